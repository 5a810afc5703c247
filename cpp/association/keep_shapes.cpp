// SPDX-License-Identifier: BSD-3-Clause
#include "association/keep_shapes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "association/divide_elements.h"
#include "association/harmonic_map.h"
#include "association/thresholds.h"
#include "mesh/editable_mesh.h"
#include "mesh/shape_levels.h"
#include "model/format_point.h"
#include "support/error.h"
#include "support/format.h"
#include "support/work_bounds.h"
#include "surface/improve/bad_region.h"
#include "surface/improve/smoothing.h"
#include "surface/improve/swaps.h"

namespace carreau::refining {

namespace {

using namespace thresholds::association;

/// The triangles of a face around those that are worse, as a patch of their own: fixed vertices come first.
struct Surroundings {
  /// `fixed`: by local vertex; `worse`: triangles of the face.
  Surroundings(const FaceMesh& face, const std::vector<Vec3>& vertices, const std::vector<char>& fixed, const std::vector<std::int32_t>& worse)
      : triangles(worse) {
    std::vector<char> near(face.uv.size(), 0);
    for (int ring = 0; ring < 2; ++ring) {
      for (const std::int32_t t : triangles)
        for (const std::int32_t v : face.triangles[t]) near[v] = 1;
      triangles.clear();
      for (std::size_t t = 2 * static_cast<std::size_t>(face.quads); t < face.triangles.size(); ++t) {
        const Triangle& c = face.triangles[t];
        if ((near[c[0]] | near[c[1]] | near[c[2]]) != 0) triangles.push_back(static_cast<std::int32_t>(t));
      }
    }
    for (const std::int32_t t : triangles) local.insert(local.end(), face.triangles[t].begin(), face.triangles[t].end());
    std::sort(local.begin(), local.end());
    local.erase(std::unique(local.begin(), local.end()), local.end());
    const auto movable = std::stable_partition(local.begin(), local.end(), [&](std::int32_t v) { return near[v] == 0 || fixed[v] != 0; });
    number.assign(face.uv.size(), -1);
    for (auto v = local.begin(); v != local.end(); ++v) {
      number[*v] = static_cast<std::int32_t>(v - local.begin());
      is_fixed.push_back(v < movable ? 1 : 0);
      if (v < movable) domain.vertices.push_back(face.uv[*v]);
      patch.plane.vertices.push_back(face.uv[*v]), patch.xyz.push_back(vertices[face.vertex[*v]]);
    }
    for (const std::int32_t t : triangles) patch.plane.triangles.push_back(renumbered(face.triangles[t], number));
  }

  static Triangle renumbered(const Triangle& t, const std::vector<std::int32_t>& by) { return {by[t[0]], by[t[1]], by[t[2]]}; }

