#include "fem/cell_cuts.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <queue>

#include "fem/elements.hpp"

namespace mortise {
namespace {

constexpr double linear_cell = 0.01, linear_piece = 0.05, small_piece = 1e-7, hidden_in_cell = 1. / 256;
constexpr std::size_t most_cell_pieces = 400;
constexpr int blind_splits = 6;  // 64 pieces where no range is known
constexpr int rule_side = 4, piece_points = rule_side * rule_side;

CellPoint cell_point(const Points& nodes, const Cell& cell, const Vec2& xi) {
  return cell_point(nodes, cell, cell_shape(cell.kind, xi));
}

Vec2 centre(const CellPiece& piece) {
  Vec2 sum = Vec2::Zero();
  for (int a = 0; a < piece.corners; ++a) sum += piece.at[a];
  return sum / piece.corners;
}

// Of side k: from corner k to the next. Half of a triangle has the corner opposite; of a rectangle two sides are cut.
std::array<CellPiece, 2> halves(const CellPiece& piece, int k) {
  const auto& c = piece.at;
  const int n = piece.corners;
  const Vec2 middle = (c[k] + c[(k + 1) % n]) / 2;
  const double part = piece.part / 2;
  if (n == 3) return {{{3, {c[k], middle, c[(k + 2) % 3]}, part}, {3, {middle, c[(k + 1) % 3], c[(k + 2) % 3]}, part}}};
  const Vec2 opposite = (c[(k + 2) % 4] + c[(k + 3) % 4]) / 2;
  return {{{4, {c[k], middle, opposite, c[(k + 3) % 4]}, part},
           {4, {middle, c[(k + 1) % 4], c[(k + 2) % 4], opposite}, part}}};
}

// A piece and how the fields vary on it: by more than linearly, and beyond what is seen of them.
struct Looked {
  CellPiece piece;
  double error = 0;     // largest of all fields and sides, part of the scale
  bool hidden = false;  // whether a range says that there is more
  int longest = 0;      // the side to cut
  bool operator<(const Looked& other) const { return error * piece.part < other.error * other.piece.part; }
};

class Looking {
 public:
  Looking(const Points& nodes, const Cell& cell, const std::vector<ScaledField>& fields)
      : nodes_(nodes), cell_(cell), fields_(fields) {}

  Looked look(const CellPiece& piece) const {
    const int n = piece.corners;
    const Places at = places(piece);
    Looked looked{piece};
    std::array<double, 4> bends{};
    for (const auto& [field, range_of, scale] : fields_) {
      std::array<double, 9> f;
      for (int a = 0; a < 2 * n + 1; ++a) f[a] = (*field)(at.x[a]);
      double mean = 0;
      for (int a = 0; a < n; ++a) {
        bends[a] = std::max(bends[a], std::abs(f[n + a] - (f[a] + f[(a + 1) % n]) / 2) / scale);
        mean += f[a] / n;
      }
      looked.error = std::max(looked.error, std::abs(f[2 * n] - mean) / scale);
      if (!range_of.known()) continue;
      const Interval range = range_of({{at.low.x(), at.high.x()}, {at.low.y(), at.high.y()}, {}});
      const auto [least, most] = std::minmax_element(f.begin(), f.begin() + 2 * n + 1);
      const double beyond =
          std::max(range.high - *most, *least - range.low) - (*most - *least) - hidden_in_cell * scale;
      if (!(beyond > 0)) continue;
      looked.hidden = true;
      looked.error = std::max(looked.error, std::min(beyond / scale, 1e6));
    }
    looked.error = std::max(looked.error, *std::max_element(bends.begin(), bends.end()));
    looked.longest = side_to_cut(at, n, bends);
    return looked;
  }

 private:
  // Corners, middles of sides, centre: within the piece, and on its outline; and a box that holds the piece.
  struct Places {
    std::array<Vec2, 9> x, drawn;
    Vec2 low, high;
  };

  Places places(const CellPiece& piece) const {
    constexpr double inwards = 0.02;  // values are not defined beyond a boundary, if they are so on it
    const int n = piece.corners;
    const Vec2 middle = centre(piece);
    Places at;
    at.x.fill(middle);
    at.drawn.fill(middle);
    for (int a = 0; a < 2 * n + 1; ++a) {
      const Vec2 xi = a < n       ? piece.at[a]
                      : a < 2 * n ? Vec2((piece.at[a - n] + piece.at[(a - n + 1) % n]) / 2)
                                  : middle;
      at.drawn[a] = cell_point(nodes_, cell_, xi).x;
      at.x[a] = cell_point(nodes_, cell_, (1 - inwards) * xi + inwards * middle).x;
    }
    at.low = at.high = at.drawn[0];
    for (int a = 0; a < n; ++a) {
      const Vec2 crossing = 2 * at.drawn[n + a] - (at.drawn[a] + at.drawn[(a + 1) % n]) / 2;  // as of along_edge
      at.low = at.low.cwiseMin(at.drawn[a]).cwiseMin(crossing);
      at.high = at.high.cwiseMax(at.drawn[a]).cwiseMax(crossing);
    }
    return at;
  }

