// How figures of a solved scene change with its loads, prescribed values, gaps and moduli.
#pragma once

#include "app/gradient_figures.hpp"
#include "scene/scene.hpp"

namespace mortise {

/// A number of the scene by its dotted key, and what it is.
struct Parameter {
  std::string key;
  double value;
};

struct Gradients {
  VecX values;       ///< of the figures
  MatX derivatives;  ///< figures x parameters: of the contact that is closed, one-sided where a row is about to change
  /// parameters x 2: the values of each, the others as they are, between which no row of contact opens or closes, as
  /// far as the derivatives tell (exactly of loads, prescribed values and gaps that are linear in it); may be infinite.
  MatX between;
};

/// The scene at `path` under overrides and the parameters. Throws InputError.
Scene parametrised(const std::string& path, std::vector<Override> overrides, const std::vector<Parameter>& by);

/// `results`: the solution of parametrised(path, overrides, by). The parameters change f, g, prescribed values and K;
/// by differences of these, which have no error where they are linear, and one substitution each by the factor of the
/// solution (docs/theory.md, section 16). Throws InputError: a figure is none, a parameter is something else or changes
/// the rows of contact, the solution has not converged.
Gradients gradients(const Results& results, const std::string& path, const std::vector<Override>& overrides,
                    const std::vector<Figure>& of, const std::vector<Parameter>& by);

}  // namespace mortise
