// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/inspect/face_triangle.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "cad/fundamental_forms.h"

namespace carreau {

namespace {

// Points of a curve between the ends of a side: the arc deviates from their polyline by a 64th of its deviation from
// the side.
constexpr int arc_points = 7;

std::uint64_t key_of(std::int32_t v, std::int32_t w) {
  const auto [low, high] = std::minmax(v, w);
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(low)) << 32 | static_cast<std::uint32_t>(high);
}

Vec2 nearest_on_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 ab = b - a;
  const double length = dot(ab, ab);
  const double share = length > 0 ? std::clamp(dot(p - a, ab) / length, 0.0, 1.0) : 0;
  return a + share * ab;
}

}  // namespace

CurveEdges::CurveEdges(const SurfaceMesh& mesh, const std::vector<DiscreteCurve>& curves) {
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const std::vector<std::int32_t>& chain = mesh.curves[c].vertices;
    if (static_cast<int>(chain.size()) != curves[c].segments() + 1) continue;
    for (std::size_t k = 0; k + 1 < chain.size(); ++k)
      segments_.try_emplace(key_of(chain[k], chain[k + 1]), SegmentOfCurve{static_cast<int>(c), static_cast<int>(k)});
  }
}

const SegmentOfCurve* CurveEdges::find(std::int32_t v, std::int32_t w) const {
  const auto found = segments_.find(key_of(v, w));
  return found == segments_.end() ? nullptr : &found->second;
}

FaceTriangle::FaceTriangle(const SurfaceMesh& mesh, int face, int local, const CurveEdges& edges,
                           const std::vector<DiscreteCurve>& curves, const CurveModel& model) {
  const FaceMesh& of = mesh.faces[static_cast<std::size_t>(face)];
  const std::array<std::int32_t, 3>& t = of.triangles[static_cast<std::size_t>(local)];
  std::array<Vec3, 3> xyz;
  for (std::size_t k = 0; k < 3; ++k) xyz[k] = mesh.vertices[of.vertex[t[k]]], uv_[k] = of.uv[t[k]];
  ref_ = of.ref;
  origin_ = xyz[0];
  const Vec3 ab = xyz[1] - xyz[0], ac = xyz[2] - xyz[0], n = cross(ab, ac);
  longest_ = std::max({norm(ab), norm(ac), norm(ac - ab)});
  sound_ = norm(n) > 0 && cross(uv_[1] - uv_[0], uv_[2] - uv_[0]) != 0;
  if (!sound_) return;
  e1_ = ab / norm(ab), e2_ = cross(n, ab).normalized();
  for (std::size_t k = 0; k < 3; ++k) corner_[k] = position_of(xyz[k]);
  for (std::size_t k = 0; k < 3; ++k) {
    outline_.push_back(corner_[k]);
    if (const SegmentOfCurve* segment = edges.find(of.vertex[t[k]], of.vertex[t[(k + 1) % 3]]))
      add_side(mesh, face, k, *segment, curves, model);
  }
  const Vec3 centroid = (xyz[0] + xyz[1] + xyz[2]) / 3;
  sagitta_ = norm(evaluate(model.cad, nearest(position_of(centroid))).jet.s - centroid);
}

