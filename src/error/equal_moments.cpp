#include "error/equal_moments.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "contact/multiplier_space.hpp"
#include "error/goal_estimate.hpp"
#include "fem/edges.hpp"
#include "fem/quadrature.hpp"

namespace mortise {
namespace {

constexpr int least_edges = 4;         // of a piece: a cubic has as many coefficients
constexpr double border_place = 0.35;  // edges: the multiplier's own border is a vertex, so p_h is off by as much

// An edge of the line as p* sees it.
struct EdgeData {
  double from = 0, to = 1;    // the part that faces the other side; from = to: none that p* can use
  double start = 0, end = 0;  // int p_h phi depth ds of its vertices' hats
  bool joined = false;        // its two multipliers share a row
  bool is_usable() const { return to > from; }
  bool is_whole() const { return from == 0 && to == 1; }
};

// `before`, `after`: whether the edges beside it are faced.
void find_faced_part(double part, bool before, bool after, EdgeData& edge) {
  constexpr double round_off = 1e-6;
  if (part > 1 - round_off) return;
  edge.from = after && !before ? 1 - part : 0;
  edge.to = before && !after ? part : 1;
  if (before == after || part < round_off) edge.from = edge.to = 0;
}

std::vector<EdgeData> edge_data(const ContactPair& pair, Multipliers space, const Model& model,
                                const PressureLine& line) {
  static const LineRule rule = gauss_legendre(5);
  const Eigen::Index count = line.p.size() - 1;
  std::vector<EdgeData> edges(count);
  VecX faced = VecX::Zero(count);
  for (const ContactPoint& point : pair.points) faced(point.edge) += point.ds;
  auto first = pair.points.begin();
  for (Eigen::Index e = 0; e < count; ++e) {
    auto last = first;
    while (last != pair.points.end() && last->edge == e) ++last;
    const EdgeMultipliers functions = edge_multipliers(pair.multiplier.edges[e], space, {first, last});
    first = last;
    EdgeData& edge = edges[e];
    const double length = line.s(e + 1) - line.s(e);
    if (!line.faced[e]) edge.to = 0;
    if (line.faced[e]) find_faced_part(faced(e) / length, line.faced_beside(e)[0], line.faced_beside(e + 1)[1], edge);
    const auto& own = pair.coupling.on_edge[e];
    edge.joined =
        own[0] != own[1] && pair.coupling.row[own[0]] >= 0 && pair.coupling.row[own[0]] == pair.coupling.row[own[1]];
    const Eigen::Vector3d p(line.p(e), line.p(e + 1), line.middle.size() > 0 ? line.middle(e) : 0);
    const auto depth = [&](Eigen::Index i) { return model.axisymmetric() ? line.position[i].x() : 1; };
    for (std::size_t i = 0; i < rule.points.size(); ++i) {
      const double t = edge.from + (edge.to - edge.from) * (1 + rule.points[i]) / 2;
      const double ds = length * (edge.to - edge.from) * rule.weights[i] / 2;
      const double force = functions.shape(2 * t - 1).head(functions.count).dot(p.head(functions.count)) *
                           ((1 - t) * depth(e) + t * depth(e + 1)) * ds;
      edge.start += (1 - t) * force;
      edge.end += t * force;
    }
  }
  return edges;
}

// Points at which p is not smooth, by vertex, and by edge with the part of the edge before them.
struct Cuts {
  std::map<Eigen::Index, double> vertices;                  // exponent
  std::map<Eigen::Index, std::pair<double, double>> edges;  // part, exponent
};

Cuts cuts_of(const PressureLine& line, const std::vector<SingularPoint>& points) {
  constexpr double at_vertex = 1e-6;
  Cuts cuts;
  const Eigen::Index last = line.p.size() - 1;
  for (const SingularPoint& point : points) {
    Eigen::Index edge = 0;
    double part = 0, nearest = std::numeric_limits<double>::infinity();
    for (Eigen::Index e = 0; e < last; ++e) {
      const Vec2 along = line.position[e + 1] - line.position[e], from = point.position - line.position[e];
      const double t = std::clamp(from.dot(along) / along.squaredNorm(), 0.0, 1.0);
      const double distance = (from - t * along).norm();
      if (distance >= nearest) continue;
      nearest = distance;
      edge = e;
      part = t;
    }
    if (part > at_vertex && part < 1 - at_vertex) {
      cuts.edges[edge] = {part, point.pressure_exponent};
      continue;
    }
    const Eigen::Index vertex = part < 0.5 ? edge : edge + 1;
    cuts.vertices[vertex] = point.pressure_exponent;
    if (line.closed && vertex % last == 0) cuts.vertices[0] = cuts.vertices[last] = point.pressure_exponent;
  }
  return cuts;
}

// The line laid out so that no piece goes on across its ends: edges in order, from one that ends a piece where it is
// closed; where none does, all of it with a part once more at either end.
struct Layout {
  std::vector<Eigen::Index> edges;
  Eigen::Index core_first = 0, core_last = 0;  // of those that count
};

Layout layout(const PressureLine& line, const std::vector<char>& ends_piece) {
  constexpr Eigen::Index most_again = 30;  // by so many knots nothing is felt of an end: 3.7^-30
  const Eigen::Index count = line.p.size() - 1;
  const auto first = std::ranges::find_if(ends_piece, [](char ends) { return ends != 0; });
  const bool again = line.closed && first == ends_piece.end();
  const Eigen::Index start = line.closed && !again ? first - ends_piece.begin() : 0;
  const Eigen::Index more = again ? std::min(most_again, count) : 0;
  Layout order{{}, more, more + count};
  for (Eigen::Index i = -more; i < count + more; ++i) order.edges.push_back((start + i + count) % count);
  return order;
}

// A loaded piece and where it lies: its vertices are `first` ... of the layout.
struct PlacedPiece {
  LoadedPiece piece;
  Eigen::Index first = 0;
  std::array<bool, 2> blind{};  // of its ends: nothing is known of p at the vertex itself
  bool has_border() const { return piece.ends[0].border || piece.ends[1].border; }
  bool is_mirrored() const { return piece.ends[0].mirrored || piece.ends[1].mirrored; }
  // p may have a kink on the axis, as below a cone. The moment there, with r dr, says next to nothing.
  void drop_mirrors() {
    blind = {piece.ends[0].mirrored, piece.ends[1].mirrored};
    if (blind[0]) piece.joined.front() = 1;
    if (blind[1]) piece.joined.back() = 1;
    piece.ends[0].mirrored = piece.ends[1].mirrored = false;
  }
  bool is_blind(Eigen::Index k) const { return (blind[0] && k == 0) || (blind[1] && k + 1 == piece.s.size()); }
};

class Pieces {
 public:
  Pieces(const ContactPair& pair, const Model& model, const PressureLine& line, std::vector<EdgeData> edges, Cuts cuts)
      : unilateral_(pair.spec.condition == Condition::unilateral),
        model_(model),
        line_(line),
        edges_(std::move(edges)),
        cuts_(std::move(cuts)) {
    const Eigen::Index count = line.p.size() - 1;
    std::vector<char> ends_piece(count);
    for (Eigen::Index e = 0; e < count; ++e)
      ends_piece[e] = !edges_[e].is_usable() || cuts_.edges.contains(e) || cuts_.vertices.contains(e) ||
                      (unilateral_ && line.p(e) == 0);
    order_ = layout(line, ends_piece);
    s_ = VecX::Zero(Eigen::Index(order_.edges.size()) + 1);
    for (Eigen::Index k = 0; k < Eigen::Index(order_.edges.size()); ++k)
      s_(k + 1) = s_(k) + line.s(order_.edges[k] + 1) - line.s(order_.edges[k]);
  }

