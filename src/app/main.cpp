#include "app/command_line.hpp"
#include "ddm/ranks.hpp"

int main(int argc, char** argv) {
  mortise::Ranks& ranks = mortise::join_ranks();
  return ranks.end(mortise::run_command_line(argc, argv));
}
