// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/built/triangles_input.h"

#include <carreau_geometry.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "base/failure.h"
#include "base/json_output.h"
#include "base/text_file.h"
#include "files/readable_mesh.h"
#include "inputs/base/built_input.h"
#include "inputs/tessellated/tessellated_step.h"

namespace command {
namespace {

carreau_triangles_options options_of(const TrianglesChoice& choice) {
  carreau_triangles_options options{};
  options.struct_size = sizeof options;
  options.sharp_angle = choice.sharp;
  options.corner_angle = choice.corner;
  options.given_edges_only = choice.given_edges ? 1 : 0;
  options.ignore_references = choice.ignore_references ? 1 : 0;
  return options;
}

carreau_status load(carreau_session* session, const std::string& path, const TrianglesChoice& choice) {
  const carreau_triangles_options options = options_of(choice);
  if (!is_tessellated_step(path)) {
    const ReadableMesh file(path);
    const carreau_status status = carreau_load_triangles(session, &options, file.path().c_str());
    if (status != CARREAU_OK && file.is_translated()) throw Failure(file.in_terms_of_file(carreau_last_error(session)));
    return status;
  }
  const Tessellation faces = read_tessellation(path);
  carreau_triangles given{};
  given.struct_size = sizeof given;
  given.vertex_count = static_cast<std::int64_t>(faces.vertices.size() / 3);
  given.triangle_count = static_cast<std::int64_t>(faces.refs.size());
  given.vertices = faces.vertices.data(), given.triangles = faces.triangles.data();
  given.triangle_refs = faces.refs.data();
  return carreau_add_triangles(session, &options, &given);
}

/// Faces are regions, which have no curves of the parameter plane.
class TrianglesInput final : public CadInput {
 public:
  TrianglesInput(SessionHandle session, const std::string& path, const TrianglesChoice& choice)
      : session_(std::move(session)), path_(path), choice_(choice), report_(triangles_report(session_.get())) {
    std::int64_t n = 0;
    require(session_.get(), carreau_model_count(session_.get(), &n, nullptr, nullptr));
    faces_.resize(static_cast<std::size_t>(n));
    require(session_.get(), carreau_model_faces(session_.get(), n, faces_.data(), nullptr));
  }

  carreau_status give_to(carreau_session* session) override { return load(session, path_, choice_); }
  [[nodiscard]] double diagonal() const override { return report_.diagonal; }
  [[nodiscard]] std::string summary() const override {
    return std::to_string(report_.triangles) + " triangles, " + std::to_string(report_.regions) + " regions, " +
           std::to_string(report_.lines) + " sharp lines of " + std::to_string(report_.sharp_edges) + " edges, " +
           std::to_string(report_.corners) + " corners";
  }
  bool set_face_size(const std::string& face, double) override {
    throw Failure("--face-size " + face + ": faces of a surface given as triangles have no sizes of their own.");
  }
  [[nodiscard]] bool answers_face_sizes() const override { return false; }
  [[nodiscard]] double face_size(std::int32_t) const override { return 0; }
  [[nodiscard]] bool locate(std::int32_t face, double u, double v, Place& place) const noexcept override {
    const std::lock_guard lock(mutex_);
    return locate_by(session_.get(), face, u, v, place);
  }
  [[nodiscard]] std::vector<FaceLook> faces() const override;
  [[nodiscard]] std::vector<std::int32_t> face_numbers() const override { return faces_; }
  [[nodiscard]] std::vector<std::int32_t> curves(std::int32_t) const override { return {}; }
  [[nodiscard]] bool on_curve(std::int32_t, std::int32_t, double, double&, double&) const noexcept override {
    return false;
  }
  [[nodiscard]] bool closed() const override { return report_.border_edges == 0; }
  [[nodiscard]] std::string of_mesh(carreau_session* session) const override {
    return distances_line(session, report_.deviation);
  }

 private:
  SessionHandle session_;
  mutable std::mutex mutex_;
  std::string path_;
  TrianglesChoice choice_;
  carreau_triangles_report report_;
  std::vector<std::int32_t> faces_;
};

MeshHandle refined(carreau_session* session, double angle, int depth) {
  carreau_mesh* raw = nullptr;
  if (carreau_mesh_create(&raw) != CARREAU_OK) throw Failure("Out of memory.");
  MeshHandle mesh(raw);
  require(session, carreau_triangles_refine(session, angle > 0 ? angle : 1, angle > 0 ? depth : 0, raw));
  return mesh;
}

std::vector<FaceLook> TrianglesInput::faces() const {
  const MeshHandle mesh = refined(session_.get(), 0, 0);
  const MeshArrays arrays = arrays_of(mesh.get());
  std::map<std::int32_t, FaceLook> looks;
  for (std::size_t t = 0; t < arrays.triangles.size(); ++t) {
    FaceLook& look = looks[arrays.triangle_refs[t]];
    std::array<Point, 3> p{};
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = arrays.vertices[static_cast<std::size_t>(arrays.triangles[t][k])];
      if (look.number == 0) look.low = look.high = p[k], look.number = arrays.triangle_refs[t], look.kind = "triangles";
      for (std::size_t c = 0; c < 3; ++c)
        look.low[c] = std::min(look.low[c], p[k][c]), look.high[c] = std::max(look.high[c], p[k][c]);
    }
    double a[3], b[3];
    for (std::size_t c = 0; c < 3; ++c) a[c] = p[1][c] - p[0][c], b[c] = p[2][c] - p[0][c];
    look.area += std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]) / 2;
  }
  std::vector<FaceLook> list;
  for (auto& [ref, look] : looks) list.push_back(std::move(look));
  return list;
}

}  // namespace

