// SPDX-License-Identifier: BSD-3-Clause
// Meshes free of the borders of their patches, with all their elements.
#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gradation/edge_sizes.h"
#include "mesh/elements/cell_quality.h"
#include "mesh/flat_mesh.h"
#include "mesh/surface_mesh.h"
#include "surface/attempts.h"
#include "surface/elements/thresholds.h"
#include "surface/elements/wires.h"
#include "surface/free_elements/free_elements.h"
#include "surface/free_elements/invalid_elements.h"
#include "surface/free_elements/thresholds.h"
#include "surface/independent/independent.h"
#include "surface/quads/quadrilaterals.h"
#include "surface/run.h"

namespace carreau {

namespace {

using namespace thresholds::elements;

/// What is said of a mesh that may be given up.
class HeldMonitor final : public Monitor {
 public:
  explicit HeldMonitor(Monitor& to) : to_(to) {}
  void message(Level level, std::string_view text) override { held_.emplace_back(level, text); }
  [[nodiscard]] bool hears(Level level) const override { return to_.hears(level); }
  void progress(Phase phase, int entity, double fraction) override { to_.progress(phase, entity, fraction); }
  void checkpoint() override { to_.checkpoint(); }
  [[nodiscard]] std::vector<std::pair<Level, std::string>> held() { return std::move(held_); }

 private:
  Monitor& to_;
  std::vector<std::pair<Level, std::string>> held_;
};

/// Where the triangles come from that elements are made of.
enum class From {
  remeshing,  ///< lengths and shapes are those of isotropic triangles, whatever the patches
  patches     ///< placed for quadrilaterals by patches: regular ones, whose lengths know the borders
};

/// What there is to choose by.
struct Made {
  std::size_t invalid = 0;
  ElementCrossings crossings;
  double shape = 0;            ///< mean
  double elements = 0;

  /// What smaller elements may mend.
  [[nodiscard]] std::size_t faults() const noexcept { return invalid + crossings.fresh.size(); }
};

class FreeStep {
 public:
  FreeStep(CompositeRun& run, const std::function<void()>& mesh_again)
      : run_(run), attempts_(run, mesh_again), start_(run.curves), finer_(run.finer) {}

  bool make() {
    std::vector<CrossingPlace> crossings;
    for (const TriangleIntersection& pair : run_.result.crossings) crossings.push_back({pair.place, 0, {}});
    const bool is_free = make_once(From::remeshing);
    messages_of_best_ = messages_;
    if (is_free) best_ = now_;
    growth_ = most_growth * std::max(few_triangles, static_cast<double>(run_.result.mesh.triangle_count()));
    if (is_free) make_finer(From::remeshing);
    if (has_quads(run_.options.element)) try_patches(crossings);
    attempts_.finish();
    for (const auto& [level, text] : messages_of_best_) run_.monitor.message(level, text);
    if (!best_) return false;
    if (has_quads_only(run_.options.element)) halve_sizes(run_.result, run_.curves);
    return true;
  }

 private:
  using Messages = std::vector<std::pair<Level, std::string>>;

  bool make_once(From from) {
    const CompositeOptions& options = run_.options;
    HeldMonitor monitor(run_.monitor);
    now_ = {};
    ElementMaker elements;
    if (options.element != Element::p1)
      elements = [&](const SurfaceMesh& before, const RemeshingFrame& frame, FreedMesh& made) {
        now_.crossings = make_free_elements(before, frame, options, run_.cad, made, monitor);
      };
    const bool by_direction = run_.rules.uses_metrics();
    bool is_free = true;
    if (from == From::remeshing && options.element == Element::p1) raise_sizes();
    if (from == From::remeshing)
      is_free = free_from_patches(run_.curve_model, run_.curves, options, by_direction, elements, run_.result, monitor);
    else
      free_elements_from_patches(run_.curve_model, run_.curves, options, by_direction, elements, run_.result, monitor);
    messages_ = monitor.held();
    if (!is_free) return false;
    const ElementWork work{run_.curve_model, run_.curves, run_.rules, options, run_.result, run_.monitor};
    if (has_quads_only(options.element)) halve_wires(work);
    if (is_quadratic(options.element)) give_nodes_to_wires(work);
    if (options.element == Element::p1) return true;
    invalid_ = find_invalid(run_.result, options.element);
    now_.invalid = invalid_.count;
    const CellSummary summary = summarise_cells(flatten(run_.result.mesh, true));
    now_.shape = summary.shape.mean;
    now_.elements = static_cast<double>(summary.triangles3 + summary.triangles6 + summary.quads4 + summary.quads8);
    return true;
  }

  template <typename Change>
  bool again(From from, const Change& change) {
    run_.options.independent = from == From::remeshing;  // else points are placed for quadrilaterals
    const bool done = attempts_.again(change);
    run_.options.independent = true;
    return done;
  }

  bool keep_if(bool better) {
    if (!attempts_.keep_if(better)) return false;
    best_ = now_, messages_of_best_ = messages_;
    return true;
  }

  // As long as fewer elements are invalid or cross, and the meshes do not grow too much for them.
  void make_finer(From from) {
    double left = growth_;
    for (int round = 0; round < most_divisions && now_.faults() > 0 && left >= 0; ++round) {
      if (!again(from, [&] { divide(); })) return;
      lower_sizes();
      if (!make_once(from)) return;
      left -= static_cast<double>(run_.result.mesh.triangle_count());
      (void)keep_if(now_.faults() < best_->faults());
    }
  }

