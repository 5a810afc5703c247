// SPDX-License-Identifier: BSD-3-Clause
#include "surface/elements/cross_patch/cross_patch_elements.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "surface/elements/base/thresholds.h"
#include "surface/elements/cross_patch/element_cells.h"
#include "surface/elements/cross_patch/edge_nodes.h"
#include "surface/elements/cross_patch/invalid_elements.h"
#include "surface/elements/cross_patch/line_middles.h"
#include "surface/elements/cross_patch/thresholds.h"
#include "surface/elements/quads/passes.h"
#include "surface/elements/quads/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::cross_patch;

/// Vertices within a distance from a place stay while quadrilaterals are improved.
using HeldPlaces = std::vector<CrossingPlace>;

/// Triangles that stay triangles: all, or triangles with an edge between vertices near a place.
struct KeptTriangles {
  HeldPlaces near = {};
  bool all = false;
};

class CrossPatchElements {
 public:
  CrossPatchElements(const SurfaceMesh& before, const RemeshingFrame& frame, const CompositeOptions& options, Cad& cad,
               const KeptTriangles& kept, CrossPatchResult& made, Monitor& monitor)
      : before_(before),
        frame_(frame),
        options_(options),
        made_(made),
        monitor_(monitor),
        surface_(*frame.charts, cad),
        vertices_(*made.free),
        lines_(surface_, vertices_, lines_left(frame, *made.free), made.worked, monitor),
        cells_(element_cells(surface_, vertices_, lines_, triangles_of(*made.free), monitor)) {
    mark(kept);
  }

  /// Makes straight elements. `gently`: joins triangles without other changes.
  void make_straight(const HeldPlaces& held, bool gently) {
    held_ = held, gently_ = gently;
    turn_ears(cells_.quads, imposed());
    if (has_quads(options_.element)) {
      pair();
      if (has_quads_only(options_.element))
        cut();
      else
        release(), split_poor(cells_.quads.cells(), surface_.by_direction() ? 0 : thresholds::quads::least_jacobian, positions(), convexity());
    }
    EdgeNodes none;
    if (has_quads(options_.element)) reassemble_with(none);
  }
  void finish() {
    if (is_quadratic(options_.element)) {
      EdgeNodes nodes = with_nodes();
      reassemble_with(nodes);
    }
    tell_invalid(made_.mesh);
  }

 private:
  static std::vector<SpaceCell> triangles_of(const CrossPatchMesh& mesh) {
    std::vector<SpaceCell> triangles;
    for (const auto& t : mesh.triangles())
      if (t[0] >= 0) triangles.push_back({t[0], t[1], t[2], -1});
    return triangles;
  }
  static std::vector<SharpLine> lines_left(const RemeshingFrame& frame, const CrossPatchMesh& mesh) {
    std::vector<SharpLine> left;
    for (const SharpLine& line : frame.lines)
      left.push_back(what_is_left(line, [&](std::int32_t v) { return mesh.is_alive(v); }));
    return left;
  }

  void mark(const KeptTriangles& kept) {
    if (!kept.all && kept.near.empty()) return;
    for (std::size_t v = 0; v < cells_.quads.vertices(); ++v) {
      const auto is_near = [&](const CrossingPlace& p) { return norm(cells_.quads.place(v).xyz - p.place) <= p.size; };
      of_triangles_.push_back(static_cast<char>(kept.all || std::ranges::any_of(kept.near, is_near)));
    }
  }
  /// The edge stays in all edits.
  [[nodiscard]] bool stays(std::int32_t a, std::int32_t b) const {
    const auto is_of_triangles = [&](std::int32_t v) {
      return static_cast<std::size_t>(v) < of_triangles_.size() && of_triangles_[v] != 0;
    };
    return (is_of_triangles(a) && is_of_triangles(b)) || is_imposed(cells_, lines_, a, b);
  }

  [[nodiscard]] ImposedEdges imposed() const {
    return [this](std::int32_t a, std::int32_t b) { return stays(a, b); };
  }
  [[nodiscard]] std::function<const Vec3&(std::int32_t)> positions() const {
    return [this](std::int32_t v) -> const Vec3& { return cells_.quads.place(v).xyz; };
  }
  [[nodiscard]] std::function<bool(const MixedCell&)> convexity() const {
    return [this](const MixedCell& cell) { return cells_.quads.is_convex(cell); };
  }

  void pair() {
    const PairRules rules = pair_rules(options_, !surface_.by_direction(), imposed(), positions());
    pair_triangles(cells_.quads, rules, monitor_);
    if (gently_) return;
    hold();
    improve_quads(cells_.quads, rules.is_imposed, monitor_);
  }

  void cut() {
    release();
    halve(surface_, vertices_, lines_, cells_, monitor_);
    hold();
    if (!gently_) smooth_all(cells_.quads, monitor_);
    release();
    mend_straight(surface_, vertices_, lines_, cells_, monitor_);
  }

  void hold() {
    const SpaceQuads& quads = cells_.quads;
    for (std::size_t v = 0; !held_.empty() && v < quads.vertices(); ++v) {
      const auto is_near = [&](const CrossingPlace& p) { return norm(quads.place(v).xyz - p.place) <= p.size; };
      if (!quads.is_fixed(v) && std::ranges::any_of(held_, is_near)) stay_.push_back(v), cells_.quads.fix(v, true);
    }
  }
  void release() {
    for (const std::size_t v : stay_) cells_.quads.fix(v, false);
    stay_.clear();
  }

