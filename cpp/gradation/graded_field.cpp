// SPDX-License-Identifier: BSD-3-Clause
#include "gradation/graded_field.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gradation/thresholds.h"
#include "model/triangle_sides.h"
#include "support/angles.h"
#include "support/infinity.h"

namespace carreau {

namespace {


bool is_source(const GradationFront& f) noexcept { return dot(f.line, f.line) == 0; }

bool one_wave(const GradationFront& a, const GradationFront& b, bool smooth) noexcept {
  // Between two sources of their own the prescribed sizes decide where they are smooth.
  if (is_source(a) && is_source(b)) return !smooth;
  if (is_source(a) || is_source(b)) return true;
  return dot(a.line, b.line) >= angles::cosine_of_45 * norm(a.line) * norm(b.line);
}

}  // namespace

/// A chord leaves a circle at half the angle that it spans.
Vec3 step_on_surface(const Vec3& normal, const Vec3& chord) noexcept {
  const double up = dot(normal, chord), length = norm(chord);
  const Vec3 flat = chord - up * normal;
  const double l = norm(flat);
  if (!(l > 0)) return {};
  const double sine = std::min(1., std::abs(up) / length);
  return (length * (1 + sine * sine / 6) / l) * flat;
}

namespace {

/// Fills GradedFace::beyond.
void find_beyond(GradedFace& face) {
  face.beyond = triangles_beyond(face.triangles, face.xyz.size());
  for (std::size_t t = 0; t < face.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      std::int32_t& beyond = face.beyond[t][i];
      if (beyond < 0) continue;
      const std::array<std::int32_t, 3>&own = face.triangles[t], &other = face.triangles[static_cast<std::size_t>(beyond)];
      beyond = *std::ranges::find_if(other, [&](std::int32_t v) { return v != own[i] && v != own[(i + 1) % 3]; });
    }
}

}  // namespace

GradedField::GradedField(double slope, std::vector<GradedFace> faces) : slope_(slope), faces_(std::move(faces)) {
  for (GradedFace& face : faces_)
    if (!face.front.empty() || !face.metric.empty()) find_beyond(face);
}

double GradedField::size(int face, const Vec2& uv, const Vec3& xyz, double prescribed) const noexcept {
  if (static_cast<std::size_t>(face) >= faces_.size()) return prescribed;
  const GradedFace& f = faces_[face];
  const TrianglePlace place = f.tree.find(uv);
  if (place.triangle < 0) return prescribed;
  const auto& t = f.triangles[place.triangle];
  const bool smooth = f.smooth[place.triangle] != 0;
  std::array<Vec3, 3> way;
  // If prescribed sizes do not count here, they count at the corners.
  double h = smooth ? prescribed : std::max({f.h[t[0]], f.h[t[1]], f.h[t[2]]}), linear = 0;
  for (int i = 0; i < 3; ++i) {
    const std::int32_t v = t[i];
    way[i] = step_on_surface(f.normal[v], xyz - f.xyz[v]);
    h = std::min(h, f.front[v].source_h + slope_ * norm(f.front[v].line + way[i]));
    linear += place.weight[i] * f.h[v];
  }
  // A front that has come to a corner across a side counts here too; otherwise sizes would jump on that side.
  for (const std::int32_t v : f.beyond[place.triangle])
    if (v >= 0)
      h = std::min(h,
                   f.front[v].source_h + slope_ * norm(f.front[v].line + step_on_surface(f.normal[v], xyz - f.xyz[v])));
  bool wave = true;
  for (int i = 0; i < 3; ++i) {
    const std::int32_t a = t[i], b = t[i == 2 ? 0 : i + 1];
    const bool one = one_wave(f.front[a], f.front[b], smooth), curve = (f.on_curve[place.triangle] >> i & 1) != 0;
    wave = wave && one;
    if (one || curve)
      h = std::min(
          h, size_from_segment(f.h[a], f.h[b], step_on_surface(f.normal[a], f.xyz[b] - f.xyz[a]), way[i], slope_));
  }
  return wave && place.inside ? std::min(h, linear) : h;
}

TangentMetric GradedField::sizes(int face, const Vec2& uv, const Vec3& xyz, TangentMetric prescribed) const noexcept {
  if (static_cast<std::size_t>(face) >= faces_.size()) return prescribed;
  const GradedFace& f = faces_[face];
  const TrianglePlace place = f.tree.find(uv);
  if (place.triangle < 0 || f.smooth[place.triangle] != 0) return prescribed;
  double h1 = 0, h2 = 0;
  for (int i = 0; i < 3; ++i) {
    if (!(place.weight[i] > 0)) continue;
    const TangentMetric& corner = f.metric[f.triangles[place.triangle][i]];
    h1 += place.weight[i] * corner.matched(prescribed.d1);
    h2 += place.weight[i] * corner.matched(prescribed.d2);
  }
  if (!std::isfinite(h1) || !std::isfinite(h2)) return prescribed;
  prescribed.h1 = h1, prescribed.h2 = h2;
  // Means of corners are too large if a corner beside allows less: across a strip it is far nearer than they are.
  const auto bound = [&](std::int32_t v) {
    const TangentMetric& corner = f.metric[v];
    const Vec3 way = step_on_surface(f.normal[v], xyz - f.xyz[v]);
    const double l = norm(way), growth = l > 0 ? 1 + slope_ * l / corner.along((1 / l) * way) : 1;
    prescribed.h1 = std::min(prescribed.h1, growth * corner.matched(prescribed.d1));
    prescribed.h2 = std::min(prescribed.h2, growth * corner.matched(prescribed.d2));
  };
  for (const std::int32_t v : f.triangles[place.triangle]) bound(v);
  for (const std::int32_t v : f.beyond[place.triangle])
    if (v >= 0) bound(v);
  return prescribed;
}

double GradedField::smaller_size(int face, const Vec2& uv) const noexcept {
  if (static_cast<std::size_t>(face) >= faces_.size()) return infinity;
  const GradedFace& f = faces_[face];
  const TrianglePlace place = f.tree.find(uv);
  if (place.triangle < 0 || f.smooth[place.triangle] != 0) return infinity;
  double h = 0;
  for (int i = 0; i < 3; ++i) {
    if (!(place.weight[i] > 0)) continue;
    const TangentMetric& corner = f.metric[f.triangles[place.triangle][i]];
    h += place.weight[i] * std::min(corner.h1, corner.h2);
  }
  return h;
}

}  // namespace carreau
