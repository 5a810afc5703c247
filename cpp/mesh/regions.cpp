// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/regions.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "mesh/triangle_search.h"
#include "model/union_find.h"
#include "support/error.h"
#include "model/format_point.h"

namespace carreau {

namespace {

constexpr std::size_t max_rays = 64;     // triangles that a point inside is sought from
constexpr std::size_t enough_points = 4;  // the farthest from the boundary of these is taken
constexpr double winding_tolerance = 1e-6;
constexpr double nearest_crossing = 1e-9;  // of the diagonal: nearer triangles touch the ray's start

/// A triangle at an edge a < b.
struct Wing {
  std::int32_t a = 0, b = 0, apex = 0;
  std::size_t triangle = 0;
  bool forward = false;  ///< the triangle runs from a to b
  double angle = 0;      ///< around the edge, from the first wing
};

class RegionFinder {
 public:
  explicit RegionFinder(const FlatMesh& mesh) : mesh_(mesh), sides_(2 * mesh.triangles.size()), search_(mesh.vertices, mesh.triangles) {
    low_ = high_ = mesh.vertices.empty() ? Vec3() : mesh.vertices.front();
    for (const Vec3& p : mesh.vertices) low_ = low_.cwiseMin(p), high_ = high_.cwiseMax(p);
    diagonal_ = norm(high_ - low_);
  }

  MeshRegions run() {
    if (mesh_.triangles.empty()) throw InvalidArgument("the surface bounds no solid: it has no triangles");
    unite_sectors();
    gather_shells();
    label();
    check_labels();
    add_regions();
    return std::move(found_);
  }

 private:
  struct Shell {
    std::vector<std::size_t> sides;
    double volume = 0;  ///< positive: the outer boundary of a region
  };

  [[nodiscard]] std::array<Vec3, 3> corners(std::size_t t) const {
    const auto at = [&](int k) { return mesh_.vertices[static_cast<std::size_t>(mesh_.triangles[t][static_cast<std::size_t>(k)])]; };
    return {at(0), at(1), at(2)};
  }
  [[nodiscard]] Vec3 area_vector(std::size_t t) const {
    const auto [a, b, c] = corners(t);
    return .5 * cross(b - a, c - a);
  }

  void unite_sectors() {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t a = mesh_.triangles[t][k], b = mesh_.triangles[t][(k + 1) % 3], c = mesh_.triangles[t][(k + 2) % 3];
        wings_.push_back({std::min(a, b), std::max(a, b), c, t, a < b});
      }
    const auto by_edge = [](const Wing& w) { return std::array<std::int64_t, 3>{w.a, w.b, static_cast<std::int64_t>(w.triangle)}; };
    std::ranges::sort(wings_, {}, by_edge);
    for (std::size_t first = 0, end = 0; first < wings_.size(); first = end) {
      while (end < wings_.size() && wings_[end].a == wings_[first].a && wings_[end].b == wings_[first].b) ++end;
      const std::span<Wing> edge(wings_.data() + first, end - first);
      if (edge.size() > 2) sort_around(edge);
      for (std::size_t i = 0; i < edge.size(); ++i) {
        const Wing &wing = edge[i], &next = edge[(i + 1) % edge.size()];
        sides_.merge(2 * wing.triangle + (wing.forward ? 1 : 0), 2 * next.triangle + (next.forward ? 0 : 1));
      }
    }
  }

  void sort_around(std::span<Wing> edge) const {
    const auto at = [&](std::int32_t v) -> const Vec3& { return mesh_.vertices[static_cast<std::size_t>(v)]; };
    const Vec3 start = at(edge.front().a), along = at(edge.front().b) - start;
    const double length = norm(along);
    const auto across = [&](const Wing& wing) -> Vec3 { return cross(along, at(wing.apex) - start); };
    const Vec3 first = across(edge.front());
    for (Wing& wing : edge) {
      const Vec3 own = across(wing);
      wing.angle = std::atan2(dot(cross(first, own), along) / (length > 0 ? length : 1), dot(first, own));
      if (wing.angle < 0) wing.angle += 2 * std::numbers::pi;
    }
    std::stable_sort(edge.begin() + 1, edge.end(), [](const Wing& p, const Wing& q) { return p.angle < q.angle; });
  }

  void gather_shells() {
    const Vec3 middle = .5 * (low_ + high_);
    for (std::size_t side = 0; side < 2 * mesh_.triangles.size(); ++side) {
      Shell& shell = shells_[sides_.find(side)];
      shell.sides.push_back(side);
      const auto [a, b, c] = corners(side / 2);
      const double volume = dot(a - middle, cross(b - middle, c - middle)) / 6;
      shell.volume += side % 2 == 0 ? volume : -volume;
    }
  }

