// SPDX-License-Identifier: BSD-3-Clause
#include "report/sections.h"

#include <algorithm>

#include "report/histogram.h"
#include "report/html_text.h"

namespace command {
namespace {

using Json = nlohmann::ordered_json;

/// A member of an object; null if it is missing.
Json member(const Json& object, const char* name) {
  return object.is_object() && object.contains(name) ? object.at(name) : Json();
}

double real(const Json& value) { return value.is_number() ? value.get<double>() : NAN; }

std::vector<std::string> texts(const Json& list) {
  std::vector<std::string> result;
  if (list.is_array())
    for (const Json& each : list) result.push_back(each.get<std::string>());
  return result;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find('\n', from), text.size());
    lines.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  return lines;
}

std::string counted(std::int64_t n, const char* one, const char* many) {
  return count_text(n) + " " + (n == 1 ? one : many);
}

std::vector<HtmlCell> row(const char* name, HtmlCell value) { return {text_cell(name), std::move(value)}; }

std::string sub_list(const char* heading, const std::vector<std::string>& lines) {
  return lines.empty() ? "" : "<h3>" + html(heading) + "</h3>\n" + list_of(lines);
}

HtmlCell range_cell(double low, double high, const char* unit) {
  return {number_text(low) + " to " + number_text(high) + unit, true};
}

void add_topology(const MeshCheck& c, HtmlTable& table) {
  const MeshReport& r = c.report;
  std::int64_t loops = std::count_if(r.borders.begin(), r.borders.end(), [](const Border& b) { return b.closed; });
  table.rows.push_back(row("Connected parts", count_cell(r.parts)));
  table.rows.push_back(row("Euler number", count_cell(r.euler)));
  table.rows.push_back(row("Edges of one triangle", count_cell(r.open_edges)));
  table.rows.push_back(row("Borders that are loops", count_cell(loops)));
  table.rows.push_back(row("Borders that are chains", count_cell(static_cast<std::int64_t>(r.borders.size()) - loops)));
  table.rows.push_back(row("Edges of more than two triangles", count_cell(r.shared_edges)));
  table.rows.push_back(row("Triangles turned over against their neighbours", count_cell(r.turned_triangles)));
  table.rows.push_back(row("Folds inside faces", count_cell(r.folds)));
  table.rows.push_back(row("Vertices at the place of another vertex", count_cell(r.double_points)));
  table.rows.push_back(row("Pairs of triangles that cross", count_cell(c.crossings.pairs)));
}

void add_elements(const carreau_cell_quality& q, HtmlTable& table) {
  if (!has_elements(q)) return;
  table.rows.push_back(row("Triangles of order 1", count_cell(q.triangles3)));
  table.rows.push_back(row("Triangles of order 2", count_cell(q.triangles6)));
  table.rows.push_back(row("Quadrilaterals of order 1", count_cell(q.quads4)));
  table.rows.push_back(row("Quadrilaterals of order 2", count_cell(q.quads8)));
  table.rows.push_back(row("Elements that are not valid", count_cell(q.invalid)));
  table.rows.push_back(row("Least scaled Jacobian", number_cell(q.scaled_jacobian_min)));
}

std::vector<HtmlCell> measure_row(const std::string& name, const Json& m) {
  const Json limit = member(m, "limit");
  return {text_cell(name),
          text_cell(member(m, "of").get<std::string>()),
          number_cell(real(member(m, "mean"))),
          number_cell(real(member(m, "min"))),
          number_cell(real(member(m, "p1"))),
          number_cell(real(member(m, "p99"))),
          number_cell(real(member(m, "max"))),
          std::isfinite(real(limit)) ? number_cell(real(limit)) : HtmlCell{"", true},
          count_cell(member(m, "beyond").get<std::int64_t>())};
}

}  // namespace

std::string verdict_section(const ReportContent& content) {
  const MeshCheck& c = content.check;
  std::vector<std::string> wrong;
  std::int64_t failed = 0, mended = 0;
  for (const FaceResult& face : content.mesh.faces)
    failed += face.status == CARREAU_FACE_FAILED ? 1 : 0, mended += face.status == CARREAU_FACE_MENDED ? 1 : 0;
  const auto add = [&](std::int64_t n, const char* one, const char* many) {
    if (n > 0) wrong.push_back(counted(n, one, many));
  };
  add(failed, "face has no mesh", "faces have no mesh");
  add(mended, "face was repaired", "faces were repaired");
  add(c.defects, "defect", "defects");
  add(c.crossings.pairs, "pair of triangles crosses", "pairs of triangles cross");
  add(static_cast<std::int64_t>(texts(member(content.run, "not_read")).size()), "entity of the file could not be read",
      "entities of the file could not be read");
  add(static_cast<std::int64_t>(texts(member(content.run, "warnings")).size()), "warning", "warnings");
  for (const std::string& sentence : texts(member(member(content.run, "delivered"), "not_met"))) wrong.push_back(sentence);
  if (wrong.empty()) return "<p class=\"verdict good\"><strong>No problems found.</strong></p>\n";
  return "<div class=\"verdict bad\"><p><strong>Problems:</strong></p>" + list_of(wrong) + "</div>\n";
}

