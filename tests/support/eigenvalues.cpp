#include "support/eigenvalues.hpp"

#include <stdexcept>
#include <string>
#include <utility>

extern "C" void dgeev_(const char* left, const char* right, const int* n, double* a, const int* lda, double* re,
                       double* im, double* vl, const int* ldvl, double* vr, const int* ldvr, double* work,
                       const int* lwork, int* info);

namespace mortise::test {

VecX eigenvalue_moduli(MatX A) {
  const int n = int(A.rows()), one = 1, size = 64 * n + 1;
  VecX re(n), im(n), work(size);
  int info = 0;
  dgeev_("N", "N", &n, A.data(), &n, re.data(), im.data(), nullptr, &one, nullptr, &one, work.data(), &size, &info);
  if (info != 0) throw std::runtime_error("dgeev: " + std::to_string(info));
  return (re.array().square() + im.array().square()).sqrt();
}

double spectral_radius(MatX A) { return eigenvalue_moduli(std::move(A)).maxCoeff(); }

}  // namespace mortise::test
