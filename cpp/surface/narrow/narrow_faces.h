// SPDX-License-Identifier: BSD-3-Clause
// Faces that are narrower than the triangles of the prescribed sizes: matched sides, one layer of triangles, or no
// triangles.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "curve/discrete_curve.h"
#include "surface/domain/domain_builder.h"
#include "surface/patch.h"

namespace carreau {

/// A curve of a face as a part of one of its sides.
struct SidePart {
  int curve = 0;      ///< index in Face::curves
  bool back = false;  ///< the side runs against the face's own direction of the curve
};
using Side = std::vector<SidePart>;

/// A face between two sides that are near each other.
struct NarrowFace {
  int face = 0;                   ///< index in Model::faces
  double width = 0;               ///< two-sided Hausdorff distance of the sides (HDR sec. 4.5.1), model length
  double size = 0;                ///< smallest size prescribed on its curves
  bool ring = false;              ///< both sides are closed
  bool point = false;             ///< no longer than wide: the whole face is near a point; it has no sides
  std::array<Side, 2> side = {};  ///< both run the same way
  /// The curves that join the starts and the ends of the sides, from side[0] to side[1]; empty where the sides meet.
  std::array<Side, 2> end_cap = {};
};

/// Faces narrower than `ratio` times the smallest size on their curves. Such a face has one loop that two of its
/// corners or short curves cut into two near sides, or two near loops. Its loop may also be all near a point. Faces
/// with internal curves or imposed points, and faces whose sides are one curve, do not count as narrow. In the order of
/// the model.
std::vector<NarrowFace> find_narrow_faces(const CurveModel& model, const std::vector<DiscreteCurve>& curves,
                                          double ratio);

/// The narrow faces of a model in one run.
struct NarrowModel {
  std::vector<NarrowFace> strips;  ///< with two sides
  std::vector<NarrowFace> points;  ///< near a point
  /// The end caps of strips and all curves of points, when their faces are to collapse.
  VanishingCurves vanishing;
  std::vector<int> folded;  ///< faces without width (find_folded_faces()), which are never meshed

  [[nodiscard]] bool empty() const noexcept { return strips.empty() && points.empty(); }
};

/// Slivers below the tolerance of their file. Their whole boundary runs there and back along the same curves, and their
/// width is within the gap of these curves. A closed surface along its seam does not count. Faces all of whose sides
/// are degenerate, and that lie where their sides do, are included. Indices in Model::faces, ascending.
std::vector<int> find_folded_faces(const CurveModel& model, const std::vector<DiscreteCurve>& curves);

/// Fills `vanishing`. A face whose curves are a whole loop of a second face, a small hole, is left out of the lists.
/// The hole would vanish with it.
void let_end_caps_vanish(const CurveModel& model, NarrowModel& narrow);

/// How the sides of narrow faces were matched.
struct SidesMatched {
  std::vector<int> changed;  ///< curves that have other vertices than before, ascending
  /// Faces whose sides exchange vertices without end, since places along them disagree: indices in Model::faces,
  /// ascending. The curves ignore these faces, which are meshed like other faces.
  std::vector<int> unmatched;
};

/// Gives the two sides of each face vertices at equal places. Vertices of each side are copied to the other side, ends
/// of curves to both.
SidesMatched match_sides(const CurveModel& model, std::span<const NarrowFace> faces, std::vector<DiscreteCurve>& curves);

/// Completes the match after splits of segments: inserts the vertices that only one side has. Calls the host only if
/// vertices are missing.
SidesMatched complete_sides(const CurveModel& model, std::span<const NarrowFace> faces,
                            std::vector<DiscreteCurve>& curves);

/// Removes faces (indices in Model::faces, ascending) from the list of strips: they are meshed like other faces.
void leave_to_mesher(std::span<const int> faces, std::vector<NarrowFace>& strips);

/// A narrow face meshed between its sides.
struct NarrowPatch {
  FaceDomain domain;
  PatchMesh mesh;
  /// Local vertices that become one when the face collapses.
  std::vector<std::vector<std::int32_t>> one;
  bool sound = false;  ///< all triangles have a positive area in (u, v), and an area in space
};

/// One layer of triangles between the vertices of both sides, without a new vertex.
NarrowPatch mesh_between_sides(const CurveModel& model, const NarrowFace& narrow,
                               const std::vector<DiscreteCurve>& curves);

}  // namespace carreau
