#include "app/command_line.hpp"
#include "solve/dense_kernel.hpp"

int main(int argc, char** argv) {
  mortise::choose_dense_kernel();
  return mortise::run_command_line(argc, argv);
}
