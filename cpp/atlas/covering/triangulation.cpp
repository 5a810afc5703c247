// SPDX-License-Identifier: BSD-3-Clause
#include "atlas/covering/triangulation.h"

#include <algorithm>
#include <map>

#include "support/error.h"

namespace carreau::atlas {
namespace {

std::string name_of(std::int32_t v) { return std::to_string(v + 1); }

void require_numbers(const Triangulation& s) {
  constexpr double largest_coordinate = 1e100;
  for (std::size_t v = 0; v < s.vertices.size(); ++v)
    if (!is_finite(s.vertices[v]) || s.vertices[v].cwiseAbs().maxCoeff() > largest_coordinate)
      throw InvalidArgument("vertex " + std::to_string(v + 1) +
                            " of the triangulation has coordinates that are not numbers below 1e100");
  for (std::size_t t = 0; t < s.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t v = s.triangles[t][k];
      if (v < 0 || static_cast<std::size_t>(v) >= s.vertices.size())
        throw InvalidArgument("triangle " + std::to_string(t + 1) + " has a vertex " + name_of(v) +
                              " that the triangulation does not have");
      if (v == s.triangles[t][(k + 1) % 3])
        throw InvalidArgument("triangle " + std::to_string(t + 1) + " has vertex " + name_of(v) + " twice");
    }
}

}  // namespace

Fans::Fans(const Triangulation& surface) : fans_(surface.vertices.size()) {
  if (surface.triangles.empty()) throw InvalidArgument("the triangulation has no triangle");
  require_numbers(surface);
  // Around each vertex, who follows whom.
  std::vector<std::vector<std::array<std::int32_t, 2>>> next(fans_.size());
  for (const auto& t : surface.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      next[static_cast<std::size_t>(t[k])].push_back({t[(k + 1) % 3], t[(k + 2) % 3]});
  for (std::size_t v = 0; v < next.size(); ++v) {
    auto& pairs = next[v];
    const std::string here = name_of(static_cast<std::int32_t>(v));
    if (pairs.empty()) throw InvalidArgument("no triangle of the triangulation has vertex " + here);
    std::sort(pairs.begin(), pairs.end());
    for (std::size_t i = 0; i + 1 < pairs.size(); ++i)
      if (pairs[i][0] == pairs[i + 1][0])
        throw InvalidArgument(
            "the edge of vertices " + here + " and " + name_of(pairs[i][0]) +
            " has several triangles on one side: they are turned differently, or more than two share it");
    auto& fan = fans_[v];
    for (std::int32_t at = pairs[0][0]; fan.empty() || at != pairs[0][0];) {
      fan.push_back(at);
      const auto found = std::lower_bound(pairs.begin(), pairs.end(), std::array<std::int32_t, 2>{at, 0});
      if (found == pairs.end() || (*found)[0] != at || fan.size() > pairs.size())
        throw InvalidArgument("the triangulation has a border at the edge of vertices " + here + " and " + name_of(at) +
                              "; an atlas needs a closed surface");
      at = (*found)[1];
    }
    if (fan.size() != pairs.size()) throw InvalidArgument("the triangulation touches itself at vertex " + here);
  }
}

std::int32_t Fans::left_of(std::int32_t a, std::int32_t b) const {
  const auto& fan = around(a);
  const auto found = std::find(fan.begin(), fan.end(), b);
  return found + 1 == fan.end() ? fan.front() : *(found + 1);
}

Triangulation subdivided(const Triangulation& surface) {
  Triangulation fine{surface.vertices, {}};
  std::map<std::array<std::int32_t, 2>, std::int32_t> middles;
  const auto middle = [&](std::int32_t a, std::int32_t b) {
    const auto [at, is_new] =
        middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<std::int32_t>(fine.vertices.size()));
    if (is_new)
      fine.vertices.push_back(
          (surface.vertices[static_cast<std::size_t>(a)] + surface.vertices[static_cast<std::size_t>(b)]) / 2);
    return at->second;
  };
  for (const auto& t : surface.triangles) {
    const std::int32_t ab = middle(t[0], t[1]), bc = middle(t[1], t[2]), ca = middle(t[2], t[0]);
    fine.triangles.push_back({t[0], ab, ca}), fine.triangles.push_back({ab, t[1], bc});
    fine.triangles.push_back({ca, bc, t[2]}), fine.triangles.push_back({ab, bc, ca});
  }
  return fine;
}

}  // namespace carreau::atlas
