// SPDX-License-Identifier: BSD-3-Clause
#include "surface/improve/refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "cad/fundamental_forms.h"
#include "mesh/distance/triangle_distance.h"
#include "mesh/editable_mesh.h"
#include "mesh/local_search.h"
#include "mesh/quality.h"
#include "support/angles.h"
#include "support/ranks/all_that_hold.h"
#include "surface/improve/corner_agreement.h"
#include "surface/improve/thresholds.h"
#include "surface/lift/thresholds.h"

namespace carreau {

namespace {

using namespace thresholds::refinement;

class Refinement {
 public:
  Refinement(const PatchInput& input, Cad& cad, const SizeRules& rules, const GeometricLimits& kept, PatchMesh& mesh,
             Monitor& monitor)
      : input_(input), cad_(cad), rules_(rules), mesh_(mesh), monitor_(monitor), kept_(kept), agreement_(kept) {}

  std::vector<int> run() {
    std::vector<int> wrong = find_wrong();
    if (wrong.empty()) return {};
    editable_.emplace(input_.domain->plane, mesh_.plane, mesh_.xyz);
    std::erase_if(wrong, [this](int t) { return is_sound(t); });
    if (wrong.empty()) return {};
    const std::size_t vertices = mesh_.xyz.size();
    depth_.assign(mesh_.plane.triangles.size(), 0);
    // A bend needs two or three halvings. More divisions show a surface that is rough at every scale.
    constexpr std::size_t max_divisions = 32;
    // A division adds two triangles: guaranteed planes at most treble the mesh.
    const std::size_t most = std::isfinite(kept_.triangle_angle_deg) ? mesh_.plane.triangles.size() : max_divisions * wrong.size();
    left_ = Budget(static_cast<std::int64_t>(std::min(most, max_divisions * wrong.size())));
    std::vector<int> still = improve_ring_by_ring(
        wrong, {}, left_, monitor_, [this](int t) { return !is_sound(t); }, [this](int t) { return mend(t); },
        [this](int t) {
          changed_.push_back(t);
          return std::exchange(changed_, {});
        });
    if (still.size() >= wrong.size()) {
      editable_->undo(0);
      if (with_normals_) mesh_.normal.resize(vertices);
      return wrong;
    }
    ask_sizes(vertices);
    return still;
  }

 private:
  using Triangle = EditableMesh::Triangle;
  using Quad = EditableMesh::Quad;

  [[nodiscard]] Triangle& triangle(int t) { return mesh_.plane.triangles[t]; }
  [[nodiscard]] Vec3 position(std::int32_t v) const { return mesh_.xyz[v]; }
  [[nodiscard]] Vec3 normal_of(const Triangle& t) const {
    return cross(position(t[1]) - position(t[0]), position(t[2]) - position(t[0]));
  }
  // Two corners of one apex of space make a flat triangle that will be removed.
  [[nodiscard]] static bool collapsed(const Vec3& a, const Vec3& b, const Vec3& c) {
    return a == b || b == c || c == a;
  }
  [[nodiscard]] bool collapsed(const Triangle& t) const {
    return collapsed(position(t[0]), position(t[1]), position(t[2]));
  }

  // Both ends of a seam and a vertex between them on a straight line of the surface have an area in (u, v) only.
  [[nodiscard]] static bool is_flat(const Vec3& a, const Vec3& b, const Vec3& c) {
    return !collapsed(a, b, c) && !(quality_q2(a, b, c) > flat_quality);
  }
  [[nodiscard]] bool is_flat(const Triangle& t) const {
    return is_flat(position(t[0]), position(t[1]), position(t[2]));
  }

