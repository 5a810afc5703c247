// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/mesh_summary.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/json_output.h"
#include "check/delivered_json.h"
#include "check/part_crossings.h"
#include "check/quality_json.h"
#include "files/session_handle.h"
#include "mesh/adaptation.h"
#include "mesh/curve_edges.h"

namespace command {
namespace {

std::int32_t threads_of(carreau_session* session) {
  std::int32_t threads = 1;
  require(session, carreau_get_integer(session, "threads", &threads));
  return threads;
}

template <typename... Values>
std::string text(const char* format, Values... values) {
  char line[240];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

long long whole(std::int64_t n) { return static_cast<long long>(n); }

std::int64_t count(const std::vector<FaceResult>& faces, std::int32_t status) {
  return std::count_if(faces.begin(), faces.end(), [&](const FaceResult& f) { return f.status == status; });
}

std::vector<carreau_interface> interfaces_of(carreau_session* session) {
  std::int64_t n = 0;
  require(session, carreau_session_interface_count(session, &n));
  std::vector<carreau_interface> interfaces(static_cast<std::size_t>(n));
  for (std::int64_t i = 0; i < n; ++i) {
    carreau_interface& each = interfaces[static_cast<std::size_t>(i)];
    each.struct_size = sizeof each;
    require(session, carreau_session_interface(session, i, &each));
  }
  return interfaces;
}

bool is_open(const carreau_interface& i) { return i.boundary != 0 && i.uses == 1 && i.degenerate == 0; }

/// Glued and open curves of faces that are not sewn.
struct Gluing {
  std::int64_t glued = 0, open = 0;
  double widest = 0;
  std::string list;  ///< of open curves: "14 (face 3), 39 (face 10), ..."
};
Gluing gluing_of(const CadInput& input, const std::vector<carreau_interface>& interfaces) {
  constexpr int listed = 10;
  Gluing gluing;
  for (const carreau_interface& each : interfaces) {
    if (each.glued != 0) ++gluing.glued, gluing.widest = std::max(gluing.widest, each.gap);
    if (!is_open(each) || ++gluing.open > listed) continue;
    gluing.list += (gluing.list.empty() ? "" : ", ") + std::to_string(input.whole_curve(each.curve)) + " (face " +
                   std::to_string(input.whole_face(each.face)) + ")";
  }
  if (gluing.open > listed) gluing.list += ", ...";
  return gluing;
}

/// Counts glued curves, and lists open ones.
std::vector<std::string> gluing_lines(const CadInput& input, const std::vector<carreau_interface>& interfaces) {
  const Gluing gluing = gluing_of(input, interfaces);
  if (gluing.glued == 0) return {};
  std::vector<std::string> lines{text("glued      %lld curves, within %.6g", whole(gluing.glued), gluing.widest)};
  if (gluing.open > 0) lines.push_back("open       curves " + gluing.list);
  return lines;
}

/// Counts the faces at the curves; the library's own messages report the widest gap.
std::string interfaces_line(const std::vector<carreau_interface>& interfaces) {
  std::int64_t shared = 0, seams = 0, open = 0, more = 0, points = 0, loose = 0;
  for (const carreau_interface& each : interfaces) {
    if (each.loose != 0)
      ++loose;
    else if (each.degenerate != 0)
      ++points;
    else if (is_open(each))
      ++open;
    else if (each.uses == 2)
      ++(each.face == each.other_face ? seams : shared);
    else if (each.uses > 2)
      ++more;
  }
  std::string line = text("interfaces %lld curves of two faces, %lld %s, %lld open", whole(shared), whole(seams),
                          seams == 1 ? "seam" : "seams", whole(open));
  if (more > 0) line += text(", %lld of more than two faces", whole(more));
  if (loose > 0) line += text(", %lld of no face", whole(loose));
  if (points > 0) line += text(", %lld shrunk to a point", whole(points));
  return line;
}

/// "3, 5, ...": at most `most` of them.
std::string list_of(const std::vector<std::int32_t>& refs, std::size_t most) {
  std::string list;
  for (std::size_t i = 0; i < refs.size() && i < most; ++i) list += (i > 0 ? ", " : "") + std::to_string(refs[i]);
  return list + (refs.size() > most ? ", ..." : "");
}

/// Edges that narrow zones and short curves made shorter than the smallest size; "": none.
std::string short_edges_line(const ShortEdges& edges) {
  constexpr std::size_t listed = 15;
  if (edges.count == 0) return "";
  return text("short      %lld %s, down to %.6g, below the smallest size of %.6g: narrow zones and short curves of %s ",
              whole(edges.count), edges.count == 1 ? "edge" : "edges", edges.shortest, edges.bound,
              edges.faces.size() == 1 ? "face" : "faces") +
         list_of(edges.faces, listed);
}

/// A line for each face that failed; faces that are repaired or collapsed for one reason share a line.
std::vector<std::string> face_lines(const std::vector<FaceResult>& faces) {
  constexpr int listed = 50;           // lines
  constexpr std::size_t numbers = 15;  // faces in one
  std::vector<std::string> lines;
  std::map<std::string, std::vector<std::int32_t>> alike;
  int failed = 0;
  for (const FaceResult& face : faces) {
    const std::string what = (face.status == CARREAU_FACE_MENDED ? "repaired" : status_word(face.status)) + reason_of(face);
    if (face.status == CARREAU_FACE_MENDED || face.status == CARREAU_FACE_COLLAPSED)
      alike[what].push_back(face.ref);
    else if (face.status != CARREAU_FACE_MESHED && ++failed <= listed)
      lines.push_back("  face " + std::to_string(face.ref) + (face.name.empty() ? " " : " (" + face.name + ") ") +
                      what);
  }
  if (failed > listed) lines.push_back("  and " + std::to_string(failed - listed) + " more, which --json lists");
  for (const auto& [what, refs] : alike) {
    lines.push_back((refs.size() == 1 ? "  face " : "  faces ") + list_of(refs, numbers) + " " + what);
  }
  return lines;
}

nlohmann::ordered_json interfaces_json(const CadInput& input, const std::vector<carreau_interface>& interfaces) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const carreau_interface& each : interfaces)
    list.push_back({{"reference", input.whole_curve(each.curve)},
                    {"uses", each.uses},
                    {"faces", {input.whole_face(each.face), input.whole_face(each.other_face)}},
                    {"curves", {each.ic, each.other_ic}},
                    {"open", is_open(each)},
                    {"glued", each.glued != 0},
                    {"degenerate", each.degenerate != 0},
                    {"loose", each.loose != 0},
                    {"gap", each.gap}});
  return list;
}

std::string name_of(const CadInput::Part& part) { return part.name.empty() ? "solid " + std::to_string(part.number) : part.name; }

/// Solids that touch without a common face.
std::string contacts_line(const MeshRun& run) {
  const std::vector<CadInput::Contact> contacts = run.input.contacts();
  if (contacts.empty()) return "";
  double area = 0;
  for (const CadInput::Contact& each : contacts) area += each.area;
  const auto largest = std::max_element(contacts.begin(), contacts.end(), [](const auto& p, const auto& q) { return p.area < q.area; });
  return text("touching   %lld %s of solids, common area %.6g", whole(static_cast<std::int64_t>(contacts.size())), contacts.size() == 1 ? "pair" : "pairs", area) +
         (contacts.size() > 1 ? ", largest " + text("%.6g", largest->area) : "") + " (" + name_of(largest->parts[0]) + " and " +
         name_of(largest->parts[1]) + "); --imprint gives them common faces";
}

nlohmann::ordered_json contacts_json(const CadInput& input) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const CadInput::Contact& each : input.contacts())
    list.push_back({{"solids", {each.parts[0].number, each.parts[1].number}},
                    {"names", {each.parts[0].name, each.parts[1].name}},
                    {"area", each.area},
                    {"face_pairs", each.faces}});
  return list;
}

