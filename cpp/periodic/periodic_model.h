// SPDX-License-Identifier: BSD-3-Clause
// Faces, curves and corners that are one under the maps of a model.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "periodic/match_faces.h"

namespace carreau {

/// A curve as the image of the root of its class.
struct CurveMember {
  CurveImage image;  ///< of the root
  Isometry map;      ///< of the root onto the curve
};

/// The maps of a closed curve onto itself: r -> r + k / n, and beside them r -> turned_at - r if `turn` is set.
struct CurveCycle {
  int n = 1;
  Isometry step;  ///< carries fraction r to r + 1 / n
  std::optional<Isometry> turn = {};
  double turned_at = 0;

  [[nodiscard]] bool is_trivial() const noexcept { return n == 1 && !turn; }
  [[nodiscard]] Isometry power(int k) const noexcept;
};

struct CurveClass {
  std::vector<CurveMember> members;  ///< the root first, the lowest of their indices
  std::optional<Isometry> turn = {};  ///< carries the root, which is open, onto itself, reversed
  CurveCycle cycle = {};              ///< of a closed root
  std::vector<Isometry> mirrors = {};  ///< reflections in planes that hold the root
};

/// Closed under chains of maps: a class is all that the maps carry onto each other.
struct PeriodicModel {
  std::vector<FacePair> pairs;      ///< of each slave, ascending; the master is the lowest face of the class, and no slave
  std::vector<int> pair_of_slave;   ///< by face: index in `pairs`; -1: the face is no slave
  std::vector<char> is_periodic;    ///< by face: it is a slave or a master
  std::vector<CurveClass> curves;   ///< of two members or more, or of one that turns
  std::vector<char> has_class;      ///< by curve
  std::vector<std::array<int, 2>> place;  ///< by curve with a class: index in `curves`, and in its members
  std::vector<std::vector<int>> corners;  ///< classes of two corners or more
  std::vector<std::vector<Isometry>> corner_maps;  ///< of the first corner of a class onto each of its corners
  std::vector<std::pair<int, Vec3>> placed;  ///< corners and their places: images of the first of their class, on its mirror planes
  double gap = 0;                   ///< model length: images may miss by it
  std::vector<std::string> remarks = {};  ///< what a person should know

  [[nodiscard]] bool empty() const noexcept { return pairs.empty() && curves.empty(); }
};

/// Fractions of the root that the maps of the class carry fraction r to, itself first.
std::vector<double> images_on_root(const CurveClass& all, bool closed, double r);

/// Moves a point that rounding alone has put beside the planes of reflections onto them.
Vec3 on_planes(Vec3 p, const std::vector<Isometry>& mirrors, double gap);

/// Matches the faces and collects their classes along spanning trees. Throws InvalidModel as match_faces(), and where two
/// chains of maps carry a face or a curve onto one another in different ways.
PeriodicModel find_periodic(const CurveModel& model, double diag);

}  // namespace carreau
