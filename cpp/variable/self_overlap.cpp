// SPDX-License-Identifier: BSD-3-Clause
#include "variable/self_overlap.h"

#include <algorithm>

#include "predicates/predicates.h"
#include "support/box_tree.h"

namespace carreau::variable {

namespace {

struct OpenSide {
  std::int32_t a, b, triangle;
  BoxTree::Box box;
};

std::vector<OpenSide> open_sides(const Eroded& eroded) {
  std::vector<OpenSide> sides;
  for (std::size_t t = 0; t < eroded.piece.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      if (eroded.adjacency[t][k] >= 0) continue;
      OpenSide side{
          eroded.piece.triangles[t][k], eroded.piece.triangles[t][(k + 1) % 3], static_cast<std::int32_t>(t), {}};
      for (const std::int32_t v : {side.a, side.b}) {
        const Vec2& p = eroded.piece.vertices[static_cast<std::size_t>(v)];
        side.box.add(Vec3{p.x(), p.y(), 0});
      }
      sides.push_back(side);
    }
  return sides;
}

/// Have two segments without a common end a common point?
bool meet(const Piece& piece, const OpenSide& e, const OpenSide& f) {
  const auto at = [&](std::int32_t v) -> const Vec2& { return piece.vertices[static_cast<std::size_t>(v)]; };
  if (e.a == f.a || e.a == f.b || e.b == f.a || e.b == f.b || e.box.is_apart(f.box)) return false;
  return orientation(at(e.a), at(e.b), at(f.a)) * orientation(at(e.a), at(e.b), at(f.b)) <= 0 &&
         orientation(at(f.a), at(f.b), at(e.a)) * orientation(at(f.a), at(f.b), at(e.b)) <= 0;
}

}  // namespace

std::vector<std::int32_t> crossing_triangles(const Eroded& eroded) {
  const std::vector<OpenSide> sides = open_sides(eroded);
  std::vector<BoxTree::Box> boxes;
  std::vector<Vec3> centres;
  for (const OpenSide& side : sides) {
    boxes.push_back(side.box);
    centres.emplace_back((side.box.low + side.box.high) / 2);
  }
  const BoxTree tree(boxes, centres);
  std::vector<std::int32_t> found;
  for (const OpenSide& side : sides)
    tree.all_that_meet([&](const BoxTree::Box& box) { return !box.is_apart(side.box); },
                       [&](const BoxTree::Node& leaf) {
                         for (const std::int32_t i : tree.things(leaf))
                           if (meet(eroded.piece, side, sides[static_cast<std::size_t>(i)]))
                             found.push_back(side.triangle);
                       });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace carreau::variable
