// The limit that the mortar solve is measured against: one sparse Cholesky solve of the same stiffness by CHOLMOD.
//   mortise_cholmod SCENE.toml [KEY=VALUE...]   prints unknowns, seconds (wall clock) and peak memory (MB)
#include <malloc.h>
#include <sys/resource.h>

#include <Eigen/CholmodSupport>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "app/solve_scene.hpp"
#include "base/stopwatch.hpp"
#include "fem/motion_sets.hpp"
#include "gmsh/load_mesh.hpp"
#include "problem/discretisation.hpp"
#include "solve/dense_kernel.hpp"
#include "solve/threads.hpp"

namespace mortise::bench {
namespace {

// The equations of the bodies alone, on the free unknowns; a spring holds each motion that only contact resists.
struct GroundedSystem {
  SparseMatrix K;  // lower triangle, positive definite
  VecX f;
};

GroundedSystem grounded_system(const Scene& scene) {
  const Mesh mesh = load_mesh(scene.mesh_file, scene.mesh_parameters);
  const Discretisation d = discretise(resolve(scene, mesh), mesh);
  const auto n = d.system.K.cols();
  std::vector<int> reduced(std::size_t(n), -1), free;
  for (int i = 0; i < int(n); ++i) {
    if (d.system.constraints.fixed[i]) continue;
    reduced[i] = int(free.size());
    free.push_back(i);
  }
  const auto motions = free_motions(mesh, d.system.constraints, SparseMatrix(0, n));
  VecX spring = VecX::Zero(n);
  for (const int i : grounding_unknowns(mesh, d.system.constraints, motions)) spring(i) = d.laws.front().young;

  const auto count = Eigen::Index(free.size());
  GroundedSystem system{SparseMatrix(count, count), VecX(count)};
  system.K.reserve(d.system.K.nonZeros());
  for (Eigen::Index j = 0; j < count; ++j) {
    const int column = free[j];
    system.f(j) = d.system.f(column);
    system.K.startVec(j);
    for (SparseMatrix::InnerIterator it(d.system.K, column); it; ++it)
      if (const int i = reduced[it.row()]; i >= 0)
        system.K.insertBack(i, j) = it.value() + (i == j ? spring(column) : 0);
  }
  system.K.finalize();
  return system;
}

// Analysis (AMD), supernodal factorisation and solution: 32-bit indices, everything else CHOLMOD's default.
void solve(const GroundedSystem& system) {
  Eigen::CholmodSupernodalLLT<SparseMatrix> cholesky;
  cholesky.cholmod().nmethods = 1;
  cholesky.cholmod().method[0].ordering = CHOLMOD_AMD;
  cholesky.analyzePattern(system.K);
  apply_solver_threads();
  cholesky.factorize(system.K);
  if (!cholesky.solve(system.f).allFinite() || cholesky.info() != Eigen::Success)
    throw std::runtime_error("CHOLMOD could not solve the grounded system");
}

void run(const std::string& scene, const std::vector<Override>& settings) {
  choose_dense_kernel();
  const GroundedSystem system = grounded_system(read_scene(scene, settings));
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";  // forget the peak so far (man 5 proc)
  Stopwatch watch;
  solve(system);
  const double seconds = watch.lap();
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("%d %.6g %.6g\n", int(system.f.size()), seconds, double(usage.ru_maxrss) / 1024);
}

}  // namespace
}  // namespace mortise::bench

int main(int argc, char** argv) {
  try {
    if (argc < 2) throw std::runtime_error("usage: mortise_cholmod SCENE.toml [KEY=VALUE...]");
    std::vector<mortise::Override> settings;
    for (int i = 2; i < argc; ++i) settings.push_back(mortise::parse_override(argv[i]));
    mortise::bench::run(argv[1], settings);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "mortise_cholmod: %s\n", error.what());
    return 1;
  }
}
