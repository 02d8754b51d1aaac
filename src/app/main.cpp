#include "app/command_line.hpp"
#include "ddm/ranks.hpp"
#include "solve/dense_kernel.hpp"

int main(int argc, char** argv) {
  mortise::choose_dense_kernel();
  mortise::Ranks& ranks = mortise::join_ranks();
  return ranks.end(mortise::run_command_line(argc, argv));
}
