// SPDX-License-Identifier: BSD-3-Clause
#include "surface/discrete/start_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace carreau {

namespace {

using discrete::RefinedMesh;

/// Factor for the angle of the geometric rule. On a cylinder A1 of an equilateral triangle whose edges have that angle
/// with the surface is up to 2 / sqrt(3) times the angle, and lengths vary.
constexpr double angle_slack = 1.6;

std::size_t index(std::int32_t i) noexcept { return static_cast<std::size_t>(i); }

/// Number of equilateral triangles with the prescribed sizes that cover the area of the input.
double expected_triangles(const RefinedMesh& mesh, const MeshSizes& sizes) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto at = [&](std::size_t k) -> const Vec3& { return mesh.vertices[index(mesh.triangles[t][k])]; };
    const double h = sizes.over(mesh, t);
    sum += norm(cross(at(1) - at(0), at(2) - at(0))) / (half_root3 * h * h);
  }
  return sum;
}

/// Edges between the triangles of the mesh that are on lines, with the faces of their triangles.
std::map<MeshEdge, std::vector<std::int32_t>> faces_beside(const SurfaceMesh& mesh) {
  std::vector<char> on_line(mesh.vertices.size(), 0);
  for (const CurveMesh& curve : mesh.curves)
    for (const std::int32_t v : curve.vertices) on_line[index(v)] = 1;
  std::map<MeshEdge, std::vector<std::int32_t>> faces;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (const auto& t : mesh.faces[f].triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int32_t v = mesh.faces[f].vertex[index(t[i])], w = mesh.faces[f].vertex[index(t[(i + 1) % 3])];
        if (on_line[index(v)] != 0 && on_line[index(w)] != 0)
          faces[mesh_edge(v, w)].push_back(static_cast<std::int32_t>(f));
      }
  return faces;
}

/// A face on both sides is one internal use.
std::vector<CurveMeshUse> uses_of(std::vector<std::int32_t> faces) {
  std::vector<CurveMeshUse> uses;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const bool internal = k + 1 < faces.size() && faces[k] == faces[k + 1];
    uses.push_back({faces[k], internal});
    if (internal) ++k;
  }
  return uses;
}

/// Metrics by face and local vertex of the mesh. Its faces have the triangles of `refined` in their order.
PlaneMetrics metrics_of(const discrete::DiscreteCad& surface, const RefinedMesh& refined, const SurfaceMesh& mesh,
                        const MeshSizes& sizes) {
  if (!sizes.by_direction()) return {};
  PlaneMetrics metrics;
  std::map<int, std::size_t> rank;
  for (const FaceMesh& face : mesh.faces) {
    rank[face.ref] = metrics.size();
    metrics.emplace_back(face.vertex.size());
  }
  const std::vector<std::int32_t> refs = discrete::face_refs(surface.discrete());
  std::vector<std::size_t> next(metrics.size(), 0);
  for (std::size_t t = 0; t < refined.triangles.size(); ++t) {
    const std::size_t f = rank.at(refs[index(refined.parent[t])]);
    const auto& local = mesh.faces[f].triangles[next[f]++];
    for (std::size_t k = 0; k < 3; ++k) metrics[f][index(local[k])] = sizes.corner[3 * t + k];
  }
  return metrics;
}

/// A sharp line of the surface: cubics of its patches, which all sides share.
class PatchLine final : public LineGeometry {
 public:
  PatchLine(const SharpLine& line, const SurfaceMesh& mesh, const Charts& charts, Cad& cad)
      : line_(line), charts_(charts), cad_(cad), arc_{0} {
    for (std::size_t k = 1; k < line.vertices.size(); ++k)
      arc_.push_back(arc_.back() +
                     norm(mesh.vertices[index(line.vertices[k])] - mesh.vertices[index(line.vertices[k - 1])]));
  }
  [[nodiscard]] bool is_known() const noexcept override { return true; }
  [[nodiscard]] const std::vector<double>& arcs() const noexcept override { return arc_; }
  [[nodiscard]] Vec3 near(double arc) const override {
    const Spot spot = spot_at(arc);
    return charts_.evaluate(cad_, foot(charts_.triangles_on(spot.edge()).front(), spot)).xyz;
  }
  [[nodiscard]] KeptPlaces at(double arc) override {
    const Spot spot = spot_at(arc);
    KeptPlaces places;
    for (const Charts::OnEdge& on : charts_.triangles_on(spot.edge())) {
      places.push_back(charts_.evaluate(cad_, foot(on, spot)));
      places.back().xyz = places.front().xyz;
    }
    return places;
  }

 private:
  struct Spot {
    std::int32_t from, to;
    double share;
    [[nodiscard]] MeshEdge edge() const noexcept { return mesh_edge(from, to); }
  };
  [[nodiscard]] Spot spot_at(double arc) const {
    const auto next = std::ranges::upper_bound(arc_, arc) - arc_.begin();
    const std::size_t k = std::clamp<std::size_t>(static_cast<std::size_t>(next), 1, arc_.size() - 1) - 1;
    return {line_.vertices[k], line_.vertices[k + 1], std::clamp((arc - arc_[k]) / (arc_[k + 1] - arc_[k]), 0.0, 1.0)};
  }
  [[nodiscard]] Foot foot(const Charts::OnEdge& on, const Spot& spot) const {
    const bool forward = charts_.triangles()[index(on.triangle)].vertex[index(on.side)] == spot.from;
    return {on.triangle, lerp(charts_.uv(on.triangle, on.side), charts_.uv(on.triangle, (on.side + 1) % 3),
                              forward ? spot.share : 1 - spot.share)};
  }

