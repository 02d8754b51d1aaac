#include "solve/known_loads.hpp"

#include <limits>

namespace mortise {
namespace {

// Three vectors each: together less than the factor of a body has for each unknown.
constexpr std::size_t most_known = 16;

// Of a load, what the rounding of each entry leaves of a sum of others.
constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
// What parts may be larger than their sum: a digit is lost.
constexpr double most_cancelled = 8;

VecX unloaded(const SplitCholesky& factor, const VecX& y) { return factor.backward(y, VecX::Zero(factor.rows())); }

}  // namespace

LoadResponse respond(const SplitCholesky& factor, const VecX& load, bool with_u) {
  LoadResponse response{.at_border = {}, .y = factor.forward(load), .u = {}};
  response.at_border = factor.at_border(response.y);
  if (with_u) response.u = unloaded(factor, response.y);
  return response;
}

VecX LoadResponse::with(SplitCholesky& factor, const VecX& lambda) const {
  return y.size() > 0 || u.size() == 0 ? VecX(factor.backward(y, lambda)) : VecX(u + factor.at_rows(lambda));
}

// Of each known load, the last of which may be what is left of this one; none where it is no sum of them.
std::vector<double> KnownLoads::parts(const SplitCholesky& factor, const VecX& load) {
  std::vector<double> parts;
  VecX rest = load;
  for (const Known& known : known_) {
    parts.push_back(known.load.dot(rest) / known.load.squaredNorm());
    rest -= parts.back() * known.load;
  }
  if (!known_.empty() && rest.norm() <= rounding * load.norm()) return parts;
  if (known_.size() == most_known || !(rest.squaredNorm() > 0)) return {};
  Known& known = known_.emplace_back(Known{.load = std::move(rest), .y = {}, .at_border = {}, .u = {}});
  known.y = factor.forward(known.load);
  known.at_border = factor.at_border(known.y);
  parts.push_back(1);
  return parts;
}

LoadResponse KnownLoads::respond(const SplitCholesky& factor, const VecX& load, bool with_u) {
  const bool first = known_.empty();
  const std::vector<double> part = parts(factor, load);
  if (part.empty()) return mortise::respond(factor, load, with_u);
  const auto find_u = [&](Known& known) {
    if (known.u.size() == 0) known.u = unloaded(factor, known.y);
  };
  if (first) {
    if (with_u) find_u(known_[0]);
    return {.at_border = known_[0].at_border, .y = known_[0].y, .u = known_[0].u};
  }
  LoadResponse sum{.at_border = VecX::Zero(factor.rows()), .y = {}, .u = VecX::Zero(load.size())};
  double sizes = 0, border_sizes = 0;
  for (std::size_t k = 0; k < part.size(); ++k) {
    find_u(known_[k]);
    sum.u += part[k] * known_[k].u;
    sum.at_border += part[k] * known_[k].at_border;
    sizes += std::abs(part[k]) * largest_entry(known_[k].u);
    border_sizes += std::abs(part[k]) * largest_entry(known_[k].at_border);
  }
  const bool cancelled =
      sizes > most_cancelled * largest_entry(sum.u) || border_sizes > most_cancelled * largest_entry(sum.at_border);
  return cancelled ? mortise::respond(factor, load, with_u) : sum;
}

}  // namespace mortise
