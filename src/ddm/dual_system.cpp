#include "ddm/dual_system.hpp"

#include "base/parallel.hpp"
#include "solve/threads.hpp"

namespace mortise {
namespace {

constexpr double worth_threads = 2e6;  // multiplications of one product, for threads to be worth their start

// W^-1 of a part, n; zero but on contact unknowns.
VecX shares(const SaddlePointSystem& s, const std::vector<int>& contact) {
  const double stiffness = s.K.diagonal().mean() / s.stiffness_scale;
  VecX share = VecX::Zero(s.K.cols());
  for (const int i : contact) {
    double sum = 0, size = 0;
    for (SparseMatrix::InnerIterator it(s.B, i); it; ++it) {
      sum += it.value();
      size += std::abs(it.value());
    }
    share(i) = 1 / (stiffness * std::max(std::abs(sum), 0.1 * size));
  }
  return share;
}

// Y^T S Y, full: S = K_cc - K_ci K_ii^-1 K_ic on contact unknowns, where alone Y has entries. The second term is Z
// K_ii^-1 Z^T with Z = Y^T K_ci, which a factorisation of K_ii with Z for its border gives.
MatX contact_stiffness(const SaddlePointSystem& s, const std::vector<int>& contact, const SparseMatrix& Y) {
  const Eigen::Index m = Y.cols();
  const SparseMatrix KY = (s.K.selfadjointView<Eigen::Lower>() * Y) / s.stiffness_scale;
  MatX stiffness = MatX(SparseMatrix(Y.transpose()) * KY);
  std::vector<char> left_out = s.constraints.fixed;
  for (const int i : contact) left_out[i] = 1;
  SaddlePointSystem inner;
  inner.K = s.K;
  inner.stiffness_scale = s.stiffness_scale;
  inner.B = KY.transpose();
  inner.row_scale = VecX::Ones(m);
  for (const std::vector<int>& springs : {std::vector<int>{}, s.grounded}) {  // few contact nodes hold no part
    BorderedSystem bordered = bordered_system(inner, left_out, springs);
    BorderedCholesky factor(std::move(bordered.matrix), bordered.blocks);
    if (factor.failed_at() >= 0) continue;
    const MatX compliance = factor.take_border_compliance();
    stiffness -= MatX(compliance.topLeftCorner(m, m).selfadjointView<Eigen::Lower>());
    break;
  }
  return stiffness;
}

std::vector<char> all_unknowns(const SaddlePointSystem& s) { return std::vector<char>(s.K.cols(), 1); }

// n x c, a unit column for each.
SparseMatrix unit_columns(Eigen::Index n, const std::vector<int>& unknowns) {
  SparseMatrix units(n, Eigen::Index(unknowns.size()));
  for (std::size_t j = 0; j < unknowns.size(); ++j) units.insert(unknowns[j], Eigen::Index(j)) = 1;
  units.makeCompressed();
  return units;
}

}  // namespace

struct DualSystem::Shared {
  std::vector<int> contact;  // unknowns
  SparseMatrix units;        // n x c
  std::shared_ptr<const BodyGroup> body;
  MatX stiffness;  // c x c