  const Layout& order() const { return order_; }
  const VecX& s() const { return s_; }
  // Of a vertex of the layout, in the line.
  Eigen::Index vertex(Eigen::Index k) const {
    return k < Eigen::Index(order_.edges.size()) ? order_.edges[k] : order_.edges.back() + 1;
  }

  std::vector<PlacedPiece> all() const {
    std::vector<PlacedPiece> list;
    const Eigen::Index last = Eigen::Index(order_.edges.size());
    for (Eigen::Index i = 0; i < last;) {
      Eigen::Index j = i;
      while (j < last && goes_on(j) && (j == i || !cut_at(j))) ++j;
      if (j - i >= least_edges) list.push_back(piece(i, j));
      i = j > i && cut_at(j) ? j : j + 1;
    }
    return list;
  }

 private:
  const EdgeData& edge(Eigen::Index k) const { return edges_[order_.edges[k]]; }
  std::optional<double> cut_at(Eigen::Index k) const {
    const auto found = cuts_.vertices.find(vertex(k));
    return found == cuts_.vertices.end() ? std::nullopt : std::optional(found->second);
  }
  bool carries(Eigen::Index k) const { return !unilateral_ || line_.p(vertex(k)) > 0; }
  // Whether p goes on along edge k, from its start to its end.
  bool goes_on(Eigen::Index k) const {
    const EdgeData& e = edge(k);
    if (!e.is_usable() || (e.is_whole() && cuts_.edges.contains(order_.edges[k]))) return false;
    return (carries(k) || e.from > 0) && (carries(k + 1) || e.to < 1) && (carries(k) || carries(k + 1));
  }

