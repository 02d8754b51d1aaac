#include "results/write_results.hpp"

#include <fstream>

#include "base/errors.hpp"
#include "base/stopwatch.hpp"
#include "output/csv.hpp"
#include "output/output_folder.hpp"
#include "output/vtu.hpp"
#include "results/report.hpp"

namespace mortise {
namespace {

// Bodies are written apart: a node that two bodies share is a point of each, with each body's stress.
VtuGrid result_grid(const Results& r) {
  VtuGrid grid;
  const Eigen::Index count = r.problem.points.node.size();
  grid.points.resize(count, 2);
  MatX u(count, 2), von_mises_stress(count, 1), body(r.problem.mesh.cells.size(), 1);
  for (Eigen::Index p = 0; p < count; ++p) {
    const int node = r.problem.points.node[p];
    grid.points.row(p) = r.problem.mesh.nodes.row(node);
    u.row(p) = r.solution.u.segment<2>(2 * node).transpose();
    von_mises_stress(p, 0) = von_mises(r.recovery.stress.points.row(p).transpose());
  }
  grid.cells = cells_on_points(r.problem.mesh, r.problem.points);
  for (std::size_t e = 0; e < grid.cells.size(); ++e) body(e, 0) = grid.cells[e].body;
  const std::vector<std::string> stress_names{"11", "22", "33", "12"};
  grid.point_fields = {
      {"displacement", u, {}}, {"stress", r.recovery.stress.points, stress_names}, {"von_mises", von_mises_stress, {}}};
  grid.cell_fields = {{"body", body, {}}, {"stress_centre", r.recovery.stress.centres, stress_names}};
  if (r.estimate) grid.cell_fields.push_back({"error_density", r.estimate->energy.density, {}});
  return grid;
}

// Both curves of every pair, with what contact.csv says at their nodes.
VtuGrid contact_grid(const Results& r) {
  VtuGrid grid;
  std::vector<std::pair<const ContactSide*, const Curve*>> sides;
  Eigen::Index count = 0;
  for (std::size_t k = 0; k < r.problem.pairs.size(); ++k) {
    sides.emplace_back(&r.recovery.contacts[k].multiplier, &r.problem.pairs[k].multiplier);
    sides.emplace_back(&r.recovery.contacts[k].opposite, &r.problem.pairs[k].opposite);
    count += r.recovery.contacts[k].multiplier.nodes.size() + r.recovery.contacts[k].opposite.nodes.size();
  }
  grid.points.resize(count, 2);
  MatX u(count, 2), normal(count, 2), p(count, 1), p_error(count, 1), p_fluid(count, 1), gap(count, 1),
      sigma_n(count, 1);
  Eigen::Index i = 0;
  std::vector<int> point_of_node(r.problem.mesh.nodes.rows());
  for (const auto& [side, curve] : sides) {
    for (const ContactNode& n : side->nodes) {
      point_of_node[n.node] = int(i);
      grid.points.row(i) = n.position.transpose();
      u.row(i) = r.solution.u.segment<2>(2 * n.node).transpose();
      normal.row(i) = n.normal.transpose();
      p(i, 0) = n.p;
      p_error(i, 0) = n.p_error;
      p_fluid(i, 0) = n.p_fluid;
      gap(i, 0) = n.gap;
      sigma_n(i++, 0) = n.sigma_n;
    }
    for (Edge edge : curve->edges) {
      for (int a = 0; a < edge.node_count; ++a) edge.nodes[a] = point_of_node[edge.nodes[a]];
      grid.edges.push_back(edge);
    }
  }
  grid.point_fields = {
      {"displacement", u, {}}, {"normal", normal, {}}, {"p", p, {}}, {"gap", gap, {}}, {"sigma_n", sigma_n, {}}};
  if (r.estimate) grid.point_fields.push_back({"p_error", p_error, {}});
  if (r.problem.fluid.size() > 0) grid.point_fields.push_back({"p_fluid", p_fluid, {}});
  return grid;
}

// Calls add(pair number, side) for both sides of every pair, multiplier side first.
template <typename Add>
void for_each_side(const Results& r, Add add) {
  for (std::size_t k = 0; k < r.recovery.contacts.size(); ++k) {
    add(double(k), r.recovery.contacts[k].multiplier);
    add(double(k), r.recovery.contacts[k].opposite);
  }
}

void add_columns(std::vector<CsvColumn>& columns, std::initializer_list<const char*> names) {
  for (const char* name : names) columns.push_back({name, {}, {}});
}

// Columns 0 and 2 on take the numbers, column 1 the word.
void add_row(std::vector<CsvColumn>& columns, const std::string& word, const std::vector<double>& numbers) {
  columns[1].words.push_back(word);
  for (std::size_t k = 0; k < numbers.size(); ++k) columns[k == 0 ? 0 : k + 1].numbers.push_back(numbers[k]);
}

void write_contact_csv(const Results& r, const std::filesystem::path& path) {
  const bool fluid = r.problem.fluid.size() > 0;
  std::vector<CsvColumn> columns;
  add_columns(columns, {"pair", "curve", "s", "x", "y", "u_n", "p", "gap", "sigma_n", "sigma_2"});
  if (r.estimate) add_columns(columns, {"p_error", "p_multiplier"});
  if (fluid) add_columns(columns, {"p_fluid"});
  for_each_side(r, [&](double pair, const ContactSide& side) {
    for (const ContactNode& n : side.nodes) {
      std::vector<double> row{pair, n.s, n.position.x(), n.position.y(), n.u_n, n.p, n.gap, n.sigma_n, n.sigma_2};
      if (r.estimate) row.insert(row.end(), {n.p_error, n.p_multiplier});
      if (fluid) row.push_back(n.p_fluid);
      add_row(columns, side.curve, row);
    }
  });
  write_csv(path, columns);
}

void write_centres_csv(const Results& r, const std::filesystem::path& path) {
  std::vector<CsvColumn> columns;
  add_columns(columns, {"pair", "curve", "s", "x", "y", "p", "sigma_n", "sigma_2"});
  for_each_side(r, [&](double pair, const ContactSide& side) {
    for (const ContactCentre& n : side.centres)
      add_row(columns, side.curve, {pair, n.s, n.position.x(), n.position.y(), n.p, n.sigma_n, n.sigma_2});
  });
  write_csv(path, columns);
}

void write_iteration_csv(const Iteration& iteration, const std::filesystem::path& path) {
  std::vector<CsvColumn> columns;
  add_columns(columns, {"step", "kinematic", "force", "beta", "seconds"});
  for (const IterationStep& step : iteration.history) {
    columns[0].numbers.push_back(double(columns[0].numbers.size() + 1));
    columns[1].numbers.push_back(step.residuals.kinematic);
    columns[2].numbers.push_back(step.residuals.force);
    columns[3].numbers.push_back(step.beta);
    columns[4].numbers.push_back(step.seconds);
  }
  write_csv(path, columns);
}

void write_probes_csv(const Results& r, const std::filesystem::path& path) {
  std::vector<CsvColumn> columns;
  add_columns(columns, {"probe", "body"});
  for (const auto& [name, value] : probe_figures(r.recovery.probes[0])) columns.push_back({name, {}, {}});
  for (const ProbeValue& v : r.recovery.probes) {
    std::vector<double> row{double(v.place.probe)};
    for (const auto& [name, value] : probe_figures(v)) row.push_back(value);
    add_row(columns, r.problem.mesh.bodies[r.problem.mesh.cells[v.place.in.cell].body], row);
  }
  write_csv(path, columns);
}

}  // namespace

void write_results(const Results& results, Json& report, const std::filesystem::path& folder, bool bodies) {
  Stopwatch watch;
  OutputFolder output(folder);
  const std::optional<std::string> no_vtu = why_no_vtu();
  if (no_vtu) report["warnings"].push_back("result.vtu and contact.vtu are left out: " + *no_vtu);
  try {
    if (bodies && !no_vtu) write_vtu(output.path("result.vtu"), result_grid(results));
    if (!results.problem.pairs.empty()) {
      if (!no_vtu) write_vtu(output.path("contact.vtu"), contact_grid(results));
      write_contact_csv(results, output.path("contact.csv"));
      write_centres_csv(results, output.path("contact_centres.csv"));
    }
    if (const auto& iteration = results.solution.iteration)
      write_iteration_csv(*iteration, output.path("iteration.csv"));
    if (!results.recovery.probes.empty()) write_probes_csv(results, output.path("probes.csv"));
  } catch (const InputError& error) {
    throw InputError(output.with_target(error.what()));
  }
  const double seconds = watch.lap();
  report["seconds"]["write"] = seconds;
  report["seconds"]["total"] = report["seconds"]["total"].get<double>() + seconds;
  std::ofstream file(output.path("summary.json"));
  file << report.dump(2) << "\n";
  file.close();
  if (!file) throw InputError(folder.string() + ": cannot write summary.json");
  output.commit();
}

void write_results(const Results& results, const std::filesystem::path& folder) {
  Json report = report_of(results);
  write_results(results, report, folder);
}

}  // namespace mortise