// A seam has two uses in its face. The use with the ends of the side counts.
void FaceTriangle::add_side(const SurfaceMesh& mesh, int face, std::size_t side, const SegmentOfCurve& segment,
                            const std::vector<DiscreteCurve>& curves, const CurveModel& model) {
  const DiscreteCurve& curve = curves[static_cast<std::size_t>(segment.curve)];
  const std::vector<CurveUse>& uses = model.curve(segment.curve).uses;
  const auto k = static_cast<std::size_t>(segment.segment);
  const Vec2 &a = uv_[side], &b = uv_[(side + 1) % 3];
  double best = infinity;
  std::size_t use = uses.size();
  bool forward = true;
  for (std::size_t u = 0; u < uses.size(); ++u) {
    if (uses[u].face != face) continue;
    const Vec2 &p = curve.uv_of_use[u][k], &q = curve.uv_of_use[u][k + 1];
    const double along = norm(p - a) + norm(q - b), against = norm(q - a) + norm(p - b);
    if (std::min(along, against) < best) best = std::min(along, against), use = u, forward = along <= against;
  }
  if (use == uses.size() || mesh.faces[static_cast<std::size_t>(face)].uv.empty()) return;
  const std::vector<double>& t = curve.t_of_use[use];
  const Vec2 u1 = uv_[1] - uv_[0], u2 = uv_[2] - uv_[0];
  for (int i = 1; i <= arc_points; ++i) {
    const double share = static_cast<double>(i) / (arc_points + 1);
    const double at = std::lerp(t[k], t[k + 1], forward ? share : 1 - share);
    const Vec2 c = model.cad.curve(ref_, uses[use].curve + 1, want_position, at).c - uv_[0];
    const double area = cross(u1, u2), s1 = cross(c, u2) / area, s2 = cross(u1, c) / area;
    outline_.emplace_back(corner_[0] + s1 * (corner_[1] - corner_[0]) + s2 * (corner_[2] - corner_[0]));
  }
}

// Even-odd rule.
bool FaceTriangle::holds(const Vec2& at) const noexcept {
  bool inside = false;
  for (std::size_t i = 0, j = outline_.size() - 1; i < outline_.size(); j = i++) {
    const Vec2 &p = outline_[i], &q = outline_[j];
    if ((p.y() > at.y()) == (q.y() > at.y())) continue;
    if (at.x() < p.x() + (at.y() - p.y()) / (q.y() - p.y()) * (q.x() - p.x())) inside = !inside;
  }
  return inside;
}

Vec2 FaceTriangle::nearest(const Vec2& at) const {
  if (holds(at)) return at;
  Vec2 best = outline_.front();
  for (std::size_t i = 0, j = outline_.size() - 1; i < outline_.size(); j = i++)
    if (const Vec2 p = nearest_on_segment(at, outline_[j], outline_[i]); norm(p - at) < norm(best - at)) best = p;
  return best;
}

OnFace FaceTriangle::evaluate(Cad& cad, const Vec2& at) const {
  const Vec2 b = corner_[1] - corner_[0], c = corner_[2] - corner_[0], p = at - corner_[0];
  const double area = cross(b, c), s1 = cross(p, c) / area, s2 = cross(b, p) / area;
  const Vec2 uv = uv_[0] + s1 * (uv_[1] - uv_[0]) + s2 * (uv_[2] - uv_[0]);
  OnFace point{at, surface_at(cad, ref_, want_position | want_first, uv), {}};
  point.normal = unit_normal(point.jet).value_or(Vec3{});
  return point;
}

Vec2 FaceTriangle::project(const OnFace& p, const Vec3& x) const {
  // The derivatives of the point with respect to positions in the plane.
  const Vec2 b = corner_[1] - corner_[0], c = corner_[2] - corner_[0], u1 = uv_[1] - uv_[0], u2 = uv_[2] - uv_[0];
  const double area = cross(b, c);
  const Vec2 along_x = (c.y() * u1 - b.y() * u2) / area, along_y = (b.x() * u2 - c.x() * u1) / area;
  SurfaceJet jet = p.jet;
  jet.su = along_x.x() * p.jet.su + along_x.y() * p.jet.sv;
  jet.sv = along_y.x() * p.jet.su + along_y.y() * p.jet.sv;
  const FirstForm form = first_form(jet);
  const Vec3 d = x - jet.s;
  const double det = form.e * form.g - form.f * form.f;
  if (!(det > 0)) return p.at;
  const double du = dot(d, jet.su), dv = dot(d, jet.sv);
  return p.at + Vec2{(form.g * du - form.f * dv) / det, (form.e * dv - form.f * du) / det};
}

}  // namespace carreau
