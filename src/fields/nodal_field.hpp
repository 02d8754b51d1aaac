// A function of place by its values at the points of a file.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "base/types.hpp"

namespace mortise {

/// By the shape functions of the cells of a .vtu and its array `values`, of which there is one component or
/// `component`, from 0; of a .csv (read_csv_points) by Delaunay's triangles of its points. Beyond the edges of a cell,
/// by up to a tenth of its size, it goes on linearly: so far curved boundaries may be missed. Where cells meet that
/// have different values the first counts. The function may be called by several threads, and throws SceneError
/// that begins with `key` at a place that is further out. Throws InputError here, naming the file: what cannot be read,
/// no such array or column, points on one line.
std::function<double(const Vec2&)> nodal_field(const std::string& key, const std::string& file,
                                               const std::string& values, std::optional<int> component);

}  // namespace mortise
