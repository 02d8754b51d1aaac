#include "app/sweep_plan.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>

#include "base/errors.hpp"

namespace mortise {
namespace {

constexpr std::size_t group_size = 4;
/// Of one sweep: with a hundredth of a second each a quarter of an hour, and each row is kept in memory.
constexpr std::size_t most_runs = 100000;

}  // namespace

Variation parse_variation(const std::string& text) {
  if (text.find('=') == std::string::npos || text.front() == '=')
    throw InputError("--vary '" + text + "': expected KEY=VALUE1,VALUE2,... such as mesh.parameters.n_upper=20,40,80");
  const Override split = parse_override(text);
  Variation variation{split.key, {}};
  std::stringstream values(split.value);
  for (std::string value; std::getline(values, value, ',');) variation.values.push_back(value);
  if (variation.values.empty())
    throw InputError("--vary " + text +
                     ": no value; expected KEY=VALUE1,VALUE2,... such as "
                     "mesh.parameters.n_upper=20,40,80");
  return variation;
}

SweepPlan plan_sweep(const std::string& scene, const std::vector<Override>& overrides,
                     const std::vector<Variation>& variations, bool diagnosed) {
  SweepPlan plan{scene, overrides, {}, {{}}, diagnosed};
  for (const Variation& v : variations) {
    plan.keys.push_back(v.key);
    if (v.values.size() > most_runs / plan.values.size())
      throw InputError("--vary " + v.key + ": the values combine to more than " + std::to_string(most_runs) +
                       " runs; expected fewer, or several sweeps");
    std::vector<std::vector<std::string>> longer;
    for (const std::vector<std::string>& values : plan.values)
      for (const std::string& value : v.values) {
        longer.push_back(values);
        longer.back().push_back(value);
      }
    plan.values = std::move(longer);
  }
  return plan;
}

SweepPart parse_part(const std::string& text) {
  SweepPart part;
  const char* const end = text.data() + text.size();
  const auto [slash, error] = std::from_chars(text.data(), end, part.part);
  const bool two = error == std::errc() && slash != end && *slash == '/';
  const auto [rest, second] = std::from_chars(two ? slash + 1 : end, end, part.of);
  if (!two || second != std::errc() || rest != end || part.part < 1 || part.part > part.of || part.of > 10000)
    throw InputError("--part '" + text + "': expected K/N with 1 <= K <= N <= 10000, such as 2/8");
  return part;
}

std::filesystem::path table_of(const std::filesystem::path& csv, const SweepPart& part) {
  if (part.of == 1) return csv;
  std::filesystem::path table = csv;
  return table.replace_extension("." + std::to_string(part.part) + "_of_" + std::to_string(part.of) +
                                 csv.extension().string());
}

std::vector<Override> SweepPlan::overrides_of(std::size_t run) const {
  std::vector<Override> all = overrides;
  for (std::size_t k = 0; k < keys.size(); ++k) all.push_back({keys[k], values[run][k]});
  return all;
}

Range groups_of(const SweepPlan& plan, const SweepPart& part) {
  const std::size_t count = (plan.values.size() + group_size - 1) / group_size;
  return {(part.part - 1) * count / part.of, part.part * count / part.of};
}

Range runs_of_group(const SweepPlan& plan, std::size_t group) {
  return {group * group_size, std::min((group + 1) * group_size, plan.values.size())};
}

std::size_t group_of(std::size_t run) { return run / group_size; }

Range runs_of(const SweepPlan& plan, const SweepPart& part) {
  const auto [first, last] = groups_of(plan, part);
  return {first * group_size, std::min(last * group_size, plan.values.size())};
}

// Its columns end with "status", or go on with the figures. No scene, geometry or mesh begins so.
bool is_sweep_table(const std::string& header) {
  return header.ends_with(",status") || header.find(",status,nodes,elements,dofs,") != std::string::npos;
}

}  // namespace mortise
