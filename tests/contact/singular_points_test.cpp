// Which points of two plates' contact line are singular, and how much.
#include "contact/singular_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <sstream>

#include "base/vectors.hpp"
#include "contact/curvature_jumps.hpp"
#include "gmsh/load_mesh.hpp"
#include "support/temporary_folder.hpp"
#include "support/two_plates.hpp"
#include "support/wedges.hpp"

namespace mortise {
namespace {

ContactReach reached_everywhere(const Curve& first, const Curve& second) {
  return {std::vector<Reach>(first.edges.size() + 1, {true, true}),
          std::vector<Reach>(second.edges.size() + 1, {true, true})};
}

using test::end_exponents;
using test::kink_exponents;
using test::TwoPlates;
using test::wedge_exponent;

std::vector<SingularPoint> points_of_pair(const Surroundings& around, const Curve& first, const Curve& second,
                                          const ContactReach& reach) {
  return singular_points({contact_places(around, first, second, reach)}, around.tips)[0];
}

constexpr double deg = std::numbers::pi / 180;

struct Sides {
  std::vector<std::string> names;  // of boundaries
  std::vector<int> components;
};

std::vector<SingularPoint> points_of(const TwoPlates& plates, const Sides& held) {
  const Mesh mesh = test::mesh_of(plates);
  Constraints constraints = no_constraints(mesh);
  for (const std::string& name : held.names)
    for (const int c : held.components) prescribe(mesh, boundary_index(mesh, name), c, 0, constraints);
  const std::vector<ElasticLaw> laws(2, elastic_law(210e9, 0.3, {Plane::strain}));
  TipTable tips;
  const Curve lower = contact_curve(mesh, boundary_index(mesh, "lower_contact")),
              upper = contact_curve(mesh, boundary_index(mesh, "upper_contact"));
  return points_of_pair({mesh, SideTable(mesh), constraints, laws, tips}, lower, upper,
                        reached_everywhere(lower, upper));
}

const std::vector<std::string> all_sides{"upper_left", "upper_right", "lower_left", "lower_right"};

Wedge steel_wedge(double angle, Face outer) { return wedge(angle, elastic_law(210e9, 0.3, {Plane::strain}), outer); }

TEST(SingularPoints, OfABodyAloneAreItsCornersByWhatHoldsThem) {
  const Mesh mesh = test::mesh_of(TwoPlates{});
  const ElasticLaw law = elastic_law(210e9, 0.3, {Plane::strain});
  Constraints constraints = no_constraints(mesh);
  const Curve side = contact_curve(mesh, boundary_index(mesh, "lower_left"));
  const int corner = side.edges.front().nodes[0], middle = side.edges.front().nodes[1];
  EXPECT_EQ(corner_exponent(mesh, corner, constraints, law), 1);
  EXPECT_EQ(corner_exponent(mesh, middle, constraints, law), 1);
  for (const int c : {0, 1}) prescribe(mesh, boundary_index(mesh, "lower_left"), c, 0, constraints);
  EXPECT_NEAR(corner_exponent(mesh, corner, constraints, law),
              wedge_exponent(steel_wedge(90 * deg, Face::free), Face::clamped).real(), 1e-9);
  EXPECT_EQ(corner_exponent(mesh, middle, constraints, law), 1);
}

TEST(SingularPoints, OfAFlatLineBetweenFreeOrSlidingSidesThereAreNone) {
  EXPECT_TRUE(points_of({}, {}).empty());
  EXPECT_TRUE(points_of({}, {all_sides, {0}}).empty());
}

TEST(SingularPoints, BetweenClampedSidesOnlyTheBodiesStressIs) {
  const auto points = points_of({}, {all_sides, {0, 1}});
  ASSERT_EQ(points.size(), 2u);
  for (const SingularPoint& p : points) {
    EXPECT_EQ(p.meeting, Meeting::ends);
    EXPECT_NEAR(p.exponent, wedge_exponent(steel_wedge(90 * deg, Face::free), Face::clamped).real(), 1e-9);
    EXPECT_EQ(p.pressure_exponent, 1);
  }
}

// Only the side beside the line says what holds the end, not the end node, which the bottom of a plate may share.
TEST(SingularPoints, WhatHoldsAnEndIsTheSideBesideIt) {
  const auto points = points_of({}, {{"lower_left"}, {0, 1}});
  ASSERT_EQ(points.size(), 1u);
  EXPECT_NEAR(points[0].position.x(), 0, 1e-15);
  EXPECT_NEAR(points[0].exponent,
              end_exponents(steel_wedge(90 * deg, Face::clamped), steel_wedge(90 * deg, Face::free)).stress.real(),
              1e-9);
}

// A body that ends within the other's edge, nearer to its vertex or not, ends on a straight side.
TEST(SingularPoints, AnEndWithinTheOthersEdgeIsNoMeetingOfCorners) {
  TwoPlates plates;
  plates.n_upper = plates.n_lower = 8;
  const double exact =
      end_exponents(steel_wedge(90 * deg, Face::free), steel_wedge(180 * deg, Face::free)).pressure.real();
  for (const double edges : {0.1, 0.4, 0.6}) {
    Mesh mesh = test::mesh_of(plates);
    const Curve upper = contact_curve(mesh, boundary_index(mesh, "upper_contact")),
                lower = contact_curve(mesh, boundary_index(mesh, "lower_contact"));
    std::set<int> of_upper;
    for (const Cell& cell : mesh.cells)
      if (cell.body == upper.body) of_upper.insert(cell.nodes.begin(), cell.nodes.begin() + node_count(cell.kind));
    for (const int node : of_upper) mesh.nodes(node, 0) += edges * 0.1;
    const std::vector<ElasticLaw> laws(2, elastic_law(210e9, 0.3, {Plane::strain}));
    TipTable tips;
    const auto points = points_of_pair({mesh, SideTable(mesh), no_constraints(mesh), laws, tips}, lower, upper,
                                       reached_everywhere(lower, upper));
    const auto end = std::ranges::find_if(
        points, [&](const SingularPoint& p) { return std::abs(p.position.x() - edges * 0.1) < 1e-12; });
    ASSERT_NE(end, points.end()) << edges;
    EXPECT_NEAR(end->pressure_exponent, exact, 1e-9) << edges;
  }
}

// An arc drawn in both bodies, contact up to a vertex in the middle of it: however short its edges are and wherever it
// is, the round-off of its places is no kink.
TEST(SingularPoints, AreNotMadeByRoundOffOfDrawnArcs) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> exponent(-4, 0), place(-40, 40), angle(-3, 3);
  const Mesh flat = test::mesh_of({});
  const double y0 = flat.nodes(contact_curve(flat, boundary_index(flat, "lower_contact")).edges[0].nodes[0], 1);
  const std::vector<ElasticLaw> laws(2, elastic_law(210e9, 0.3, {Plane::strain}));
  TipTable tips;
  for (int i = 0; i < 100; ++i) {
    const double scale = std::pow(10, exponent(random)), radius = 10 + std::abs(place(random)), start = angle(random);
    const Vec2 centre(place(random), place(random));
    const auto at = [&](double t, double r) { return Vec2(centre + r * Vec2(std::sin(t), std::cos(t))); };
    const auto turn = [&](int node) { return start + scale * flat.nodes(node, 0) / radius; };
    Mesh mesh = flat;
    for (Eigen::Index n = 0; n < mesh.nodes.rows(); ++n)
      mesh.nodes.row(n) = at(turn(int(n)), radius + scale * (flat.nodes(n, 1) - y0)).transpose();
    std::vector<Curve> curves;
    ContactReach reach;
    for (const char* name : {"lower_contact", "upper_contact"}) {
      Curve& curve = curves.emplace_back(contact_curve(mesh, boundary_index(mesh, name)));
      std::vector<std::array<double, 2>> ends;
      for (const Edge& edge : curve.edges) ends.push_back({turn(edge.nodes[0]), turn(edge.nodes[1])});
      curve.samples = sample_edges(
          [&](const std::vector<double>& turns) {
            std::vector<Vec2> places;
            for (const double t : turns) places.push_back(at(t, radius));
            return places;
          },
          ends);
      std::vector<Reach> reached(curve.edges.size() + 1, {false, false});
      for (std::size_t v = 0; v < reached.size(); ++v) {  // where x is less than that of a vertex
        const auto inside = [&](std::size_t edge) {
          return edge < curve.edges.size() &&
                 std::max(flat.nodes(curve.edges[edge].nodes[0], 0), flat.nodes(curve.edges[edge].nodes[1], 0)) < 0.5;
        };
        reached[v] = {v > 0 && inside(v - 1), inside(v)};
      }
      reach[curves.size() - 1] = reached;
    }
    const auto points =
        points_of_pair({mesh, SideTable(mesh), no_constraints(mesh), laws, tips}, curves[0], curves[1], reach);
    EXPECT_TRUE(points.empty()) << i << ": edges of " << scale << " times the plates'";
  }
}

// A body whose foot is a chain of curves that gmsh draws, above a flat one, turned and moved at random; lengths in
// widths of the foot, angles from its chord.
struct DrawnFoot {
  struct Piece {
    std::string kind;  // Line, Circle, Ellipse, Spline, BSpline, Bezier
    double length, radius;
    bool bulges;          // towards the flat body
    double turn_to_next;  // radians
  };
  std::vector<Piece> pieces;
  std::vector<double> sizes;  // of the mesh where the pieces begin and end
  double width, place, angle;
  int order;
};

double draw(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
double draw_power(std::mt19937& random, double low, double high) { return std::pow(10, draw(random, low, high)); }

// `finest`: the decimal logarithm of the finest size.
DrawnFoot random_foot(std::mt19937& random, int pieces, double finest) {
  const std::array kinds{"Circle", "Ellipse", "Spline", "BSpline", "Bezier", "Line"};
  DrawnFoot foot;
  double angle = 0;
  for (int i = 0; i < pieces; ++i) {
    const std::string kind = kinds[random() % (pieces > 1 ? 6 : 5)];
    double turn = draw_power(random, -2, 1.4) * deg;
    if (angle > 0) turn = -turn;  // so that the foot stays level
    angle += turn;
    // An ellipse that is nearly a line gmsh draws past its own ends.
    const double flattest = kind == "Ellipse" ? 3 : 5.7;
    foot.pieces.push_back({kind, draw(random, 0.5, 1), draw_power(random, 0.7, flattest), random() % 2 == 1, turn});
  }
  double sum = 0;
  for (const auto& piece : foot.pieces) sum += piece.length;
  for (auto& piece : foot.pieces) {
    piece.length /= sum;
    piece.radius *= piece.length;
  }
  for (int i = 0; i <= pieces; ++i)
    foot.sizes.push_back(i % 2 == 0 ? draw(random, 0.05, 0.2) : draw_power(random, finest, -1));
  foot.width = draw_power(random, -2, 3);
  foot.place = foot.width * draw(random, -1, 1) * (random() % 2 == 0 ? 1 : 30);
  foot.angle = random() % 2 == 0 ? 0 : draw(random, -3, 3);
  foot.order = 1 + int(random() % 2);
  return foot;
}

struct FootFile {
  std::string geo;
  std::vector<Vec2> vertices;  // where pieces begin and end
};

FootFile file_of(const DrawnFoot& foot) {
  FootFile file;
  std::ostringstream out;
  out.precision(17);
  int tag = 1;
  const auto moved = [&](const Vec2& x) {
    const double c = std::cos(foot.angle), s = std::sin(foot.angle);
    return Vec2(foot.width * Vec2(c * x.x() - s * x.y(), s * x.x() + c * x.y()) + foot.place * Vec2(1, -0.7));
  };
  const auto point = [&](const Vec2& x, double size) {
    const Vec2 at = moved(x);
    out << "Point(" << tag << ") = {" << at.x() << ", " << at.y() << ", 0, " << size * foot.width << "};\n";
    return tag++;
  };
  const auto curve = [&](const std::string& kind, const std::vector<int>& points) {
    out << kind << "(" << tag << ") = {";
    for (std::size_t i = 0; i < points.size(); ++i) out << (i > 0 ? ", " : "") << points[i];
    out << "};\n";
    return tag++;
  };
  const auto surface = [&](const std::string& name, const std::vector<int>& curves) {
    out << "Curve Loop(" << tag << ") = {";
    for (std::size_t i = 0; i < curves.size(); ++i) out << (i > 0 ? ", " : "") << curves[i];
    out << "}; Plane Surface(" << tag << ") = {" << tag << "}; Physical Surface(\"" << name << "\") = {" << tag
        << "};\n";
    ++tag;
  };
  const auto direction = [](double t) { return Vec2(std::cos(t), std::sin(t)); };
  Vec2 x(0, 0);
  double heading = 0;
  int from = point(x, foot.sizes[0]);
  const int first = from;
  file.vertices.push_back(moved(x));
  std::vector<int> loop;
  for (std::size_t i = 0; i < foot.pieces.size(); ++i) {
    const auto& piece = foot.pieces[i];
    const double bend = piece.kind == "Line" ? 0 : piece.length / piece.radius * (piece.bulges ? 1 : -1);
    const Vec2 chord = piece.length * direction(heading);
    // Places of the arc about its middle, by the part of its turn.
    const auto on_arc = [&](double part) {
      if (bend == 0) return Vec2(x + part * chord);
      const double r = piece.length / 2 / std::sin(bend / 2), a = bend * (part - 0.5);
      const double along = r * std::sin(a),
                   up = 2 * r * (std::pow(std::sin(bend / 4), 2) - std::pow(std::sin(a / 2), 2));
      return Vec2(x + chord / 2 + along * direction(heading) - up * direction(heading + straight / 2));
    };
    std::vector<int> points{from};
    const Vec2 end = on_arc(1);
    const Vec2 centre =
        x + chord / 2 + direction(heading + straight / 2) * (bend == 0 ? 0 : piece.length / 2 / std::tan(bend / 2));
    if (piece.kind == "Circle") points.push_back(point(centre, 1));
    if (piece.kind == "Ellipse") {  // half the length above the chord's middle; the foot's axis is its longer one
      points.push_back(point(centre, 1));
      points.push_back(point(centre + piece.length * direction(heading + 0.3), 1));
    }
    if (piece.kind == "Spline" || piece.kind == "BSpline" || piece.kind == "Bezier")
      for (const double part : {0.2, 0.45, 0.8}) points.push_back(point(on_arc(part), 1));
    from = point(end, foot.sizes[i + 1]);
    points.push_back(from);
    loop.push_back(curve(piece.kind, points));
    x = end;
    file.vertices.push_back(moved(x));
    heading += piece.turn_to_next;
  }
  out << "Physical Curve(\"foot\") = {";
  for (std::size_t i = 0; i < loop.size(); ++i) out << (i > 0 ? ", " : "") << loop[i];
  out << "};\n";
  const int right = point({1, 1}, 0.4), left = point({0, 1}, 0.4);
  loop.push_back(curve("Line", {from, right}));
  loop.push_back(curve("Line", {right, left}));
  loop.push_back(curve("Line", {left, first}));
  surface("upper", loop);
  const std::vector<int> corners{point({-2, -2}, 1), point({3, -2}, 1), point({3, -0.7}, 1), point({-2, -0.7}, 1)};
  loop.clear();
  for (int i = 0; i < 4; ++i) loop.push_back(curve("Line", {corners[i], corners[(i + 1) % 4]}));
  out << "Physical Curve(\"flat\") = {" << loop[2] << "};\n";
  surface("lower", loop);
  out << "Mesh.ElementOrder = " << foot.order << "; Mesh.SecondOrderIncomplete = 1;\n";
  file.geo = out.str();
  return file;
}

// Of the foot, without its ends.
std::vector<Vec2> kinks_of(const FootFile& file, const DrawnFoot& foot) {
  const test::TemporaryFolder folder;
  const Mesh mesh = load_mesh(folder.write("a.geo", file.geo), {});
  const std::vector<ElasticLaw> laws(2, elastic_law(210e9, 0.3, {Plane::strain}));
  TipTable tips;
  const Curve upper = contact_curve(mesh, boundary_index(mesh, "foot")),
              lower = contact_curve(mesh, boundary_index(mesh, "flat"));
  EXPECT_EQ(upper.samples.size(), upper.edges.size()) << mesh.boundaries[upper.boundary].undrawn;
  ContactReach reach = reached_everywhere(upper, lower);
  reach[0].front() = reach[0].back() = {false, false};
  std::vector<Vec2> found;
  for (const SingularPoint& p :
       points_of_pair({mesh, SideTable(mesh), no_constraints(mesh), laws, tips}, upper, lower, reach))
    found.push_back(p.position);
  // Smooth within an edge, too: a circle is one polynomial to round-off of its centre.
  for (std::size_t e = 0; e < upper.samples.size() && foot.pieces.size() == 1; ++e)
    if (foot.pieces[0].kind == "Circle") EXPECT_EQ(upper.samples[e].pieces.size(), 1u);
  EXPECT_TRUE(curvature_jumps(mesh.nodes, upper, ContactLine(mesh.nodes, upper)).empty() || foot.pieces.size() > 1 ||
              foot.pieces[0].kind.ends_with("pline"));
  return found;
}

std::string name_of(const DrawnFoot& foot) {
  std::ostringstream out;
  for (const auto& piece : foot.pieces)
    out << piece.kind << " " << piece.length << " R " << piece.radius << " then " << piece.turn_to_next / deg << "; ";
  out << "sizes";
  for (const double size : foot.sizes) out << " " << size;
  out << " width " << foot.width << " at " << foot.place << " by " << foot.angle;
  return out.str();
}

// Arcs of radii up to 1e6 times their half width, whose places are known no better than those of their centres.
TEST(SingularPoints, WithinOneDrawnCurveThereAreNone) {
  std::mt19937 random(8);
  for (int i = 0; i < 40; ++i) {
    const DrawnFoot foot = random_foot(random, 1, -4);
    for (const Vec2& x : kinks_of(file_of(foot), foot))
      ADD_FAILURE() << i << ": (" << x.transpose() << ") of " << name_of(foot);
  }
}

TEST(SingularPoints, DrawnCurvesThatMeetAtAnyAngleAreFoundAsKinks) {
  std::mt19937 random(9);
  for (int i = 0; i < 40; ++i) {
    const DrawnFoot foot = random_foot(random, 2 + int(random() % 2), -3);
    const FootFile file = file_of(foot);
    const std::vector<Vec2> found = kinks_of(file, foot);
    EXPECT_EQ(found.size(), foot.pieces.size() - 1) << i << ": " << name_of(foot);
    for (std::size_t k = 1; k < foot.pieces.size(); ++k)
      EXPECT_TRUE(
          std::ranges::any_of(found, [&](const Vec2& x) { return (x - file.vertices[k]).norm() < 1e-9 * foot.width; }))
          << i << ": " << name_of(foot);
  }
}

// At its kinks and at vertices of smooth pieces, each part a contact of its own.
TEST(SingularPoints, AreThoseOfTheWholeCurveHoweverManyNamesItHas) {
  std::mt19937 random(10);
  int kinks = 0;
  for (int i = 0; i < 40; ++i) {
    const DrawnFoot foot = random_foot(random, 1 + int(random() % 3), -3);
    const test::TemporaryFolder folder;
    const Mesh mesh = load_mesh(folder.write("a.geo", file_of(foot).geo), {});
    const std::vector<ElasticLaw> laws(2, elastic_law(210e9, 0.3, {Plane::strain}));
    const Constraints free = no_constraints(mesh);
    const SideTable table(mesh);
    TipTable tips;
    const Surroundings around{mesh, table, free, laws, tips};
    const Curve upper = contact_curve(mesh, boundary_index(mesh, "foot")),
                lower = contact_curve(mesh, boundary_index(mesh, "flat"));
    ContactReach reach = reached_everywhere(upper, lower);
    reach[0].front() = reach[0].back() = {false, false};
    const auto whole = singular_points({contact_places(around, upper, lower, reach)}, tips)[0];
    std::set<std::size_t> cuts{0, upper.edges.size()};
    for (std::size_t e = 1; e < upper.edges.size(); ++e) {
      const Vec2 x = mesh.nodes.row(upper.edges[e].nodes[0]).transpose();
      const bool is_kink = std::ranges::any_of(whole, [&](const SingularPoint& p) { return p.position == x; });
      if (random() % (is_kink ? 2 : 8) == 0) cuts.insert(e);
    }
    std::vector<std::vector<ContactPlace>> places;
    for (auto from = cuts.begin(), to = std::next(from); to != cuts.end(); from = to++) {
      Curve part = upper;
      part.edges = {upper.edges.begin() + *from, upper.edges.begin() + *to};
      part.samples = {upper.samples.begin() + *from, upper.samples.begin() + *to};
      ContactReach of_part = reached_everywhere(part, lower);
      if (*from == 0) of_part[0].front() = {false, false};
      if (*to == upper.edges.size()) of_part[0].back() = {false, false};
      places.push_back(contact_places(around, part, lower, of_part));
    }
    std::vector<SingularPoint> found;
    for (const auto& points : singular_points(places, tips))
      for (const SingularPoint& point : points)
        if (std::ranges::none_of(found, [&](const auto& p) { return p.position == point.position; }))
          found.push_back(point);
    ASSERT_EQ(found.size(), whole.size()) << i << ": " << name_of(foot);
    for (std::size_t k = 0; k < found.size(); ++k) {
      EXPECT_NEAR(found[k].pressure_exponent, whole[k].pressure_exponent, 1e-6) << i;
      EXPECT_NEAR(found[k].log_pressure, whole[k].log_pressure, 1e-6 * whole[k].log_pressure) << i;
    }
    kinks += int(whole.size());
  }
  EXPECT_GE(kinks, 20);
}

// The preprint's parabola has slopes 1 and -1 at its ends, with elements of any kind, and no corner between them.
TEST(SingularPoints, AParabolaMeetsItsSlidingSidesAtTheAnglesOfTheCurve) {
  TwoPlates plates;
  plates.height = [](double x) { return 0.2 + x - 1.25 * x * x; };
  for (const CellKind kind : {CellKind::quad4, CellKind::tri3, CellKind::quad8}) {
    plates.kind_upper = plates.kind_lower = kind;
    const auto points = points_of(plates, {all_sides, {0}});
    ASSERT_EQ(points.size(), 2u);
    const double exact =
        end_exponents(steel_wedge(45 * deg, Face::symmetric), steel_wedge(135 * deg, Face::symmetric)).pressure.real();
    for (const SingularPoint& p : points) {
      EXPECT_NEAR(p.exponent, exact, 2e-3);  // rebuilt through 8 and 12 vertices; by the chords 0.05
      EXPECT_EQ(p.exponent, p.pressure_exponent);
    }
  }
}

TEST(SingularPoints, AKinkOfBothPlatesIsOnePointWithBothFacesShared) {
  TwoPlates plates;
  plates.height = [](double x) { return 0.4 - std::abs(x - 0.4) / 2; };
  plates.n_upper = 8;
  plates.n_lower = 12;
  const auto points = points_of(plates, {all_sides, {0}});
  ASSERT_EQ(points.size(), 3u);
  const auto kink = std::ranges::find(points, Meeting::kink, &SingularPoint::meeting);
  ASSERT_NE(kink, points.end());
  const double turn = 2 * std::atan(0.5), half_turn = turn / 2, straight = std::numbers::pi;
  EXPECT_NEAR(kink->position.x(), 0.4, 1e-12);
  EXPECT_NEAR(kink->wedges[0].angle, straight - turn, 1e-9);
  EXPECT_NEAR(kink->wedges[1].angle, straight + turn, 1e-9);
  // Its symmetric modes are those of an end beside a sliding side; the lowest mode is antisymmetric.
  const double beside = points[kink == points.begin() ? 1 : 0].exponent;
  EXPECT_NEAR(kink_exponents(kink->wedges[0], kink->wedges[1], Face::symmetric).stress.real(), beside, 1e-9);
  EXPECT_NEAR(kink->exponent,
              end_exponents(steel_wedge(straight / 2 - half_turn, Face::antisymmetric),
                            steel_wedge(straight / 2 + half_turn, Face::antisymmetric))
                  .stress.real(),
              1e-9);
}

// The lower plate's top stays flat, the upper plate's foot is a wedge about x = middle, of slope `slope` on both sides.
struct WedgeOnFlat {
  double slope, middle;
  double gap = 0;
};

std::vector<SingularPoint> points_of(const WedgeOnFlat& wedge, const std::vector<Reach>& upper_reach,
                                     const Sides& held) {
  TwoPlates plates;
  plates.height = [](double) { return 0.3; };
  plates.n_upper = plates.n_lower = 8;
  Mesh mesh = test::mesh_of(plates);
  const Curve upper = contact_curve(mesh, boundary_index(mesh, "upper_contact"));
  for (const int node : curve_nodes(upper))
    mesh.nodes(node, 1) += wedge.gap + wedge.slope * std::abs(mesh.nodes(node, 0) - wedge.middle);
  Constraints constraints = no_constraints(mesh);
  for (const std::string& name : held.names)
    for (const int c : held.components) prescribe(mesh, boundary_index(mesh, name), c, 0, constraints);
  const std::vector<ElasticLaw> laws(2, elastic_law(210e9, 0.3, {Plane::strain}));
  TipTable tips;
  const Curve lower = contact_curve(mesh, boundary_index(mesh, "lower_contact"));
  ContactReach reach = reached_everywhere(lower, upper);
  for (Reach& at : reach[0]) at = {false, false};
  if (!upper_reach.empty()) reach[1] = upper_reach;
  return points_of_pair({mesh, SideTable(mesh), constraints, laws, tips}, lower, upper, reach);
}

// Johnson (1985), section 5.2: p = E* slope / pi arccosh(a / x), whose logarithm has half of what a cone's has.
TEST(SingularPoints, UnderAWedgeOnAFlatPressureGrowsAsTheLogarithm) {
  const double stiffness = 210e9 / (1 - 0.09) / 2;
  for (const double slope : {0.05, 2e-3})
    for (const double gap : {0.0, 0.2}) {  // however far it is drawn
      const auto points = points_of({slope, 0.4, gap}, std::vector<Reach>(9, {true, true}), {});
      const auto tip = std::ranges::find_if(points, [](const SingularPoint& p) { return p.log_pressure > 0; });
      ASSERT_NE(tip, points.end());
      EXPECT_EQ(tip->pressure_exponent, 1);
      EXPECT_NEAR(tip->position.x(), 0.4, 1e-12);
      EXPECT_NEAR(tip->log_pressure, stiffness * 2 * std::atan(slope) / 4, 1e-3 * tip->log_pressure);
    }
}

TEST(SingularPoints, UnderACornerPressedOnOneFaceItIsThatOfAWedge) {
  std::vector<Reach> reach(9, {false, false});
  reach[4] = {true, false};
  const auto points = points_of({0.5, 0.4}, reach, {});
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].log_pressure, 0);
  const double angle = 180 - 2 * std::atan(0.5) / deg;
  EXPECT_NEAR(points[0].pressure_exponent,
              end_exponents(steel_wedge(angle * deg, Face::free), steel_wedge(180 * deg, Face::free)).pressure.real(),
              1e-3);
}

