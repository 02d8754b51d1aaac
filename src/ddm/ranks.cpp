#include "ddm/ranks.hpp"

namespace mortise {

#ifdef MORTISE_MPI
std::unique_ptr<Ranks> petsc_ranks();  // ranks_petsc.cpp; none without mpirun
#endif

namespace {

std::unique_ptr<Ranks>& current() {
  static std::unique_ptr<Ranks> ranks = std::make_unique<Ranks>();
  return ranks;
}

}  // namespace

const Ranks& ranks() { return *current(); }

Ranks& join_ranks() {
#ifdef MORTISE_MPI
  if (std::unique_ptr<Ranks> several = petsc_ranks()) current() = std::move(several);
#endif
  return *current();
}

}  // namespace mortise
