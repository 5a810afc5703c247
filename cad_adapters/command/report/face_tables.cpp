// SPDX-License-Identifier: BSD-3-Clause
// The sections with a row a face or an element.
#include <algorithm>
#include <cmath>
#include <map>

#include "report/html_text.h"
#include "report/sections.h"

namespace command {
namespace {

constexpr std::size_t worst_listed = 20;

const TriangleValues* find(const ReportContent& content, const std::string& key) {
  for (const TriangleValues& values : content.values)
    if (values.key == key) return &values;
  return nullptr;
}

/// Elements with the lowest or the highest values.
std::vector<std::size_t> worst_of(const ReportContent& content, const TriangleValues& values, bool highest) {
  std::vector<std::size_t> order;
  for (std::size_t t = 0; t < values.values.size(); ++t)
    if (content.halves[t] != 2 && std::isfinite(values.values[t])) order.push_back(t);
  const auto worse = [&](std::size_t a, std::size_t b) {
    const double x = values.values[a], y = values.values[b];
    return x != y ? (highest ? x > y : x < y) : a < b;
  };
  const std::size_t n = std::min(worst_listed, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(n), order.end(), worse);
  order.resize(n);
  return order;
}

HtmlCell button_cell(const char* attribute, std::size_t index, const std::string& label) {
  const std::string number = std::to_string(index);
  return {"<button type=\"button\" class=\"show\" " + std::string(attribute) + "=\"" + number + "\">" + html(label) +
              "</button>", false, number};
}

std::map<std::int32_t, const FaceResult*> results_of(const MeshArrays& mesh) {
  std::map<std::int32_t, const FaceResult*> results;
  for (const FaceResult& face : mesh.faces) results.emplace(face.ref, &face);
  return results;
}

std::string worst_table(const ReportContent& content, const TriangleValues& values, bool highest) {
  HtmlTable table{.id = "worst-" + values.key,
                  .caption = (highest ? "Largest: " : "Lowest: ") + values.title +
                             (values.unit.empty() ? "" : ", " + values.unit),
                  .columns = {"Triangle", "Value", "Face", "Name"}};
  const auto results = results_of(content.mesh);
  for (const std::size_t t : worst_of(content, values, highest)) {
    const std::int32_t ref = content.mesh.triangle_refs[t];
    const auto face = results.find(ref);
    table.rows.push_back({button_cell("data-triangle", t, count_text(static_cast<std::int64_t>(t) + 1)),
                          number_cell(values.values[t]),
                          {std::to_string(ref), true},
                          text_cell(face == results.end() ? "" : face->second->name)});
  }
  return html_of(table);
}

/// The largest finite value of each face.
std::map<std::int32_t, double> largest_of(const ReportContent& content, const TriangleValues* values) {
  std::map<std::int32_t, double> largest;
  for (std::size_t t = 0; values != nullptr && t < values->values.size(); ++t)
    if (const double x = values->values[t]; std::isfinite(x)) {
      const auto [at, fresh] = largest.emplace(content.mesh.triangle_refs[t], x);
      if (!fresh) at->second = std::max(at->second, x);
    }
  return largest;
}

/// Returns the cells of a face with triangles.
void add_figures(const FaceFigures* f, std::vector<HtmlCell>& row) {
  if (f == nullptr) {
    row.insert(row.end(), 6, HtmlCell{"", true, "-1e999"});
    return;
  }
  for (const double x : {f->area, f->q2_mean, f->q2_min, f->edge_min, f->edge_mean, f->edge_max})
    row.push_back(number_cell(x));
}

}  // namespace

std::string worst_section(const ReportContent& content) {
  std::string tables;
  for (const TriangleValues& values : content.values)
    if (values.key != "size") tables += worst_table(content, values, values.key != "quality");
  if (tables.empty()) return "";
  return section("worst", "Worst elements",
                 "<p>Numbers count from 1, as in files. A button shows its triangle in the view.</p>\n<div class=\"side\">" + tables +
                     "</div>\n");
}

std::string faces_section(const ReportContent& content) {
  std::map<std::int32_t, const FaceFigures*> figures;
  for (const FaceFigures& f : content.check.report.faces) figures.emplace(f.ref, &f);
  const auto results = results_of(content.mesh);
  std::map<std::int32_t, const FaceResult*> all = results;
  for (const auto& each : figures) all.emplace(each.first, nullptr);
  HtmlTable table{.id = "faces-table", .caption = "Faces",
                  .columns = {"Face", "Name", "Status", "Triangles", "Area", "Q2 mean", "Q2 worst", "Edge least",
                              "Edge mean", "Edge largest"}, .sortable = true};
  const TriangleValues* const measured[] = {find(content, "a0"), find(content, "a1")};
  const std::map<std::int32_t, double> largest[] = {largest_of(content, measured[0]), largest_of(content, measured[1])};
  if (measured[0] != nullptr) table.columns.insert(table.columns.end(), {"A0 largest", "A1 largest"});
  table.columns.emplace_back("Reason");
  std::size_t index = 0;
  for (const auto& [ref, face] : all) {
    const auto f = figures.find(ref);
    const FaceFigures* const of_face = f == figures.end() ? nullptr : f->second;
    std::vector<HtmlCell> row{of_face != nullptr ? button_cell("data-face", index, std::to_string(ref))
                                                 : HtmlCell{std::to_string(ref), false, std::to_string(index)},
                              text_cell(face == nullptr ? "" : face->name),
                              text_cell(face == nullptr ? "" : status_word(face->status)),
                              count_cell(of_face == nullptr ? 0 : of_face->triangles)};
    add_figures(of_face, row);
    for (const auto& values : largest)
      if (measured[0] != nullptr) row.push_back(number_cell(values.contains(ref) ? values.at(ref) : NAN));
    row.push_back(text_cell(face == nullptr ? "" : face->why));
    table.rows.push_back(std::move(row));
    ++index;
  }
  const std::string filter =
      "<p><label for=\"face-filter\">Show faces whose row has</label> <input id=\"face-filter\" type=\"search\" /></p>\n";
  return section("faces", "Faces", table.rows.empty() ? "" : filter + html_of(table));
}

}  // namespace command
