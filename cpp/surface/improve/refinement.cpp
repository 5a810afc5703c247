#include "surface/improve/refinement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "cad/fundamental_forms.h"
#include "mesh/quality.h"
#include "mesh/triangle_distance.h"
#include "predicates/predicates.h"
#include "surface/improve/cubic_offset.h"

namespace carreau {

namespace {

// Least cosine of a triangle's normal and the surface's: a little less than upright.
constexpr double upright = 0.08;
// Triangles are looked at more closely below this cosine: at a corner the surface may be turned by 60 degrees on the
// way to the middle of a coarse one.
constexpr double suspicious = 0.5;
// Edges divided for each triangle that was wrong to begin with; a bend needs two or three halvings. More are
// a host whose surface is rough at every scale.
constexpr std::size_t most_divisions = 32;
// Times that a triangle was divided to make another: beside a chord so coarse that each triangle on it is turned over
// divisions would go on until vertices coincide.
constexpr std::uint8_t deepest = 12;
// What exceeds an angle or a distance is not divided where a median would be shorter than this share of the shortest
// edge that is divided.
constexpr double shortest_median = 0.3;
// The surface is not divided where it is farther from the middle of an edge than this many lengths: it jumps there.
constexpr double farthest = 1;

class SpaceRefinement {
 public:
  SpaceRefinement(const PatchInput& input, Cad& cad, const SizeRules& rules, const GeometricLimits& kept,
                  PatchMesh& mesh, Monitor& monitor)
      : input_(input),
        cad_(cad),
        rules_(rules),
        mesh_(mesh),
        monitor_(monitor),
        kept_(kept),
        sine_(std::isfinite(kept.edge_angle_deg) ? std::sin(kept.edge_angle_deg * std::numbers::pi / 180) : infinity) {}

  std::vector<int> run() {
    std::vector<int> wrong = find_wrong();
    if (wrong.empty()) return {};
    connect();
    std::erase_if(wrong, [this](int t) { return is_sound(t); });
    if (wrong.empty()) return {};
    const PatchMesh untouched = mesh_;
    depth_.assign(mesh_.plane.triangles.size(), 0);
    std::size_t left = most_divisions * wrong.size();
    queue_ = wrong;
    for (std::size_t k = 0; k < queue_.size() && left > 0; ++k) {
      if (k % 256 == 0) monitor_.checkpoint();
      const int t = queue_[k];
      if (is_sound(t) || swap_one(t) || depth_[t] >= deepest || !divide(t)) continue;
      --left;
      queue_.push_back(t);
    }
    std::sort(queue_.begin(), queue_.end());
    queue_.erase(std::unique(queue_.begin(), queue_.end()), queue_.end());
    std::erase_if(queue_, [this](int t) { return is_sound(t); });
    if (queue_.size() >= wrong.size()) {
      mesh_ = untouched;
      return wrong;
    }
    ask_sizes(untouched.xyz.size());
    return queue_;
  }

 private:
  using Triangle = std::array<std::int32_t, 3>;
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  [[nodiscard]] Triangle& triangle(int t) { return mesh_.plane.triangles[t]; }
  [[nodiscard]] Vec3 position(std::int32_t v) const { return mesh_.xyz[v]; }
  [[nodiscard]] Vec3 normal_of(const Triangle& t) const {
    return cross(position(t[1]) - position(t[0]), position(t[2]) - position(t[0]));
  }
  // Two corners of one apex of space make a flat triangle that will be removed.
  [[nodiscard]] bool collapsed(const Triangle& t) const {
    return position(t[0]) == position(t[1]) || position(t[1]) == position(t[2]) || position(t[2]) == position(t[0]);
  }

  // Both ends of a seam and a vertex between them on a straight line of the surface have an area in (u, v) only.
  [[nodiscard]] bool is_flat(const Triangle& t) const {
    return !collapsed(t) && !(quality_q2(position(t[0]), position(t[1]), position(t[2])) > flat_quality);
  }

  // Those that look wrong from what is known at their corners, or against the mean of the triangles around.
  std::vector<int> find_wrong() {
    const std::vector<Triangle>& triangles = mesh_.plane.triangles;
    with_normals_ = mesh_.normal.size() == mesh_.xyz.size();
    // Beside coarse edges that bend by more than a right angle divisions of shapely triangles end in slivers.
    known_ = with_normals_ && (kept_.any() || rules_.uses_curvature() || !input_.one_size);
    std::vector<Vec3> around;
    if (!known_) {
      around.resize(mesh_.xyz.size());
      for (const Triangle& t : triangles) {
        const Vec3 n = normal_of(t);
        for (const std::int32_t v : t) around[v] = around[v] + n;
      }
    }
    if (known_) ask_curves();
    const std::vector<Vec3>& normal = known_ ? mesh_.normal : around;
    std::vector<int> wrong;
    for (std::size_t t = 0; t < triangles.size(); ++t)
      if (suspect(triangles[t], normal) && !collapsed(triangles[t])) wrong.push_back(static_cast<int>(t));
    return wrong;
  }

