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
#include "support/infinity.h"
#include "surface/independent/base/charts.h"
#include "surface/independent/base/sharp_edges.h"

namespace carreau {

struct Division;
struct EditedPart;
struct MeshPart;

/// How far triangles may leave the surface.
struct SurfaceTolerances {
  double angle_deg = 0;       ///< A1: of a triangle's normal with the surface's normals at its corners
  double deviation = 0;       ///< A0, model length; 0: `share_of_size` counts
  double share_of_size = 0;   ///< A0 as a share of the size
};

/// Sums of the shapes of some triangles.
struct TriangleShapes {
  double worst = 1;      ///< Q2 in the metric
  double inverses = 0;   ///< sum of 1 / Q2
  double sum = 0;        ///< of Q2
  int count = 0;
  double share = 0;      ///< the largest square of A0 or A1 over its tolerance, by the normals at the corners
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
class FreeMesh final : public PlacedVertices {
 public:
  using Place = EditableMesh::Place;
  using Quad = EditableMesh::Quad;

  FreeMesh(const SurfaceMesh& mesh, const VertexJets& jets, std::span<const double> size,
           std::span<const MeshEdge> sharp, std::span<const std::int32_t> corners, const SurfaceTolerances& tolerances,
           const Charts& charts, Cad& cad);
  /// Starts with some triangles of `whole`. Edits do not join two frozen vertices, since other parts may join them.
  FreeMesh(const FreeMesh& whole, const MeshPart& part);
  /// Starts with other triangles than the triangles of `mesh`. `added`: vertices that follow the vertices of `mesh`;
  /// `sharp`: edges of `triangles`.
  FreeMesh(const SurfaceMesh& mesh, const VertexJets& jets, std::span<const double> size,
           std::span<const MeshEdge> sharp, std::span<const std::int32_t> corners, const SurfaceTolerances& tolerances,
           const Charts& charts, Cad& cad, std::span<const SurfacePlace> added, std::vector<EditableMesh::Triangle> triangles);
  FreeMesh(const FreeMesh&) = delete;
  FreeMesh& operator=(const FreeMesh&) = delete;

  [[nodiscard]] const EditableMesh& mesh() const noexcept { return *mesh_; }
  [[nodiscard]] std::size_t vertices() const noexcept override { return place_.size(); }
  [[nodiscard]] const std::vector<EditableMesh::Triangle>& triangles() const noexcept { return triangles_; }
  [[nodiscard]] bool is_free(std::int32_t v) const override { return several_[v] < 0; }
  [[nodiscard]] bool is_alive(std::int32_t v) const { return !mesh_->fan(v).empty(); }
  [[nodiscard]] const SurfacePlace& place(std::int32_t v) const { return place_[v]; }
  [[nodiscard]] std::span<const SurfacePlace> places(std::int32_t v) const override;
  [[nodiscard]] double size(std::int32_t v) const override { return size_[v]; }
  [[nodiscard]] bool by_direction() const noexcept override { return charts_.by_direction(); }
  /// The metric at a vertex, if sizes differ by direction.
  [[nodiscard]] const Metric3& metric(std::int32_t v) const { return metric_[v]; }
  [[nodiscard]] WantedSize wanted(std::int32_t v) const { return {size_[v], by_direction() ? metric_[v] : Metric3{}}; }
  [[nodiscard]] double size_along(std::int32_t v, std::int32_t w) const override;
  [[nodiscard]] Vec3 position(std::int32_t v) const override { return place_[v].xyz; }

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
  [[nodiscard]] TriangleShapes judge_around(std::int32_t v) const { return judge_fan(v, &FreeMesh::judge); }
  [[nodiscard]] TriangleShapes judge_shapes_around(std::int32_t v) const { return judge_fan(v, &FreeMesh::judge_shape); }
  [[nodiscard]] TriangleShapes judge_agreement_around(std::int32_t v) const {
    return judge_fan(v, &FreeMesh::judge_agreement);
  }
  /// Returns whether edits may replace `before` by `after`.
  [[nodiscard]] static bool agrees(const TriangleShapes& before, const TriangleShapes& after) noexcept;

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
  std::int32_t try_vertex(const SurfacePlace& at);
  void forget_vertex();

  ShapeBudget budget;

  // Edits. Rejected edits change nothing.
  bool collapse(std::int32_t gone, std::int32_t kept) { return !joins_frozen(gone, kept) && mesh_->collapse(gone, kept); }
  bool swap(const Quad& q) { return !(is_frozen(q.c) && is_frozen(q.d)) && mesh_->swap(q); }
  std::int32_t split(const Quad& q, const SurfacePlace& at);
  /// Moves a free vertex and sets its size, without tests.
  void put(std::int32_t v, const SurfacePlace& at, const WantedSize& wanted);
  /// Moves a vertex on a line; the first place has the position.
  void put_kept(std::int32_t v, std::span<const SurfacePlace> at, const WantedSize& wanted);

  /// Number of edits so far, without put(). undo() goes back to a number; the vertices that later edits made are gone.
  [[nodiscard]] std::size_t edits() const noexcept { return mesh_->edits(); }
  void undo(std::size_t edits);

  /// Takes over the results of all parts of a division. Triangles get other numbers, old vertices keep theirs.
  void take(const Division& division, std::vector<EditedPart>&& edited);

  [[nodiscard]] const Charts& charts() const noexcept { return charts_; }
  [[nodiscard]] Cad& cad() const noexcept { return cad_; }

 private:
  using Judge = void (FreeMesh::*)(std::int32_t, std::int32_t, std::int32_t, TriangleShapes&) const;
  [[nodiscard]] TriangleShapes judge_fan(std::int32_t v, Judge how) const;
  void begin(const SurfaceMesh& mesh, const VertexJets& jets, std::span<const MeshEdge> sharp, std::span<const std::int32_t> corners);
  void place_vertices(const SurfaceMesh& mesh, const VertexJets& jets);
  void place_metrics();
  void take(const EditedPart& part, std::int32_t old);
  [[nodiscard]] bool is_frozen(std::int32_t v) const { return static_cast<std::size_t>(v) < frozen_.size() && frozen_[v] != 0; }
  [[nodiscard]] bool joins_frozen(std::int32_t gone, std::int32_t kept) const;
  [[nodiscard]] Metric2 gram_of(std::int32_t a, std::int32_t b, std::int32_t c) const;
  [[nodiscard]] const Vec3& normal_at(std::int32_t v, const Vec3& of_triangle) const;

  std::vector<Vec3> xyz_;
  std::vector<Vec2> uv_;
  std::vector<EditableMesh::Triangle> triangles_;
  std::vector<char> mixed_;
  std::vector<SurfacePlace> place_;
  std::vector<double> size_;
  std::vector<Metric3> metric_;  // by vertex; empty: sizes do not differ by direction
  std::vector<std::int32_t> several_;  // by vertex: index in kept_places_, -1: free
  std::vector<std::vector<SurfacePlace>> kept_places_;
  std::vector<char> frozen_;  // of a part, by vertex; empty: none
  const SurfaceTolerances asked_;
  SurfaceTolerances tolerances_;
  double cosine_;        // of the angle that is tolerated
  bool guards_ = false;  // some triangles of the charts are guarded
  const Charts& charts_;
  Cad& cad_;
  std::optional<EditableMesh> mesh_;
};

}  // namespace carreau
