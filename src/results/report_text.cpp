#include "results/report_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <map>
#include <sstream>

#include "base/printable.hpp"
#include "results/checks.hpp"
#include "results/diagnose.hpp"

namespace mortise {
namespace {

std::string near(const Json& position) { return near_point({position[0].get<double>(), position[1].get<double>()}); }

void print_iteration(const Json& report, std::ostream& out) {
  const Json& i = report["iteration"];
  if (i.is_null()) return;
  const std::string settings = i["settings"];
  out << "  iteration " << i["method"].get<std::string>() << ", acceleration " << i["acceleration"].get<std::string>()
      << (settings.empty() ? "" : ", ") << settings << "\n            ";
  const std::vector<std::string> dirichlet = report["method"]["dirichlet"];
  if (!dirichlet.empty()) out << "displacement taken by " << listed(dirichlet) << "; ";
  out << i["steps"] << " steps to residuals " << i["kinematic"].get<double>() << " (kinematic), "
      << i["force"].get<double>() << " (force); " << i["convergence_rate"].get<double>() << " a step\n";
}

// One row a solve, where there was more than one.
void print_steps(const Json& steps, std::ostream& out) {
  if (steps.size() < 2) return;
  out << "  steps     " << std::setw(6) << "closed" << std::setw(10) << "changing" << std::setw(16) << "penetration"
      << std::setw(16) << "tension\n";
  for (std::size_t k = 0; k < steps.size(); ++k) {
    if (steps.size() > 14 && k == 7) {
      out << "            ... summary.json has all\n";
      k = steps.size() - 7;
    }
    const Json& s = steps[k];
    out << std::setw(10) << k + 1 << "  " << std::setw(6) << s["active"].get<int>() << std::setw(10)
        << s["changed"].get<int>() << std::setw(16) << s["penetration"].get<double>() << std::setw(15)
        << s["tension"].get<double>() << "\n";
  }
}

// How contact was found; nothing where nothing was to be found.
void print_contact_search(const Json& report, std::ostream& out) {
  const Json &conditions = report["method"]["condition"], &steps = report["contact_steps"];
  if (std::ranges::count(conditions, Json("unilateral")) == 0 || !report["iteration"].is_null()) return;
  const int coarse = report["iterations"]["contact_coarse"], layers = report["iterations"]["layers"];
  out << "            ";
  if (layers > 0) out << layers << " tangents until p is that of the law; with the last ";
  if (steps.size() > 1)
    out << steps.size() << " solves until nothing is in tension or overlaps"
        << (coarse > 0 ? ", and " + std::to_string(coarse) + " smaller ones for the second's start" : "") << "\n";
  else if (steps.empty() || steps[0]["active"] == report["mesh"]["multipliers"])
    out << "one solve: nothing is in tension, contact is closed everywhere\n";
  else
    out << "one solve: the active set of the start holds\n";
}

void print_extremes(const Json& extremes, std::ostream& out) {
  const Json &v = extremes["von_mises"], &principal = extremes["principal"];
  out << std::setprecision(6) << "  largest   displacement " << extremes["displacement"].get<double>() << "; von Mises "
      << v["value"].get<double>() << " in " << v["body"].get<std::string>() << " " << near(v["position"])
      << (v["limit"] ? "" : ", where it has no limit") << "; principal stresses "
      << principal["min"]["value"].get<double>() << " ... " << principal["max"]["value"].get<double>() << "\n";
}

void print_estimate(const Json& estimate, std::ostream& out) {
  if (estimate.is_null()) return;
  const Json& most = estimate["largest"];
  out << std::setprecision(2) << "  estimate  stresses off by " << percent(estimate["error"].get<double>())
      << " (energy norm), the most in " << most["body"].get<std::string>() << " " << near(most["position"]) << "\n"
      << std::setprecision(6);
}

// Whether a reader sees one place: a hundredth of what is left out about it is far more than round-off.
bool is_one_place(const Json& a, const Json& b) {
  const auto x = a["position"].get<std::array<double, 2>>(), y = b["position"].get<std::array<double, 2>>();
  return std::hypot(x[0] - y[0], x[1] - y[1]) <=
         0.01 * std::max(a["left_out"].get<double>(), b["left_out"].get<double>());
}

// Where p has no limit, and is left out of its norm: a place of several pairs once.
void print_left_out(const Json& singular, std::ostream& out) {
  std::vector<Json> points;
  for (const Json& point : singular)
    if (point["unbounded"] && std::ranges::none_of(points, [&](const Json& p) { return is_one_place(p, point); }))
      points.push_back(point);
  std::vector<std::string> places;
  for (const Json& point : points) places.push_back(near(point["position"]));
  if (places.empty()) return;
  out << "            left out where p has no limit, ";
  for (std::size_t i = 0; i < std::min<std::size_t>(places.size(), 3); ++i) out << (i == 0 ? "" : ", ") << places[i];
  if (places.size() > 3) out << " and " << places.size() - 3 << " more";
  out << "\n";
}

std::string goal_words(const std::string& of) {
  const std::map<std::string, std::string> words{
      {"pressure", "p"}, {"peak", "largest p"}, {"half_width", "half-width of contact"}, {"mean", "mean p"}};
  const auto found = words.find(of);
  return found == words.end() ? of : found->second;
}

// "mean p 1.2e6", "displacement (1e-3, 2e-3)"
void print_goal(const std::string& of, const Json& value, std::ostream& out) {
  out << goal_words(of);
  if (value.is_null()) return;
  out << std::setprecision(6) << (value.size() > 1 ? " (" : " ");
  for (std::size_t i = 0; i < value.size(); ++i) out << (i == 0 ? "" : ", ") << value[i].get<double>();
  out << (value.size() > 1 ? ")" : "") << std::setprecision(2);
}

void print_asked(const Json& accuracy, double found, std::ostream& out) {
  const std::size_t solves = accuracy["solves"].size();
  out << " (asked " << percent(accuracy["asked"].get<double>()) << "): ";
  out << (solves == 1 ? "1 solve, which no second confirms" : std::to_string(solves) + " solves");
  if (accuracy["of"] == "half_width" && found == 0) out << "; contact ends nowhere within a line";
  if (!accuracy["reached"])
    out << "; not reached: " << accuracy["reason"].get<std::string>()
        << "; largest part: " << accuracy["largest"].get<std::string>();
}

// What p is within, and what was asked.
void print_accuracy(const Json& report, std::ostream& out) {
  const Json& accuracy = report["accuracy"];
  if (report["estimate"].is_null()) return;
  const Json& pressure = report["estimate"]["pressure"];  // null: nothing is pressed
  const bool asked = !accuracy.is_null();
  double found = std::numeric_limits<double>::quiet_NaN();
  if (asked)
    found = accuracy["solves"][accuracy["answer"].get<std::size_t>() - 1]["estimated"].get<double>();
  else if (!pressure.is_null())
    found = pressure["error"].get<double>();
  if (!asked && !std::isfinite(found)) return;
  const std::string of = asked ? accuracy["of"].get<std::string>() : "pressure";
  out << std::setprecision(2) << "  accuracy  ";
  print_goal(of, asked && std::isfinite(found) ? accuracy["value"] : Json(), out);
  if (pressure.is_null() && goal_words(of) != of)
    out << " is 0, as contact carries nothing";
  else if (std::isfinite(found))
    out << " within " << percent(found);
  else
    out << " not known";
  if (asked) print_asked(accuracy, found, out);
  out << "\n";
  if (of == "pressure" && !pressure.is_null()) print_left_out(pressure["singular"], out);
  out << std::setprecision(6);
}

// Those that fail; summary.json has all.
void print_checks(const Json& checks, std::ostream& out) {
  const auto hold = std::ranges::count_if(checks, [](const Json& c) { return c["ok"].get<bool>(); });
  const auto balance = std::ranges::find_if(checks, [](const Json& c) { return c["name"] == balance_check; });
  out << std::setprecision(2) << "  checks    " << hold << " of " << checks.size()
      << " hold; reactions and loads sum to " << (*balance)["value"].get<double>() << " (relative)\n";
  for (const Json& c : checks)
    if (!c["ok"])
      out << "  FAILED    " << c["name"].get<std::string>() << ": " << c["value"].get<double>() << " (limit "
          << c["limit"].get<double>() << ")" << (c.contains("where") ? "; " + c["where"].get<std::string>() : "")
          << "\n";
}

// "contact.0.pressure.max 2145.1: 0.098 % off 2143, 1 % allowed (Johnson 1985)"
void print_expected(const Json& expected, std::ostream& out) {
  for (const Json& e : expected) {
    const double found = e["found"].get<double>(), off = e["off"].get<double>();
    out << "  expected  " << printable(e["figure"]) << std::setprecision(6);
    if (std::isfinite(found)) out << " " << found;
    out << ": " << std::setprecision(2);
    if (std::isfinite(off))
      out << percent(off) << " off ";
    else
      out << "not known; ";
    out << std::setprecision(6);
    if (e["value"].is_number())
      out << e["value"].get<double>();
    else
      out << printable(e["value"]);
    out << std::setprecision(2) << ", " << percent(e["tolerance"].get<double>()) << " allowed";
    if (e["source"] != "") out << " (" << printable(e["source"]) << ")";
    out << "\n";
  }
}

void print_warnings(const Json& warnings, std::ostream& out) {
  constexpr std::size_t most = 5;
  for (std::size_t i = 0; i < std::min(warnings.size(), most); ++i)
    out << "  warning   " << warnings[i].get<std::string>() << "\n";
  if (warnings.size() > most) out << "  warning   " << warnings.size() - most << " more in summary.json\n";
}

void print_seconds(const Json& report, std::ostream& out) {
  out << std::fixed << std::setprecision(3) << "  seconds   ";
  for (const auto& [stage, seconds] : report["seconds"].items())
    out << (stage == "mesh"    ? ""
            : stage == "total" ? "; "
                               : ", ")
        << stage << " " << seconds.get<double>() << (stage == "mesh" && report["mesh"]["cached"] ? " (cached)" : "");
  out << "\n";
}

}  // namespace

std::string report_text(const Json& r, const std::filesystem::path& folder) {
  std::ostringstream out;
  const Json& mesh = r["mesh"];
  out << printable(r["title"]) << "\n";
  out << "  " << r["status"].get<std::string>() << "; results in " << folder.string() << "/"
      << (std::filesystem::exists(folder / "result.vtu") ? " (result.vtu opens in ParaView)\n" : "\n");
  out << "  mesh      " << mesh["nodes"] << " nodes, " << mesh["elements"] << " elements; " << mesh["dofs"]
      << " unknowns, " << mesh["multipliers"] << " multipliers\n";
  out << std::setprecision(6) << model_text(r["model"]);
  out << contact_text(r);
  out << std::setprecision(3);
  print_iteration(r, out);
  print_steps(r["contact_steps"], out);
  print_contact_search(r, out);
  print_extremes(r["extremes"], out);
  out << "  energy    " << r["energy"].get<double>() << "\n";
  print_estimate(r["estimate"], out);
  print_accuracy(r, out);
  if (r["probes"] != 0) out << "  probes    " << r["probes"] << " places in probes.csv\n";
  if (!r["inf_sup"].is_null())
    out << "  inf-sup   " << r["inf_sup"].get<double>() << ", worst " << near(r["inf_sup_position"]) << " (limit "
        << inf_sup_limit << ")\n";
  if (r.contains("expected")) print_expected(r["expected"], out);
  print_checks(r["checks"], out);
  print_warnings(r["warnings"], out);
  print_seconds(r, out);
  return out.str();
}

}  // namespace mortise
