// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/distance/surface_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "mesh/distance/heights.h"
#include "mesh/distance/triangle_distance.h"
#include "mesh/triangle_search.h"
#include "support/infinity.h"
#include "support/stepped_tasks.h"

namespace carreau {

namespace {

using Edge = std::array<std::int32_t, 2>;

/// Each once.
std::vector<Edge> edges_of(std::span<const std::array<std::int32_t, 3>> triangles) {
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (const auto& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) edges.push_back({std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])});
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

std::vector<std::int32_t> corners_of(std::span<const std::array<std::int32_t, 3>> triangles, std::size_t vertices) {
  std::vector<char> used(vertices, 0);
  for (const auto& t : triangles)
    for (const std::int32_t v : t) used[static_cast<std::size_t>(v)] = 1;
  std::vector<std::int32_t> corners;
  for (std::size_t v = 0; v < vertices; ++v)
    if (used[v] != 0) corners.push_back(static_cast<std::int32_t>(v));
  return corners;
}

}  // namespace

double largest_distance(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                        std::span<const Vec3> to_vertices, std::span<const std::array<std::int32_t, 3>> to_triangles,
                        Monitor& monitor, const Executor& executor) {
  const TriangleSearch search(to_vertices, to_triangles, &monitor, executor.threads);
  if (search.empty()) return 0;
  const std::vector<std::int32_t> corners = corners_of(triangles, vertices.size());
  const std::vector<Edge> edges = edges_of(triangles);
  const auto at = [&](std::int32_t v) -> const Vec3& { return vertices[static_cast<std::size_t>(v)]; };
  const auto point = [&](std::size_t k) -> Vec3 {
    if (k < corners.size()) return at(corners[k]);
    if ((k -= corners.size()) < edges.size()) return 0.5 * (at(edges[k][0]) + at(edges[k][1]));
    const auto& [a, b, c] = triangles[k - edges.size()];
    return (at(a) + at(b) + at(c)) / 3;
  };
  const std::size_t points = corners.size() + edges.size() + triangles.size();
  constexpr std::size_t at_once = 4096, between = 256;
  const auto look = [&](std::size_t first, std::size_t last, double* out, Monitor& of_task) {
    for (std::size_t piece = first; piece < last; ++piece, ++out) {
      std::int32_t guess = 0;
      for (std::size_t k = piece * at_once; k < std::min((piece + 1) * at_once, points); ++k) {
        if (k % between == 0) of_task.checkpoint();
        const NearestOnMesh nearest = search.nearest(point(k), guess);
        guess = nearest.triangle;
        *out = std::max(*out, nearest.distance);
      }
    }
  };
  double most = 0;
  for (const double of_piece :
       shared_rows(executor, "distances to triangles", {.count = (points + at_once - 1) / at_once}, look, monitor))
    most = std::max(most, of_piece);
  return most;
}

