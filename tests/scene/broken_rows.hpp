// The mistakes of broken_input_test.cpp, a row each.
#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace mortise::test {

/// A mistake made in the scene of scene_files.hpp: `good` is replaced by `bad`, or an override is given.
struct Row {
  std::string name;
  std::string good;                 ///< text of the scene; empty: the mistake is the override `bad`
  std::string bad;                  ///< what stands there instead, or KEY=VALUE
  std::vector<std::string> expect;  ///< what the message must contain
  int line = 0;                     ///< where the message points, in lines after the first of `bad`; -1: no line
};

inline void PrintTo(const Row& row, std::ostream* stream) { *stream << row.bad; }

using Rows = std::vector<Row>;

inline Rows toml_rows() {
  return {
      {"UnitBehindNumber", "young = 210e9", "young = 210e9 Pa", {"not valid TOML"}},
      {"QuoteNotClosed", "kind = \"ddm\"", "kind = \"ddm", {"not valid TOML"}},
      {"KeyTwice", "poisson = 0.3\n", "poisson = 0.3\npoisson = 0.4\n", {"not valid TOML", "poisson"}, 1},
      {"TableTwice", "[method]", "[model]", {"not valid TOML", "model"}},
      {"HeaderIsAComment", "[method]", "[#method]", {"not valid TOML"}},
      {"BareWord", "kind = \"ddm\"", "kind = ddm", {"not valid TOML"}},
      {"UnknownSection", "[model]", "[modle]", {"unknown key 'modle'", "did you mean 'model'"}},
      {"MaterialForMaterials", "[materials.brass]", "[material.brass]", {"unknown key 'material'", "'materials'"}},
      {"UnknownKeyInMesh", "parameters =", "parametres =", {"mesh: unknown key 'parametres'", "'parameters'"}},
      {"UnknownKeyInModel", "plane =", "plain =", {"model: unknown key 'plain'", "'plane'"}},
      {"UnknownKeyInMaterial", "young = 210e9", "yuong = 210e9", {"materials.steel: unknown key 'yuong'", "'young'"}},
      {"UnknownKeyInBoundary", "pressure =", "presure =", {"boundary.2: unknown key 'presure'", "'pressure'"}},
      {"UnknownDisplacement", "{ x = 0 }", "{ z = 0 }", {"boundary.0.displacement: unknown key 'z'", "x, y"}},
      {"UnknownKeyInBodyForce", "force = [0", "forces = [0", {"body_force.0: unknown key 'forces'", "'force'"}},
      {"UnknownKeyInInitialStrain", "strain = {", "strains = {", {"initial_strain.1: unknown key 'strains'"}},
      {"UnknownStrain", "zz = 4e-3", "yx = 4e-3", {"initial_strain.1.strain: unknown key 'yx'", "xy"}},
      {"UnknownKeyInContact", "initial_gap =", "gap_initial =", {"contact.0: unknown key 'gap_initial'"}},
      {"UnknownKeyInMethod", "integration =", "integral =", {"method: unknown key 'integral'", "'integration'"}},
      {"SectionIsNoTable", "title = \"Every key\"\n", "method = 1\n", {"not valid TOML", "method"}, -1},
      {"SingleBracketsForEntries", "[[body_force]]", "[body_force]", {"body_force: expected", "[[body_force]]"}},
      {"TitleIsANumber", "title = \"Every key\"", "title = 10", {"title: expected a string, found 10"}},
      {"LineBreakInAValue", "\"dual\"", "\"du\\nal\"", {"unknown multipliers 'du\\nal'", "'dual'"}},
  };
}

