// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/parts/near_triangles.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <string_view>

#include "mesh/crossings/spatial_order.h"
#include "support/box_tree.h"
#include "support/ranks/packet.h"
#include "support/ranks/team.h"

namespace carreau {

namespace {

using Corners = std::array<std::int32_t, 3>;
using Box = BoxTree::Box;

// Triangles in one box. All processes receive the large boxes, some 0.3 bytes a triangle; the small boxes inside boxes that meet
// others cost 4 bytes a triangle. [time and memory only]
constexpr std::size_t triangles_of_box = 256, triangles_of_small_box = 16;
// Largest ratio of the sides of a box to the sides of the box of its first triangle: neighbours in the order may be far apart, and
// their common box would meet unrelated ones. Twice the ratios of compact groups. [time and memory only]
constexpr double widest_box = 32, widest_small_box = 8;

/// The process of two that searches: each does so for half of the others.
int looks(int a, int b) noexcept { return (a + b) % 2 == 0 ? std::min(a, b) : std::max(a, b); }

Box box_of(const std::vector<Vec3>& vertices, const Corners& corners) {
  Box box;
  for (const std::int32_t v : corners) box.add(vertices[static_cast<std::size_t>(v)]);
  return box;
}

BoxTree tree_of(const std::vector<Box>& boxes, const CompositeRun& run) {
  std::vector<Vec3> centres;
  centres.reserve(boxes.size());
  for (const Box& box : boxes) centres.push_back(0.5 * (box.low + box.high));
  return {boxes, centres, &run.monitor, run.options.executor.threads};
}

/// Boxes that meet one.
void all_that_meet(const BoxTree& tree, const std::vector<Box>& boxes, const Box& box, std::vector<Box>& found) {
  found.clear();
  tree.all_that_meet([&](const Box& node) { return !box.is_apart(node); },
                     [&](const BoxTree::Node& leaf) {
                       for (const std::int32_t i : tree.things(leaf))
                         if (!box.is_apart(boxes[static_cast<std::size_t>(i)])) found.push_back(boxes[static_cast<std::size_t>(i)]);
                     });
}

/// Neighbours among triangles, with their boxes.
struct Groups {
  std::vector<std::size_t> first;  // of each, in OwnTriangles::order
  std::vector<Box> boxes;
};

/// The triangles of this process, and their order in space.
struct OwnTriangles {
  std::vector<TriangleOfFace> which;
  std::vector<Corners> corners;
  std::vector<std::int32_t> order;

  explicit OwnTriangles(const CompositeRun& run) : vertices_(run.result.mesh.vertices) {
    const SurfaceMesh& mesh = run.result.mesh;
    corners.reserve(mesh.triangle_count()), which.reserve(mesh.triangle_count());
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
      for (std::size_t t = 0; t < mesh.faces[f].triangles.size(); ++t) {
        const FaceMesh& face = mesh.faces[f];
        const Corners& local = face.triangles[t];
        corners.push_back({face.vertex[local[0]], face.vertex[local[1]], face.vertex[local[2]]});
        which.push_back({static_cast<std::int32_t>(f), static_cast<std::int32_t>(t)});
      }
    std::vector<std::int32_t> numbers(corners.size());
    std::iota(numbers.begin(), numbers.end(), 0);
    order = spatial_order(mesh.vertices, corners, std::move(numbers), run.monitor, run.options.executor.threads);
  }
  /// Box of the k-th triangle in the order.
  [[nodiscard]] Box box(std::size_t k) const { return box_of(vertices_, corners[static_cast<std::size_t>(order[k])]); }

  /// Divides the triangles from `begin` to before `end` in the order.
  void divide(std::size_t begin, std::size_t end, std::size_t most, double widest, Groups& groups) const {
    double limit = 0;
    std::size_t first = begin;
    for (std::size_t k = begin; k < end; ++k) {
      const Box added = box(k);
      Box together = added;
      if (k > begin) together.add(groups.boxes.back());
      if (k == begin || k - first == most || longest_side(together) > limit) {
        first = k, limit = widest * longest_side(added);
        groups.first.push_back(k), groups.boxes.push_back(added);
      } else {
        groups.boxes.back() = together;
      }
    }
  }

 private:
  static double longest_side(const Box& box) { return (box.high - box.low).maxCoeff(); }