  // The longest of the n sides along which a field bends at least half as much as on the worst.
  static int side_to_cut(const Places& at, int n, const std::array<double, 4>& bends) {
    const double most = *std::max_element(bends.begin(), bends.end());
    int longest = 0;
    double length = -1;
    for (int a = 0; a < n; ++a) {
      const double side = (at.drawn[(a + 1) % n] - at.drawn[a]).norm();
      if (bends[a] < 0.5 * most || side <= length) continue;
      length = side;
      longest = a;
    }
    return longest;
  }

  const Points& nodes_;
  const Cell& cell_;
  const std::vector<ScaledField>& fields_;
};

bool all_have_ranges(const std::vector<ScaledField>& fields) {
  return std::ranges::all_of(fields, [](const ScaledField& f) { return f.range.known(); });
}

}  // namespace

CellPiece whole_cell(CellKind kind) {
  if (corner_count(kind) == 3) return {3, {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1), Vec2(0, 0)}};
  return {4, {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)}};
}

std::vector<CellPiece> resolving_pieces(const Points& nodes, const Cell& cell, const std::vector<ScaledField>& fields) {
  const Looking looking(nodes, cell, fields);
  const Looked all = looking.look(whole_cell(cell.kind));
  const bool blind = !all_have_ranges(fields);
  if (!blind && !all.hidden && all.error <= linear_cell) return {};
  bool linear = all.error <= linear_cell;
  std::priority_queue<Looked> open;
  std::vector<CellPiece> settled;
  const auto add = [&](const CellPiece& piece) {
    const Looked looked = looking.look(piece);
    linear = linear && looked.error <= linear_cell;
    if (looked.hidden || looked.error > linear_piece)
      open.push(looked);
    else
      settled.push_back(piece);
  };
  std::vector<CellPiece> start{all.piece};
  for (int k = 0; blind && k < blind_splits; ++k) {
    std::vector<CellPiece> finer;
    for (const CellPiece& piece : start)
      for (const CellPiece& half : halves(piece, piece.corners == 3 ? 0 : k % 2)) finer.push_back(half);
    start = std::move(finer);
  }
  for (const CellPiece& piece : start) add(piece);
  if (blind && linear) return {};
  while (!open.empty() && open.size() + settled.size() < most_cell_pieces) {
    const Looked worst = open.top();
    if (std::min(worst.error, 1.0) * worst.piece.part < small_piece) break;
    open.pop();
    for (const CellPiece& half : halves(worst.piece, worst.longest)) add(half);
  }
  for (; !open.empty(); open.pop()) settled.push_back(open.top().piece);
  return settled;
}

CellRule piece_rule(const std::vector<CellPiece>& pieces) {
  static const ForEachKind<CellRule> rules = [] {
    ForEachKind<CellRule> of;
    for (const CellKind kind : all_cell_kinds) of[int(kind)] = product_rule(kind, rule_side);
    return of;
  }();
  CellRule all;
  for (const CellPiece& piece : pieces) {
    const CellRule& rule = rules[int(piece.corners == 3 ? CellKind::tri3 : CellKind::quad4)];
    const auto& c = piece.at;
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const Vec2& at = rule.points[q];
      all.points.push_back(piece.corners == 3
                               ? Vec2(c[0] + at.x() * (c[1] - c[0]) + at.y() * (c[2] - c[0]))
                               : Vec2(c[0] + (1 + at.x()) / 2 * (c[1] - c[0]) + (1 + at.y()) / 2 * (c[3] - c[0])));
      all.weights.push_back(piece.part * rule.weights[q]);
    }
  }
  return all;
}

CellMisfit misfit(const Points& nodes, const Cell& cell, const std::vector<CellPiece>& pieces, int degree,
                  const std::function<VecX(const Vec2&)>& values) {
  const CellRule rule = piece_rule(pieces);
  const Eigen::Index count = Eigen::Index(rule.points.size());
  MatX f, terms(count, degree == 1 ? 3 : 6);  // a row a point
  VecX dA(count);
  Points x(count, 2);
  for (Eigen::Index q = 0; q < count; ++q) {
    const CellPoint point = cell_point(nodes, cell, rule.points[q]);
    const VecX here = values(point.x);
    if (q == 0) f.resize(count, here.size());
    f.row(q) = here;
    x.row(q) = point.x;
    dA(q) = rule.weights[q] * point.jacobian();
    const double xi = rule.points[q].x(), eta = rule.points[q].y();
    terms.row(q).head<3>() << 1, xi, eta;
    if (degree == 2) terms.row(q).tail<3>() << xi * xi, xi * eta, eta * eta;
  }
  const MatX weighted = dA.asDiagonal() * terms;
  const MatX rest = f - terms * (terms.transpose() * weighted).llt().solve(weighted.transpose() * f);
  const double area = dA.sum();
  const VecX squares = rest.rowwise().squaredNorm();
  const double all = dA.dot(squares);
  Eigen::Index worst = 0;
  squares.maxCoeff(&worst);
  CellMisfit found{.root_mean_square = std::sqrt(all / area),
                   .mean = dA.dot(squares.cwiseSqrt()) / area,
                   .at = x.row(worst),
                   .finest = std::sqrt(area)};
  for (std::size_t p = 0; p < pieces.size(); ++p)
    if (dA.segment(piece_points * Eigen::Index(p), piece_points)
            .dot(squares.segment(piece_points * Eigen::Index(p), piece_points)) > 0.01 * all)
      found.finest = std::min(found.finest, std::sqrt(pieces[p].part * area));
  return found;
}

}  // namespace mortise