inline Rows mesh_rows() {
  return {
      {"NoMeshFile", "file = \"plates.geo\"\n", "", {"mesh: 'file' is missing", ".geo"}, -1},
      {"MeshFileIsANumber", "\"plates.geo\"", "7", {"mesh.file: expected a name, found 7"}},
      {"MeshFileEmpty", "\"plates.geo\"", "\"\"", {"mesh.file: expected a name, found ''"}},
      {"MeshFileNotThere", "\"plates.geo\"", "\"plate.geo\"", {"plate.geo': no such file", "'plates.geo'"}},
      {"MeshFileIsAFolder", "\"plates.geo\"", "\"folder.geo\"", {"folder.geo': is a folder"}},
      {"MeshFileOfAnotherKind",
       "\"plates.geo\"",
       "\"plates.stl\"",
       {"expected a file that ends in .geo or .msh", "'plates.stl'"}},
      {"ParametersOfAMsh", "\"plates.geo\"", "\"plates.msh\"", {"mesh.parameters.n_upper", "no parameters"}, 1},
      {"ParameterIsAString", "n_upper = 80", "n_upper = \"80\"", {"n_upper: expected a number, found '80'"}},
      {"TimeLimitIsZero", "parameters =", "time_limit = 0\nparameters =", {"mesh.time_limit: expected"}},
      {"ProgramsIsAWord", "parameters =", "programs = 'no'\nparameters =", {"mesh.programs: expected true or false"}},
      {"ParametersAreAList", "{ n_upper = 80, height = 0.25 }", "[80]", {"expected a table, found [80]"}},
      {"NotAPlane", "plane = \"stress\"", "plane = \"stretch\"", {"model.plane: unknown plane 'stretch'", "stress"}},
  };
}

inline Rows material_rows() {
  return {
      {"YoungIsAString", "210e9", "\"210 GPa\"", {"materials.steel.young: expected a number, found '210 GPa'"}},
      {"YoungIsZero", "210e9", "0", {"materials.steel.young: expected a number > 0, found 0"}},
      {"YoungIsNegative", "210e9", "-210e9", {"expected a number > 0, found -2.1e+11"}},
      {"YoungIsInfinite", "210e9", "inf", {"materials.steel.young: expected a finite number, found inf"}},
      {"YoungIsNoNumber", "210e9", "nan", {"expected a finite number, found nan"}},
      {"YoungIsADate", "210e9", "1979-05-27", {"expected a number, found the date or time 1979-05-27"}},
      {"YoungIsABool", "210e9", "true", {"expected a number, found true"}},
      {"YoungMissing", "young = 210e9\n", "", {"materials.steel: 'young' is missing"}, -1},
      {"PoissonMissing", "poisson = 0.3\n", "", {"materials.steel: 'poisson' is missing"}, -1},
      {"PoissonIsAHalf", "poisson = 0.3\n", "poisson = 0.5\n", {"between -1 and 0.5 (both excluded), found 0.5"}},
      {"PoissonBelowMinusOne", "poisson = 0.3\n", "poisson = -1\n", {"between -1 and 0.5", "found -1"}},
      {"YoungOfTwoDirections",
       "young = 210e9",
       "young = [1, 2]",
       {"materials.steel.young: expected a number, or a list of three"}},
      {"PoissonOfOneDirection",
       "young = 210e9",
       "young = [3, 2, 1]",
       {"materials.steel.poisson: expected a list of three"},
       1},
      {"ShearMissing",
       "young = 210e9\npoisson = 0.3",
       "young = [3, 2, 1]\npoisson = [0.3, 0.3, 0.3]",
       {"materials.steel: 'shear' is missing", "G12"},
       -1},
      {"RatiosOfNoMaterial",
       "young = 210e9\npoisson = 0.3",
       "young = [1, 1, 1]\nshear = 1\npoisson = [1.1, 0.3, 0.3]",
       {"materials.steel.poisson: found ratios", "negative energy"},
       2},
      {"StiffnessOfThreeRows",
       "young = 210e9\npoisson = 0.3",
       "stiffness = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]",
       {"materials.steel.stiffness: expected a symmetric matrix"}},
      {"StiffnessThatIsNotSymmetric",
       "young = 210e9\npoisson = 0.3",
       "stiffness = [[3, 1, 0, 0], [1.01, 3, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]",
       {"materials.steel.stiffness: expected a symmetric matrix"}},
      {"StiffnessWithoutEnergy",
       "young = 210e9\npoisson = 0.3",
       "stiffness = [[1, 2, 0, 0], [2, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]",
       {"materials.steel.stiffness: gives some strains no positive energy"}},
      {"ThicknessOfNothing", "", "model.thickness=0", {"model.thickness", "> 0"}},
      {"ThicknessOfRings",
       "",
       "model={plane=\"axisymmetric\",thickness=1}",
       {"model.thickness: an axisymmetric model has none"}},
      {"PoissonInPercent", "poisson = 0.3\n", "poisson = 30\n", {"materials.steel.poisson", "found 30"}},
      {"MaterialIsANumber", "[model]", "[materials]\niron = 1\n[model]", {"materials.iron: expected a table"}, 1},
      {"UnknownMaterial", "lower = \"brass\"", "lower = \"bras\"", {"bodies.lower: unknown material", "'brass'"}},
      {"MaterialOfABodyIsANumber", "lower = \"brass\"", "lower = 3", {"bodies.lower: expected a name, found 3"}},
      {"MaterialUnused",
       "[materials.brass]",
       "[materials.iron]\nyoung = 1e11\npoisson = 0\n[materials.brass]",
       {"materials.iron: no body has the material 'iron'"}},
      {"NoBodies", "upper = \"steel\"\nlower = \"brass\"\nbase = \"steel\"\n", "", {"bodies: is empty"}, -1},
      {"BodyWithoutName", "base =", "\"\" =", {"the name of the body is empty"}},
  };
}