  const SharpLine& line_;
  const Charts& charts_;
  Cad& cad_;
  std::vector<double> arc_;
};

}  // namespace

double angle_slack_of(const CompositeOptions& options) { return options.size.geo_guarantee ? 1 : angle_slack; }

RefinedMesh refine_by_sizes(const discrete::DiscreteSurface& surface, const DiscreteSizes& sizes,
                            const CompositeOptions& options, Monitor& monitor, double longest,
                            double longest_of_lines) {
  MeshSizes size;
  std::vector<char> on_line;
  discrete::RefinementWish wish;
  wish.edge = [&](const RefinedMesh& mesh, std::int32_t v, std::int32_t w) {
    if (size.h.size() != mesh.vertices.size()) {
      size = sizes.at_vertices(mesh, monitor);
      on_line.assign(size.h.size(), 0);
      for (const auto& line : mesh.lines)
        for (const std::int32_t k : line) on_line[index(k)] = 1;
    }
    const bool line = on_line[index(v)] != 0 && on_line[index(w)] != 0;
    const double most = line ? longest_of_lines : longest;
    if (size.by_direction()) return size.length(mesh, v, w) > most;
    const double h = 0.5 * (size.h[index(v)] + size.h[index(w)]);
    return norm(mesh.vertices[index(w)] - mesh.vertices[index(v)]) > most * h;
  };
  discrete::RefinementLimits limits{.depth = 40};
  if (options.max_triangles > 0) limits.triangles = options.max_triangles;
  const RefinedMesh given = unrefined(surface);
  if (const double expected = expected_triangles(given, sizes.at_vertices(given, monitor));
      expected > static_cast<double>(limits.triangles))
    refuse_triangles({}, expected, limits.triangles);
  return refine(surface, wish, limits, monitor);
}

SurfaceMesh start_mesh(const Model& model, const discrete::DiscreteCad& surface, const RefinedMesh& refined) {
  SurfaceMesh mesh;
  mesh.vertices = refined.vertices;
  mesh.vertex_ref.assign(mesh.vertices.size(), 0);
  std::int32_t number = 0;
  for (const std::int32_t v : surface.discrete().lines().corners) mesh.vertex_ref[index(v)] = ++number;
  std::map<int, std::size_t> rank;
  for (const Face& face : model.faces) {
    rank[face.ref] = mesh.faces.size();
    FaceMesh& made = mesh.faces.emplace_back();
    made.ref = face.ref, made.name = face.name, made.rgb = face.rgb;
    made.status = face.discrete ? FaceStatus::meshed : FaceStatus::not_meshed;
  }
  const std::vector<std::int32_t> refs = discrete::face_refs(surface.discrete());
  // Index: vertex; the patch that met it last, and its local number there.
  std::vector<std::pair<std::int32_t, std::int32_t>> known(mesh.vertices.size(), {-1, -1});
  for (std::size_t t = 0; t < refined.triangles.size(); ++t) {
    const std::int32_t parent = refined.parent[t];
    FaceMesh& face = mesh.faces[rank.at(refs[index(parent)])];
    std::array<std::int32_t, 3> local{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t v = refined.triangles[t][k];
      auto& [patch, number_there] = known[index(v)];
      if (patch != parent) {
        patch = parent, number_there = static_cast<std::int32_t>(face.vertex.size());
        face.vertex.push_back(v);
        face.uv.push_back(surface.corner_of_tile(parent) + refined.uv[t][k]);
      }
      local[k] = number_there;
    }
    face.triangles.push_back(local);
  }
  for (const auto& line : refined.lines)
    mesh.curves.push_back({.ref = static_cast<int>(mesh.curves.size()) + 1, .vertices = line, .uses = {}});
  const auto beside = faces_beside(mesh);
  for (CurveMesh& curve : mesh.curves) curve.uses = uses_of(beside.at(mesh_edge(curve.vertices[0], curve.vertices[1])));
  mesh.independent = true;
  return mesh;
}

RemeshingFrame start_frame(const discrete::DiscreteCad& surface, const RefinedMesh& refined, const SurfaceMesh& mesh,
                           const MeshSizes& sizes, const CompositeOptions& options, Cad& cad, Monitor& monitor) {
  RemeshingFrame frame{.jets = evaluate_vertices(mesh, cad, monitor),
                       .sharp = {},
                       .charts = {},
                       .corners = surface.discrete().lines().corners,
                       .lines = {},
                       .geometry = {},
                       .everywhere = true,
                       .angle_slack = angle_slack_of(options)};
  for (std::size_t c = 0; c < mesh.curves.size(); ++c) {
    const std::vector<std::int32_t>& chain = mesh.curves[c].vertices;
    for (std::size_t k = 1; k < chain.size(); ++k) frame.sharp.push_back(mesh_edge(chain[k - 1], chain[k]));
    frame.lines.push_back({chain, std::vector<std::int32_t>(chain.size() - 1, static_cast<std::int32_t>(c))});
  }
  std::ranges::sort(frame.sharp);
  frame.charts = std::make_shared<Charts>(mesh, frame.sharp, sizes.h, metrics_of(surface, refined, mesh, sizes), monitor);
  frame.geometry = [&mesh, &cad, charts = frame.charts](const SharpLine& line) {
    return std::make_unique<PatchLine>(line, mesh, *charts, cad);
  };
  return frame;
}

}  // namespace carreau
