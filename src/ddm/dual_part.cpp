#include "ddm/dual_part.hpp"

#include "base/parallel.hpp"
#include "solve/threads.hpp"

namespace mortise {
namespace {

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

SparseMatrix rows_of(const SaddlePointSystem& s) { return s.row_scale.cwiseInverse().asDiagonal() * s.B; }

// W^-1 B^T.
SparseMatrix shared_out(const SaddlePointSystem& s, const std::vector<int>& contact, const SparseMatrix& B) {
  return shares(s, contact).asDiagonal() * SparseMatrix(B.transpose());
}

// A x on some rows, of an x that is zero on the others. `between`: A's entries there, where these are not all.
MatX product(const MatX& A, const MatX& x, const std::vector<int>& some, const MatX& between) {
  if (Eigen::Index(some.size()) == A.rows()) return A * x;
  MatX product = MatX::Zero(x.rows(), x.cols());
  product(some, Eigen::all) = between * MatX(x(some, Eigen::all));
  return product;
}

// Its compliance and the stiffness of its contact nodes as full matrices of its rows.
class FullPart : public DualPart {
 public:
  MatX pressed(const MatX& lambda) const override { return C_ * lambda; }
  MatX compliance() const override { return C_; }
  SomeRows some(std::vector<int> which) const override {
    if (Eigen::Index(which.size()) == C_.rows()) return {.rows = std::move(which), .C = {}, .stiffness = {}};
    return {.rows = which,
            .C = C_(which, which),
            .stiffness = stiffness_.size() > 0 ? MatX(stiffness_(which, which)) : MatX()};
  }
  MatX pressed(const MatX& lambda, const SomeRows& some) const override {
    return product(C_, lambda, some.rows, some.C);
  }
  MatX stiffened(const MatX& x, const SomeRows& some) const override {
    if (stiffness_.size() == 0) return MatX::Zero(x.rows(), x.cols());
    return product(stiffness_, x, some.rows, some.stiffness);
  }

 protected:
  MatX C_, stiffness_;  // the second empty: of a slender part
};

// With a factor of its own.
class OwnPart : public FullPart {
 public:
  OwnPart(const SaddlePointSystem& s, const std::vector<int>& contact, const SparseMatrix& Y, bool slender) {
    auto body = std::make_shared<BodyGroup>(s, all_unknowns(s));
    body->compliance.resize(0, 0);
    C_ = std::move(body->C);
    diagonal = C_.diagonal();
    H = std::move(body->H);
    if (!slender) stiffness_ = contact_stiffness(s, contact, Y);
    load = std::move(body->load);
    body_ = std::move(body);
  }

  MatX displacements(const BodyGroup::Answer& forces, const MatX& lambda, const MatX& mu) const override {
    return moved(forces, lambda, mu);
  }
};

// With the factor of all that are alike, its rows in unit rows of contact unknowns.
class AlikePart : public FullPart {
 public:
  AlikePart(const SaddlePointSystem& s, const AlikeBody& alike, const SparseMatrix& B, const SparseMatrix& Y)
      : rows_of_body_(B * alike.units) {
    body_ = alike.body;
    if (body_->failed_at >= 0) return;
    C_ = rows_of_body_ * MatX(body_->C * rows_of_body_.transpose());
    diagonal = C_.diagonal();
    H = rows_of_body_ * body_->H;
    const SparseMatrix y = SparseMatrix(alike.units.transpose()) * Y;
    stiffness_ = y.transpose() * MatX(alike.stiffness * y);
    load = answer(load_of(s));
  }

  BodyGroup::Answer answer(const MatX& forces) const override {
    BodyGroup::Answer of_body = body_->answer(forces);
    of_body.response = rows_of_body_ * of_body.response;
    return of_body;
  }
  MatX displacements(const BodyGroup::Answer& forces, const MatX& lambda, const MatX& mu) const override {
    return moved(forces, rows_of_body_.transpose() * lambda, mu);
  }

 private:
  SparseMatrix rows_of_body_;  // rows x contact unknowns
};

// Slender, with many rows: solved for each vector anew, as the body has no rows.
class SolvedPart : public DualPart {
 public:
  SolvedPart(SaddlePointSystem s, SparseMatrix B) : B_(std::move(B)) {
    s.B.resize(0, s.B.cols());
    s.row_scale.resize(0);
    body_ = std::make_shared<const BodyGroup>(s, all_unknowns(s));
    if (body_->failed_at >= 0) return;
    H = B_ * body_->motion_shapes(B_.cols());
    load = answer(load_of(s));
  }