inline Rows load_rows() {
  return {
      {"OnMissing", "on = [\"top\"]\n", "", {"boundary.2: 'on' is missing"}, -1},
      {"OnEmpty", "[\"top\"]", "[]", {"boundary.2.on: expected a list of names, found []"}},
      {"OnHoldsANumber", "[\"top\"]", "[\"top\", 1]", {"boundary.2.on.1: expected a name, found 1"}},
      {"NothingGiven", "pressure = 10e6\n", "", {"expected exactly one of 'displacement', 'pressure'"}, -1},
      {"TwoGiven", "pressure = 10e6", "pressure = 10e6\ntraction = [0, 1]", {"boundary.2", "exclude each other"}, 1},
      {"CurveTwiceInOneEntry", "[\"top\"]", "[\"top\", \"top\"]", {"curve 'top' is named twice", "boundary.2"}},
      {"TwoLoads", "[\"right\"]", "[\"top\"]", {"curve 'top' carries a load twice", "boundary.2 (line 32)"}},
      {"SameDisplacementTwice",
       "[\"upper_left\",",
       "[\"bottom\",",
       {"boundary.1.on: curve 'bottom' is given displacement.x twice", "boundary.0"},
       4},
      {"DisplacementIsABool", "{ x = 0 }", "{ x = true }", {"displacement.x: expected a number or an expression"}},
      {"DisplacementOfZ",
       "{ x = 0 }",
       "{ x = \"z\" }",
       {"boundary.0.displacement.x: 'z', character 1: unknown name 'z'", "known: x, y, r, theta, s, pi"}},
      {"DisplacementIsANumber", "{ x = 0 }", "0", {"boundary.0.displacement: expected a table, found 0"}},
      {"SeveralDirections",
       "{ x = 0 }",
       "{ x = 0, normal = 0 }",
       {"boundary.0.displacement: names several directions"}},
      {"StiffnessOfADirection",
       "{ x = 0 }",
       "{ normal = 0 }\nstiffness = true",
       {"boundary.0.stiffness: is that of a support; expected it with rigid, or displacement = { x, y }"},
       1},
      {"DirectionWithoutLength", "{ x = 0 }", "{ direction = [0, 0], value = 1 }", {"direction: has no length"}},
      {"DirectionWithoutValue", "{ x = 0 }", "{ direction = [1, 0] }", {"value"}},
      {"ValueWithoutDirection", "{ x = 0 }", "{ value = 1 }", {"direction"}},
      {"SpringThatPushes", "pressure = 10e6", "spring = [1, -1]", {"boundary.2.spring: expected a stiffness > 0"}},
      {"SpringOfNothing", "pressure = 10e6", "spring = 0", {"boundary.2.spring: expected a stiffness > 0"}},
      {"UnknownKeyInRigid", "pressure = 10e6", "rigid = { turn = 1 }", {"boundary.2.rigid: unknown key 'turn'"}},
      {"RigidAndPressure", "pressure = 10e6", "pressure = 10e6\nrigid = {}", {"exclude each other"}, -1},
      {"DisplacementEmpty", "{ x = 0 }", "{}", {"boundary.0.displacement: is empty; expected x, y or both"}},
      {"DisplacementInfinite", "{ x = 0 }", "{ x = -inf }", {"expected a finite number, found -inf"}},
      {"PressureIsAList", "10e6", "[10e6]", {"boundary.2.pressure: expected a number or an expression, found [1e+07]"}},
      {"PressureIsNoExpression", "10e6", "\"10e6 Pa\"", {"'10e6 Pa', character 6: unknown name 'Pa'"}},
      {"PressureIsEmpty", "10e6", "\"\"", {"boundary.2.pressure: '', character 1: expression is empty"}},
      {"ForceAndPressure", "pressure = 10e6", "pressure = 10e6\nforce = [0, 1]", {"exclude each other"}, 1},
      {"FoundationIsATable", "pressure = 10e6", "foundation = {}", {"boundary.2.foundation: expected a number or an"}},
      {"TemperatureOfS", "temperature_change = 50", "temperature_change = \"s\"", {"known on curves only"}},
      {"StrainOfZ", "yy = 2e-3", "yy = \"z\"", {"initial_strain.1.strain.yy: 'z', character 1: unknown name"}},
      {"TotalForceIsANumber", "pressure = 10e6", "force = 1", {"boundary.2.force: expected a list of two numbers"}},
      {"PressureAboveYoung", "10e6", "10e15", {"boundary.2.pressure", "(line 11)", "1e+16", "unit mismatch"}},
      {"TractionOfThree", "[1e6, -2e6]", "[1e6, -2e6, 0]", {"numbers or expressions [x, y], found [1e+06, -2e+06, 0]"}},
      {"TractionAboveYoung", "[1e6, -2e6]", "[0, -2e12]", {"boundary.3.traction", "unit mismatch"}},
      {"ForceOnUnknownBody",
       "body = \"lower\"\nforce",
       "body = \"lowr\"\nforce",
       {"body_force.0.body: unknown body 'lowr'; did you mean 'lower'"}},
      {"ForceOnNoBody", "body = \"lower\"\nforce", "force", {"body_force.0: 'body' is missing"}, -1},
      {"ForceIsANumber", "[0, -76e3]", "-76e3", {"body_force.0.force: expected a list of two numbers"}},
      {"ForceTwice",
       "[0, -76e3]\n",
       "[0, 1]\n[[body_force]]\nbody = \"lower\"\nforce = [1, 1]\n",
       {"body 'lower' is given a body force twice", "body_force.0"},
       2},
      {"StrainOfUnknownBody",
       "body = \"upper\"",
       "body = \"uper\"",
       {"initial_strain.1.body: unknown body", "'upper'"}},
      {"StrainTwice", "body = \"upper\"", "body = \"lower\"", {"'lower' is given an initial strain twice"}},
      {"StrainAndTemperature",
       "temperature_change = 50",
       "temperature_change = 50\nstrain = { xx = 0.1 }",
       {"initial_strain.0", "exclude each other"},
       1},
      {"StrainOfOne", "yy = 2e-3", "yy = 1", {"initial_strain.1.strain.yy: expected a strain below 1, found 1"}},
      {"StrainEmpty", "{ xx = 1e-3, yy = 2e-3, xy = 3e-3, zz = 4e-3 }", "{}", {"initial_strain.1.strain: is empty"}},
      {"NoThermalExpansion", "thermal_expansion = 19e-6\n", "", {"temperature_change: body 'lower'", "brass"}, -1},
      {"ThermalStrainAboveOne", "temperature_change = 50", "temperature_change = 1e5", {"unit mismatch", "1.9e-05"}},
  };
}

