#include "base/errors.hpp"
#include "base/printable.hpp"
#include "base/stopwatch.hpp"
#include "problem/audit.hpp"
#include "problem/contact_curves.hpp"
#include "problem/curve_pieces.hpp"
#include "problem/dirichlet_neumann.hpp"
#include "problem/fluid.hpp"
#include "problem/held_pieces.hpp"
#include "problem/problem.hpp"
#include "problem/ties.hpp"
#include "scene/scene.hpp"

namespace mortise {
namespace {

// Bodies drawn over one another may have no places that face each other: that is said first.
template <typename Find>
auto audited(const Problem& p, Find find) {
  try {
    return find();
  } catch (const InputError&) {
    audit(p.mesh, p.entries, {});
    throw;
  }
}

// Couples the pairs and puts their rows into the system; refuses what cannot be meant.
void add_contact(std::vector<ContactCurves> curves, Problem& p) {
  p.pairs =
      audited(p, [&] { return couple_pairs(p.method, p.mesh, p.discretisation, std::move(curves), p.dirichlet); });
  SaddlePointSystem& system = p.discretisation.system;
  set_contact(p.pairs, system);
  p.fluid = dry_rows(p.mesh, p.pairs, system.B.rows());
  if (p.fluid.size() > 0) p.fluid_loads = fluid_loads(p.mesh, p.discretisation.model, p.pairs, system.B.rows());
  p.warnings = p.mesh.notes;
  append_lines(p.warnings, audit(p.mesh, p.entries, p.pairs));
  require_closed(p.mesh, p.pairs);
  require_held_pieces(p.mesh, system.constraints, p.warnings);
  p.held = hold_free_motions(p.mesh, p.pairs, p.warnings, system);
  p.idle = p.held.grounded;
  append_lines(p.warnings, held_lines(p.mesh, p.held.motions));
  p.floating = find_floating(p.mesh, system.constraints);
  system.grounded = p.floating.grounded;
}

}  // namespace

Problem prepare(const Scene& scene, Mesh mesh, const Progress& progress, const ActiveSet* start) {
  const auto stage = [&](const std::string& name) {
    if (progress) progress(name);
  };
  Stopwatch watch;
  Problem p;
  p.title = scene.title;
  p.scene = scene.path;
  p.changes = scene.changes;
  p.load_case = scene.load_case;
  p.method = scene.method;
  if (scene.accuracy) p.accuracy = scene.accuracy->value;
  p.fields = scene.fields;
  add_pieces(scene, mesh);
  p.mesh = tied(scene, std::move(mesh));

  stage("assemble");
  p.points = body_points(p.mesh);
  p.entries = resolve(scene, p.mesh);
  p.discretisation = discretise(p.entries, p.mesh);
  p.misfits = data_misfits(p.entries, p.mesh, p.discretisation.laws);
  std::ranges::move(outline_misfits(p.mesh, p.discretisation.model), std::back_inserter(p.misfits.parts));
  p.probes = locate_probes(scene, p.mesh);
  p.expectations = scene.expectations;
  p.assemble_seconds = watch.lap();

  stage("couple");
  std::vector<ContactCurves> curves = audited(p, [&] { return contact_curves(scene, p.mesh); });
  if (p.method.solver == Solver::ddm)
    p.dirichlet = dirichlet_bodies(p.method.dirichlet, p.mesh, p.discretisation, curves);
  add_contact(std::move(curves), p);
  p.patterns = patterns_without_distance(scene, p.mesh);
  if (start) p.discretisation.system.start = starting_rows(*start, p.mesh, p.pairs);
  p.couple_seconds = watch.lap();
  return p;
}

}  // namespace mortise
