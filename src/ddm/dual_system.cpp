#include "ddm/dual_system.hpp"

#include "base/each_once.hpp"
#include "base/parallel.hpp"
#include "solve/threads.hpp"

namespace mortise {
namespace {

constexpr double worth_threads = 2e6;  // multiplications of one product, for threads to be worth their start

}  // namespace

DualSystem::DualSystem(const SaddlePointSystem& s, const std::vector<double>& slenderness) {
  factorise(s, slenderness);
  for (const auto& part : parts_)
    if (failed_at < 0) failed_at = part->failed_at();
  if (failed_at >= 0) return;
  gather(s);
  if (!slender.empty()) {
    TouchingParts touching;
    for (const auto& part : parts_)
      if (part->is_full()) touching.add(slender, part->rows, part->compliance(), part->H, part->springs);
    set_touching(slender, std::move(touching), sharing.diagonal().cwiseProduct(s.row_scale));
  }
  for (const auto& part : parts_) load.parts.push_back(std::move(part->load));
  add_up(1, load);
  load.r -= (s.g - s.B * s.constraints.value).cwiseQuotient(s.row_scale);
}

void DualSystem::factorise(const SaddlePointSystem& s, const std::vector<double>& slenderness) {
  const Substructures all(s);
  std::vector<PartKind> kinds(all.size(), PartKind::compact);
  if (!slenderness.empty())
    for_each_index(all.size(), solver_threads(), [&](std::size_t k) { kinds[k] = kind_of(all[k], slenderness); });
  std::vector<int> rows;
  Triplets stiffness;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (kinds[k] == PartKind::compact) continue;
    const Substructure part = all[k];
    rows.insert(rows.end(), part.rows.begin(), part.rows.end());
    if (kinds[k] == PartKind::slender_with_many_rows) add_stiffness(part, stiffness);
  }
  keep_each_once(rows);
  slender = slender_parts(std::move(rows), std::move(stiffness), s);
  const auto alike = alike_bodies(all, kinds);
  parts_.resize(all.size());
  for_each_index(all.size(), solver_threads(),
                 [&](std::size_t k) { parts_[k] = dual_part(all[k], kinds[k], alike[k].get()); });
}

// `diagonal`, H and `sharing`.
void DualSystem::gather(const SaddlePointSystem& s) {
  const Eigen::Index m = s.B.rows();
  diagonal = VecX::Zero(m);
  Triplets of_H, of_sharing;
  for (const auto& part : parts_) {
    diagonal(part->rows) += part->diagonal;
    for (std::size_t a = 0; a < part->rows.size(); ++a)
      for (std::size_t j = 0; j < part->springs.size(); ++j)
        of_H.emplace_back(part->rows[a], part->springs[j], part->H(a, j));
    const SparseMatrix own = std::exchange(part->sharing, {});
    for_each_entry(own, [&](int i, int j, double value) {
      if (i >= j) of_sharing.emplace_back(part->rows[i], part->rows[j], value);
    });
  }
  H = filled(m, s.grounded.size(), of_H);
  sharing = filled(m, m, of_sharing);
}

void DualSystem::add_up(Eigen::Index count, Answer& answer) const {
  answer.response = MatX::Zero(sharing.rows(), count);
  answer.h = MatX::Zero(H.cols(), count);
  answer.energy = VecX::Zero(count);
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const BodyGroup::Answer& part = answer.parts[k];
    answer.response(parts_[k]->rows, Eigen::all) += part.response;
    answer.h(parts_[k]->springs, Eigen::all) = part.work;
    answer.energy += part.y.colwise().squaredNorm();
  }
  answer.r = answer.response;
}

VecX DualSystem::work_terms(const VecX& h, const VecX& lambda) const {
  return h.cwiseAbs() + H.cwiseAbs().transpose() * lambda.cwiseAbs();
}

