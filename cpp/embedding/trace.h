// SPDX-License-Identifier: BSD-3-Clause
// A polyline of space as curves in the faces that it lies on.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "embedding/embedded_curve.h"
#include "model/model.h"
#include "support/vec.h"

namespace carreau {

class Projector;

namespace embedding {

/// The geometry of a model, as a trace needs it. Calls are by the run's thread.
struct Ground {
  /// The closest point of an entity, or of all entities of the dimension if `ref` is 0.
  struct Place {
    int ref = 0;
    Vec2 uv;  ///< of a face
    Vec3 xyz;
    double distance = 0;
  };
  std::function<Place(int dimension, const Vec3& x, int ref)> closest;
  /// A face without that curve on which all points lie; 0: none.
  std::function<int(int curve, std::span<const Vec3> points)> other_face;
  std::function<SurfaceJet(int face, unsigned want, const Vec2& uv)> surface;
  /// The point nearest to the segments a-y-b among the curves that both faces have. Returns false if they have none.
  std::function<bool(int face, int other, const Vec3& a, const Vec3& b, Vec3& y)> border;
  /// Returns whether a face has the curve.
  std::function<bool(int face, int curve)> has;
  bool has_curves = true, has_points = true;
  double diagonal = 0;
  double tolerance = 0;  ///< of ends and vertices from faces, model length
};

/// One end of a piece, and the entity of the model that it lies on.
struct End {
  Vec3 at;
  int curve = 0, point = 0;  ///< references; 0: none
};

/// The part of a polyline in one face, without corners inside.
struct Piece {
  int face = 0;  ///< reference
  EmbeddedCurve curve;
  End begin, end;
  int along = 0;  ///< reference of a curve of another face along which it runs, as the foot of a sheet on a body; 0: none
};

/// Throws an InvalidArgument about a place that is too far from the faces.
[[noreturn]] void report_far(const std::string& which, const Vec3& x, const Ground::Place& nearest, double tolerance);

/// Projects the chords of a polyline to the faces. Closed when the last point equals the first. Throws InvalidArgument for points that are
/// farther from the faces than the tolerance, for chords that leave the surface or run along a curve of their face,
/// and for singular points.
std::vector<Piece> trace(const Ground& ground, std::span<const Vec3> points);

}  // namespace embedding
}  // namespace carreau
