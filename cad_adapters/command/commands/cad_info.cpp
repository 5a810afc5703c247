// SPDX-License-Identifier: BSD-3-Clause
// `carreau info` on STEP, IGES and BREP files.
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "base/json_output.h"
#include "base/lengths.h"
#include "commands/commands.h"
#include "inputs/cad/cad_file.h"
#include "inputs/cad/cad_library.h"

namespace command {
namespace {

std::string name_of(carreau_cad_file* file, std::int32_t number_of_face) {
  carreau_cad_face face{};
  face.struct_size = sizeof face;
  require(file, cad_library().file_face(file, number_of_face, &face));
  return face.name;
}

/// Kinds and their counts, by name.
std::vector<std::pair<std::string, int>> surfaces_of(carreau_cad_file* file, const carreau_cad_report& report) {
  std::vector<std::pair<std::string, int>> surfaces;
  for (std::int32_t i = 0; i < report.kinds; ++i) {
    const char* kind = "";
    std::int32_t count = 0;
    require(file, cad_library().surfaces(file, i, &kind, &count));
    surfaces.emplace_back(kind, count);
  }
  return surfaces;
}

/// `solid`: the row of the only solid of a part; nullptr: another row.
std::string words_of(const carreau_cad_tree_row& row, const carreau_cad_tree_row* solid) {
  std::string words = row.kind;
  char text[32];
  const auto add = [&](const char* format, auto value) { std::snprintf(text, sizeof text, format, value), words += text; };
  if (row.number > 0) add(" %d", static_cast<int>(row.number));
  if (row.name[0] != '\0') words.append("  ").append(row.name);
  if (solid != nullptr) {
    add(", solid %d", static_cast<int>(solid->number));
    if (std::string(solid->name) != row.name) words.append("  ").append(solid->name);
  }
  if (row.faces > 0) add(row.faces == 1 ? "  %d face" : "  %d faces", static_cast<int>(row.faces));
  if (row.rgb >= 0) add("  #%06x", static_cast<unsigned>(row.rgb));
  if (row.layer[0] != '\0') words.append("  layer ").append(row.layer);
  return words;
}

/// Rows whose holder has more than `limit` rows of their kind are counted.
void print_tree(carreau_cad_file* file, int limit) {
  const std::vector<carreau_cad_tree_row> rows = tree_of(file);
  if (rows.empty()) return;
  std::puts("tree:");
  std::map<std::pair<int, std::string>, int> told;  // since the last row that is less deep
  const auto is_solid = [&](std::size_t k, int depth) { return k < rows.size() && rows[k].depth == depth && rows[k].kind == std::string("solid"); };
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const carreau_cad_tree_row& row = rows[k];
    std::size_t solids = 0;
    for (std::size_t j = k + 1; j < rows.size() && rows[j].depth > row.depth; ++j) solids += is_solid(j, row.depth + 1) ? 1 : 0;
    const bool is_alone = row.kind == std::string("part") && solids == 1 && is_solid(k + 1, row.depth + 1) && rows[k + 1].rgb < 0;
    std::erase_if(told, [&](const auto& each) { return each.first.first > row.depth; });
    int& n = told[{row.depth, row.kind}];
    ++n;
    const bool is_entity = row.kind == std::string("face") || row.kind == std::string("edge") || row.kind == std::string("vertex");
    const std::string indent(2 * static_cast<std::size_t>(row.depth) + 2, ' ');
    if (!is_entity || n <= limit) std::printf("%s%s\n", indent.c_str(), words_of(row, is_alone ? &rows[k + 1] : nullptr).c_str());
    if (is_alone) ++k;
    if (is_entity && n == limit + 1) std::printf("%s...\n", indent.c_str());
  }
}

void print_report(carreau_cad_file* file, const carreau_cad_report& r, int limit) {
  const std::string unit = content_of(file).unit;
  const std::vector<std::string> losses = losses_of(file);
  std::printf("solids      %d\nshells      %d\nfaces       %d\nedges       %d\nvertices    %d\n", r.solids, r.shells,
              r.faces, r.edges, r.vertices);
  const std::string file_unit = content_of(file).file_unit;
  std::printf("unit        %s%s\n", unit.empty() ? "none" : unit.c_str(),
              file_unit.empty() || file_unit == unit ? "" : (" (the file has " + file_unit + ")").c_str());
  if (content_of(file).shared_faces > 0) std::printf("shared faces %d\n", content_of(file).shared_faces);
  std::printf("diagonal    %s\narea        %s\nvolume      %s\n", number_text(r.diagonal).c_str(), number_text(r.area).c_str(),
              number_text(r.volume).c_str());
  std::string kinds;
  for (const auto& [name, n] : surfaces_of(file, r)) kinds += (kinds.empty() ? "" : ", ") + std::to_string(n) + " " + name;
  std::printf("surfaces    %s\n", kinds.c_str());
  std::printf("seams       %d\npoles       %d\nclosed edges %d\ninner wires %d\ninternal    %d\n", r.seams, r.poles,
              r.closed_edges, r.inner_wires, r.internal_edges);
  std::printf("shortest edge %s\nlargest tolerance %s\nlargest gap %s\n", number_text(r.shortest_edge).c_str(),
              number_text(r.largest_tolerance).c_str(), number_text(r.largest_gap).c_str());
  std::map<std::string, int> count;
  const std::vector<carreau_cad_danger> dangers = dangers_of(file, r);
  for (const carreau_cad_danger& danger : dangers) ++count[danger.kind];
  if (!losses.empty()) std::printf("not read: %d\n", static_cast<int>(losses.size()));
  for (std::size_t i = 0; i < losses.size() && i <= static_cast<std::size_t>(limit); ++i)
    std::printf("  %s\n", i == static_cast<std::size_t>(limit) ? "..." : losses[i].c_str());
  for (const std::string& note : notes_of(file)) std::printf("note: %s\n", note.c_str());
  for (const std::string& line : small_features_of(file)) std::printf("%s\n", line.c_str());
  if (count.empty() && losses.empty()) std::puts("no problems found");
  std::map<std::string, int> told;
  for (const carreau_cad_danger& danger : dangers) {
    int& n = told[danger.kind];
    if (n == 0) std::printf("%s: %d\n", danger.kind, count[danger.kind]);
    if (++n <= limit) std::printf("  %s\n", danger.sentence);
    if (n == limit + 1) std::puts("  ...");
  }
  print_tree(file, limit);
}

nlohmann::ordered_json tree_json(carreau_cad_file* file) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const carreau_cad_tree_row& row : tree_of(file))
    list.push_back({{"depth", row.depth}, {"kind", row.kind}, {"number", row.number}, {"name", row.name},
                    {"rgb", row.rgb}, {"layer", row.layer}, {"faces", row.faces}});
  return list;
}