  // Finds triangles that look wrong from the data at their corners, or against the mean of the triangles around.
  std::vector<int> find_wrong() {
    const std::vector<Triangle>& triangles = mesh_.plane.triangles;
    // Passes before may have moved vertices.
    if (std::isfinite(kept_.triangle_angle_deg)) mesh_.normal.resize(mesh_.xyz.size()), ask_normals(mesh_.xyz.size());
    with_normals_ = mesh_.normal.size() == mesh_.xyz.size();
    // Beside coarse edges that bend by more than a right angle divisions of shapely triangles end in slivers.
    known_ = with_normals_ && (kept_.any() || rules_.uses_curvature() || !input_.one_size);
    std::vector<Vec3> around;
    if (!known_ && !input_.is_plane) {
      around.resize(mesh_.xyz.size());
      for (const Triangle& t : triangles) {
        const Vec3 n = normal_of(t);
        for (const std::int32_t v : t) around[v] = around[v] + n;
      }
    }
    if (known_) ask_normals(input_.domain->plane.vertices.size());  // at imposed vertices
    const std::vector<Vec3>& normal = known_ ? mesh_.normal : around;
    return all_that_hold(triangles.size(), input_.executor, "doubtful triangles", monitor_, [&](std::size_t t) {
      return is_doubtful(triangles[t], normal) && !collapsed(triangles[t]);
    });
  }

  // At the first n vertices.
  void ask_normals(std::size_t n) {
    std::vector<SurfaceJet> jets(n);
    cad_.surface(input_.ref, want_first, std::span(mesh_.plane.vertices).first(n), jets);
    for (std::size_t v = 0; v < n; ++v) mesh_.normal[v] = unit_normal(jets[v]).value_or(Vec3{});
  }

  [[nodiscard]] bool is_doubtful(const Triangle& t, const std::vector<Vec3>& normal) const {
    const Vec3 n = normal_of(t);
    if (!known_ && input_.is_plane) return n.z() < 0;  // the sums at its corners are positive
    if (!known_) {
      // It is on the side of the minority at two corners or more.
      const auto against = [&](std::int32_t v) { return dot(n, normal[v]) < 0; };
      const bool first = against(t[0]), second = against(t[1]);
      return first != second ? against(t[2]) : first;
    }
    const double least = angles::cosine_of_60 * angles::cosine_of_60 * dot(n, n);
    for (const std::int32_t v : t) {
      const double along = dot(n, normal[v]), whole = dot(normal[v], normal[v]);
      if (whole > 0 && (!(along > 0) || along * along < least * whole)) return true;  // zero at singular vertices
    }
    return looks_far(t);
  }

  [[nodiscard]] bool looks_far(const Triangle& t) const {
    if (!kept_.any()) return false;
    return agreement_.share({position(t[0]), position(t[1]), position(t[2])},
                            {mesh_.normal[t[0]], mesh_.normal[t[1]], mesh_.normal[t[2]]}) > 1 ||
           leans(t);
  }
  [[nodiscard]] bool leans(const Triangle& t) const {
    return agreement_.leans({position(t[0]), position(t[1]), position(t[2])},
                            {mesh_.normal[t[0]], mesh_.normal[t[1]], mesh_.normal[t[2]]});
  }

  /// Beyond a side; none where that is imposed.
  [[nodiscard]] std::optional<Quad> quad(int t, int side) const { return editable_->quad({0, t}, side); }

  [[nodiscard]] SurfaceJet jet_at(const Vec2& uv) { return surface_at(cad_, input_.ref, want_position | want_first, uv); }
  [[nodiscard]] bool is_sound(int t) {
    const Triangle c = triangle(t);
    if (collapsed(c)) return true;
    if (!agrees(c)) return false;
    if (!known_ || !looks_far(c)) return true;
    bool as_short_as_allowed = false;
    for (int i = 0; i < 3; ++i) {
      const std::int32_t a = c[i], b = c[(i + 1) % 3];
      if (norm(position(b) - position(a)) < kept_.shortest_divided)
        as_short_as_allowed = true;
      else if (quad(t, i) && excess(t, a, b) > 1)
        return false;
    }
    if (as_short_as_allowed) return true;
    if (leans(c)) return false;
    if (!std::isfinite(kept_.deviation)) return true;
    const auto& uv = mesh_.plane.vertices;
    return deviation(t, jet_at((1. / 3) * (uv[c[0]] + uv[c[1]] + uv[c[2]])).s) <= kept_.deviation;
  }

