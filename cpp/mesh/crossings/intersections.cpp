// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/crossings/intersections.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "mesh/crossings/box_pairs.h"
#include "mesh/crossings/changed_triangles.h"
#include "mesh/crossings/face_graphs.h"
#include "mesh/crossings/graphs.h"
#include "mesh/crossings/shared_cells.h"
#include "mesh/crossings/shared_search.h"
#include "mesh/crossings/spatial_order.h"
#include "mesh/crossings/views.h"
#include "predicates/orientation_3d.h"
#include "support/stepped_tasks.h"

namespace carreau {
namespace {

using Corners = std::array<Vec3, 3>;

constexpr std::int8_t no_axis = -1;

/// An axis along which the triangle has an area, the largest one if doubles can decide; no_axis: it has no area.
int axis_of(const Corners& t) noexcept {
  const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
  const double x = std::abs(n.x()), y = std::abs(n.y()), z = std::abs(n.z());
  const int best = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  for (int k = 0; k < 3; ++k)
    if (const int axis = (best + k) % 3; turn(axis, t[0], t[1], t[2]) != 0) return axis;
  return no_axis;
}

/// True if a plane along an edge of s and along the axis separates s and t, except for corners that are ends of that
/// edge. Such corners then span the common points of s and t.
bool parted_by_edges_of(const Corners& s, const Corners& t, int axis) noexcept {
  const int inside = turn(axis, s[0], s[1], s[2]);  // of each corner, seen from the edge opposite to it
  if (inside == 0) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 &from = s[(k + 1) % 3], &to = s[(k + 2) % 3];
    const bool parted = std::all_of(
        t.begin(), t.end(), [&](const Vec3& p) { return p == from || p == to || turn(axis, from, to, p) == -inside; });
    if (parted) return true;
  }
  return false;
}

/// The part of p - q over the triangle, in the middle; by doubles.
Vec3 middle_over(const Corners& t, int axis, const Vec3& p, const Vec3& q) noexcept {
  double from = 0, to = 1;
  const double sign = turn(axis, t[0], t[1], t[2]);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 a = along(axis, t[k]), side = along(axis, t[(k + 1) % 3]) - a;
    const double at_p = sign * cross(side, along(axis, p) - a), at_q = sign * cross(side, along(axis, q) - a);
    if (at_p < 0 && at_q > at_p) from = std::max(from, at_p / (at_p - at_q));
    if (at_q < 0 && at_p > at_q) to = std::min(to, at_p / (at_p - at_q));
  }
  return lerp(p, q, std::clamp((from + to) / 2, 0.0, 1.0));
}

bool flat_segments_meet(int axis, const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b) noexcept {
  const int sa = turn(axis, p, q, a), sb = turn(axis, p, q, b);
  const int sp = turn(axis, a, b, p), sq = turn(axis, a, b, q);
  // All on one line: the other sides of the triangle or its corners decide whether they overlap.
  return sa * sb <= 0 && sp * sq <= 0 && (sa != 0 || sb != 0);
}

/// p - q lies in the plane of t.
bool meets_in_plane(const Vec3& p, const Vec3& q, const Corners& t) noexcept {
  const int axis = axis_of(t), inside = turn(axis, t[0], t[1], t[2]);
  const auto holds = [&](const Vec3& x) {
    return turn(axis, t[0], t[1], x) * inside >= 0 && turn(axis, t[1], t[2], x) * inside >= 0 &&
           turn(axis, t[2], t[0], x) * inside >= 0;
  };
  if (holds(p) || holds(q)) return true;
  for (std::size_t k = 0; k < 3; ++k)
    if (flat_segments_meet(axis, p, q, t[k], t[(k + 1) % 3])) return true;
  return false;
}

/// True if p - q, p != q, has a point in common with the closed triangle t.
bool segment_meets(const Vec3& p, const Vec3& q, const Corners& t, Vec3& place) noexcept {
  const int sp = orientation(t[0], t[1], t[2], p), sq = orientation(t[0], t[1], t[2], q);
  if (sp * sq > 0) return false;
  if (sp == 0 && sq == 0) {
    if (!meets_in_plane(p, q, t)) return false;
    place = middle_over(t, axis_of(t), p, q);
    return true;
  }
  // The line crosses the plane in one point: inside if it passes all sides in one sense.
  const int a = orientation(p, q, t[0], t[1]), b = orientation(p, q, t[1], t[2]), c = orientation(p, q, t[2], t[0]);
  if (std::min({a, b, c}) < 0 && std::max({a, b, c}) > 0) return false;
  const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
  const double at_p = dot(n, p - t[0]), at_q = dot(n, q - t[0]);
  place = lerp(p, q, at_p != at_q ? std::clamp(at_p / (at_p - at_q), 0.0, 1.0) : 0.5);
  return true;
}

