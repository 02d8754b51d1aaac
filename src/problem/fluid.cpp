#include "problem/fluid.hpp"

#include <algorithm>
#include <sstream>

#include "base/errors.hpp"
#include "contact/multiplier_rows.hpp"
#include "fem/edges.hpp"

namespace mortise {
namespace {

constexpr double as_much = 1 - 1e-8;  // of the fluid's pressure: what a row carries is not known any better

// Where fluid gets in: of the multipliers along the line the nearest.
std::vector<std::size_t> inlets(const Mesh& mesh, const ContactPair& pair, const std::vector<int>& line) {
  std::vector<std::size_t> found;
  for (const Vec2& x : pair.spec.fluid->from) {
    const auto away = [&](int a) { return (mesh.nodes.row(pair.coupling.node[a]).transpose() - x).norm(); };
    const auto nearest = std::ranges::min_element(line, {}, away);
    if (const double length = curve_length(mesh.nodes, pair.multiplier); away(*nearest) > length) {
      std::ostringstream text;
      text << pair.spec.key << ".fluid.from: (" << x.x() << ", " << x.y() << ") lies " << away(*nearest) << " from '"
           << mesh.boundaries[pair.multiplier.boundary].name << "', more than that is long, " << length
           << "; expected a place on the curve, such as one of its ends";
      throw SceneError(text.str());
    }
    found.push_back(std::size_t(nearest - line.begin()));
  }
  return found;
}

// Calls wet(row) for the rows that fluid gets to from an inlet, both ways along the line, each until `holds(row)`.
template <typename Holds, typename Wet>
void flow(const ContactPair& pair, const std::vector<int>& line, std::size_t inlet, Holds holds, Wet wet) {
  const int count = int(line.size());
  for (const int step : {1, -1})
    for (int k = 0, i = int(inlet); k < count; ++k, i += step) {
      if (pair.multiplier.closed) i = (i + count) % count;
      if (i < 0 || i >= count) break;
      const int row = pair.coupling.row[line[i]];
      if (row < 0) continue;  // it faces nothing
      if (holds(pair.first_row + row)) break;
      wet(pair.first_row + row);
    }
}

}  // namespace

VecX dry_rows(const Mesh& mesh, const std::vector<ContactPair>& pairs, Eigen::Index rows) {
  if (std::ranges::none_of(pairs, [](const ContactPair& pair) { return pair.spec.fluid.has_value(); })) return {};
  for (const ContactPair& pair : pairs)
    if (pair.spec.fluid) inlets(mesh, pair, multipliers_along(pair.coupling));
  return VecX::Zero(rows);
}

bool spread_fluids(const Solution& solution, Problem& p) {
  if (p.fluid.size() == 0) return false;
  const VecX before = p.fluid;
  for (const ContactPair& pair : p.pairs) {
    if (!pair.spec.fluid || pair.spec.fluid->pressure == 0) continue;
    const double pressure = pair.spec.fluid->pressure;
    const std::vector<int> line = multipliers_along(pair.coupling);
    for (const std::size_t inlet : inlets(p.mesh, pair, line))
      flow(
          pair, line, inlet, [&](int row) { return p.fluid(row) == 0 && -solution.lambda(row) >= as_much * pressure; },
          [&](int row) { p.fluid(row) = pressure; });
  }
  const VecX more = p.fluid - before;
  p.discretisation.system.f += p.discretisation.system.B.transpose() * more;
  return more.any();
}

void add_fluids(Problem& p, Solution& solution) {
  if (p.fluid.size() == 0) return;
  p.discretisation.system.f -= p.discretisation.system.B.transpose() * p.fluid;
  if (solution.lambda.size() > 0) solution.lambda -= p.fluid;
}

}  // namespace mortise
