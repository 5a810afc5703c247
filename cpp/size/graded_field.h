// A graded size field over a composite surface, evaluated anywhere.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "size/gradation.h"
#include "size/triangle_tree.h"
#include "support/monitor.h"
#include "support/vec.h"

namespace carreau {

/// What the grading knows on one face: triangles of its parameter domain, and at their corners what came from where.
struct GradedFace {
  std::vector<Vec2> uv;
  std::vector<Vec3> xyz, normal;  ///< normal: unit, either side
  std::vector<double> h;          ///< graded size
  std::vector<GradationFront> front;
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< counterclockwise in (u, v)
  /// By triangle: bit i is set when the side from corner i to the next one lies on a curve, along which sizes between
  /// the corners are interpolated.
  std::vector<std::uint8_t> on_curve;
};

/// The largest size allowed at a place by the graded sizes around it: h(x) = min over sources y of h(y) + slope |x - y|
/// (HDR sec. 1.1.2; Borouchaki, Hecht, Frey). The sources are those of the fronts at the corners of the triangle around
/// x, and those parts of curves between corners; it is not bounded by sizes prescribed at x itself. Safe from several
/// threads.
class GradedField {
 public:
  /// By face (index in Model::faces); a face without triangles bounds nothing.
  GradedField(double slope, std::vector<GradedFace> faces, Monitor& monitor);

  [[nodiscard]] double slope() const noexcept { return slope_; }
  /// At (u, v) in a face, whose image is `xyz`; +infinity where the field says nothing. Logarithmic in the number of
  /// triangles. Outside the triangles, the nearest one.
  [[nodiscard]] double at(int face, Vec2 uv, Vec3 xyz) const noexcept;

 private:
  struct Corner;
  struct Face {
    GradedFace data;
    TriangleTree tree;
  };

  double slope_;
  std::vector<Face> faces_;
};

/// What is made of a prescribed size before a mesh is: bounded by a graded field, multiplied, bounded by a constant.
struct SizeLimits {
  const GradedField* field = nullptr;  ///< null: no bound
  double factor = 1;
  double largest = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool idle() const noexcept {
    return field == nullptr && factor == 1 && largest == std::numeric_limits<double>::infinity();
  }
};

}  // namespace carreau