inline Rows contact_rows() {
  return {
      {"BetweenMissing", "between = [\"lower_base\", \"base_contact\"]\n", "", {"contact.1: 'between' is missing"}, -1},
      {"BetweenOfOne", "[\"lower_base\", \"base_contact\"]", "[\"lower_base\"]", {"expected a list of two names"}},
      {"BetweenItself", "\"base_contact\"", "\"lower_base\"", {"two different curves", "'lower_base' twice"}},
      {"PairTwice",
       "[\"lower_base\", \"base_contact\"]",
       "[\"upper_contact\", \"lower_contact\"]",
       {"contact.1.between.0: the pair of 'lower_contact' and 'upper_contact' stands twice", "contact.0 (line 52)"}},
      {"WithinOfNamedCurves",
       "\"bilateral\"",
       "\"bilateral\"\nwithin = 1",
       {"contact.0.within: goes with between = patterns"},
       1},
      {"NotACondition", "\"bilateral\"", "\"bilaterl\"", {"unknown condition 'bilaterl'", "did you mean 'bilateral'"}},
      {"ConditionIsABool", "\"bilateral\"", "true", {"contact.0.condition: expected a string, found true"}},
      {"NotAnInitialGap", "\"closed\"", "\"close\"", {"unknown initial_gap 'close'", "'closed'"}},
      {"InitialGapNotFinite", "\"closed\"", "nan", {"contact.0.initial_gap", "a finite number"}},
      {"InitialGapIsAList", "\"closed\"", "[1e-3]", {"contact.0.initial_gap", "a length, an expression or a word"}},
      {"InitialGapOfZ", "\"closed\"", "\"1e-3 * z\"", {"contact.0.initial_gap: '1e-3 * z', character 8", "'z'"}},
      {"ClearanceOfClosed", "\"closed\"", "\"closed\"\nclearance = 1e-3", {"contact.0.clearance: is added"}, 1},
      {"ClearanceOfAGap", "\"closed\"", "1e-3\nclearance = 1e-3", {"initial_gap = 0.001; expected one of them"}, 1},

      {"MultipliersOnNeither",
       "multipliers_on = \"lower_contact\"",
       "multipliers_on = \"lower_base\"",
       {"contact.0.multipliers_on: unknown curve of this pair 'lower_base'", "upper_contact, lower_contact"}},
      {"NotAMethod", "kind = \"ddm\"", "kind = \"ddn\"", {"method.kind: unknown kind 'ddn'", "'ddm'"}},
      {"NotAnIntegration", "\"elements\"", "\"element\"", {"unknown integration 'element'", "'elements'"}},
      {"NotMultipliers", "\"dual\"", "\"cubic\"", {"unknown multipliers 'cubic'", "quadratic, linear, dual"}},
  };
}

