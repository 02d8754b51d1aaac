// The program of docs/tour.md: what the page shows of it stands here as it is, and it prints what the page says.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <fstream>
#include <iomanip>
#include <sstream>

#include "app/solve_scene.hpp"
#include "app/solve_system.hpp"
#include "contact/segments.hpp"
#include "mortise/scene.hpp"

namespace mortise::test {
namespace {

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The fences of a language, one after another.
std::vector<std::string> fences(const std::string& page, const std::string& language) {
  std::vector<std::string> found;
  const std::string begin = "```" + language + "\n", end = "```";
  for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at)) {
    at += begin.size();
    found.push_back(page.substr(at, page.find(end, at) - at));
  }
  return found;
}

// Whatever its layout.
std::string in_one_line(const std::string& text) {
  std::istringstream words(text);
  std::string line, word;
  while (words >> word) line += word + " ";
  return line;
}

// What the walk prints.
std::string walk() {
  std::ostringstream out;
  out << std::setprecision(4);

  const std::string path = std::string(MORTISE_SOURCE_DIR) + "/geo/parabola_1.toml";
  const Scene scene = read_scene(path, {{"mesh.parameters.n_upper", "8"}, {"mesh.parameters.n_lower", "10"}});
  const Mesh mesh = scene_mesh(scene);
  out << mesh.bodies.size() << " bodies, " << mesh.cells.size() << " cells, " << mesh.nodes.rows() << " nodes\n";

  const Problem problem = prepare(scene, mesh);
  const SaddlePointSystem& system = problem.discretisation.system;
  const std::vector<char>& fixed = system.constraints.fixed;
  out << system.f.size() << " unknowns, " << std::count(fixed.begin(), fixed.end(), 1) << " of them prescribed\n";
  double load = 0;
  for (Eigen::Index i = 1; i < system.f.size(); i += 2) load += system.f(i);
  out << "load along x2: " << load << " N\n";

  const ContactPair& pair = problem.pairs[0];
  out << "multipliers on " << mesh.boundaries[pair.multiplier.boundary].name << ": " << pair.multiplier.edges.size()
      << " edges against " << pair.opposite.edges.size() << ", " << find_segments(mesh.nodes, pair).size()
      << " segments, " << pair.points.size() << " points\n";
  double length = 0;
  for (const ContactPoint& point : pair.points) length += point.ds;
  out << "length that faces the other side: " << length << " m\n";

  const auto lifted = [&](int body) {
    VecX u = VecX::Zero(system.f.size());
    for (int p = problem.points.first[body]; p < problem.points.first[body + 1]; ++p)
      u(2 * problem.points.node[p] + 1) = 1;
    return u;
  };
  const VecX upper = system.B * lifted(pair.opposite.body), lower = system.B * lifted(pair.multiplier.body);
  out << system.B.rows() << " rows of B; lifting the upper body opens them by " << upper.sum()
      << " m^2, the lower one by " << lower.sum() << " m^2\n";

  const double E = system.stiffness_scale;
  MatX K = MatX(system.K).selfadjointView<Eigen::Lower>();
  K /= E;
  MatX B = system.row_scale.cwiseInverse().asDiagonal() * MatX(system.B);
  for (Eigen::Index i = 0; i < K.rows(); ++i)
    if (fixed[i]) K.row(i).setZero(), K.col(i).setZero(), K(i, i) = 1, B.col(i).setZero();
  const int grounded = system.grounded.at(0);
  K(grounded, grounded) += 1;

  const Eigen::LLT<MatX> factor(K);
  const VecX S = VecX::Unit(K.rows(), grounded), free = factor.solve(S), f = system.f / E;
  const MatX C = B * factor.solve(B.transpose());
  out << "spring " << S.dot(free) << "; C is " << C.rows() << " x " << C.cols() << "\n";

  const Eigen::Index m = C.rows();
  MatX bordered = MatX::Zero(m + 1, m + 1);
  bordered.topLeftCorner(m, m) = C;
  bordered.topRightCorner(m, 1) = B * free;
  bordered.bottomLeftCorner(1, m) = bordered.topRightCorner(m, 1).transpose();
  bordered(m, m) = S.dot(free) - 1;
  VecX right(m + 1);
  right << B * factor.solve(f) - system.g.cwiseQuotient(system.row_scale), S.dot(factor.solve(f));
  const VecX lambda = E * bordered.partialPivLu().solve(right).head(m).cwiseQuotient(system.row_scale);

  const Solution solution = SystemSolver(problem).solve();
  const bool same = (lambda - solution.lambda).norm() < 1e-9 * lambda.norm();
  out << "by hand and by the direct solver: " << (same ? "the same" : "not the same") << "\n";

  Results results = solve_scene(scene, mesh);
  estimate(results);
  const ContactResults& contact = results.recovery.contacts[0];
  out << to_string(results.status) << ": force " << contact.force.y() << " N, mean p " << contact.p_mean << " Pa\n";
  for (std::size_t i = 0; i < contact.multiplier.nodes.size(); i += 4) {
    const ContactNode& node = contact.multiplier.nodes[i];
    out << "x1 = " << node.position.x() << ": p = " << node.p / 1e6 << " +- " << node.p_error / 1e6 << " MPa\n";
  }
  return out.str();
}

TEST(Tour, PageShowsThisProgramAndWhatItPrints) {
  const std::string page = text_of(std::string(MORTISE_SOURCE_DIR) + "/docs/tour.md");
  const std::string program = in_one_line(text_of(std::string(MORTISE_SOURCE_DIR) + "/tests/app/tour_test.cpp"));
  const std::vector<std::string> code = fences(page, "cpp");
  EXPECT_GT(code.size(), 6u);
  for (const std::string& shown : code) EXPECT_NE(program.find(in_one_line(shown)), std::string::npos) << shown;
  std::string said;
  for (const std::string& shown : fences(page, "text")) said += shown;
  EXPECT_EQ(said, walk());
}

}  // namespace
}  // namespace mortise::test
