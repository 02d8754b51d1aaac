#include "model/choices.hpp"

#include <cassert>

namespace mortise {

std::string to_string(Plane value) {
  switch (value) {
    case Plane::strain:
      return "strain";
    case Plane::stress:
      return "stress";
    case Plane::axisymmetric:
      return "axisymmetric";
  }
  assert(false && "no such Plane");
  return {};
}

std::string to_string(Condition value) {
  switch (value) {
    case Condition::unilateral:
      return "unilateral";
    case Condition::bilateral:
      return "bilateral";
    case Condition::tied:
      return "tied";
    case Condition::cyclic:
      return "cyclic";
  }
  assert(false && "no such Condition");
  return {};
}

std::string to_string(InitialGap value) {
  switch (value) {
    case InitialGap::measured:
      return "measured";
    case InitialGap::curve:
      return "curve";
    case InitialGap::given:
      return "given";
    case InitialGap::closed:
      return "closed";
  }
  assert(false && "no such InitialGap");
  return {};
}

std::string to_string(Normals value) {
  switch (value) {
    case Normals::edges:
      return "edges";
    case Normals::curve:
      return "curve";
  }
  assert(false && "no such Normals");
  return {};
}

std::string to_string(Integration value) {
  switch (value) {
    case Integration::segments:
      return "segments";
    case Integration::elements:
      return "elements";
  }
  assert(false && "no such Integration");
  return {};
}

std::string to_string(Goal value) {
  switch (value) {
    case Goal::pressure:
      return "pressure";
    case Goal::peak:
      return "peak";
    case Goal::half_width:
      return "half_width";
    case Goal::mean:
      return "mean";
    case Goal::force:
      return "force";
    case Goal::displacement:
      return "displacement";
    case Goal::stress:
      return "stress";
  }
  assert(false && "no such Goal");
  return {};
}

std::string to_string(Solver value) {
  switch (value) {
    case Solver::direct:
      return "direct";
    case Solver::mssor:
      return "mssor";
    case Solver::ddm:
      return "ddm";
    case Solver::feti:
      return "feti";
  }
  assert(false && "no such Solver");
  return {};
}

std::string to_string(Multipliers value) {
  switch (value) {
    case Multipliers::quadratic:
      return "quadratic";
    case Multipliers::linear:
      return "linear";
    case Multipliers::dual:
      return "dual";
  }
  assert(false && "no such Multipliers");
  return {};
}

std::string to_string(Scheme value) {
  switch (value) {
    case Scheme::neumann_dirichlet:
      return "neumann_dirichlet";
    case Scheme::neumann_neumann:
      return "neumann_neumann";
    case Scheme::dirichlet_dirichlet:
      return "dirichlet_dirichlet";
  }
  assert(false && "no such Scheme");
  return {};
}

std::string to_string(Acceleration value) {
  switch (value) {
    case Acceleration::none:
      return "none";
    case Acceleration::aitken:
      return "aitken";
    case Acceleration::anderson:
      return "anderson";
    case Acceleration::krylov:
      return "krylov";
    case Acceleration::minres:
      return "minres";
  }
  assert(false && "no such Acceleration");
  return {};
}

}  // namespace mortise