bool on_one_side(const Corners& s, const Corners& t) noexcept {
  const int first = orientation(s[0], s[1], s[2], t[0]);
  return first != 0 && orientation(s[0], s[1], s[2], t[1]) == first && orientation(s[0], s[1], s[2], t[2]) == first;
}

/// No common corner.
bool strangers_meet(const Corners& s, const Corners& t, Vec3& place) noexcept {
  if (on_one_side(s, t) || on_one_side(t, s)) return false;
  for (std::size_t k = 0; k < 3; ++k)
    if (segment_meets(s[k], s[(k + 1) % 3], t, place) || segment_meets(t[k], t[(k + 1) % 3], s, place)) return true;
  return false;
}

/// Corner i of s is corner j of t. Triangles are convex: from there to another common point and on, one of the two is
/// left over the side that faces the corner.
bool meet_beyond_corner(const Corners& s, std::size_t i, const Corners& t, std::size_t j, Vec3& place) noexcept {
  return segment_meets(s[(i + 1) % 3], s[(i + 2) % 3], t, place) ||
         segment_meets(t[(j + 1) % 3], t[(j + 2) % 3], s, place);
}

/// Corners i of s and j of t face an edge that both have.
bool overlap_at_edge(const Corners& s, std::size_t i, const Corners& t, std::size_t j, Vec3& place) noexcept {
  const Vec3 &from = s[(i + 1) % 3], &to = s[(i + 2) % 3];
  if (orientation(from, to, s[i], t[j]) != 0) return false;
  const int axis = axis_of(s);
  if (turn(axis, from, to, s[i]) != turn(axis, from, to, t[j])) return false;
  place = lerp(from, to, 0.5);
  return true;
}

/// `axis`: of s.
bool intersect(const Corners& s, const Corners& t, int axis, Vec3& place) noexcept {
  if (parted_by_edges_of(s, t, axis) || parted_by_edges_of(t, s, axis)) return false;
  std::size_t shared = 0, first_s = 0, first_t = 0, other_s = 3, other_t = 3;  // sums of indices to 3
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (s[i] == t[j]) ++shared, first_s = i, first_t = j, other_s -= i, other_t -= j;
  if (shared == 0) return strangers_meet(s, t, place);
  if (shared == 1) return meet_beyond_corner(s, first_s, t, first_t, place);
  if (shared == 2) return overlap_at_edge(s, other_s, t, other_t, place);
  place = (1.0 / 3) * (s[0] + s[1] + s[2]);
  return true;
}

using Indices = std::array<std::int32_t, 3>;

/// True if a plane of parted_by_edges_of() along an edge of s that ends at a common vertex separates them: this holds
/// for nearly all neighbours. `inside`: orientation of s, seen along the axis.
bool parted_at_neighbour(std::span<const Vec3> vertices, const Indices& s, const Indices& t, int axis,
                         int inside) noexcept {
  int in_t = 0, in_s = 0;  // bits of corners of t that s has, of s that t has
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (s[i] == t[j]) in_s |= 1 << i, in_t |= 1 << j;
  if (in_s == 0) return false;
  for (int k = 0; k < 3; ++k) {
    const std::int32_t from = s[(k + 1) % 3], to = s[(k + 2) % 3];
    if ((in_s & ~(1 << k)) == 0 || (in_s >> k & 1) != 0) continue;  // an end is common, and the corner before it is not
    const auto beyond = [&](int j) {
      return (in_t >> j & 1) != 0 || turn(axis, vertices[from], vertices[to], vertices[t[j]]) == -inside;
    };
    if (beyond(0) && beyond(1) && beyond(2)) return true;
  }
  return false;
}

/// The searchable triangles of a mesh.
struct SoundTriangles {
  std::vector<std::int32_t> numbers;
  std::vector<TriangleView> view;  // by triangle of the whole mesh
};

Corners corners_of(std::span<const Vec3> vertices, const std::array<std::int32_t, 3>& t) noexcept {
  return {vertices[static_cast<std::size_t>(t[0])], vertices[static_cast<std::size_t>(t[1])],
          vertices[static_cast<std::size_t>(t[2])]};
}