/// Parameters that are implied.
std::string gradation_line(const MeshRun& run) {
  if (!(run.options.anisotropy > 0) || run.options.gradation) return "";
  double ratio = 0;
  require(run.session, carreau_get_real(run.session, "gradation", &ratio));
  return ratio > 0 ? text("sizes      by direction, growing by %.6g at most (--gradation 0: by any ratio)", ratio) : "";
}

}  // namespace

carreau_report report_of(carreau_session* session) {
  carreau_report r{};
  r.struct_size = sizeof r;
  require(session, carreau_session_report(session, &r));
  return r;
}

std::string failed_faces(const std::vector<FaceResult>& faces) {
  constexpr int listed = 20;
  const std::int64_t failed = count(faces, CARREAU_FACE_FAILED);
  if (failed == 0) return "";
  std::string list;
  int told = 0;
  for (const FaceResult& face : faces)
    if (face.status == CARREAU_FACE_FAILED && told++ < listed)
      list += (list.empty() ? "" : ", ") + std::to_string(face.ref);
  return std::to_string(failed) + " of " + std::to_string(faces.size()) + " faces have no mesh: " + list +
         (failed > listed ? ", ..." : "");
}

std::string lost_entities(const CadInput& input) {
  constexpr std::size_t listed = 20;
  const std::vector<std::string> losses = input.losses();
  if (losses.empty()) return "";
  std::string list;
  for (std::size_t i = 0; i < losses.size() && i < listed; ++i)
    list += (i == 0 ? "" : ", ") + losses[i].substr(0, losses[i].find(": "));
  return std::to_string(losses.size()) + (losses.size() == 1 ? " entity" : " entities") +
         " of the file could not be read: " + list + (losses.size() > listed ? ", ..." : "");
}

