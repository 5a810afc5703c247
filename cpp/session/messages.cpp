// SPDX-License-Identifier: BSD-3-Clause
#include "session/messages.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "measure/strips_note.h"
#include "mesh/flat_mesh.h"
#include "support/format.h"
#include "support/ranks/all_that_hold.h"
#include "support/short_number.h"

namespace carreau {

void report_short_curves(const Model& model, const ModelSupports& supports, double eps_ends, Monitor& monitor) {
  for (std::size_t f = 0; f < model.faces.size(); ++f)
    for (std::size_t c = 0; c < model.faces[f].curves.size(); ++c) {
      const CurveSupport& support = supports.of_face[f][c];
      const double gap = norm(support.xyz.back() - support.xyz.front());
      if (gap >= eps_ends) continue;
      const Where where{.face = model.faces[f].ref,
                        .curve_index = host_rank(model.faces[f], c),
                        .curve = model.faces[f].curves[c].ref};
      // Closed curves and degenerate sides have one reference at both ends and are legal.
      const FaceCurve& curve = model.faces[f].curves[c];
      monitor.message(
          curve.end1 == curve.end2 ? Level::detail : Level::warning,
          where.prefix() + "its ends are " + format_number(gap) +
              " apart, less than eps_ends = " + format_number(eps_ends) +
              (support.length() < eps_ends ? "; the whole curve is that small" : "; the curve is closed or nearly so"));
    }
}

namespace {

// The quality without roots, and twice flat_quality.
bool is_surely_not_flat(const Vec3& a, const Vec3& b, const Vec3& c) noexcept {
  const Vec3 ab = b - a, bc = c - b, ca = a - c, n = cross(ab, ca);
  const double squares = dot(ab, ab) + dot(bc, bc) + dot(ca, ca);
  return 12 * dot(n, n) > 4 * flat_quality * flat_quality * squares * squares;
}

}  // namespace

void report_flat_triangles(SurfaceMesh& mesh, int threads, Monitor& monitor) {
  for (FaceMesh& face : mesh.faces) {
    if (face.status != FaceStatus::meshed && face.status != FaceStatus::mended) continue;
    const auto is_flat = [&](std::size_t t) {
      const auto at = [&](std::size_t k) -> const Vec3& { return mesh.vertices[face.vertex[face.triangles[t][k]]]; };
      return !is_surely_not_flat(at(0), at(1), at(2)) && quality_q2(at(0), at(1), at(2)) <= flat_quality;
    };
    const std::vector<std::int32_t> flat = all_that_hold(face.triangles.size(), {nullptr, threads}, "", monitor, is_flat);
    if (flat.empty()) continue;
    Where where{.face = face.ref};
    const auto& [a, b, c] = face.triangles[flat.front()];
    if (!face.is_spread(flat.front())) where.uv = (face.uv[a] + face.uv[b] + face.uv[c]) / 3;
    const std::string what = where.prefix() + std::to_string(flat.size()) +
                             (flat.size() == 1 ? " triangle has no area in space" : " triangles have no area in space");
    face.status = FaceStatus::mended;
    face.why += (face.why.empty() ? "" : "; ") + what;
    monitor.message(Level::warning, what);
  }
}

namespace {

/// The numbers of entities of a mesh.
struct Extent {
  std::int64_t vertices = 0, triangles = 0, edges = 0, loose_edges = 0;
};

void describe(const std::vector<WholeFace>& all, const Extent& extent, const CompositeReport& r, const QualitySummary& q, Monitor& monitor) {
  const auto whole = [](std::int64_t n) { return std::to_string(n); };
  const auto count = [&](FaceStatus status) {
    return std::count_if(all.begin(), all.end(), [&](const WholeFace& each) { return each.face.status == status; });
  };
  std::string faces = whole(static_cast<std::int64_t>(all.size())) + (all.size() == 1 ? " face" : " faces");
  if (const auto n = count(FaceStatus::mended); n > 0) faces += ", " + whole(n) + " of them repaired";
  if (const auto n = count(FaceStatus::collapsed); n > 0) faces += ", " + whole(n) + " of them collapsed";
  if (const auto n = count(FaceStatus::failed); n > 0) faces += ", " + whole(n) + " FAILED";
  monitor.message(Level::summary,
                  faces + ": " + whole(extent.vertices) + " vertices, " +
                      whole(extent.triangles) + " triangles, " +
                      whole(extent.edges) + " edges on curves" +
                      (extent.loose_edges > 0 ? ", " + whole(extent.loose_edges) + " of them on curves of no face" : ""));
  const auto short_text = [](double x) { return format_number(std::round(x * 1e4) / 1e4); };
  // Parts of a micrometre have a diagonal, and slivers a quality.
  const auto not_zero = [&](double x) { return x > 0 && x < 0.01 ? short_number(x) : short_text(x); };
  monitor.message(Level::summary, "shape quality Q2: mean " + short_text(q.q2.mean) + ", first percentile " +
                                      short_text(q.q2.p1) + ", worst " + not_zero(q.q2.min) + "; angles " +
                                      short_text(q.angle_min_deg) + " to " + short_text(q.angle_max_deg) + " degrees");
  if (r.gradation_rounds > 0)
    monitor.message(Level::detail,
                    "gradation: sizes graded on " + whole(static_cast<std::int64_t>(r.gradation_triangles)) +
                        " triangles" +
                        (r.gradation_rounds > 1 ? ", made " + whole(r.gradation_rounds) + " times" : "") + "; " +
                        short_text(r.seconds_gradation) + " s");
  monitor.message(Level::detail, "diag " + not_zero(r.diag) + "; " + whole(r.calls.surface()) +
                                      " evaluations of surfaces; " + short_text(r.seconds_total) + " s (curves " +
                                      short_text(r.seconds_curves) + ", sampling " + short_text(r.seconds_sampling) +
                                      ", plane meshes " + short_text(r.seconds_plane) + ", lift " +
                                      short_text(r.seconds_lift) + ")");
}

/// A line for each curve and face, for a verbosity of 100 (RT-0232 sec. 3.3).
void describe_entities(const SurfaceMesh& mesh, Monitor& monitor) {
  for (const CurveMesh& curve : mesh.curves) {
    double length = 0;
    for (std::size_t i = 1; i < curve.vertices.size(); ++i)
      length += norm(mesh.vertices[curve.vertices[i]] - mesh.vertices[curve.vertices[i - 1]]);
    const std::size_t edges = curve.vertices.empty() ? 0 : curve.vertices.size() - 1;
    monitor.message(Level::debug, "curve " + std::to_string(curve.ref) + ": " + std::to_string(edges) +
                                      (edges == 1 ? " edge" : " edges") + ", length " + short_number(length));
  }
  for (const WholeFace& each : whole_faces(mesh))
    monitor.message(Level::debug, "face " + std::to_string(each.face.ref) + ": " + std::to_string(each.triangles) +
                                      (each.triangles == 1 ? " triangle" : " triangles"));
}

}  // namespace

void describe_result(const CompositeResult& result, const QualitySummary& q, Monitor& monitor) {
  const SurfaceMesh& mesh = result.mesh;
  describe(whole_faces(mesh),
           {static_cast<std::int64_t>(mesh.vertices.size()), static_cast<std::int64_t>(mesh.triangle_count()),
            static_cast<std::int64_t>(mesh.edge_count()), static_cast<std::int64_t>(mesh.loose_edge_count())},
           result.report, q, monitor);
  if (const std::string strips = describe_strips(mesh); !strips.empty()) monitor.message(Level::summary, strips);
  if (monitor.hears(Level::debug)) describe_entities(mesh, monitor);
}

void describe_layers(std::span<const LayerFigures> layers, std::span<const CurveLayers> given, Monitor& monitor) {
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const LayerFigures& l = layers[i];
    const std::string name = "layers" + (layers.size() > 1 ? " " + std::to_string(i + 1) : std::string());
    if (l.cells == 0) {
      monitor.message(Level::warning, name + ": no row has room");
      continue;
    }
    monitor.message(Level::summary,
                    name + ": " + std::to_string(l.cells) + " cells in " +
                        (l.fewest_rows < l.rows ? std::to_string(l.fewest_rows) + " to " : std::string()) + std::to_string(l.rows) +
                        " rows; first height " + short_number(l.first_mean) + " (" + short_number(l.first_min) + " to " +
                        short_number(l.first_max) + "), " + short_number(l.first_min / given[i].first) + " to " +
                        short_number(l.first_max / given[i].first) + " of the request" +
                        (l.growth_max > 0 ? ", growth " + short_number(l.growth_mean) + " (" + short_number(l.growth_min) + " to " +
                                                short_number(l.growth_max) + ")"
                                          : std::string()));
  }
}

