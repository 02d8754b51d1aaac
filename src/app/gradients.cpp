#include "app/gradients.hpp"

#include <algorithm>
#include <limits>

#include "base/errors.hpp"
#include "base/printable.hpp"
#include "fem/assembly.hpp"
#include "fields/load_fields.hpp"
#include "problem/take_loads.hpp"
#include "scene/check_ranges.hpp"
#include "scene/loads.hpp"
#include "solve/contact_factor.hpp"
#include "solve/layered_system.hpp"
#include "solve/threads.hpp"

namespace mortise {
namespace {

std::vector<Override> with_parameters(std::vector<Override> overrides, const std::vector<Parameter>& by) {
  for (const Parameter& one : by) overrides.push_back({one.key, shortest(one.value)});
  return overrides;
}

// What the solution leaves in the equations of a scene that is a little different, and its energy there.
struct Left {
  VecX force;   // f - K u, n
  VecX gap;     // g, m
  VecX values;  // of prescribed q, n
  double energy = 0;
};

Left operator-(const Left& a, const Left& b) {
  return {a.force - b.force, a.gap - b.gap, a.values - b.values, a.energy - b.energy};
}

Left times(const Left& a, double factor) {
  return {a.force * factor, a.gap * factor, a.values * factor, a.energy * factor};
}

class Equations {
 public:
  Equations(const Results& results, const std::string& path, const std::vector<Override>& overrides,
            const std::vector<Parameter>& by)
      : results_(results),
        problem_(results.problem),
        path_(path),
        overrides_(with_parameters(overrides, by)),
        own_(read_scene(path, overrides_)),
        of_K_(own_.materials) {
    now_ = left(own_, path);
  }

  // d / dp, by steps as short as it takes, and no shorter: of nearly incompressible bodies the round-off of a
  // difference is a load that they give way to, and what is missed of the derivative is one that they resist.
  Left slope(const Parameter& p) {
    constexpr double straight = 1e-4, smooth = 0.06;  // a difference is off by its square; three, by its sixth power
    constexpr int tries = 9;
    double step = p.value != 0 ? 1e-3 * std::abs(p.value) : 1, best = std::numeric_limits<double>::infinity();
    Left found;
    for (int tried = 1; tried <= tries; ++tried, step *= 0.2) try {
        const Left up = at(p, p.value + step), down = at(p, p.value - step);
        const double bent = bend(up - now_, now_ - down);
        if (bent < best || found.force.size() == 0) found = times(up - down, 0.5 / step);
        best = std::min(best, bent);
        if (best <= straight) break;
        if (best <= smooth) return extrapolated(found, difference(p, step / 2), difference(p, step / 4));
      } catch (const InputError&) {  // so far off it is no scene any more
        if (tried == tries && found.force.size() == 0) throw;
      }
    return found;
  }

 private:
  static double bend(const Left& above, const Left& below) {
    double most = 0;
    const auto compare = [&](const VecX& a, const VecX& b) {
      const double difference = (a - b).norm(), size = (a + b).norm();
      if (difference > 0) most = std::max(most, difference / size);
    };
    compare(above.force, below.force);
    compare(above.gap, below.gap);
    compare(above.values, below.values);
    return most;
  }

  Left difference(const Parameter& p, double step) {
    return times(at(p, p.value + step) - at(p, p.value - step), 0.5 / step);
  }

  // Of central differences by a step, its half and its quarter (Richardson).
  static Left extrapolated(const Left& whole, const Left& half, const Left& quarter) {
    const auto finer = [](const Left& a, const Left& b, double by) { return b - times(a - b, 1 / (by - 1)); };
    return finer(finer(whole, half, 4), finer(half, quarter, 4), 16);
  }

  Left at(const Parameter& p, double value) {
    std::vector<Override> changed = overrides_;
    changed.push_back({p.key, shortest(value)});
    const Scene scene = read_scene(path_, changed);
    Scene alike = scene;
    if (std::ranges::none_of(own_.ties, &ContactSpec::locked)) alike.materials = own_.materials;
    if (!differ_in_loads_alone(own_, alike))
      throw InputError(
          path_ + ": " + p.key +
          ": has no gradient here; expected a load, a prescribed value, a gap, a modulus or a constant of such");
    return left(scene, path_ + ": " + p.key);
  }

  Left left(const Scene& scene, const std::string& told) try {
    check_ranges(scene);
    load_fields(scene);
    if (!take_loads(scene, problem_))
      throw SceneError("changes which rows contact has, so that nothing is known of its gradients");
    Discretisation& d = problem_.discretisation;
    if (scene.materials != of_K_) {
      d.system.K = assemble_stiffness(problem_.mesh, d.laws, solver_threads());
      if (d.springs.cols() > 0) d.system.K += d.springs;
      of_K_ = scene.materials;
    }
    const VecX& u = results_.solution.u;
    return {d.system.f - d.system.K.selfadjointView<Eigen::Lower>() * u, d.system.g, d.system.constraints.value,
            strain_energy(d, u)};
  } catch (const SceneError& error) {
    problem_ = results_.problem;  // what is left of the other is none
    of_K_ = own_.materials;
    throw InputError(told + ": " + error.what());
  }