  BodyGroup::Answer answer(const MatX& forces) const override {
    BodyGroup::Answer of_body = body_->answer(forces);
    MatX u = MatX::Zero(B_.cols(), forces.cols());
    body_->add_displacements(of_body, MatX(0, forces.cols()), MatX::Zero(body_->motions, forces.cols()), u);
    of_body.response = B_ * u;
    return of_body;
  }
  MatX pressed(const MatX& lambda) const override { return answer(B_.transpose() * lambda).response; }
  MatX compliance() const override {
    MatX all(B_.rows(), B_.rows());
    for (Eigen::Index a = 0; a < B_.rows(); ++a) all.col(a) = pressed(VecX::Unit(B_.rows(), a));
    return all;
  }
  SomeRows some(std::vector<int> which) const override { return {.rows = std::move(which), .C = {}, .stiffness = {}}; }
  MatX pressed(const MatX& lambda, const SomeRows&) const override { return pressed(lambda); }
  MatX stiffened(const MatX& x, const SomeRows&) const override { return MatX::Zero(x.rows(), x.cols()); }
  bool is_full() const override { return false; }
  MatX displacements(const BodyGroup::Answer& forces, const MatX& lambda, const MatX& mu) const override {
    BodyGroup::Answer left = forces;
    left.y -= body_->answer(B_.transpose() * lambda).y;
    return moved(left, MatX(0, mu.cols()), mu);
  }

 private:
  SparseMatrix B_;
};

// Whether it takes less than the parts one by one: the borders' squares count, of all contact unknowns or of the rows.
bool worth_sharing(const Substructure& part, std::size_t count) {
  const double c = double(contact_unknowns(part.system).size()), m = double(part.rows.size());
  return c * c <= double(count) * m * m;
}

}  // namespace

AlikeBody::AlikeBody(SaddlePointSystem s) : contact(contact_unknowns(s)), units(unit_columns(s.K.cols(), contact)) {
  stiffness = contact_stiffness(s, contact, units);
  s.B = units.transpose();
  s.row_scale = VecX::Ones(units.cols());
  body = std::make_shared<BodyGroup>(s, all_unknowns(s));
}

MatX DualPart::moved(const BodyGroup::Answer& forces, const MatX& lambda, const MatX& mu) const {
  MatX u = MatX::Zero(Eigen::Index(unknowns.size()), mu.cols());
  body_->add_displacements(forces, lambda, mu, u);
  return u;
}

std::vector<std::shared_ptr<const AlikeBody>> alike_bodies(const Substructures& parts,
                                                           const std::vector<PartKind>& kinds) {
  const std::vector<int> first = first_alike(parts);
  std::vector<std::size_t> counts(parts.size(), 0);
  for (const int k : first) ++counts[k];
  std::vector<std::shared_ptr<const AlikeBody>> of_first(parts.size()), bodies(parts.size());
  for_each_index(parts.size(), solver_threads(), [&](std::size_t k) {
    if (kinds[k] != PartKind::compact || counts[k] < 2) return;
    if (Substructure part = parts[k]; worth_sharing(part, counts[k]))
      of_first[k] = std::make_shared<AlikeBody>(std::move(part.system));
  });
  for (std::size_t k = 0; k < parts.size(); ++k) bodies[k] = of_first[first[k]];
  return bodies;
}

std::unique_ptr<DualPart> dual_part(Substructure of, PartKind kind, const AlikeBody* alike) {
  const SparseMatrix B = rows_of(of.system);
  const std::vector<int> contact = contact_unknowns(of.system);
  const SparseMatrix Y = shared_out(of.system, contact, B);
  std::unique_ptr<DualPart> part;
  const VecX row_scale = of.system.row_scale;
  if (kind == PartKind::slender_with_many_rows)
    part = std::make_unique<SolvedPart>(std::move(of.system), B);
  else if (alike)
    part = std::make_unique<AlikePart>(of.system, *alike, B, Y);
  else
    part = std::make_unique<OwnPart>(of.system, contact, Y, kind == PartKind::slender);
  part->unknowns = std::move(of.unknowns);
  part->rows = std::move(of.rows);
  part->springs = std::move(of.springs);
  part->sharing = B * Y;
  if (kind != PartKind::compact) part->diagonal = part->sharing.diagonal().cwiseProduct(row_scale);
  return part;
}

}  // namespace mortise
