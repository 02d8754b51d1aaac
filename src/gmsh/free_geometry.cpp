#include "gmsh/free_geometry.hpp"

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <sstream>

#include "base/errors.hpp"
#include "gmsh/far_geometry.hpp"
#include "gmsh/gmsh_groups.hpp"

namespace mortise {
namespace {

std::vector<PhysicalGroup> open_groups() {
  std::vector<PhysicalGroup> groups;
  for (const int dimension : {0, 1, 2}) {
    gmsh::vectorpair found;
    gmsh::model::getPhysicalGroups(found, dimension);
    for (const auto& [dim, tag] : found) groups.push_back({dim, tag, group_name(dim, tag)});
  }
  return groups;
}

// gmsh has no command that takes Transfinite back from a curve of its own kernel.
std::string without_mesh(const std::string& geo) {
  constexpr std::array dropped{"Transfinite ", "Recombine ", "Periodic ", "Field[", "Background Field"};
  std::istringstream lines(geo);
  std::string text;
  for (std::string line; std::getline(lines, line);)
    if (std::ranges::none_of(dropped, [&](const char* word) { return line.starts_with(word); })) text += line + "\n";
  return text;
}

bool is_closed(int curve) {
  gmsh::vectorpair ends;
  gmsh::model::getBoundary({{1, curve}}, ends, false, false);
  return ends.size() == 2 && ends[0] == ends[1];
}

// gmsh writes one Curve Loop with all curves of a surface and sorts them as it reads it: but not those that are loops
// by themselves, which are loops of their own here.
std::string with_loops_apart(const std::string& geo) {
  gmsh::vectorpair surfaces;
  gmsh::model::getEntities(surfaces, 2);
  int last = std::ranges::max(surfaces).second;  // a loop has its surface's tag
  std::istringstream lines(geo);
  std::string text, loops;
  for (std::string line; std::getline(lines, line);) {
    int tag = 0, from = 0;
    if (std::sscanf(line.c_str(), "Curve Loop(%d) = {%n", &tag, &from) == 1 && from > 0) {
      std::string open;
      loops.clear();
      std::istringstream curves(line.substr(from));
      for (int curve = 0; curves >> curve; curves.ignore())
        if (is_closed(std::abs(curve))) {
          text += "Curve Loop(" + std::to_string(++last) + ") = {" + std::to_string(curve) + "};\n";
          loops += ", " + std::to_string(last);
        } else {
          open += (open.empty() ? "" : ", ") + std::to_string(curve);
        }
      line = open.empty() ? "" : "Curve Loop(" + std::to_string(tag) + ") = {" + open + "};";
      loops = open.empty() ? loops.substr(2) : std::to_string(tag) + loops;
    } else if (std::sscanf(line.c_str(), "Plane Surface(%d) = {%n", &tag, &from) == 1 && from > 0) {
      line = line.substr(0, from) + loops + "};";
    }
    text += line + "\n";
  }
  return text;
}

// A geometry of gmsh's own kernel, moved to the origin if it lies far from it. All places are in lines
// "Point(1) = {x, y, z, size};".
Vec2 move_to_origin(std::string& geo) {
  const auto read_point = [](const std::string& line, Vec2& x) {
    int end = 0;
    return std::sscanf(line.c_str(), "Point(%*d) = {%lf , %lf%n", &x.x(), &x.y(), &end) == 2 ? end : 0;
  };
  Box box;
  Vec2 x;
  std::istringstream lines(geo);
  for (std::string line; std::getline(lines, line);)
    if (read_point(line, x) > 0) box.extend(x);
  if (box.isEmpty() || !lies_far(box)) return Vec2::Zero();
  const Vec2 centre = box.center();
  lines = std::istringstream(geo);
  std::ostringstream moved;
  moved.precision(17);
  for (std::string line; std::getline(lines, line);)
    if (const int end = read_point(line, x); end > 0)
      moved << line.substr(0, line.find('{') + 1) << x.x() - centre.x() << ", " << x.y() - centre.y()
            << line.substr(end) << "\n";
    else
      moved << line << "\n";
  geo = moved.str();
  return -centre;
}

void require_drawn(const std::string& file) {
  const auto fail = [&](const std::string& why) { throw InputError(file + ": has no geometry to refine: " + why); };
  gmsh::vectorpair surfaces;
  gmsh::model::getEntities(surfaces, 2);
  if (surfaces.empty()) fail("it draws no surface");
  for (const auto& [dimension, surface] : surfaces) {
    std::string type;
    gmsh::model::getType(dimension, surface, type);
    if (type == "Discrete surface") fail("surface " + std::to_string(surface) + " is a mesh that it reads or makes");
  }
}

// Of gmsh's two kernels.
bool drawn_by_opencascade(const std::string& file) {
  gmsh::vectorpair all, opencascade;
  gmsh::model::getEntities(all, 2);
  gmsh::model::occ::getEntities(opencascade, 2);
  if (!opencascade.empty() && opencascade.size() < all.size())
    throw InputError(file +
                     ": its surfaces are drawn by both the built-in kernel and OpenCASCADE; expected one of them");
  return !opencascade.empty();
}

}  // namespace

FreeGeometry read_free_geometry(GmshSession& session, const std::string& file,
                                const std::map<std::string, double>& parameters) {
  session.read(file, parameters);
  require_drawn(file);
  FreeGeometry geometry{.file = file, .parameters = parameters, .text = {}, .groups = open_groups()};
  if (drawn_by_opencascade(file)) return geometry;
  geometry.text = with_loops_apart(without_mesh(unrolled(session, file)));
  geometry.shift = move_to_origin(geometry.text);
  return geometry;
}

void open_free_geometry(GmshSession& session, const FreeGeometry& geometry) {
  if (geometry.text.empty()) {
    session.read(geometry.file, geometry.parameters);
    session.reset_options();
    gmsh::model::mesh::clear();
    gmsh::model::mesh::removeConstraints();
    gmsh::model::mesh::field::setAsBackgroundMesh(0);
    return;
  }
  session.read_text(geometry.file, geometry.text);
  for (const auto& [dimension, tag, name] : geometry.groups)
    if (!name.empty()) gmsh::model::setPhysicalName(dimension, tag, name);
}

}  // namespace mortise