nlohmann::ordered_json contacts_json(carreau_cad_file* file) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const carreau_cad_contact& each : contacts_of(file))
    list.push_back({{"solids", {each.solids[0], each.solids[1]}}, {"faces", {each.faces[0], each.faces[1]}},
                    {"face_pairs", each.pairs}, {"area", each.area}, {"place", each.place}});
  return list;
}

nlohmann::ordered_json json_of(carreau_cad_file* file, const carreau_cad_report& r, const InfoOptions& options) {
  nlohmann::ordered_json surfaces = nlohmann::ordered_json::object(), dangers = nlohmann::ordered_json::array();
  for (const auto& [name, n] : surfaces_of(file, r)) surfaces[name] = n;
  nlohmann::ordered_json contacts = nlohmann::ordered_json::array();
  for (const carreau_cad_danger& d : dangers_of(file, r)) {
    if (d.solids[0] > 0)
      contacts.push_back({{"solids", {d.solids[0], d.solids[1]}}, {"overlap", std::string("overlapping solids") == d.kind}});
    dangers.push_back({{"kind", d.kind},
                       {"face", d.face},
                       {"edge", d.edge},
                       {"name", d.face > 0 ? name_of(file, d.face) : ""},
                       {"value", d.value},
                       {"text", d.sentence}});
  }
  return {{"input", options.input},
          {"solids", r.solids},
          {"shells", r.shells},
          {"faces", r.faces},
          {"edges", r.edges},
          {"vertices", r.vertices},
          {"unit", content_of(file).unit},
          {"file_unit", content_of(file).file_unit},
          {"shared_faces", content_of(file).shared_faces},
          {"diagonal", r.diagonal},
          {"area", r.area},
          {"volume", r.volume},
          {"surfaces", surfaces},
          {"seams", r.seams},
          {"poles", r.poles},
          {"closed_edges", r.closed_edges},
          {"inner_wires", r.inner_wires},
          {"internal_edges", r.internal_edges},
          {"shortest_edge", r.shortest_edge},
          {"largest_tolerance", r.largest_tolerance},
          {"largest_gap", r.largest_gap},
          {"not_read", losses_of(file)},
          {"contacts", contacts},
          {"common_areas", contacts_json(file)},
          {"tree", tree_json(file)},
          {"notes", notes_of(file)},
          {"dangers", dangers}};
}

}  // namespace

int print_cad_info(const InfoOptions& options) {
  CadChoice choice = options.cad;
  choice.loose_edges = true;
  const CadFileHandle file = read_cad(options.input, choice);
  const carreau_cad_report report = inspect(file.get());
  if (options.json) {
    nlohmann::ordered_json value = json_of(file.get(), report, options);
    if (options.faces) value["face_list"] = faces_json(faces_of(file.get()));
    print_json("info", value);
    return 0;
  }
  print_report(file.get(), report, options.limit);
  if (options.faces) print_faces(faces_of(file.get()));
  return 0;
}

}  // namespace command
