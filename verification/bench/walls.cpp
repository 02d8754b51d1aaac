#include "walls.hpp"

#include <cstdio>

#include "app/solve_scene.hpp"
#include "peak_memory.hpp"
#include "support/wall.hpp"

namespace mortise::bench {
namespace {

void print_row(int n) {
  constexpr int elements = 6;  // along a block, or one more
  const test::Wall wall = test::wall(n, elements);
  const auto solve = [&] {
    Results r = solve_scene(wall.scene, wall.mesh);
    estimate(r);
    return r;
  };
  const double megabytes = peak_megabytes([] {}, [&] { solve(); });
  const Results r = solve();
  const Seconds& s = r.seconds;
  std::printf("%4d x %-4d %7zu %9zu %9d  %8.3f %8.3f %8.3f %8.3f %8.3f %8.3f %8.0f\n", n, n, r.problem.pairs.size(),
              std::size_t(r.solution.lambda.size()), int(r.solution.u.size()), s.assemble, s.couple, s.factorise,
              s.solve, s.recover, s.estimate, megabytes);
  std::fflush(stdout);
}

}  // namespace

void print_walls(int largest) {
  std::printf("\nWalls of blocks, every two that meet in contact (MB: peak).\n\n");
  std::printf("%-11s %7s %9s %9s  %8s %8s %8s %8s %8s %8s %8s\n", "blocks", "pairs", "rows", "unknowns", "assemble",
              "couple", "factor", "solve", "recover", "estimate", "MB");
  for (int n = 5; n <= largest; n *= 2) print_row(n);
}

}  // namespace mortise::bench
