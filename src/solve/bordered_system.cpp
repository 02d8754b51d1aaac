#include "solve/bordered_system.hpp"

namespace mortise {

BorderedSystem bordered_system(const SaddlePointSystem& s) {
  return bordered_system(s, s.constraints.fixed, s.grounded);
}

BorderedSystem bordered_system(const SaddlePointSystem& s, const std::vector<char>& left_out,
                               const std::vector<int>& grounded) {
  BorderedSystem r;
  const int n = int(s.K.cols());
  std::vector<int> to_reduced(n, -1);
  int last_node = -1, block = -1;
  for (int i = 0; i < n; ++i) {
    if (left_out[i]) continue;
    to_reduced[i] = int(r.free.size());
    if (i / 2 != last_node) ++block;
    last_node = i / 2;
    r.free.push_back(i);
    r.blocks.push_back(block);
  }
  std::vector<int> spring(n, -1);
  for (std::size_t k = 0; k < grounded.size(); ++k) spring[grounded[k]] = int(k);

  const int count = int(r.free.size()), m = int(s.B.rows()), border = m + int(grounded.size());
  // The columns below the diagonal, read as rows above it: an entry (i, j) goes to column i, and comes in order.
  const auto for_each_entry = [&](auto visit) {
    for (int j = 0; j < count; ++j) {
      const int column = r.free[j], held = spring[column];
      for (SparseMatrix::InnerIterator it(s.K, column); it; ++it) {
        const int i = to_reduced[it.row()];
        if (i >= 0) visit(i, j, it.value() / s.stiffness_scale + (i == j && held >= 0 ? 1 : 0));
      }
      for (SparseMatrix::InnerIterator it(s.B, column); it; ++it)
        visit(count + int(it.row()), j, it.value() / s.row_scale(it.row()));
      if (held >= 0) visit(count + m + held, j, 1.0);
    }
    for (int i = count; i < count + border; ++i) visit(i, i, border_beta);
  };
  r.matrix.resize(count + border, count + border);
  int* start = r.matrix.outerIndexPtr();
  for_each_entry([&](int i, int, double) { ++start[i + 1]; });
  for (int i = 0; i < count + border; ++i) start[i + 1] += start[i];
  r.matrix.resizeNonZeros(start[count + border]);
  std::vector<int> next(start, start + count + border);
  for_each_entry([&](int i, int j, double value) {
    const int at = next[i]++;
    r.matrix.innerIndexPtr()[at] = j;
    r.matrix.valuePtr()[at] = value;
  });
  return r;
}

}  // namespace mortise
