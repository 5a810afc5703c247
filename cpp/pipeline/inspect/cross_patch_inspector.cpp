// SPDX-License-Identifier: BSD-3-Clause
// Meshes free of the borders of their patches, with all their elements.
#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gradation/edge_sizes.h"
#include "mesh/elements/cell_quality.h"
#include "mesh/flat_mesh.h"
#include "mesh/surface_mesh.h"
#include "pipeline/base/inspector.h"
#include "pipeline/base/run.h"
#include "surface/elements/base/thresholds.h"
#include "surface/elements/second_order/wires.h"
#include "surface/elements/cross_patch/carried_cells.h"
#include "surface/elements/cross_patch/cross_patch_elements.h"
#include "surface/elements/cross_patch/invalid_elements.h"
#include "surface/elements/cross_patch/thresholds.h"
#include "surface/remesh/cross_patch.h"
#include "surface/elements/quads/quadrilaterals.h"

namespace carreau {

namespace {

using namespace thresholds::elements;

/// Holds the messages on a mesh that may be discarded.
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

/// Source of the triangles that elements are made of.
enum class From {
  remeshing,  ///< isotropic triangles, whatever the patches
  patches     ///< placed for quadrilaterals by patches: regular ones, whose lengths know the borders
};

/// The parts of a result that cross-patch remeshing replaces.
class PatchesOfBefore {
 public:
  explicit PatchesOfBefore(const CompositeResult& result)
      : mesh_(result), atlas_(result.atlas), crossings_(result.report.crossings), pairs_(result.crossings) {}
  void give_back(CompositeResult& result) {
    static_cast<SizedMesh&>(result) = std::move(mesh_);
    result.atlas = std::move(atlas_);
    result.report.crossings = crossings_, result.crossings = std::move(pairs_);
  }

 private:
  SizedMesh mesh_;
  std::shared_ptr<const Charts> atlas_;
  std::int64_t crossings_;
  std::vector<TriangleIntersection> pairs_;
};

/// Figures by which a mesh is chosen.
struct Made {
  std::size_t invalid = 0;
  ElementCrossings crossings;
  double shape = 0;            ///< mean
  double elements = 0;

  /// Faults that smaller elements may repair.
  [[nodiscard]] std::size_t faults() const noexcept { return invalid + crossings.fresh.size(); }
};

class CrossPatchInspector final : public Inspector {
 public:
  void inspect(CompositeRun& run) override {
    if (is_first_)
      for (const TriangleIntersection& pair : run.result.crossings) crossings_of_patches_.push_back({pair.place, 0, {}});
    else
      lower_sizes(run);
    is_free_ = make_once(run);
    const auto triangles = static_cast<double>(run.result.mesh.triangle_count());
    if (is_first_)
      growth_ = left_ = max_growth * std::max(few_triangles, triangles);
    else
      left_ -= triangles;
    is_first_ = false;
  }

  [[nodiscard]] bool is_better(const CompositeRun& run) const override {
    if (!is_free_) return false;
    return from_ == From::remeshing ? now_.faults() < best_->faults() : are_patches_better(run);
  }

  void keep() override {
    if (is_free_) best_ = now_;
    messages_of_best_ = messages_;
  }

  [[nodiscard]] std::optional<RefinementRequests> requests(const CompositeRun& run) override {
    if (!run.options.refines_invalid_elements) return {};
    if (from_ == From::remeshing && !remeshing_continues()) return first_of_patches(run);
    if (from_ == From::patches && !patches_continue()) return {};
    ++round_;
    return divide(run);
  }

  [[nodiscard]] bool continues_after_failure() override {
    is_free_ = false;
    return from_ == From::remeshing;
  }

  void report(CompositeRun& run) override {
    for (const auto& [level, text] : messages_of_best_) run.monitor.message(level, text);
    if (best_ && has_quads_only(run.options.element)) halve_sizes(run.result, run.curves);
  }

