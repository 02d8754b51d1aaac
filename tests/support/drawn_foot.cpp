#include "support/drawn_foot.hpp"

#include <array>
#include <cmath>
#include <sstream>

#include "base/vectors.hpp"
#include "contact/williams.hpp"

namespace mortise::test {
namespace {

constexpr double deg = straight / 180;

}  // namespace

double draw(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
double draw_power(std::mt19937& random, double low, double high) { return std::pow(10, draw(random, low, high)); }

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

std::string name_of(const DrawnFoot& foot) {
  std::ostringstream out;
  for (const auto& piece : foot.pieces)
    out << piece.kind << " " << piece.length << " R " << piece.radius << " then " << piece.turn_to_next / deg << "; ";
  out << "sizes";
  for (const double size : foot.sizes) out << " " << size;
  out << " width " << foot.width << " at " << foot.place << " by " << foot.angle;
  return out.str();
}

}  // namespace mortise::test
