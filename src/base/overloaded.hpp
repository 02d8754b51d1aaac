// One function of several, for std::visit: a kind that none of them takes does not compile.
#pragma once

namespace mortise {

template <typename... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <typename... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

}  // namespace mortise