SparseMatrix DualSystem::matrix() const {
  const Eigen::Index m = sharing.rows(), size = m + H.cols();
  Triplets entries;
  for (const auto& part : parts_) {
    const MatX C = part->compliance();
    for (std::size_t b = 0; b < part->rows.size(); ++b) {
      for (std::size_t a = 0; a < part->rows.size(); ++a)
        if (part->rows[a] >= part->rows[b]) entries.emplace_back(part->rows[a], part->rows[b], C(a, b));
      for (std::size_t k = 0; k < part->springs.size(); ++k)
        entries.emplace_back(int(m) + part->springs[k], part->rows[b], part->H(b, k));
    }
  }
  return filled(size, size, entries);
}

VecX DualSystem::stiffness() const { return H.cwiseAbs2().transpose() * diagonal.cwiseInverse(); }

namespace {

// The sum over the parts of what each, by its number, makes of the entries of x in its rows. `count`:
// of the rows of a part that count.
template <typename Parts, typename Count, typename Product>
MatX sum_of_products(const Parts& parts, const MatX& x, Count count, Product product) {
  std::vector<MatX> products(parts.size());
  double work = 0;
  for (std::size_t k = 0; k < parts.size(); ++k) work += double(count(k)) * double(count(k)) * double(x.cols());
  for_each_index(parts.size(), work > worth_threads ? solver_threads() : 1,
                 [&](std::size_t k) { products[k] = product(k, MatX(x(parts[k]->rows, Eigen::all))); });
  MatX sum = MatX::Zero(x.rows(), x.cols());
  for (std::size_t k = 0; k < parts.size(); ++k) sum(parts[k]->rows, Eigen::all) += products[k];
  return sum;
}

}  // namespace

MatX DualSystem::multiply(const MatX& lambda) const {
  return sum_of_products(
      parts_, lambda, [&](std::size_t k) { return parts_[k]->rows.size(); },
      [&](std::size_t k, const MatX& own) { return parts_[k]->pressed(own); });
}

std::vector<SomeRows> DualSystem::closed_of_parts(const std::vector<char>& closed) const {
  std::vector<SomeRows> all;
  for (const auto& part : parts_) {
    std::vector<int> rows;
    for (std::size_t a = 0; a < part->rows.size(); ++a)
      if (closed[part->rows[a]]) rows.push_back(int(a));
    all.push_back(part->some(std::move(rows)));
  }
  return all;
}

MatX DualSystem::multiply(const MatX& lambda, const std::vector<SomeRows>& closed) const {
  return sum_of_products(
      parts_, lambda, [&](std::size_t k) { return closed[k].rows.size(); },
      [&](std::size_t k, const MatX& own) { return parts_[k]->pressed(own, closed[k]); });
}

MatX DualSystem::multiply_stiffness(const MatX& x, const std::vector<SomeRows>& closed) const {
  return sum_of_products(
      parts_, x, [&](std::size_t k) { return closed[k].rows.size(); },
      [&](std::size_t k, const MatX& own) { return parts_[k]->stiffened(own, closed[k]); });
}

DualSystem::Answer DualSystem::answer(const MatX& forces) const {
  Answer all;
  all.parts.resize(parts_.size());
  for_each_index(parts_.size(), solver_threads(),
                 [&](std::size_t k) { all.parts[k] = parts_[k]->answer(forces(parts_[k]->unknowns, Eigen::all)); });
  add_up(forces.cols(), all);
  return all;
}

void DualSystem::add_displacements(const Answer& forces, const MatX& lambda, const MatX& mu, Eigen::Ref<MatX> u) const {
  for_each_index(parts_.size(), solver_threads(), [&](std::size_t k) {
    const DualPart& part = *parts_[k];
    u(part.unknowns, Eigen::all) +=
        part.displacements(forces.parts[k], lambda(part.rows, Eigen::all), mu(part.springs, Eigen::all));
  });
}

}  // namespace mortise
