// A program that uses an installed mortise: solves a scene and prints the pressure along its contact line.
//   example scene.toml [KEY=VALUE ...]
#include <app/solve_scene.hpp>
#include <base/errors.hpp>
#include <iostream>

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: example scene.toml [KEY=VALUE ...]\n";
    return 1;
  }
  try {
    std::vector<mortise::Override> overrides;
    for (int i = 2; i < argc; ++i) overrides.push_back(mortise::parse_override(argv[i]));
    const mortise::Results results = mortise::solve_scene(mortise::read_scene(argv[1], overrides));
    std::cout << "s p\n";
    for (const mortise::ContactResults& contact : results.contacts) {
      for (const mortise::ContactNode& node : contact.multiplier.nodes) std::cout << node.s << " " << node.p << "\n";
      std::cout << "mean " << contact.p_mean << "\n";
    }
    return results.status == mortise::Status::solved ? 0 : 2;
  } catch (const mortise::InputError& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
