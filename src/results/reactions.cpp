#include "results/reactions.hpp"

#include "fem/edges.hpp"
#include "problem/scene_names.hpp"

namespace mortise {
namespace {

VecX nodal_reactions(const SaddlePointSystem& s, const Solution& solution) {
  VecX nodal = s.K.selfadjointView<Eigen::Lower>() * solution.u + s.B.transpose() * solution.lambda - s.f;
  for (Eigen::Index i = 0; i < nodal.size(); ++i)
    if (!s.constraints.fixed[i]) nodal(i) = 0;
  return nodal;
}

// Adds up the reactions, each once: what has been added is 0 in `left`.
class Collector {
 public:
  Collector(const Mesh& mesh, const VecX& nodal) : mesh_(mesh), left_(nodal) {}

  Resultant take(const Boundary& curve, bool x, bool y) {
    Resultant sum;
    for (const Edge& edge : curve.edges)
      for (int a = 0; a < edge.node_count; ++a) take_node(edge.nodes[a], x, y, sum);
    return sum;
  }

  Resultant take_rest() {
    Resultant sum;
    for (int node = 0; node < int(mesh_.nodes.rows()); ++node) take_node(node, true, true, sum);
    return sum;
  }

 private:
  void take_node(int node, bool x, bool y, Resultant& sum) {
    Vec2 force = Vec2::Zero();
    if (x) std::swap(force.x(), left_(2 * node));
    if (y) std::swap(force.y(), left_(2 * node + 1));
    sum.add(mesh_.nodes.row(node).transpose(), force);
  }

  const Mesh& mesh_;
  VecX left_;
};

Resultant sum_of_loads(const Mesh& mesh, const Discretisation& d) {
  Resultant sum;
  const VecX loads = d.system.f - d.initial_load;
  for (Eigen::Index i = 0; i < mesh.nodes.rows(); ++i) sum.add(mesh.nodes.row(i).transpose(), loads.segment<2>(2 * i));
  return sum;
}

}  // namespace

Reactions find_reactions(const Scene& scene, const Mesh& mesh, const Discretisation& d, const Solution& solution) {
  Reactions r;
  r.nodal = nodal_reactions(d.system, solution);
  const VecX of_springs = spring_forces(d, solution.u);
  Collector collector(mesh, r.nodal), springs(mesh, of_springs);
  r.nodal += of_springs;
  const SceneNames names(mesh);
  for (const BoundarySpec& spec : scene.boundaries) {
    Resultant& entry = r.entries.emplace_back();
    if (spec.is_load()) continue;
    for (const std::string& name : spec.on)
      for (const int b : names.boundaries(spec.key + ".on", name)) {
        const Boundary& curve = mesh.boundaries[b];
        const Resultant sum = spec.is_foundation() ? springs.take(curve, true, true)
                                                   : collector.take(curve, spec.displacement_x.has_value(),
                                                                    spec.displacement_y.has_value());
        r.curves.push_back({int(r.entries.size()) - 1, b, centre_of(mesh.nodes, curve.edges), sum});
        entry += sum;
      }
    r.all += entry;
  }
  r.held = collector.take_rest();
  r.all += r.held;
  r.loads = sum_of_loads(mesh, d);
  return r;
}

}  // namespace mortise