  // Of the piece at vertex k; `beyond`: the edge that follows, from which the piece comes by `outward`.
  PieceEnd end(Eigen::Index k, Eigen::Index beyond, bool at_start) const {
    PieceEnd end{.place = s_(k), .centre = s_(k)};
    const EdgeData& own = edge(at_start ? k : k - 1);
    if (at_start && own.from > 0) end.place = end.centre = s_(k) + own.from * (s_(k + 1) - s_(k));
    if (!at_start && own.to < 1) end.place = end.centre = s_(k - 1) + own.to * (s_(k) - s_(k - 1));
    if (!own.is_whole()) return with_exponent_near(k, at_start, end);
    if (const auto exponent = cut_at(k)) {
      end.exponent = *exponent;
      return end;
    }
    if (model_.axisymmetric() && line_.position[vertex(k)].x() < 1e-9 * line_.s(line_.s.size() - 1))
      end.mirrored = true;
    if (beyond < 0 || beyond >= Eigen::Index(order_.edges.size())) return end;
    if (const auto cut = cuts_.edges.find(order_.edges[beyond]); cut != cuts_.edges.end()) {
      end.centre = s_(beyond) + cut->second.first * (s_(beyond + 1) - s_(beyond));
      end.exponent = cut->second.second;
    } else {
      end.border = unilateral_ && edge(beyond).is_whole() && !carries(at_start ? k - 1 : k + 1);
      if (end.border) end.exponent = 1.5;
    }
    return end;
  }

  // Of an end within an edge, where the other side ends.
  PieceEnd with_exponent_near(Eigen::Index k, bool at_start, PieceEnd end) const {
    const Eigen::Index own = at_start ? k : k - 1;
    if (const auto cut = cuts_.edges.find(order_.edges[own]); cut != cuts_.edges.end())
      end.exponent = cut->second.second;
    return end;
  }

  PlacedPiece piece(Eigen::Index i, Eigen::Index j) const {
    const std::array<PieceEnd, 2> ends{end(i, i - 1, true), end(j, j, false)};
    const Eigen::Index first = i - ends[0].border, last = j + ends[1].border, count = last - first + 1;
    PlacedPiece placed{.piece = {.s = s_.segment(first, count),
                                 .depth = VecX::Ones(count),
                                 .moments = VecX::Zero(count),
                                 .joined = std::vector<char>(count - 1),
                                 .ends = ends},
                       .first = first};
    for (Eigen::Index k = 0; k < count; ++k)
      if (model_.axisymmetric()) placed.piece.depth(k) = line_.position[vertex(first + k)].x();
    for (Eigen::Index k = 0; k + 1 < count; ++k) {
      const EdgeData& e = edge(first + k);
      placed.piece.moments(k) += e.start;
      placed.piece.moments(k + 1) += e.end;
      placed.piece.joined[k] = e.joined;
    }
    return placed;
  }

