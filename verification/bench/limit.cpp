#include "limit.hpp"

#include <Eigen/CholmodSupport>
#include <stdexcept>

#include "fem/motion_sets.hpp"
#include "solve/threads.hpp"

namespace mortise::bench {

GroundedSystem grounded_system(const Mesh& mesh, const Discretisation& d) {
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

VecX cholmod_solution(const GroundedSystem& system) {
  Eigen::CholmodSupernodalLLT<SparseMatrix> cholesky;
  cholesky.cholmod().nmethods = 1;
  cholesky.cholmod().method[0].ordering = CHOLMOD_AMD;
  cholesky.analyzePattern(system.K);
  apply_solver_threads();
  cholesky.factorize(system.K);
  const VecX u = cholesky.solve(system.f);
  if (cholesky.info() != Eigen::Success) throw std::runtime_error("CHOLMOD could not solve the grounded system");
  return u;
}

}  // namespace mortise::bench
