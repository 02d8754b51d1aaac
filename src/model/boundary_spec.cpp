#include "model/boundary_spec.hpp"

#include "base/overloaded.hpp"

namespace mortise {
namespace {

template <typename... Kinds>
bool is_any(const BoundaryCondition& what) {
  return (std::holds_alternative<Kinds>(what) || ...);
}

}  // namespace

bool is_load(const BoundaryCondition& what) { return is_any<Pressure, SurfaceTraction, TotalForce>(what); }

bool is_foundation(const BoundaryCondition& what) { return is_any<NormalFoundation, AxesFoundation>(what); }

std::vector<const Field*> fields_of(const BoundaryCondition& what) {
  using Fields = std::vector<const Field*>;
  return std::visit(
      Overloaded{[](const Displacement& u) {
                   Fields fields;
                   for (const auto* field : {&u.x, &u.y})
                     if (*field) fields.push_back(&**field);
                   return fields;
                 },
                 [](const NormalDisplacement& u) -> Fields { return {&u.value}; },
                 [](const DirectedDisplacement& u) -> Fields { return {&u.value}; },
                 [](const RigidSpec&) -> Fields { return {}; }, [](const Pressure& p) -> Fields { return {&p.value}; },
                 [](const SurfaceTraction& t) -> Fields {
                   return {&t.value.x, &t.value.y};
                 },
                 [](const TotalForce&) -> Fields { return {}; },
                 [](const NormalFoundation& k) -> Fields { return {&k.modulus}; },
                 [](const AxesFoundation& k) -> Fields {
                   return {&k.moduli.x, &k.moduli.y};
                 },
                 [](const PointSpring&) -> Fields { return {}; }},
      what);
}

}  // namespace mortise