  const Results& results_;
  Problem problem_;  // under the loads that were asked for last
  std::string path_;
  std::vector<Override> overrides_;
  Scene own_;
  decltype(Scene::materials) of_K_;  // of which the problem has the stiffness
  Left now_;
};

// Derivatives of the solution by each parameter, a column each.
struct Tangents {
  MatX u, lambda;
};

Tangents tangents(const Results& r, const ContactFactor& factor, const std::vector<Left>& slopes) {
  const SaddlePointSystem& s = r.problem.discretisation.system;
  MatX moved(s.f.size(), slopes.size()), loads = moved, gaps(s.g.size(), slopes.size());
  for (Eigen::Index k = 0; k < moved.cols(); ++k) {
    moved.col(k) = slopes[std::size_t(k)].values;
    loads.col(k) = slopes[std::size_t(k)].force;
    gaps.col(k) = slopes[std::size_t(k)].gap;
  }
  if (const auto& multipoint = s.constraints.multipoint) moved = multipoint->T * moved;
  const DualAnswers found = factor.answers(gaps - s.B * moved, loads - s.K.selfadjointView<Eigen::Lower>() * moved);
  return {found.z + moved, found.mu};
}

// How far a parameter goes down and up until a figure that is `now` >= 0, and grows by `slope`, is 0.
void shorten(double now, double slope, Eigen::Ref<Eigen::RowVector2d> steps) {
  const double to = -std::max(now, 0.0) / slope;
  if (slope < 0) steps(1) = std::min(steps(1), to);
  if (slope > 0) steps(0) = std::max(steps(0), to);
}

// parameters x 2: by how much each may change until a row opens or closes.
MatX steps_to_changes(const Results& r, const Tangents& tangents, const std::vector<Left>& slopes) {
  constexpr double round_off = 1e-12;
  const SaddlePointSystem& s = r.problem.discretisation.system;
  VecX gap = s.B * r.solution.u - s.g;
  if (r.solution.compression.size() > 0) gap += s.layers.B * r.solution.compression;
  const MatX opened = s.B * tangents.u + layer_openings(s.layers, r.solution.compression, tangents.lambda);
  MatX steps(tangents.u.cols(), 2);
  for (Eigen::Index k = 0; k < steps.rows(); ++k) {
    Eigen::RowVector2d within(-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity());
    const VecX of_lambda = tangents.lambda.col(k), opening = opened.col(k),
               of_gap = opening - slopes[std::size_t(k)].gap;
    const double stress = round_off * largest_entry(of_lambda), length = round_off * largest_entry(opening);
    for (Eigen::Index a = 0; a < gap.size(); ++a) {
      if (s.unilateral.empty() || !s.unilateral[std::size_t(a)]) continue;
      if (r.solution.active[std::size_t(a)]) {
        if (std::abs(of_lambda(a)) > stress) shorten(-r.solution.lambda(a), -of_lambda(a), within);
      } else if (std::abs(of_gap(a)) > length) {
        shorten(gap(a), of_gap(a), within);
      }
    }
    steps.row(k) = within;
  }
  return steps;
}

}  // namespace

Scene parametrised(const std::string& path, std::vector<Override> overrides, const std::vector<Parameter>& by) {
  return read_scene(path, with_parameters(std::move(overrides), by));
}

Gradients gradients(const Results& r, const std::string& path, const std::vector<Override>& overrides,
                    const std::vector<Figure>& of, const std::vector<Parameter>& by) {
  if (r.solution.status != SolveStatus::converged)
    throw InputError(path + ": the solution has not converged, so that nothing is known of its gradients");
  if (r.problem.fluid.size() > 0)
    throw InputError(path + ": contact.fluid: gradients where a fluid gets into a gap are not known; expected none");
  Equations equations(r, path, overrides, by);
  std::vector<Left> slopes;
  for (const Parameter& one : by) slopes.push_back(equations.slope(one));
  const auto factor = exact_factor(r.problem.discretisation.system, r.solution);
  const Tangents found = tangents(r, *factor, slopes);
  Gradients gradients{.values = VecX(of.size()), .derivatives = MatX(of.size(), by.size()), .between = {}};
  for (Eigen::Index i = 0; i < gradients.values.size(); ++i) {
    const LinearisedFigure figure = linearised(r, of[std::size_t(i)]);
    gradients.values(i) = figure.value;
    gradients.derivatives.row(i) = figure.by_u.transpose() * found.u + figure.by_lambda.transpose() * found.lambda;
    for (std::size_t k = 0; figure.is_energy && k < by.size(); ++k)
      gradients.derivatives(i, Eigen::Index(k)) += slopes[k].energy;
  }
  gradients.between = steps_to_changes(r, found, slopes);
  for (std::size_t k = 0; k < by.size(); ++k) gradients.between.row(Eigen::Index(k)).array() += by[k].value;
  return gradients;
}

}  // namespace mortise
