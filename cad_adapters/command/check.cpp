// `carreau check`: what a mesh in a file is worth.
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "crossings.h"
#include "json_output.h"
#include "mesh_report.h"
#include "quality_json.h"

namespace command {
namespace {

using Json = nlohmann::ordered_json;

struct Checked {
  std::int64_t vertices = 0, triangles = 0, edges = 0, faces = 0, defects = 0;
  std::string sentences;
  carreau_quality quality{};
  carreau_cell_quality cells{};
  MeshReport report;
  Crossings crossings;
  std::vector<FaceResult> not_meshed;  ///< faces that the file knows of and has no triangles of
  bool measured = false;               ///< indices and numbers allow quality and report
};

/// Whether indices are in range and coordinates finite.
bool can_be_measured(const MeshArrays& mesh) {
  const auto n = static_cast<std::int32_t>(mesh.vertices.size());
  for (const auto& t : mesh.triangles)
    for (const std::int32_t v : t)
      if (v < 0 || v >= n) return false;
  for (const Point& p : mesh.vertices)
    for (const double x : p)
      if (!std::isfinite(x)) return false;
  return true;
}

Checked look_at(const CheckOptions& options) {
  constexpr std::size_t places = 5;  // of each thing that is wrong
  const MeshHandle mesh = read_mesh(options.mesh);
  Checked c;
  require(mesh.get(), carreau_mesh_count(mesh.get(), &c.vertices, &c.triangles, &c.edges, &c.faces));
  const char* text = "";
  require(mesh.get(), carreau_mesh_defects(mesh.get(), options.closed ? 1 : 0, options.limit, &c.defects, &text));
  c.sentences = text;
  const MeshArrays arrays = arrays_of(mesh.get());
  for (const FaceResult& face : arrays.faces)
    if (face.triangles == 0) c.not_meshed.push_back(face);
  c.measured = can_be_measured(arrays);
  if (!c.measured) return c;
  c.report = report_of(arrays, static_cast<std::size_t>(options.worst), places);
  c.quality.struct_size = sizeof c.quality;
  require(mesh.get(), carreau_mesh_quality(mesh.get(), &c.quality));
  c.cells.struct_size = sizeof c.cells;
  require(mesh.get(), carreau_mesh_cell_quality(mesh.get(), &c.cells));
  c.crossings = crossings_of(mesh.get(), arrays.triangle_refs, 0);
  return c;
}

/// Models may cross themselves: that is a defect for those who say so.
bool is_sound(const Checked& c, const CheckOptions& options) {
  return c.defects == 0 && (c.crossings.pairs == 0 || !options.no_crossings);
}

std::string place_text(const Point& p) {
  char text[120];
  std::snprintf(text, sizeof text, "(%.6g, %.6g, %.6g)", p[0], p[1], p[2]);
  return text;
}

std::string places_text(const std::vector<Point>& places, std::int64_t all) {
  std::string text;
  for (const Point& p : places) text += (text.empty() ? " at " : ", ") + place_text(p);
  return text + (static_cast<std::int64_t>(places.size()) < all ? ", ..." : "");
}

void print_histogram(const char* name, const std::array<std::int64_t, quality_classes>& classes, double all) {
  std::printf("%s from 0 to 1 by tenths:", name);
  for (const std::int64_t n : classes) std::printf(" %" PRId64, n);
  std::printf(" (%.1f %% below 0.5)\n",
              all > 0
                  ? 100.0 * static_cast<double>(classes[0] + classes[1] + classes[2] + classes[3] + classes[4]) / all
                  : 0.0);
}

void print_quality(const carreau_quality& q, const MeshReport& r) {
  std::printf("edges       %" PRId64 " (%" PRId64 " with one triangle)\n", q.edges, q.open_edges);
  std::printf("area        %.9g\n", q.area);
  std::printf("edge length %.6g to %.6g, mean %.6g\n", q.edge_min, q.edge_max, q.edge_mean);
  std::printf("angles      %.4g to %.4g degrees\n", q.angle_min, q.angle_max);
  std::printf("shape Q1    mean %.4f, first percentile %.4f, worst %.4f\n", q.q1_mean, q.q1_p1, q.q1_min);
  std::printf("shape Q2    mean %.4f, first percentile %.4f, worst %.4f\n", q.q2_mean, q.q2_p1, q.q2_min);
  print_histogram("Q1 classes  ", r.q1, static_cast<double>(q.triangles));
  print_histogram("Q2 classes  ", r.q2, static_cast<double>(q.triangles));
  std::printf("degree 6    %.1f %% of interior vertices\n", 100 * q.degree6);
}

bool has_elements(const carreau_cell_quality& q) { return q.triangles6 + q.quads4 + q.quads8 > 0; }

void print_elements(const carreau_cell_quality& q) {
  if (!has_elements(q)) return;
  std::string kinds;
  const auto add = [&](std::int64_t n, const char* kind) {
    if (n > 0) kinds += (kinds.empty() ? "" : ", ") + std::to_string(n) + " " + kind;
  };
  add(q.triangles3, "triangles"), add(q.triangles6, "triangles of order 2");
  add(q.quads4, "quadrilaterals"), add(q.quads8, "quadrilaterals of order 2");
  std::printf("elements    %s\n", kinds.c_str());
  std::printf("  area      %.12g, of triangles %.3g %%\n", q.area, 100 * q.triangle_share);
  std::printf("  shape     mean %.4f, worst %.4f; scaled Jacobian mean %.4f, worst %.4f\n", q.shape_mean, q.shape_min,
              q.scaled_jacobian_mean, q.scaled_jacobian_min);
  std::printf("  angles    %.4g to %.4g degrees\n", q.angle_min, q.angle_max);
  std::printf("  Jacobian  least over mean %.4f, in the mean %.4f; %" PRId64 " elements are not valid\n",
              q.least_jacobian_min, q.least_jacobian_mean, q.invalid);
}

void print_report(const MeshReport& r, bool faces) {
  for (const WorstTriangle& t : r.worst)
    std::printf("worst       Q2 %.4f: triangle %zu of face %d at %s\n", t.quality, t.index + 1, static_cast<int>(t.ref),
                place_text(t.centre).c_str());
  std::printf("parts       %" PRId64 "%s, Euler number %" PRId64 "\n", r.parts, r.open_edges == 0 ? " (closed)" : "",
              r.euler);
  constexpr std::size_t listed = 5;
  std::printf("borders     %zu\n", r.borders.size());
  for (std::size_t i = 0; i < r.borders.size() && i < listed; ++i)
    std::printf("  %s of %" PRId64 " edges, length %.6g, at %s\n", r.borders[i].closed ? "loop" : "chain",
                r.borders[i].edges, r.borders[i].length, place_text(r.borders[i].place).c_str());
  if (r.borders.size() > listed) std::puts("  ...");
  if (r.loose_edges > 0) std::printf("loose       %" PRId64 " edges of curves, of no triangle\n", r.loose_edges);
  std::printf("shared      %" PRId64 " edges of more than two triangles%s\n", r.shared_edges,
              places_text(r.shared_at, r.shared_edges).c_str());
  std::printf("turned over %" PRId64 " triangles%s\n", r.turned_triangles,
              places_text(r.turned_at, r.turned_triangles).c_str());
  std::printf("folds       %" PRId64 " edges inside faces%s\n", r.folds, places_text(r.fold_at, r.folds).c_str());
  std::printf("points      %" PRId64 " at the place of another%s\n", r.double_points,
              places_text(r.double_at, r.double_points).c_str());
  if (!faces) return;
  std::printf("%10s %10s %12s %8s %8s %12s %12s %12s\n", "face", "triangles", "area", "Q2 mean", "Q2 min", "edge min",
              "edge mean", "edge max");
  for (const FaceFigures& f : r.faces)
    std::printf("%10d %10" PRId64 " %12.6g %8.4f %8.4f %12.6g %12.6g %12.6g%s%s\n", static_cast<int>(f.ref),
                f.triangles, f.area, f.q2_mean, f.q2_min, f.edge_min, f.edge_mean, f.edge_max,
                f.name.empty() ? "" : "  ", f.name.c_str());
}

Json json_of(const MeshReport& r) {
  Json borders = Json::array(), faces = Json::array(), worst = Json::array();
  for (const Border& b : r.borders)
    borders.push_back({{"edges", b.edges}, {"length", b.length}, {"loop", b.closed}, {"at", b.place}});
  for (const FaceFigures& f : r.faces)
    faces.push_back({{"reference", f.ref},
                     {"name", f.name},
                     {"triangles", f.triangles},
                     {"area", f.area},
                     {"q2_mean", f.q2_mean},
                     {"q2_min", f.q2_min},
                     {"edge_min", f.edge_min},
                     {"edge_mean", f.edge_mean},
                     {"edge_max", f.edge_max}});
  for (const WorstTriangle& t : r.worst)
    worst.push_back({{"triangle", t.index}, {"reference", t.ref}, {"q2", t.quality}, {"at", t.centre}});
  return {{"q1_classes", r.q1},
          {"q2_classes", r.q2},
          {"worst", worst},
          {"parts", r.parts},
          {"euler", r.euler},
          {"borders", borders},
          {"loose_edges", r.loose_edges},
          {"shared_edges", {{"count", r.shared_edges}, {"at", r.shared_at}}},
          {"turned_triangles", {{"count", r.turned_triangles}, {"at", r.turned_at}}},
          {"folds", {{"count", r.folds}, {"at", r.fold_at}}},
          {"double_points", {{"count", r.double_points}, {"at", r.double_at}}},
          {"faces", faces}};
}

void print_as_json(const Checked& c, const CheckOptions& options) {
  Json defects = Json::array();
  for (std::size_t from = 0; from < c.sentences.size();) {
    const std::size_t to = std::min(c.sentences.find('\n', from), c.sentences.size());
    defects.push_back(c.sentences.substr(from, to - from));
    from = to + 1;
  }
  Json result = {{"mesh", options.mesh},
                 {"vertices", c.vertices},
                 {"triangles", c.triangles},
                 {"faces", c.faces},
                 {"curve_edges", c.edges},
                 {"defects", defects},
                 {"all_defects", c.defects < options.limit}};
  for (const FaceResult& face : c.not_meshed)
    result["not_meshed"].push_back(
        {{"reference", face.ref}, {"name", face.name}, {"status", status_word(face.status)}, {"why", face.why}});
  if (c.measured) {
    result["quality"] = quality_json(c.quality);
    if (has_elements(c.cells)) result["elements"] = elements_json(c.cells);
    result["report"] = json_of(c.report);
    result["intersections"] = crossings_json(c.crossings);
  }
  print_json("check", result);
}

}  // namespace

int check(const CheckOptions& options) {
  const Checked c = look_at(options);
  if (options.json) {
    print_as_json(c, options);
    return is_sound(c, options) ? 0 : 1;
  }
  std::printf("vertices    %" PRId64 "\ntriangles   %" PRId64 "\nfaces       %" PRId64 "\ncurve edges %" PRId64 "\n",
              c.vertices, c.triangles, c.faces, c.edges);
  for (const FaceResult& face : c.not_meshed)
    std::printf("%-11s face %d%s%s\n", status_word(face.status), static_cast<int>(face.ref),
                face.name.empty() ? "" : (" (" + face.name + ")").c_str(), reason_of(face).c_str());
  if (c.measured) {
    print_elements(c.cells);
    print_quality(c.quality, c.report);
    print_report(c.report, options.faces);
    std::printf("crossing    %" PRId64 " pairs of triangles\n", c.crossings.pairs);
    for (const std::string& sentence : sentences_of(c.crossings, static_cast<std::size_t>(options.limit)))
      std::printf("  %s\n", sentence.c_str());
  }
  if (c.defects == 0) {
    std::puts(is_sound(c, options) ? "defects     none" : "defects     none but triangles that cross");
    return is_sound(c, options) ? 0 : 1;
  }
  std::printf("defects     %" PRId64 "%s\n%s\n", c.defects, c.defects >= options.limit ? " or more" : "",
              c.sentences.c_str());
  return 1;
}

}  // namespace command
