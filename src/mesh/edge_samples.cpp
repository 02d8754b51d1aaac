#include "mesh/edge_samples.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace mortise {
namespace {

constexpr int degree = std::tuple_size_v<decltype(SamplePiece::places)> - 1;
constexpr int fine = 2 * degree;  // a piece is looked at halfway between its places too

// Of the length of an edge: a gap of it strains the bodies by this, which nobody can measure.
constexpr double resolved_part = 1e-13;
// A place is a sum of products of coordinates, in each of which round-off is at most a few times this.
constexpr double round_off = 64 * std::numeric_limits<double>::epsilon();
// Parts of a curve's parameter, in halvings, that tell its noise: a smooth curve's misfit falls to nothing from one to
// the next, a knot's to 1/16 and less; what stays is noise of the places. The short ones alone do not tell it: of a
// circle of a large radius they are shorter than round-off of its centre, and all their places one.
constexpr std::array<int, 4> part_depths{6, 10, 14, 18};
// Parts of each length, and which of them, in the order of their misfits, is taken: knots lie in a few.
constexpr int part_count = 32, taken_part = 24;
// The noise of a polynomial of degree 8 between Chebyshev's points is at most 2.4 times theirs (Lebesgue's constant);
// it is in the place that is compared, too.
constexpr double noise_between = 3.4;
// Halving the parameter so many times meets its own round-off.
constexpr int deepest = 44;

// Chebyshev points of `count` intervals between -1 and 1.
double chebyshev(int k, int count) { return -std::cos(std::numbers::pi * k / count); }

// Row i: the weights of the places in the value of their polynomial halfway between places i and i + 1.
using Between = Eigen::Matrix<double, degree, degree + 1>;
const Between& between() {
  static const Between weights = [] {
    Between rows;
    for (int i = 0; i < degree; ++i)
      for (int k = 0; k <= degree; ++k) {
        rows(i, k) = 1;
        for (int m = 0; m <= degree; ++m)
          if (m != k)
            rows(i, k) *=
                (chebyshev(2 * i + 1, fine) - chebyshev(m, degree)) / (chebyshev(k, degree) - chebyshev(m, degree));
      }
    return rows;
  }();
  return weights;
}

// A part of an edge as the polynomial through its places has it.
struct Part {
  double begin, end;
  SamplePiece piece;
  double misfit;
};

Part part_of(double begin, double end, const Vec2* places) {
  Part part{begin, end, {end, {}}, 0};
  Eigen::Matrix<double, degree + 1, 2> at;
  for (int k = 0; k <= degree; ++k) {
    part.piece.places[k] = places[2 * k];
    at.row(k) = (places[2 * k] - places[0]).transpose();
  }
  const Eigen::Matrix<double, degree, 2> found = between() * at;
  for (int i = 0; i < degree; ++i)
    part.misfit = std::max(part.misfit, (places[2 * i + 1] - places[0] - found.row(i).transpose()).norm());
  return part;
}

// Of the edge whose ends have these parameters.
Part part_of(const CurvePlaces& curve, const std::array<double, 2>& ends, double begin, double end) {
  std::vector<double> t;
  for (int k = 0; k <= fine; ++k) {
    const double xi = (begin + end) / 2 + (end - begin) / 2 * chebyshev(k, fine);
    t.push_back(((1 - xi) * ends[0] + (1 + xi) * ends[1]) / 2);
  }
  return part_of(begin, end, curve(t).data());
}

// Of the places of a curve between two parameters, length, as misfits show it: of all of it, as an edge may be so short
// that it has one place. A circle of a large radius has more of it than the coordinates of its places tell.
class Noise {
 public:
  Noise(const CurvePlaces& curve, const std::array<double, 2>& ends) : curve_(curve), ends_(ends) {}

  double operator()() {
    if (!found_) found_ = look();
    return *found_;
  }

 private:
  double look() const {
    double before = misfit_of_parts(part_depths[0]);
    for (std::size_t i = 1; i < part_depths.size(); ++i) {
      const double after = misfit_of_parts(part_depths[i]);
      if (after > before / 2) return std::max(before, after);
      before = after;
    }
    return before;
  }

  double misfit_of_parts(int depth) const {
    const double length = std::ldexp(2.0, -depth);
    std::array<double, part_count> found;
    for (int i = 0; i < part_count; ++i) {
      const double at = std::fmod((i + 0.5) * std::numbers::phi, 1.0);  // no places that are likely knots
      const double begin = -1 + (2 - length) * at;
      found[i] = part_of(curve_, ends_, begin, begin + length).misfit;
    }
    std::ranges::sort(found);
    return found[taken_part - 1];
  }

  const CurvePlaces& curve_;
  const std::array<double, 2> ends_;
  std::optional<double> found_;
};

// One edge of a curve.
class EdgeSampler {
 public:
  EdgeSampler(const CurvePlaces& curve, const std::array<double, 2>& ends, Noise& noise)
      : curve_(curve), ends_(ends), noise_(noise) {}

