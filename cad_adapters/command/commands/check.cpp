// SPDX-License-Identifier: BSD-3-Clause
// `carreau check`: figures and defects of a mesh in a file.
#include <cinttypes>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/json_output.h"
#include "check/mesh_check.h"
#include "commands/commands.h"

namespace command {
namespace {

/// Some models cross themselves: --allow-crossings is for them.
bool is_sound(const MeshCheck& c, const CheckOptions& options) {
  return c.defects == 0 && (c.crossings.pairs == 0 || options.allow_crossings);
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

void print_elements(const carreau_cell_quality& q, int order) {
  if (!has_elements(q)) return;
  std::string kinds;
  const auto add = [&](std::int64_t n, const std::string& kind) {
    if (n > 0) kinds += (kinds.empty() ? "" : ", ") + std::to_string(n) + " " + kind;
  };
  const std::string curved = " of order " + std::to_string(order);
  add(q.triangles3, "triangles"), add(q.triangles6, "triangles" + curved);
  add(q.quads4, "quadrilaterals"), add(q.quads8, "quadrilaterals" + curved);
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

void print_defects(const MeshCheck& c, const CheckOptions& options) {
  const std::string crossing = crossings_count(c.crossings.pairs);
  if (c.defects == 0 && !crossing.empty())
    std::printf("defects     %s%s\n", options.allow_crossings ? "none; allowed: " : "", crossing.c_str());
  else if (c.defects == 0)
    std::puts("defects     none");
  else
    std::printf("defects     %" PRId64 "%s%s\n%s\n", c.defects, c.defects >= options.limit ? " or more" : "",
                crossing.empty() || options.allow_crossings ? "" : (", and " + crossing).c_str(), c.sentences.c_str());
}

}  // namespace

int check(const CheckOptions& options) {
  const MeshHandle mesh = read_mesh(options.mesh);
  const MeshCheck c = check_of(mesh.get(), {options.closed, options.limit, options.worst});
  if (options.json) {
    print_json("check", check_json(c, options.mesh, options.limit, options.allow_crossings));
    return is_sound(c, options) ? 0 : 1;
  }
  std::printf("vertices    %" PRId64 "\ntriangles   %" PRId64 "\nfaces       %" PRId64 "\ncurve edges %" PRId64 "\n",
              c.vertices, c.triangles, c.faces, c.edges);
  for (const FaceResult& face : c.not_meshed)
    std::printf("%-11s face %d%s%s\n", status_word(face.status), static_cast<int>(face.ref),
                face.name.empty() ? "" : (" (" + face.name + ")").c_str(), reason_of(face).c_str());
  if (c.measured) {
    print_elements(c.cells, c.order);
    print_quality(c.quality, c.report);
    print_report(c.report, options.faces);
    std::printf("crossing    %" PRId64 " pairs of triangles\n", c.crossings.pairs);
    for (const std::string& sentence : sentences_of(c.crossings, static_cast<std::size_t>(options.limit)))
      std::printf("  %s\n", sentence.c_str());
  }
  print_defects(c, options);
  return is_sound(c, options) ? 0 : 1;
}

}  // namespace command
