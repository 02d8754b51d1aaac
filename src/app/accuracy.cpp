#include "app/accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "app/accuracy_end.hpp"
#include "app/drawn_sizes.hpp"
#include "app/next_sizes.hpp"
#include "base/errors.hpp"
#include "base/printable.hpp"
#include "base/stopwatch.hpp"
#include "gmsh/free_mesher.hpp"
#include "results/error_report.hpp"

namespace mortise {
namespace {

struct Interrupted {};

// A scene that is refused on a mesh that was made.
struct RefusedOnMesh {
  InputError error;
  std::vector<SizeLayers> wanted = {};  // as of EdgesTooLong
};

constexpr int least_edges = 10;  // along a contact curve, of any mesh after the first
constexpr int most_others = 2;   // meshes in succession that tell no sizes of the next

class Loop {
 public:
  Loop(std::vector<const Scene*> cases, const Progress& progress, const std::function<bool()>& interrupted)
      : cases_(std::move(cases)),
        scene_(*cases_.front()),
        spec_(*scene_.accuracy),
        progress_(progress),
        interrupted_(interrupted),
        mesher_(scene_.mesh_file, scene_.mesh_parameters, scene_.geo_limits),
        largest_(drawn_sizes(mesher_.curves(), scene_, std::min(spec_.first_edges, least_edges))),
        gaps_(cases_.size()),
        open_(cases_.size()) {}

  std::optional<Results> run() {
    std::optional<Answer> last, best;  // best: of those before the last, if it is better
    AccuracyReport report{.of = spec_.of, .asked = spec_.value, .excluded = spec_.exclude, .solves = {}, .reason = {}};
    Seconds seconds;
    const LayeredSizes first = drawn_sizes(mesher_.curves(), scene_, spec_.first_edges);
    SizeAt sizes = [&first](const Vec2& x) { return first(x); };
    try {
      for (int number = 1;; ++number) {
        Results r = solve_on_a_mesh(sizes, last, number);
        seconds += r.seconds;
        report.solves.push_back({free_unknowns(r), open_[worst_] ? 0 : told(r), r.seconds.total(), is_narrow(r)});
        aim_lower(report.solves);
        if (spec_.of == Goal::peak) require_peak(scene_, r);
        const bool says = tells_sizes(r) && is_pressed(r);
        const double off =
            says ? AccuracyReport::confirmed(report.solves.back(), number) : std::numeric_limits<double>::infinity();
        if (last && last->off < std::min(off, best ? best->off : off)) best = std::move(last);
        last = Answer{std::move(r), off, number};
        const bool tells_no_more = others_ == most_others && !tells_sizes(last->results);
        report.reason = why_to_stop(last->results, report, spec_, tells_no_more, at_limit_);
        if (report.reached() || !report.reason.empty()) break;
        sizes = sizes_after(last->results, std::move(sizes), report.solves);
      }
    } catch (const Interrupted&) {
      if (!last) return std::nullopt;
      report.reason = "interrupted";
    } catch (const InputError& error) {  // a mesh that gmsh does not make
      if (!last) throw;
      report.reason = error.what();
    }
    if (best && !report.reached() && best->off < last->off) {
      report.reason += "; the answer is that of solve " + std::to_string(best->number);
      report.later = int(report.solves.size()) - best->number;
      last = std::move(best);
    }
    complete(last->results, std::move(report), seconds);
    return std::move(last->results);
  }

  const std::vector<FoundPoint>& found() const { return found_; }
  const std::vector<char>& open() const { return open_; }

 private:
  struct Answer {
    Results results;
    double off;  // what the report holds against what is asked; infinite where the estimate says nothing
    int number;  // of the solve, from 1
  };

