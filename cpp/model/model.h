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

/// Progression of the lengths of prescribed edges. Values are part of the C ABI.
enum class Progression : int { equal = 0, arithmetic = 1, geometric = 2, given = 3 };

/// The edges of a curve, prescribed in place of sizes (HDR sec. 2.1, 2.3). Lengths are arc lengths in space, in the
/// direction of the parameter t of the FaceCurve with the prescription.
struct PrescribedEdges {
  Progression progression = Progression::equal;
  int edges = 1;          ///< their number, not of `given`
  double ratio = 1;       ///< > 0: ratio of the last length to the first (arithmetic), of each length to the previous one (geometric)
  std::vector<double> t;  ///< of `given`: the parameters of the vertices inside, strictly increasing; whole curve

  friend bool operator==(const PrescribedEdges&, const PrescribedEdges&) = default;
};

/// A curve as one face sees it; its rank `ic` (from 1) is its index in Face::curves + 1.
/// Gluing cuts curves at the ends of curves of other faces (HDR sec. 4.5.1). The first part of a curve keeps its rank,
/// the others follow behind all curves of the face.
struct FaceCurve {
  CurveType type = CurveType::boundary;
  int ref = 0;             ///< refc: equal for curves that are one in space
  int end1 = 0, end2 = 0;  ///< references of the points at t = a and t = b
  int line = 0;
  /// Treated as one point of space although it has a small extent (eps_collapse, RT-0232 sec. 3.3). The curve keeps its
  /// rank: hosts address curves by it.
  bool collapsed = false;
  /// Rank of the host's curve whose part from t = part_a to t = part_b this is; 0: the host's curve of equal rank,
  /// whole.
  int part_of = 0;
  double part_a = 0, part_b = 0;
  /// Reference of the curve that results name in place of this one, which is a part of it; 0: none.
  int shown_as = 0;
  /// Its prescribed edges, which override sizes; null: sizes decide.
  std::shared_ptr<const PrescribedEdges> edges = {};
};

struct Face {
  int ref = 0;
  /// |orientation| is the rank of a boundary curve; the surface lies on its left when positive, on its right when
  /// negative. 0: a wire, curves of space without area; the host evaluates only its curves.
  int orientation = 1;
  std::vector<FaceCurve> curves;
  std::vector<FacePoint> points;
  std::string name = {};  ///< for people and for files that hold names; empty: none
  std::int32_t rgb = -1;  ///< colour for files that hold colours, 0xRRGGBB (sRGB); -1: none
  int line = 0;
  /// Reference of the face that results name in place of this one, which is a part of it; 0: none.
  int part_of = 0;
  /// In a model of several geometries, the geometry of the face, from 1, in Model::geometries; 0: the host's own.
  int geometry = 0;
  bool discrete = false;  ///< given by triangles: it has no curves, and its mesh is made in space
  /// The reason why the face is not meshed; empty: it is meshed. The library never evaluates such a face, and its
  /// curves may break any rule.
  std::string left_out = {};

  [[nodiscard]] bool is_wire() const noexcept { return orientation == 0; }
};

/// The rank by which the host knows a curve (index in Face::curves).
inline int host_rank(const Face& face, std::size_t curve) {
  const int part_of = face.curves[curve].part_of;
  return part_of != 0 ? part_of : static_cast<int>(curve) + 1;
}

/// References of a geometry among others: the ones from first_ to last_ belong to it, and it counts them from 1. last_
/// is first_ - 1 if it has none.
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
  /// References that replace the references of points in results, if they differ.
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
