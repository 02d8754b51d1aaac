// Ranks by PETSc and MPI. Compiled with MORTISE_MPI only.
#include <fcntl.h>
#include <petscvec.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <stdexcept>
#include <string>

#include "base/stopwatch.hpp"
#include "ddm/ranks.hpp"

namespace mortise {
namespace {

constexpr double patience = 10;  // seconds that a rank with an error waits for the others to meet it as well

void must(PetscErrorCode code) {
  if (!code) return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw std::runtime_error("PETSc: " + std::string(text ? text : "error " + std::to_string(code)));
}

void must_send(int code) {
  if (code != MPI_SUCCESS) throw std::runtime_error("MPI: the ranks do not reach each other");
}

// A vector of PETSc's whose entries are an Eigen vector's for a while.
class Placed {
 public:
  Placed(Vec vec, const VecX& values) : vec_(vec) { must(VecPlaceArray(vec_, values.data())); }
  ~Placed() { VecResetArray(vec_); }
  Placed(const Placed&) = delete;
  Placed& operator=(const Placed&) = delete;

 private:
  Vec vec_;
};

// The lowest rank that sees each row; the first of those that none sees.
std::vector<int> owners(Eigen::Index rows, const std::vector<int>& seen, int rank, int ranks) {
  std::vector<int> owner(rows, ranks);
  for (const int row : seen) owner[row] = rank;
  must_send(MPI_Allreduce(MPI_IN_PLACE, owner.data(), int(rows), MPI_INT, MPI_MIN, PETSC_COMM_WORLD));
  for (int& of_row : owner)
    if (of_row == ranks) of_row = 0;
  return owner;
}

// PETSc numbers the rows rank by rank, each rank's in their order.
class PetscRows : public DealtRows {
 public:
  PetscRows(Eigen::Index rows, const std::vector<int>& seen, int rank, int ranks)
      : place_(rows, -1), order_(rows), size_(PetscInt(seen.size())) {
    const std::vector<int> owner = owners(rows, seen, rank, ranks);
    std::vector<int> first(ranks + 1, 0);
    for (const int of_row : owner) ++first[of_row + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<int> number(rows), next = first;
    for (int row = 0; row < rows; ++row) {
      number[row] = next[owner[row]]++;
      order_[number[row]] = row;
    }
    own_.assign(order_.begin() + first[rank], order_.begin() + first[rank + 1]);
    std::vector<PetscInt> numbers;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      place_[seen[k]] = int(k);
      numbers.push_back(number[seen[k]]);
    }
    must(VecCreateMPIWithArray(PETSC_COMM_WORLD, 1, PetscInt(own_.size()), PetscInt(rows), nullptr, &own_vec_));
    must(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, size_, nullptr, &seen_vec_));
    IS indices;
    must(ISCreateGeneral(PETSC_COMM_SELF, size_, numbers.data(), PETSC_COPY_VALUES, &indices));
    must(VecScatterCreate(own_vec_, indices, seen_vec_, nullptr, &to_seen_));
    must(ISDestroy(&indices));
    must(VecScatterCreateToAll(own_vec_, &to_all_, &all_));
  }
  ~PetscRows() override {
    for (Vec* vec : {&own_vec_, &seen_vec_, &all_}) VecDestroy(vec);
    for (VecScatter* scatter : {&to_seen_, &to_all_}) VecScatterDestroy(scatter);
  }

  MatX own(const MatX& whole) const override { return whole(own_, Eigen::all); }

  SparseMatrix own(const SparseRows& whole) const override {
    Triplets entries;
    for (std::size_t k = 0; k < own_.size(); ++k)
      for (SparseRows::InnerIterator it(whole, own_[k]); it; ++it)
        entries.emplace_back(int(k), int(it.col()), it.value());
    SparseMatrix found(own_.size(), whole.cols());
    found.setFromTriplets(entries.begin(), entries.end());
    return found;
  }

  MatX whole(const MatX& own) const override {
    return by_columns(own, Eigen::Index(order_.size()), &PetscRows::whole_column);
  }

  MatX seen(const MatX& own) const override { return by_columns(own, size_, &PetscRows::seen_column); }

  MatX sum_of_seen(const MatX& seen) const override {
    return by_columns(seen, Eigen::Index(own_.size()), &PetscRows::sum_of_seen_column);
  }

  VecX dot(const MatX& a, const MatX& b) const override {
    VecX found = a.cwiseProduct(b).colwise().sum();
    return over_ranks(std::move(found), MPI_SUM);
  }

  VecX largest(const MatX& own) const override { return over_ranks(DealtRows::largest(own), MPI_MAX); }

  std::vector<int> places(const std::vector<int>& rows) const override {
    std::vector<int> found;
    for (const int row : rows) found.push_back(place_[row]);
    return found;
  }

 private:
  MatX by_columns(const MatX& from, Eigen::Index rows, VecX (PetscRows::*to)(const VecX&) const) const {
    MatX found(rows, from.cols());
    for (Eigen::Index k = 0; k < from.cols(); ++k) found.col(k) = (this->*to)(from.col(k));
    return found;
  }

  static VecX over_ranks(VecX values, MPI_Op operation) {
    must_send(MPI_Allreduce(MPI_IN_PLACE, values.data(), int(values.size()), MPI_DOUBLE, operation, PETSC_COMM_WORLD));
    return values;
  }

  VecX whole_column(const VecX& own) const {
    const Placed from(own_vec_, own);
    must(VecScatterBegin(to_all_, own_vec_, all_, INSERT_VALUES, SCATTER_FORWARD));
    must(VecScatterEnd(to_all_, own_vec_, all_, INSERT_VALUES, SCATTER_FORWARD));
    const PetscScalar* values = nullptr;
    must(VecGetArrayRead(all_, &values));
    VecX found(order_.size());
    for (std::size_t k = 0; k < order_.size(); ++k) found(order_[k]) = values[k];
    must(VecRestoreArrayRead(all_, &values));
    return found;
  }

