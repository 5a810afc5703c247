// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/groups.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <utility>

#include "base/failure.h"
#include "base/lengths.h"
#include "files/session_handle.h"
#include "mesh/selection.h"

namespace command {
namespace {

/// The name of the group of an entity, by dimension and reference.
using Groups = std::map<std::pair<int, std::int32_t>, std::string>;

std::string colour_name(std::int32_t rgb) {
  char text[16];
  std::snprintf(text, sizeof text, "color_%06x", static_cast<unsigned>(rgb));
  return text;
}

/// "bolt" of "bolt_2": the name of a solid before it was made distinct.
std::string without_number(const std::string& name) {
  const std::size_t end = name.find_last_not_of("0123456789");
  return end != std::string::npos && end + 1 < name.size() && name[end] == '_' ? name.substr(0, end) : name;
}

void group_faces(const CadInput& input, const std::string& by, Groups& groups) {
  for (const std::int32_t face : input.face_numbers()) {
    const std::string part = input.parts_beside(face)[0].name;
    if (by == "part" && !part.empty()) groups[{2, face}] = part;
    if (by == "layer" && !input.face_layer(face).empty()) groups[{2, face}] = input.face_layer(face);
    if (by == "color" && input.face_colour(face) >= 0) groups[{2, face}] = colour_name(input.face_colour(face));
    // An unnamed face has the name of a part.
    if (by == "face" && input.face_name(face) == without_number(part)) groups[{2, face}] = "";
  }
}

}  // namespace

std::vector<std::string> set_groups(carreau_session* session, const CadInput& input, const std::string& group_by,
                                    const std::vector<std::string>& rules) {
  Groups groups, by_rules, around_solids;
  group_faces(input, group_by, groups);
  std::vector<std::string> sentences;
  for (const std::string& rule : rules) {
    const auto [name, selector] = parse_assignment(rule, "--group");
    const Selection selection = select(input, selector, "--group");
    int twice = 0;
    for (const std::int32_t ref : selection.refs) {
      std::string& group = by_rules[{selection.dimension, ref}];
      twice += group.empty() || group == name ? 0 : 1;
      group = name;
    }
    if (twice > 0)
      sentences.push_back("--group " + rule + ": " + std::to_string(twice) + (twice == 1 ? " entity was" : " entities were") +
                          " in another group, and an entity has one group");
    if (selection.dimension != 3) continue;
    for (const std::int32_t face : input.face_numbers())
      for (const CadInput::Part& part : input.parts_beside(face))
        if (std::find(selection.refs.begin(), selection.refs.end(), part.number) != selection.refs.end())
          around_solids[{2, face}] = name;
  }
  for (const Groups* more : {&around_solids, &by_rules})
    for (const auto& [entity, name] : *more) groups[entity] = name;
  std::map<std::pair<int, std::string>, std::vector<std::int32_t>> members;
  for (const auto& [entity, name] : groups) members[{entity.first, name}].push_back(entity.second);
  for (const auto& [group, refs] : members)
    require(session, carreau_model_name_entities(session, group.first, static_cast<std::int64_t>(refs.size()), refs.data(), group.second.c_str()));
  return sentences;
}

}  // namespace command
