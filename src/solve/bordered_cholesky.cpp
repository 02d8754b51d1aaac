#include "solve/bordered_cholesky.hpp"

#include <cholmod.h>

#include <new>
#include <stdexcept>

#include "base/errors.hpp"
#include "solve/threads.hpp"

extern "C" void dsyrk_(const char* triangle, const char* transposed, const int* n, const int* k, const double* alpha,
                       const double* A, const int* lda, const double* beta, double* C, const int* ldc);

namespace mortise {
namespace {

cholmod_sparse view(SparseMatrix& A) {
  cholmod_sparse s{};
  s.nrow = A.rows();
  s.ncol = A.cols();
  s.nzmax = A.nonZeros();
  s.p = A.outerIndexPtr();
  s.i = A.innerIndexPtr();
  s.x = A.valuePtr();
  s.stype = 1;
  s.itype = CHOLMOD_INT;
  s.xtype = CHOLMOD_REAL;
  s.dtype = CHOLMOD_DOUBLE;
  s.sorted = 1;
  s.packed = 1;
  return s;
}

// The lower triangle of V V^T. Eigen's kernels are compiled for the plain processor, BLAS knows this one: several times
// faster where there is work, slower to call where there is none.
constexpr int blas_from = 100000;  // unknowns

void square(const Eigen::Map<const MatX, 0, Eigen::OuterStride<>>& V, bool by_blas, MatX& product) {
  const int rows = int(V.rows()), columns = int(V.cols()), stride = int(V.outerStride());
  if (!by_blas) {
    product.setZero(rows, rows);
    product.selfadjointView<Eigen::Lower>().rankUpdate(V);
    return;
  }
  const double one = 1, zero = 0;
  product.resize(rows, rows);
  dsyrk_("L", "N", &rows, &columns, &one, V.data(), &stride, &zero, product.data(), &rows);
}

}  // namespace

// The border's rows of a run of columns of K in a supernode.
struct BorderBlock {
  Eigen::Map<const MatX, 0, Eigen::OuterStride<>> V;  // count x columns
  const int* rows;                                    // permuted indices of the rows
  Eigen::Index first_column;                          // permuted
};

struct BorderedCholesky::Factor {
  cholmod_common common;
  cholmod_factor* L = nullptr;  // stays so where there is nothing to factorise
  int n = 0, m = 0;
  int failed_at = -1;

  Factor() { cholmod_start(&common); }
  ~Factor() {
    cholmod_free_factor(&L, &common);
    cholmod_finish(&common);
  }
  const int* perm() const { return static_cast<const int*>(L->Perm); }

  // Calls visit(BorderBlock) for each run of columns of K that has border rows. Parts of K that only the border joins
  // may stand behind border rows that they do not touch, in one supernode with them.
  template <typename Visit>
  void for_each_border_block(Visit visit) const {
    if (!L) return;
    const auto* super = static_cast<const int*>(L->super);
    const auto* pi = static_cast<const int*>(L->pi);
    const auto* px = static_cast<const int*>(L->px);
    const auto* s = static_cast<const int*>(L->s);
    const auto is_border = [&](int permuted) { return perm()[permuted] >= n; };
    for (std::size_t k = 0; k < L->nsuper; ++k) {
      const int rows = pi[k + 1] - pi[k], columns = super[k + 1] - super[k];
      const int* row = s + pi[k];
      const double* block = static_cast<const double*>(L->x) + px[k];
      for (int start = 0, end; start < columns; start = end) {
        end = start + 1;
        while (end < columns && is_border(super[k] + end) == is_border(super[k] + start)) ++end;
        if (is_border(super[k] + start)) continue;
        std::vector<int> border;
        for (int r = end; r < rows; ++r)
          if (is_border(row[r])) border.push_back(r);
        if (border.empty()) continue;
        const int first = border.front(), count = int(border.size());
        const auto at = [&](const double* V, const int* of_V, int stride) {
          visit(BorderBlock{{V, count, end - start, Eigen::OuterStride<>(stride)}, of_V, super[k] + start});
        };
        const double* columns_of_run = block + std::size_t(start) * rows;
        if (border.back() - first == count - 1) {
          at(columns_of_run + first, row + first, rows);
          continue;
        }
        const Eigen::Map<const MatX> all(columns_of_run, rows, end - start);
        const MatX gathered = all(border, Eigen::all);
        std::vector<int> gathered_rows;
        for (const int r : border) gathered_rows.push_back(row[r]);
        at(gathered.data(), gathered_rows.data(), count);
      }
    }
  }