  VecX seen_column(const VecX& own) const {
    VecX found(size_);
    const Placed from(own_vec_, own), to(seen_vec_, found);
    must(VecScatterBegin(to_seen_, own_vec_, seen_vec_, INSERT_VALUES, SCATTER_FORWARD));
    must(VecScatterEnd(to_seen_, own_vec_, seen_vec_, INSERT_VALUES, SCATTER_FORWARD));
    return found;
  }

  VecX sum_of_seen_column(const VecX& seen) const {
    VecX sum = VecX::Zero(own_.size());
    const Placed from(seen_vec_, seen), to(own_vec_, sum);
    must(VecScatterBegin(to_seen_, seen_vec_, own_vec_, ADD_VALUES, SCATTER_REVERSE));
    must(VecScatterEnd(to_seen_, seen_vec_, own_vec_, ADD_VALUES, SCATTER_REVERSE));
    return sum;
  }

  std::vector<int> place_, order_, own_;
  PetscInt size_;
  Vec own_vec_ = nullptr, seen_vec_ = nullptr, all_ = nullptr;
  VecScatter to_seen_ = nullptr, to_all_ = nullptr;
};

// A file in memory that keeps what is written to the standard error.
int keep_standard_error() {
  const int kept = memfd_create("standard error", MFD_CLOEXEC), nothing = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (kept < 0 || nothing < 0) throw std::runtime_error("the standard error cannot be kept");
  dup2(nothing, STDOUT_FILENO);
  dup2(kept, STDERR_FILENO);
  close(nothing);
  return kept;
}

class PetscRanks : public Ranks {
 public:
  PetscRanks() {
    // Signals and errors end a rank as they end mortise: by an exception or by the system, told once.
    must(PetscOptionsSetValue(nullptr, "-no_signal_handler", "true"));
    must(PetscInitialize(nullptr, nullptr, nullptr, nullptr));
    must(PetscPushErrorHandler(PetscIgnoreErrorHandler, nullptr));
    must_send(MPI_Comm_set_errhandler(PETSC_COMM_WORLD, MPI_ERRORS_RETURN));
    must_send(MPI_Comm_dup(PETSC_COMM_WORLD, &ends_));
    must_send(MPI_Comm_rank(PETSC_COMM_WORLD, &rank_));
    must_send(MPI_Comm_size(PETSC_COMM_WORLD, &count_));
    must_send(MPI_Type_contiguous(sizeof(Triplets::value_type), MPI_BYTE, &triplet_));
    must_send(MPI_Type_commit(&triplet_));
    if (rank_ == 0) return;
    terminal_ = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
    kept_ = keep_standard_error();
  }

  int rank() const override { return rank_; }
  int count() const override { return count_; }

  void sum(double* values, Eigen::Index count) const override {
    must_send(MPI_Allreduce(MPI_IN_PLACE, values, int(count), MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD));
  }

  int largest(int value) const override {
    must_send(MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_INT, MPI_MAX, PETSC_COMM_WORLD));
    return value;
  }

  Triplets of_all(Triplets own) const override {
    int count = int(own.size());
    std::vector<int> counts(count_), first(count_);
    must_send(MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, PETSC_COMM_WORLD));
    std::exclusive_scan(counts.begin(), counts.end(), first.begin(), 0);
    Triplets all(first.back() + counts.back());
    must_send(MPI_Allgatherv(own.data(), count, triplet_, all.data(), counts.data(), first.data(), triplet_,
                             PETSC_COMM_WORLD));
    return all;
  }

  std::unique_ptr<const DealtRows> deal(Eigen::Index rows, const std::vector<int>& seen) const override {
    return std::make_unique<PetscRows>(rows, seen, rank_, count_);
  }

  // The first rank that failed tells it; the first of all has done so already. A rank that failed while others go on
  // ends them.
  int end(int status) override {
    const bool failed = status == 1 || status == 3;
    int first = failed ? rank_ : count_;
    MPI_Request request;
    MPI_Iallreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, ends_, &request);
    int all_here = 0;
    const Stopwatch watch;
    while (MPI_Test(&request, &all_here, MPI_STATUS_IGNORE), !all_here && !(failed && watch.elapsed() > patience))
      usleep(1000);
    if (rank_ > 0 && failed && (!all_here || first == rank_)) tell();
    if (!all_here) MPI_Abort(PETSC_COMM_WORLD, status);
    MPI_Type_free(&triplet_);
    MPI_Comm_free(&ends_);
    PetscFinalize();
    return status;
  }

 private:
  void tell() const {
    std::fflush(stderr);
    std::string text(lseek(kept_, 0, SEEK_END), ' ');
    if (pread(kept_, text.data(), text.size(), 0) != ssize_t(text.size())) text = "mortise: it does not say why\n";
    dprintf(terminal_, "mortise: rank %d of %d failed alone\n%s", rank_, count_, text.c_str());
  }

  int rank_ = 0, count_ = 1, terminal_ = STDERR_FILENO, kept_ = -1;
  MPI_Comm ends_ = MPI_COMM_NULL;  // for the last message: a rank may be amid others
  MPI_Datatype triplet_ = MPI_DATATYPE_NULL;
};

}  // namespace

std::unique_ptr<Ranks> petsc_ranks();
std::unique_ptr<Ranks> petsc_ranks() {
  // Without mpirun MPI is not started at all. Open MPI and MPICH tell their processes so.
  for (const char* started : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (std::getenv(started)) return std::make_unique<PetscRanks>();
  return nullptr;
}

}  // namespace mortise
