#include "solve/split_cholesky.hpp"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <numeric>

#include "base/parallel.hpp"
#include "solve/splitting.hpp"
#include "solve/threads.hpp"

namespace mortise {
namespace {

// A part to come: one side of a body.
struct Task {
  SplitBody* body;
  char side;
  std::size_t part;
};

// Cuts bodies, the largest first, and hands out their parts: each idle thread takes the largest ready part, or
// cuts the next body where there is none, so that nobody waits for an order (one at a time) while there is other work.
class Agenda {
 public:
  explicit Agenda(const std::vector<std::unique_ptr<SplitBody>>& bodies) {
    for (const auto& body : bodies) {
      uncut_.push_back({body.get(), 0, count_});
      count_ += body->halves();
    }
  }
  std::size_t pieces() const { return uncut_.size() + count_; }
  std::size_t parts() const { return count_; }

  // One piece of work: cut(body) or factorise(task).
  template <typename Cut, typename Factorise>
  void work(Cut cut, Factorise factorise) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return failed_ || !ready_.empty() || next_ < uncut_.size(); });
    if (failed_) return;
    if (const auto task = std::ranges::max_element(ready_, {}, size); task != ready_.end()) {
      const Task own = *task;
      ready_.erase(task);
      lock.unlock();
      return factorise(own);
    }
    const Task own = uncut_[next_++];
    lock.unlock();
    try {
      cut(*own.body);
    } catch (...) {
      lock.lock();
      failed_ = true;  // what waits for its parts would wait for ever
      changed_.notify_all();
      throw;
    }
    lock.lock();
    for (char side = 0; side < own.body->halves(); ++side) ready_.push_back({own.body, side, own.part + side});
    changed_.notify_all();
  }

 private:
  static std::size_t size(const Task& task) { return task.body->unknowns.size() / task.body->halves(); }

  std::vector<Task> uncut_, ready_;
  std::size_t next_ = 0, count_ = 0;
  bool failed_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
};

}  // namespace

template <typename Work>
void SplitCholesky::for_each_part(Work work) const {
  for_each_index(parts_.size(), solver_threads(), [&](std::size_t k) { work(parts_[k]); });
}

SplitCholesky::SplitCholesky(SparseMatrix&& matrix, const std::vector<int>& blocks, int from, int dissect)
    : unknowns_(Eigen::Index(blocks.size())), rows_(matrix.cols() - unknowns_) {
  if (unknowns_ < from || unknowns_ == 0) {
    Part& all = parts_.emplace_back();
    all.unknowns.resize(unknowns_);
    all.border.resize(rows_);
    std::iota(all.unknowns.begin(), all.unknowns.end(), 0);
    std::iota(all.border.begin(), all.border.end(), 0);
    all.factor = std::make_unique<BorderedCholesky>(std::move(matrix), blocks);
    compliance_ = all.factor->take_border_compliance();
    return;
  }
  Splitting splitting(std::move(matrix), blocks, from);
  Agenda agenda(splitting.bodies);
  parts_.resize(agenda.parts());
  for_each_index(agenda.pieces(), solver_threads(), [&](std::size_t) {
    agenda.work([&](SplitBody& body) { splitting.cut(body, dissect); },
                [&](const Task& task) {
                  Part& part = parts_[task.part];
                  SparseMatrix own = splitting.take(*task.body, task.side, part.border);
                  part.unknowns = std::move(task.body->sides[task.side]);
                  part.factor =
                      std::make_unique<BorderedCholesky>(std::move(own), std::move(task.body->order[task.side]));
                });
  });

  // From columns of the whole to places among the separators' unknowns and then the rows.
  std::vector<int> place(unknowns_ + rows_, -1);
  for (const auto& body : splitting.bodies)
    for (const int i : body->sides[separating]) {
      place[i] = int(separator_.size());
      separator_.push_back(i);
    }
  for (Eigen::Index r = 0; r < rows_; ++r) place[unknowns_ + r] = int(separator_.size() + r);
  Eigen::Index first = 0;
  for (Part& part : parts_) {
    part.first = first;
    first += part.size();
    for (int& column : part.border) column = place[column];
  }
  compliance_ = MatX::Zero(separators() + rows_, separators() + rows_);
  for (const auto& body : splitting.bodies)
    for (const auto& entry : body->separated) {
      const auto [row, column] = std::minmax(place[entry.row()], place[entry.col()]);
      compliance_(column, row) -= entry.value();
    }
  for (const Part& part : parts_) compliance_(part.border, part.border) += part.factor->take_border_compliance();
  if (separators() > 0 && failed_at() < 0) eliminate_separators(blocks);
}

