#include <algorithm>
#include <cmath>
#include <iomanip>
#include <map>
#include <sstream>

#include "base/printable.hpp"
#include "results/report_text.hpp"

namespace mortise {
namespace {

double norm(const Json& v) { return std::hypot(v[0].get<double>(), v[1].get<double>()); }

std::string name_of(const Json& contact) {
  return contact["between"][0].get<std::string>() + " - " + contact["between"][1].get<std::string>();
}

// " within 1.2 %", of a force that equilibrium does not give; of one that is less than its bar this as a force, and
// nothing where that is round-off of the pressures, which balance.
std::string force_within(const Json& contact) {
  constexpr double round_off = 1e-6;
  if (contact["force_error"].is_null()) return "";
  const double error = norm(contact["force_error"]), force = norm(contact["force"]),
               pressed = contact["pressure"]["mean"].get<double>() * contact["length"].get<double>();
  if (!(error > round_off * std::max(force, pressed))) return "";
  return " within " + (error < force ? percent(error / force) : worded(std::setprecision(2), error));
}

std::string length_within(const Json& contact) {
  const Json& error = contact["length_in_contact_error"];
  if (error.is_null() || !(error.get<double>() > 0)) return "";
  return worded(std::setprecision(2), " within ", error.get<double>());
}

std::string condition_and_gap(const Json& report, std::size_t k) {
  return report["method"]["condition"][k].get<std::string>() + ", gap " +
         report["contact"][k]["gap"].get<std::string>();
}

void print_force(const Json& force, std::ostream& out) {
  out << "force (" << force[0].get<double>() << ", " << force[1].get<double>() << ") on ";
}

void print_pair(const Json& report, std::size_t k, std::ostream& out) {
  const Json &c = report["contact"][k], &p = c["pressure"], &method = report["method"];
  const std::string on = method["multipliers_on"][k];
  out << "  contact   " << name_of(c) << ": " << condition_and_gap(report, k) << ", "
      << method["multipliers"].get<std::string>() << " multipliers on " << on << "\n            pressure "
      << p["min"].get<double>() << " ... " << p["max"].get<double>() << " (mean " << p["mean"].get<double>() << "), ";
  print_force(c["force"], out);
  out << on << force_within(c) << "\n            length " << c["length"].get<double>() << ", in contact "
      << c["length_in_contact"].get<double>() << length_within(c) << "; undeformed gap "
      << c["initial_gap"]["min"].get<double>() << " ... " << c["initial_gap"]["max"].get<double>() << "\n";
  if (const auto fluid = c.find("fluid"); fluid != c.end()) {
    out << "            fluid at " << (*fluid)["pressure"].get<double>() << " has wet "
        << (*fluid)["wet_length"].get<double>() << "; of the force it makes (" << (*fluid)["force"][0].get<double>()
        << ", " << (*fluid)["force"][1].get<double>() << ")\n";
  }
}

// "480 unilateral, gap closed; 20 bilateral, gap as drawn"
std::string kinds_of(const Json& report) {
  std::map<std::string, int> count;
  for (std::size_t k = 0; k < report["contact"].size(); ++k) ++count[condition_and_gap(report, k)];
  std::vector<std::string> kinds;
  for (const auto& [kind, number] : count) kinds.push_back(std::to_string(number) + " " + kind);
  return listed(kinds);
}

// The pair for which `value` is largest; NaN is no value.
template <typename Value>
std::size_t largest_pair(const Json& contacts, Value value) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < contacts.size(); ++k)
    if (value(contacts[k]) > value(contacts[best]) || std::isnan(value(contacts[best]))) best = k;
  return best;
}

void print_all(const Json& report, std::ostream& out) {
  const Json& all = report["contact"];
  const Json& low = all[largest_pair(all, [](const Json& c) { return -c["pressure"]["min"].get<double>(); })];
  const Json& high = all[largest_pair(all, [](const Json& c) { return c["pressure"]["max"].get<double>(); })];
  const std::size_t k = largest_pair(all, [](const Json& c) { return norm(c["force"]); });
  double length = 0, in_contact = 0, gap_min = all[0]["initial_gap"]["min"], gap_max = all[0]["initial_gap"]["max"];
  int open = 0;
  for (const Json& c : all) {
    length += c["length"].get<double>();
    in_contact += c["length_in_contact"].get<double>();
    open += c["length_in_contact"] == 0;
    gap_min = std::min(gap_min, c["initial_gap"]["min"].get<double>());
    gap_max = std::max(gap_max, c["initial_gap"]["max"].get<double>());
  }
  out << "  contact   " << all.size() << " pairs, " << report["method"]["multipliers"].get<std::string>()
      << " multipliers: " << kinds_of(report) << "\n            lowest pressure "
      << low["pressure"]["min"].get<double>() << " (" << name_of(low) << "), highest "
      << high["pressure"]["max"].get<double>() << " (" << name_of(high) << ")\n            largest ";
  print_force(all[k]["force"], out);
  out << report["method"]["multipliers_on"][k].get<std::string>() << " (" << name_of(all[k]) << ")\n            length "
      << length << ", in contact " << in_contact << "; " << open << " pairs open; undeformed gap " << gap_min << " ... "
      << gap_max << "\n";
  out << "            each pair: summary.json, contact.csv\n";
}

}  // namespace

std::string contact_text(const Json& report) {
  std::ostringstream out;
  const std::size_t count = report["contact"].size();
  if (count > told_in_full)
    print_all(report, out);
  else
    for (std::size_t k = 0; k < count; ++k) print_pair(report, k, out);
  return out.str();
}

}  // namespace mortise
