// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/bezier/bezier_geometry.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/bezier/bezier_cad.h"
#include "model/union_find.h"
#include "support/error.h"

namespace carreau {
namespace {

/// Squares of lengths must still be numbers.
constexpr double largest_coordinate = 1e100;

void check(const BezierPatch& patch, int face) {
  const auto fail = [&](const std::string& sentence) { throw InvalidArgument(Where{.face = face}, sentence); };
  for (const int degree : {patch.m, patch.n})
    if (degree < 1 || degree > largest_bezier_degree)
      fail("the degree of a Bezier patch is " + std::to_string(degree) + "; it must be from 1 to " +
           std::to_string(largest_bezier_degree));
  const auto points = static_cast<std::size_t>((patch.m + 1) * (patch.n + 1));
  if (patch.control.size() != points)
    fail("the Bezier patch has " + std::to_string(patch.control.size()) + " control points, but its degrees require " +
         std::to_string(points));
  for (std::size_t i = 0; i < points; ++i)
    if (!is_finite(patch.control[i]) || patch.control[i].cwiseAbs().maxCoeff() > largest_coordinate)
      fail("a coordinate of control point " + std::to_string(i + 1) + " is not a number below 1e100");
}

/// Corners in order: (0, 0), (1, 0), (1, 1), (0, 1).
Vec3 corner(const BezierPatch& patch, int which) {
  const auto row = static_cast<std::size_t>(patch.n + 1), last = static_cast<std::size_t>(patch.m) * row;
  const std::size_t at[] = {0, last, last + row - 1, row - 1};
  return patch.control[at[which]];
}

/// The corners at the ends of sides of one reference become one.
class Corners {
 public:
  explicit Corners(const BezierPatches& given) : given_(given), same_(bezier_sides * given.patches.size()) {
    std::map<int, std::pair<std::size_t, int>> first;
    for (std::size_t p = 0; p < given.patches.size(); ++p)
      for (int side = 0; side < bezier_sides; ++side) {
        const auto [at, is_first] = first.try_emplace(given.side_refs[p][static_cast<std::size_t>(side)], p, side);
        if (!is_first) join(at->second.first, at->second.second, p, side);
      }
  }

  /// From 1, in the order of faces.
  int reference(std::size_t patch, int which) {
    const auto [at, is_new] = numbers_.try_emplace(same_.find(index(patch, which)), 0);
    if (is_new) at->second = static_cast<int>(numbers_.size());
    return at->second;
  }

 private:
  static std::size_t index(std::size_t patch, int which) {
    return bezier_sides * patch + static_cast<std::size_t>(which % bezier_sides);
  }
  [[nodiscard]] Vec3 at(std::size_t patch, int which) const {
    return corner(given_.patches[patch], which % bezier_sides);
  }

  // Side k runs from corner k to corner k + 1.
  void join(std::size_t p, int i, std::size_t q, int j) {
    const double along = std::max((at(p, i) - at(q, j)).norm(), (at(p, i + 1) - at(q, j + 1)).norm());
    const double against = std::max((at(p, i) - at(q, j + 1)).norm(), (at(p, i + 1) - at(q, j)).norm());
    const int turned = against < along ? 1 : 0;
    same_.merge(index(p, i), index(q, j + turned));
    same_.merge(index(p, i + 1), index(q, j + 1 - turned));
  }

  const BezierPatches& given_;
  UnionFind same_;
  std::map<std::size_t, int> numbers_;
};

Model model_of(const BezierPatches& given) {
  Model model;
  for (std::size_t p = 0; p < given.patches.size(); ++p) {
    Face face{.ref = static_cast<int>(p) + 1, .curves = {}, .points = {}};
    face.curves.resize(bezier_sides);
    model.faces.push_back(std::move(face));
  }
  if (given.side_refs.empty()) return model;
  Corners corners(given);
  for (std::size_t p = 0; p < given.patches.size(); ++p)
    for (int side = 0; side < bezier_sides; ++side) {
      FaceCurve& curve = model.faces[p].curves[static_cast<std::size_t>(side)];
      curve.ref = given.side_refs[p][static_cast<std::size_t>(side)];
      curve.end1 = corners.reference(p, side), curve.end2 = corners.reference(p, (side + 1) % bezier_sides);
    }
  return model;
}

}  // namespace

BuiltGeometry build_bezier(BezierPatches patches) {
  if (patches.patches.empty()) throw InvalidArgument("there is no Bezier patch");
  for (std::size_t p = 0; p < patches.patches.size(); ++p) check(patches.patches[p], static_cast<int>(p) + 1);
  if (!patches.side_refs.empty() && patches.side_refs.size() != patches.patches.size())
    throw InvalidArgument("references of sides are given for " + std::to_string(patches.side_refs.size()) + " of " +
                          std::to_string(patches.patches.size()) + " Bezier patches");
  for (std::size_t p = 0; p < patches.side_refs.size(); ++p)
    for (const int ref : patches.side_refs[p])
      if (ref <= 0)
        throw InvalidArgument(Where{.face = static_cast<int>(p) + 1},
                              "the reference of a side is " + std::to_string(ref) + "; it must be positive");
  Model model = model_of(patches);
  return {.cad = std::make_shared<BezierCad>(std::move(patches.patches)), .model = std::move(model)};
}

}  // namespace carreau