  // A few triangles are allowed: two stand for a quadrilateral that cannot be valid.
  EdgeNodes with_nodes() {
    EdgeNodes nodes = make_nodes(surface_, vertices_, lines_, cells_, monitor_);
    for (int round = 0; round < thresholds::elements::max_partings && options_.element == Element::q2_0; ++round) {
      bool any = false;
      for (const std::int32_t c : nodes.invalid)
        if (corners_of(cells_.quads.cells()[c]) == 4) split_quad(cells_.quads.cells(), static_cast<std::size_t>(c), positions(), convexity()), any = true;
      if (!any) break;
      nodes = make_nodes(surface_, vertices_, lines_, cells_, monitor_);
    }
    if (nodes.moved > 0)
      monitor_.message(Level::detail, "elements of second order: " + std::to_string(nodes.moved) + " moves of nodes");
    return nodes;
  }

  void reassemble_with(EdgeNodes& nodes) {
    std::vector<std::int32_t> vertex;
    put_vertices(cells_, vertices_, vertex);
    CellsInSpace all{vertices_, surface_.charts(), surface_.cad(), {}, std::move(nodes.of_cell)};
    for (MixedCell cell : cells_.quads.cells()) {
      for (std::int32_t& v : cell)
        if (v >= 0) v = vertex[v];
      all.cells.push_back(cell);
    }
    static_cast<SizedMesh&>(made_) = reassemble(before_, all, lines_.lines(), made_.worked, frame_.corners, frame_.workers, monitor_);
  }

  const SurfaceMesh& before_;
  const RemeshingFrame& frame_;
  const CompositeOptions& options_;
  CrossPatchResult& made_;
  Monitor& monitor_;
  AtlasSurface surface_;
  PlacedVertices vertices_;
  LineMiddles lines_;
  ElementCells cells_;
  HeldPlaces held_;
  std::vector<std::size_t> stay_;   // of them
  std::vector<char> of_triangles_;  // by local vertex of the triangles; empty: no such vertex stays
  bool gently_ = false;
};

/// Makes elements until they are joined as the triangles are.
class ElementRounds {
 public:
  ElementRounds(const SurfaceMesh& before, const RemeshingFrame& frame, const CompositeOptions& options, Cad& cad, CrossPatchResult& made,
                Monitor& monitor)
      : before_(before), frame_(frame), options_(options), cad_(cad), made_(made), monitor_(monitor) {
    for (const WorkedLine& line : made.worked) left_.push_back(line.left);
  }

  ElementCrossings run() {
    if (has_quads(options_.element)) crossings_before_ = find_crossing_places(made_, options_.executor.threads, monitor_);
    const std::size_t wrong_before = find_wrong_joints(made_.mesh).size();
    KeptTriangles kept;
    for (int round = 1;; ++round) {
      make_all(kept);
      const std::vector<std::int32_t> wrong = find_wrong_joints(made_.mesh);
      if (wrong.size() <= wrong_before) break;
      if (kept.all) {
        fail_wrong_joints(made_);
        break;
      }
      monitor_.message(Level::detail, "elements are joined wrongly at " + std::to_string(wrong.size()) +
                                          " vertices: triangles around them stay");
      for (const std::int32_t v : wrong)
        kept.near.push_back({made_.mesh.vertices[v], kept_sizes * std::exp2(round) * made_.vertex_size[v], {}});
      kept.all = round == max_again;
    }
    if (!has_quads(options_.element)) return {};
    if (!fresh_.empty())
      monitor_.message(Level::warning, std::to_string(fresh_.size()) +
                                           " pairs of triangles cross, of straight halves of elements: sizes are too large there");
    return {find_crossing_places(made_, options_.executor.threads, monitor_), std::move(fresh_)};
  }

 private:
  void make_all(const KeptTriangles& kept) {
    HeldPlaces held, held_by_best;
    std::size_t fewest = 0;
    for (int attempt = 0; attempt < max_again; ++attempt) {
      make(held, kept, kept.all);
      if (attempt == 0 || fresh_.size() < fewest) fewest = fresh_.size(), held_by_best = held;
      if (fresh_.empty() || kept.all) break;
      for (const CrossingPlace& p : fresh_) held.push_back({p.place, held_sizes * std::exp2(attempt) * p.size, {}});
    }
    if (fewest > 0 && !kept.all) make({}, kept, true);
    if (fewest > 0 && !fresh_.empty() && !kept.all) make(held_by_best, kept, false);
    elements_->finish();
  }

  void make(const HeldPlaces& held, const KeptTriangles& kept, bool gently) {
    for (std::size_t k = 0; k < left_.size(); ++k) made_.worked[k].left = left_[k];
    elements_ = std::make_unique<CrossPatchElements>(before_, frame_, options_, cad_, kept, made_, monitor_);
    elements_->make_straight(held, gently);
    fresh_.clear();
    if (has_quads(options_.element)) fresh_ = new_places(crossings_before_, find_crossing_places(made_, options_.executor.threads, monitor_));
  }

  const SurfaceMesh& before_;
  const RemeshingFrame& frame_;
  const CompositeOptions& options_;
  Cad& cad_;
  CrossPatchResult& made_;
  Monitor& monitor_;
  std::vector<std::vector<LineNode>> left_;  // by line, of the triangles
  std::vector<CrossingPlace> crossings_before_, fresh_;
  std::unique_ptr<CrossPatchElements> elements_;
};

}  // namespace

ElementCrossings make_cross_patch_elements(const SurfaceMesh& before, const RemeshingFrame& frame, const CompositeOptions& options,
                                    Cad& cad, CrossPatchResult& made, Monitor& monitor) {
  return ElementRounds(before, frame, options, cad, made, monitor).run();
}

}  // namespace carreau
