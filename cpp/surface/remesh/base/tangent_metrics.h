// SPDX-License-Identifier: BSD-3-Clause
// Sizes by direction on a surface: metrics of tangent planes, carried from one plane to the next.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "cad/cad.h"
#include "metric/metric3.h"

namespace carreau {

/// A metric of space with the directions of one tangent plane, without an entry along its normal. Lengths of chords are the lengths of
/// their parts in the plane.
struct PlaneMetric {
  Metric3 metric;
  Vec3 normal;  ///< unit, either side; zero: all of space is known (at a pole, an apex)
};

/// Metrics by face and local vertex; empty: sizes do not differ by direction.
using PlaneMetrics = std::vector<std::vector<PlaneMetric>>;

/// Lifts a metric of (u, v) to the tangent plane of a jet with first derivatives. A jet without a tangent plane gets
/// the isotropic metric of size `h`.
PlaneMetric plane_metric(const SurfaceJet& jet, Metric2 metric, double h) noexcept;

/// The metric in the plane of the unit vector `normal`. Planes are turned into it the short way, then sizes are linear by `weights` (their
/// sum is 1, none is negative).
PlaneMetric interpolate(const std::array<const PlaneMetric*, 3>& corners, const std::array<double, 3>& weights,
                        const Vec3& normal) noexcept;

/// Combines the metrics of all planes that meet at a vertex. Along each normal it takes the larger size of the plane, and then the largest
/// ellipsoid inside all. A single plane keeps its metric.
Metric3 where_planes_meet(std::span<const PlaneMetric> planes);

/// sqrt(h1 h2) in the plane.
double mean_size(const PlaneMetric& m) noexcept;
/// h2 / h1 >= 1.
double anisotropy(const PlaneMetric& m) noexcept;

/// Metric length between both ends of a straight edge, whose lengths by the metrics of the ends are l_p and l_q. Sizes along the edge are
/// linear (HDR eq. 4.83).
double length_between(double l_p, double l_q) noexcept;

/// Squares and products of two vectors in a metric: (p.p, p.q, q.q).
Metric2 gram(const Metric3& m, const Vec3& p, const Vec3& q) noexcept;
/// Q2 of the triangle whose sides from one corner have these products; 0 where it is flat.
double quality_q2(Metric2 gram) noexcept;

}  // namespace carreau