/// `wanted`: 1 for the triangles to search; empty: all.
SoundTriangles sound_triangles(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                               const std::vector<char>& wanted, int threads, Monitor& monitor) {
  const bool finite = std::all_of(vertices.begin(), vertices.end(), [](const Vec3& p) { return is_finite(p); });
  const auto usable = [&](std::int32_t v) {
    return v >= 0 && static_cast<std::size_t>(v) < vertices.size() &&
           (finite || is_finite(vertices[static_cast<std::size_t>(v)]));
  };
  constexpr std::size_t at_once = 16384;
  SoundTriangles sound;
  sound.view.resize(triangles.size());
  const std::size_t parts = (triangles.size() + at_once - 1) / at_once;
  std::vector<std::size_t> count(parts, 0);
  const auto look = [&](std::size_t part, Monitor&) {
    for (std::size_t i = part * at_once; i < std::min((part + 1) * at_once, triangles.size()); ++i) {
      const auto& t = triangles[i];
      if ((!wanted.empty() && wanted[i] == 0) || !usable(t[0]) || !usable(t[1]) || !usable(t[2])) continue;
      sound.view[i] = view_of(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
      if (sound.view[i].any()) ++count[part];
    }
  };
  run_each(parts, false, threads, look, monitor);
  std::vector<std::size_t> first(parts + 1, 0);
  std::partial_sum(count.begin(), count.end(), first.begin() + 1);
  sound.numbers.resize(first.back());
  const auto list = [&](std::size_t part, Monitor&) {
    std::size_t place = first[part];
    for (std::size_t i = part * at_once; i < std::min((part + 1) * at_once, triangles.size()); ++i)
      if (sound.view[i].any()) sound.numbers[place++] = static_cast<std::int32_t>(i);
  };
  run_each(parts, false, threads, list, monitor);
  return sound;
}

/// Keeps the first pairs of a part, whatever the order in which they come.
class FirstPairs {
 public:
  FirstPairs(std::size_t limit, Intersections& found) : limit_(limit), found_(found) {}

  void add(const TriangleIntersection& pair) {
    ++found_.count;
    if (limit_ == 0) return;
    found_.pairs.push_back(pair);
    if (found_.pairs.size() >= 2 * limit_) shorten(found_.pairs, limit_);
  }
  static void shorten(std::vector<TriangleIntersection>& pairs, std::size_t limit) {
    if (pairs.size() <= limit) return;
    std::nth_element(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(limit), pairs.end(), before);
    pairs.resize(limit);
  }
  static bool before(const TriangleIntersection& a, const TriangleIntersection& b) noexcept {
    return a.triangles < b.triangles;
  }

 private:
  std::size_t limit_;
  Intersections& found_;
};

void put(PacketWriter& packet, const Intersections& found) {
  packet.put(found.count);
  packet.put(static_cast<std::int64_t>(found.pairs.size()));
  for (const TriangleIntersection& pair : found.pairs) {
    for (const std::int32_t t : pair.triangles) packet.put(std::int64_t{t});
    for (int axis = 0; axis < 3; ++axis) packet.put(pair.place[axis]);
  }
}

Intersections get(PacketReader& packet) {
  Intersections found;
  found.count = packet.integer();
  constexpr std::size_t each = 2 * sizeof(std::int64_t) + 3 * sizeof(double);
  found.pairs.resize(packet.count(each));
  for (TriangleIntersection& pair : found.pairs) {
    for (std::int32_t& t : pair.triangles) t = static_cast<std::int32_t>(packet.integer());
    for (int axis = 0; axis < 3; ++axis) pair.place[axis] = packet.real();
  }
  return found;
}

/// Graphs of whole faces, then of neighbouring triangles among the others. Returns the number of its graph by triangle, or -1.
std::vector<std::int32_t> all_graphs(std::span<const Vec3> vertices, std::span<const Indices> triangles, const SoundTriangles& sound,
                                     const FacesOfTriangles& faces, int threads, Monitor& monitor) {
  std::vector<std::int32_t> graph(triangles.size(), -1);
  const std::int32_t of_faces = find_face_graphs(vertices, triangles, sound.view, faces, graph, threads, monitor);
  std::vector<std::int32_t> rest;
  if (of_faces == 0) rest.reserve(sound.numbers.size());
  for (const std::int32_t t : sound.numbers)
    if (graph[static_cast<std::size_t>(t)] < 0) rest.push_back(t);
  if (rest.empty()) return graph;
  rest = spatial_order(vertices, triangles, std::move(rest), monitor, threads);
  find_graphs_of(vertices, triangles, sound.view, rest, of_faces, graph, threads, monitor);
  return graph;
}

/// Triangles that may cross triangles of other graphs, graph by graph, neighbours near each other.
std::vector<std::int32_t> doubtful_order(std::span<const Vec3> vertices, std::span<const Indices> triangles,
                                         std::vector<std::int32_t> numbers, std::span<const std::int32_t> graph, int threads,
                                         Monitor& monitor) {
  const std::vector<std::int32_t> near = spatial_order(
      vertices, triangles, near_other_sets(vertices, triangles, std::move(numbers), graph, threads, monitor), monitor, threads);
  const auto rank = [&](std::int32_t t) { return static_cast<std::size_t>(graph[static_cast<std::size_t>(t)] + 1); };
  std::vector<std::size_t> next;  // by graph
  for (const std::int32_t t : near) {
    if (rank(t) + 1 >= next.size()) next.resize(rank(t) + 2, 0);
    ++next[rank(t) + 1];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<std::int32_t> order(near.size());
  for (const std::int32_t t : near) order[next[rank(t)]++] = t;
  return order;
}

/// Finds crossings between sound triangles, at least one of each pair in `asked`; empty: all.
Intersections find_among(std::span<const Vec3> vertices, std::span<const Indices> triangles, SoundTriangles sound,
                         const std::vector<char>& asked, std::size_t limit, const Executor& executor, Monitor& monitor,
                         const FacesOfTriangles& faces = {}) {
  const std::vector<std::int32_t> graph = all_graphs(vertices, triangles, sound, faces, executor.threads, monitor);
  std::vector<std::int32_t> order = doubtful_order(vertices, triangles, std::move(sound.numbers), graph, executor.threads, monitor);
  const BoxPairs near(vertices, triangles, std::move(order), graph, monitor, executor.threads);
  const auto ask = [&](std::size_t part, Monitor&) {
    Intersections here;
    FirstPairs first(limit, here);
    near.each(part, [&](std::size_t i, std::size_t j) {
      if (graph[i] >= 0 && graph[i] == graph[j]) return;
      if (!asked.empty() && asked[i] == 0 && asked[j] == 0) return;
      const TriangleView view = sound.view[i];
      if (parted_at_neighbour(vertices, triangles[i], triangles[j], view.axis(), view.turned())) return;
      Vec3 place;
      if (intersect(corners_of(vertices, triangles[i]), corners_of(vertices, triangles[j]), view.axis(), place))
        first.add({{static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)}, place});
    });
    return here;
  };
  const std::vector<Intersections> of_part =
      shared_work<Intersections>(executor, "triangles that cross", near.parts(), false, ask, put, get, monitor);
  Intersections all;
  for (const Intersections& some : of_part) {
    all.count += some.count;
    all.pairs.insert(all.pairs.end(), some.pairs.begin(), some.pairs.end());
    if (all.pairs.size() >= 2 * limit) FirstPairs::shorten(all.pairs, limit);
  }
  FirstPairs::shorten(all.pairs, limit);
  std::sort(all.pairs.begin(), all.pairs.end(), FirstPairs::before);
  return all;
}

}  // namespace

