// SPDX-License-Identifier: BSD-3-Clause
// Faces, curves and points with their references: the content of x.pardom (RT-0232 sec. 3.2).
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/isometry.h"
#include "model/names.h"
#include "support/vec.h"

namespace carreau {

/// A point imposed inside a face.
struct FacePoint {
  int ref = 0;
  Vec2 uv;
  int line = 0;  ///< of the file it was read from; 0: from memory
};

enum class CurveType : int { boundary = 1, internal = 2 };

/// How the lengths of prescribed edges follow one another. Values are part of the C ABI.
enum class Progression : int { equal = 0, arithmetic = 1, geometric = 2, given = 3 };

/// The edges of a curve, told in place of sizes (HDR sec. 2.1, 2.3). Lengths are those of the curve's arcs in space, in
/// the direction of the parameter t of the FaceCurve that they are prescribed on.
struct PrescribedEdges {
  Progression progression = Progression::equal;
  int edges = 1;          ///< their number, not of `given`
  double ratio = 1;       ///< > 0: of the last length to the first (arithmetic), of each to the one before (geometric)
  std::vector<double> t;  ///< of `given`: the parameters of the vertices inside, strictly increasing; whole curve

  friend bool operator==(const PrescribedEdges&, const PrescribedEdges&) = default;
};

/// A curve as one face sees it; its rank `ic` (from 1) is its index in Face::curves + 1.
/// Gluing cuts curves where curves of other faces end (HDR sec. 4.5.1): the first part of a curve keeps its rank, the
/// others follow behind all curves of the face.
struct FaceCurve {
  CurveType type = CurveType::boundary;
  int ref = 0;             ///< refc: the same for curves that are one in space
  int end1 = 0, end2 = 0;  ///< references of the points at t = a and t = b
  int line = 0;
  /// Treated as one point of space although it has a small extent (eps_collapse, RT-0232 sec. 3.3). The curve keeps its
  /// rank: hosts address curves by it.
  bool collapsed = false;
  /// Rank of the host's curve of which this is the part from t = part_a to t = part_b; 0: the host's curve of the same
  /// rank, whole.
  int part_of = 0;
  double part_a = 0, part_b = 0;
  /// Reference of the curve that results speak of in place of this one, which is a part of it; 0: none.
  int shown_as = 0;
  /// Its edges, whatever sizes say; null: by sizes.
  std::shared_ptr<const PrescribedEdges> edges = {};
};

struct Face {
  int ref = 0;
  /// |orientation| is the rank of a boundary curve; the surface lies on its left when positive, on its right when
  /// negative. 0: a wire, curves of space without area, which only its curves are asked on.
  int orientation = 1;
  std::vector<FaceCurve> curves;
  std::vector<FacePoint> points;
  std::string name = {};  ///< for people and for files that hold names; empty: none
  std::int32_t rgb = -1;  ///< colour for files that hold colours, 0xRRGGBB (sRGB); -1: none
  int line = 0;
  /// Reference of the face that results speak of in place of this one, which is a part of it; 0: none.
  int part_of = 0;
  /// Of a model of several geometries, the one that the face belongs to, from 1, in Model::geometries; 0: the host's own.
  int geometry = 0;
  bool discrete = false;  ///< given by triangles: it has no curves, and its mesh is made in space
  /// Why the face is not meshed: nothing is asked of its geometry, and its curves may break any rule; empty: it is.
  std::string left_out = {};

  [[nodiscard]] bool is_wire() const noexcept { return orientation == 0; }
};

/// The rank by which the host knows a curve (index in Face::curves).
inline int host_rank(const Face& face, std::size_t curve) {
  const int part_of = face.curves[curve].part_of;
  return part_of != 0 ? part_of : static_cast<int>(curve) + 1;
}

/// References of a geometry among others: those from first_ to last_ are its own, which it counts from 1. last_ is
/// first_ - 1 where it has none.
struct GeometryRange {
  int first_face = 1, last_face = 0;
  int first_curve = 1, last_curve = 0;
  int first_point = 1, last_point = 0;
};

/// Faces that are one under a map: the mesh of each slave is the image of its master's mesh.
struct Periodicity {
  std::vector<int> slaves, masters;  ///< references of faces, pair by pair; both empty: all pairs that the map finds
  std::optional<Isometry> map = {};  ///< from masters to slaves; empty: found
  /// Length not 0, without a map: the translation along this direction by the extent of the model.
  Vec3 direction{0, 0, 0};
};

struct Model {
  std::vector<Face> faces;
  std::string source;  ///< name of the file it was read from; empty: from memory
  /// References that results have in place of those of points, where they differ.
  std::map<int, int> shown_points = {};
  std::vector<GeometryRange> geometries = {};  ///< beside the host's own; see Face::geometry
  EntityNames names = {};
  std::vector<Periodicity> periodicities = {};
  bool plane = false;  ///< all of it lies in the plane z = 0, and files of its mesh have dimension 2
};

/// All faces are given by triangles, or some.
[[nodiscard]] inline bool is_discrete(const Model& model) noexcept {
  return !model.faces.empty() &&
         std::all_of(model.faces.begin(), model.faces.end(), [](const Face& face) { return face.discrete; });
}
[[nodiscard]] inline bool has_discrete(const Model& model) noexcept {
  return std::any_of(model.faces.begin(), model.faces.end(), [](const Face& face) { return face.discrete; });
}

}  // namespace carreau