  explicit Shared(SaddlePointSystem s) : contact(contact_unknowns(s)), units(unit_columns(s.K.cols(), contact)) {
    stiffness = contact_stiffness(s, contact, units);
    s.B = units.transpose();
    s.row_scale = VecX::Ones(units.cols());
    body = std::make_shared<BodyGroup>(s, all_unknowns(s));
  }
};

BodyGroup::Answer DualSystem::Part::answer(const VecX& force) const {
  BodyGroup::Answer of_body = body->answer(force);
  if (rows_of_body.cols() > 0) of_body.response = rows_of_body * of_body.response;
  if (slender()) {
    VecX u = VecX::Zero(B.cols());
    body->add_displacements(of_body, VecX(), VecX::Zero(body->motions), u);
    of_body.response = B * u;
  }
  return of_body;
}

VecX DualSystem::Part::pressed(const VecX& lambda) const {
  if (slender()) return answer(B.transpose() * lambda).response;
  return C * lambda;
}

MatX DualSystem::Part::compliance() const {
  if (!slender()) return C;
  MatX all(B.rows(), B.rows());
  for (Eigen::Index a = 0; a < B.rows(); ++a) all.col(a) = pressed(VecX::Unit(B.rows(), a));
  return all;
}

VecX DualSystem::Part::displacements(const BodyGroup::Answer& forces, const VecX& lambda, const VecX& mu) const {
  VecX u = VecX::Zero(unknowns.size());
  if (slender()) {
    BodyGroup::Answer left = forces;
    left.y -= body->answer(B.transpose() * lambda).y;
    body->add_displacements(left, VecX(), mu, u);
  } else {
    body->add_displacements(forces, rows_of_body.cols() > 0 ? VecX(rows_of_body.transpose() * lambda) : lambda, mu, u);
  }
  return u;
}

namespace {

// Whether it takes less than the parts one by one: the borders' squares count, of all contact unknowns or of the rows.
bool worth_sharing(const Substructure& part, std::size_t count) {
  const double c = double(contact_unknowns(part.system).size()), m = double(part.rows.size());
  return count > 1 && c * c <= double(count) * m * m;
}

}  // namespace

DualSystem::DualSystem(const SaddlePointSystem& s) {
  const Eigen::Index m = s.B.rows(), springs = s.grounded.size();
  diagonal = VecX::Zero(m);
  std::vector<Substructure> all = substructures(s, ranks().rank(), ranks().count());
  const std::vector<int> first = first_alike(all);
  std::vector<std::size_t> counts(all.size(), 0);
  for (const int k : first) ++counts[k];
  std::vector<std::optional<Shared>> shared(all.size());
  std::vector<char> bends(all.size());
  for_each_index(all.size(), solver_threads(), [&](std::size_t k) {
    bends[k] = is_slender(all[k]);
    if (!bends[k] && worth_sharing(all[k], counts[k])) shared[k].emplace(all[k].system);
  });
  Triplets slender_stiffness;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (bends[k]) add_stiffness(all[k], slender_stiffness);
  slender = slender_parts(std::move(slender_stiffness), s);

  parts_.resize(all.size());
  load.parts.resize(all.size());
  std::vector<SparseMatrix> sharings(all.size());
  for_each_index(all.size(), solver_threads(), [&](std::size_t k) {
    Substructure& own = all[k];
    const SparseMatrix B = own.system.row_scale.cwiseInverse().asDiagonal() * own.system.B;
    const std::vector<int> contact = contact_unknowns(own.system);
    const SparseMatrix Y = shares(own.system, contact).asDiagonal() * SparseMatrix(B.transpose());
    sharings[k] = B * Y;
    Part& part = parts_[k];
    part.unknowns = std::move(own.unknowns);
    part.rows = std::move(own.rows);
    part.springs = std::move(own.springs);
    const std::optional<Shared>& alike = shared[first[k]];
    if (bends[k]) {
      own.system.B.resize(0, own.system.B.cols());
      own.system.row_scale.resize(0);
      part.body = std::make_shared<const BodyGroup>(own.system, all_unknowns(own.system));
      if (part.body->failed_at >= 0) return;
      part.B = B;
      part.H = part.B * part.body->motion_shapes(part.unknowns.size());
      load.parts[k] = part.answer(load_of(own.system));
    } else if (alike) {
      part.body = alike->body;
      part.rows_of_body = B * alike->units;
      if (part.body->failed_at >= 0) return;
      part.C = part.rows_of_body * MatX(alike->body->C * part.rows_of_body.transpose());
      part.H = part.rows_of_body * alike->body->H;
      const SparseMatrix y = SparseMatrix(alike->units.transpose()) * Y;
      part.stiffness = y.transpose() * MatX(alike->stiffness * y);
      load.parts[k] = part.answer(load_of(own.system));
    } else {
      auto body = std::make_shared<BodyGroup>(own.system, all_unknowns(own.system));
      body->compliance.resize(0, 0);
      part.C = std::move(body->C);
      part.H = std::move(body->H);
      part.stiffness = contact_stiffness(own.system, contact, Y);
      load.parts[k] = std::move(body->load);
      part.body = std::move(body);
    }
    own.system = {};
  });

  Triplets of_H, of_sharing;
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const Part& part = parts_[k];
    if (part.body->failed_at >= 0) {
      failed_at = part.unknowns[part.body->failed_at];
      break;
    }
    diagonal(part.rows) += part.slender() ? VecX(sharings[k].diagonal()) : VecX(part.C.diagonal());
    for (std::size_t a = 0; a < part.rows.size(); ++a)
      for (std::size_t j = 0; j < part.springs.size(); ++j)
        of_H.emplace_back(part.rows[a], part.springs[j], part.H(a, j));
    for (int j = 0; j < sharings[k].cols(); ++j)
      for (SparseMatrix::InnerIterator it(sharings[k], j); it; ++it)
        if (it.row() >= j) of_sharing.emplace_back(part.rows[it.row()], part.rows[j], it.value());
  }
  failed_at = ranks().largest(failed_at);
  if (failed_at >= 0) return;
  diagonal = sum_over_ranks(std::move(diagonal));
  deal_rows(m);
  of_H = ranks().of_all(std::move(of_H));
  SparseRows all_H(m, springs);
  all_H.setFromTriplets(of_H.begin(), of_H.end());
  H = rows_->own(all_H);
  of_sharing = ranks().of_all(std::move(of_sharing));
  sharing.resize(m, m);
  sharing.setFromTriplets(of_sharing.begin(), of_sharing.end());
  if (!slender.empty()) {
    TouchingParts touching;
    for (const Part& part : parts_)
      if (!part.slender()) touching.add(slender, part.rows, part.C, part.H, part.springs);
    set_touching(slender, std::move(touching), sharing.diagonal());
  }
  add_up(load);
  load.r -= (s.g - s.B * s.constraints.value).cwiseQuotient(s.row_scale);
}