  bool unilateral_;
  const Model& model_;
  const PressureLine& line_;
  std::vector<EdgeData> edges_;
  Cuts cuts_;
  Layout order_;
  VecX s_;  // of the layout's vertices
};

struct Candidate {
  PressureForm form;
  VecX p;                       // at the vertices of the piece
  std::array<VecX, 2> differs;  // from it, of other splines
};

// Nowhere tension, and at 19 of 20 vertices where the multiplier's bar says that p is, those left out for a singular
// point aside.
bool is_credible(const PressureForm& form, const PlacedPiece& placed, const Pieces& pieces,
                 const PressureEstimate& estimate, bool unilateral) {
  constexpr int samples = 4;
  constexpr double outside = 0.05;
  const VecX& s = placed.piece.s;
  int judged = 0, off = 0;
  for (Eigen::Index k = 0; k < s.size(); ++k) {
    const Eigen::Index i = pieces.vertex(placed.first + k);
    const double p = form.at(s(k));
    if (!estimate.excluded[i] && estimate.line.p(i) != 0 && std::isfinite(p) && !placed.is_blind(k)) {
      ++judged;
      off += std::abs(p - estimate.line.p(i)) > estimate.bar(i);
    }
    if (!unilateral || k + 1 == s.size()) continue;
    for (int n = 1; n <= samples; ++n)
      if (form.at(s(k) + (s(k + 1) - s(k)) * n / (samples + 1)) < 0) return false;
  }
  return off <= outside * judged;
}

// The largest of `n` neighbours on both sides.
VecX spread(const VecX& v, Eigen::Index n) {
  VecX found(v.size());
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    const Eigen::Index first = std::max<Eigen::Index>(i - n, 0), last = std::min(i + n, v.size() - 1);
    found(i) = v.segment(first, last - first + 1).maxCoeff();
  }
  return found;
}

VecX values(const PressureForm& form, const VecX& s) {
  VecX p(s.size());
  for (Eigen::Index i = 0; i < s.size(); ++i) p(i) = form.at(s(i));
  return p;
}

// How far p* is at the vertices from what parabolas, and from what knots at every other vertex make of the same
// moments.
std::array<VecX, 2> differences(const LoadedPiece& piece, const VecX& p, int clear) {
  std::array<VecX, 2> found;
  for (int k = 0; k < 2; ++k) {
    const PressureForm form = fit_form(piece, k == 0 ? FormSpec{2, 1, clear} : FormSpec{3, 2, clear});
    found[k] = form.q.size() == 0 ? p : VecX(values(form, piece.s) - p);
    for (double& d : found[k]) d = std::isnan(d) ? std::numeric_limits<double>::infinity() : std::abs(d);
  }
  return found;
}

// What moving a border by `off` does to the root beside it, at r from it.
double border_shift(const PressureForm& form, const PieceEnd& end, double s, double off) {
  const double inward = end.place == form.ends[0].place ? 1 : -1;
  const double r = std::max(inward * (s - end.place), 0.0), at = std::max(r, off);
  return std::abs(form.at(end.place + inward * at)) * (std::sqrt(r + off) - std::sqrt(r)) / std::sqrt(at);
}

class Recovery {
 public:
  Recovery(const ContactPair& pair, Multipliers space, const Model& model, const PressureEstimate& estimate)
      : estimate_(estimate),
        line_(estimate.line),
        unilateral_(pair.spec.condition == Condition::unilateral),
        pieces_(pair, model, line_, edge_data(pair, space, model, line_), cuts_of(line_, estimate.singular)) {
    const Eigen::Index count = line_.p.size() - 1;
    found_ = {{},
              std::vector<int>(count, -1),
              VecX::Zero(count),
              VecX(line_.s.tail(count) - line_.s.head(count)),
              line_.p,
              estimate.bar,
              {}};
    rest_ = line_rest();
    for (const PlacedPiece& placed : pieces_.all()) recover(placed);
  }

