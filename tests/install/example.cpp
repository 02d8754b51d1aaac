// Solves a scene to 1 % and prints the pressure along its contact lines: example scene.toml [KEY=VALUE ...]
#include <iostream>
#include <mortise/scene.hpp>
#include <mortise/solve.hpp>

int main(int argc, char** argv) try {
  std::vector<mortise::Override> changes{{"accuracy.value", "1%"}};
  for (int i = 2; i < argc; ++i) changes.push_back(mortise::parse_override(argv[i]));
  const mortise::Scene scene = mortise::read_scene(argc < 2 ? "scene.toml" : argv[1], changes);

  const std::optional<mortise::Results> results = mortise::solve_to_accuracy(scene);
  for (const std::string& warning : results->warnings) std::cerr << warning << "\n";

  std::cout << "s p bar\n";
  for (const mortise::ContactResults& contact : results->recovery.contacts) {
    for (const mortise::ContactNode& node : contact.multiplier.nodes)
      std::cout << node.s << " " << node.p << " " << node.p_error << "\n";
    std::cout << "mean " << contact.p_mean << "\n";
  }
  return results->status == mortise::Status::solved ? 0 : 2;
} catch (const mortise::InputError& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
