// SPDX-License-Identifier: BSD-3-Clause
// Background meshes: sizes or metrics at the vertices of a mesh, anywhere by interpolation.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesh/simplices/simplex_search.h"
#include "mesh/surface_mesh.h"
#include "metric/metric2_algebra.h"
#include "metric/metric3.h"
#include "metric/prescription.h"

namespace carreau {

/// The prescriptions at the vertices: one of the three lists is filled.
struct VertexValues {
  std::vector<double> sizes;       ///< in space, > 0
  std::vector<Metric3> space;      ///< metrics of space
  std::vector<Metric2> parameter;  ///< metrics of the parameter plane; plane meshes only

  [[nodiscard]] std::size_t size() const noexcept { return sizes.size() + space.size() + parameter.size(); }
};

/// A mesh with a value at each vertex: of triangles, of tetrahedra, of edges, or of several of them.
struct BackgroundMesh {
  int dimension = 3;           ///< 3: in space; 2: in parameter planes, z = 0
  std::vector<Vec3> vertices;  ///< finite
  std::vector<std::array<std::int32_t, 3>> triangles;
  /// Plane meshes: the reference of the face in whose parameter plane each triangle lies; empty, or 0: any face that
  /// no other triangle names.
  std::vector<std::int32_t> faces;
  VertexValues values;
  std::vector<std::array<std::int32_t, 4>> tetrahedra = {};  ///< of dimension 3
  std::vector<std::array<std::int32_t, 2>> edges =
      {};  ///< of dimension 2: on curves of the faces that no triangle names
};

/// Number of evaluations of a background mesh, and of places that it did not cover.
struct BackgroundReport {
  std::int64_t asked = 0;
  std::int64_t outside = 0;  ///< farther from the mesh than 1/8 of the longest edge of the nearest element
  double farthest = 0;       ///< distance of the farthest point outside; model length, or parameter length
  /// Estimated error of the fields on the background mesh, in the unit of the tolerance; a tolerance of 0: no estimate.
  double estimated_error = 0, tolerance = 0;
  friend bool operator==(const BackgroundReport&, const BackgroundReport&) = default;
};

/// The field of a background mesh. A place is found in logarithmic time. In space it is the nearest point of the mesh,
/// which is the place itself inside a tetrahedron; in a parameter plane it lies in the triangle that holds (u, v).
/// Outside, the nearest point's value holds, and the point is counted. Inside a triangle values follow the law along
/// two segments, from the first vertex towards the second, then towards the third; on edges this gives the law of the
/// edge from either side. In a tetrahedron a third segment leads to the last vertex. Edges alone, with metrics at the
/// vertices of curves (RR-2818 sec. 4.1), answer on curves and points, not inside faces. Answers are as given: not
/// clamped. For one thread.
class BackgroundField final : public PrescriptionSource {
 public:
  /// Throws InvalidArgument, with the vertex or element counted from 0, for a mesh without elements, indices out of
  /// range, lists of wrong lengths, coordinates that are not finite. Sizes must be positive and metrics positive
  /// definite.
  explicit BackgroundField(const BackgroundMesh& mesh);
  /// On a mesh of a session: each face is searched in its parameter plane, and values are the values of the mesh's
  /// vertices in space. The surface is looked up in space for points only. Throws the same.
  BackgroundField(const SurfaceMesh& mesh, VertexValues values);

  [[nodiscard]] std::string name() const override { return "the background mesh"; }
  /// Forgets the report. The law is linear before the first run.
  void begin_run(MetricLaw law) override;
  /// The report in words.
  [[nodiscard]] std::vector<std::string> remarks() const override;
  [[nodiscard]] bool needs_position() const noexcept override { return needs_position_; }
  [[nodiscard]] double accuracy() const noexcept override;
  [[nodiscard]] bool curves_only() const noexcept override;
  Prescription on_surface(int face, Vec2 uv, Vec3 xyz) override;
  Prescription on_curve(int face, int ic, double t, Vec2 uv, Vec3 xyz) override;
  /// A plane mesh does not answer.
  Prescription at_point(int point, Vec3 xyz) override;

  void set_estimate(double error, double tolerance) noexcept { report_.estimated_error = error, report_.tolerance = tolerance; }
  /// Since the last begin_run().
  [[nodiscard]] const BackgroundReport& report() const noexcept { return report_; }

  /// Vertices in the parameter plane of a face from which the field changes by more than a factor 1.5 to a neighbour;
  /// empty for a mesh in space.
  [[nodiscard]] std::vector<Vec2> steep_places(int face) const override;
  /// Vertices of a mesh in space from which the field changes by more than a factor 1.5 to a neighbour, or within a
  /// unit edge on the way there. Empty on a mesh of a session. The reach is the longest edge around.
  [[nodiscard]] std::span<const SteepPlace> steep_in_space() const override { return steep_in_space_; }

 private:
  /// The part of the mesh in one parameter plane, or in space.
  struct Piece {
    std::vector<Vec3> vertices;
    std::vector<Simplex> simplices;   // of vertices
    std::vector<std::int32_t> value;  // of each vertex: index in values_
    SimplexSearch tree = {};
    std::int32_t last = 0;         // simplex that was found last
    bool edges_only = false;       // prescribes nothing inside faces
    std::vector<Vec2> steep = {};  // of a parameter plane: steep_places()

    void prepare();
  };

  void add_planes(const BackgroundMesh& mesh, const std::vector<std::int32_t>& same);
  void check_values(std::size_t vertices) const;
  [[nodiscard]] std::vector<Vec2> steep_vertices(const Piece& piece) const;
  void find_steep_in_space();
  void add_piece(int face, Piece piece);
  [[nodiscard]] Piece* piece_of(int face) noexcept;
  Prescription look_up(Piece& piece, Vec3 p);
  [[nodiscard]] Prescription value_at(const Piece& piece, const NearestOnSimplices& where) const;
  [[nodiscard]] double change(std::int32_t a, std::int32_t b) const;

  VertexValues values_;
  std::map<int, Piece> planes_;  // by reference of the face; 0: any other
  std::optional<Piece> space_;
  std::vector<SteepPlace> steep_in_space_;
  bool needs_position_ = true;
  MetricLaw law_ = MetricLaw::linear;
  BackgroundReport report_;
};

}  // namespace carreau