 private:
  using Messages = std::vector<std::pair<Level, std::string>>;

  bool make_once(CompositeRun& run) {
    const CompositeOptions& options = run.options;
    HeldMonitor monitor(run.monitor);
    now_ = {};
    ElementMaker elements;
    std::string no_images;
    std::optional<PatchesOfBefore> before_elements;
    if (options.element != Element::p1) {
      if (!run.periodic.empty()) share_vertex_sizes(run), before_elements.emplace(run.result);
      elements = [&](const SurfaceMesh& before, const RemeshingFrame& frame, CrossPatchResult& made) {
        now_.crossings = make_cross_patch_elements(before, frame, options, run.cad, made, monitor);
        if (!run.periodic.empty()) no_images = carry_cells(run.curve_model, run.periodic, before, *frame.charts, made);
      };
    }
    const bool by_direction = !run.isotropic();
    bool is_free = true;
    if (from_ == From::remeshing && options.element == Element::p1) raise_sizes(run);
    // Slaves get the elements of their masters; triangles of periodic faces stay.
    FixedParts fixed{.curves = run.periodic.has_class};
    if (options.element == Element::p1) fixed.faces = run.periodic.is_periodic;
    if (from_ == From::remeshing)
      is_free = remesh_across_patches(run.curve_model, run.curves, options, by_direction, fixed, elements, run.result, monitor);
    else
      make_elements_across_patches(run.curve_model, run.curves, options, by_direction, fixed, elements, run.result, monitor);
    if (!no_images.empty()) {
      monitor.message(Level::warning, "no cross-patch remeshing: " + no_images);
      before_elements->give_back(run.result);
      is_free = false;
    }
    messages_ = monitor.held();
    if (!is_free) return false;
    const ElementWork work{run.curve_model, run.curves, run.rules, options, run.result, run.monitor};
    if (has_quads_only(options.element)) halve_wires(work);
    if (is_quadratic(options.element)) give_nodes_to_wires(work);
    if (options.element == Element::p1) return true;
    invalid_ = find_invalid(run.result, options.element);
    now_.invalid = invalid_.count;
    const CellSummary summary = summarise_cells(flatten(run.result.mesh, true));
    now_.shape = summary.shape.mean;
    now_.elements = static_cast<double>(summary.triangles3 + summary.triangles6 + summary.quads4 + summary.quads8);
    return true;
  }

  // Rounds continue while faults are left and the finer meshes stay within their bound.
  [[nodiscard]] bool remeshing_continues() const {
    return is_free_ && round_ < max_divisions && now_.faults() > 0 && left_ >= 0;
  }

  // If borders of patches are not much shorter than elements, quadrilaterals of patches are more regular than pairs of isotropic
  // triangles.
  std::optional<RefinementRequests> first_of_patches(const CompositeRun& run) {
    if (!has_quads(run.options.element)) return {};
    from_ = From::patches, round_ = 0, left_ = growth_;
    return RefinementRequests{.first_curves = true, .patch_elements = true};
  }

  [[nodiscard]] bool patches_continue() const {
    return is_free_ && round_ < thresholds::cross_patch::max_again && now_.faults() > 0 && !is_hopeless() && left_ >= 0;
  }

  // A mesh that is valid already is better than one with faults, even if that one may improve.
  [[nodiscard]] bool is_hopeless() const {
    using thresholds::cross_patch::max_of_patches;
    return best_ && best_->faults() == 0 && (now_.shape <= best_->shape || now_.elements > max_of_patches * best_->elements);
  }

  [[nodiscard]] bool are_patches_better(const CompositeRun& run) const {
    if (!new_places(best_ ? best_->crossings.all : crossings_of_patches_, now_.crossings.all).empty()) return false;
    if (!find_defects(run.result.mesh, {.closed = false, .limit = 1}).empty()) return false;
    if (!best_) return true;
    if (now_.elements > thresholds::cross_patch::max_of_patches * best_->elements) return false;
    return now_.faults() != best_->faults() ? now_.faults() < best_->faults() : now_.shape > best_->shape;
  }

