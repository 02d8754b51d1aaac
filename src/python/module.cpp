// The part of Python's module `mortise` that solves: plain arrays out, by the names that the files have
// (src/python/mortise/__init__.py makes the results of them).
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "mortise/scene.hpp"
#include "mortise/solve.hpp"
#include "results/expected.hpp"
#include "results/report.hpp"

namespace mortise {
namespace {

namespace py = pybind11;

// Columns of contact.csv.
py::dict contact_columns(const Results& r) {
  std::vector<int> pair;
  std::vector<std::string> curve;
  std::vector<const ContactNode*> nodes;
  for (std::size_t k = 0; k < r.recovery.contacts.size(); ++k)
    for (const ContactSide* side : {&r.recovery.contacts[k].multiplier, &r.recovery.contacts[k].opposite})
      for (const ContactNode& node : side->nodes) {
        pair.push_back(int(k));
        curve.push_back(side->curve);
        nodes.push_back(&node);
      }
  const auto column = [&](auto value) {
    VecX values(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) values(Eigen::Index(i)) = value(*nodes[i]);
    return values;
  };
  py::dict columns;
  columns["pair"] = pair;
  columns["curve"] = curve;
  columns["s"] = column([](const ContactNode& n) { return n.s; });
  columns["x"] = column([](const ContactNode& n) { return n.position.x(); });
  columns["y"] = column([](const ContactNode& n) { return n.position.y(); });
  columns["u_n"] = column([](const ContactNode& n) { return n.u_n; });
  columns["p"] = column([](const ContactNode& n) { return n.p; });
  columns["gap"] = column([](const ContactNode& n) { return n.gap; });
  columns["sigma_n"] = column([](const ContactNode& n) { return n.sigma_n; });
  columns["sigma_2"] = column([](const ContactNode& n) { return n.sigma_2; });
  if (r.estimate) {
    columns["p_error"] = column([](const ContactNode& n) { return n.p_error; });
    columns["p_multiplier"] = column([](const ContactNode& n) { return n.p_multiplier; });
  }
  if (r.problem.fluid.size() > 0) columns["p_fluid"] = column([](const ContactNode& n) { return n.p_fluid; });
  return columns;
}

// Points of the bodies, as in result.vtu.
py::dict body_fields(const Results& r) {
  const Eigen::Index count = Eigen::Index(r.problem.points.node.size());
  MatX x(count, 2), u(count, 2);
  for (Eigen::Index p = 0; p < count; ++p) {
    const int node = r.problem.points.node[std::size_t(p)];
    x.row(p) = r.problem.mesh.nodes.row(node);
    u.row(p) = r.solution.u.segment<2>(2 * node).transpose();
  }
  py::dict fields;
  fields["x"] = x;
  fields["u"] = u;
  fields["stress"] = MatX(r.recovery.stress.points);
  return fields;
}

// Python's handlers of signals run between the stages: Ctrl-C ends a solve.
void check_signals(const std::string& /*stage*/) {
  const py::gil_scoped_acquire python;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

Results solved(const Scene& scene, bool with_estimate) {
  if (scene.accuracy) return *solve_to_accuracy(scene, check_signals);
  Results results = solve_scene(scene, check_signals);
  if (with_estimate) estimate(results);
  return results;
}

using Changes = std::vector<std::pair<std::string, std::string>>;

std::vector<Override> overrides_of(const Changes& changes) {
  std::vector<Override> overrides;
  for (const auto& [key, value] : changes) overrides.push_back({key, value});
  return overrides;
}

Scene scene_of(const std::string& path, const Changes& changes) { return read_scene(path, overrides_of(changes)); }

py::tuple solve(const std::string& path, const Changes& changes, bool with_estimate, const std::string& one_case) {
  Scene scene;
  Results results;
  std::string summary;
  {
    const py::gil_scoped_release others_run;
    scene = scene_of(path, changes);
    if (!one_case.empty()) scene = case_of(scene, one_case);
    if (!scene.cases.empty())
      throw InputError(path +
                       ": the scene has cases; expected solve(scene, case=NAME), or cases(scene) for all of them");
    results = solved(scene, with_estimate);
    judge_expectations(results);
    summary = report_of(results).dump();
  }
  return py::make_tuple(contact_columns(results), body_fields(results), summary);
}

// Words of all cases by key, and numbers by column.
py::tuple cases(const std::string& path, const Changes& changes, bool with_estimate) {
  CaseTable table;
  {
    const py::gil_scoped_release others_run;
    const Scene scene = scene_of(path, changes);
    if (scene.cases.empty()) throw InputError(path + ": the scene has no [[case]]; expected some, or solve(scene)");
    table = solve_cases(scene, {.estimated = with_estimate}, check_signals);
  }
  std::map<std::string, std::vector<std::string>> words;
  std::map<std::string, VecX> numbers;
  for (const auto& [run, row] : table.rows) {
    for (std::size_t k = 0; k < table.keys.size(); ++k) words[table.keys[k]].push_back(table.values[run][k]);
    words["status"].push_back(row.status);
    for (const auto& [name, value] : row.figures) {
      const double nan = std::numeric_limits<double>::quiet_NaN();
      const auto column = numbers.try_emplace(name, VecX::Constant(Eigen::Index(table.rows.size()), nan)).first;
      column->second(Eigen::Index(run)) = value;
    }
  }
  return py::make_tuple(words, numbers);
}

using Row = std::pair<std::string, std::vector<std::pair<std::string, double>>>;

// Runs of a sweep, one after another; the first starts from no known rows. `solver` keeps mesh and factor from call to
// call.
std::vector<Row> rows(CaseSolver& solver, const std::string& path, const std::vector<Changes>& runs) {
  const py::gil_scoped_release others_run;
  solver.forget_rows();
  std::vector<Row> rows;
  for (const Changes& changes : runs) {
    const RunRow row = solve_run(path, overrides_of(changes), false, solver, check_signals);
    rows.emplace_back(row.status, row.figures);
  }
  return rows;
}

// As of app/sweep.hpp.
std::string refusal(const std::string& path, const std::vector<Changes>& runs) {
  std::vector<std::vector<Override>> overrides;
  for (const Changes& changes : runs) overrides.push_back(overrides_of(changes));
  return refusal_of(path, overrides);
}

// Values, derivatives, bounds of gradients (app/gradients.hpp). `solver`: as of rows().
py::tuple gradient(CaseSolver& solver, const std::string& path, const Changes& changes,
                   const std::vector<std::pair<std::string, std::vector<double>>>& of,
                   const std::vector<std::pair<std::string, double>>& by) {
  std::vector<Figure> figures;
  for (const auto& [name, numbers] : of) figures.push_back({name, numbers});
  std::vector<Parameter> parameters;
  for (const auto& [key, value] : by) parameters.push_back({key, value});
  Gradients found;
  {
    const py::gil_scoped_release others_run;
    const std::vector<Override> overrides = overrides_of(changes);
    const Scene scene = parametrised(path, overrides, parameters);
    if (!scene.cases.empty())
      throw InputError(path + ": the scene has cases; expected changes={\"case\": []}, and what the case changes");
    if (scene.accuracy)
      found = gradients(*solve_to_accuracy(scene, check_signals), path, overrides, figures, parameters);
    else
      found = gradients(solver.solve(scene, check_signals), path, overrides, figures, parameters);
  }
  return py::make_tuple(found.values, found.derivatives, found.between);
}

}  // namespace

PYBIND11_MODULE(_mortise, m) {
  py::register_exception<InputError>(m, "InputError", PyExc_ValueError);
  m.def("solve", &solve);
  m.def("cases", &cases);
  m.def("refusal", &refusal);
  m.def("set_threads", &set_solver_threads);
  py::class_<CaseSolver>(m, "Solver").def(py::init<>()).def("rows", &rows).def("gradient", &gradient);
}

}  // namespace mortise