  // On a mesh of these sizes; if the scene is refused there, on others, whose sizes they become.
  Results solve_on_a_mesh(SizeAt& sizes, const std::optional<Answer>& last, int number) {
    std::optional<ActiveSet> start;
    if (last) start = active_set(last->results);
    for (;;) try {
        return solve_on(sizes, start ? &*start : nullptr, number);
      } catch (const RefusedOnMesh& refused) {  // perhaps for this mesh alone: a finer one then says something else
        if (are_shorter(refused.wanted, sizes)) {
          sizes = with_layers(sizes, refused.wanted);
          continue;
        }
        if (refused.error.what() == refusal_ || others_++ == most_others) throw InputError(refused.error);
        refusal_ = refused.error.what();
        sizes = scaled(sizes, 1 / another);
      }
  }

  // Whether the last of two meshes has not even halved the error: as much came back where sizes grew as went elsewhere.
  static bool stagnates(const std::vector<AccuracyReport::Solve>& solves) {
    const std::size_t n = solves.size();
    return n >= 3 && solves[n - 1].estimated > solves[n - 2].estimated / 2;
  }

  // So near to what was asked the estimate's parts are known to fall as they should: meshes that miss it all the same,
  // twice, ask for too little.
  void aim_lower(const std::vector<AccuracyReport::Solve>& solves) {
    constexpr double near = 3, lower = 0.7;
    const std::size_t n = solves.size();
    if (n < 2 || solves[n - 2].estimated > near * spec_.value || solves[n - 1].estimated <= spec_.value) return;
    if (++near_misses_ > 1) aim_ *= lower;
  }

  // `sizes`: of the mesh that r is on.
  SizeAt sizes_after(const Results& r, SizeAt sizes, const std::vector<AccuracyReport::Solve>& solves) {
    const bool pressed = is_pressed(r), tells = pressed && tells_sizes(r);
    others_ = tells || !pressed ? 0 : others_ + 1;
    if (!tells) return with_wanted(r, small_at_gaps(r, scaled(sizes, 1 / another)));
    const SizeAt next = next_sizes(r, solves.size() == 1);
    if (!stagnates(solves)) return next;
    return [next, kept = std::move(sizes)](const Vec2& x) { return std::min(next(x), kept(x)); };
  }

  // With what only the last results have. `seconds`: of all solves.
  void complete(Results& last, AccuracyReport report, Seconds seconds) const {
    Stopwatch watch;
    set_force_bars(last);
    set_fitted_pressures(last);
    seconds.estimate += watch.lap();
    // What is left was spent on the geometry, and on the sizes of the next mesh.
    seconds.mesh += watch_.elapsed() - seconds.total();
    last.seconds = seconds;
    if (!report.reached()) last.status = std::max(last.status, Status::accuracy_not_reached);
    last.accuracy = std::move(report);
  }

  Results solve_on(const SizeAt& sizes, const ActiveSet* start, int number) {
    const std::string words = "solve " + std::to_string(number) + told_;
    const auto stage = [&](const std::string& name) {
      if (interrupted_ && interrupted_()) throw Interrupted();
      if (progress_) progress_(words + ": " + name);
    };
    stage("mesh");
    Stopwatch watch;
    double factor = 1;
    const SizeAt held = [&](const Vec2& x) { return factor * sizes(x); };
    Mesh mesh = mesh_of(held, factor);
    for (int again = 0; again < 3 && 2.0 * double(mesh.nodes.rows()) > 1.1 * spec_.unknowns_max; ++again) {
      factor *= std::sqrt(2.0 * double(mesh.nodes.rows()) / spec_.unknowns_max);
      mesh = mesh_of(held, factor);
      at_limit_ = true;
    }
    const double meshing = watch.lap();
    Results r = cases_.size() == 1 ? solve_one(std::move(mesh), stage, start)
                                   : solve_all(std::move(mesh), sizes, stage, number);
    r.seconds.mesh = meshing;
    std::ostringstream text;
    text.precision(2);
    text << " (" << to_string(spec_.of) << " was within " << percent(estimated(r)) << " with " << free_unknowns(r)
         << " unknowns)";
    told_ = text.str();
    return r;
  }