  // Where borders of patches are not much shorter than elements, quadrilaterals of theirs are more regular than pairs of isotropic
  // triangles. `crossings`: of the patches' own.
  void try_patches(const std::vector<CrossingPlace>& crossings) {
    double left = growth_;
    for (int round = 0; round <= thresholds::free_elements::most_rounds_of_patches && left >= 0; ++round) {
      const bool done = again(From::patches, [&] {
        if (round == 0)
          run_.curves = start_, run_.finer = finer_;
        else
          divide();
      });
      if (!done) return;
      lower_sizes();
      if (!make_once(From::patches)) return;
      left -= static_cast<double>(run_.result.mesh.triangle_count());
      (void)keep_if(is_better(crossings));
      if (now_.faults() == 0 || is_hopeless()) return;
    }
  }
  // What is valid already is better, whatever becomes of what is not.
  [[nodiscard]] bool is_hopeless() const {
    using thresholds::free_elements::most_of_patches;
    return best_ && best_->faults() == 0 && (now_.shape <= best_->shape || now_.elements > most_of_patches * best_->elements);
  }
  [[nodiscard]] bool is_better(const std::vector<CrossingPlace>& crossings) const {
    if (!new_places(best_ ? best_->crossings.all : crossings, now_.crossings.all).empty()) return false;
    if (!find_defects(run_.result.mesh, {.closed = false, .limit = 1}).empty()) return false;
    if (!best_) return true;
    if (now_.elements > thresholds::free_elements::most_of_patches * best_->elements) return false;
    return now_.faults() != best_->faults() ? now_.faults() < best_->faults() : now_.shape > best_->shape;
  }

  void divide() {
    run_.finer.resize(invalid_.finer.size());
    for (std::size_t f = 0; f < invalid_.finer.size(); ++f)
      run_.finer[f].insert(run_.finer[f].end(), invalid_.finer[f].begin(), invalid_.finer[f].end());
    // Sizes are asked of the mesh that is cut, if one is.
    const double share = has_quads_only(run_.options.element) ? 1 : 0.5;
    for (const CrossingPlace& p : now_.crossings.fresh)
      for (const std::int32_t f : p.faces) run_.finer[f].push_back({p.place, p.place, share * p.size});
    divide_segments(run_, segments_under(invalid_.coarse));
  }

  /// Those that are as long as what is to be divided, or nearly so.
  [[nodiscard]] std::vector<std::pair<std::int32_t, int>> segments_under(const std::vector<CoarseEdge>& coarse) const {
    std::map<std::pair<int, int>, std::int32_t> curve_of;
    for (std::size_t c = 0; c < run_.topology.curves.size(); ++c)
      if (const auto& uses = run_.topology.curves[c].uses; !uses.empty())
        curve_of.try_emplace({run_.curve_model.face_ref(uses.front()), uses.front().curve + 1}, static_cast<std::int32_t>(c));
    std::vector<std::pair<std::int32_t, int>> segments;
    for (const CoarseEdge& edge : coarse) {
      const auto found = curve_of.find({edge.face, edge.ic});
      if (found == curve_of.end()) continue;
      const std::vector<double>& t = run_.cut_curves[found->second].t_of_use.front();
      for (std::size_t k = 1; k < t.size(); ++k) {
        const double low = std::min(t[k - 1], t[k]), high = std::max(t[k - 1], t[k]);
        const double common = std::min(high, edge.to) - std::max(low, edge.from);
        if (common > 0.5 * (high - low) && high - low > 0.6 * (edge.to - edge.from))
          segments.emplace_back(found->second, static_cast<int>(k) - 1);
      }
    }
    std::ranges::sort(segments);
    segments.erase(std::unique(segments.begin(), segments.end()), segments.end());
    return segments;
  }

  // Patches have smaller sizes beside borders that are shorter than the size, for the sake of their shapes. Nobody asked for these.
  void raise_sizes() {
    const std::optional<double> size = run_.rules.constant();
    if (!size || run_.graded.field || std::ranges::any_of(run_.curves, &DiscreteCurve::prescribed)) return;
    for (double& h : run_.result.vertex_size) h = std::max(h, *size);
    lower_sizes();
  }

  // Curves and their vertices know nothing of what is to be finer.
  void lower_sizes() {
    CompositeResult& result = run_.result;
    for (std::size_t f = 0; f < run_.finer.size(); ++f) {
      if (run_.finer[f].empty()) continue;
      const EdgeSizes sizes(run_.finer[f], run_.slope_of_edges());
      for (const std::int32_t v : result.mesh.faces[f].vertex)
        result.vertex_size[v] = std::min(result.vertex_size[v], sizes.at(result.mesh.vertices[v]));
    }
  }

  CompositeRun& run_;
  Attempts attempts_;
  const std::vector<DiscreteCurve> start_;  // what the first mesh was made with
  const std::vector<std::vector<EdgeSizes::Source>> finer_;
  Made now_;                  // the mesh of now
  InvalidInSpace invalid_;    // the same
  Messages messages_;         // the same
  std::optional<Made> best_;  // empty: no mesh is free
  Messages messages_of_best_;
  double growth_ = 0;  // triangles that finer meshes may have together
};

}  // namespace

bool make_free(CompositeRun& run, const std::function<void()>& mesh_again) { return FreeStep(run, mesh_again).make(); }

}  // namespace carreau