  // The larger of an edge's angle and deviation, as shares of their limits.
  [[nodiscard]] double excess(int t, std::int32_t a, std::int32_t b) {
    const Vec3 e = position(b) - position(a);
    double share = 0;
    for (const std::int32_t v : {a, b})
      share = std::max(share, std::abs(dot(e, mesh_.normal[v])) / (agreement_.sine() * norm(e)));
    if (!std::isfinite(kept_.deviation)) return share;
    for (const double s : along_edge) {
      const Vec2 uv = lerp(mesh_.plane.vertices[a], mesh_.plane.vertices[b], s);
      share = std::max(share, deviation(t, jet_at(uv).s) / kept_.deviation);
    }
    return share;
  }

  // Measures the distance from the triangle and its neighbours, since the image of a triangle of (u, v) may reach
  // beyond it.
  [[nodiscard]] double deviation(int t, const Vec3& s) {
    const auto from = [&](int k) {
      const Triangle& c = triangle(k);
      return distance_to_triangle(s, position(c[0]), position(c[1]), position(c[2]));
    };
    double d = from(t);
    for (int i = 0; i < 3; ++i)
      if (const auto q = quad(t, i)) d = std::min(d, from(q->u));
    return d;
  }

  // The least cosine of the normals of a triangle and of the surface; if normals at the corners are unknown, at its
  // centre alone.
  [[nodiscard]] double agreement(const Triangle& c) {
    const Vec3 n = normal_of(c);
    const double size = norm(n);
    if (!(size > 0)) return -1;
    double least = 1;
    const auto compare = [&](const Vec3& m) {
      if (dot(m, m) > 0) least = std::min(least, dot(n, m) / size);
    };
    if (known_)
      for (const std::int32_t v : c) compare(mesh_.normal[v]);
    if (least < angles::cosine_of_85) return least;
    const auto& uv = mesh_.plane.vertices;
    compare(unit_normal(jet_at((1. / 3) * (uv[c[0]] + uv[c[1]] + uv[c[2]]))).value_or(Vec3{}));
    return least;
  }
  [[nodiscard]] bool agrees(const Triangle& c) { return agreement(c) >= (known_ ? angles::cosine_of_85 : 0); }

  // A division, or a swap, that completes the work on the triangle.
  bool mend(int t) {
    if (swap_one(t) || depth_[t] >= deepest || !divide(t)) return false;
    left_.spend();
    return true;
  }

  // The other diagonal of a quadrilateral, when both triangles agree with the surface and seem near then. The best of
  // three.
  bool swap_one(int t) {
    double best = angles::cosine_of_85;
    std::optional<Quad> found;
    for (int i = 0; i < 3; ++i) {
      const auto q = quad(t, i);
      if (!q || !editable_->can_swap(*q)) continue;
      const auto [first, second] = EditableMesh::swapped(*q);
      if (collapsed(first) || collapsed(second) || is_flat(first) || is_flat(second)) continue;
      const double least = std::min(agreement(first), agreement(second));
      if (least > best && !(known_ && (looks_far(first) || looks_far(second)))) best = least, found = q;
    }
    return found && editable_->swap(*found);
  }

  [[nodiscard]] double length(const Quad& q) const { return norm(position(q.b) - position(q.a)); }
  // None: it is imposed. Dividing other sides would make the triangle narrower beside the bend.
  [[nodiscard]] std::optional<Quad> longest_side(int t) const {
    const Triangle& c = mesh_.plane.triangles[t];
    std::array<double, 3> lengths{};
    for (int k = 0; k < 3; ++k) lengths[k] = norm(position(c[k]) - position(c[(k + 1) % 3]));
    return quad(t, static_cast<int>(std::max_element(lengths.begin(), lengths.end()) - lengths.begin()));
  }