  std::vector<std::int32_t> local;      // of the face, by vertex of the patch
  std::vector<std::int32_t> number;     // of the patch, by vertex of the face; -1: none
  std::vector<std::int32_t> triangles;  // of the face, ascending, by triangle of the patch
  std::vector<char> is_fixed;
  PlaneDomain domain;
  PatchMesh patch;
};

/// Exchanges diagonals of turned triangles if both new triangles are positive. Returns whether one is left.
bool swap_turned(Surroundings& around) {
  PlaneMesh& plane = around.patch.plane;
  EditableMesh mesh(around.domain, plane, around.patch.xyz);
  bool left = false;
  for (int pass = 0; pass < work_bounds::rounds; ++pass) {
    bool changed = false;
    left = false;
    for (std::size_t t = 0; t < plane.triangles.size(); ++t) {
      const EditableMesh::Place place{0, static_cast<std::int32_t>(t)};
      for (int side = 0; side < 3 && !mesh.is_positive(0, mesh.at(place)); ++side)
        if (const std::optional<EditableMesh::Quad> quad = mesh.quad(place, side)) changed = mesh.swap(*quad) || changed;
      left = left || !mesh.is_positive(0, mesh.at(place));
    }
    if (!left || !changed) break;
  }
  return left;
}

std::string rounded(double shape) { return format_number(std::round(1e4 * shape) / 1e4); }

/// Moves vertices until no triangle is turned.
void untangle_patch(Surroundings& around, int ref, Cad& cad) {
  PatchMesh& patch = around.patch;
  const std::vector<Vec2> before = patch.plane.vertices;
  (void)untangle(patch.plane.triangles, around.is_fixed, patch.plane.vertices);
  for (std::size_t v = 0; v < before.size(); ++v)
    if (patch.plane.vertices[v] != before[v]) patch.xyz[v] = surface_at(cad, ref, want_position, patch.plane.vertices[v]).s;
}

}  // namespace

ShapeKeeper::ShapeKeeper(SurfaceMesh& mesh, std::int32_t first_new, Cad& cad, bool isotropic, bool quadratic, Monitor& monitor)
    : mesh_(mesh), first_new_(first_new), cad_(cad), isotropic_(isotropic), quadratic_(quadratic), monitor_(monitor), fixed_(mesh.vertices.size(), 0) {
  for (std::size_t v = 0; v < fixed_.size(); ++v) fixed_[v] = mesh.vertex_ref[v] != 0 ? 1 : 0;
  for (const CurveMesh& curve : mesh.curves) {
    for (const std::int32_t v : curve.vertices) fixed_[v] = 1;
    for (std::size_t k = 1; k < curve.vertices.size(); ++k) curve_edges_.push_back(ordered(curve.vertices[k - 1], curve.vertices[k]));
  }
  std::sort(curve_edges_.begin(), curve_edges_.end());
}

bool ShapeKeeper::is_curve_edge(std::int32_t v, std::int32_t w) const { return std::binary_search(curve_edges_.begin(), curve_edges_.end(), ordered(v, w)); }

template <typename Kept>
std::vector<std::int32_t> ShapeKeeper::triangles_below(const FaceMesh& face, const Kept& kept) const {
  std::vector<std::int32_t> worse;
  for (std::size_t t = 2 * static_cast<std::size_t>(face.quads); t < face.triangles.size(); ++t)
    if (shape_of(face, face.triangles[t], mesh_.vertices) < kept(t)) worse.push_back(static_cast<std::int32_t>(t));
  return worse;
}

void ShapeKeeper::list_chords(std::size_t f, std::vector<Chord>& to) const {
  const FaceMesh& face = mesh_.faces[f];
  for_sides(face, [&](std::int32_t a, std::int32_t b) {
    const std::int32_t v = face.vertex[a], w = face.vertex[b];
    if (fixed_[v] != 0 && fixed_[w] != 0 && !is_curve_edge(v, w)) to.push_back({ordered(v, w), static_cast<std::int32_t>(f), ordered(a, b)});
  });
}

// A new chord of this face that another face has too, or the other side of a seam.
bool ShapeKeeper::repeats_chord(std::size_t f, std::vector<Chord> before) {
  if (!knows_chords_)
    for (std::size_t other = 0; other < mesh_.faces.size(); ++other)
      if (other != f) list_chords(other, chords_);
  knows_chords_ = true;
  std::erase_if(chords_, [&](const Chord& chord) { return chord.face == static_cast<std::int32_t>(f); });
  std::vector<Chord> after;
  list_chords(f, after);
  chords_.insert(chords_.end(), after.begin(), after.end());
  std::sort(chords_.begin(), chords_.end());
  chords_.erase(std::unique(chords_.begin(), chords_.end()), chords_.end());
  std::sort(before.begin(), before.end());
  return std::any_of(after.begin(), after.end(), [&](const Chord& chord) {
    if (std::binary_search(before.begin(), before.end(), chord)) return false;
    const auto first = std::lower_bound(chords_.begin(), chords_.end(), Chord{chord.vertices, 0, {0, 0}});
    return std::next(first) != chords_.end() && std::next(first)->vertices == chord.vertices;
  });
}

void ShapeKeeper::restore(std::size_t f, std::span<const float> before) {
  const FaceMesh& face = mesh_.faces[f];
  const double poor = isotropic_ ? shape_level::bad : 0;
  std::vector<double> goals;
  for (const float shape : before) goals.push_back(std::max<double>(shape, shape_level::bad));
  repair(f, triangles_below(face, [&](std::size_t) { return poor; }), goals, Edits::swaps);
  if (isotropic_)
    repair(f, triangles_below(face, [&](std::size_t t) { return std::max(std::min<double>(before[t], shape_level::good) - shape_loss, 0.0); }), goals, Edits::both);
  if (face.quads == 0) return;
  std::vector<double> kept;
  for (const float shape : before) kept.push_back(isotropic_ && !quadratic_ ? std::max(std::min<double>(shape, shape_level::poor) - shape_loss, 0.0) : 0);
  restore_quads(mesh_.faces[f], mesh_.vertices, cad_, isotropic_, fixed_of(face), kept, first_new_, monitor_);
}

bool ShapeKeeper::smooth(std::size_t f, std::span<const float> before) {
  const FaceMesh& face = mesh_.faces[f];
  std::vector<double> kept;
  for (const float shape : before) kept.push_back(reported_loss * std::min<double>(shape, shape_level::good));
  const std::vector<std::int32_t> worse = triangles_below(face, [&](std::size_t t) { return kept[t]; });
  if (!isotropic_ || 2 * worse.size() > face.triangles.size()) return false;  // the whole face is stretched
  const std::vector<Vec2> places = face.uv;
  repair(f, worse, kept, Edits::moves);
  if (face.quads > 0) restore_quads(mesh_.faces[f], mesh_.vertices, cad_, isotropic_, fixed_of(face), kept, 0, monitor_);
  return face.uv != places;
}

std::vector<char> ShapeKeeper::fixed_of(const FaceMesh& face) const {
  std::vector<char> fixed(face.uv.size());
  for (std::size_t v = 0; v < fixed.size(); ++v) fixed[v] = fixed_[face.vertex[v]];
  for (const Triangle& t : face.flattened)
    for (const std::int32_t v : t) fixed[v] = 1;
  return fixed;
}

void ShapeKeeper::repair(std::size_t f, const std::vector<std::int32_t>& worse, std::span<const double> goals, Edits edits) {
  FaceMesh& face = mesh_.faces[f];
  if (worse.empty()) return;
  std::vector<char> fixed = fixed_of(face);
  for (std::size_t t = 0; t < 2 * static_cast<std::size_t>(face.quads); ++t)
    for (const std::int32_t v : face.triangles[t]) fixed[v] = 1;
  Surroundings around(face, mesh_.vertices, fixed, worse);
  for (const std::int32_t t : around.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t a = face.triangles[t][i], b = face.triangles[t][(i + 1) % 3];
      if (is_curve_edge(face.vertex[a], face.vertex[b])) around.domain.edges.push_back({.a = around.number[a], .b = around.number[b]});
    }
  if (edits != Edits::moves && swap_turned(around)) untangle_patch(around, face.ref, cad_);
  PatchMesh& patch = around.patch;
  if (isotropic_) {
    std::vector<std::int32_t> all(around.triangles.size());
    std::iota(all.begin(), all.end(), 0);
    BadRegion region(around.domain, patch.plane, patch.xyz, std::move(all), 1, monitor_);
    std::vector<float> of_patch;
    for (const std::int32_t t : around.triangles) of_patch.push_back(static_cast<float>(goals[t]));
    for (int round = 0; round < work_bounds::rounds; ++round) {
      region.aim_at({});
      const bool swapped = edits != Edits::moves && swap_in_space(region, around.domain, patch.plane, patch.xyz, monitor_);
      region.aim_at(of_patch);
      if (edits == Edits::swaps || (smooth_in_space(region, around.domain, face.ref, cad_, patch, monitor_).empty() && !swapped)) break;
    }
  }
  std::vector<Chord> chords;
  list_chords(f, chords);
  std::vector<Triangle> triangles;
  for (const std::int32_t t : around.triangles) triangles.push_back(face.triangles[t]);
  for (std::size_t k = 0; k < around.triangles.size(); ++k) face.triangles[around.triangles[k]] = Surroundings::renumbered(patch.plane.triangles[k], around.local);
  if (repeats_chord(f, std::move(chords))) {
    for (std::size_t k = 0; k < around.triangles.size(); ++k) face.triangles[around.triangles[k]] = triangles[k];
    return;
  }
  for (std::size_t v = 0; v < around.local.size(); ++v)
    if (around.is_fixed[v] == 0) {
      face.uv[around.local[v]] = patch.plane.vertices[v];
      mesh_.vertices[face.vertex[around.local[v]]] = patch.xyz[v];
    }
}

std::vector<WorstShape> worst_shapes(const SurfaceMesh& mesh) {
  std::vector<WorstShape> worst(mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const FaceMesh& face = mesh.faces[f];
    for (const Triangle& t : face.triangles)
      if (const double shape = shape_of(face, t, mesh.vertices); shape < worst[f].shape) worst[f].shape = shape, worst[f].vertex = face.vertex[t[0]];
    if (mesh.mid_vertices.empty() && (face.quads > 0 || worst[f].shape < 0)) worst[f].turned = find_turned(face, mesh.vertices);
  }
  return worst;
}

void report_losses(SurfaceMesh& mesh, std::span<const WorstShape> before, const char* by, Monitor& monitor) {
  const std::vector<WorstShape> after = worst_shapes(mesh);
  for (std::size_t f = 0; f < after.size(); ++f) {
    const auto& [shape, vertex, turned] = after[f];
    FaceMesh& face = mesh.faces[f];
    if (shape < 0 && !mesh.mid_vertices.empty()) continue;  // the nodes on edges decide, and invalid elements have a report
    const std::string where = Where{.face = face.shown_ref()}.prefix();
    if (turned.count > before[f].turned.count) {
      const std::string why = where + "the " + by + " has turned " + std::to_string(turned.count) + (turned.count == 1 ? " element" : " elements") +
                              ", the first one at " + format_point(mesh.vertices[turned.first]);
      face.status = FaceStatus::mended, face.why += (face.why.empty() ? "" : "; ") + why;
      monitor.message(Level::warning, why);
    } else if (shape < reported_loss * std::min(before[f].shape, shape_level::good)) {
      monitor.message(Level::warning, where + "the " + by + " has lowered the worst shape (Q2) from " + rounded(before[f].shape) + " to " + rounded(shape) + " at " +
                                          format_point(mesh.vertices[vertex]));
    }
  }
}

}  // namespace carreau::refining