  void estimate_one(Results& r) {
    try {
      estimate(r, spec_, found_, false);
    } catch (const SceneError& error) {
      throw InputError(scene_.path + ": " + error.what());
    }
    keep_found(r);
  }

  Results solve_one(Mesh mesh, const Progress& stage, const ActiveSet* start) {
    Results r = refusable([&] { return solve_scene(scene_, std::move(mesh), stage, start); });
    stage("estimate");
    estimate_one(r);
    open_[0] = gaps_[0].are_the_answer(r);  // then p = 0 is an answer
    return r;
  }

  // That of the cases which is farthest from what was asked; what all want of the next mesh is kept.
  Results solve_all(Mesh mesh, const SizeAt& sizes, const Progress& stage, int number) {
    wanted_.reset();
    CaseSolver solver(std::move(mesh));
    std::optional<InputError> refused;
    double most = -1;
    for (std::size_t k = 0; k < cases_.size(); ++k) try {
        const auto of_case = [&](const std::string& name) { stage("case " + std::to_string(k + 1) + ", " + name); };
        Results& r = solver.solve(*cases_[k], of_case);
        estimate_one(r);
        open_[k] = gaps_[k].are_the_answer(r);
        if (is_pressed(r) && tells_sizes(r)) add_wanted(wanted_next(r, spec_, number == 1, aim_));
        const double off = open_[k] ? 0 : tells_sizes(r) ? estimated(r) : std::numeric_limits<double>::infinity();
        if (off <= most) continue;
        most = off;
        worst_ = k;
      } catch (const EdgesTooLong& error) {
        if (are_shorter(error.wanted, sizes)) throw RefusedOnMesh{error, error.wanted};
        if (!refused) refused = error;
      } catch (const InputError& error) {
        if (!refused) refused = error;
      }
    if (most < 0) throw RefusedOnMesh{*refused};
    Results& r = solver.solve(*cases_[worst_], stage);
    estimate_one(r);
    return std::move(r);
  }

  void add_wanted(WantedSizes wanted) {
    if (!wanted_) {
      wanted_ = std::move(wanted);
      return;
    }
    wanted_->sizes = wanted_->sizes.cwiseMin(wanted.sizes);
    wanted_->layers.insert(wanted_->layers.end(), wanted.layers.begin(), wanted.layers.end());
  }

  template <typename Work>
  static Results refusable(Work work) {
    try {
      return work();
    } catch (const EdgesTooLong& error) {
      throw RefusedOnMesh{error, error.wanted};
    } catch (const InputError& error) {
      throw RefusedOnMesh{error};
    }
  }

  // Where gmsh refuses these sizes, of larger ones.
  Mesh mesh_of(const SizeAt& sizes, double& factor) {
    for (int refused = 0;; ++refused) try {
        Mesh mesh = mesher_.mesh(sizes, spec_.recombine, expected_nodes_);
        mesh.known_pairs = known_pairs_;
        return mesh;
      } catch (const InputError&) {
        if (refused == most_others) throw;
        factor *= another;
      }
  }

  bool tells_sizes(const Results& r) const { return r.status != Status::not_converged && std::isfinite(estimated(r)); }

  // A point once found stays on the meshes that follow, and so does a pair of curves (half an edge, within which
  // patterns find them, becomes less than the gap between them) and its multiplier side (p depends on whose normals
  // count).
  void keep_found(const Results& r) {
    known_pairs_.clear();
    for (const ContactPair& pair : r.problem.pairs)
      known_pairs_.push_back({.curves = curve_names(r.problem.mesh, pair), .first_is_multiplier = true});
    std::vector<FoundPoint> found;
    for (std::size_t k = 0; k < r.problem.pairs.size(); ++k)
      for (const SingularPoint& point : r.estimate->pressures[k].singular)
        found.push_back({curve_names(r.problem.mesh, r.problem.pairs[k]), point.position, point.is_swinging()});
    for (const FoundPoint& old : found_)
      if (std::ranges::none_of(found, [&](const FoundPoint& point) { return point.is(old); })) found.push_back(old);
    found_ = std::move(found);
  }

