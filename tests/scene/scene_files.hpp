// Scene files for the tests.
#pragma once

#include <string>

#include "scene/scene.hpp"
#include "support/temporary_folder.hpp"

namespace mortise::test {

inline const std::string every_key = R"(title = "Every key"

[mesh]
file = "plates.geo"
parameters = { n_upper = 80, height = 0.25 }

[model]
plane = "stress"

[materials.steel]
young = 210e9
poisson = 0.3

[materials.brass]
young = 100e9
poisson = 0.35
thermal_expansion = 19e-6

[bodies]
upper = "steel"
lower = "brass"
base = "steel"

[[boundary]]
on = ["upper_left", "lower_left"]
displacement = { x = 0 }

[[boundary]]
on = "bottom"
displacement = { x = 0.001, y = -0.002 }

[[boundary]]
on = ["top"]
pressure = 10e6

[[boundary]]
on = ["right"]
traction = [1e6, -2e6]

[[body_force]]
body = "lower"
force = [0, -76e3]

[[initial_strain]]
body = "lower"
temperature_change = 50

[[initial_strain]]
body = "upper"
strain = { xx = 1e-3, yy = 2e-3, xy = 3e-3, zz = 4e-3 }

[[contact]]
between = ["upper_contact", "lower_contact"]
condition = "bilateral"
initial_gap = "closed"
multipliers_on = "lower_contact"

[[contact]]
between = ["lower_base", "base_contact"]

[method]
kind = "ddm"
integration = "elements"
multipliers = "dual"
)";

inline const std::string shortest_scene = R"([mesh]
file = "block.msh"
[materials.steel]
young = 210e9
poisson = 0.3
[bodies]
block = "steel"
)";

/// The shortest scene with `text` after it, read from a file.
inline Scene scene_with(const std::string& text) {
  const TemporaryFolder folder;
  folder.write("block.msh", "");
  return read_scene(folder.write("scene.toml", shortest_scene + text));
}

}  // namespace mortise::test
