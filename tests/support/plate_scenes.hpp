// Scenes on the two plates of two_plates.hpp, without files.
#pragma once

#include "scene/scene.hpp"
#include "support/two_plates.hpp"

namespace mortise::test {

/// Bodies of steel, nothing held or loaded.
Scene steel_scene(const std::vector<std::string>& bodies);
/// A body "ring" of patches.hpp from the x axis to the y axis, with 10 MPa in its bore, between lines of symmetry.
Scene bored_scene();
/// Steel, one closed contact pair, nothing held or loaded. Bilateral.
Scene bare_scene();
/// Symmetry on the left, free on the right, rolling bottom, 10 MPa on top: sigma_22 = -10 MPa.
Scene uniaxial_scene();
/// 10 MPa on top and right, symmetry on the left, rolling bottom: sigma_11 = sigma_22 = -10 MPa.
Scene hydrostatic_scene();
/// The preprint's: clamped bottom, symmetry on both sides, 10 MPa on top.
Scene clamped_scene();

}  // namespace mortise::test