bool locate_by(carreau_session* session, std::int32_t face, double u, double v, Place& place) noexcept {
  const double uv[2] = {u, v};
  double x[3] = {};
  if (carreau_geometry_points(session, face, 1, uv, x) != CARREAU_OK) return false;
  place = {x[0], x[1], x[2], u, v};
  return true;
}

bool is_triangles(const std::string& path) {
  const std::string suffix = suffix_of(path);
  return std::any_of(std::begin(triangles_suffixes), std::end(triangles_suffixes),
                     [&](const char* each) { return suffix == each; }) ||
         is_tessellated_step(path);
}

carreau_triangles_report triangles_report(carreau_session* session) {
  carreau_triangles_report report{};
  report.struct_size = sizeof report;
  require(session, carreau_triangles_measure(session, &report));
  return report;
}

std::string distances_line(carreau_session* session, double deviation) {
  const char* element = nullptr;
  require(session, carreau_get_text(session, "element", &element));
  const bool straight = std::string(element) == "p1";
  double pair[2] = {}, bounds[4] = {};
  if (straight)
    require(session, carreau_triangles_bounds(session, 0, bounds));
  else
    require(session, carreau_triangles_distances(session, pair));
  char text[160];
  std::snprintf(text, sizeof text,
                "distance   %.4g%s from the mesh to the triangles, %.4g back; their smooth surface is within %.4g",
                straight ? bounds[1] : pair[0], straight ? " at most" : "", straight ? bounds[3] : pair[1], deviation);
  return text;
}

std::unique_ptr<CadInput> open_triangles(const std::string& path, const TrianglesChoice& choice) {
  SessionHandle session = make_silent_session();
  require(session.get(), load(session.get(), path, choice));
  return std::make_unique<TrianglesInput>(std::move(session), path, choice);
}

MeshHandle refined_triangles(const std::string& path, const TrianglesChoice& choice, double angle, int depth,
                             bool quiet) {
  SessionHandle session = quiet ? make_silent_session() : make_session();
  require(session.get(), load(session.get(), path, choice));
  return refined(session.get(), angle, depth);
}

void print_triangles_info(const std::string& path, const TrianglesChoice& choice, bool json) {
  SessionHandle session = json ? make_silent_session() : make_session();
  require(session.get(), load(session.get(), path, choice));
  const carreau_triangles_report r = triangles_report(session.get());
  const std::pair<const char*, std::int64_t> counts[] = {{"vertices", r.vertices},
                                                         {"triangles", r.triangles},
                                                         {"edges", r.edges},
                                                         {"shells", r.shells},
                                                         {"euler_number", r.euler_number},
                                                         {"border_edges", r.border_edges},
                                                         {"manifold_breaks", r.manifold_breaks},
                                                         {"one_sided_edges", r.one_sided_edges},
                                                         {"pinched_vertices", r.pinched_vertices},
                                                         {"turned_triangles", r.turned_triangles},
                                                         {"repeated_triangles", r.repeated_triangles},
                                                         {"flat_triangles", r.flat_triangles},
                                                         {"sharp_edges", r.sharp_edges},
                                                         {"lines", r.lines},
                                                         {"corners", r.corners},
                                                         {"regions", r.regions},
                                                         {"dropped_edges", r.dropped_edges},
                                                         {"prolonged_edges", r.prolonged_edges},
                                                         {"faded_ends", r.faded_ends},
                                                         {"unfolded", r.unfolded},
                                                         {"folded", r.folded}};
  if (json) {
    nlohmann::ordered_json value = {{"input", path}};
    for (const auto& [name, n] : counts) value[name] = n;
    value["diagonal"] = r.diagonal, value["deviation"] = r.deviation, value["sharp_angle"] = r.sharp_angle;
    print_json("info", value);
    return;
  }
  for (const auto& [name, n] : counts) {
    std::string words = name;
    std::replace(words.begin(), words.end(), '_', ' ');
    std::printf("%-18s %lld\n", words.c_str(), static_cast<long long>(n));
  }
  std::printf("%-18s %.6g\n%-18s %.6g\n%-18s %.6g\n", "diagonal", r.diagonal, "deviation", r.deviation, "sharp angle",
              r.sharp_angle);
}

}  // namespace command