TEST(SingularPoints, WhatContactDoesNotReachIsNone) {
  EXPECT_TRUE(points_of({0.5, 0.4}, std::vector<Reach>(9, {false, false}), {}).empty());
}

// Half a wedge beside its line of symmetry.
TEST(SingularPoints, AWedgesTipOnASymmetryLineIsOne) {
  const auto points = points_of({0.05, 0}, std::vector<Reach>(9, {true, true}), {all_sides, {0}});
  ASSERT_FALSE(points.empty());
  EXPECT_NEAR(points[0].position.x(), 0, 1e-12);
  EXPECT_NEAR(points[0].log_pressure, 210e9 / (1 - 0.09) / 2 * 2 * std::atan(0.05) / 4, 1e-3 * points[0].log_pressure);
}

// ---- More than two bodies at a place ----

// The faces of each body lie on those of its neighbours, all around or from a free face to another; each pair knows
// its own two, as its first and second curve in either order, none at quite the same place.
TEST(SingularPoints, OfSeveralBodiesAtAPlaceAreThoseOfAllThatAreInContact) {
  std::mt19937 random(8);
  TipTable tips;
  for (int k = 0; k < 40; ++k) {
    const int count = 3 + k % 3;
    const bool closed = k % 2 == 0;
    Fan fan{{}, std::vector<Joint>(count - (closed ? 0 : 1), Joint::sliding)};
    double sum = 0;
    for (int i = 0; i < count; ++i) {
      const double young = draw_power(random, -1, 1), angle = draw(random, 40, 120) * deg;
      sum += fan.wedges.emplace_back(wedge(angle, elastic_law(young, 0.3, {Plane::strain}))).angle;
    }
    for (Wedge& w : fan.wedges) w.angle *= (closed ? 1 : draw(random, 0.6, 1)) * 2 * straight / sum;
    std::vector<std::vector<ContactPlace>> of_pairs;
    for (int i = 0; i < int(fan.joints.size()); ++i) {
      const int next = (i + 1) % count, first = int(random() % 2);
      ContactPlace place{.position = {1e-3 * draw(random, -1, 1), 1e-3 * draw(random, -1, 1)},
                         .bodies = {i, next},
                         .corners = {Corner{fan.wedges[i], true, 0.1}, Corner{fan.wedges[next], true, 0.1}},
                         .joined = {true, false},
                         .one_curve = false,
                         .given_slope = 0,
                         .shortest = 0.1};
      if (first == 1) {
        std::swap(place.bodies[0], place.bodies[1]);
        std::swap(place.corners[0], place.corners[1]);
        std::swap(place.joined[0], place.joined[1]);
      }
      of_pairs.push_back({place});
    }
    std::vector<std::vector<ContactPlace>> soft = of_pairs;
    soft[0][0].soft = true;
    const auto points = singular_points(of_pairs, tips), beside_soft = singular_points(soft, tips);
    for (std::size_t j = 0; j < fan.joints.size(); ++j) {
      const TipExponents exact = exponents(fan, j);
      const double of_all = exact.pressure.real() <= singular_limit ? exact.pressure.real() : 1;
      EXPECT_NEAR(points[j].empty() ? 1 : points[j][0].pressure_exponent, of_all, 1e-6) << k << " " << j;
    }
    const double of_two = end_exponents(fan.wedges[0], fan.wedges[1]).pressure.real();
    EXPECT_NEAR(beside_soft[0].empty() ? 1 : beside_soft[0][0].pressure_exponent, of_two <= singular_limit ? of_two : 1,
                1e-6);
  }
}

