#include "results/slides_across_jumps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "contact/curvature_jumps.hpp"

namespace mortise {
namespace {

// A jump that loaded places feel.
struct Felt {
  Vec2 position, along;   // on the multiplier side, and its direction there
  double amplitude;       // A, stress, with its sign
  double before, behind;  // how far contact is closed on both sides
  double slid;
  double square = 0;  // of what it makes p off by, where it makes the most

  // At a place that stands for a length: next to the jump the mean of it.
  double off_at(const Vec2& place, double length) const {
    const double at = (place - position).dot(along), away = std::max(std::abs(at), length / std::numbers::e);
    if (at <= -before || at >= behind || away >= std::max(before, behind)) return 0;
    const double a = (before + behind) / 2, jump = (before - behind) / 2, x = jump + at;
    const double root = std::sqrt((a - x) * (a + x) * before * behind);
    return amplitude * std::log((a * a - jump * x + root) / (a * away));
  }
};

// How far contact goes on from a place by 1 or -1, up to `most`: a closed curve goes on behind its last place.
double closed_length(const std::vector<PlaceMotion>& places, std::size_t from, int step, double most) {
  double length = 0;
  const std::size_t count = places.size();
  for (std::size_t i = from, left = count - 1; left > 0 && length < most; --left) {
    const PlaceMotion& last = places[i];
    i = (i + count + std::size_t(step)) % count;
    if (places[i].patch != last.patch || (places[i].position - last.position).norm() > places[i].ds + last.ds) break;
    length += places[i].ds;
  }
  return std::min(length, most);
}

// Adds those of one side that lie in contact, or next to it by what the sides slide.
void add_felt(const ContactPair& pair, const std::vector<PlaceMotion>& places, const std::vector<CurvatureJump>& jumps,
              bool opposite, double modulus, std::vector<Felt>& felt) {
  const ContactLine& line = opposite ? *pair.geometry.opposite : *pair.geometry.multiplier;
  const Curve& curve = opposite ? pair.opposite : pair.multiplier;
  for (const CurvatureJump& jump : jumps) {
    const LinePoint on = line.at(jump.edge, jump.xi);
    const Vec2& at = on.position;
    const auto away = [&](const PlaceMotion& place) {
      return ((opposite ? place.facing : place.position) - at).norm();
    };
    const auto nearest =
        std::ranges::min_element(places, [&](const auto& a, const auto& b) { return away(a) < away(b); });
    const double slid = std::abs(nearest->slid);
    if (away(*nearest) > std::max(slid, nearest->ds)) continue;
    const auto i = std::size_t(nearest - places.begin());
    const double thickness =
        curve.thickness.empty() ? std::numeric_limits<double>::infinity() : curve.thickness[jump.edge];
    const double side = opposite ? -1 : 1;
    felt.push_back({.position = nearest->position + (at - (opposite ? nearest->facing : nearest->position)),
                    .along = side * on.tangent.normalized(),
                    .amplitude = -side * modulus * jump.jump * nearest->slid / (2 * std::numbers::pi),
                    .before = std::max(slid, closed_length(places, i, -1, thickness)),
                    .behind = std::max(slid, closed_length(places, i, 1, thickness)),
                    .slid = slid});
  }
}

// What p is off by at a place; the jump that makes the most of it.
std::pair<double, Felt*> off_at(const PlaceMotion& place, std::vector<Felt>& felt) {
  double sum = 0, most = 0;
  Felt* of = nullptr;
  for (Felt& jump : felt) {
    const double part = jump.off_at(place.position, place.ds);
    sum += part;
    if (std::abs(part) <= most) continue;
    most = std::abs(part);
    of = &jump;
  }
  return {std::abs(sum), of};
}

}  // namespace

std::optional<SlideAcrossJump> slide_across_jumps(const Points& nodes, const ContactPair& pair,
                                                  const std::vector<PlaceMotion>& places, double modulus) {
  if (places.empty() || !is_drawn(pair) || pair.geometry.given) return {};
  std::vector<Felt> felt;
  add_felt(pair, places, curvature_jumps(nodes, pair.multiplier, *pair.geometry.multiplier), false, modulus, felt);
  add_felt(pair, places, curvature_jumps(nodes, pair.opposite, *pair.geometry.opposite), true, modulus, felt);
  // Contact does not pull: p that is lost is no more than there is, and stands elsewhere, as the force is what it was.
  const double most =
      pair.spec.condition == Condition::unilateral ? std::numbers::sqrt2 : std::numeric_limits<double>::infinity();
  double off = 0, whole = 0;
  for (const PlaceMotion& place : places) {
    whole += place.p * place.p * place.dA;
    const auto [by, of] = off_at(place, felt);
    if (!of) continue;
    const double square = std::pow(std::min(by, most * place.p), 2) * place.dA;
    off += square;
    of->square += square;
  }
  const auto worst = std::ranges::max_element(felt, {}, &Felt::square);
  if (!(off > 0)) return {};
  return SlideAcrossJump{std::sqrt(off / whole), worst->position, worst->slid};
}

}  // namespace mortise