  EqualMoments take() { return std::move(found_); }

 private:
  // What the line's own error has besides that of a piecewise linear function: what gaps, data and swings make, which
  // p* has too.
  VecX line_rest() const {
    LineError rest = estimate_.local;
    const VecX hats = line_error(line_).l2;
    rest.l2 = (rest.l2.cwiseAbs2() - hats.cwiseAbs2()).cwiseMax(0).cwiseSqrt();
    std::ranges::fill(rest.border, 0);
    VecX found = rest.pointwise(line_);
    if (rest.least.size() > 0) found = found.cwiseMax(rest.least);
    return found;
  }

  void recover(PlacedPiece placed) {
    if (recover_as_it_is(placed) || !placed.is_mirrored()) return;
    placed.drop_mirrors();
    recover_as_it_is(placed);
  }

  bool recover_as_it_is(PlacedPiece& placed) {
    for (const int clear : {10, 6, 4}) {
      const FormSpec spec{.clear = clear};
      if (placed.has_border()) place_borders(placed.piece, spec);
      Candidate found{.form = fit_form(placed.piece, spec), .p = {}, .differs = {}};
      if (found.form.q.size() > 0 && is_credible(found.form, placed, pieces_, estimate_, unilateral_)) {
        found.p = values(found.form, placed.piece.s);
        found.differs = differences(placed.piece, found.p, clear);
        if (is_known(found, placed)) {
          keep(std::move(found), placed);
          return true;
        }
      }
      if (!placed.has_border()) return false;
    }
    return false;
  }

  // Whether p* changes p_h by what it hangs on the spline by, in the root mean square: else it is not known any better,
  // as where the bodies make p_h swing from vertex to vertex. (Where p is resolved half as many knots are off by 16
  // times the error of p*; where sizes grow quickly, as at tents, by up to 1.2 times what p* changes.)
  bool is_known(const Candidate& found, const PlacedPiece& placed) const {
    constexpr double most = 2;
    double changed = 0, differs = 0;
    for (Eigen::Index k = 0; k < found.p.size(); ++k) {
      const Eigen::Index i = pieces_.vertex(placed.first + k);
      if (estimate_.excluded[i] || placed.is_blind(k) || !std::isfinite(found.p(k))) continue;
      changed += line_.h(i) * std::pow(found.p(k) - line_.p(i), 2);
      differs += line_.h(i) * std::pow(std::min(found.differs[0](k), found.differs[1](k)), 2);
    }
    return differs < most * most * changed;
  }

  void keep(Candidate found, const PlacedPiece& placed) {
    constexpr Eigen::Index beside = 4;
    PressureForm& form = found.form;
    const VecX &s = placed.piece.s, &p = found.p;
    const VecX differs = spread(found.differs[0], beside).cwiseMin(spread(found.differs[1], beside));
    for (const PieceEnd& end : form.ends)
      if (end.border) add_border(form, end, placed);
    const Layout& order = pieces_.order();
    for (Eigen::Index k = 0; k < s.size(); ++k) {
      const Eigen::Index at = placed.first + k, i = pieces_.vertex(at);
      if (at < order.core_first || at > order.core_last) continue;
      if (k + 1 < s.size() && at < order.core_last) {
        found_.form_of_edge[order.edges[at]] = int(found_.forms.size());
        found_.start(order.edges[at]) = s(k);
      }
      if (!std::isfinite(p(k)) || !has_place(form, s(k)) || placed.is_blind(k)) continue;
      double bar = error_safety * (differs(k) + far_parts * estimate_.far_at(i) + rest_(i));
      for (const PieceEnd& end : form.ends)
        if (end.border) bar += border_shift(form, end, s(k), border_off(end, placed));
      put(i, p(k), std::min(bar, estimate_.bar(i)));
    }
    found_.forms.push_back(std::move(form));
  }

