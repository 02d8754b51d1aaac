#include "results/expected.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "results/checks.hpp"
#include "results/report.hpp"

namespace mortise {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

std::string number(double value) { return Field(value).words(); }

// NaN if there is none.
double number_at(const Json& report, const std::string& dotted) try {
  std::string path = "/" + dotted;
  std::ranges::replace(path, '.', '/');
  const Json::json_pointer pointer(path);
  return report.contains(pointer) && report[pointer].is_number() ? report[pointer].get<double>() : unknown;
} catch (const Json::exception&) {  // no key: a ~, an index beyond all
  return unknown;
}

// summary.json, its pairs by their numbers (contact_numbers), and the rows of probes.csv as probe.0, probe.1, ...
Json named_figures(const Results& r) {
  Json report = report_of(r);
  Json pairs = Json::array();
  for (const Json& pair : report["contact"]) pairs[pair["number"].get<std::size_t>()] = pair;
  report["contact"] = pairs;
  for (const ProbeValue& value : r.recovery.probes) {
    Json& row = report["probe"].emplace_back();
    for (const auto& [name, number] : probe_figures(value)) row[name] = number;
  }
  return report;
}

ExpectedFigure compare_figure(const Json& report, const Expectation& e) {
  ExpectedFigure found{e, e.figure, number_at(report, e.figure), unknown, {}};
  if (std::isnan(found.found)) {
    found.trouble =
        "summary.json has no such number; expected a dotted key such as contact.0.pressure.max, or probe.0.u_y";
    return found;
  }
  const double value = e.value.constant();
  found.off = std::abs(found.found - value) / std::abs(value);
  found.trouble = "found " + number(found.found) + ", expected " + number(value);
  return found;
}

// Whether p has a limit at a node, as far as that is known.
bool counts(const Results& r, int pair, const ContactNode& node) {
  if (node.on_multiplier.edge < 0 || (std::isnan(node.gap) && node.p == 0)) return false;
  if (!r.estimate) return true;
  return !r.estimate->pressures[pair].excluded[node.on_multiplier.edge + (node.on_multiplier.xi > 0)];
}

ExpectedFigure compare_pressure(const Results& r, const Expectation& e) {
  ExpectedFigure found{e, "pressure of pair " + std::to_string(e.pair), unknown, unknown, {}};
  if (e.pair >= int(r.recovery.contacts.size())) {
    found.trouble = "the scene has " + std::to_string(r.recovery.contacts.size()) + " pairs, from 0";
    return found;
  }
  double off = 0, largest_value = 0;
  const ContactNode* worst = nullptr;
  for (const ContactNode& node : r.recovery.contacts[e.pair].multiplier.nodes) {
    if (!counts(r, e.pair, node)) continue;
    const double value = e.value(node.position, node.s), difference = std::abs(node.p - value);
    largest_value = std::max(largest_value, std::abs(value));
    if (worst && (difference <= off || std::isnan(off))) continue;
    off = difference;
    worst = &node;
  }
  if (!worst) {
    found.trouble = "no node of it faces the other side";
    return found;
  }
  found.off = off / largest_value;
  found.trouble = "found " + number(worst->p) + ", expected " + number(e.value(worst->position, worst->s)) + " near (" +
                  number(worst->position.x()) + ", " + number(worst->position.y()) + ")";
  return found;
}

ExpectedFigure compare(const Results& r, const Json& report, const Expectation& e) try {
  return e.figure.empty() ? compare_pressure(r, e) : compare_figure(report, e);
} catch (const SceneError& error) {  // an expression without a value somewhere
  return {e, "pressure of pair " + std::to_string(e.pair), unknown, unknown, error.what()};
}

}  // namespace

void judge_expectations(Results& r) {
  if (r.problem.expectations.empty()) return;
  const Json report = named_figures(r);
  for (const Expectation& e : r.problem.expectations) {
    r.expected.push_back(compare(r, report, e));
    const ExpectedFigure& found = r.expected.back();
    r.checks.push_back({found.name + " as expected", found.off, e.tolerance, found.trouble});
  }
  r.status = std::max(r.status, verdict(r));
}

}  // namespace mortise
