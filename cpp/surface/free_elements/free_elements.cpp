// SPDX-License-Identifier: BSD-3-Clause
#include "surface/free_elements/free_elements.h"

#include <algorithm>
#include <numbers>
#include <string>
#include <utility>

#include "mesh/elements/jacobian.h"
#include "mesh/flat_mesh.h"
#include "mesh/intersections.h"
#include "support/error.h"
#include "surface/elements/thresholds.h"
#include "surface/free_elements/free_cells.h"
#include "surface/free_elements/free_nodes.h"
#include "surface/free_elements/line_middles.h"
#include "surface/quads/cleanup.h"
#include "surface/quads/pairing.h"
#include "surface/quads/quad_shape.h"
#include "surface/quads/quadrilaterals.h"
#include "surface/quads/smoothing.h"
#include "surface/quads/thresholds.h"
#include "surface/quads/walks.h"

namespace carreau {

namespace {

class FreeElements {
 public:
  FreeElements(const SurfaceMesh& before, const RemeshingFrame& frame, const CompositeOptions& options, Cad& cad,
               FreedMesh& made, Monitor& monitor)
      : before_(before),
        frame_(frame),
        options_(options),
        made_(made),
        monitor_(monitor),
        surface_(*frame.charts, cad),
        vertices_(*made.free),
        lines_(surface_, vertices_, lines_left(frame, *made.free), made.worked, monitor),
        cells_(free_cells(surface_, vertices_, lines_, triangles_of(*made.free), monitor)) {}

  /// `gently`: triangles are joined, and nothing else is changed.
  void run(bool gently) {
    gently_ = gently;
    turn_ears(cells_.quads, [&](std::int32_t a, std::int32_t b) { return is_imposed(cells_, lines_, a, b); });
    if (has_quads(options_.element)) {
      pair();
      if (has_quads_only(options_.element))
        cut();
      else
        split_poor();
    }
    FreeNodes nodes;
    if (is_quadratic(options_.element)) nodes = with_nodes();
    reassemble_with(nodes);
    tell_invalid();
  }

 private:
  static std::vector<FreeCell> triangles_of(const FreeMesh& mesh) {
    std::vector<FreeCell> triangles;
    for (const auto& t : mesh.triangles())
      if (t[0] >= 0) triangles.push_back({t[0], t[1], t[2], -1});
    return triangles;
  }
  static std::vector<SharpLine> lines_left(const RemeshingFrame& frame, const FreeMesh& mesh) {
    std::vector<SharpLine> left;
    for (const SharpLine& line : frame.lines)
      left.push_back(what_is_left(line, [&](std::int32_t v) { return mesh.is_alive(v); }));
    return left;
  }

  [[nodiscard]] double least_in_space() const {
    return surface_.by_direction() ? 0 : thresholds::quads::least_jacobian;
  }

  void pair() {
    using namespace thresholds::quads;
    SpaceQuads& quads = cells_.quads;
    const ImposedEdges imposed = [&](std::int32_t a, std::int32_t b) { return is_imposed(cells_, lines_, a, b); };
    const double turn = turns_per_edge * options_.size.angle_mesh * std::numbers::pi / 180;
    const PairRules rules{imposed, [&](std::int32_t v) { return quads.place(v).xyz; },
                          turn * enlargement_for(options_.element), least_in_space()};
    pair_triangles(quads, rules, monitor_);
    if (gently_) return;
    clean_up(quads, imposed, monitor_);
    join_triangles(quads, imposed, monitor_);
    clean_up(quads, imposed, monitor_);
    smooth();
  }

  void smooth() {
    smooth_quads(cells_.quads, {}, monitor_);
    improve_worst_quads(cells_.quads, thresholds::quads::poor, monitor_);
  }

  void cut() {
    halve(surface_, vertices_, lines_, cells_, monitor_);
    if (!gently_) smooth();
    mend_straight(surface_, vertices_, lines_, cells_, monitor_);
  }

  [[nodiscard]] double jacobian_of(const MixedCell& q) const {
    const auto at = [&](int k) { return cells_.quads.place(q[k]).xyz; };
    return cells_.quads.is_convex(q) ? scaled_jacobian(std::array<Vec3, 4>{at(0), at(1), at(2), at(3)}) : -1;
  }

  void split_poor() {
    std::vector<MixedCell>& cells = cells_.quads.cells();
    for (std::size_t c = 0, n = cells.size(); c < n; ++c)
      if (corners_of(cells[c]) == 4 && !(jacobian_of(cells[c]) > least_in_space())) part(c);
  }
  // Along the shorter diagonal, unless a half would be turned over.
  void part(std::size_t c) {
    std::vector<MixedCell>& cells = cells_.quads.cells();
    const MixedCell q = cells[c];
    const auto at = [&](int k) { return cells_.quads.place(q[k]).xyz; };
    bool other = norm(at(3) - at(1)) < norm(at(2) - at(0));
    const auto halves = [&](bool second) {
      return second ? std::pair<MixedCell, MixedCell>{{q[0], q[1], q[3], -1}, {q[1], q[2], q[3], -1}}
                    : std::pair<MixedCell, MixedCell>{{q[0], q[1], q[2], -1}, {q[0], q[2], q[3], -1}};
    };
    const auto fit = [&](bool second) {
      const auto [one, two] = halves(second);
      return cells_.quads.is_convex(one) && cells_.quads.is_convex(two);
    };
    if (!fit(other) && fit(!other)) other = !other;
    std::tie(cells[c], std::ignore) = halves(other);
    cells.push_back(halves(other).second);
  }