namespace {

std::string list_of(const std::vector<BareEdges::OfCurve>& curves) {
  constexpr std::size_t most = 5;
  std::string text;
  for (std::size_t k = 0; k < std::min(most, curves.size()); ++k)
    text += (k > 0 ? ", " : "") + std::to_string(curves[k].bare) + " on curve " + std::to_string(curves[k].curve) + " of face " +
            std::to_string(curves[k].face);
  return curves.size() > most ? text + ", and edges of " + std::to_string(curves.size() - most) + " other places" : text;
}

}  // namespace

void describe_bare_edges(std::span<const BareEdges> layers, Monitor& monitor) {
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const BareEdges& edges = layers[i];
    if (edges.bare == 0 || edges.bare == edges.sides) continue;  // describe_layers() reports that no row has room
    monitor.message(Level::warning, "layers" + (layers.size() > 1 ? " " + std::to_string(i + 1) : std::string()) + ": " +
                                        std::to_string(edges.bare) + " of " + std::to_string(edges.sides) + (edges.bare == 1 ? " edges has no row: " : " edges have no row: ") +
                                        list_of(edges.curves));
  }
}

void describe_part(const PartMesh& part, const CompositeReport& report, Monitor& monitor) {
  describe(part.faces, {part.vertices, part.triangles, part.curve_edges, part.loose_edges}, report, part.quality, monitor);
}

void describe_evaluation(const SurfaceMesh& mesh, const MeshEvaluation& delivered, Monitor& monitor) {
  const DeliveredText text = describe(delivered);
  for (const std::string& line : text.summary) monitor.message(Level::summary, line);
  for (const std::string& sentence : text.not_met) monitor.message(Level::warning, sentence);
  if (const std::string by_face = describe(beyond_in_faces(mesh, delivered)); !by_face.empty()) monitor.message(Level::warning, by_face);
}

}  // namespace carreau
