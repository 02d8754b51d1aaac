#include "app/command_line.hpp"
#include "base/large_pages.hpp"
#include "solve/dense_kernel.hpp"

int main(int argc, char** argv) {
  mortise::use_large_pages();
  mortise::choose_dense_kernel();
  return mortise::run_command_line(argc, argv);
}
