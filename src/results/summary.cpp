#include "results/summary.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <sstream>

#include "base/printable.hpp"
#include "problem/dirichlet_neumann.hpp"
#include "results/checks.hpp"
#include "results/contact_summary.hpp"
#include "results/diagnose.hpp"
#include "results/error_report.hpp"
#include "results/model_summary.hpp"
#include "solve/dense_kernel.hpp"

namespace mortise {
namespace {

using Json = nlohmann::ordered_json;

Json balance_json(const Reactions& r) {
  Json balance;
  const auto add = [&](const char* name, const Resultant& sum) {
    balance[name] = {{"force", {sum.force.x(), sum.force.y()}}, {"moment", sum.moment}};
  };
  add("loads", r.loads);
  add("reactions", r.all);
  add("held", r.held);
  return balance;
}

Json extremes_json(const Results& r) {
  const auto in_body = [&](const Extreme& e) -> Json {
    return {{"value", e.value}, {"body", r.problem.mesh.bodies[e.of]}, {"position", {e.place.x(), e.place.y()}}};
  };
  const Extremes& found = r.recovery.extremes;
  Json json{{"von_mises", in_body(found.von_mises)},
            {"principal", {{"max", in_body(found.principal_max)}, {"min", in_body(found.principal_min)}}}};
  json["von_mises"]["limit"] = !grows_without_limit(r, found.von_mises);
  if (const auto& p = found.pressure)
    json["pressure"] = {{"value", p->value}, {"pair", p->of}, {"position", {p->place.x(), p->place.y()}}};
  return json;
}

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json contact_json(const ContactPair& pair, const ContactResults& c) {
  const auto& error = c.force_error;
  return {{"between", pair.spec.between},
          {"length", c.length},
          {"length_in_contact", c.length_in_contact},
          {"length_in_contact_error", or_null(c.length_error)},
          {"force", {c.force.x(), c.force.y()}},
          {"force_error", error ? Json{(*error)(0), (*error)(1)} : Json()},
          {"moment", c.moment},
          {"centre", {c.centre.x(), c.centre.y()}},
          {"moment_about_centre", c.moment - (c.centre.x() * c.force.y() - c.centre.y() * c.force.x())},
          {"moment_about_centre_error", error ? Json((*error)(2)) : Json()},
          {"pressure", {{"min", c.p_min}, {"mean", c.p_mean}, {"max", c.p_max}}},
          {"drawn", is_drawn(pair)},
          {"initial_gap", {{"min", pair.coupling.gap_min}, {"max", pair.coupling.gap_max}}}};
}

Json pressure_json(const Results& r) {
  const ErrorEstimate& e = *r.estimate;
  if (e.pressures.empty() || e.pressure_square() == 0) return nullptr;
  Json singular = Json::array(), excluded = Json::array();
  for (std::size_t k = 0; k < e.pressures.size(); ++k) {
    for (const SingularPoint& point : e.pressures[k].singular)
      singular.push_back({{"pair", k},
                          {"position", {point.position.x(), point.position.y()}},
                          {"exponent", point.exponent},
                          {"pressure_exponent", point.pressure_exponent},
                          {"logarithmic", point.log_pressure > 0}});
    excluded.push_back(e.pressures[k].excluded_distance);
  }
  return {{"error", e.pressure()},
          {"line", e.line()},
          {"far_field", e.far_field()},
          {"singular", singular},
          {"excluded", excluded}};
}

Json estimate_json(const Results& r) {
  if (!r.estimate) return nullptr;
  const EnergyEstimate& e = r.estimate->energy;
  return {{"error", e.error},
          {"largest",
           {{"body", r.problem.mesh.bodies[e.body]}, {"part", e.part}, {"position", {e.position.x(), e.position.y()}}}},
          {"pressure", pressure_json(r)}};
}

Json accuracy_json(const Results& r) {
  if (!r.accuracy) return nullptr;
  const AccuracyReport& a = *r.accuracy;
  Json solves = Json::array();
  for (const AccuracyReport::Solve& s : a.solves)
    solves.push_back({{"unknowns", s.unknowns}, {"estimated", s.estimated}, {"seconds", s.seconds}});
  return {{"of", to_string(a.of)},
          {"value", r.estimate->goal ? Json(std::vector(r.estimate->goal->value.begin(), r.estimate->goal->value.end()))
                                     : Json()},
          {"asked", a.asked},
          {"reached", a.reached()},
          {"reason", a.reason},
          {"largest", a.reached() ? Json() : Json(largest_error(r))},
          {"excluded", a.excluded},
          {"solves", solves}};
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
  Json json{{"method", i.method},
            {"acceleration", to_string(i.acceleration)},
            {"steps", i.steps},
            {"convergence_rate", i.convergence_rate},
            {"kinematic", last.kinematic},
            {"force", last.force}};
  for (const auto& [name, value] : i.figures) json[name] = value;
  return json;
}

void print_iteration(const Results& r, std::ostream& out) {
  if (!r.solution.iteration) return;
  const Iteration& i = *r.solution.iteration;
  const Residuals last = i.history.back().residuals;
  out << "  iteration " << i.method << ", acceleration " << to_string(i.acceleration)
      << (i.settings.empty() ? "" : ", ") << i.settings << "\n            ";
  const std::vector<std::string> dirichlet = dirichlet_names(r.problem.mesh, r.problem.dirichlet);
  if (!dirichlet.empty()) out << "displacement taken by " << listed(dirichlet);
  out << (dirichlet.empty() ? "" : "; ") << i.steps << " steps to residuals " << last.kinematic << " (kinematic), "
      << last.force << " (force); " << i.convergence_rate << " a step\n";
}

// One row a solve, where there was more than one.
void print_steps(const Results& r, std::ostream& out) {
  if (r.solution.steps.size() < 2) return;
  out << "  steps     " << std::setw(6) << "closed" << std::setw(10) << "changing" << std::setw(16) << "penetration"
      << std::setw(16) << "tension\n";
  for (std::size_t k = 0; k < r.solution.steps.size(); ++k) {
    if (r.solution.steps.size() > 14 && k == 7) {
      out << "            ... summary.json has all\n";
      k = r.solution.steps.size() - 7;
    }
    const ActiveSetStep& s = r.solution.steps[k];
    out << std::setw(10) << k + 1 << "  " << std::setw(6) << s.active << std::setw(10) << s.changed << std::setw(16)
        << s.penetration << std::setw(15) << s.tension << "\n";
  }
}

// Where p has no limit, and is left out of its norm.
void print_left_out(const ErrorEstimate& estimate, std::ostream& out) {
  std::string places;
  int count = 0;
  for (const PressureEstimate& e : estimate.pressures)
    for (const SingularPoint& point : e.singular)
      if (point.is_unbounded() && ++count <= 3) places += (count > 1 ? ", " : "") + near_point(point.position);
  if (count == 0) return;
  out << "            left out where p has no limit, " << places;
  if (count > 3) out << " and " << count - 3 << " more";
  out << "\n";
}

// What p is within, and what was asked.
void print_accuracy(const Results& r, std::ostream& out) {
  if (!r.estimate || !std::isfinite(r.estimate->pressure())) return;
  const double found = r.accuracy ? r.accuracy->solves.back().estimated : r.estimate->pressure();
  const std::map<Goal, std::string> words{
      {Goal::pressure, "p"},   {Goal::peak, "largest p"}, {Goal::half_width, "half-width of contact"},
      {Goal::mean, "mean p"},  {Goal::force, "force"},    {Goal::displacement, "displacement"},
      {Goal::stress, "stress"}};
  out << std::setprecision(2) << "  accuracy  " << words.at(r.accuracy ? r.accuracy->of : Goal::pressure);
  if (r.estimate->goal && std::isfinite(found)) {
    const VecX& value = r.estimate->goal->value;
    out << std::setprecision(6);
    for (Eigen::Index i = 0; i < value.size(); ++i) out << (i == 0 ? value.size() > 1 ? " (" : " " : ", ") << value(i);
    out << (value.size() > 1 ? ")" : "") << std::setprecision(2);
  }
  if (std::isfinite(found))
    out << " within " << 100 * found << " %";
  else
    out << " not known";
  if (r.accuracy) {
    const AccuracyReport& a = *r.accuracy;
    out << " (asked " << 100 * a.asked << " %): "
        << (a.solves.size() == 1 ? "1 solve, which no second confirms" : std::to_string(a.solves.size()) + " solves");
    if (a.of == Goal::half_width && found == 0) out << "; contact ends nowhere within a line";
    if (!a.reached()) out << "; not reached: " << a.reason << "; largest part: " << largest_error(r);
  }
  out << "\n";
  if (!r.accuracy || r.accuracy->of == Goal::pressure) print_left_out(*r.estimate, out);
  out << std::setprecision(6);
}

void print_extremes(const Results& r, std::ostream& out) {
  const Extremes& found = r.recovery.extremes;
  const Extreme& v = found.von_mises;
  out << std::setprecision(6) << "  largest   displacement " << r.solution.u.cwiseAbs().maxCoeff() << "; von Mises "
      << v.value << " in " << r.problem.mesh.bodies[v.of] << " " << near_point(v.place)
      << (grows_without_limit(r, v) ? ", where it has no limit" : "") << "; principal stresses "
      << found.principal_min.value << " ... " << found.principal_max.value << "\n";
}

// Those that fail; summary.json has all.
void print_checks(const std::vector<Check>& checks, std::ostream& out) {
  const auto hold = std::count_if(checks.begin(), checks.end(), [](const Check& c) { return c.ok(); });
  const auto balance = std::ranges::find(checks, balance_check, &Check::name);
  out << std::setprecision(2) << "  checks    " << hold << " of " << checks.size()
      << " hold; reactions and loads sum to " << balance->value << " (relative)\n";
  for (const Check& c : checks)
    if (!c.ok())
      out << "  FAILED    " << c.name << ": " << c.value << " (limit " << c.limit << ")"
          << (c.where.empty() ? "" : "; " + c.where) << "\n";
}

Json gap_json(const ContactSpec& spec) {
  if (spec.initial_gap == InitialGap::given) return json_of(spec.gap);
  const std::string word = to_string(spec.initial_gap);
  return spec.clearance == Field() ? word : word + " + " + spec.clearance.words();
}

}  // namespace

Json summary_json(const Results& r, double write_seconds) {
  Json on = Json::array(), condition = Json::array(), gap = Json::array(), contact = Json::array();
  for (std::size_t k = 0; k < r.problem.pairs.size(); ++k) {
    const ContactSpec& spec = r.problem.pairs[k].spec;
    on.push_back(spec.multipliers_on);
    condition.push_back(to_string(spec.condition));
    gap.push_back(gap_json(spec));
    contact.push_back(contact_json(r.problem.pairs[k], r.recovery.contacts[k]));
  }
  Json checks = Json::array();
  for (const Check& c : r.checks) {
    checks.push_back({{"name", c.name}, {"value", c.value}, {"limit", c.limit}, {"ok", c.ok()}});
    if (!c.ok() && !c.where.empty()) checks.back()["where"] = c.where;
  }
  const Seconds& s = r.seconds;
  return {{"title", r.problem.title},
          {"scene", r.problem.scene},
          {"version", MORTISE_VERSION},
          {"dense_kernel", dense_kernel()},
          {"status", to_string(r.status)},
          {"model", model_json(r.problem, r.recovery.reactions)},
          {"method",
           {{"integration", to_string(r.problem.method.integration)},
            {"normals", to_string(r.problem.method.normals)},
            {"multipliers", space_word(r)},
            {"multipliers_on", on},
            {"solver", to_string(r.solution.solver)},
            {"dirichlet", dirichlet_names(r.problem.mesh, r.problem.dirichlet)},
            {"condition", condition},
            {"initial_gap", gap}}},
          {"mesh",
           {{"nodes", r.problem.mesh.nodes.rows()},
            {"elements", r.problem.mesh.cells.size()},
            {"dofs", free_unknowns(r)},
            {"multipliers", r.solution.lambda.size()},
            {"cached", r.mesh_cached}}},
          {"seconds",
           {{"mesh", s.mesh},
            {"assemble", s.assemble},
            {"couple", s.couple},
            {"factorise", s.factorise},
            {"solve", s.solve},
            {"recover", s.recover},
            {"estimate", s.estimate},
            {"write", write_seconds},
            {"total", s.total() + write_seconds}}},
          {"iterations",
           {{"contact", r.problem.pairs.empty() ? 0 : r.solution.steps.size()},
            {"contact_coarse", r.solution.coarse_steps},
            {"solver", r.solution.iteration ? r.solution.iteration->steps : 0}}},
          {"contact_steps", steps_json(r)},
          {"iteration", iteration_json(r.solution)},
          {"estimate", estimate_json(r)},
          {"accuracy", accuracy_json(r)},
          {"inf_sup", r.inf_sup ? Json(r.inf_sup->beta) : Json()},
          {"energy", r.recovery.energy},
          {"contact", contact},
          {"balance", balance_json(r.recovery.reactions)},
          {"extremes", extremes_json(r)},
          {"checks", checks},
          {"warnings", r.warnings}};
}

std::string terminal_summary(const Results& r, const std::filesystem::path& folder) {
  std::ostringstream out;
  out << printable(r.problem.title) << "\n";
  out << "  " << to_string(r.status) << "; results in " << folder.string() << "/ (result.vtu opens in ParaView)\n";
  out << "  mesh      " << r.problem.mesh.nodes.rows() << " nodes, " << r.problem.mesh.cells.size() << " elements; "
      << free_unknowns(r) << " unknowns, " << r.solution.lambda.size() << " multipliers\n";
  out << std::setprecision(6) << model_lines(r.problem, &r.recovery.reactions);
  out << contact_lines(r);
  out << std::setprecision(3);
  print_iteration(r, out);
  print_steps(r, out);
  if (const std::string words = contact_words(r); !words.empty()) out << "            " << words << "\n";
  print_extremes(r, out);
  out << "  energy    " << r.recovery.energy << "\n";
  if (r.estimate)
    out << std::setprecision(2) << "  estimate  stresses off by " << 100 * r.estimate->energy.error
        << " % (energy norm), the most in " << r.problem.mesh.bodies[r.estimate->energy.body] << " "
        << near_point(r.estimate->energy.position) << "\n"
        << std::setprecision(6);
  print_accuracy(r, out);
  if (!r.recovery.probes.empty()) out << "  probes    " << r.recovery.probes.size() << " places in probes.csv\n";
  if (r.inf_sup)
    out << "  inf-sup   " << r.inf_sup->beta << ", worst " << near_point(r.inf_sup->position) << " (limit "
        << inf_sup_limit << ")\n";
  print_checks(r.checks, out);
  for (std::size_t i = 0; i < std::min<std::size_t>(r.warnings.size(), 5); ++i)
    out << "  warning   " << r.warnings[i] << "\n";
  if (r.warnings.size() > 5) out << "  warning   " << r.warnings.size() - 5 << " more in summary.json\n";
  const Seconds& s = r.seconds;
  out << std::fixed << std::setprecision(3) << "  seconds   mesh " << s.mesh << (r.mesh_cached ? " (cached)" : "")
      << ", assemble " << s.assemble << ", couple " << s.couple << ", factorise " << s.factorise << ", solve "
      << s.solve << ", recover " << s.recover << ", estimate " << s.estimate << ", write " << s.write << "; total "
      << s.total() << "\n";
  return out.str();
}

}  // namespace mortise
