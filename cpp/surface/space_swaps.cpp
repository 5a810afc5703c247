#include "surface/space_swaps.h"

#include <algorithm>

#include "mesh/quality.h"
#include "predicates/predicates.h"

namespace carreau {

namespace {

// Triangles better than this are left as the metric made them.
constexpr double good_quality = 0.6;
// A swap must gain this much, so that no pair of swaps undoes each other for ever.
constexpr double least_gain = 1e-6;
// Cosine of the angle to the nearer of the two old triangles that a new one must keep: across a tube or around an apex
// of three edges the best shape is the cross-section.
constexpr double least_agreement = 0.7;
// A fan of n triangles in a narrow wedge is undone in n passes; nearly all patches need two or three.
constexpr int most_passes = 100;

class Swapper {
 public:
  Swapper(const PlaneDomain& domain, PlaneMesh& mesh, const std::vector<Vec3>& xyz) : mesh_(mesh), xyz_(xyz) {
    for (const PlaneEdge& edge : domain.edges) imposed_.push_back(key(edge.a, edge.b));
    std::sort(imposed_.begin(), imposed_.end());
  }

  // Only bad triangles and their neighbours are looked at: a sorted list of all edges would cost more than it gives.
  void run() {
    for (int pass = 0; pass < most_passes; ++pass) {
      std::vector<int> bad;
      for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t)
        if (is_bad(mesh_.triangles[t])) bad.push_back(t);
      if (bad.empty()) return;
      collect_around(bad);
      bool changed = false;
      for (const int t : bad) changed |= improve(t);
      if (!changed) return;
    }
  }

 private:
  using Key = std::array<int, 2>;
  using Triangle = std::array<std::int32_t, 3>;

  static Key key(int a, int b) { return {std::min(a, b), std::max(a, b)}; }
  [[nodiscard]] bool is_imposed(int a, int b) const {
    return std::binary_search(imposed_.begin(), imposed_.end(), key(a, b));
  }
  // A corner that two vertices of one apex share makes a flat triangle: it will be removed, and judges nothing.
  [[nodiscard]] double quality(const Triangle& t) const {
    const Vec3 a = xyz_[t[0]], b = xyz_[t[1]], c = xyz_[t[2]];
    if (a == b || b == c || c == a) return 1;
    return quality_q2(a, b, c);
  }
  // The same against good_quality, without roots for those that are good, which nearly all are.
  [[nodiscard]] bool is_bad(const Triangle& t) const {
    const Vec3 ab = xyz_[t[1]] - xyz_[t[0]], ac = xyz_[t[2]] - xyz_[t[0]], bc = ac - ab, n = cross(ab, ac);
    const double squares = dot(ab, ab) + dot(bc, bc) + dot(ac, ac), good = 1.001 * good_quality;
    return !(12 * dot(n, n) > good * good * squares * squares) && quality(t) < good_quality;
  }
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

  void collect_around(const std::vector<int>& bad) {
    std::vector<char> marked(mesh_.vertices.size(), 0);
    for (const int t : bad)
      for (const int v : mesh_.triangles[t]) marked[v] = 1;
    sides_.clear();
    for (int t = 0; t < static_cast<int>(mesh_.triangles.size()); ++t)
      for (int i = 0; i < 3; ++i) {
        const int a = mesh_.triangles[t][i], b = mesh_.triangles[t][(i + 1) % 3];
        if (marked[a] != 0 && marked[b] != 0) sides_.push_back({key(a, b), t});
      }
    std::sort(sides_.begin(), sides_.end(),
              [](const Side& p, const Side& q) { return p.key != q.key ? p.key < q.key : p.triangle < q.triangle; });
    touched_.assign(mesh_.triangles.size(), 0);
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
      if (is_imposed(a, b)) continue;
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
  PlaneMesh& mesh_;
  const std::vector<Vec3>& xyz_;
  std::vector<Key> imposed_;
  std::vector<Side> sides_;
  std::vector<char> touched_;
};

}  // namespace

void improve_in_space(const PlaneDomain& domain, PlaneMesh& mesh, const std::vector<Vec3>& xyz) {
  Swapper(domain, mesh, xyz).run();
}

}  // namespace carreau