  // At imposed vertices.
  void ask_curves() {
    const std::size_t n = input_.domain->plane.vertices.size();
    std::vector<SurfaceJet> jets(n);
    cad_.surface(input_.ref, want_first, std::span(mesh_.plane.vertices).first(n), jets);
    for (std::size_t v = 0; v < n; ++v) mesh_.normal[v] = unit_normal(jets[v]).value_or(Vec3{});
  }

  [[nodiscard]] bool suspect(const Triangle& t, const std::vector<Vec3>& normal) const {
    const Vec3 n = normal_of(t);
    if (!known_) {
      // It is on the side of the minority at two corners or more.
      const auto against = [&](std::int32_t v) { return dot(n, normal[v]) < 0; };
      const bool first = against(t[0]), second = against(t[1]);
      return first != second ? against(t[2]) : first;
    }
    const double least = suspicious * suspicious * dot(n, n);
    for (const std::int32_t v : t) {
      const double along = dot(n, normal[v]), whole = dot(normal[v], normal[v]);
      if (whole > 0 && (!(along > 0) || along * along < least * whole)) return true;  // zero at singular vertices
    }
    return looks_far(t);
  }

  // By the cubics that leave the ends of edges as the surface does, and by the middle of the patch that they bound:
  // the mean of the six offsets of their control points.
  [[nodiscard]] bool looks_far(const Triangle& t) const {
    if (!kept_.any()) return false;
    double middle = 0;
    for (int i = 0; i < 3; ++i) {
      const std::int32_t a = t[i], b = t[(i + 1) % 3];
      const Vec3 e = position(b) - position(a);
      const double p = dot(e, mesh_.normal[a]), q = -dot(e, mesh_.normal[b]), l = norm(e);
      if (std::max(std::abs(p), std::abs(q)) > sine_ * l) return true;
      for (const double s : along_edge)
        if (std::abs(cubic_offset(s, p, q)) > kept_.deviation) return true;
      middle += p + q;
    }
    return std::abs(middle) / 18 > kept_.deviation;
  }

  // Neighbours across sides; -1: a border, or an imposed edge inside.
  void connect() {
    struct Side {
      std::array<std::int32_t, 2> key;
      int triangle, side;
    };
    std::vector<Side> sides;
    const auto key = [](std::int32_t a, std::int32_t b) { return std::array{std::min(a, b), std::max(a, b)}; };
    for (std::size_t t = 0; t < mesh_.plane.triangles.size(); ++t)
      for (int i = 0; i < 3; ++i) {
        const Triangle& c = mesh_.plane.triangles[t];
        sides.push_back({key(c[i], c[(i + 1) % 3]), static_cast<int>(t), i});
      }
    std::sort(sides.begin(), sides.end(),
              [](const Side& p, const Side& q) { return p.key != q.key ? p.key < q.key : p.triangle < q.triangle; });
    std::vector<std::array<std::int32_t, 2>> imposed;
    for (const PlaneEdge& e : input_.domain->plane.edges) imposed.push_back(key(e.a, e.b));
    std::sort(imposed.begin(), imposed.end());
    across_.assign(mesh_.plane.triangles.size(), {-1, -1, -1});
    for (std::size_t k = 0; k + 1 < sides.size(); ++k) {
      const Side &p = sides[k], &q = sides[k + 1];
      if (p.key != q.key || std::binary_search(imposed.begin(), imposed.end(), p.key)) continue;
      across_[p.triangle][p.side] = q.triangle;
      across_[q.triangle][q.side] = p.triangle;
    }
  }

  [[nodiscard]] SurfaceJet jet_at(Vec2 uv) {
    SurfaceJet jet;
    cad_.surface(input_.ref, want_position | want_first, {&uv, 1}, {&jet, 1});
    return jet;
  }
  [[nodiscard]] bool is_sound(int t) {
    const Triangle c = triangle(t);
    if (collapsed(c)) return true;
    if (!is_upright(c)) return false;
    if (!known_ || !looks_far(c)) return true;
    bool as_short_as_allowed = false;
    for (int i = 0; i < 3; ++i) {
      const std::int32_t a = c[i], b = c[(i + 1) % 3];
      if (norm(position(b) - position(a)) < kept_.shortest_divided)
        as_short_as_allowed = true;
      else if (across_[t][i] >= 0 && excess(t, a, b) > 1)
        return false;
    }
    if (as_short_as_allowed || !std::isfinite(kept_.deviation)) return true;
    const auto& uv = mesh_.plane.vertices;
    return deviation(t, jet_at((1. / 3) * (uv[c[0]] + uv[c[1]] + uv[c[2]])).s) <= kept_.deviation;
  }

