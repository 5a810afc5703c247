// SPDX-License-Identifier: BSD-3-Clause
// Potential meshing problems of a file, and figures of its faces.
#include <cstdio>
#include <map>

#include "handle.h"

using namespace carreau_occ;
using namespace carreau_occ::abi;

namespace {

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

bool is_cut(const Danger& danger, const BrepHost& host) {
  const std::vector<int>& bent = host.bent_faces();
  return danger.kind == "kink" && std::find(bent.begin(), bent.end(), danger.face) == bent.end();
}

std::string sentence(const Danger& danger, const BrepHost& host) {
  if (danger.solids[0] > 0 || danger.kind == "untested solids") return danger.text;
  std::string text;
  if (danger.edge > 0) text += "edge " + std::to_string(danger.edge);
  if (danger.face > 0) {
    text += (text.empty() ? "face " : ", face ") + std::to_string(danger.face);
    const std::string& name = host.face_name(danger.face);
    if (!name.empty()) text += " (" + name + ")";
  }
  text += ": " + (danger.value > 0 ? number(danger.value) + " " : "") + danger.text;
  if (danger.kind != "kink") return text;
  return text + (is_cut(danger, host) ? ", where it is cut: edges of meshes follow it"
                                      : "; it cannot be cut there, and sizes by an angle or a chord do not see it");
}

/// Solids that touch or overlap become dangers.
void add_contacts(carreau_cad_file& file, ShapeReport& report) {
  if (report.solids < 2) return;
  const Solids& solids = solids_in(file);
  const auto name = [&](int s) {
    const std::string& known = solids.names[static_cast<std::size_t>(s - 1)];
    return std::to_string(s) + (known.empty() ? "" : " (" + known + ")");
  };
  SolidContacts found = find_contacts(file.shape);
  std::map<std::array<int, 2>, double> areas;
  for (const FaceContact& contact : contacts_of(file)) {
    areas[contact.solids] = contact.area;
    if (std::none_of(found.contacts.begin(), found.contacts.end(), [&](const SolidContact& known) { return known.solids == contact.solids; }))
      found.contacts.push_back({.solids = contact.solids, .place = contact.place});
  }
  std::stable_sort(found.contacts.begin(), found.contacts.end(), [](const SolidContact& p, const SolidContact& q) { return p.solids < q.solids; });
  for (const SolidContact& contact : found.contacts) {
    const auto& [a, b] = contact.solids;
    const auto& p = contact.place;
    const double area = areas.contains(contact.solids) ? areas[contact.solids] : 0;
    report.dangers.push_back({.kind = contact.overlap ? "overlapping solids" : "touching solids",
                              .value = area,
                              .text = "solids " + name(a) + " and " + name(b) + (contact.overlap ? " overlap" : " touch") +
                                      " at (" + number(p[0]) + ", " + number(p[1]) + ", " + number(p[2]) + ")" +
                                      (area > 0 ? ", common area " + number(area) : ""),
                              .solids = contact.solids});
  }
  if (found.untested > 0)
    report.dangers.push_back({.kind = "untested solids",
                              .text = std::to_string(found.untested) + " more pairs of solids have boxes that meet, and were not tested",
                              .solids = {}});
  std::stable_sort(report.dangers.begin(), report.dangers.end(),
                   [](const Danger& p, const Danger& q) { return p.kind < q.kind; });
}

const ShapeReport& report_of(const carreau_cad_file& file) {
  host_of(file);
  if (!file.report) throw Failure(CARREAU_ERR_SEQUENCE, "there is no report: call carreau_cad_inspect first");
  return *file.report;
}

carreau_cad_report counts_of(const ShapeReport& r) {
  carreau_cad_report counts{};
  counts.solids = r.solids, counts.shells = r.shells, counts.faces = r.faces;
  counts.edges = r.edges, counts.vertices = r.vertices;
  counts.seams = r.seams, counts.poles = r.poles, counts.closed_edges = r.closed_edges;
  counts.inner_wires = r.inner_wires, counts.internal_edges = r.internal_edges;
  counts.diagonal = r.diagonal, counts.area = r.area, counts.volume = r.volume;
  counts.shortest_edge = r.shortest_edge, counts.largest_tolerance = r.largest_tolerance;
  counts.largest_gap = r.largest_gap;
  counts.kinds = static_cast<int32_t>(r.surfaces.size()), counts.dangers = static_cast<int32_t>(r.dangers.size());
  return counts;
}

}  // namespace

carreau_status carreau_cad_measure_face(carreau_cad_file* file, int32_t face_number, carreau_cad_figures* out_figures) {
  return guarded_call(file, [&] {
    check_face(host_of(*file), face_number);
    if (!file->figures) file->figures = list_faces(file->shape);
    const FaceFigures& face = (*file->figures)[static_cast<std::size_t>(face_number - 1)];
    carreau_cad_figures figures{};
    figures.kind = face.kind.c_str();
    figures.area = face.area, figures.perimeter = face.perimeter;
    std::copy(face.low.begin(), face.low.end(), figures.low);
    std::copy(face.high.begin(), face.high.end(), figures.high);
    write_struct(figures, out_figures, "out_figures");
  });
}

carreau_status carreau_cad_inspect(carreau_cad_file* file, double tiny, carreau_cad_report* out_report) {
  return guarded_call(file, [&] {
    const BrepHost& host = host_of(*file);
    if (!(tiny >= 0)) throw Failure(CARREAU_ERR_ARGUMENT, "tiny must not be negative");
    if (out_report != nullptr) write_struct(carreau_cad_report{}, out_report, "out_report");  // reports a wrong size first
    constexpr double usual = 1e-3;
    ShapeReport report = inspect(file->shape, tiny > 0 ? tiny : usual);
    add_contacts(*file, report);
    std::vector<std::string> sentences;
    for (const Danger& danger : report.dangers) sentences.push_back(sentence(danger, host));
    file->report = std::move(report), file->sentences = std::move(sentences);
    if (out_report != nullptr) write_struct(counts_of(*file->report), out_report, "out_report");
  });
}

carreau_status carreau_cad_surfaces(carreau_cad_file* file, int64_t index, const char** out_kind, int32_t* out_count) {
  return guarded_call(file, [&] {
    const auto& [kind, count] = at(report_of(*file).surfaces, index, "kind of surfaces");
    *required(out_kind, "out_kind") = kind.c_str();
    *required(out_count, "out_count") = count;
  });
}

carreau_status carreau_cad_danger_at(carreau_cad_file* file, int64_t index, carreau_cad_danger* out_danger) {
  return guarded_call(file, [&] {
    const Danger& found = at(report_of(*file).dangers, index, "danger");
    carreau_cad_danger danger{};
    danger.kind = found.kind.c_str();
    danger.face = found.face, danger.edge = found.edge, danger.value = found.value;
    danger.cut = is_cut(found, *file->host) ? 1 : 0;
    danger.sentence = file->sentences[static_cast<std::size_t>(index)].c_str();
    std::copy(found.solids.begin(), found.solids.end(), danger.solids);
    write_struct(danger, out_danger, "out_danger");
  });
}

carreau_status carreau_cad_measure_gaps(carreau_cad_file* file, carreau_cad_gaps* out_gaps) {
  return guarded_call(file, [&] {
    host_of(*file);
    const Gaps found = measure_gaps(file->shape);
    carreau_cad_gaps gaps{};
    gaps.largest = found.largest, gaps.edge = found.edge, gaps.face = found.face, gaps.beyond = found.beyond;
    write_struct(gaps, out_gaps, "out_gaps");
  });
}