inline Rows solver_rows() {
  const std::string kind = "kind = \"ddm\"", mortar = "kind = \"mortar\"\n", mssor = mortar + "solver = \"mssor\"\n";
  return {
      {"NotASolver", kind, mortar + "solver = \"msor\"", {"method.solver: unknown solver 'msor'", "'mssor'"}, 1},
      {"MssorInDdm",
       kind,
       kind + "\nsolver = \"mssor\"",
       {"method.solver: kind = \"ddm\" and solver = \"mssor\" contradict"},
       1},
      {"OmegaOfNoSolver", kind, mortar + "omega = 1", {"method.omega: belongs", "expected solver = \"mssor\""}, 1},
      {"TauInDdm", kind, kind + "\ntau = 1", {"method.tau: belongs", "expected solver = \"mssor\""}, 1},
      {"OmegaIsTwo", kind, mssor + "omega = 2", {"method.omega", "0 and 2 (both excluded), found 2"}, 2},
      {"OmegaIsAuto", kind, mssor + "omega = \"auto\"", {"method.omega: expected a number, found 'auto'"}, 2},
      {"TauIsZero", kind, mssor + "tau = 0", {"method.tau: expected a number > 0, found 0"}, 2},
      {"AndersonWithMssor", kind, mssor + "acceleration = \"anderson\"", {"'anderson'", "none, krylov, minres"}, 2},
      {"MinresInDdm", kind, kind + "\nacceleration = \"minres\"", {"unknown acceleration 'minres'", "krylov"}, 1},
      {"SchemeWithMssor", kind, mssor + "scheme = \"neumann_neumann\"", {"method.scheme", "solver = \"ddm\""}, 2},
      {"ToleranceOfNone", kind, mortar + "tolerance = 1e-8", {"belongs to an iteration", "\"ddm\" or \"mssor\""}, 1},
      {"StepsOfNone", kind, mortar + "max_iterations = 9", {"method.max_iterations: belongs to an iteration"}, 1},
  };
}

