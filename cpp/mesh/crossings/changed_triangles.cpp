// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/crossings/changed_triangles.h"

#include <algorithm>
#include <bit>
#include <cstddef>

#include "support/box_tree.h"
#include "support/stepped_tasks.h"

namespace carreau {

namespace {

using Triangle = std::array<std::int32_t, 3>;

constexpr std::size_t at_once = 4096;  // triangles between two looks for a stop, or of one task
constexpr std::size_t one_of = 3;      // beyond this share of requested triangles, compares all [time only]

/// Numbers of places, by their bits.
class PlaceNumbers {
 public:
  explicit PlaceNumbers(std::span<const Vec3> places) : places_(places), slots_(std::bit_ceil(2 * places.size() + 1), none) {}

  /// Returns the first vertex with this place that was registered. If there is none, registers `v` if it is given.
  std::int32_t find(const Vec3& p, std::int32_t v = none) {
    for (std::size_t slot = hash(p) & mask();; slot = (slot + 1) & mask()) {
      if (slots_[slot] == none) return slots_[slot] = v;
      if (same(places_[static_cast<std::size_t>(slots_[slot])], p)) return slots_[slot];
    }
  }

 private:
  static constexpr std::int32_t none = -1;
  [[nodiscard]] std::size_t mask() const noexcept { return slots_.size() - 1; }
  static std::array<std::uint64_t, 3> bits(const Vec3& p) noexcept {
    return {std::bit_cast<std::uint64_t>(p.x()), std::bit_cast<std::uint64_t>(p.y()), std::bit_cast<std::uint64_t>(p.z())};
  }
  static bool same(const Vec3& p, const Vec3& q) noexcept { return bits(p) == bits(q); }
  static std::size_t hash(const Vec3& p) noexcept {
    std::uint64_t h = 0;
    for (const std::uint64_t b : bits(p)) h = (h ^ b) * 0x9E3779B97F4A7C15U, h ^= h >> 29;
    return h ^ (h >> 32);
  }

  std::span<const Vec3> places_;
  std::vector<std::int32_t> slots_;
};

bool in_range(const Triangle& t, std::size_t vertices) noexcept {
  return std::ranges::all_of(t, [&](std::int32_t v) { return v >= 0 && static_cast<std::size_t>(v) < vertices; });
}

BoxTree::Box box_of(std::span<const Vec3> vertices, const Triangle& t) noexcept {
  BoxTree::Box box;
  for (const std::int32_t v : t) box.add(vertices[static_cast<std::size_t>(v)]);
  return box;
}

/// Triangles of the previous mesh, by the smallest number of their corners' places; each is found once.
class TrianglesByPlaces {
 public:
  TrianglesByPlaces(const SearchedMesh& before, Monitor& monitor)
      : numbers_(before.vertices), first_(before.vertices.size(), -1), next_(before.triangles.size(), -1), corners_(before.triangles.size()) {
    std::vector<char> crosses(before.triangles.size(), 0);
    for (const TriangleIntersection& pair : before.pairs)
      for (const std::int32_t t : pair.triangles) crosses[static_cast<std::size_t>(t)] = 1;
    for (std::size_t t = 0; t < before.triangles.size(); ++t) {
      if (t % at_once == 0) monitor.checkpoint();
      if (crosses[t] != 0 || !in_range(before.triangles[t], before.vertices.size())) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int32_t v = before.triangles[t][i];
        corners_[t][i] = numbers_.find(before.vertices[static_cast<std::size_t>(v)], v);
      }
      std::ranges::sort(corners_[t]);
      std::int32_t& first = first_[static_cast<std::size_t>(corners_[t][0])];
      next_[t] = first, first = static_cast<std::int32_t>(t);
    }
  }

  std::int32_t number(const Vec3& place) { return numbers_.find(place); }
  bool take(Triangle corners) {
    if (std::ranges::min(corners) < 0) return false;
    std::ranges::sort(corners);
    for (std::int32_t* t = &first_[static_cast<std::size_t>(corners[0])]; *t >= 0; t = &next_[static_cast<std::size_t>(*t)]) {
      if (corners_[static_cast<std::size_t>(*t)] != corners) continue;
      *t = next_[static_cast<std::size_t>(*t)];
      return true;
    }
    return false;
  }

 private:
  PlaceNumbers numbers_;
  std::vector<std::int32_t> first_, next_;
  std::vector<Triangle> corners_;
};

}  // namespace

std::vector<char> changed_triangles(const SearchedMesh& before, std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                                    Monitor& monitor) {
  TrianglesByPlaces known(before, monitor);
  std::vector<std::int32_t> number(vertices.size());
  for (std::size_t v = 0; v < vertices.size(); ++v) number[v] = known.number(vertices[v]);
  std::vector<char> changed(triangles.size(), 1);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (t % at_once == 0) monitor.checkpoint();
    if (!in_range(triangles[t], vertices.size())) continue;
    Triangle corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = number[static_cast<std::size_t>(triangles[t][i])];
    changed[t] = known.take(corners) ? 0 : 1;
  }
  return changed;
}

std::vector<char> near_triangles(std::span<const Vec3> vertices, std::span<const Triangle> triangles, const std::vector<char>& asked,
                                 int threads, Monitor& monitor) {
  std::vector<BoxTree::Box> boxes;
  std::vector<Vec3> centres;
  if (one_of * static_cast<std::size_t>(std::ranges::count(asked, 1)) > triangles.size()) return std::vector<char>(triangles.size(), 1);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (asked[t] == 0 || !in_range(triangles[t], vertices.size())) continue;
    const BoxTree::Box box = box_of(vertices, triangles[t]);
    if (!is_finite(box.low) || !is_finite(box.high)) continue;
    boxes.push_back(box), centres.push_back(0.5 * (box.low + box.high));
  }
  const BoxTree tree(boxes, centres, &monitor, threads);
  std::vector<char> near = asked;
  const auto look = [&](std::size_t part, Monitor&) {
    for (std::size_t t = part * at_once; t < std::min((part + 1) * at_once, triangles.size()); ++t) {
      if (asked[t] != 0 || !in_range(triangles[t], vertices.size())) continue;
      const BoxTree::Box box = box_of(vertices, triangles[t]);
      tree.all_that_meet([&](const BoxTree::Box& all) { return near[t] == 0 && !box.is_apart(all); },
                         [&](const BoxTree::Node& leaf) {
                           for (const std::int32_t k : tree.things(leaf))
                             if (!box.is_apart(boxes[static_cast<std::size_t>(k)])) near[t] = 1;
                         });
    }
  };
  run_each((triangles.size() + at_once - 1) / at_once, false, threads, look, monitor);
  return near;
}

}  // namespace carreau
