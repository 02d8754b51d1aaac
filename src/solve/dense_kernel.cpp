#include "solve/dense_kernel.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>

extern "C" {
void openblas_set_num_threads(int threads);
char* openblas_get_config();
char* openblas_get_corename();
// What OpenBLAS's own constructor and destructor call; a build for one processor only has neither.
[[gnu::weak]] void gotoblas_dynamic_init();
[[gnu::weak]] void gotoblas_dynamic_quit();
// What it calls before a fork; absent where its threads are OpenMP's.
[[gnu::weak]] int blas_thread_shutdown_();
}

namespace mortise {
namespace {

constexpr const char* variable = "OPENBLAS_CORETYPE";

// Those that use neither AVX2 nor fused multiply-add.
bool is_old(std::string_view kernel) {
  constexpr std::array<std::string_view, 16> old{
      "Prescott", "Core2",   "Penryn",       "Dunnington", "Nehalem", "Sandybridge", "Atom",       "Nano",
      "Athlon",   "Opteron", "Opteron_SSE3", "Barcelona",  "Bobcat",  "Bulldozer",   "Piledriver", "Steamroller"};
  return std::ranges::find(old, kernel) != old.end();
}

// Of this processor as its system lets it run; null below AVX2.
const char* processor_kernel() {
#ifdef __x86_64__
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return nullptr;
  const bool wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
                    __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
                    __builtin_cpu_supports("avx512vl");
  return wide ? "SkylakeX" : "Haswell";
#else
  return nullptr;
#endif
}

}  // namespace

void choose_dense_kernel() {
  openblas_set_num_threads(1);
  if (blas_thread_shutdown_) blas_thread_shutdown_();
  const char* kernel = processor_kernel();
  if (!kernel || std::getenv(variable) || !is_old(openblas_get_corename())) return;
  if (!gotoblas_dynamic_init || !gotoblas_dynamic_quit) return;
  setenv(variable, kernel, 0);
  gotoblas_dynamic_quit();
  gotoblas_dynamic_init();
  unsetenv(variable);  // programs that this one starts choose for themselves
}

std::string dense_kernel() {
  const std::string config = openblas_get_config();  // "OpenBLAS 0.3.21 NO_LAPACKE DYNAMIC_ARCH ..."
  return config.substr(0, config.find(' ', config.find(' ') + 1)) + " " + openblas_get_corename();
}

}  // namespace mortise