  // Across a longest side there may be a longer one, and so on. The last one is divided, so that the new triangles are
  // not thinner than the old ones (Rivara's path of longest edges).
  bool divide(int t) {
    // Medians of triangles that are narrow already may be much shorter than halves. Share of the shortest edge that is divided.
    constexpr double shortest_median = 0.3;
    const double least = agrees(triangle(t)) ? shortest_median * kept_.shortest_divided : 0;
    std::optional<Quad> side = longest_side(t);
    while (side) {
      const auto next = longest_side(side->u);
      // If lengths are equal the first one counts; otherwise the path would not end.
      if (!next || next->u == side->t || !(length(*next) > length(*side))) break;
      side = next;
    }
    return side && divide_side(*side, least);
  }

  bool divide_side(const Quad& q, double least) {
    const Vec3 a = position(q.a), b = position(q.b), c = position(q.c), d = position(q.d);
    const Vec2 uv = lerp(mesh_.plane.vertices[q.a], mesh_.plane.vertices[q.b], 0.5);
    if (!editable_->can_split(q, uv)) return false;
    const SurfaceJet jet = jet_at(uv);
    const Vec3 m = jet.s;
    // The surface jumps where it is farther from the middle of an edge than the edge is long.
    if (!(norm(m - lerp(a, b, 0.5)) < norm(b - a)) || norm(m - c) < least || norm(m - d) < least)
      return false;
    if (is_flat(a, m, c) || is_flat(m, b, c) || is_flat(b, m, d) || is_flat(m, a, d)) return false;
    // Angles of triangles that follow the surface are not worth slivers, unless planes are guaranteed.
    const double poor = std::isfinite(kept_.triangle_angle_deg) ? min_guaranteed_shape : min_divided_shape;
    const auto is_poor = [&](const Vec3& u, const Vec3& v, const Vec3& w) { return quality_q2(u, v, w) < poor; };
    if (least > 0 && input_.isotropic && (is_poor(a, m, c) || is_poor(m, b, c) || is_poor(b, m, d) || is_poor(m, a, d))) return false;
    editable_->split(q, uv, m);
    if (with_normals_) mesh_.normal.push_back(unit_normal(jet).value_or(Vec3{0, 0, 0}));
    ++depth_[q.t], ++depth_[q.u];
    depth_.push_back(depth_[q.t]);
    depth_.push_back(depth_[q.u]);
    const int n = static_cast<int>(mesh_.plane.triangles.size());
    changed_ = {q.t, q.u, n - 2, n - 1};
    return true;
  }

  void ask_sizes(std::size_t before) {
    const std::span<const Vec2> uv = std::span(mesh_.plane.vertices).subspan(before);
    const std::vector<double> sizes = prescribed_sizes(input_, cad_, rules_, uv, monitor_);
    mesh_.size.insert(mesh_.size.end(), sizes.begin(), sizes.end());
  }

  const PatchInput& input_;
  Cad& cad_;
  const SizeRules& rules_;
  PatchMesh& mesh_;
  Monitor& monitor_;
  GeometricLimits kept_;
  KeptAgreement agreement_;
  bool with_normals_ = false;  // the mesh has them at all vertices
  bool known_ = false;         // they are compared with the normals of triangles
  std::optional<EditableMesh> editable_;
  std::vector<std::uint8_t> depth_;  // by triangle
  Budget left_;                      // divisions
  std::vector<int> changed_;         // by the last division
};

}  // namespace

std::vector<int> refine_in_space(const PatchInput& input, Cad& cad, const SizeRules& rules, const GeometricLimits& kept,
                                 PatchMesh& mesh, Monitor& monitor) {
  const bool had_normals = !mesh.normal.empty();
  std::vector<int> wrong = Refinement(input, cad, rules, kept, mesh, monitor).run();
  if (!had_normals) mesh.normal.clear();
  return wrong;
}

}  // namespace carreau
