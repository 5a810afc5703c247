// SPDX-License-Identifier: BSD-3-Clause
// Points of three spheres, and tests whether balls cover points. Steps of arrange().
#pragma once

#include <vector>

#include "geometry/molecule/arrangement.h"

namespace carreau::molecule {

Circle circle_of_pair(std::span<const Ball> balls, int i, int j);

/// Decisions that rounding leaves open: the balls of these decisions.
class Doubts {
 public:
  void add(std::initializer_list<int> balls) { balls_.insert(balls_.end(), balls); }
  void add(const Doubts& other) { balls_.insert(balls_.end(), other.balls_.begin(), other.balls_.end()); }
  [[nodiscard]] bool none() const { return balls_.empty(); }
  /// Ascending, each once.
  [[nodiscard]] std::vector<int> list() const;

 private:
  std::vector<int> balls_;
};

/// Result of a test whether some ball covers a point, in the order of `others`; balls of `but` are skipped.
enum class Cover { no, yes, doubtful };
struct CoverTest {
  std::span<const Ball> balls;
  std::span<const int> others;
  double tolerance = 0;
  [[nodiscard]] Cover of(const Vec3& p, std::span<const int> but, int& doubtful_ball) const;
};

/// Appends the points of spheres i < j < k, of all j and k for one i, that no ball covers.
void find_vertices(std::span<const Ball> balls, const Neighbours& neighbours, int i, std::vector<Vertex>& vertices,
                   Doubts& doubts);

}  // namespace carreau::molecule
