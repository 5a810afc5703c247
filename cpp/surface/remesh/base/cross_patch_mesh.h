// SPDX-License-Identifier: BSD-3-Clause
// Triangles of all faces in one mesh of space, each vertex with its place on the surface.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesh/editable_mesh.h"
#include "mesh/trial.h"
#include "support/infinity.h"
#include "surface/remesh/base/charts.h"
#include "surface/remesh/base/placed_vertices.h"
#include "surface/remesh/base/sharp_edges.h"

namespace carreau {

struct Division;
struct EditedPart;
struct MeshPart;

/// How far triangles may leave the surface.
struct SurfaceTolerances {
  double angle_deg = 0;       ///< A1: of a triangle's normal with the surface's normals at its corners
  double deviation = 0;       ///< A0, model length; 0: `share_of_size` counts
  double share_of_size = 0;   ///< A0 as a share of the size

  /// A0 for triangles or edges of size h.
  [[nodiscard]] double deviation_at(double h) const noexcept { return deviation > 0 ? deviation : share_of_size * h; }
};

/// The loss of shapes that collapses between sharp lines may cause. Costs are sums of differences of Q2; triangles that go count against a
/// mean.
struct ShapeBudget {
  double price = infinity;  ///< for an edge that comes into range
  double mean = 0;          ///< Q2 that the mesh is to keep
  double left = infinity;   ///< of all; infinity: whatever it costs
  double floor = 0;         ///< Q2: no edit leaves a triangle that is worse, where none was

  [[nodiscard]] bool is_limited() const noexcept { return left < infinity; }
  /// The loss of shapes by an edit.
  [[nodiscard]] double cost(const TriangleShapes& before, const TriangleShapes& after) const noexcept {
    return before.sum - after.sum - mean * (before.count - after.count);
  }
  [[nodiscard]] bool affords(double cost) const noexcept { return cost <= 0 || cost <= left; }
  void pay(double cost) noexcept { left -= cost; }
};

/// Metric length of a distance between two places with these sizes (HDR eq. 4.83).
inline double length_between_sizes(double distance, double p, double q) noexcept {
  return std::abs(q - p) > 1e-6 * p ? distance * std::log(q / p) / (q - p) : distance / p;
}

/// Vertices of the mesh keep their numbers until the end; new ones follow. Keeps references to `charts`
/// and `cad`.
class CrossPatchMesh : public PlacedVertices {
 public:
  using Place = EditableMesh::Place;
  using Quad = EditableMesh::Quad;

  CrossPatchMesh(const SurfaceMesh& mesh, const VertexJets& jets, std::span<const double> size,
           std::span<const MeshEdge> sharp, std::span<const std::int32_t> corners, const SurfaceTolerances& tolerances,
           const Charts& charts, Cad& cad);
  /// Starts with some triangles of `whole`. Edits do not join two frozen vertices, since other parts may join them.
  CrossPatchMesh(const CrossPatchMesh& whole, const MeshPart& part);
  /// Starts with other triangles than the triangles of `mesh`. `added`: vertices that follow the vertices of `mesh`;
  /// `sharp`: edges of `triangles`.
  CrossPatchMesh(const SurfaceMesh& mesh, const VertexJets& jets, std::span<const double> size,
           std::span<const MeshEdge> sharp, std::span<const std::int32_t> corners, const SurfaceTolerances& tolerances,
           const Charts& charts, Cad& cad, std::span<const SurfacePlace> added, std::vector<EditableMesh::Triangle> triangles);
  CrossPatchMesh(const CrossPatchMesh&) = delete;
  CrossPatchMesh& operator=(const CrossPatchMesh&) = delete;

  [[nodiscard]] const EditableMesh& mesh() const noexcept { return *mesh_; }
  [[nodiscard]] const std::vector<EditableMesh::Triangle>& triangles() const noexcept { return triangles_; }
  [[nodiscard]] bool is_alive(std::int32_t v) const { return !mesh_->fan(v).empty(); }
  /// The metric at a vertex, if sizes differ by direction.
  [[nodiscard]] const Metric3& metric(std::int32_t v) const { return metric_[v]; }

  /// Length in the prescribed metric (HDR eq. 4.83).
  [[nodiscard]] double length(std::int32_t v, std::int32_t w) const;
  /// Twice the area of a triangle in its mean metric.
  [[nodiscard]] double double_area(const EditableMesh::Triangle& t) const;
  /// Adds the triangle with these corners to `shapes`.
  void judge(std::int32_t a, std::int32_t b, std::int32_t c, TriangleShapes& shapes) const {
    judge_shape(a, b, c, shapes);
    judge_agreement(a, b, c, shapes);
  }
  /// Adds its shape alone: much less work, and most edits fail by it.
  void judge_shape(std::int32_t a, std::int32_t b, std::int32_t c, TriangleShapes& shapes) const;
  /// Adds its share alone.
  void judge_agreement(std::int32_t a, std::int32_t b, std::int32_t c, TriangleShapes& shapes) const;
  [[nodiscard]] TriangleShapes judge_around(std::int32_t v) const { return judge_fan(v, &CrossPatchMesh::judge); }
  [[nodiscard]] TriangleShapes judge_shapes_around(std::int32_t v) const { return judge_fan(v, &CrossPatchMesh::judge_shape); }
  [[nodiscard]] TriangleShapes judge_agreement_around(std::int32_t v) const {
    return judge_fan(v, &CrossPatchMesh::judge_agreement);
  }