bool triangles_intersect(const Corners& s, const Corners& t, Vec3* place) noexcept {
  Vec3 point;
  const int axis = axis_of(s);
  if (axis == no_axis || axis_of(t) == no_axis || !intersect(s, t, axis, point)) return false;
  if (place != nullptr) *place = point;
  return true;
}

Intersections find_intersections(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                                 const IntersectionOptions& options, Monitor& monitor) {
  return find_intersections(vertices, triangles, options.limit, Executor{nullptr, options.threads}, monitor);
}

Intersections find_intersections(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                                 std::size_t limit, const Executor& executor, Monitor& monitor, const FacesOfTriangles& faces) {
  return find_among(vertices, triangles, sound_triangles(vertices, triangles, {}, executor.threads, monitor), {}, limit, executor,
                    monitor, faces);
}

Intersections find_intersections_of(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles,
                                    const std::vector<char>& asked, std::size_t limit, int threads, Monitor& monitor) {
  return find_among(vertices, triangles, sound_triangles(vertices, triangles, {}, threads, monitor), asked, limit,
                    Executor{nullptr, threads}, monitor);
}

Intersections find_intersections_again(const SearchedMesh& before, std::span<const Vec3> vertices,
                                       std::span<const std::array<std::int32_t, 3>> triangles, std::size_t limit,
                                       const Executor& executor, Monitor& monitor) {
  const std::vector<char> changed = changed_triangles(before, vertices, triangles, monitor);
  const std::vector<char> near = near_triangles(vertices, triangles, changed, executor.threads, monitor);
  return find_among(vertices, triangles, sound_triangles(vertices, triangles, near, executor.threads, monitor), changed, limit,
                    executor, monitor);
}

}  // namespace carreau