std::string histograms_section(const ReportContent& content) {
  std::string figures;
  for (const TriangleValues& values : content.values)
    figures += html_of(histogram_of(values, content.halves), values);
  return section("histograms", "Histograms", figures.empty() ? "" : "<div class=\"figures\">" + figures + "</div>\n");
}

std::string asked_section(const ReportContent& content) {
  HtmlTable table{.id = "parameters",
                  .caption = "Parameters with other values than their defaults",
                  .columns = {"Parameter", "Value", "Default", "Meaning"}};
  for (const AskedValue& each : content.asked)
    table.rows.push_back({text_cell(each.name), text_cell(each.value), text_cell(each.usual), text_cell(each.help)});
  return section("asked", "Parameters", html_of(table));
}

std::string delivered_section(const ReportContent& content) {
  const Json delivered = member(content.run, "delivered");
  if (delivered.is_null()) return "";
  HtmlTable table{.id = "measures",
                  .caption = "The mesh against the surface and the prescribed sizes",
                  .columns = {"Measure", "Entities", "Mean", "Least", "1 % below", "1 % above", "Largest", "Limit", "Beyond"}};
  const Json measures = member(delivered, "measures");
  for (const auto& [name, m] : measures.items())
    if (!member(m, "mean").is_null()) table.rows.push_back(measure_row(name, m));  // measures that were not computed have no mean
  const std::string share = number_text(100 * real(member(delivered, "lengths_in_range")));
  return section("delivered", "Measures",
                 "<p>" + share + " % of the edges have metric lengths from 0.7071 to 1.414; 1 is as prescribed.</p>\n" +
                     html_of(table) + sub_list("Not met", texts(member(delivered, "not_met"))));
}

std::string warnings_section(const ReportContent& content) {
  constexpr std::size_t pairs = 100;  // of faces
  return section("warnings", "Warnings",
                 sub_list("Messages of the run", texts(member(content.run, "warnings"))) +
                     sub_list("Not read", texts(member(content.run, "not_read"))) +
                     sub_list("Defects", lines_of(content.check.sentences)) +
                     sub_list("Triangles that cross", sentences_of(content.check.crossings, pairs)));
}

std::string mesh_section(const ReportContent& content) {
  const MeshCheck& c = content.check;
  const carreau_quality& q = c.quality;
  HtmlTable table{.id = "figures", .caption = "Figures of the mesh", .columns = {"Figure", "Value"}};
  table.rows.push_back(row("Vertices", count_cell(c.vertices)));
  table.rows.push_back(row("Triangles", count_cell(c.triangles)));
  table.rows.push_back(row("Edges on curves", count_cell(c.edges)));
  table.rows.push_back(row("Faces", count_cell(c.faces)));
  if (c.measured) {
    add_elements(c.cells, table);
    table.rows.push_back(row("Area", number_cell(q.area)));
    table.rows.push_back(row("Lengths of edges", range_cell(q.edge_min, q.edge_max, "")));
    table.rows.push_back(row("Mean length of edges", number_cell(q.edge_mean)));
    table.rows.push_back(row("Angles", range_cell(q.angle_min, q.angle_max, "°")));
    table.rows.push_back(row("Shape Q2: mean", number_cell(q.q2_mean)));
    table.rows.push_back(row("Shape Q2: first percentile", number_cell(q.q2_p1)));
    table.rows.push_back(row("Shape Q2: worst", number_cell(q.q2_min)));
    add_topology(c, table);
  }
  return section("mesh", "Mesh", html_of(table));
}

std::string times_section(const ReportContent& content) {
  const Json seconds = member(content.run, "seconds");
  HtmlTable table{.id = "seconds", .caption = "Seconds", .columns = {"Phase", "Seconds"}};
  if (seconds.is_object())
    for (const auto& [name, value] : seconds.items())
      if (name != "writing") table.rows.push_back(row(name.c_str(), number_cell(real(value))));
  const Json threads = member(content.run, "threads");
  if (threads.is_number()) table.rows.push_back(row("threads", count_cell(threads.get<std::int64_t>())));
  return section("times", "Times", html_of(table));
}

std::string command_section(const ReportContent& content) {
  return section("repeat", "To repeat it",
                 "<pre tabindex=\"0\" role=\"region\" aria-label=\"Command\"><code id=\"command\">" + html(content.repeat) + "</code></pre>\n<p>" +
                     html(std::string("carreau ") + carreau_version()) + "</p>\n");
}

}  // namespace command
