// SPDX-License-Identifier: BSD-3-Clause
// Places on a chain of curves of one face, by length.
#pragma once

#include <vector>

#include "curve/discrete_curve.h"
#include "surface/narrow/narrow_faces.h"

namespace carreau {

/// The curves of a side end to end, by the supports of the face itself. The coordinate s is the length of the curves
/// from its start, which the fractions DiscreteCurve::r measure too. The chords of the supports are up to 5e-5 shorter,
/// unevenly.
class SideRuler {
 public:
  struct Place {
    std::size_t part = 0;  ///< rank of a curve in the side
    double r = 0;          ///< fraction of the curve's length in the direction of its first use (DiscreteCurve::r)
    double s = 0;
  };

  /// Keeps references to `model`.
  SideRuler(const CurveModel& model, int face, const Side& side);

  [[nodiscard]] double length() const noexcept { return start_.back(); }
  /// Index in Topology::curves.
  [[nodiscard]] int curve(std::size_t part) const { return parts_[part].curve; }
  [[nodiscard]] std::size_t parts() const noexcept { return parts_.size(); }
  /// The side runs against the direction of the curve's first use.
  [[nodiscard]] bool against(std::size_t part) const { return parts_[part].against; }
  /// The start of a part; start(parts()) is the length.
  [[nodiscard]] double start(std::size_t part) const { return start_[part]; }
  [[nodiscard]] double s_of(std::size_t part, double r) const {
    const double along = parts_[part].against ? 1 - r : r;
    return start_[part] + along * (start_[part + 1] - start_[part]);
  }
  /// The place nearest to a point of space.
  [[nodiscard]] Place place_of(const Vec3& p) const;
  [[nodiscard]] Vec3 point_at(double s) const;
  [[nodiscard]] const std::vector<Vec3>& points() const noexcept { return points_; }

 private:
  struct Part {
    int curve;
    bool against;
  };

  std::vector<Part> parts_;
  std::vector<double> start_;  // of each part, and the end
  std::vector<Vec3> points_;   // of the supports, in the direction of the side
  std::vector<double> arc_;    // length of the curves to each of them
};

/// Distance along a side below which two vertices are at one place of the strip.
[[nodiscard]] double same_place_distance(const NarrowFace& narrow, const SideRuler& side);

}  // namespace carreau
