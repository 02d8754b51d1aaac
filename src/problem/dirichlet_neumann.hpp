// Domain decomposition: which bodies take the displacement (Dirichlet) and which the pressure (Neumann).
#pragma once

#include "problem/contact_pair.hpp"

namespace mortise {

/// True for each body that takes the displacement. Bodies in contact play different roles, bodies that share nodes the
/// same. Bodies with one of the `names` take the displacement; where there is none, those softer than their opposites
/// do (the softer body must follow the stiffer one: theory, section 11), and of equally stiff ones those with the finer
/// curve; but not a body whose whole contact curve is prescribed. Throws SceneError where the roles cannot be dealt out
/// so: a ring of an odd number of bodies, a curve against another of the same body, or names that contradict.
std::vector<char> dirichlet_bodies(const std::vector<std::string>& names, const Mesh& mesh,
                                   const Discretisation& discretisation, const std::vector<ContactCurves>& contacts);

/// The names of those that do.
std::vector<std::string> dirichlet_names(const Mesh& mesh, const std::vector<char>& dirichlet);

/// The unknowns of some bodies: one entry each, none of none.
std::vector<char> unknowns_of(const Mesh& mesh, const std::vector<char>& bodies);

}  // namespace mortise
