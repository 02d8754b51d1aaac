#include "solve/coarse_rows.hpp"

namespace mortise {

CoarseRows join_rows(const ComplementarityProblem& fine) {
  CoarseRows c;
  const Eigen::Index m = fine.scale.size(), springs = fine.rhs.size() - m;
  for (int a = 0; a < m; ++a) {
    const bool second = a > 0 && (a < 2 || c.group[a - 1] != c.group[a - 2]);
    if (!(second && fine.unilateral[a] == fine.unilateral[a - 1])) c.unilateral.push_back(fine.unilateral[a]);
    c.group.push_back(int(c.unilateral.size()) - 1);
  }
  const Eigen::Index count = c.unilateral.size();
  c.scale = VecX::Zero(count);
  for (Eigen::Index a = 0; a < m; ++a) c.scale(c.group[a]) += fine.scale(a);

  std::vector<Eigen::Triplet<double>> entries;  // each row's part of its group; the springs stay as they are
  for (Eigen::Index a = 0; a < m; ++a) {
    const int g = c.group[a];
    entries.emplace_back(int(a), g, fine.scale(a) / c.scale(g));
  }
  for (Eigen::Index k = 0; k < springs; ++k) entries.emplace_back(int(m + k), int(count + k), 1.0);
  SparseMatrix P(m + springs, count + springs);
  P.setFromTriplets(entries.begin(), entries.end());
  const MatX half = MatX(fine.compliance.selfadjointView<Eigen::Lower>()) * P;
  c.compliance = P.transpose() * half;
  c.rhs = P.transpose() * fine.rhs;
  c.round_off = fine.round_off;
  return c;
}

}  // namespace mortise
