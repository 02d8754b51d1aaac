// A scene as plain data: what the user's .toml says, checked for sense but not yet against a mesh.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/types.hpp"
#include "model/body_copy.hpp"
#include "model/choices.hpp"
#include "model/field.hpp"
#include "model/geo_limits.hpp"
#include "model/model.hpp"
#include "model/moduli.hpp"

namespace mortise {

/// Units are the scene's own, used throughout (SI if E is in Pa and lengths in m).
struct Material {
  double young = 0;                         ///< E, stress, > 0; of a material that is not isotropic the largest
  double poisson = 0;                       ///< nu, -1 < nu < 0.5
  double thermal_expansion = 0;             ///< alpha, 1/K
  double density = 0;                       ///< mass per volume
  std::optional<OrthotropicModuli> moduli;  ///< of an orthotropic material
  std::optional<Mat4> stiffness;            ///< (11, 22, 33, gamma_12), of one that is not isotropic
};

struct BodySpec {
  std::string name;      ///< physical surface
  std::string material;  ///< key of Scene::materials
};

/// Curves that move as a rigid body.
struct RigidSpec {
  std::optional<double> x, y;      ///< prescribed displacement of `about`, length
  std::optional<double> rotation;  ///< prescribed, radians counter-clockwise
  Vec2 force = Vec2::Zero();       ///< at `about`, times depth (model/model.hpp)
  double moment = 0;               ///< the same times length, positive counter-clockwise
  std::optional<Vec2> about;       ///< none: the curves' centre
};

/// One [[boundary]] entry: exactly one of displacement, pressure, traction, force, foundation, spring, rigid.
struct BoundarySpec {
  std::string key;                           ///< where it stands, for messages: "boundary.2 (line 31)", counted from 0
  std::vector<std::string> on;               ///< physical curves; of displacement, force and spring also points
  std::optional<Field> displacement_x;       ///< prescribed u1, length
  std::optional<Field> displacement_y;       ///< prescribed u2, length
  std::optional<Field> displacement_normal;  ///< prescribed u . n, length, n outward
  std::optional<Vec2> direction;             ///< a unit vector, along which
  std::optional<Field> displacement_along;   ///< is prescribed, length
  std::optional<RigidSpec> rigid;
  std::optional<Field> pressure;        ///< positive pushes onto the body, stress
  std::optional<VectorField> traction;  ///< stress
  std::optional<Vec2> force;            ///< sum of a constant traction on all its curves, times depth (model/model.hpp)
  /// Springs to the ground, stress per length, >= 0: along the normal, or along x and y.
  std::optional<Field> normal_foundation;
  std::optional<VectorField> foundation;
  std::optional<Vec2> spring;  ///< to the ground at points, along x and y, force times depth per length, >= 0

