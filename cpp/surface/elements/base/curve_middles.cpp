// SPDX-License-Identifier: BSD-3-Clause
#include "surface/elements/base/curve_middles.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "periodic/closest.h"
#include "periodic/root_maps.h"
#include "periodic/shared_curves.h"
#include "periodic/thresholds.h"
#include "support/rounding_of.h"

namespace carreau {

namespace {

// Returns false for curves that vanished faces have left (assembly/narrow_collapse), which do not belong to the model.
bool is_known(const ElementWork& work, std::size_t curve) {
  if (curve >= work.curves.size()) return false;
  const DiscreteCurve& d = work.curves[curve];
  const std::vector<std::int32_t>& v = work.result.mesh.curves[curve].vertices;
  return !d.indivisible && v.size() == static_cast<std::size_t>(d.segments()) + 1;
}

/// An edge of a curve by its vertices in space, ascending.
struct Segment {
  std::array<std::int32_t, 2> key;
  std::int32_t curve, segment;
  friend auto operator<=>(const Segment&, const Segment&) = default;
};

std::array<std::int32_t, 2> ordered(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

std::vector<Segment> segments_of(const ElementWork& work, std::size_t face) {
  std::vector<Segment> all;
  const SurfaceMesh& mesh = work.result.mesh;
  for (std::size_t c = 0; c < mesh.curves.size(); ++c) {
    const CurveMesh& curve = mesh.curves[c];
    if (std::none_of(curve.uses.begin(), curve.uses.end(),
                     [&](const CurveMeshUse& use) { return static_cast<std::size_t>(use.face) == face; }))
      continue;
    for (std::size_t k = 1; k < curve.vertices.size(); ++k)
      all.push_back({ordered(curve.vertices[k - 1], curve.vertices[k]), static_cast<std::int32_t>(c),
                     static_cast<std::int32_t>(k) - 1});
  }
  std::sort(all.begin(), all.end());
  return all;
}

// Marks, for each local vertex, whether a segment ends there.
std::vector<char> on_segments(const std::vector<Segment>& segments, const std::vector<std::int32_t>& vertices) {
  std::vector<std::int32_t> ends;
  for (const Segment& s : segments) ends.insert(ends.end(), s.key.begin(), s.key.end());
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::vector<char> found(vertices.size());
  std::transform(vertices.begin(), vertices.end(), found.begin(), [&](std::int32_t v) {
    return static_cast<char>(!ends.empty() && v <= ends.back() && std::binary_search(ends.begin(), ends.end(), v));
  });
  return found;
}

// The use of a curve in the face whose image of the segment is the side from p to q of (u, v). The point p lies over
// the segment's first vertex.
std::int32_t nearest_use(const ElementWork& work, std::size_t face, const Segment& s, const Vec2& p, const Vec2& q) {
  if (static_cast<std::size_t>(s.curve) >= work.model.topology.curves.size()) return -1;
  const std::vector<CurveUse>& uses = work.model.topology.curves[s.curve].uses;
  const bool known = is_known(work, static_cast<std::size_t>(s.curve));
  const auto k = static_cast<std::size_t>(s.segment);
  std::int32_t best = -1;
  double least = 0;
  for (std::size_t u = 0; u < uses.size(); ++u) {
    if (static_cast<std::size_t>(uses[u].face) != face) continue;
    double apart = 0;
    if (known) {
      const std::vector<Vec2>& uv = work.curves[s.curve].uv_of_use[u];
      const Vec2 at_p = uv[k] - p, at_q = uv[k + 1] - q;
      apart = dot(at_p, at_p) + dot(at_q, at_q);
    }
    if (best < 0 || apart < least) best = static_cast<std::int32_t>(u), least = apart;
  }
  return best;
}

}  // namespace

// The integral of the line f + g s over [-1, 1] reaches its half where k s^2 + s = k, k = g / (2 f).
double metric_middle(double left, double middle, double right) noexcept {
  const double f = (left + 4 * middle + right) / 6, g = (right - left) / 2;
  if (!(f > 0) || !std::isfinite(f)) return 0.5;
  const double k = std::clamp(g / (2 * f), -0.5, 0.5);
  return 0.5 + k / (1 + std::sqrt(1 + 4 * k * k));
}

double middle_share(const DiscreteCurve& curve, std::size_t k) {
  const double left = curve.r[k], right = curve.r[k + 1];
  const auto density = [&](double r) { return 1 / curve.sizes.size_at(r); };
  return metric_middle(density(left), density((left + right) / 2), density(right));
}

std::optional<CurveMiddle> EdgeMiddles::at(std::size_t curve, std::size_t k, double shift) {
  if (!is_known(work_, curve)) return std::nullopt;
  const PeriodicModel* periodic = work_.periodic;
  if (periodic != nullptr && periodic->has_class[curve] != 0 && periodic->place[curve][1] > 0) return image(curve, k, shift);
  if (periodic != nullptr && periodic->has_class[curve] != 0)
    if (std::optional<CurveMiddle> repeated = repeated_middle(curve, k, shift)) return repeated;
  std::optional<CurveMiddle> middle = at_share(curve, k, middle_share(work_.curves[curve], k) + shift);
  if (middle && periodic != nullptr && periodic->has_class[curve] != 0)
    middle->xyz = on_planes(middle->xyz, periodic->curves[periodic->place[curve][0]].mirrors, periodic->gap);
  return middle;
}

// If maps carry the root onto itself: the image of the middle of the first edge among the images of edge k.
std::optional<CurveMiddle> EdgeMiddles::repeated_middle(std::size_t curve, std::size_t k, double shift) {
  const CurveClass& all = work_.periodic->curves[work_.periodic->place[curve][0]];
  const DiscreteCurve& d = work_.curves[curve];
  const Curve& shape = work_.model.curve(static_cast<int>(curve));
  const bool closed = shape.end1 == shape.end2;
  const int n = d.segments();
  int first = static_cast<int>(k);
  const CurveMember* found = nullptr;  // carries edge k to the first one
  const CurveMember* itself = nullptr;
  const std::vector<CurveMember> maps = maps_of_root(all);
  for (const CurveMember& each : maps) {
    const int i = vertex_image(d, d, each.image, closed, static_cast<int>(k));
    if (i < 0) continue;
    const int edge = each.image.reversed ? (i + n - 1) % n : i % n;
    if (edge == static_cast<int>(k)) itself = &each;
    if (edge < first) first = edge, found = &each;
  }
  if (found == nullptr && itself == nullptr) return {};
  const bool reversed = found != nullptr && found->image.reversed;
  std::optional<CurveMiddle> middle;
  Vec3 target;
  if (found != nullptr) {
    const std::optional<CurveMiddle> known = at(curve, static_cast<std::size_t>(first), reversed ? -shift : shift);
    if (!known) return {};
    target = found->map.inverse()(known->xyz);
    const double share = middle_share(d, static_cast<std::size_t>(first)) + (reversed ? -shift : shift);
    middle = at_share(curve, k, reversed ? 1 - share : share);
  } else {
    middle = at_share(curve, k, 0.5);
    if (middle) target = 0.5 * (middle->xyz + itself->map(middle->xyz));
  }
  if (middle) move_to(curve, k, target, *middle);
  return middle;
}

// Moves the middle of an edge to the points of its uses closest to a place, which it takes if it lies on the curve.
void EdgeMiddles::move_to(std::size_t curve, std::size_t k, const Vec3& target, CurveMiddle& middle) {
  const DiscreteCurve& to = work_.curves[curve];
  const std::vector<CurveUse>& uses = work_.model.curve(static_cast<int>(curve)).uses;
  for (std::size_t u = 0; u < uses.size(); ++u) {
    const auto [low, high] = std::minmax(to.t_of_use[u][k], to.t_of_use[u][k + 1]);
    const CurvePoint point = find_closest(work_.model, uses[u], (low + high) / 2, low, high, target);
    middle.uv_of_use[u] = point.uv;
    if (static_cast<int>(u) == to.owner)
      middle.xyz = point.distance <= rounding_of::places * work_.periodic->gap ? target : point.xyz;
  }
}

// The point of the root's edge, carried; on the other uses its closest points.
std::optional<CurveMiddle> EdgeMiddles::image(std::size_t curve, std::size_t k, double shift) {
  const auto [number, rank] = work_.periodic->place[curve];
  const CurveClass& all = work_.periodic->curves[number];
  const CurveMember& member = all.members[rank];
  const int root = all.members.front().image.curve;
  const DiscreteCurve &from = work_.curves[root], &to = work_.curves[curve];
  const Curve& shape = work_.model.curve(root);
  const bool closed = shape.end1 == shape.end2;
  const int n = from.segments();
  const int i = vertex_image(to, from, inverse(root, member.image), closed, static_cast<int>(k));
  if (i < 0 || n != to.segments()) return std::nullopt;
  const int segment = member.image.reversed ? (i + n - 1) % n : i % n;
  const bool reversed = member.image.reversed;
  const double share = middle_share(from, static_cast<std::size_t>(segment)) + (reversed ? -shift : shift);
  std::optional<CurveMiddle> known = at(static_cast<std::size_t>(root), static_cast<std::size_t>(segment), reversed ? -shift : shift);
  std::optional<CurveMiddle> middle = at_share(curve, k, reversed ? 1 - share : share);
  if (!known || !middle) return middle;
  move_to(curve, k, member.map(known->xyz), *middle);
  return middle;
}

std::optional<CurveMiddle> EdgeMiddles::at_share(std::size_t curve, std::size_t k, double share) {
  const DiscreteCurve& d = work_.curves[curve];
  piece_.curve = d.curve;
  piece_.owner = d.owner;  // a node between prescribed vertices is not prescribed itself
  piece_.refined = d.refined;
  piece_.r.assign({d.r[k], d.r[k + 1]});
  piece_.xyz.assign({d.xyz[k], d.xyz[k + 1]});
  const std::size_t uses = d.t_of_use.size();
  piece_.t_of_use.resize(uses), piece_.uv_of_use.resize(uses);
  for (std::size_t u = 0; u < uses; ++u) {
    piece_.t_of_use[u].assign({d.t_of_use[u][k], d.t_of_use[u][k + 1]});
    piece_.uv_of_use[u].assign({d.uv_of_use[u][k], d.uv_of_use[u][k + 1]});
  }
  piece_.size.assign({1, 1}), piece_.physical.assign({1, 1});
  if (!split_segment(piece_, 0, work_.model, share)) return std::nullopt;
  CurveMiddle middle{piece_.xyz[1], {}};
  middle.uv_of_use.reserve(uses);
  for (const std::vector<Vec2>& uv : piece_.uv_of_use) middle.uv_of_use.push_back(uv[1]);
  return middle;
}

std::vector<CurveSide> curve_sides(const ElementWork& work, std::size_t face) {
  const std::vector<Segment> segments = segments_of(work, face);
  const FaceMesh& mesh = work.result.mesh.faces[face];
  const std::vector<char> on_curve = on_segments(segments, mesh.vertex);
  std::vector<CurveSide> sides;
  for (const std::array<std::int32_t, 3>& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t a = t[i], b = t[(i + 1) % 3];
      if (on_curve[a] == 0 || on_curve[b] == 0) continue;
      const std::int32_t va = mesh.vertex[a], vb = mesh.vertex[b];
      const auto found = std::lower_bound(segments.begin(), segments.end(), Segment{ordered(va, vb), 0, 0});
      if (found == segments.end() || found->key != ordered(va, vb)) continue;
      const bool forward = work.result.mesh.curves[found->curve].vertices[found->segment] == va;
      const std::int32_t p = forward ? a : b, q = forward ? b : a;
      sides.push_back({std::min(a, b), std::max(a, b), found->curve, found->segment,
                       nearest_use(work, face, *found, mesh.uv[p], mesh.uv[q])});
    }
  std::sort(sides.begin(), sides.end());
  sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
  return sides;
}

}  // namespace carreau
