// SPDX-License-Identifier: BSD-3-Clause
#include "check/crossings.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "files/mesh_file.h"

namespace command {
namespace {

constexpr std::int64_t max_pairs = 1'000'000;

std::string sentence(const FaceCrossing& crossing) {
  char text[240];
  const auto& [f, g] = crossing.faces;
  if (f == g)
    std::snprintf(text, sizeof text, "face %d", static_cast<int>(f));
  else
    std::snprintf(text, sizeof text, "faces %d and %d", static_cast<int>(f), static_cast<int>(g));
  const std::string faces = text;
  const Point& p = crossing.place;
  std::snprintf(text, sizeof text, ": %lld %s of triangles cross%s, first triangles %d and %d at (%.6g, %.6g, %.6g)",
                static_cast<long long>(crossing.pairs), crossing.pairs == 1 ? "pair" : "pairs",
                crossing.pairs == 1 ? "es" : "", static_cast<int>(crossing.triangles[0]) + 1,
                static_cast<int>(crossing.triangles[1]) + 1, p[0], p[1], p[2]);
  return faces + text;
}

}  // namespace

Crossings crossings_of(carreau_mesh* mesh, const std::vector<std::int32_t>& refs, int threads) {
  Crossings crossings;
  constexpr std::int64_t usual = 1000;
  std::vector<std::int32_t> triangles;
  std::vector<double> xyz;
  const auto ask = [&](std::int64_t room) {
    triangles.resize(2 * static_cast<std::size_t>(room)), xyz.resize(3 * static_cast<std::size_t>(room));
    require(mesh, carreau_mesh_intersections(mesh, threads, room, &crossings.pairs, triangles.data(), xyz.data()));
    return std::min(room, crossings.pairs);
  };
  std::int64_t n = ask(usual);
  if (n < crossings.pairs) n = ask(std::min(crossings.pairs, max_pairs));
  std::vector<std::int32_t> crossing(triangles.begin(), triangles.begin() + 2 * static_cast<std::ptrdiff_t>(n));
  std::sort(crossing.begin(), crossing.end());
  crossings.triangles = std::unique(crossing.begin(), crossing.end()) - crossing.begin();
  std::map<std::array<std::int32_t, 2>, FaceCrossing> by_faces;
  for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
    const std::array pair{triangles[2 * i], triangles[2 * i + 1]};
    const auto [low, high] =
        std::minmax(refs[static_cast<std::size_t>(pair[0])], refs[static_cast<std::size_t>(pair[1])]);
    FaceCrossing& of_faces = by_faces[{low, high}];
    if (of_faces.pairs++ > 0) continue;
    of_faces.faces = {low, high}, of_faces.triangles = pair;
    of_faces.place = {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
  }
  for (const auto& [faces, of_faces] : by_faces) crossings.faces.push_back(of_faces);
  std::stable_sort(crossings.faces.begin(), crossings.faces.end(),
                   [](const FaceCrossing& p, const FaceCrossing& q) { return p.pairs > q.pairs; });
  return crossings;
}

Crossings crossings_of(carreau_mesh* mesh, int threads) {
  std::int64_t n = 0;
  require(mesh, carreau_mesh_count(mesh, nullptr, &n, nullptr, nullptr));
  if (n == 0) return {};  // edges alone
  std::vector<std::int32_t> refs(static_cast<std::size_t>(n));
  require(mesh, carreau_mesh_triangle_refs(mesh, n, refs.data()));
  return crossings_of(mesh, refs, threads);
}

std::vector<std::string> sentences_of(const Crossings& crossings, std::size_t most) {
  std::vector<std::string> sentences;
  std::int64_t told = 0;
  for (const FaceCrossing& each : crossings.faces) {
    if (sentences.size() == most) break;
    sentences.push_back(sentence(each));
    told += each.pairs;
  }
  if (const std::int64_t others = crossings.pairs - told; others > 0)
    sentences.push_back("and " + std::to_string(others) + (others == 1 ? " pair" : " pairs") + " of other faces");
  return sentences;
}

std::string crossings_count(std::int64_t pairs) {
  if (pairs <= 0) return "";
  return std::to_string(pairs) + (pairs == 1 ? " pair of triangles crosses" : " pairs of triangles cross");
}

nlohmann::ordered_json crossings_json(const Crossings& crossings) {
  nlohmann::ordered_json faces = nlohmann::ordered_json::array();
  for (const FaceCrossing& each : crossings.faces)
    faces.push_back({{"faces", each.faces}, {"pairs", each.pairs}, {"triangles", each.triangles}, {"at", each.place}});
  return {{"pairs", crossings.pairs}, {"faces", faces}};
}

}  // namespace command