  double estimated(const Results& r) const { return estimated_error(r, spec_.of); }
  // Nothing where the solver did not converge, as its last iterate is the solution of nothing.
  double told(const Results& r) const {
    return r.status == Status::not_converged ? std::numeric_limits<double>::quiet_NaN() : estimated(r);
  }
  static bool is_narrow(const Results& r) {
    return std::ranges::any_of(r.estimate->pressures, [](const auto& e) { return !e.local.narrow_at.empty(); });
  }

  SizeAt next_sizes(const Results& r, bool first) {
    return sizes_as(r, wanted_ ? *wanted_ : wanted_next(r, spec_, first, aim_));
  }

  // Where other cases than this one want sizes too.
  SizeAt with_wanted(const Results& r, SizeAt sizes) {
    if (!wanted_) return sizes;
    return [sizes = std::move(sizes), others = sizes_as(r, *wanted_)](const Vec2& x) {
      return std::min(sizes(x), others(x));
    };
  }

  SizeAt sizes_as(const Results& r, WantedSizes wanted) {
    for (Eigen::Index i = 0; i < wanted.sizes.size(); ++i)
      wanted.sizes(i) = std::min(wanted.sizes(i), largest_(r.problem.mesh.nodes.row(i).transpose()));
    const auto field = std::make_shared<SizeField>(r.problem.mesh, wanted.sizes, std::move(wanted.layers));
    // More than may be, as far as the old mesh tells: all elements larger, and this is the last mesh.
    const double expected = expected_unknowns(r.problem.mesh, r.estimate->energy.areas, *field),
                 excess = expected / spec_.unknowns_max;
    at_limit_ = excess > 1;
    expected_nodes_ = std::min<double>(expected, spec_.unknowns_max) / 2;
    return [field, factor = std::sqrt(std::max(1.0, excess))](const Vec2& x) { return factor * (*field)(x); };
  }

  Stopwatch watch_;  // from the start
  const std::vector<const Scene*> cases_;
  const Scene& scene_;  // the first
  const AccuracySpec& spec_;
  const Progress& progress_;
  const std::function<bool()>& interrupted_;
  FreeMesher mesher_;
  LayeredSizes largest_;               // sizes that no mesh goes above
  std::vector<OpenGaps> gaps_;         // of each case
  std::vector<char> open_;             // of each case: nothing is pressed, and that is the answer
  std::size_t worst_ = 0;              // case
  std::optional<WantedSizes> wanted_;  // of several cases on the last mesh, where any of them tells
  std::vector<FoundPoint> found_;      // singular points, of all solves so far
  std::vector<KnownPair> known_pairs_;
  std::string told_;           // of the solve before, in the progress line
  std::string refusal_;        // of the last mesh on which the scene was refused
  double aim_ = 1;             // as of wanted_next
  int near_misses_ = 0;        // of what was asked
  int others_ = 0;             // meshes since the last that told the sizes of the next
  bool at_limit_ = false;      // the mesh has been held to unknowns_max
  double expected_nodes_ = 0;  // of the next mesh
};

}  // namespace

AccurateMesh mesh_to_accuracy(const std::vector<const Scene*>& cases, const Progress& progress) {
  const std::function<bool()> never;
  return told_with_path(*cases.front(), [&]() -> AccurateMesh {
    Loop loop(cases, progress, never);
    Results results = *loop.run();
    return {std::move(results.problem.mesh), std::move(*results.accuracy), loop.found(), loop.open()};
  });
}

std::optional<Results> solve_to_accuracy(const Scene& scene, const Progress& progress,
                                         const std::function<bool()>& interrupted) {
  return told_with_path(scene, [&] { return Loop({&scene}, progress, interrupted).run(); });
}

}  // namespace mortise