  // By several threads at once, each with a workspace of its own.
  MatX solve(int system, const MatX& b) const {
    if (!L || b.cols() == 0) return b;
    cholmod_dense rhs{};
    rhs.nrow = rhs.d = b.rows();
    rhs.ncol = b.cols();
    rhs.nzmax = b.size();
    rhs.x = const_cast<double*>(b.data());
    rhs.xtype = CHOLMOD_REAL;
    rhs.dtype = CHOLMOD_DOUBLE;
    cholmod_common workspace;
    cholmod_start(&workspace);
    cholmod_dense* x = cholmod_solve(system, L, &rhs, &workspace);
    MatX result;
    if (x) result = Eigen::Map<const MatX>(static_cast<const double*>(x->x), b.rows(), b.cols());
    cholmod_free_dense(&x, &workspace);
    cholmod_finish(&workspace);
    if (result.rows() != b.rows()) throw std::runtime_error("CHOLMOD solve failed");
    return result;
  }
};

BorderedCholesky::BorderedCholesky(SparseMatrix&& matrix, const std::vector<int>& blocks)
    : BorderedCholesky(std::move(matrix), EliminationOrder{block_order(matrix, blocks)}) {}

BorderedCholesky::BorderedCholesky(SparseMatrix&& given, EliminationOrder order) : factor_(std::make_unique<Factor>()) {
  SparseMatrix matrix = std::move(given);  // freed as soon as it is factorised
  Factor& f = *factor_;
  f.n = int(order.unknowns.size());
  f.m = int(matrix.cols()) - f.n;
  compliance_ = MatX::Zero(f.m, f.m);
  if (matrix.cols() == 0) return;  // CHOLMOD refuses it
  cholmod_common& c = f.common;
  c.supernodal = CHOLMOD_SUPERNODAL;
  c.nmethods = 1;
  c.method[0].ordering = CHOLMOD_GIVEN;
  c.print = 0;
  for (int r = f.n; r < int(matrix.cols()); ++r) order.unknowns.push_back(r);  // the border last
  cholmod_sparse A = view(matrix);
  f.L = cholmod_analyze_p(&A, order.unknowns.data(), nullptr, 0, &c);
  if (c.status == CHOLMOD_TOO_LARGE)
    throw InputError(
        "the factor of a body has more than 2^31 entries, as from about ten million unknowns on: the mesh is "
        "too large");
  if (!f.L) throw std::bad_alloc();
  apply_solver_threads();
  cholmod_factorize(&A, f.L, &c);
  if (c.status == CHOLMOD_NOT_POSDEF) {
    f.failed_at = f.perm()[f.L->minor];
    return;
  }
  if (c.status < CHOLMOD_OK) throw std::bad_alloc();
  matrix = SparseMatrix();

  MatX product;
  f.for_each_border_block([&](const BorderBlock& block) {
    const Eigen::Index count = block.V.rows();
    square(block.V, f.n >= blas_from, product);
    for (Eigen::Index j = 0; j < count; ++j)
      for (Eigen::Index i = j; i < count; ++i) {
        const int r = f.perm()[block.rows[i]] - f.n, s = f.perm()[block.rows[j]] - f.n;
        compliance_(std::max(r, s), std::min(r, s)) += product(i, j);
      }
  });
}

BorderedCholesky::~BorderedCholesky() = default;

int BorderedCholesky::failed_at() const { return factor_->failed_at; }

int BorderedCholesky::unknowns() const { return factor_->n; }
Eigen::Index BorderedCholesky::size() const { return factor_->n + factor_->m; }
Eigen::Index BorderedCholesky::entries() const { return factor_->L ? Eigen::Index(factor_->L->xsize) : 0; }

MatX BorderedCholesky::forward(const MatX& f) const {
  const Factor& F = *factor_;
  MatX b = MatX::Zero(F.n + F.m, f.cols());
  for (int k = 0; k < F.n + F.m; ++k)
    if (F.perm()[k] < F.n) b.row(k) = f.row(F.perm()[k]);
  return factor_->solve(CHOLMOD_L, b);
}

MatX BorderedCholesky::at_border(const MatX& y) const {
  const Factor& F = *factor_;
  MatX response = MatX::Zero(F.m, y.cols());
  F.for_each_border_block([&](const BorderBlock& block) {
    const MatX part = block.V * y.middleRows(block.first_column, block.V.cols());
    for (Eigen::Index i = 0; i < part.rows(); ++i) response.row(F.perm()[block.rows[i]] - F.n) += part.row(i);
  });
  return response;
}

MatX BorderedCholesky::backward(MatX y, const MatX& lambda) const {
  const Factor& F = *factor_;
  for (int k = 0; k < F.n + F.m; ++k)
    if (F.perm()[k] >= F.n) y.row(k).setZero();  // so that the border adds nothing in the substitution
  MatX at_rows;
  F.for_each_border_block([&](const BorderBlock& block) {
    at_rows.resize(block.V.rows(), lambda.cols());
    for (Eigen::Index i = 0; i < at_rows.rows(); ++i) at_rows.row(i) = lambda.row(F.perm()[block.rows[i]] - F.n);
    y.middleRows(block.first_column, block.V.cols()).noalias() -= block.V.transpose() * at_rows;
  });
  const MatX x = factor_->solve(CHOLMOD_Lt, y);
  MatX u(F.n, y.cols());
  for (int k = 0; k < F.n + F.m; ++k)
    if (F.perm()[k] < F.n) u.row(F.perm()[k]) = x.row(k);
  return u;
}

}  // namespace mortise
