#include "surface/improve/smoothing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "cad/fundamental_forms.h"
#include "predicates/predicates.h"

namespace carreau {

namespace {

constexpr int most_passes = 12;
// A move must raise the worst around a vertex by so much.
constexpr double least_gain = 1e-3;
// Steps of the search, in mean lengths of the edges around: from the first, halved down to the last.
constexpr double first_step = 0.4, last_step = 0.01;
// Shares of a step that are tried on the surface itself: it bends away from the tangent plane.
constexpr std::array<double, 3> shares{1, 0.5, 0.25};
// Least cosine of a triangle's normal and the surface's at its corners, unless it was less before: around the apex of a
// narrow cone, and across a bend, the best shapes are those of the cross-section.
constexpr double least_agreement = 0.5;

class SpaceSmoothing {
 public:
  SpaceSmoothing(const BadRegion& region, int ref, Cad& cad, PatchMesh& mesh, Monitor& monitor)
      : region_(region), ref_(ref), cad_(cad), mesh_(mesh), monitor_(monitor) {
    rank_.assign(mesh.xyz.size(), -1);
    for (const std::int32_t t : region.triangles())
      for (const std::int32_t v : mesh.plane.triangles[t]) {
        if (rank_[v] < 0) {
          rank_[v] = static_cast<int>(stars_.size());
          stars_.push_back({.vertex = v});
        }
        if (region.may_move(v)) stars_[rank_[v]].triangles.push_back(t);
      }
  }

  std::vector<std::int32_t> run() {
    std::vector<std::int32_t> all;
    for (int pass = 0; pass < most_passes; ++pass) {
      bool moved = false;
      for (const std::int32_t v : corners_of_bad()) {
        monitor_.checkpoint();
        if (!improve(star_of(v))) continue;
        moved = true;
        all.push_back(v);
      }
      if (!moved) break;
    }
    return all;
  }

 private:
  using Triangle = std::array<std::int32_t, 3>;
  struct Star {
    std::int32_t vertex = 0;
    std::vector<std::int32_t> triangles = {};  // none around a vertex that may not move
    bool tried = false;                        // in vain, and nothing around has moved since
    std::optional<Vec3> normal = {};           // of unit length, or zero where the surface has none; once it was asked
  };

  [[nodiscard]] Star& star_of(std::int32_t v) { return stars_[rank_[v]]; }

  // Those that may move, of the worst triangles first.
  [[nodiscard]] std::vector<std::int32_t> corners_of_bad() {
    std::vector<std::pair<double, std::int32_t>> bad;
    for (const std::int32_t t : region_.below(good_quality)) bad.emplace_back(quality_of(t), t);
    std::sort(bad.begin(), bad.end());
    std::vector<std::int32_t> corners;
    for (const auto& [quality, t] : bad)
      for (const std::int32_t v : mesh_.plane.triangles[t])
        if (region_.may_move(v) && !star_of(v).tried) corners.push_back(v);
    return corners;
  }

  [[nodiscard]] double quality_of(std::int32_t t) const {
    return quality_in_space(mesh_.plane.triangles[t], mesh_.xyz);
  }
  // Below `least`, it need not be known.
  [[nodiscard]] double worst_around(const Star& star, double least = 0) const {
    double worst = 1;
    for (const std::int32_t t : star.triangles) {
      worst = std::min(worst, quality_of(t));
      if (worst < least) break;
    }
    return worst;
  }
  // The same of the triangles of order_: the one that told last is asked first.
  [[nodiscard]] double worst_in_order(double least) {
    double worst = 1;
    for (std::int32_t& t : order_) {
      worst = std::min(worst, quality_of(t));
      if (worst < least) {
        std::swap(t, order_.front());
        break;
      }
    }
    return worst;
  }
  [[nodiscard]] double sum_around(const Star& star) const {
    double sum = 0;
    for (const std::int32_t t : star.triangles) sum += quality_of(t);
    return sum;
  }
  [[nodiscard]] double mean_edge(const Star& star) const {
    double sum = 0;
    for (const std::int32_t t : star.triangles)
      for (const std::int32_t v : mesh_.plane.triangles[t]) sum += norm(mesh_.xyz[v] - mesh_.xyz[star.vertex]);
    return sum / (2 * static_cast<double>(star.triangles.size()));
  }

  [[nodiscard]] SurfaceJet jet_at(Vec2 uv) {
    SurfaceJet jet;
    cad_.surface(ref_, want_position | want_first, {&uv, 1}, {&jet, 1});
    return jet;
  }
  void ask_normals(const Star& star) {
    std::vector<Vec2> uv;
    std::vector<std::int32_t> asked;
    for (const std::int32_t t : star.triangles)
      for (const std::int32_t v : mesh_.plane.triangles[t])
        if (!star_of(v).normal) {
          star_of(v).normal = Vec3{};
          asked.push_back(v);
          uv.push_back(mesh_.plane.vertices[v]);
        }
    std::vector<SurfaceJet> jets(uv.size());
    if (!uv.empty()) cad_.surface(ref_, want_first, uv, jets);
    for (std::size_t k = 0; k < jets.size(); ++k) star_of(asked[k]).normal = unit_normal(jets[k]).value_or(Vec3{});
  }

