// SPDX-License-Identifier: BSD-3-Clause
#include "variable/base/piece.h"

#include <algorithm>
#include <string>

#include "support/error.h"

namespace carreau::variable {

double Piece::area() const noexcept {
  double sum = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) sum += double_area(t);
  return sum / 2;
}

std::vector<Vec3> in_space(const std::vector<Vec2>& vertices) {
  std::vector<Vec3> space;
  space.reserve(vertices.size());
  for (const Vec2& p : vertices) space.emplace_back(p.x(), p.y(), 0);
  return space;
}

namespace {

struct Side {
  std::int32_t low, high, triangle;
  std::int8_t rank;
  bool ascending;  // the triangle runs from low to high

  bool operator<(const Side& other) const noexcept {
    if (low != other.low) return low < other.low;
    if (high != other.high) return high < other.high;
    return triangle < other.triangle;
  }
};

std::vector<Side> sorted_sides(const Piece& piece) {
  std::vector<Side> sides;
  sides.reserve(3 * piece.triangles.size());
  for (std::size_t t = 0; t < piece.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::int32_t a = piece.triangles[t][static_cast<std::size_t>(k)],
                         b = piece.triangles[t][static_cast<std::size_t>((k + 1) % 3)];
      sides.push_back(
          {std::min(a, b), std::max(a, b), static_cast<std::int32_t>(t), static_cast<std::int8_t>(k), a < b});
    }
  std::sort(sides.begin(), sides.end());
  return sides;
}

}  // namespace

Adjacency adjacency_of(const Piece& piece) {
  Adjacency adjacency(piece.triangles.size(), {-1, -1, -1});
  const std::vector<Side> sides = sorted_sides(piece);
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high) ++end;
    const auto complain = [&](const std::string& what) {
      throw InvalidArgument("triangles " + std::to_string(sides[i].triangle) + " and " +
                            std::to_string(sides[i + 1].triangle) + " of the piece " + what + " the edge of vertices " +
                            std::to_string(sides[i].low) + " and " + std::to_string(sides[i].high));
    };
    if (end - i > 2) complain("and another side share");
    if (end - i == 2) {
      const Side &p = sides[i], &q = sides[i + 1];
      if (p.ascending == q.ascending) complain("run the same way along");
      adjacency[static_cast<std::size_t>(p.triangle)][static_cast<std::size_t>(p.rank)] = q.triangle;
      adjacency[static_cast<std::size_t>(q.triangle)][static_cast<std::size_t>(q.rank)] = p.triangle;
    }
    i = end;
  }
  return adjacency;
}

std::pair<std::vector<std::int32_t>, std::int32_t> parts_of(const Adjacency& adjacency) {
  std::vector<std::int32_t> part(adjacency.size(), -1), todo;
  std::int32_t count = 0;
  for (std::size_t first = 0; first < adjacency.size(); ++first) {
    if (part[first] >= 0) continue;
    part[first] = count;
    todo.push_back(static_cast<std::int32_t>(first));
    while (!todo.empty()) {
      const auto t = static_cast<std::size_t>(todo.back());
      todo.pop_back();
      for (const std::int32_t n : adjacency[t])
        if (n >= 0 && part[static_cast<std::size_t>(n)] < 0) {
          part[static_cast<std::size_t>(n)] = count;
          todo.push_back(n);
        }
    }
    ++count;
  }
  return {std::move(part), count};
}

}  // namespace carreau::variable