  // The largest of an edge's angle and deviation, in shares of what is allowed.
  [[nodiscard]] double excess(int t, std::int32_t a, std::int32_t b) {
    const Vec3 e = position(b) - position(a);
    double share = 0;
    for (const std::int32_t v : {a, b}) share = std::max(share, std::abs(dot(e, mesh_.normal[v])) / (sine_ * norm(e)));
    if (!std::isfinite(kept_.deviation)) return share;
    for (const double s : along_edge) {
      const Vec2 uv = lerp(mesh_.plane.vertices[a], mesh_.plane.vertices[b], s);
      share = std::max(share, deviation(t, jet_at(uv).s) / kept_.deviation);
    }
    return share;
  }

  // From a triangle or those around it: the image of a triangle of (u, v) may reach beyond it.
  [[nodiscard]] double deviation(int t, Vec3 s) {
    const auto from = [&](int k) {
      const Triangle& c = triangle(k);
      return distance_to_triangle(s, position(c[0]), position(c[1]), position(c[2]));
    };
    double d = from(t);
    for (const int u : across_[t])
      if (u >= 0) d = std::min(d, from(u));
    return d;
  }

  // The least cosine of the normals of a triangle and of the surface; without those at the corners in its centre alone.
  [[nodiscard]] double uprightness(const Triangle& c) {
    const Vec3 n = normal_of(c);
    const double size = norm(n);
    if (!(size > 0)) return -1;
    double least = 1;
    const auto compare = [&](Vec3 m) {
      if (dot(m, m) > 0) least = std::min(least, dot(n, m) / size);
    };
    if (known_)
      for (const std::int32_t v : c) compare(mesh_.normal[v]);
    if (least < upright) return least;
    const auto& uv = mesh_.plane.vertices;
    compare(unit_normal(jet_at((1. / 3) * (uv[c[0]] + uv[c[1]] + uv[c[2]]))).value_or(Vec3{}));
    return least;
  }
  [[nodiscard]] bool is_upright(const Triangle& c) { return uprightness(c) >= (known_ ? upright : 0); }

  [[nodiscard]] int side_towards(int t, int neighbour) const {
    const auto& a = across_[t];
    return static_cast<int>(std::find(a.begin(), a.end(), neighbour) - a.begin());
  }
  void reconnect(int t, int from, int to) {
    if (t >= 0) across_[t][side_towards(t, from)] = to;
  }
  [[nodiscard]] bool positive(const Triangle& c) const {
    const auto& uv = mesh_.plane.vertices;
    return orientation(uv[c[0]], uv[c[1]], uv[c[2]]) > 0;
  }

  // The other diagonal of a quadrilateral, when both triangles are upright and seem near then. The best of three.
  bool swap_one(int t) {
    const Triangle c = triangle(t);
    double best = upright;
    int best_side = -1;
    for (int i = 0; i < 3; ++i) {
      const int u = across_[t][i];
      if (u < 0) continue;
      const std::int32_t d = triangle(u)[(side_towards(u, t) + 2) % 3];
      const Triangle first{c[i], d, c[(i + 2) % 3]}, second{d, c[(i + 1) % 3], c[(i + 2) % 3]};
      if (collapsed(first) || collapsed(second) || !positive(first) || !positive(second)) continue;
      if (is_flat(first) || is_flat(second)) continue;
      const double least = std::min(uprightness(first), uprightness(second));
      if (least > best && !(known_ && (looks_far(first) || looks_far(second)))) best = least, best_side = i;
    }
    if (best_side >= 0) swap(t, best_side);
    return best_side >= 0;
  }

  void swap(int t, int i) {
    const int u = across_[t][i], j = side_towards(u, t);
    const std::int32_t a = triangle(t)[i], b = triangle(t)[(i + 1) % 3], c = triangle(t)[(i + 2) % 3],
                       d = triangle(u)[(j + 2) % 3];
    const int bc = across_[t][(i + 1) % 3], ca = across_[t][(i + 2) % 3], ad = across_[u][(j + 1) % 3],
              db = across_[u][(j + 2) % 3];
    triangle(t) = {a, d, c};
    across_[t] = {ad, u, ca};
    triangle(u) = {d, b, c};
    across_[u] = {db, bc, t};
    reconnect(ad, u, t);
    reconnect(bc, t, u);
  }

