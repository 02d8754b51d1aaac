#include "results/report.hpp"

#include <algorithm>
#include <cmath>

#include "base/vectors.hpp"
#include "problem/dirichlet_neumann.hpp"
#include "results/checks.hpp"
#include "results/error_report.hpp"
#include "solve/dense_kernel.hpp"

namespace mortise {
namespace {

Json balance_json(const Results& results) {
  const auto of = [](const Resultant& sum) -> Json { return {{"force", sum.force}, {"moment", sum.moment}}; };
  const Reactions& r = results.recovery.reactions;
  Json balance{{"loads", of(r.loads)}, {"reactions", of(r.all)}, {"held", of(r.held)}};
  for (std::size_t b = 0; b < r.held_bodies.size(); ++b)
    if (r.held_bodies[b].size > 0) balance["held"]["bodies"][results.problem.mesh.bodies[b]] = of(r.held_bodies[b]);
  return balance;
}

Json extremes_json(const Results& r) {
  const auto in_body = [&](const Extreme& e) -> Json {
    return {{"value", e.value}, {"body", r.problem.mesh.bodies[e.of]}, {"position", e.place}};
  };
  const Extremes& found = r.recovery.extremes;
  Json json{{"von_mises", in_body(found.von_mises)},
            {"principal", {{"max", in_body(found.principal_max)}, {"min", in_body(found.principal_min)}}}};
  json["displacement"] = r.solution.u.cwiseAbs().maxCoeff();
  json["von_mises"]["limit"] = !grows_without_limit(r, found.von_mises);
  if (const auto p = largest_pressure(r.recovery.contacts))
    json["pressure"] = {{"value", p->value}, {"pair", p->of}, {"position", p->place}};
  return json;
}

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

// The bar where p is largest, or by how much it may be more elsewhere; none where it has no limit.
Json peak_error(const Results& r, std::size_t k) {
  const ContactResults& c = r.recovery.contacts[k];
  if (r.estimate && k < r.estimate->pressures.size() &&
      std::ranges::any_of(r.estimate->pressures[k].singular, &SingularPoint::is_unbounded))
    return nullptr;
  double most = std::numeric_limits<double>::quiet_NaN(), bar = most;
  for (const ContactNode* n : nodes_of_extremes(c)) {
    most = std::fmax(most, n->p + n->p_error);
    if (n->p == c.p_max) bar = std::fmax(bar, n->p_error);
  }
  if (std::isnan(bar)) return nullptr;
  return std::max(bar, most - c.p_max);
}

// As the scene has it.
Json law_json(const ContactLaw& law) {
  const Vec2& last = law.points.back();
  if (law.is_linear()) return law.slope(0);
  if (law.exponent != 1) return {{"pressure", last.y()}, {"overlap", last.x()}, {"exponent", law.exponent}};
  return law.points;
}

// Of its own p; null where none counts.
Json relative_error(const Results& r, std::size_t k) {
  const double error = r.estimate ? r.estimate->pressure_of({k}) : std::nan("");
  return std::isfinite(error) ? Json(error) : Json(nullptr);
}

Json contact_json(const Results& r, std::size_t k) {
  const ContactPair& pair = r.problem.pairs[k];
  const ContactResults& c = r.recovery.contacts[k];
  const auto& error = c.force_error;
  Json json{{"between", pair.spec.between},
            {"length", c.length},
            {"length_in_contact", c.length_in_contact},
            {"length_in_contact_error", or_null(c.length_error)},
            {"ends", c.ends ? Json(*c.ends) : Json()},
            {"force", c.force},
            {"force_error", error ? Json(Vec2(error->head<2>())) : Json()},
            {"moment", c.moment},
            {"centre", c.centre},
            {"moment_about_centre", c.moment - cross(c.centre, c.force)},
            {"moment_about_centre_error", error ? Json((*error)(2)) : Json()},
            {"pressure", {{"min", c.p_min}, {"mean", c.p_mean}, {"max", c.p_max}, {"max_error", peak_error(r, k)}}},
            {"drawn", is_drawn(pair)},
            {"gap", gap_words(pair)},
            {"initial_gap", {{"min", pair.coupling.gap_min}, {"max", pair.coupling.gap_max}}}};
  if (pair.spec.stiffness) json["stiffness"] = law_json(*pair.spec.stiffness);
  if (c.fluid)
    json["fluid"] = {{"pressure", pair.spec.fluid->pressure},
                     {"wet_length", c.fluid->wet_length},
                     {"force", c.fluid->force},
                     {"besides", {{"force", c.fluid->besides.force}, {"moment", c.fluid->besides.moment}}}};
  return json;
}

Json pressure_json(const Results& r) {
  const ErrorEstimate& e = *r.estimate;
  if (e.pressures.empty() || e.pressure_square() == 0) return nullptr;
  Json singular = Json::array();
  for (std::size_t k = 0; k < e.pressures.size(); ++k)
    for (std::size_t i = 0; i < e.pressures[k].singular.size(); ++i) {
      const SingularPoint& point = e.pressures[k].singular[i];
      singular.push_back({{"pair", k},
                          {"position", point.position},
                          {"exponent", point.exponent},
                          {"pressure_exponent", point.pressure_exponent},
                          {"logarithmic", point.log_pressure > 0},
                          {"unbounded", point.is_unbounded()},
                          {"left_out", e.pressures[k].left_out[i]}});
    }
  return {{"error", e.pressure()}, {"line", e.line()}, {"far_field", e.far_field()}, {"singular", singular}};
}

Json estimate_json(const Results& r) {
  if (!r.estimate) return nullptr;
  const EnergyEstimate& e = r.estimate->energy;
  return {{"error", e.error},
          {"largest", {{"body", r.problem.mesh.bodies[e.body]}, {"part", e.part}, {"position", e.position}}},
          {"pressure", pressure_json(r)}};
}

Json accuracy_json(const Results& r) {
  if (!r.accuracy) return nullptr;
  const AccuracyReport& a = *r.accuracy;
  Json solves = Json::array();
  for (const AccuracyReport::Solve& s : a.solves)
    solves.push_back({{"unknowns", s.unknowns}, {"estimated", s.estimated}, {"seconds", s.seconds}});
  return {{"of", to_string(a.of)},  {"value", r.estimate->goal ? Json(r.estimate->goal->value) : Json()},
          {"asked", a.asked},       {"reached", a.reached()},
          {"reason", a.reason},     {"largest", a.reached() ? Json() : Json(largest_error(r))},
          {"excluded", a.excluded}, {"solves", solves},
          {"answer", a.answer()}};
}

Json steps_json(const Results& r) {
  Json steps = Json::array();
  for (const ActiveSetStep& s : r.solution.steps)
    steps.push_back(
        {{"active", s.active}, {"changed", s.changed}, {"penetration", s.penetration}, {"tension", s.tension}});
  return steps;
}

Json iteration_json(const Solution& solution) {
  if (!solution.iteration) return nullptr;
  const Iteration& i = *solution.iteration;
  const Residuals last = i.history.back().residuals;
  Json json{{"method", i.method}, {"acceleration", to_string(i.acceleration)}, {"settings", i.settings},
            {"steps", i.steps},   {"convergence_rate", i.convergence_rate},    {"kinematic", last.kinematic},
            {"force", last.force}};
  for (const auto& [name, value] : i.figures) json[name] = value;
  return json;
}

Json gap_json(const ContactSpec& spec) {
  if (spec.initial_gap == InitialGap::given)
    return spec.gap.is_constant() ? Json(spec.gap.constant()) : Json(spec.gap.words());
  const std::string word = to_string(spec.initial_gap);
  return spec.clearance == Field() ? word : word + " + " + spec.clearance.words();
}

// The multiplier space that is really used: quadratic needs 3-node edges.
std::string space_word(const Results& r) {
  const bool quadratic_edges = std::any_of(r.problem.pairs.begin(), r.problem.pairs.end(),
                                           [](const ContactPair& p) { return p.multiplier.edges[0].node_count == 3; });
  if (r.problem.method.multipliers == Multipliers::quadratic && !quadratic_edges) return to_string(Multipliers::linear);
  return to_string(r.problem.method.multipliers);
}

Json method_json(const Results& r) {
  const Method& method = r.problem.method;
  Json on = Json::array(), condition = Json::array(), gap = Json::array();
  for (const ContactPair& pair : r.problem.pairs) {
    on.push_back(pair.spec.multipliers_on);
    condition.push_back(to_string(pair.spec.condition));
    gap.push_back(gap_json(pair.spec));
  }
  return {{"integration", to_string(method.integration)},
          {"normals", to_string(method.normals)},
          {"multipliers", space_word(r)},
          {"multipliers_on", on},
          {"solver", to_string(r.solution.solver)},
          {"dirichlet", dirichlet_names(r.problem.mesh, r.problem.dirichlet)},
          {"condition", condition},
          {"initial_gap", gap}};
}

Json mesh_json(const Results& r) {
  return {{"nodes", r.problem.mesh.nodes.rows()},
          {"elements", r.problem.mesh.cells.size()},
          {"dofs", free_unknowns(r)},
          {"multipliers", r.solution.lambda.size()},
          {"cached", r.mesh_cached}};
}

Json seconds_json(const Seconds& s) {
  return {{"mesh", s.mesh},           {"assemble", s.assemble}, {"couple", s.couple},
          {"factorise", s.factorise}, {"solve", s.solve},       {"recover", s.recover},
          {"estimate", s.estimate},   {"write", s.write},       {"total", s.total()}};
}

Json counts_json(const Results& r) {
  return {{"contact", r.problem.pairs.empty() ? 0 : r.solution.steps.size()},
          {"contact_coarse", r.solution.coarse_steps},
          {"contact_interior", r.solution.interior_steps},
          {"layers", r.solution.layer_steps},
          {"solver", r.solution.iteration ? r.solution.iteration->steps : 0}};
}

Json contacts_json(const Results& r) {
  Json list = Json::array();
  const ContactNumbers numbers = contact_numbers(r.problem);
  for (std::size_t k = 0; k < r.problem.pairs.size(); ++k) {
    list.push_back(contact_json(r, k));
    list.back()["number"] = numbers.pairs[k];
    list.back()["pressure"]["error"] = relative_error(r, k);
  }
  return list;
}

Json checks_json(const std::vector<Check>& checks) {
  Json list = Json::array();
  for (const Check& c : checks) {
    list.push_back({{"name", c.name}, {"value", c.value}, {"limit", c.limit}, {"ok", c.ok()}});
    if (!c.ok() && !c.where.empty()) list.back()["where"] = c.where;
  }
  return list;
}

Json expected_json(const std::vector<ExpectedFigure>& expected) {
  Json list = Json::array();
  for (const ExpectedFigure& e : expected)
    list.push_back({{"figure", e.name},
                    {"value", e.of.value.is_constant() ? Json(e.of.value.constant()) : Json(e.of.value.words())},
                    {"found", e.found},
                    {"off", e.off},
                    {"tolerance", e.of.tolerance},
                    {"source", e.of.source}});
  return list;
}

}  // namespace

Json report_of(const Results& r) {
  Json report{{"title", r.problem.title},
              {"scene", r.problem.scene},
              {"changes", r.problem.changes},
              {"version", MORTISE_VERSION},
              {"dense_kernel", dense_kernel()},
              {"status", to_string(r.status)},
              {"model", model_report(r.problem, &r.recovery.reactions)},
              {"method", method_json(r)},
              {"mesh", mesh_json(r)},
              {"seconds", seconds_json(r.seconds)},
              {"iterations", counts_json(r)},
              {"contact_steps", steps_json(r)},
              {"iteration", iteration_json(r.solution)},
              {"estimate", estimate_json(r)},
              {"accuracy", accuracy_json(r)},
              {"inf_sup", r.inf_sup ? Json(r.inf_sup->beta) : Json()},
              {"probes", r.recovery.probes.size()},
              {"energy", r.recovery.energy},
              {"contact", contacts_json(r)},
              {"balance", balance_json(r)},
              {"extremes", extremes_json(r)},
              {"checks", checks_json(r.checks)},
              {"large_displacement", r.contact_moved},
              {"warnings", r.warnings}};
  if (!r.problem.load_case.empty()) report["case"] = r.problem.load_case;
  if (!r.expected.empty()) report["expected"] = expected_json(r.expected);
  if (r.inf_sup) report["inf_sup_position"] = r.inf_sup->position;
  return report;
}

}  // namespace mortise
