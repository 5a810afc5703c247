// SPDX-License-Identifier: BSD-3-Clause
#include "variable/base/erosion.h"

#include <algorithm>

#include "support/error.h"

namespace carreau::variable {

namespace {

using Flags = std::vector<char>;

/// Boundary edges of the triangles that are left, a vertex.
std::vector<int> boundary_degrees(const Piece& piece, const Adjacency& adjacency, const Flags& kept) {
  std::vector<int> degree(piece.vertices.size(), 0);
  for (std::size_t t = 0; t < piece.triangles.size(); ++t)
    for (std::size_t k = 0; kept[t] && k < 3; ++k) {
      const std::int32_t other = adjacency[t][k];
      if (other >= 0 && kept[static_cast<std::size_t>(other)]) continue;
      ++degree[static_cast<std::size_t>(piece.triangles[t][k])];
      ++degree[static_cast<std::size_t>(piece.triangles[t][(k + 1) % 3])];
    }
  return degree;
}

/// New multiple vertices may come up: until there are none.
std::int64_t undo_multiple_vertices(const Piece& piece, const Adjacency& adjacency, Flags& kept) {
  std::int64_t removed = 0;
  while (true) {
    const std::vector<int> degree = boundary_degrees(piece, adjacency, kept);
    std::int64_t now = 0;
    for (std::size_t t = 0; t < piece.triangles.size(); ++t) {
      const auto& corners = piece.triangles[t];
      if (!kept[t] || std::none_of(corners.begin(), corners.end(),
                                   [&](std::int32_t v) { return degree[static_cast<std::size_t>(v)] > 2; }))
        continue;
      kept[t] = 0;
      ++now;
    }
    if (now == 0) return removed;
    removed += now;
  }
}

/// Removes triangles with two open sides, one of them bared: the current ones, not triangles that their removal bares.
std::int64_t remove_dangling(const Adjacency& adjacency, Flags& kept) {
  std::vector<std::size_t> found;
  for (std::size_t t = 0; t < adjacency.size(); ++t) {
    const auto is_bared = [&](std::int32_t n) { return n >= 0 && !kept[static_cast<std::size_t>(n)]; };
    const auto bared = std::count_if(adjacency[t].begin(), adjacency[t].end(), is_bared),
               outer = std::count(adjacency[t].begin(), adjacency[t].end(), -1);
    if (kept[t] && bared > 0 && bared + outer >= 2) found.push_back(t);
  }
  for (const std::size_t t : found) kept[t] = 0;
  return static_cast<std::int64_t>(found.size());
}

Adjacency adjacency_among(const Adjacency& adjacency, const Flags& kept, const std::vector<std::int32_t>& number,
                          const std::vector<std::int32_t>& triangle_of) {
  Adjacency among;
  among.reserve(triangle_of.size());
  for (const std::int32_t t : triangle_of) {
    std::array<std::int32_t, 3> row = adjacency[static_cast<std::size_t>(t)];
    for (std::int32_t& n : row)
      n = n >= 0 && kept[static_cast<std::size_t>(n)] ? number[static_cast<std::size_t>(n)] : -1;
    among.push_back(row);
  }
  return among;
}

/// The part of the largest area stays; of equal ones the first.
std::int64_t keep_largest(const Piece& piece, const std::vector<std::int32_t>& part, std::int32_t parts,
                          const std::vector<std::int32_t>& triangle_of, Flags& kept) {
  std::vector<double> area(static_cast<std::size_t>(parts), 0);
  for (std::size_t i = 0; i < part.size(); ++i)
    area[static_cast<std::size_t>(part[i])] += piece.double_area(static_cast<std::size_t>(triangle_of[i]));
  const auto largest = static_cast<std::int32_t>(std::max_element(area.begin(), area.end()) - area.begin());
  std::int64_t removed = 0;
  for (std::size_t i = 0; i < part.size(); ++i)
    if (part[i] != largest) kept[static_cast<std::size_t>(triangle_of[i])] = 0, ++removed;
  return removed;
}

std::vector<std::int32_t> list_kept(const Flags& kept, std::vector<std::int32_t>& number) {
  std::vector<std::int32_t> list;
  number.assign(kept.size(), -1);
  for (std::size_t t = 0; t < kept.size(); ++t)
    if (kept[t]) {
      number[t] = static_cast<std::int32_t>(list.size());
      list.push_back(static_cast<std::int32_t>(t));
    }
  return list;
}

void copy_kept(const Piece& piece, Eroded& result) {
  std::vector<std::int32_t> number(piece.vertices.size(), -1);
  for (const std::int32_t t : result.triangle_of)
    for (const std::int32_t v : piece.triangles[static_cast<std::size_t>(t)]) number[static_cast<std::size_t>(v)] = 0;
  for (std::size_t v = 0; v < number.size(); ++v)
    if (number[v] == 0) {
      number[v] = static_cast<std::int32_t>(result.vertex_of.size());
      result.vertex_of.push_back(static_cast<std::int32_t>(v));
      result.piece.vertices.push_back(piece.vertices[v]);
    }
  for (const std::int32_t t : result.triangle_of) {
    std::array<std::int32_t, 3> corners = piece.triangles[static_cast<std::size_t>(t)];
    for (std::int32_t& v : corners) v = number[static_cast<std::size_t>(v)];
    result.piece.triangles.push_back(corners);
  }
}

}  // namespace

Eroded erode(const Piece& piece, std::span<const double> damage, double limit, bool keep_all_parts,
             std::span<const std::int32_t> kinds) {
  Eroded result;
  const Adjacency whole = adjacency_of(piece);
  Flags kept(piece.triangles.size(), 1);
  for (std::size_t t = 0; t < damage.size(); ++t)
    if (damage[t] >= limit) kept[t] = 0, ++result.damaged;
  result.at_multiple_vertices = undo_multiple_vertices(piece, whole, kept);
  result.dangling = remove_dangling(whole, kept);
  result.at_multiple_vertices += undo_multiple_vertices(piece, whole, kept);

  std::vector<std::int32_t> number;
  result.triangle_of = list_kept(kept, number);
  if (result.triangle_of.empty())
    throw InvalidArgument("nothing is left of the piece: all of its " + std::to_string(kept.size()) +
                          " elements are totally damaged, or hang together at single vertices only");
  result.adjacency = adjacency_among(whole, kept, number, result.triangle_of);
  const auto [part, parts] = parts_of(result.adjacency);
  result.parts_found = result.parts_kept = parts;
  if (!keep_all_parts && parts > 1) {
    result.in_parts = keep_largest(piece, part, parts, result.triangle_of, kept);
    result.triangle_of = list_kept(kept, number);
    result.adjacency = adjacency_among(whole, kept, number, result.triangle_of);
    result.parts_kept = 1;
  }
  copy_kept(piece, result);
  for (const std::int32_t t : result.triangle_of) {
    auto& bared = result.bared.emplace_back();
    auto& imposed = result.imposed.emplace_back();
    const auto& corners = piece.triangles[static_cast<std::size_t>(t)];
    const auto was_imposed = [&](std::size_t k) {
      return !kinds.empty() && kinds[static_cast<std::size_t>(corners[k % 3])] == Kind::imposed;
    };
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t other = whole[static_cast<std::size_t>(t)][k];
      bared[k] = other >= 0 && !kept[static_cast<std::size_t>(other)];
      imposed[k] = other < 0 && was_imposed(k) && was_imposed(k + 1);
    }
  }
  for (std::size_t t = 0; t < kept.size(); ++t)
    if (!kept[t]) result.removed_area += piece.double_area(t) / 2;
  return result;
}

}  // namespace carreau::variable