std::string unexpectedly_open(const MeshRun& run) {
  const std::int64_t edges = run.quality.open_edges;
  if (edges == 0 || count(run.faces, CARREAU_FACE_FAILED) > 0) return "";
  const Gluing gluing = gluing_of(run.input, interfaces_of(run.session));
  if (!run.input.closed() && gluing.glued == 0) return "";
  const std::string why = run.input.closed() ? "The faces of the file close, the mesh does not: "
                                             : "The faces of the file were glued, and the mesh stays open: ";
  return why + std::to_string(edges) + (edges == 1 ? " free edge" : " free edges") +
         (gluing.open > 0 ? ", on curves " + gluing.list : "") + ".";
}

namespace {

/// Returns the lines about faces and edges.
std::vector<std::string> first_lines(const MeshRun& run) {
  const carreau_quality& q = run.quality;
  const auto of = [&](std::int32_t status) { return whole(count(run.faces, status)); };
  std::vector<std::string> lines{text("faces      %lld meshed, %lld repaired, %lld failed", of(CARREAU_FACE_MESHED),
                                      of(CARREAU_FACE_MENDED), of(CARREAU_FACE_FAILED))};
  if (const std::int64_t n = count(run.faces, CARREAU_FACE_COLLAPSED); n > 0)
    lines.front() += text(", %lld collapsed", whole(n));
  for (std::string& line : face_lines(run.faces)) lines.push_back(std::move(line));
  lines.push_back(text("edges      %.6g to %.6g, mean %.6g; %s", q.edge_min, q.edge_max, q.edge_mean,
                       q.open_edges == 0 ? "closed" : text("%lld open", whole(q.open_edges)).c_str()));
  return lines;
}

carreau_part_counts counts_of(carreau_mesh* part) {
  carreau_part_counts counts{};
  counts.struct_size = sizeof counts;
  require(part, carreau_mesh_part_count(part, &counts));
  return counts;
}

nlohmann::ordered_json faces_json(const MeshRun& run) {
  nlohmann::ordered_json faces = nlohmann::ordered_json::array();
  for (const FaceResult& face : run.faces)
    faces.push_back({{"reference", face.ref},
                     {"name", face.name},
                     {"status", status_word(face.status)},
                     {"triangles", face.triangles},
                     {"why", face.why}});
  return faces;
}

bool is_measured(const MeshRun& run) {
  std::int32_t measured = 0;
  require(run.session, carreau_get_integer(run.session, "measure", &measured));
  return measured != 0;
}

}  // namespace

std::string free_edges_of_parts(const MeshRun& run) {
  const std::int64_t edges = run.quality.open_edges;
  if (edges == 0 || count(run.faces, CARREAU_FACE_FAILED) > 0 || !run.input.closed()) return "";
  return "The faces of the file close, the mesh does not: " + std::to_string(edges) + (edges == 1 ? " free edge." : " free edges.");
}

std::string crossings_of_parts(const MeshRun& run) {
  const std::int64_t pairs = counts_of(run.mesh).crossings;
  if (pairs <= 0) return "";
  return crossings_count(pairs) + ", and smaller ones do, too: faces cross in the geometry itself, or lie at one place";
}

std::vector<std::string> crossing_lines_of_parts(const MeshRun& run) {
  const std::int64_t pairs = counts_of(run.mesh).crossings;
  if (pairs <= 0) return {};
  return {crossings_count(pairs) + ": faces touch or overlap",
          "  No process has the whole mesh, so that the faces are not known: carreau check names them in the file.",
          "  A mesh of volumes needs them apart or with common faces."};
}

std::vector<std::string> part_lines(const MeshRun& run, int processes) {
  std::vector<std::string> lines = first_lines(run);
  const carreau_part_counts counts = counts_of(run.mesh);
  lines.push_back(text("parts      %d %s; the first has %lld of %lld triangles", processes, processes == 1 ? "process" : "processes", whole(counts.own_triangles),
                       whole(counts.all_triangles)));
  const std::int32_t threads = threads_of(run.session);
  lines.push_back(text("seconds    reading %.3f, writing %.3f (%d %s for each process)", run.seconds_reading, run.seconds_writing,
                       static_cast<int>(threads), threads == 1 ? "thread" : "threads"));
  for (const std::string& path : run.options.outputs) lines.push_back("written    " + path);
  return lines;
}

