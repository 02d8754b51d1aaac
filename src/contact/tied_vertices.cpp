#include "contact/tied_vertices.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "contact/projection.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

// The last vertex of an edge, or its first one.
EdgeAtVertex at_vertex(const Edge& edge, bool last) {
  return last ? EdgeAtVertex{edge.nodes[1], edge.nodes[0]} : EdgeAtVertex{edge.nodes[0], edge.nodes[1]};
}

// The edge of a curve that begins where one of the other curve ends, at x, or the other way round.
std::optional<EdgeAtVertex> edge_at(const Points& nodes, const Curve& curve, const Vec2& x, double length, bool last) {
  for (const Edge& edge : curve.edges) {
    const EdgeAtVertex at = at_vertex(edge, last);
    const double near = at_one_place * std::min(length, edge_length(nodes, edge));
    if ((nodes.row(at.vertex).transpose() - x).norm() <= near) return at;
  }
  return {};
}

}  // namespace

TiedVertices::TiedVertices(const Mesh& mesh, const SideTable& table) {
  for (const Tie& tie : mesh.ties) {
    const Curve curves[] = {contact_curve(mesh, tie.boundary[0], table), contact_curve(mesh, tie.boundary[1], table)};
    const double turn = std::atan2(tie.turn(1, 0), tie.turn(0, 0));
    for (const int k : {0, 1}) {
      const Curve &curve = curves[k], &other = curves[1 - k];
      if (curve.closed) continue;
      for (const bool last : {false, true}) {
        const Edge& edge = last ? curve.edges.back() : curve.edges.front();
        const EdgeAtVertex here = at_vertex(edge, last);
        const Vec2 place = mesh.nodes.row(here.vertex).transpose();
        const Vec2 x = (k == 0 ? Eigen::Matrix2d(tie.turn.transpose()) : tie.turn) * place;
        if (const auto there = edge_at(mesh.nodes, other, x, edge_length(mesh.nodes, edge), !last)) {
          across_.insert_or_assign(here, AcrossTie{*there, other.body, k == 0 ? turn : -turn});
          across_.insert_or_assign(*there, AcrossTie{here, curve.body, k == 0 ? -turn : turn});
        } else if (turn == 0) {
          const Line line = line_from(mesh.nodes, curve, last ? int(curve.edges.size()) - 1 : 0, last ? 1 : -1);
          const auto hit = project_onto_curve(mesh.nodes, other, line);
          if (hit && std::abs(hit->distance) < edge_length(mesh.nodes, edge))
            across_.insert_or_assign(here, AcrossTie{{-1, -1}, other.body, 0});
        }
      }
    }
  }
}

const AcrossTie* TiedVertices::across(const EdgeAtVertex& edge) const {
  const auto found = across_.find(edge);
  return found == across_.end() ? nullptr : &found->second;
}

}  // namespace mortise