  void label() {
    found_.sides.resize(mesh_.triangles.size());
    const auto& known = mesh_.names.face_solids;
    if (!known.empty()) {
      for (std::size_t t = 0; t < found_.sides.size(); ++t) {
        const auto own = known.find(mesh_.triangle_refs.empty() ? 0 : mesh_.triangle_refs[t]);
        if (own != known.end()) found_.sides[t] = {std::max(own->second[0], 0), std::max(own->second[1], 0)};
      }
      return;
    }
    // Triangles look out of a solid, unless all look into it.
    for (const std::size_t parity : {0U, 1U}) {
      std::vector<int> solid(2 * mesh_.triangles.size(), 0);
      int number = 0;
      std::vector<std::size_t> cavities;
      for (const auto& [first, shell] : shells_) {
        // Between two solids a triangle looks out of one of them only: most sides decide.
        const auto behind = static_cast<std::size_t>(std::ranges::count_if(shell.sides, [&](std::size_t side) { return side % 2 == parity; }));
        if (2 * behind <= shell.sides.size()) continue;
        if (shell.volume > 0)
          solid[first] = ++number;
        else if (shell.volume < 0)
          cavities.push_back(first);
      }
      if (number == 0) continue;
      for (const std::size_t first : cavities) solid[first] = solid_around(first, solid);
      for (std::size_t t = 0; t < found_.sides.size(); ++t)
        found_.sides[t] = {solid[sides_.find(2 * t)], solid[sides_.find(2 * t + 1)]};
      return;
    }
  }

  /// The region around a cavity: the outer boundary of least volume around it.
  int solid_around(std::size_t cavity, const std::vector<int>& solid) const {
    const auto [a, b, c] = corners(cavity / 2);
    const Vec3 place = (a + b + c) / 3;
    int best = 0;
    double least = infinity;
    for (const auto& [first, shell] : shells_)
      if (solid[first] > 0 && shell.volume > 0 && shell.volume < least && winding(place, shell) > .5)
        best = solid[first], least = shell.volume;
    return best;
  }

  [[nodiscard]] int label_of(std::size_t side) const { return found_.sides[side / 2][side % 2]; }

  void check_labels() const {
    std::size_t open = 0, wrong = 0;
    const Wing* first = nullptr;
    const auto sides_of = [&](const Wing& wing) { return found_.sides[wing.triangle]; };
    for (std::size_t begin = 0, end = 0; begin < wings_.size(); begin = end) {
      while (end < wings_.size() && wings_[end].a == wings_[begin].a && wings_[end].b == wings_[begin].b) ++end;
      const bool is_open = end == begin + 1 && (sides_of(wings_[begin])[0] != sides_of(wings_[begin])[1] || is_all_outside());
      bool is_wrong = false;
      for (std::size_t i = begin; i < end && end > begin + 1; ++i) {
        const Wing &wing = wings_[i], &next = wings_[i + 1 < end ? i + 1 : begin];
        is_wrong = is_wrong || sides_of(wing)[wing.forward ? 1 : 0] != sides_of(next)[next.forward ? 0 : 1];
      }
      open += is_open ? 1 : 0, wrong += is_wrong ? 1 : 0;
      // Sides that leak through an open edge are wrong elsewhere: the open edge is the cause.
      if ((is_open && open == 1) || (is_wrong && open == 0 && wrong == 1)) first = &wings_[begin];
    }
    if (first == nullptr) {
      if (is_all_outside()) throw InvalidArgument("the surface bounds no solid: all its triangles are sheets");
      return;
    }
    const auto at = [&](std::int32_t v) { return format_point(mesh_.vertices[static_cast<std::size_t>(v)]); };
    const std::string place = "the edge from " + at(first->a) + " to " + at(first->b) + " of face " +
                              std::to_string(mesh_.triangle_refs.empty() ? 0 : mesh_.triangle_refs[first->triangle]);
    if (open > 0)
      throw InvalidArgument("the surface is open: " + place + " has one triangle" +
                            (open > 1 ? ", as have " + std::to_string(open - 1) + " other edges" : ""));
    throw InvalidArgument("the solids on both sides of the surface contradict each other: " + place + " is between two solids where one must be");
  }