  // The least cosine of a triangle's normal and those at its corners; that of a corner without a normal is zero.
  [[nodiscard]] double agreement(std::int32_t t) {
    const Triangle& c = mesh_.plane.triangles[t];
    const Vec3 n = cross(mesh_.xyz[c[1]] - mesh_.xyz[c[0]], mesh_.xyz[c[2]] - mesh_.xyz[c[0]]);
    const double size = norm(n);
    if (!(size > 0)) return -1;
    double least = 1;
    for (const std::int32_t v : c) least = std::min(least, dot(n, *star_of(v).normal) / size);
    return least;
  }

  // The way to the best place of the tangent plane, by a search along eight directions: the worst of some triangles
  // has no derivative.
  [[nodiscard]] Vec2 best_way(const Star& star, Vec3 e1, Vec3 e2) {
    const Vec3 home = mesh_.xyz[star.vertex];
    const double length = mean_edge(star);
    static constexpr double d = 0.70710678118654752;
    static const std::array<Vec2, 8> directions{
        {{1, 0}, {d, d}, {0, 1}, {-d, d}, {-1, 0}, {-d, -d}, {0, -1}, {d, -d}}};
    Vec2 way;
    double best = worst_around(star);
    order_ = star.triangles;
    for (double step = first_step; step > last_step;) {
      Vec2 next = way;
      for (const Vec2& direction : directions) {
        const Vec2 there = way + (step * length) * direction;
        mesh_.xyz[star.vertex] = home + there.x() * e1 + there.y() * e2;
        const double worst = worst_in_order(best);
        if (worst > best) best = worst, next = there;
      }
      if (next == way) step /= 2;
      way = next;
    }
    mesh_.xyz[star.vertex] = home;
    return way;
  }

  bool improve(Star& star) {
    if (star.tried) return false;
    star.tried = !move(star);
    if (star.tried) return false;
    for (const std::int32_t t : star.triangles)
      for (const std::int32_t v : mesh_.plane.triangles[t]) star_of(v).tried = false;
    return true;
  }

  bool move(Star& star) {
    const double worst = worst_around(star), sum = sum_around(star);
    if (!(worst < good_quality)) return false;
    Vec2& uv = mesh_.plane.vertices[star.vertex];
    Vec3& xyz = mesh_.xyz[star.vertex];
    const Vec2 home_uv = uv;
    const Vec3 home = xyz;
    const SurfaceJet jet = jet_at(uv);
    const std::optional<Vec3> normal = unit_normal(jet);
    if (!normal) return false;
    const Vec3 e1 = (1 / norm(jet.su)) * jet.su, e2 = cross(*normal, e1);
    const Vec2 way = best_way(star, e1, e2);
    if (way == Vec2{}) return false;
    const double along_v = way.y() / dot(jet.sv, e2);
    const Vec2 step{(way.x() - along_v * dot(jet.sv, e1)) / norm(jet.su), along_v};
    star.normal = normal;
    ask_normals(star);
    agreement_before_.clear();
    for (const std::int32_t t : star.triangles) agreement_before_.push_back(agreement(t));
    for (const double share : shares) {
      uv = home_uv + share * step;
      if (!is_positive(star)) continue;
      const SurfaceJet there = jet_at(uv);
      xyz = there.s;
      star.normal = unit_normal(there).value_or(Vec3{});
      const bool better = worst_around(star) > worst + least_gain && (worst < poor_quality || sum_around(star) > sum);
      if (better && agrees(star)) return true;
    }
    uv = home_uv;
    xyz = home;
    star.normal = normal;
    return false;
  }

  [[nodiscard]] bool is_positive(const Star& star) const {
    const std::vector<Vec2>& uv = mesh_.plane.vertices;
    return std::all_of(star.triangles.begin(), star.triangles.end(), [&](std::int32_t t) {
      const Triangle& c = mesh_.plane.triangles[t];
      return orientation(uv[c[0]], uv[c[1]], uv[c[2]]) > 0;
    });
  }
  [[nodiscard]] bool agrees(const Star& star) {
    for (std::size_t k = 0; k < star.triangles.size(); ++k)
      if (agreement(star.triangles[k]) < std::min(agreement_before_[k], least_agreement)) return false;
    return true;
  }

  const BadRegion& region_;
  int ref_;
  Cad& cad_;
  PatchMesh& mesh_;
  Monitor& monitor_;
  std::vector<int> rank_;  // by vertex: index in stars_, or -1
  std::vector<Star> stars_;
  std::vector<std::int32_t> order_;       // scratch of best_way()
  std::vector<double> agreement_before_;  // of the triangles of the star that is moved
};

}  // namespace

std::vector<std::int32_t> smooth_in_space(const BadRegion& region, int ref, Cad& cad, PatchMesh& mesh,
                                          Monitor& monitor) {
  return SpaceSmoothing(region, ref, cad, mesh, monitor).run();
}

}  // namespace carreau
