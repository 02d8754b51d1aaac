#include "solve/coarse_rows.hpp"

namespace mortise {

CoarseRows join_rows(const ComplementarityProblem& fine, const VecX& rhs) {
  CoarseRows coarse;
  ComplementarityProblem& c = coarse.problem;
  std::vector<int>& group = coarse.group;
  const Eigen::Index m = fine.scale.size(), springs = rhs.size() - m;
  for (int a = 0; a < m; ++a) {
    const bool second = a > 0 && (a < 2 || group[a - 1] != group[a - 2]);
    if (!(second && fine.unilateral[a] == fine.unilateral[a - 1])) c.unilateral.push_back(fine.unilateral[a]);
    group.push_back(int(c.unilateral.size()) - 1);
  }
  const int count = int(c.unilateral.size());
  c.scale = VecX::Zero(count);
  for (int a = 0; a < m; ++a) c.scale(group[a]) += fine.scale(a);

  Triplets entries;  // each row's part of its group; the springs stay as they are
  for (int a = 0; a < m; ++a) entries.emplace_back(a, group[a], fine.scale(a) / c.scale(group[a]));
  for (int k = 0; k < springs; ++k) entries.emplace_back(int(m) + k, count + k, 1.0);
  const SparseMatrix P = filled(m + springs, count + springs, entries);
  const MatX half = MatX(fine.compliance.selfadjointView<Eigen::Lower>()) * P;
  c.compliance = P.transpose() * half;
  c.round_off = fine.round_off;
  coarse.rhs = P.transpose() * rhs;
  return coarse;
}

}  // namespace mortise