  // -1: it is imposed. Other sides of such a triangle are of no use: it would become narrower beside the bend.
  [[nodiscard]] int longest_side(int t) const {
    const Triangle& c = mesh_.plane.triangles[t];
    std::array<double, 3> length{};
    for (int k = 0; k < 3; ++k) length[k] = norm(position(c[k]) - position(c[(k + 1) % 3]));
    const auto k = std::max_element(length.begin(), length.end()) - length.begin();
    return across_[t][k] >= 0 ? static_cast<int>(k) : -1;
  }

  // Across a longest side there may be a longer one, and so on; the last one is divided, so that no thinner triangles
  // come out than went in (Rivara's path of longest edges).
  bool divide(int t) {
    // Medians of triangles that are narrow already may be much shorter than halves.
    const double least = is_upright(triangle(t)) ? shortest_median * kept_.shortest_divided : 0;
    int i = longest_side(t);
    while (i >= 0) {
      const int u = across_[t][i], j = longest_side(u);
      if (j < 0 || across_[u][j] == t) break;
      // Of equal lengths the first met counts, or there would be no end.
      const Triangle &c = triangle(t), &d = triangle(u);
      if (!(norm(position(d[j]) - position(d[(j + 1) % 3])) > norm(position(c[i]) - position(c[(i + 1) % 3])))) break;
      t = u, i = j;
    }
    return i >= 0 && divide_side(t, i, least);
  }

  bool divide_side(int t, int i, double least) {
    const int u = across_[t][i], j = side_towards(u, t);
    const std::int32_t a = triangle(t)[i], b = triangle(t)[(i + 1) % 3], c = triangle(t)[(i + 2) % 3],
                       d = triangle(u)[(j + 2) % 3], m = static_cast<std::int32_t>(mesh_.xyz.size());
    mesh_.plane.vertices.push_back(lerp(mesh_.plane.vertices[a], mesh_.plane.vertices[b], 0.5));
    if (!positive({a, m, c}) || !positive({m, b, c}) || !positive({b, m, d}) || !positive({m, a, d})) {
      mesh_.plane.vertices.pop_back();
      return false;
    }
    const SurfaceJet jet = jet_at(mesh_.plane.vertices.back());
    const Vec3 away = jet.s - lerp(position(a), position(b), 0.5);
    if (!(norm(away) < farthest * norm(position(b) - position(a))) || norm(jet.s - position(c)) < least ||
        norm(jet.s - position(d)) < least) {
      mesh_.plane.vertices.pop_back();
      return false;
    }
    mesh_.xyz.push_back(jet.s);
    if (is_flat({a, m, c}) || is_flat({m, b, c}) || is_flat({b, m, d}) || is_flat({m, a, d})) {
      mesh_.plane.vertices.pop_back();
      mesh_.xyz.pop_back();
      return false;
    }
    if (with_normals_) mesh_.normal.push_back(unit_normal(jet).value_or(Vec3{}));
    const int bc = across_[t][(i + 1) % 3], ca = across_[t][(i + 2) % 3], ad = across_[u][(j + 1) % 3],
              db = across_[u][(j + 2) % 3];
    const int v = static_cast<int>(mesh_.plane.triangles.size()), w = v + 1;
    triangle(t) = {a, m, c};
    triangle(u) = {m, a, d};
    mesh_.plane.triangles.push_back({m, b, c});
    mesh_.plane.triangles.push_back({b, m, d});
    across_[t] = {u, v, ca};
    across_[u] = {t, ad, w};
    across_.push_back({w, bc, t});
    across_.push_back({v, u, db});
    ++depth_[t], ++depth_[u];
    depth_.push_back(depth_[t]);
    depth_.push_back(depth_[u]);
    reconnect(bc, t, v);
    reconnect(db, u, w);
    queue_.insert(queue_.end(), {t, u, v, w});
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
  double sine_;                // of the angle that is kept
  bool with_normals_ = false;  // the mesh has them at all vertices
  bool known_ = false;         // they are compared with those of triangles
  std::vector<std::array<int, 3>> across_;
  std::vector<std::uint8_t> depth_;  // by triangle
  std::vector<int> queue_;
};

}  // namespace

std::vector<int> refine_in_space(const PatchInput& input, Cad& cad, const SizeRules& rules, const GeometricLimits& kept,
                                 PatchMesh& mesh, Monitor& monitor) {
  return SpaceRefinement(input, cad, rules, kept, mesh, monitor).run();
}

}  // namespace carreau
