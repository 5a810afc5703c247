#include "surface/improve/swaps.h"

#include <algorithm>

#include "predicates/predicates.h"

namespace carreau {

namespace {

// A swap must gain this much, so that no pair of swaps undoes each other for ever.
constexpr double least_gain = 1e-6;
// Cosine of the angle to the nearer of the two old triangles that a new one must keep: across a tube or around an apex
// of three edges the best shape is the cross-section.
constexpr double least_agreement = 0.7;
// A fan of n triangles in a narrow wedge is undone in n passes; nearly all patches need two or three.
constexpr int most_passes = 100;

class Swapper {
 public:
  Swapper(const BadRegion& region, PlaneMesh& mesh, const std::vector<Vec3>& xyz)
      : region_(region), mesh_(mesh), xyz_(xyz), touched_(mesh.triangles.size(), 0), marked_(mesh.vertices.size(), 0) {}

  bool run(Monitor& monitor) {
    bool any = false;
    for (int pass = 0; pass < most_passes; ++pass) {
      const std::vector<std::int32_t> bad = region_.below(poor_quality);
      if (bad.empty()) break;
      monitor.checkpoint();
      collect_around(bad);
      monitor.checkpoint();
      bool changed = false;
      for (const std::int32_t t : bad) changed |= improve(t);
      any |= changed;
      if (!changed) break;
    }
    return any;
  }

 private:
  using Key = std::array<int, 2>;
  using Triangle = std::array<std::int32_t, 3>;

  static Key key(int a, int b) { return {std::min(a, b), std::max(a, b)}; }
  [[nodiscard]] double quality(const Triangle& t) const { return quality_in_space(t, xyz_); }
  [[nodiscard]] double length(int a, int b) const { return norm(xyz_[a] - xyz_[b]); }
  [[nodiscard]] bool positive(const Triangle& t) const {
    return orientation(mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]) > 0;
  }

  [[nodiscard]] Vec3 normal(const Triangle& t) const {
    const Vec3 n = cross(xyz_[t[1]] - xyz_[t[0]], xyz_[t[2]] - xyz_[t[0]]);
    const double l = norm(n);
    return l > 0 ? (1 / l) * n : Vec3{};
  }
  // Triangles without area agree with all.
  [[nodiscard]] bool leaves(const Triangle& t, const Triangle& old, const Triangle& other) const {
    const Vec3 n = normal(t), p = normal(old), q = normal(other);
    if (p == Vec3{} || q == Vec3{}) return false;
    return std::max(dot(n, p), dot(n, q)) < least_agreement;
  }

  // Only bad triangles and their neighbours are looked at: a sorted list of all edges would cost more than it gives.
  void collect_around(const std::vector<std::int32_t>& bad) {
    for (const std::int32_t t : bad)
      for (const int v : mesh_.triangles[t]) marked_[v] = 1;
    sides_.clear();
    for (const std::int32_t t : region_.triangles()) {
      touched_[t] = 0;
      for (int i = 0; i < 3; ++i) {
        const int a = mesh_.triangles[t][i], b = mesh_.triangles[t][(i + 1) % 3];
        if (marked_[a] != 0 && marked_[b] != 0) sides_.push_back({key(a, b), t});
      }
    }
    for (const std::int32_t t : bad)
      for (const int v : mesh_.triangles[t]) marked_[v] = 0;
    std::sort(sides_.begin(), sides_.end(),
              [](const Side& p, const Side& q) { return p.key != q.key ? p.key < q.key : p.triangle < q.triangle; });
  }

  // The triangle across edge (a, b) of t, or -1.
  [[nodiscard]] int across(int t, int a, int b) const {
    auto it = std::lower_bound(sides_.begin(), sides_.end(), key(a, b),
                               [](const Side& s, const Key& k) { return s.key < k; });
    for (; it != sides_.end() && it->key == key(a, b); ++it)
      if (it->triangle != t) return it->triangle;
    return -1;
  }

  bool improve(int t) {
    if (touched_[t] != 0) return false;
    double best = least_gain;
    int best_u = -1;
    Triangle best_t{}, best_other{};
    for (int i = 0; i < 3; ++i) {
      const int a = mesh_.triangles[t][i], b = mesh_.triangles[t][(i + 1) % 3], c = mesh_.triangles[t][(i + 2) % 3];
      if (region_.is_imposed(a, b)) continue;
      const int u = across(t, a, b);
      if (u < 0 || touched_[u] != 0) continue;
      const Triangle& other = mesh_.triangles[u];
      const int d = other[0] + other[1] + other[2] - a - b;
      // c on the left of a -> b, d on its right: the other diagonal is c - d.
      const Triangle first{a, d, c}, second{d, b, c};
      if (xyz_[c] == xyz_[d] || !positive(first) || !positive(second)) continue;
      // In a narrow strip that winds, far vertices make triangles of a better shape that leave the surface.
      if (norm(xyz_[c] - xyz_[d]) > std::max({length(a, b), length(b, c), length(c, a), length(a, d), length(d, b)}))
        continue;
      if (leaves(first, mesh_.triangles[t], other) || leaves(second, mesh_.triangles[t], other)) continue;
      const double before = std::min(quality(mesh_.triangles[t]), quality(other));
      const double gain = std::min(quality(first), quality(second)) - before;
      if (gain > best) best = gain, best_u = u, best_t = first, best_other = second;
    }
    if (best_u < 0) return false;
    mesh_.triangles[t] = best_t;
    mesh_.triangles[best_u] = best_other;
    // Their neighbours are known again in the next pass only.
    touched_[t] = touched_[best_u] = 1;
    return true;
  }

  struct Side {
    Key key;
    int triangle;
  };
  const BadRegion& region_;
  PlaneMesh& mesh_;
  const std::vector<Vec3>& xyz_;
  std::vector<Side> sides_;
  std::vector<char> touched_;  // by triangle, in this pass
  std::vector<char> marked_;   // by vertex: of a bad triangle, while sides are collected
};

}  // namespace

bool swap_in_space(const BadRegion& region, PlaneMesh& mesh, const std::vector<Vec3>& xyz, Monitor& monitor) {
  return Swapper(region, mesh, xyz).run(monitor);
}

}  // namespace carreau