  /// The surface near `target`, sought from the vertex v; `normal`: on which side, where v is kept.
  [[nodiscard]] std::optional<SurfacePlace> near(std::int32_t v, const Vec3& normal, const Vec3& target);
  [[nodiscard]] WantedSize wanted_at(const SurfacePlace& place) const {
    return wanted_at(std::span<const SurfacePlace>(&place, 1));
  }
  /// The size at a vertex with several places.
  [[nodiscard]] WantedSize wanted_at(std::span<const SurfacePlace> places) const { return charts_.wanted(places); }

  /// Updates sizes after the sizes of the charts have changed.
  void update_sizes();
  /// Updates guarded vertices after triangles of the charts have been guarded.
  void update_guards();
  /// Tightens the tolerances of a mesh that is `factor` times as coarse as prescribed. Its triangles leave the surface no farther than
  /// triangles of the prescribed sizes may, and lean less; 1: the given tolerances.
  void tighten(double factor);

  [[nodiscard]] const SurfaceTolerances& tolerances() const noexcept { return asked_; }

  /// Adds a vertex beside the mesh, to judge edits with it, until forget_vertex().
  std::int32_t try_vertex(const SurfacePlace& at) { return add(at, wanted_at(at)); }
  void forget_vertex() { remove_last(); }

  ShapeBudget budget;

  // Edits. Rejected edits change nothing.
  bool collapse(std::int32_t gone, std::int32_t kept) { return !joins_frozen(gone, kept) && mesh_->collapse(gone, kept); }
  bool swap(const Quad& q) { return !(is_frozen(q.c) && is_frozen(q.d)) && mesh_->swap(q); }
  std::int32_t split(const Quad& q, const SurfacePlace& at);
  /// Puts a vertex there; tests nothing.
  void put(std::int32_t v, const SurfacePlace& at, const WantedSize& wanted);
  /// Moves a vertex on a line; the first place has the position.
  void put_kept(std::int32_t v, std::span<const SurfacePlace> at, const WantedSize& wanted);

  /// Takes over the results of all parts of a division. Triangles get other numbers, old vertices keep theirs.
  void take(const Division& division, std::vector<EditedPart>&& edited);

  [[nodiscard]] const Charts& charts() const noexcept { return charts_; }
  [[nodiscard]] Cad& cad() const noexcept { return cad_; }

  // For Trial. Numbers of edits, and of moves in trials.
  using State = std::array<std::size_t, 2>;
  [[nodiscard]] State state() const noexcept { return {mesh_->edits(), moved_.size()}; }
  bool undo(const State& state);
  void begin_trial() noexcept { ++trials_; }
  void end_trial() noexcept {
    if (--trials_ == 0) moved_.clear();
  }

 private:
  /// A vertex with its values before a move.
  struct Moved {
    std::int32_t vertex;
    SurfacePlace place;
    std::vector<SurfacePlace> kept;  // of a vertex that is not free
    WantedSize wanted;
  };
  void set_place(std::int32_t v, const SurfacePlace& at, const WantedSize& wanted);

  using Judge = void (CrossPatchMesh::*)(std::int32_t, std::int32_t, std::int32_t, TriangleShapes&) const;
  [[nodiscard]] TriangleShapes judge_fan(std::int32_t v, Judge how) const;
  void place_vertices(const SurfaceMesh& mesh, const VertexJets& jets);
  void place_metrics();
  void take(const EditedPart& part, std::int32_t old);
  [[nodiscard]] bool is_frozen(std::int32_t v) const { return static_cast<std::size_t>(v) < frozen_.size() && frozen_[v] != 0; }
  [[nodiscard]] bool joins_frozen(std::int32_t gone, std::int32_t kept) const;
  [[nodiscard]] Metric2 gram_of(std::int32_t a, std::int32_t b, std::int32_t c) const;

  std::vector<Vec3> xyz_;
  std::vector<Vec2> uv_;
  std::vector<EditableMesh::Triangle> triangles_;
  std::vector<char> mixed_;
  std::vector<char> frozen_;  // of a part, by vertex; empty: none
  const SurfaceTolerances asked_;
  SurfaceTolerances tolerances_;
  double cosine_;        // of the angle that is tolerated
  bool guards_ = false;  // some triangles of the charts are guarded
  const Charts& charts_;
  Cad& cad_;
  std::optional<EditableMesh> mesh_;
  int trials_ = 0;            // open ones
  std::vector<Moved> moved_;  // in them
};

}  // namespace carreau
