#include "problem/dirichlet_neumann.hpp"

#include <algorithm>

#include "base/errors.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

// Two bodies with a contact pair or common nodes between them.
struct Link {
  int body, other;
  bool differ;                             // in contact: different roles
  bool body_finer;                         // in contact: its edges are the shorter ones, or as long
  bool body_prescribed, other_prescribed;  // in contact: its curve's normal displacements are all given
  std::string key;
};

bool prescribed(const Mesh& mesh, const Curve& curve, const Constraints& constraints) {
  for (const Edge& edge : curve.edges)
    for (int a = 0; a < edge.node_count; ++a) {
      const Vec2 n = edge_point(mesh.nodes, edge, xi_of_node(a)).normal();
      if (!prescribed_along(constraints, edge.nodes[a], n)) return false;
    }
  return true;
}

std::vector<Link> contact_links(const Mesh& mesh, const std::vector<ContactCurves>& contacts,
                                const Constraints& constraints) {
  std::vector<Link> links;
  for (const auto& [spec, curves, edge_size] : contacts)
    links.push_back({.body = curves[0].body,
                     .other = curves[1].body,
                     .differ = true,
                     .body_finer = edge_size[0] <= (1 + 1e-6) * edge_size[1],
                     .body_prescribed = prescribed(mesh, curves[0], constraints),
                     .other_prescribed = prescribed(mesh, curves[1], constraints),
                     .key = spec.key});
  return links;
}

void add_shared_nodes(const Mesh& mesh, std::vector<Link>& links) {
  std::vector<int> owner(mesh.nodes.rows(), -1);
  for (const Cell& cell : mesh.cells)
    for (int a = 0; a < node_count(cell.kind); ++a) {
      int& first = owner[cell.nodes[a]];
      if (first < 0) first = cell.body;
      if (first != cell.body) links.push_back({first, cell.body, false, false, false, false, "common nodes"});
    }
}

// One set of bodies that hang together, dealt out in two: sides[b] is 0 or 1, -1 for bodies of other sets.
std::vector<int> deal_out(const Mesh& mesh, const std::vector<Link>& links, int first) {
  std::vector<int> side(mesh.bodies.size(), -1);
  side[first] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (const Link& link : links) {
      int& a = side[link.body];
      int& b = side[link.other];
      if (a < 0 && b < 0) continue;
      if (a >= 0 && b >= 0) {
        if ((a != b) != link.differ)
          throw SceneError(
              link.key + ": '" + mesh.bodies[link.body] + "' and '" + mesh.bodies[link.other] +
              "' cannot take the displacement in turns: domain decomposition needs bodies in a chain, "
              "each in contact with others of the opposite role only; expected method.solver = \"direct\"");
        continue;
      }
      (a < 0 ? a : b) = link.differ ? 1 - std::max(a, b) : std::max(a, b);
      changed = true;
    }
  }
  return side;
}

// The side whose bodies take the displacement by their `names`; -1 if none does.
int named_side(const std::vector<std::string>& names, const Mesh& mesh, const std::vector<int>& side) {
  int named = -1;
  for (const std::string& name : names) {
    const int s = side[body_index(mesh, name)];
    if (s >= 0 && named >= 0 && s != named)
      throw SceneError("method.dirichlet: '" + name + "' is in contact with a body of the same role");
    named = std::max(named, s);
  }
  return named;
}

// The side with the softer bodies; of equally stiff ones that with the finer curves. A body whose whole curve is
// prescribed cannot take the displacement.
int softer_side(const std::vector<Link>& links, const std::vector<int>& side, const std::vector<ElasticLaw>& laws) {
  std::array<double, 2> stiffest{};
  std::array<int, 2> finer{}, given{};
  for (std::size_t b = 0; b < side.size(); ++b)
    if (side[b] >= 0) stiffest[side[b]] = std::max(stiffest[side[b]], laws[b].young);
  for (const Link& link : links) {
    if (!link.differ || side[link.body] < 0) continue;
    const int body = side[link.body], other = 1 - body;
    ++finer[link.body_finer ? body : other];
    given[body] += link.body_prescribed;
    given[other] += link.other_prescribed;
  }
  if (given[0] != given[1]) return given[1] < given[0];
  if (stiffest[0] != stiffest[1]) return stiffest[1] < stiffest[0];
  return finer[1] > finer[0];
}

}  // namespace

std::vector<char> dirichlet_bodies(const std::vector<std::string>& names, const Mesh& mesh, const Discretisation& d,
                                   const std::vector<ContactCurves>& contacts) {
  std::vector<Link> links = contact_links(mesh, contacts, d.system.constraints);
  add_shared_nodes(mesh, links);
  std::vector<char> dirichlet(mesh.bodies.size(), 0), dealt(mesh.bodies.size(), 0);
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    if (dealt[links[k].body]) continue;
    const std::vector<int> side = deal_out(mesh, links, links[k].body);
    const int named = named_side(names, mesh, side);
    const int chosen = named >= 0 ? named : softer_side(links, side, d.laws);
    for (std::size_t b = 0; b < side.size(); ++b) {
      if (side[b] < 0) continue;
      dealt[b] = 1;
      dirichlet[b] = side[b] == chosen;
    }
  }
  return dirichlet;
}

std::vector<char> unknowns_of(const Mesh& mesh, const std::vector<char>& bodies) {
  if (bodies.empty()) return {};
  std::vector<char> member(2 * mesh.nodes.rows(), 0);
  for (const Cell& cell : mesh.cells)
    for (int a = 0; a < node_count(cell.kind); ++a)
      member[2 * cell.nodes[a]] = member[2 * cell.nodes[a] + 1] = bodies[cell.body];
  return member;
}

}  // namespace mortise