  bool is_foundation() const { return normal_foundation || foundation; }
  bool is_skew() const { return displacement_normal || displacement_along; }
  bool is_load() const { return pressure || traction || force; }
};

/// One [[body_force]] entry: force per volume.
struct BodyForceSpec {
  std::string key;
  std::string body;
  VectorField force;
};

/// One [[initial_strain]] entry: a strain, or a temperature change (strain alpha dT in all three directions).
struct InitialStrainSpec {
  std::string key;
  std::string body;
  std::optional<Field> temperature_change;  ///< K
  std::array<Field, 4> strain;              ///< (11, 22, 33, 12), tensor shear strain
};

/// One [[contact]] entry.
struct ContactSpec {
  std::string key;
  /// Physical curves; or patterns (model/patterns.hpp), for all pairs of theirs that face each other.
  std::array<std::string, 2> between;
  std::optional<double> within;  ///< how far apart these may be, length; none: half an edge
  bool found = false;            ///< a pair of a pattern's: its curves need not face each other all along
  Condition condition = Condition::unilateral;
  InitialGap initial_gap = InitialGap::curve;
  Field gap;                   ///< of InitialGap::given: the gap, length: + open, - overlap
  Field clearance;             ///< added to the drawn or measured gap, length
  std::string multipliers_on;  ///< one of `between`; empty: couple_pairs chooses; of a tie the curve that follows
};

/// [method]. The options of a solver count only where it is chosen.
struct Method {
  Integration integration = Integration::segments;
  Normals normals = Normals::curve;
  Multipliers multipliers = Multipliers::linear;  ///< on 2-node edges quadratic means linear
  std::optional<Solver> solver;                   ///< none: direct, or feti where it is faster (app/solve_system.hpp)
  MssorOptions mssor;
  FetiOptions feti;
  DdmOptions ddm;
  std::vector<std::string> dirichlet;  ///< of ddm: bodies that take the displacement; default: the softer ones
};

/// [accuracy]: what the pressure is to be right to, on a mesh that is found for it.
struct AccuracySpec {
  Goal of = Goal::pressure;
  int pair = 0;                ///< of mean and force: the [[contact]] entry, ties not counted
  Vec2 window = Vec2::Zero();  ///< of mean: from, to, arc length s as in contact.csv
  Vec2 at = Vec2::Zero();      ///< of displacement and stress: the place,
  std::string body;            ///< and the body that has it; empty: the only one
  double value = 0;            ///< asked, relative, > 0 and < 1
  double exclude = 0.1;        ///< of the loaded length, on either side of a singular point: left out of the norm
  int unknowns_max = 1000000;
  int solves_max = 8;
  int first_edges = 20;    ///< of the first mesh along each contact curve
  bool recombine = false;  ///< quadrilaterals instead of triangles
};

/// One [[probe]] entry: places at which the solution is told.
struct ProbeSpec {
  std::string key;
  std::vector<Vec2> at;
  bool line = false;  ///< the places are along a straight line, from its start
  std::string body;   ///< that has them; empty: of each the only one
  double angle = 0;   ///< of the axes of the stresses, degrees counter-clockwise from x
};

/// One entry of [fields]: a function of place by its values at the points of a file.
struct FieldSpec {
  std::string key;
  std::string file;                         ///< as Scene::mesh_file
  std::string values;                       ///< the array of a .vtu, the column of a .csv
  std::optional<int> component;             ///< of an array with several, from 0
  std::shared_ptr<NamedFunction> function;  ///< that expressions name; load_fields says what it is
};

struct Scene {
  std::string path;  ///< the .toml, for messages
  std::string title;
  std::string mesh_file;  ///< absolute or relative to the working directory
  std::map<std::string, double> mesh_parameters;
  GeoLimits geo_limits;
  std::vector<BodyCopy> copies;  ///< of bodies of the mesh file, in their place
  std::vector<FieldSpec> fields;
  Model model;
  std::optional<Vec2> gravity;  ///< acceleration: the force per volume is density times it
  std::map<std::string, Material> materials;
  std::vector<BodySpec> bodies;
  std::vector<BoundarySpec> boundaries;
  std::vector<BodyForceSpec> body_forces;
  std::vector<InitialStrainSpec> initial_strains;
  std::vector<ContactSpec> contacts;
  std::vector<ContactSpec> ties;  ///< the [[contact]] entries of Condition::tied
  std::vector<ProbeSpec> probes;
  Method method;
  std::optional<AccuracySpec> accuracy;  ///< none: the mesh is the file's
};

/// One `--set KEY=VALUE`, e.g. {"contact.0.multipliers_on", "lower_contact"}.
struct Override {
  std::string key;
  std::string value;
};

/// "KEY=VALUE" split at the first '='. Throws InputError if there is none or the key is empty.
Override parse_override(const std::string& text);

/// Reads and checks a scene file, with `--set` overrides applied before the checks.
/// Throws InputError naming the file, the line or override, the value and what was expected.
Scene read_scene(const std::string& path, const std::vector<Override>& overrides = {});

}  // namespace mortise