std::vector<std::string> summary_lines(const MeshRun& run) {
  const carreau_report r = report_of(run.session);
  const std::vector<carreau_interface> interfaces = interfaces_of(run.session);
  std::vector<std::string> lines = first_lines(run);
  for (std::string& line : y_plus_lines(run.session, run.options)) lines.push_back(std::move(line));
  if (std::string line = short_edges_line(run.short_edges); !line.empty()) lines.push_back(std::move(line));
  lines.push_back(interfaces_line(interfaces));
  for (std::string& line : gluing_lines(run.input, interfaces)) lines.push_back(std::move(line));
  if (std::string line = gradation_line(run); !line.empty()) lines.push_back(std::move(line));
  if (const std::string gaps = run.input.gaps(); !gaps.empty()) lines.push_back("gaps       " + gaps);
  if (std::string line = contacts_line(run); !line.empty()) lines.push_back(std::move(line));
  if (std::string line = run.adaptation != nullptr ? run.adaptation->line(run.session) : ""; !line.empty()) lines.push_back(std::move(line));
  const std::int32_t threads = threads_of(run.session);
  lines.push_back(text("seconds    reading %.3f, meshing %.3f (%d %s), writing %.3f", run.seconds_reading,
                       r.seconds_total, static_cast<int>(threads), threads == 1 ? "thread" : "threads",
                       run.seconds_writing));
  for (const std::string& path : run.dumped) lines.push_back("dumped     " + path);
  for (const std::string& path : run.options.outputs) lines.push_back("written    " + path);
  return lines;
}

nlohmann::ordered_json part_json(const MeshRun& run, int processes) {
  const carreau_part_counts counts = counts_of(run.mesh);
  nlohmann::ordered_json summary = {{"input", run.options.input},
                                    {"more_inputs", run.options.more_inputs},
                                    {"outputs", run.options.outputs},
                                    {"diagonal", run.input.diagonal()},
                                    {"closed", run.quality.open_edges == 0},
                                    {"threads", threads_of(run.session)},
                                    {"processes", processes},
                                    {"mesh", quality_json(run.quality)},
                                    {"faces", faces_json(run)},
                                    {"intersections", {{"pairs", counts.crossings}}},
                                    {"not_read", run.input.losses()},
                                    {"warnings", run.warnings},
                                    {"seconds", {{"reading", run.seconds_reading}, {"writing", run.seconds_writing}, {"processor", run.seconds_processor}}}};
  if (!run.options.layers.empty()) summary["layers"] = layers_json(run.session, run.options, run.input.diagonal());
  if (is_measured(run)) summary["delivered"] = delivered_json(run.session);
  return summary;
}

nlohmann::ordered_json summary_json(const MeshRun& run, bool delivered) {
  const carreau_report r = report_of(run.session);
  const carreau_quality& q = run.quality;
  const ShortEdges& short_edges = run.short_edges;
  nlohmann::ordered_json summary = {{"input", run.options.input},
                                    {"more_inputs", run.options.more_inputs},
                                    {"outputs", run.options.outputs},
                                    {"dumped", run.dumped},
                                    {"diagonal", run.input.diagonal()},
                                    {"closed", q.open_edges == 0},
                                    {"threads", threads_of(run.session)},
                                    {"mesh", quality_json(q)},
                                    {"below_minimum",
                                     {{"minimum", short_edges.bound},
                                      {"edges", short_edges.count},
                                      {"shortest", short_edges.shortest},
                                      {"faces", short_edges.faces}}},
                                    {"faces", faces_json(run)},
                                    {"intersections", crossings_json(run.crossings)},
                                    {"crossing_parts", part_crossings_json(run.crossings, run.input)},
                                    {"contacts", contacts_json(run.input)},
                                    {"not_read", run.input.losses()},
                                    {"warnings", run.warnings},
                                    {"interfaces", interfaces_json(run.input, interfaces_of(run.session))},
                                    {"calls",
                                     {{"surf0", r.surf0_calls},
                                      {"surf1", r.surf1_calls},
                                      {"surf2", r.surf2_calls},
                                      {"curv0", r.curv0_calls},
                                      {"curv1", r.curv1_calls},
                                      {"curv2", r.curv2_calls},
                                      {"sizes", r.size_calls}}},
                                    {"seconds",
                                     {{"reading", run.seconds_reading},
                                      {"curves", r.seconds_curves},
                                      {"sampling", r.seconds_sampling},
                                      {"plane", r.seconds_plane},
                                      {"lift", r.seconds_lift},
                                      {"total", r.seconds_total},
                                      {"writing", run.seconds_writing},
                                      {"processor", run.seconds_processor}}}};
  if (nlohmann::ordered_json loop = run.adaptation != nullptr ? run.adaptation->json(run.session) : nullptr; !loop.is_null())
    summary["adaptation"] = std::move(loop);
  if (!run.options.layers.empty()) summary["layers"] = layers_json(run.session, run.options, run.input.diagonal());
  if (delivered) summary["delivered"] = delivered_json(run.session);
  return summary;
}

void print_json(const MeshRun& run) { print_json("mesh", summary_json(run, is_measured(run))); }

}  // namespace command