  const std::vector<Vec3>& vertices_;
};

/// Parts of the groups that meet groups of other processes.
Groups small_groups(const CompositeRun& run, const OwnTriangles& own, const Groups& groups, const std::vector<Box>& others) {
  Groups small;
  const BoxTree tree = tree_of(others, run);
  std::vector<Box> near;
  for (std::size_t g = 0; g < groups.boxes.size(); ++g) {
    all_that_meet(tree, others, groups.boxes[g], near);
    const std::size_t end = g + 1 < groups.first.size() ? groups.first[g + 1] : own.order.size();
    if (!near.empty()) own.divide(groups.first[g], end, triangles_of_small_box, widest_small_box, small);
  }
  return small;
}

std::string packed(const std::vector<Box>& boxes) {
  PacketWriter packet;
  std::vector<Vec3> corners;
  corners.reserve(2 * boxes.size());
  for (const Box& box : boxes) corners.insert(corners.end(), {box.low, box.high});
  packet.put(corners);
  return packet.take();
}

/// Boxes of the other processes that `wanted` selects.
std::vector<Box> boxes_of_others(Team& team, std::string_view step, const std::vector<Box>& own, const std::function<bool(int)>& wanted) {
  std::vector<Box> boxes;
  const std::vector<std::string> all = team.exchange(step, packed(own));
  for (int rank = 0; rank < team.size(); ++rank) {
    if (rank == team.rank() || !wanted(rank)) continue;
    PacketReader packet(all[static_cast<std::size_t>(rank)]);
    const std::vector<Vec3> corners = packet.points();
    for (std::size_t k = 0; k + 1 < corners.size(); k += 2) boxes.push_back({corners[k], corners[k + 1]});
  }
  return boxes;
}

/// Own triangles that other processes need.
std::vector<TriangleOfFace> triangles_to_show(const CompositeRun& run, const OwnTriangles& own, const Groups& groups, const Groups& small,
                                              const std::vector<Box>& lookers) {
  std::vector<TriangleOfFace> shown;
  const BoxTree tree = tree_of(lookers, run);
  std::vector<Box> near;
  for (std::size_t g = 0; g < small.boxes.size(); ++g) {
    all_that_meet(tree, lookers, small.boxes[g], near);
    if (near.empty()) continue;
    // The next one may be in a group far behind.
    const auto behind = std::upper_bound(groups.first.begin(), groups.first.end(), small.first[g]);
    std::size_t end = behind == groups.first.end() ? own.order.size() : *behind;
    if (g + 1 < small.first.size()) end = std::min(end, small.first[g + 1]);
    for (std::size_t k = small.first[g]; k < end; ++k) {
      const Box box = own.box(k);
      if (std::any_of(near.begin(), near.end(), [&](const Box& other) { return !box.is_apart(other); }))
        shown.push_back(own.which[static_cast<std::size_t>(own.order[k])]);
    }
  }
  std::sort(shown.begin(), shown.end());
  return shown;
}

/// A triangle of another process, with vertices as NearTriangles has them.
struct OtherTriangle {
  TriangleOfFace which;
  Corners corners{};
};

/// Keeps the boxes and triangles of other processes that are near its own.
class Receiver {
 public:
  Receiver(const CompositeRun& run, const std::vector<Box>& own, std::vector<Vec3>& vertices)
      : run_(run), own_(own), tree_(tree_of(own, run)), vertices_(vertices) {}

  void take(const std::string& bytes, std::vector<OtherTriangle>& others) {
    std::vector<Box> near;
    for_shown_triangles(bytes, run_.result.mesh, *run_.result.shares, [&](const ShownTriangle& shown) {
      Box box;
      for (const ShownTriangle::Corner& corner : shown.corners) box.add(corner.xyz);
      all_that_meet(tree_, own_, box, near);
      if (near.empty()) return;
      OtherTriangle& other = others.emplace_back();
      other.which = shown.which;
      for (std::size_t k = 0; k < 3; ++k) other.corners[k] = index_of(shown.corners[k]);
    });
  }

 private:
  std::int32_t index_of(const ShownTriangle::Corner& corner) {
    if (corner.number < run_.result.shares->on_curves) return static_cast<std::int32_t>(corner.number);
    const auto [found, is_new] = index_.try_emplace(corner.number, static_cast<std::int32_t>(vertices_.size()));
    if (is_new) vertices_.push_back(corner.xyz);
    return found->second;
  }

  const CompositeRun& run_;
  const std::vector<Box>& own_;
  BoxTree tree_;
  std::vector<Vec3>& vertices_;
  std::map<std::int64_t, std::int32_t> index_;
};

void add_face(const FaceMesh& face, NearTriangles& near) {
  for (const auto& [a, b, c] : face.triangles) near.triangles.push_back({face.vertex[a], face.vertex[b], face.vertex[c]});
  near.own.resize(near.triangles.size(), 1);
}

}  // namespace

TriangleOfFace NearTriangles::origin(std::int32_t triangle) const {
  const auto next = std::upper_bound(first.begin(), first.end(), triangle);  // faces without triangles have no rows
  const auto face = static_cast<std::int32_t>(next - first.begin()) - 1;
  const std::int32_t rank = triangle - *(next - 1);
  const auto others = locals.find(face);
  return {face, others == locals.end() ? rank : others->second[static_cast<std::size_t>(rank)]};
}

NearTriangles near_triangles(const CompositeRun& run) {
  Team& team = *run.options.executor.team;
  const SurfaceMesh& mesh = run.result.mesh;
  NearTriangles near;
  near.vertices = mesh.vertices;
  std::vector<OtherTriangle> others;
  {
    const OwnTriangles own(run);
    Groups groups;
    own.divide(0, own.order.size(), triangles_of_box, widest_box, groups);
    const Groups small = small_groups(run, own, groups, boxes_of_others(team, "boxes", groups.boxes, [](int) { return true; }));
    const std::vector<Box> lookers =
        boxes_of_others(team, "small boxes", small.boxes, [&](int rank) { return looks(rank, team.rank()) == rank; });
    Receiver receiver(run, small.boxes, near.vertices);
    team.exchange_in_turn("triangles near others", show_triangles(mesh, *run.result.shares, triangles_to_show(run, own, groups, small, lookers)),
                          [&](int rank, const std::string& bytes) {
                            run.monitor.checkpoint();
                            if (rank != team.rank() && looks(rank, team.rank()) == team.rank()) receiver.take(bytes, others);
                          });
  }
  std::sort(others.begin(), others.end(), [](const OtherTriangle& a, const OtherTriangle& b) { return a.which < b.which; });
  near.triangles.reserve(mesh.triangle_count() + others.size());
  near.own.reserve(mesh.triangle_count() + others.size());
  auto other = others.begin();
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    near.first.push_back(static_cast<std::int32_t>(near.triangles.size()));
    add_face(mesh.faces[f], near);
    for (; other != others.end() && other->which.face == static_cast<std::int32_t>(f); ++other) {
      near.triangles.push_back(other->corners), near.own.push_back(0);
      near.locals[other->which.face].push_back(other->which.local);
    }
  }
  near.first.push_back(static_cast<std::int32_t>(near.triangles.size()));
  return near;
}

}  // namespace carreau
