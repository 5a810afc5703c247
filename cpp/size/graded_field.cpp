#include "size/graded_field.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace carreau {

namespace {

// Lines that are one wave from a line of sources, not two cones (cosine).
constexpr double same_wave = 0.7;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// From a corner to a point nearby, in the corner's tangent plane and as long as the arc: a chord leaves a circle at
/// half the angle that it spans.
Vec3 step(Vec3 normal, Vec3 chord) noexcept {
  const double up = dot(normal, chord), length = norm(chord);
  const Vec3 flat = chord - up * normal;
  const double l = norm(flat);
  if (!(l > 0)) return {};
  const double sine = std::min(1., std::abs(up) / length);
  return (length * (1 + sine * sine / 6) / l) * flat;
}

bool is_source(const GradationFront& f) noexcept { return dot(f.line, f.line) == 0; }

}  // namespace

/// A corner of the triangle around a point, and the way from it to the point.
struct GradedField::Corner {
  double h = 0;
  GradationFront front;
  Vec3 xyz, normal, to_point;
};

namespace {

/// min over the points p of the segment from corner a along `edge` of size(p) + slope |p - x|, x being at `d` from a;
/// sizes are linear along it.
double from_segment(double h_a, double h_b, Vec3 edge, Vec3 d, double slope) noexcept {
  const double length = norm(edge);
  if (!(length > 0)) return infinity;
  const double climb = (h_b - h_a) / (slope * length);
  const double along = dot(d, edge) / length;
  const double up = std::sqrt(std::max(0., dot(d, d) - along * along));
  double foot = climb >= 1 ? 0. : climb <= -1 ? length : along - climb * up / std::sqrt(1 - climb * climb);
  foot = std::clamp(foot, 0., length);
  return h_a + (h_b - h_a) * (foot / length) + slope * std::hypot(along - foot, up);
}

bool one_wave(const GradationFront& a, const GradationFront& b) noexcept {
  // Between two sources of their own the prescribed sizes decide.
  if (is_source(a) && is_source(b)) return false;
  if (is_source(a) || is_source(b)) return true;
  return dot(a.line, b.line) >= same_wave * norm(a.line) * norm(b.line);
}

}  // namespace

GradedField::GradedField(double slope, std::vector<GradedFace> faces, Monitor& monitor) : slope_(slope) {
  faces_.reserve(faces.size());
  for (GradedFace& face : faces) {
    monitor.checkpoint();
    TriangleTree tree(face.uv, face.triangles, monitor);
    faces_.push_back({std::move(face), std::move(tree)});
  }
}

double GradedField::at(int face, Vec2 uv, Vec3 xyz) const noexcept {
  if (static_cast<std::size_t>(face) >= faces_.size()) return infinity;
  const Face& f = faces_[face];
  const TrianglePlace place = f.tree.find(uv);
  if (place.triangle < 0) return infinity;
  const auto& t = f.data.triangles[place.triangle];
  std::array<Corner, 3> corner;
  double h = infinity, linear = 0;
  for (int i = 0; i < 3; ++i) {
    const std::int32_t v = t[i];
    corner[i] = {f.data.h[v], f.data.front[v], f.data.xyz[v], f.data.normal[v], {}};
    corner[i].to_point = step(corner[i].normal, xyz - corner[i].xyz);
    h = std::min(h, corner[i].front.source_h + slope_ * norm(corner[i].front.line + corner[i].to_point));
    linear += place.weight[i] * corner[i].h;
  }
  bool wave = true;
  for (int i = 0; i < 3; ++i) {
    const Corner &a = corner[i], &b = corner[i == 2 ? 0 : i + 1];
    const bool one = one_wave(a.front, b.front), curve = (f.data.on_curve[place.triangle] >> i & 1) != 0;
    wave = wave && one;
    if (one || curve) h = std::min(h, from_segment(a.h, b.h, step(a.normal, b.xyz - a.xyz), a.to_point, slope_));
  }
  if (wave && place.inside) h = std::min(h, linear);
  return h;
}

}  // namespace carreau