  static bool has_place(const PressureForm& form, double s) {
    return (form.ends[0].border || s >= form.ends[0].place) && (form.ends[1].border || s <= form.ends[1].place);
  }

  void put(Eigen::Index i, double p, double bar) {
    const Eigen::Index last = line_.p.size() - 1;
    for (const Eigen::Index at : {i, i == last ? 0 : last}) {
      if (at != i && !(line_.closed && i % last == 0)) continue;
      found_.p(at) = p;
      found_.bar(at) = bar;
    }
  }

  // The edge of the piece on which an end lies.
  static Eigen::Index edge_of(const PieceEnd& end, const VecX& s) {
    const auto after = std::upper_bound(s.begin() + 1, s.end() - 1, end.place);
    return after - s.begin() - 1;
  }
  double border_off(const PieceEnd& end, const PlacedPiece& placed) const {
    const Eigen::Index k = edge_of(end, placed.piece.s);
    return border_place * (placed.piece.s(k + 1) - placed.piece.s(k));
  }
  void add_border(const PressureForm& form, const PieceEnd& end, const PlacedPiece& placed) {
    const VecX& s = placed.piece.s;
    const bool at_start = end.place < s(s.size() / 2);
    const Eigen::Index last = s.size() - 2, k = edge_of(end, s), *edges = &pieces_.order().edges[placed.first];
    const double t = (end.place - s(k)) / (s(k + 1) - s(k));
    found_.borders.push_back({.edge = edges[at_start ? 0 : last],
                              .length = at_start ? s(1) - end.place : end.place - s(last),
                              .position = at_part(edges[k], t),
                              .bar = border_off(end, placed) + far_off(form, end, edges[k], t)});
  }
  // By what a border moves where the mean of the nearest window, at r from it, is off by F: a root that moves by d
  // changes there by d p / 2r.
  double far_off(const PressureForm& form, const PieceEnd& end, Eigen::Index edge, double t) const {
    const double place = line_.s(edge) + t * found_.lengths(edge), whole = line_.s(line_.s.size() - 1);
    double r = std::numeric_limits<double>::infinity();
    for (const PressureWindow& window : estimate_.windows) {
      const double d = std::abs(window.s - place);
      r = std::min(r, line_.closed ? std::min(d, whole - d) : d);
    }
    if (estimate_.windows.empty()) return 0;
    const double p = form.at(end.place + (end.place == form.ends[0].place ? r : -r));
    return p > 0 ? std::min(error_safety * estimate_.far_at(edge) * 2 * r / p, r) : 0;
  }
  Vec2 at_part(Eigen::Index edge, double t) const {
    return (1 - t) * line_.position[edge] + t * line_.position[edge + 1];
  }

  static constexpr double far_parts = 3;  // windows' means see one; what swings from vertex to vertex is in none

  const PressureEstimate& estimate_;
  const PressureLine& line_;
  bool unilateral_;
  Pieces pieces_;
  VecX rest_;
  EqualMoments found_;
};

}  // namespace

std::optional<double> EqualMoments::at(Eigen::Index edge, double t) const {
  const int k = form_of_edge[edge];
  if (k < 0) return {};
  const PressureForm& form = forms[k];
  const double s = start(edge) + t * lengths(edge);
  if ((!form.ends[0].border && s < form.ends[0].place) || (!form.ends[1].border && s > form.ends[1].place)) return {};
  const double found = form.at(s);
  return std::isfinite(found) ? std::optional(found) : std::nullopt;
}

EqualMoments equal_moments(const ContactPair& pair, Multipliers space, const Model& model,
                           const PressureEstimate& estimate) {
  return Recovery(pair, space, model, estimate).take();
}

}  // namespace mortise