// Two parts of one body of two materials, both on another that goes on.
TEST(SingularPoints, OfBondedPartsInContactWithOneBodyAreThoseOfAllThree) {
  std::mt19937 random(12);
  for (int k = 0; k < 20; ++k) {
    const auto of = [&](double angle) {
      return wedge(angle, elastic_law(draw_power(random, -1, 1), 0.3, {Plane::strain}));
    };
    const double angle = draw(random, 40, 140) * deg;
    const Wedge left = of(straight - angle), right = of(angle), base = of(straight);
    ContactPlace of_left{.position = {0, 0},
                         .bodies = {0, 2},
                         .corners = {Corner{left, true, 0.1, 0, 7}, Corner{base, false, 0.1}},
                         .joined = {true, false},
                         .one_curve = false,
                         .given_slope = 0,
                         .shortest = 0.1},
        of_right = of_left;
    of_right.bodies = {1, 2};
    of_right.joined = {false, true};
    of_right.corners[0].wedge = right;
    of_left.corners[0].before = of_right.corners[0].after = Vec2(1, 0);
    of_left.corners[0].bonded = {{1, right}};
    of_right.corners[0].bonded = {{0, left}};
    TipTable tips;
    const auto points = singular_points({{of_left}, {of_right}}, tips);
    const Fan fan{{left, base, right}, {Joint::sliding, Joint::sliding, Joint::bonded}};
    for (const std::size_t pair : {0, 1}) {
      const double exact = exponents(fan, pair).pressure.real();
      EXPECT_NEAR(points[pair].empty() ? 1 : points[pair][0].pressure_exponent, exact > singular_limit ? 1 : exact,
                  1e-6);
    }
  }
}

}  // namespace
}  // namespace mortise
