#include "limit.hpp"

#include <cholmod.h>

#include <stdexcept>

#include "fem/motion_sets.hpp"
#include "solve/threads.hpp"

namespace mortise::bench {
namespace {

cholmod_sparse view(SparseMatrix& K) {
  cholmod_sparse s{};
  s.nrow = s.ncol = std::size_t(K.cols());
  s.nzmax = std::size_t(K.nonZeros());
  s.p = K.outerIndexPtr();
  s.i = K.innerIndexPtr();
  s.x = K.valuePtr();
  s.stype = -1;
  s.itype = CHOLMOD_INT;
  s.xtype = CHOLMOD_REAL;
  s.dtype = CHOLMOD_DOUBLE;
  s.sorted = s.packed = 1;
  return s;
}

cholmod_dense view(VecX& f) {
  cholmod_dense d{};
  d.nrow = d.nzmax = d.d = std::size_t(f.size());
  d.ncol = 1;
  d.x = f.data();
  d.xtype = CHOLMOD_REAL;
  d.dtype = CHOLMOD_DOUBLE;
  return d;
}

}  // namespace

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

VecX cholmod_solution(GroundedSystem& system) {
  cholmod_common c;
  cholmod_start(&c);
  c.supernodal = CHOLMOD_SUPERNODAL;
  c.nmethods = 1;
  c.method[0].ordering = CHOLMOD_AMD;
  cholmod_sparse K = view(system.K);
  cholmod_dense f = view(system.f);
  cholmod_factor* L = cholmod_analyze(&K, &c);
  apply_solver_threads(c.fl);
  if (L) cholmod_factorize(&K, L, &c);
  cholmod_dense* x = L && c.status == CHOLMOD_OK ? cholmod_solve(CHOLMOD_A, L, &f, &c) : nullptr;
  VecX u;
  if (x) u = Eigen::Map<const VecX>(static_cast<const double*>(x->x), system.f.size());
  cholmod_free_dense(&x, &c);
  cholmod_free_factor(&L, &c);
  cholmod_finish(&c);
  if (u.size() != system.f.size()) throw std::runtime_error("CHOLMOD could not solve the grounded system");
  return u;
}

}  // namespace mortise::bench