  // `whole`: the edge's places at the finer points.
  EdgeSamples sample(const Vec2* whole) {
    const Part part = mortise::part_of(-1, 1, whole);
    double size = 0, farthest = 0;
    for (int k = 0; k <= fine; ++k) {
      size += k > 0 ? (whole[k] - whole[k - 1]).norm() : 0;
      farthest = std::max(farthest, whole[k].cwiseAbs().maxCoeff());
    }
    resolved_ = std::max(resolved_part * size, round_off * farthest);
    if (part.misfit > resolved_) resolved_ = std::max(resolved_, noise_between * noise_());
    if (part.misfit > resolved_) {
      bisect(part);
      merge();
    } else {
      parts_.push_back(part);
    }
    EdgeSamples samples;
    for (const Part& p : parts_) {
      samples.pieces.push_back(p.piece);
      samples.misfit = std::max(samples.misfit, p.misfit);
    }
    return samples;
  }

 private:
  Part part_of(double begin, double end) const { return mortise::part_of(curve_, ends_, begin, end); }

  // Level by level, so that noise is known by what it does: it is in all parts and does not fall, where knots are in a
  // few parts, and four halvings take a kink to 1/16, a jump of curvature to 1/256. (One knot says nothing: near an end
  // of its part it is seen no better in a part of that.)
  void bisect(const Part& whole) {
    constexpr std::size_t many = 64;
    std::vector<Part> open{whole};
    std::vector<double> worst;  // of each level
    while (!open.empty()) {
      worst.push_back(std::ranges::max_element(open, {}, &Part::misfit)->misfit);
      const std::size_t depth = worst.size() - 1;
      if (depth == deepest) break;
      if (open.size() > many && worst[depth] > worst[depth - 4] / 2) {
        resolved_ = std::max(resolved_, worst[depth]);  // parts say no more than what they are merged to
        break;
      }
      std::vector<Part> next;
      for (const Part& part : open) {
        const double middle = (part.begin + part.end) / 2;
        for (Part half : {part_of(part.begin, middle), part_of(middle, part.end)})
          (half.misfit > resolved_ ? next : parts_).push_back(std::move(half));
      }
      open = std::move(next);
    }
    parts_.insert(parts_.end(), open.begin(), open.end());
    std::ranges::sort(parts_, {}, &Part::begin);
  }

  // From each part the longest one that is resolved, by doubling how many it takes, then by halving what was too much.
  void merge() {
    std::vector<Part> merged;
    const std::size_t count = parts_.size();
    for (std::size_t first = 0; first < count;) {
      Part longest = parts_[first];
      std::size_t last = first, step = 1;
      const auto take = [&](std::size_t to) {
        const Part part = part_of(parts_[first].begin, parts_[to].end);
        if (part.misfit > resolved_) return false;
        longest = part;
        last = to;
        return true;
      };
      while (last + step < count && take(last + step)) step *= 2;
      for (step /= 2; step > 0; step /= 2)
        if (last + step < count) take(last + step);
      merged.push_back(longest);
      first = last + 1;
    }
    parts_ = std::move(merged);
  }

  const CurvePlaces& curve_;
  const std::array<double, 2>& ends_;
  Noise& noise_;
  double resolved_ = 0;
  std::vector<Part> parts_;
};

}  // namespace

EdgeSamples reversed(const EdgeSamples& samples) {
  EdgeSamples turned{{}, samples.misfit};
  for (std::size_t i = samples.pieces.size(); i-- > 0;) {
    turned.pieces.push_back({i > 0 ? -samples.pieces[i - 1].end : 1, samples.pieces[i].places});
    std::ranges::reverse(turned.pieces.back().places);
  }
  return turned;
}

std::vector<EdgeSamples> sample_edges(const CurvePlaces& curve, const std::vector<std::array<double, 2>>& ends) {
  std::vector<double> t;
  for (const auto& [start, end] : ends)
    for (int k = 0; k <= fine; ++k) t.push_back((start + end) / 2 + (end - start) / 2 * chebyshev(k, fine));
  const std::vector<Vec2> places = curve(t);
  const auto [first, last] = std::ranges::minmax(t);
  Noise noise(curve, {first, last});
  std::vector<EdgeSamples> samples;
  for (std::size_t e = 0; e < ends.size(); ++e)
    samples.push_back(EdgeSampler(curve, ends[e], noise).sample(&places[e * (fine + 1)]));
  return samples;
}

std::vector<EdgeSamples> sample_straight_edges(const CurvePlaces& curve,
                                               const std::vector<std::array<double, 2>>& ends) {
  std::vector<double> t;
  for (const auto& edge : ends) t.insert(t.end(), edge.begin(), edge.end());
  const std::vector<Vec2> places = curve(t);
  std::vector<EdgeSamples> samples;
  for (std::size_t e = 0; e < ends.size(); ++e) {
    SamplePiece piece{1, {}};
    for (int k = 0; k <= degree; ++k) {
      const double part = (1 + chebyshev(k, degree)) / 2;
      piece.places[k] = (1 - part) * places[2 * e] + part * places[2 * e + 1];
    }
    samples.push_back({{piece}});
  }
  return samples;
}

}  // namespace mortise