namespace {

std::size_t index(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

/// Triangles of a task.
constexpr std::size_t chunk = 1024;
/// Most pieces that a triangle is cut into, and pieces more for each triangle of the other mesh near it: some 5 k
/// pieces lie beside k triangles.
constexpr std::size_t max_pieces = 4096, pieces_of_each = 64;
/// A piece is halved if it is longer than the triangle beside it by this factor: cuts beside a small one would leave
/// slivers.
constexpr double halved_from = 3;
/// Share of the length of a piece: a plane so near to its corners does not cut it.
constexpr double clear_cut = 1e-9;

/// A corner of a piece, and its nearest triangle.
struct Corner {
  Vec3 p;
  std::int32_t nearest = 0;
  double distance = 0;
};
/// A convex polygon in the plane of a triangle.
using Piece = std::vector<Corner>;

struct Diagonal {
  std::size_t from = 0, to = 1;
  double length = 0;
};
Diagonal longest(const Piece& piece) {
  Diagonal best;
  for (std::size_t i = 0; i < piece.size(); ++i)
    for (std::size_t k = i + 1; k < piece.size(); ++k)
      if (const double d = norm(piece[k].p - piece[i].p); d > best.length) best = {i, k, d};
  return best;
}

struct Box {
  Vec3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  void add(std::span<const Vec3> points) {
    for (const Vec3& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  }
};

/// The distance from triangles to a mesh.
class DistanceBounder {
 public:
  DistanceBounder(const TrianglesOfSpace& from, const TrianglesOfSpace& to, const DistanceTolerance& tolerance,
                  const Executor& executor, Monitor& monitor)
      : from_(from), to_(to), search_(to.vertices, to.triangles, &monitor, executor.threads),
        heights_(to.vertices, to.triangles), tolerance_(tolerance), executor_(executor), monitor_(monitor) {}

  DistanceBounds run(std::vector<double>* of_triangles, std::vector<FarPoint>* farthest) {
    if (of_triangles != nullptr) of_triangles->assign(from_.triangles.size(), 0);
    if (farthest != nullptr) farthest->clear();
    if (search_.empty() || from_.triangles.empty()) return {};
    Box box, all;
    box.add(to_.vertices), all.add(from_.vertices), all.add(to_.vertices);
    length_ = tolerance_.length * norm(box.high - box.low);
    const double rounding = 32 * std::numeric_limits<double>::epsilon() *
                            std::max(all.low.cwiseAbs().maxCoeff(), all.high.cwiseAbs().maxCoeff());
    look_around();
    enough_ = goal(lower_);
    if (farthest != nullptr)
      for (std::size_t t = 0; t < from_.triangles.size(); ++t) farthest->push_back(farthest_of(t));
    const std::size_t n = from_.triangles.size();
    const std::vector<double> bounds = pairs(n, [&](std::size_t t, const double*, Monitor& of_task) -> Pair {
      const auto [low, high] = bounds_of(t, of_task);
      return {low, high + rounding};
    });
    DistanceBounds found{0, bounds[1]};
    for (std::size_t t = 0; t < n; ++t) {
      found.lower = std::max(found.lower, bounds[2 * t] - rounding);
      found.upper = std::max(found.upper, bounds[2 * t + 1]);
      if (of_triangles != nullptr) (*of_triangles)[t] = bounds[2 * t + 1];
    }
    return found;
  }

 private:
  using Pair = std::array<double, 2>;

  /// work(k, the pair of k - 1 or null, monitor) for each k below n, shared.
  template <typename Work>
  std::vector<double> pairs(std::size_t n, const Work& work) const {
    const auto fill = [&](std::size_t first, std::size_t last, double* out, Monitor& of_task) {
      constexpr std::size_t between = 64;
      for (std::size_t k = first; k < last; ++k, out += 2) {
        if (k % between == 0) of_task.checkpoint();
        const Pair found = work(k, k > first ? out - 2 : nullptr, of_task);
        out[0] = found[0], out[1] = found[1];
      }
    };
    return shared_rows(executor_, "bounds of distances", {.count = n, .width = 2, .at_once = chunk}, fill, monitor_);
  }

  /// The corners with their nearest triangles, by number; an empty `place` is skipped.
  template <typename Place>
  [[nodiscard]] std::vector<Corner> corners(std::size_t n, const Place& place) const {
    const std::vector<double> found = pairs(n, [&](std::size_t k, const double* before, Monitor&) -> Pair {
      const std::optional<Vec3> p = place(k);
      if (!p) return before != nullptr ? Pair{before[0], 0} : Pair{};
      const Corner c = corner(*p, before != nullptr ? static_cast<std::int32_t>(before[0]) : 0);
      return {static_cast<double>(c.nearest), c.distance};
    });
    std::vector<Corner> all(n);
    for (std::size_t k = 0; k < n; ++k)
      if (const std::optional<Vec3> p = place(k)) all[k] = {*p, static_cast<std::int32_t>(found[2 * k]), found[2 * k + 1]};
    return all;
  }

  [[nodiscard]] double goal(double lower) const noexcept { return (1 + tolerance_.share) * lower + length_; }

  [[nodiscard]] Corner corner(const Vec3& p, std::int32_t guess) const {
    const NearestOnMesh found = search_.nearest(p, guess);
    return {p, found.triangle, found.distance};
  }

  // Vertices and middles: most of the largest distance.
  void look_around() {
    std::vector<char> used(from_.vertices.size(), 0);
    for (const auto& t : from_.triangles)
      for (const std::int32_t v : t) used[index(v)] = 1;
    at_vertex_ = corners(used.size(), [&](std::size_t v) -> std::optional<Vec3> {
      if (used[v] == 0) return {};
      return from_.vertices[v];
    });
    middle_ = corners(from_.triangles.size(), [&](std::size_t t) -> std::optional<Vec3> {
      const auto& [a, b, c] = from_.triangles[t];
      return Vec3((from_.vertices[index(a)] + from_.vertices[index(b)] + from_.vertices[index(c)]) / 3);
    });
    for (const auto* corners : {&at_vertex_, &middle_})
      for (const Corner& c : *corners) lower_ = std::max(lower_, c.distance);
  }

  [[nodiscard]] FarPoint farthest_of(std::size_t triangle) const {
    const Corner* best = &middle_[triangle];
    for (const std::int32_t v : from_.triangles[triangle])
      if (at_vertex_[index(v)].distance > best->distance) best = &at_vertex_[index(v)];
    return {best->p, best->distance, best->nearest};
  }

  [[nodiscard]] std::array<Vec3, 3> target(std::int32_t t) const {
    const auto& [a, b, c] = to_.triangles[index(t)];
    return {to_.vertices[index(a)], to_.vertices[index(b)], to_.vertices[index(c)]};
  }

  /// Upper bound over a piece whose middle is known: the least of the bounds by the triangles nearest to its corners, and of the bound by
  /// its middle. A distance grows by at most the way between two places.
  [[nodiscard]] double upper_of(const Piece& piece, const Corner& middle) const {
    double radius = 0;
    for (const Corner& c : piece) radius = std::max(radius, norm(c.p - middle.p));
    double best = middle.distance + radius;
    const auto look = [&](std::int32_t t) {
      const std::array<Vec3, 3> c = target(t);
      double most = 0;
      for (const Corner& each : piece) {
        if (each.nearest != t) most = std::max(most, distance_to_triangle(each.p, c[0], c[1], c[2]));
        if (each.nearest == t) most = std::max(most, each.distance);
        if (most >= best) return;
      }
      best = most;
    };
    look(middle.nearest);
    std::int32_t last = middle.nearest;
    for (const Corner& c : piece)
      if (c.nearest != last) look(last = c.nearest);
    return best;
  }

  /// The largest height of the other mesh over a piece; infinite if the mesh does not cover it, or is higher than `enough`.
  [[nodiscard]] double height_over(const Piece& piece, const Vec3& normal, const Corner& middle, double enough) const {
    if (normal.isZero()) return infinity;
    std::vector<Vec3> polygon;
    for (const Corner& c : piece) polygon.push_back(c.p);
    return heights_.largest_over(polygon, normal, middle.nearest, enough).value_or(infinity);
  }

  DistanceBounds bounds_of(std::size_t triangle, Monitor& of_task) const {
    DistanceBounds found;
    std::vector<Piece> todo(1);
    for (const std::int32_t v : from_.triangles[triangle]) todo.back().push_back(at_vertex_[index(v)]);
    const Vec3 across = cross(todo[0][1].p - todo[0][0].p, todo[0][2].p - todo[0][0].p);
    const Vec3 normal = norm(across) > 0 ? Vec3(across / norm(across)) : Vec3(Vec3::Zero());
    std::size_t most = max_pieces, count = 0;
    while (!todo.empty()) {
      const Piece piece = std::move(todo.back());
      todo.pop_back();
      const Corner middle = count == 0 ? middle_[triangle] : middle_of(piece);
      found.lower = std::max(found.lower, middle.distance);
      for (const Corner& c : piece) found.lower = std::max(found.lower, c.distance);
      const double enough = std::max(enough_, goal(found.lower));
      double upper = upper_of(piece, middle);
      if (upper > enough) upper = std::min(upper, height_over(piece, normal, middle, enough));
      if (++count == most && most == max_pieces) most += pieces_of_each * beside(triangle);
      if (count % 256 == 0) of_task.checkpoint();
      if (upper <= enough || count >= most)
        found.upper = std::max(found.upper, upper);
      else
        cut(piece, middle, todo);
    }
    return found;
  }

  [[nodiscard]] std::size_t beside(std::size_t triangle) const {
    Box box;
    for (const std::int32_t v : from_.triangles[triangle]) box.add({&from_.vertices[index(v)], 1});
    const Vec3 room = Vec3::Constant(enough_);
    std::vector<std::int32_t> found;
    search_.beside_box(box.low - room, box.high + room, found);
    return found.size();
  }

  [[nodiscard]] Corner middle_of(const Piece& piece) const {
    Vec3 sum = Vec3::Zero();
    for (const Corner& c : piece) sum += c.p;
    return corner(sum / static_cast<double>(piece.size()), piece.front().nearest);
  }

  /// The part behind the plane through `at` with this normal, of unit length, goes to `parts`, the rest stays. False: the plane does not cut.
  bool split(Piece& piece, const Vec3& at, const Vec3& normal, double clear, std::vector<Piece>& parts) const {
    std::vector<double> side;
    for (const Corner& c : piece) side.push_back(dot(normal, c.p - at));
    if (std::ranges::max(side) <= clear || std::ranges::min(side) >= -clear) return false;
    Piece inside, outside;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const std::size_t k = (i + 1) % piece.size();
      (side[i] <= 0 ? inside : outside).push_back(piece[i]);
      if ((side[i] <= 0) == (side[k] <= 0)) continue;
      const Corner between =
          corner(lerp(piece[i].p, piece[k].p, side[i] / (side[i] - side[k])), piece[i].nearest);
      inside.push_back(between), outside.push_back(between);
    }
    parts.push_back(std::move(outside));
    piece = std::move(inside);
    return true;
  }

  // Cuts by the planes on the sides of the nearest triangle, otherwise in halves.
  void cut(Piece piece, const Corner& middle, std::vector<Piece>& parts) const {
    const Diagonal diagonal = longest(piece);
    const std::array<Vec3, 3> c = target(middle.nearest);
    const Vec3 normal = cross(c[1] - c[0], c[2] - c[0]);
    const double side = std::max({norm(c[1] - c[0]), norm(c[2] - c[1]), norm(c[0] - c[2])});
    bool any = false;
    if (norm(normal) > 0 && diagonal.length < halved_from * side)
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 across = cross(c[(i + 1) % 3] - c[i], normal);
        if (!(norm(across) > 0)) continue;
        any = split(piece, c[i], across / norm(across), clear_cut * diagonal.length, parts) || any;
      }
    if (!any) {
      const Vec3 way = piece[diagonal.to].p - piece[diagonal.from].p;
      split(piece, 0.5 * (piece[diagonal.to].p + piece[diagonal.from].p), way / diagonal.length, 0, parts);
    }
    parts.push_back(std::move(piece));
  }

  TrianglesOfSpace from_, to_;
  TriangleSearch search_;
  HeightSearch heights_;
  DistanceTolerance tolerance_;
  Executor executor_;
  Monitor& monitor_;
  std::vector<Corner> at_vertex_, middle_;
  double length_ = 0, lower_ = 0, enough_ = 0;
};

}  // namespace

DistanceBounds bound_distance(const TrianglesOfSpace& from, const TrianglesOfSpace& to, const DistanceTolerance& tolerance,
                              const Executor& executor, Monitor& monitor, std::vector<double>* of_triangles,
                              std::vector<FarPoint>* farthest) {
  return DistanceBounder(from, to, tolerance, executor, monitor).run(of_triangles, farthest);
}

}  // namespace carreau