void DualSystem::add_up(Answer& answer) const {
  answer.response = VecX::Zero(sharing.rows());
  answer.h = VecX::Zero(H.cols());
  VecX energy = VecX::Zero(1);
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const BodyGroup::Answer& part = answer.parts[k];
    answer.response(parts_[k].rows) += part.response;
    answer.h(parts_[k].springs) = part.work;
    energy(0) += part.y.squaredNorm();
  }
  answer.response = sum_over_ranks(std::move(answer.response));
  answer.h = sum_over_ranks(std::move(answer.h));
  answer.energy = sum_over_ranks(std::move(energy))(0);
  answer.r = answer.response;
}

void DualSystem::deal_rows(Eigen::Index m) {
  std::vector<int> seen;
  for (const Part& part : parts_) seen.insert(seen.end(), part.rows.begin(), part.rows.end());
  std::ranges::sort(seen);
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  rows_ = ranks().deal(m, seen);
  for (Part& part : parts_) part.places = rows_->places(part.rows);
}

VecX DualSystem::sum_over_ranks(VecX sum) {
  ranks().sum(sum.data(), sum.size());
  return sum;
}

VecX DualSystem::work_terms(const VecX& h, const VecX& lambda) const {
  return h.cwiseAbs() + sum_over_ranks(H.cwiseAbs().transpose() * rows_->own(lambda).cwiseAbs());
}

MatX DualSystem::all_openings() const {
  MatX all(sharing.rows(), H.cols());
  for (Eigen::Index k = 0; k < H.cols(); ++k) all.col(k) = rows_->whole(VecX(H.col(k)));
  return all;
}

SparseMatrix DualSystem::matrix() const {
  const Eigen::Index m = sharing.rows(), size = m + H.cols();
  Triplets entries;
  for (const Part& part : parts_) {
    const MatX C = part.compliance();
    for (std::size_t b = 0; b < part.rows.size(); ++b) {
      for (std::size_t a = 0; a < part.rows.size(); ++a)
        if (part.rows[a] >= part.rows[b]) entries.emplace_back(part.rows[a], part.rows[b], C(a, b));
      for (std::size_t k = 0; k < part.springs.size(); ++k)
        entries.emplace_back(int(m) + part.springs[k], part.rows[b], part.H(b, k));
    }
  }
  entries = ranks().of_all(std::move(entries));
  SparseMatrix all(size, size);
  all.setFromTriplets(entries.begin(), entries.end());
  return all;
}

VecX DualSystem::stiffness() const {
  return sum_over_ranks(H.cwiseAbs2().transpose() * rows_->own(diagonal).cwiseInverse());
}

namespace {

// The sum over the parts of what each makes of the entries of x in the places of its rows.
template <typename Parts, typename Product>
VecX sum_of_products(const Parts& parts, const VecX& x, Product product) {
  std::vector<VecX> products(parts.size());
  double work = 0;
  for (const auto& part : parts) work += double(part.rows.size()) * double(part.rows.size());
  for_each_index(parts.size(), work > worth_threads ? solver_threads() : 1,
                 [&](std::size_t k) { products[k] = product(parts[k], VecX(x(parts[k].places))); });
  VecX sum = VecX::Zero(x.size());
  for (std::size_t k = 0; k < parts.size(); ++k) sum(parts[k].places) += products[k];
  return sum;
}

}  // namespace

VecX DualSystem::multiply(const VecX& lambda) const {
  return rows_->sum_of_seen(sum_of_products(
      parts_, rows_->seen(lambda), [](const Part& part, const VecX& own) -> VecX { return part.pressed(own); }));
}

VecX DualSystem::multiply_stiffness(const VecX& x) const {
  return rows_->sum_of_seen(sum_of_products(parts_, rows_->seen(x), [](const Part& part, const VecX& own) -> VecX {
    return part.slender() ? VecX(VecX::Zero(own.size())) : VecX(part.stiffness * own);
  }));
}

DualSystem::Answer DualSystem::answer(const VecX& force) const {
  Answer all;
  all.parts.resize(parts_.size());
  for_each_index(parts_.size(), solver_threads(),
                 [&](std::size_t k) { all.parts[k] = parts_[k].answer(force(parts_[k].unknowns)); });
  add_up(all);
  return all;
}

void DualSystem::add_displacements(const Answer& forces, const VecX& lambda, const VecX& mu, VecX& u) const {
  VecX added = VecX::Zero(u.size());
  for_each_index(parts_.size(), solver_threads(), [&](std::size_t k) {
    const Part& part = parts_[k];
    added(part.unknowns) = part.displacements(forces.parts[k], lambda(part.rows), mu(part.springs));
  });
  ranks().sum(added.data(), added.size());
  u += added;
}

}  // namespace mortise