inline Rows override_rows() {
  return {
      {"ConstantOfATakenName", "", "constants.x=1", {"constants.x: 'x' cannot be a name in expressions"}},
      {"ConstantThatIsAWord", "", "constants.c=one", {"constants.c: expected a number"}},
      {"SetWrongWord", "", "method.kind=mortr", {"method.kind: unknown kind 'mortr'", "'mortar'"}},
      {"SetUnknownKey", "", "method.knd=ddm", {"method: unknown key 'knd'", "'kind'"}},
      {"SetUnknownSection", "", "metod.kind=ddm", {"unknown key 'metod'", "'method'"}},
      {"SetNumberNotOfToml", "", "materials.steel.young=.5", {"expected a number, found '.5'"}},
      {"SetNoExpression", "", "boundary.2.pressure=1e6*z", {"boundary.2.pressure: '1e6*z', character 5: unknown name"}},
      {"SetNegativeYoung", "", "materials.steel.young=-1", {"materials.steel.young: expected a number > 0, found -1"}},
      {"SetYoungBelowPressure",
       "",
       "materials={steel={young=210,poisson=0.3},brass={young=100,poisson=0.3}}",
       {"boundary.2.pressure", "210", "unit mismatch"}},
      {"SetIndexOutOfRange", "", "boundary.4.pressure=1", {"boundary: no entry with index 4; there are 4 entries"}},
      {"SetHugeIndex", "", "contact.99999999999999999999.condition=bilateral", {"there are 2 entries"}},
      {"SetIndexOfOne", "", "body_force.1.force=[0, 0]", {"there is 1 entry (index 0)"}},
      {"SetNoIndex", "", "boundary.pressure=1", {"boundary: expected an index, found 'pressure'", "4 entries"}},
      {"SetStarForAll", "", "boundary.*.pressure=1", {"not a dotted key"}},
      {"SetBrackets", "", "boundary[2].pressure=1", {"'boundary[2].pressure' is not a dotted key"}},
      {"SetComment", "", "#=1", {"'#' is not a dotted key"}},
      {"SetHeader", "", "[a] #=1", {"'[a] #' is not a dotted key"}},
      {"SetThroughAScalar", "", "method.kind.fast=1", {"method.kind: is 'ddm'", "expected a table"}},
      {"SetSecondQuantity", "", "boundary.2.traction=[0, 1]", {"boundary.2", "exclude each other"}},
      {"SetSecondDisplacement", "", "boundary.1.on=[\"upper_left\"]", {"displacement.x twice", "boundary.0"}},
      {"SetFirstDisplacement", "", "boundary.0.on=[\"bottom\"]", {"displacement.x twice", "boundary.1"}},
      {"SetForEveryPair",
       "",
       "contact.between=[\"upper_contact\", \"lower_contact\"]",
       {"the pair of 'lower_contact' and 'upper_contact' stands twice"}},
      {"SetCurveOfNoPair", "", "contact.multipliers_on=upper_contact", {"contact.1.multipliers_on", "base_contact"}},
      {"SetPairUnderMultipliers", "", "contact.0.between=[\"a\", \"b\"]", {"'lower_contact'", "known: a, b"}},
      {"SetMaterialWithoutBody", "", "materials.iron={young=1e11,poisson=0.3}", {"no body has the material 'iron'"}},
      {"SetHalfAMaterial", "", "materials.iron.young=1e11", {"materials.iron: 'poisson' is missing"}},
      {"SetBodyWithoutExpansion", "", "initial_strain.0.body=base", {"temperature_change", "steel"}},
      {"SetMaterialWithoutExpansion", "", "bodies.lower=steel", {"initial_strain.0.temperature_change", "steel"}},
      {"SetOtherBodies", "", "bodies={upper=\"steel\",base=\"brass\"}", {"body_force.0.body: unknown body 'lower'"}},
      {"SetOtherMaterials", "", "materials={iron={young=1e11,poisson=0}}", {"bodies.upper: unknown material"}},
      {"SetMeshNotThere", "", "mesh.file=nowhere/plates.geo", {"'nowhere/plates.geo': no such file"}},
      {"SetMsh", "", "mesh.file=plates.msh", {"'plates.msh': no such file"}},
      {"SetEmptyValue", "", "method.kind=", {"unknown kind ''"}},
      {"SetWithLineBreak", "", "method.kind=a\nb", {"unknown kind 'a\\nb'"}},
  };
}

inline Rows all_rows() {
  Rows rows;
  for (const Rows& some :
       {toml_rows(), mesh_rows(), material_rows(), load_rows(), contact_rows(), solver_rows(), override_rows()}) {
    rows.insert(rows.end(), some.begin(), some.end());
  }
  return rows;
}

}  // namespace mortise::test
