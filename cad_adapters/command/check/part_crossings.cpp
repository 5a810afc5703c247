// SPDX-License-Identifier: BSD-3-Clause
#include "check/part_crossings.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

namespace command {
namespace {

std::string name_of(const CadInput::Part& part) {
  return std::to_string(part.number) + (part.name.empty() ? "" : " (" + part.name + ")");
}

/// "solids 1 (bolt) and 2 (plate)", "within solid 1", "faces 3 and 5".
std::string names_of(const PartCrossing& crossing, const CadInput& input) {
  const auto& [a, b] = crossing.parts;
  const std::string word = crossing.are_faces ? "face" : input.part_word();
  if (a.number == b.number) return "within " + word + " " + name_of(a);
  return word + "s " + name_of(a) + " and " + name_of(b);
}

std::string counted(std::int64_t n, const std::string& one) { return std::to_string(n) + " " + one + (n == 1 ? "" : "s"); }

}  // namespace

std::vector<PartCrossing> part_crossings_of(const Crossings& crossings, const CadInput& input) {
  using Key = std::array<std::int32_t, 3>;
  std::map<Key, PartCrossing> by_parts;
  std::map<std::int32_t, CadInput::Part> known;
  const auto part_of = [&](std::int32_t face) -> const CadInput::Part& {
    const auto [at, is_new] = known.try_emplace(face);
    if (is_new) at->second = input.part_of_face(face);
    return at->second;
  };
  for (const FaceCrossing& each : crossings.faces) {
    std::array<CadInput::Part, 2> parts{part_of(each.faces[0]), part_of(each.faces[1])};
    const bool are_faces = parts[0].number == 0 || parts[1].number == 0;
    if (are_faces)
      for (std::size_t k = 0; k < 2; ++k) parts[k] = {each.faces[k], input.face_name(each.faces[k])};
    if (parts[0].number > parts[1].number) std::swap(parts[0], parts[1]);
    PartCrossing& crossing = by_parts[{are_faces ? 1 : 0, parts[0].number, parts[1].number}];
    if (crossing.pairs == 0) crossing.parts = parts, crossing.are_faces = are_faces, crossing.place = each.place;
    crossing.pairs += each.pairs;
  }
  std::vector<PartCrossing> list;
  for (const auto& [key, crossing] : by_parts) list.push_back(crossing);
  std::stable_sort(list.begin(), list.end(), [](const PartCrossing& p, const PartCrossing& q) { return p.pairs > q.pairs; });
  return list;
}

std::vector<std::string> crossing_lines(const Crossings& crossings, const CadInput& input) {
  constexpr std::size_t listed = 10;
  const std::vector<PartCrossing> parts = part_crossings_of(crossings, input);
  if (parts.empty()) return {};
  const bool any_faces = std::any_of(parts.begin(), parts.end(), [](const PartCrossing& p) { return p.are_faces; });
  const std::string word = any_faces ? "face" : input.part_word();
  const auto apart = std::count_if(parts.begin(), parts.end(),
                                   [](const PartCrossing& p) { return p.parts[0].number != p.parts[1].number; });
  std::string kinds;
  if (apart > 0) kinds = counted(apart, "pair") + " of " + word + "s" + (apart == 1 ? " touches or overlaps" : " touch or overlap");
  if (const auto within = static_cast<std::int64_t>(parts.size()) - apart; within > 0)
    kinds += (kinds.empty() ? "" : "; ") + counted(within, word) + (within == 1 ? " crosses itself" : " cross themselves");
  std::vector<std::string> lines{counted(crossings.triangles, "triangle") + (crossings.triangles == 1 ? " crosses" : " cross") +
                                 " others, in " + counted(crossings.pairs, "pair") + ": " + kinds};
  for (std::size_t k = 0; k < parts.size() && k < listed; ++k) {
    const Point& p = parts[k].place;
    char place[120];
    std::snprintf(place, sizeof place, " of triangles, the first at (%.6g, %.6g, %.6g)", p[0], p[1], p[2]);
    lines.push_back("  " + names_of(parts[k], input) + ": " + counted(parts[k].pairs, "pair") + place);
  }
  if (parts.size() > listed) lines.push_back("  and " + std::to_string(parts.size() - listed) + " more");
  lines.push_back("  A mesh of volumes needs them apart or with common faces: unite or imprint them in the CAD program, or mesh each one alone.");
  return lines;
}

nlohmann::ordered_json part_crossings_json(const Crossings& crossings, const CadInput& input) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const PartCrossing& each : part_crossings_of(crossings, input))
    list.push_back({{"kind", each.are_faces ? "face" : input.part_word()},
                    {"numbers", {each.parts[0].number, each.parts[1].number}},
                    {"names", {each.parts[0].name, each.parts[1].name}},
                    {"pairs", each.pairs},
                    {"at", each.place}});
  return {{"triangles", crossings.triangles}, {"pairs", crossings.pairs}, {"parts", list}};
}

}  // namespace command