  [[nodiscard]] RefinementRequests divide(const CompositeRun& run) const {
    RefinementRequests requests{.segments = segments_under(run, invalid_.coarse),
                                .sizes = invalid_.finer,
                                .patch_elements = from_ == From::patches};
    // Sizes describe the mesh that is cut, if elements are cut.
    const double share = has_quads_only(run.options.element) ? 1 : 0.5;
    for (const CrossingPlace& p : now_.crossings.fresh)
      for (const std::int32_t f : p.faces) requests.sizes[f].push_back({p.place, p.place, share * p.size});
    return requests;
  }

  /// Segments of curves that are about as long as the edges to divide.
  [[nodiscard]] static std::vector<std::pair<std::int32_t, int>> segments_under(const CompositeRun& run, const std::vector<CoarseEdge>& coarse) {
    std::map<std::pair<int, int>, std::int32_t> curve_of;
    for (std::size_t c = 0; c < run.topology.curves.size(); ++c)
      if (const auto& uses = run.topology.curves[c].uses; !uses.empty())
        curve_of.try_emplace({run.curve_model.face_ref(uses.front()), uses.front().curve + 1}, static_cast<std::int32_t>(c));
    std::vector<std::pair<std::int32_t, int>> segments;
    for (const CoarseEdge& edge : coarse) {
      const auto found = curve_of.find({edge.face, edge.ic});
      if (found == curve_of.end()) continue;
      const std::vector<double>& t = run.cut_curves[found->second].t_of_use.front();
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

  // Patches have smaller sizes beside borders that are shorter than the size, to improve their shapes. The user did not prescribe these.
  static void raise_sizes(CompositeRun& run) {
    const std::optional<double> size = run.rules.constant();
    if (!size || run.graded.field || std::ranges::any_of(run.curves, &DiscreteCurve::prescribed)) return;
    for (double& h : run.result.vertex_size) h = std::max(h, *size);
    lower_sizes(run);
  }

  // Middles of edges depend on sizes: images have equal ones.
  static void share_vertex_sizes(CompositeRun& run) {
    link_periodic(run, false);
    std::vector<double>& size = run.result.vertex_size;
    for (const bool back : {false, true})
      for (const PeriodicLink& link : run.result.mesh.periodic)
        for (const auto& [slave, master] : link.nodes)
          if (back)
            size[slave] = size[master];
          else
            size[master] = std::min(size[master], size[slave]);
    run.result.mesh.periodic.clear();
  }

  // Requests lower the sizes of faces alone; the vertices of curves follow here.
  static void lower_sizes(CompositeRun& run) {
    CompositeResult& result = run.result;
    for (std::size_t f = 0; f < run.finer.size(); ++f) {
      if (run.finer[f].empty()) continue;
      const EdgeSizes sizes(run.finer[f], run.slope_of_edges());
      for (const std::int32_t v : result.mesh.faces[f].vertex)
        result.vertex_size[v] = std::min(result.vertex_size[v], sizes.at(result.mesh.vertices[v]));
    }
  }

  From from_ = From::remeshing;
  int round_ = 0;
  bool is_first_ = true;
  bool is_free_ = false;      // the current mesh
  Made now_;                  // the same
  InvalidInSpace invalid_;    // the same
  Messages messages_;         // the same
  std::optional<Made> best_;  // empty: no mesh is free
  Messages messages_of_best_;
  std::vector<CrossingPlace> crossings_of_patches_;  // of straight triangles, before anything was freed
  double growth_ = 0, left_ = 0;                     // triangles that finer meshes may have together, and may still have
};

}  // namespace

std::unique_ptr<Inspector> make_cross_patch_inspector() { return std::make_unique<CrossPatchInspector>(); }

}  // namespace carreau