  // A few triangles are allowed: two stand for a quadrilateral that cannot be valid.
  FreeNodes with_nodes() {
    FreeNodes nodes = make_nodes(surface_, vertices_, lines_, cells_, monitor_);
    for (int round = 0; round < thresholds::elements::most_partings && options_.element == Element::q2_0; ++round) {
      bool any = false;
      for (const std::int32_t c : nodes.invalid)
        if (corners_of(cells_.quads.cells()[c]) == 4) part(static_cast<std::size_t>(c)), any = true;
      if (!any) break;
      nodes = make_nodes(surface_, vertices_, lines_, cells_, monitor_);
    }
    if (nodes.moved > 0)
      monitor_.message(Level::detail, "elements of second order: " + std::to_string(nodes.moved) + " moves of nodes");
    return nodes;
  }

  void reassemble_with(FreeNodes& nodes) {
    std::vector<std::int32_t> vertex;
    put_vertices(cells_, vertices_, vertex);
    CellsInSpace all{vertices_, surface_.charts(), surface_.cad(), {}, std::move(nodes.of_cell)};
    for (MixedCell cell : cells_.quads.cells()) {
      for (std::int32_t& v : cell)
        if (v >= 0) v = vertex[v];
      all.cells.push_back(cell);
    }
    FreedMesh result = reassemble(before_, all, lines_.lines(), made_.worked, frame_.corners, monitor_);
    made_.mesh = std::move(result.mesh);
    made_.vertex_size = std::move(result.vertex_size);
    made_.curve_size = std::move(result.curve_size);
    made_.curve_parameters = std::move(result.curve_parameters);
    made_.feet = std::move(result.feet);
    made_.mid_feet = std::move(result.mid_feet);
  }

  void tell_invalid() {
    for (FaceMesh& face : made_.mesh.faces) {
      std::size_t count = 0;
      Vec2 uv{0, 0};
      for (const Cell& cell : local_cells(face)) {
        if (is_valid(face, cell)) continue;
        if (++count == 1) uv = face.uv[cell.nodes[0]];
      }
      if (count == 0) continue;
      const std::string what = Where{.face = face.ref, .uv = uv}.prefix() + std::to_string(count) +
                               (count == 1 ? " element has" : " elements have") + " a Jacobian that is not positive everywhere";
      face.status = FaceStatus::mended;
      face.why += (face.why.empty() ? "" : "; ") + what;
    }
  }
  [[nodiscard]] bool is_valid(const FaceMesh& face, const Cell& cell) const {
    if (cell.kind == CellKind::triangle3) return true;
    std::array<Vec3, 8> nodes;
    const auto n = static_cast<std::size_t>(node_count(cell.kind));
    const auto corners = static_cast<std::int32_t>(face.uv.size());
    for (std::size_t i = 0; i < n; ++i) {
      const std::int32_t node = cell.nodes[i];
      nodes[i] = node < corners ? made_.mesh.vertices[face.vertex[node]]
                                : made_.mesh.mid_vertices[face.mid_vertex[node - corners]];
    }
    return jacobian(cell.kind, {nodes.data(), n}).least() > 0;
  }

  const SurfaceMesh& before_;
  const RemeshingFrame& frame_;
  const CompositeOptions& options_;
  FreedMesh& made_;
  Monitor& monitor_;
  FreeSurface surface_;
  ElementVertices vertices_;
  LineMiddles lines_;
  FreeCells cells_;
  bool gently_ = false;
};

std::int64_t crossings(const SurfaceMesh& mesh, int threads, Monitor& monitor) {
  const FlatMesh flat = flatten(mesh, false);
  return find_intersections(flat.vertices, flat.triangles, {.threads = threads}, monitor).count;
}

}  // namespace

void make_free_elements(const SurfaceMesh& before, const RemeshingFrame& frame, const CompositeOptions& options,
                        Cad& cad, FreedMesh& made, Monitor& monitor) {
  const bool moves = has_quads(options.element);
  const std::int64_t before_them = moves ? crossings(made.mesh, options.threads, monitor) : 0;
  std::vector<std::vector<LineNode>> left;
  for (const WorkedLine& line : made.worked) left.push_back(line.left);
  FreeElements(before, frame, options, cad, made, monitor).run(false);
  if (!moves) return;
  std::int64_t now = crossings(made.mesh, options.threads, monitor);
  if (now > before_them) {
    for (std::size_t k = 0; k < left.size(); ++k) made.worked[k].left = left[k];
    FreeElements(before, frame, options, cad, made, monitor).run(true);
    now = crossings(made.mesh, options.threads, monitor);
  }
  if (now > before_them)
    monitor.message(Level::warning, std::to_string(now) + " pairs of triangles cross, of straight halves of elements: sizes are too large there");
}

}  // namespace carreau