void SplitCholesky::eliminate_separators(const std::vector<int>& blocks) {
  const Eigen::Index s = separators(), all = s + rows_;
  SparseMatrix upper(all, all);  // of [S F^T ; F beta]
  for (Eigen::Index j = 0; j < all; ++j) {
    upper.startVec(j);
    for (Eigen::Index i = 0; i <= std::min(j, s - 1); ++i)
      if (const double value = compliance_(j, i); value != 0) upper.insertBack(i, j) = -value;
    if (j >= s) upper.insertBack(j, j) = border_beta;
  }
  upper.finalize();
  compliance_ = compliance_.bottomRightCorner(rows_, rows_).eval();
  std::vector<int> nodes;
  for (Eigen::Index k = 0; k < s; ++k)
    nodes.push_back(nodes.empty() ? 0 : nodes.back() + (blocks[separator_[k]] != blocks[separator_[k - 1]]));
  separator_factor_ = std::make_unique<BorderedCholesky>(std::move(upper), nodes);
  if (separator_factor_->failed_at() < 0) compliance_ += separator_factor_->take_border_compliance();
}

int SplitCholesky::failed_at() const {
  const auto unknown = [&](int place) {
    return place < separators() ? separator_[place] : int(unknowns_ + place - separators());
  };
  for (const Part& part : parts_)
    if (const int at = part.factor->failed_at(); at >= 0)
      return at < int(part.unknowns.size()) ? part.unknowns[at] : unknown(part.border[at - part.unknowns.size()]);
  const int at = separator_factor_ ? separator_factor_->failed_at() : -1;
  return at < 0 ? -1 : unknown(at);
}

Eigen::Index SplitCholesky::size() const {
  return parts_.back().first + parts_.back().size() + (separator_factor_ ? separators() + rows_ : 0);
}

VecX SplitCholesky::at_borders(const VecX& y) const {
  VecX response = VecX::Zero(separators() + rows_);
  for (const Part& part : parts_) response(part.border) += part.factor->at_border(y.segment(part.first, part.size()));
  return response;
}

VecX SplitCholesky::forward(const VecX& f) const {
  VecX y(size());
  for_each_part([&](const Part& part) { y.segment(part.first, part.size()) = part.factor->forward(f(part.unknowns)); });
  if (separator_factor_)
    y.tail(separators() + rows_) = separator_factor_->forward(f(separator_) - at_borders(y).head(separators()));
  return y;
}

VecX SplitCholesky::at_border(const VecX& y) const {
  VecX response = at_borders(y).tail(rows_);
  if (separator_factor_) response += separator_factor_->at_border(y.tail(separators() + rows_));
  return response;
}

MatX SplitCholesky::beside_parts(const MatX& y, const MatX& lambda) const {
  MatX outer(separators() + rows_, lambda.cols());
  if (separator_factor_) outer.topRows(separators()) = separator_factor_->backward(y, lambda);
  outer.bottomRows(rows_) = lambda;
  return outer;
}

MatX SplitCholesky::at_rows(const MatX& lambda) {
  const MatX outer = beside_parts(MatX::Zero(separators() + rows_, lambda.cols()), lambda);
  MatX u(unknowns_, lambda.cols());
  u(separator_, Eigen::all) = outer.topRows(separators());
  for_each_index(parts_.size(), solver_threads(), [&](std::size_t k) {
    Part& part = parts_[k];
    u(part.unknowns, Eigen::all) = part.responses.at(*part.factor, outer(part.border, Eigen::all));
  });
  return u;
}

MatX SplitCholesky::backward(const MatX& y, const MatX& lambda) const {
  const MatX outer = beside_parts(y.bottomRows(separator_factor_ ? separators() + rows_ : 0), lambda);
  MatX u(unknowns_, lambda.cols());
  u(separator_, Eigen::all) = outer.topRows(separators());
  for_each_part([&](const Part& part) {
    u(part.unknowns, Eigen::all) =
        part.factor->backward(y.middleRows(part.first, part.size()), outer(part.border, Eigen::all));
  });
  return u;
}

}  // namespace mortise
