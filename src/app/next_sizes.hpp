// What an accuracy asks of the sizes of the next mesh.
#pragma once

#include "error/wanted_sizes.hpp"
#include "gmsh/free_mesher.hpp"
#include "results/results.hpp"

namespace mortise {

/// By which all sizes change where a mesh tells nothing of the next, or is not made.
inline constexpr double another = 1.5;

/// By which part of it p changes as elements at supports at points become a tenth as long (results/point_supports).
double changed_by_point_supports(const Results& results);

/// By which part of it the figure that an accuracy is asked of is off, as estimated; of p with what supports at points,
/// which have no p of a finest mesh, change of it.
double estimated_error(const Results& results, Goal of);

/// Sizes with which that comes to what is asked, in as few meshes as can be. `first`: of all. `aim`: less than 1 where
/// meshes that were to come to it have missed it.
WantedSizes wanted_next(const Results& results, const AccuracySpec& spec, bool first, double aim = 1);

/// The number of unknowns of a mesh with these sizes. `areas`: of the cells.
double expected_unknowns(const Mesh& mesh, const VecX& areas, const SizeField& sizes);

SizeAt scaled(const SizeAt& sizes, double factor);
SizeAt with_layers(const SizeAt& sizes, std::vector<SizeLayers> layers);

/// Edges an eighth as long where the curves of pairs that carry nothing are nearest.
SizeAt small_at_gaps(const Results& results, const SizeAt& sizes);

/// Whether layers ask for edges anywhere that are shorter than sizes do, by more than gmsh's differ from what is asked.
bool are_shorter(const std::vector<SizeLayers>& layers, const SizeAt& sizes);

}  // namespace mortise
