#include "io/gmsh_groups.hpp"

#include <gmsh.h>

#include <map>
#include <set>

#include "base/errors.hpp"
#include "mesh/place.hpp"

namespace mortise {
namespace {

std::string kind_of(int dimension) { return dimension == 2 ? "physical surface" : "physical curve"; }

/// A node of one of the entities, for messages. Its end points count, and a curve that is not meshed has none.
std::string near_entity(int dimension, int entity) {
  std::vector<std::size_t> tags;
  std::vector<double> coordinates;
  std::vector<double> parametric;
  gmsh::model::mesh::getNodes(tags, coordinates, parametric, dimension, entity, true, false);
  if (tags.empty()) return "with no nodes";
  return near_point(Vec2(coordinates[0], coordinates[1]));
}

void check_names(const std::string& file, int dimension, const std::vector<PhysicalGroup>& groups) {
  std::map<std::string, int> tag_of;
  for (const PhysicalGroup& group : groups) {
    const std::string what = kind_of(dimension) + " " + std::to_string(group.tag);
    if (group.name.empty()) {
      const std::string place = group.entities.empty() ? "" : " " + near_entity(dimension, group.entities.front());
      throw InputError(file + ": " + what + place + " has no name; write " +
                       (dimension == 2 ? "Physical Surface" : "Physical Curve") + "(\"name\") = {...}");
    }
    const auto [found, inserted] = tag_of.emplace(group.name, group.tag);
    if (!inserted) {
      throw InputError(file + ": " + what + " and " + std::to_string(found->second) + " have the same name '" +
                       group.name + "'");
    }
  }
}

bool has_cells(int surface) {
  std::vector<int> types;
  gmsh::model::mesh::getElementTypes(types, 2, surface);
  return !types.empty();
}

}  // namespace

std::vector<PhysicalGroup> physical_groups(const std::string& file, int dimension) {
  gmsh::vectorpair dim_tags;
  gmsh::model::getPhysicalGroups(dim_tags, dimension);
  std::vector<PhysicalGroup> groups;
  for (const auto& [dim, tag] : dim_tags) {
    PhysicalGroup group{tag, "", {}};
    gmsh::model::getPhysicalName(dim, tag, group.name);
    gmsh::model::getEntitiesForPhysicalGroup(dim, tag, group.entities);
    // Reversed in a .geo, "Physical Curve("top") = {-3}", is the same curve; named twice counts once.
    std::set<int> entities;
    for (const int entity : group.entities) entities.insert(std::abs(entity));
    group.entities.assign(entities.begin(), entities.end());
    groups.push_back(group);
  }
  check_names(file, dimension, groups);
  return groups;
}

void check_surfaces(const std::string& file, const std::vector<PhysicalGroup>& bodies) {
  if (bodies.empty()) {
    throw InputError(file + ": no physical surface; a body is a Physical Surface(\"name\") = {...}");
  }
  std::map<int, std::string> body_of;
  for (const PhysicalGroup& body : bodies) {
    for (const int surface : body.entities) {
      const auto [found, inserted] = body_of.emplace(surface, body.name);
      if (inserted) continue;
      throw InputError(file + ": surface " + std::to_string(surface) + " " + near_entity(2, surface) +
                       " is in two bodies, '" + found->second + "' and '" + body.name + "'");
    }
  }

  gmsh::vectorpair surfaces;
  gmsh::model::getEntities(surfaces, 2);
  for (const auto& [dim, surface] : surfaces) {
    if (body_of.contains(surface) || !has_cells(surface)) continue;
    throw InputError(file + ": surface " + std::to_string(surface) + " " + near_entity(2, surface) +
                     " is in no physical surface; every meshed surface belongs to a body");
  }
}

}  // namespace mortise