  [[nodiscard]] bool is_all_outside() const {
    return std::ranges::all_of(found_.sides, [](const std::array<int, 2>& each) { return each[0] == 0 && each[1] == 0; });
  }

  void add_regions() {
    for (const auto& [first, shell] : shells_) {
      const int solid = label_of(first);
      if (solid > 0) found_.volumes[solid] += shell.volume;
      if (!(shell.volume > 0)) continue;
      MeshRegion region;
      region.solid = solid;
      for (const std::size_t side : shell.sides)
        region.longest_edge = std::max(region.longest_edge, search_.longest_edge(static_cast<std::int32_t>(side / 2)));
      region.inside = point_inside(shell);
      (solid > 0 ? found_.solids : found_.holes).push_back(region);
    }
    std::ranges::stable_sort(found_.solids, {}, &MeshRegion::solid);
  }

  Vec3 point_inside(const Shell& shell) const {
    std::vector<std::pair<double, std::size_t>> order;
    for (const std::size_t side : shell.sides) order.emplace_back(-norm(area_vector(side / 2)), side);
    const std::size_t rays = std::min(order.size(), max_rays);
    std::ranges::partial_sort(order, order.begin() + static_cast<std::ptrdiff_t>(rays));
    Vec3 best;
    double farthest = 0;
    std::size_t points = 0;
    for (std::size_t k = 0; k < rays && points < enough_points; ++k) {
      const std::size_t side = order[k].second;
      const auto [a, b, c] = corners(side / 2);
      const Vec3 start = (a + b + c) / 3;
      const Vec3 normal = area_vector(side / 2);
      const double length = norm(normal);
      if (!(length > 0)) break;
      const Vec3 inward = (side % 2 == 0 ? -1 : 1) / length * normal;
      const double distance = next_crossing(start, inward, side / 2);
      if (!(distance < infinity) || distance <= farthest) continue;
      const Vec3 place = start + .5 * distance * inward;
      if (std::abs(winding(place, shell) - 1) > winding_tolerance) continue;
      best = place, farthest = distance, ++points;
    }
    if (points == 0) {
      const auto [a, b, c] = corners(shell.sides.front() / 2);
      throw InvalidArgument("no point inside the region beside the triangle at " + format_point((a + b + c) / 3) + " can be found: it is too thin");
    }
    return best;
  }

  [[nodiscard]] double next_crossing(const Vec3& start, const Vec3& direction, std::size_t own) const {
    std::vector<std::int32_t> near;
    search_.beside_segment(start, start + 2 * diagonal_ * direction, near);
    double least = infinity;
    for (const std::int32_t t : near) {
      if (static_cast<std::size_t>(t) == own) continue;
      const auto [a, b, c] = corners(static_cast<std::size_t>(t));
      // Moller, Trumbore, "Fast, minimum storage ray-triangle intersection", 1997; touched edges count.
      const Vec3 p = b - a, q = c - a, across = cross(direction, q);
      const double scale = dot(p, across);
      if (scale == 0) continue;
      const Vec3 from = start - a, turned = cross(from, p);
      const double u = dot(from, across) / scale, v = dot(direction, turned) / scale;
      constexpr double slack = 1e-12;
      if (u < -slack || v < -slack || u + v > 1 + slack) continue;
      const double distance = dot(q, turned) / scale;
      if (distance > nearest_crossing * diagonal_) least = std::min(least, distance);
    }
    return least;
  }

  /// Around a point: A. Van Oosterom, J. Strackee, "The solid angle of a plane triangle", 1983.
  [[nodiscard]] double winding(const Vec3& place, const Shell& shell) const {
    double sum = 0;
    for (const std::size_t side : shell.sides) {
      const auto corner = corners(side / 2);
      const Vec3 a = corner[0] - place, b = corner[1] - place, c = corner[2] - place;
      const double la = norm(a), lb = norm(b), lc = norm(c);
      const double angle = 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
      sum += side % 2 == 0 ? angle : -angle;
    }
    return sum / (4 * std::numbers::pi);
  }

  const FlatMesh& mesh_;
  UnionFind sides_;  // of triangles: 2 t is the back of triangle t, 2 t + 1 its front, where its normal points; a set is a shell
  TriangleSearch search_;
  Vec3 low_, high_;
  double diagonal_ = 0;
  std::vector<Wing> wings_;
  std::map<std::size_t, Shell> shells_;  // by their first side
  MeshRegions found_;
};

}  // namespace

MeshRegions find_regions(const FlatMesh& mesh) { return RegionFinder(mesh).run(); }

}  // namespace carreau
