// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "periodic/shared_curves.h"
#include "support/infinity.h"
#include "support/ranks/executor.h"
#include "support/shares.h"
#include "surface/grade/graph_sizes.h"
#include "surface/grade/thresholds.h"
#include "surface/sample/face_metric.h"

namespace carreau::detail {

GradingWork::GradingWork(const CurveModel& curve_model, SizeRules& size_rules,
                         const CompositeOptions& composite_options, double diag, Monitor& run_monitor,
                         const PeriodicModel& periodic_model)
    : model(curve_model),
      periodic(periodic_model),
      rules(size_rules),
      options(composite_options),
      monitor(run_monitor),
      largest(diag * thresholds::grade::graph_share),
      sizes(size_rules.uses_metrics() ? directional_graph_sizes(*this) : isotropic_graph_sizes(*this)) {
  options.check_close_edges = options.check_adjacent_edges = options.check_well_defined = 0;
}

GradingWork::~GradingWork() = default;

namespace {

using thresholds::grade::graph_factor;

SizeSamples coarsened(const GradingWork& work, SizeSamples samples) {
  for (double& h : samples.h) h = std::min(graph_factor * h, work.largest);
  return samples;
}

// Lowers the sizes at the vertices of a curve by the known sizes between them.
void lower_by_samples(GradingWork& work, std::size_t c, const SizeSamples& raw, const std::vector<int>& nodes) {
  const DiscreteCurve& d = work.curves[c];
  const double length = work.model.length(static_cast<int>(c)), slope = slope_of_gradation(work.options.gradation);
  for (std::size_t i = 0; i < raw.r.size(); ++i) {
    const auto above = std::upper_bound(d.r.begin() + 1, d.r.end() - 1, raw.r[i]);
    const auto k = static_cast<std::size_t>(above - d.r.begin()) - 1;
    for (const std::size_t n : {k, k + 1}) {
      double& h = work.h[nodes[n]];
      h = std::min(h, raw.h[i] + slope * length * std::abs(raw.r[i] - d.r[n]));
    }
  }
}

// Corners first, then the other vertices of the curves.
void number_vertices(GradingWork& work, const std::vector<SizeSamples>& raw) {
  const Topology& topology = work.model.topology;
  for (std::size_t p = 0; p < topology.points.size(); ++p) {
    work.graph.xyz.push_back(topology.points[p].position);
    work.h.push_back(work.rules.at_point(static_cast<int>(p)));
  }
  for (std::size_t c = 0; c < work.curves.size(); ++c) {
    const Curve& curve = topology.curves[c];
    work.h[curve.end1] = std::min(work.h[curve.end1], raw[c].h.front());
    work.h[curve.end2] = std::min(work.h[curve.end2], raw[c].h.back());
    std::vector<int> nodes{curve.end1};
    for (std::size_t i = 1; i + 1 < work.curves[c].r.size(); ++i) {
      nodes.push_back(static_cast<int>(work.graph.xyz.size()));
      work.graph.xyz.push_back(work.curves[c].xyz[i]);
      work.h.push_back(raw[c].size_at(work.curves[c].r[i]));
    }
    nodes.push_back(curve.end2);
    if (!curve.degenerate) lower_by_samples(work, c, raw[c], nodes);
    if (!curve.degenerate)
      for (std::size_t i = 1; i < nodes.size(); ++i) work.graph.segments.push_back({nodes[i - 1], nodes[i]});
    work.node_of.push_back(std::move(nodes));
  }
}

// Periodic corners and vertices of curves are one.
void join_vertices(GradingWork& work) {
  const auto join = [&](int vertex, int image, const Isometry& map) {
    work.graph.joined.push_back({vertex, image});
    work.graph.joined_by.push_back(map);
  };
  for (std::size_t c = 0; c < work.periodic.corners.size(); ++c) {
    const std::vector<int>& corners = work.periodic.corners[c];
    for (std::size_t i = 1; i < corners.size(); ++i)
      join(corners.front(), corners[i], work.periodic.corner_maps[c][i].after(work.periodic.corner_maps[c].front().inverse()));
  }
  for (const CurveClass& all : work.periodic.curves) {
    const int root = all.members.front().image.curve;
    const Curve& shape = work.model.curve(root);
    const bool closed = shape.end1 == shape.end2 && !shape.degenerate;
    for (const CurveMember& member : all.members) {
      const int c = member.image.curve;
      for (int k = 0; c != root && k < work.curves[root].segments(); ++k)
        if (const int image = vertex_image(work.curves[root], work.curves[c], member.image, closed, k); image >= 0)
          join(work.node_of[root][k], work.node_of[c][image], member.map);
    }
  }
}

// Copies positions, normals and prescribed sizes. On curves the sizes of the face count beside the size of the curve,
// so that sizes do not jump at its border.
void take_over(GradingWork& work, const FaceDomain& domain, FaceInGraph& made, GradedFace& face, std::size_t first) {
  for (std::size_t v = 0; v < face.uv.size(); ++v) {
    const int vertex = work.graph.places[first + v].vertex;
    const bool on_curve = v < domain.origin.size() && domain.origin[v].curve >= 0;
    if (!on_curve) work.graph.xyz[vertex] = face.xyz[v] = made.xyz[v];
  }
  face.normal = std::move(made.normal);
  work.sizes->add_face(made, first);
}

// Replaces normals where the parametrisation is degenerate by the mean of the triangles around.
void mend_normals(GradedFace& face) {
  std::vector<Vec3> sum(face.uv.size());
  for (const auto& t : face.triangles) {
    const Vec3 n = cross(face.xyz[t[1]] - face.xyz[t[0]], face.xyz[t[2]] - face.xyz[t[0]]);
    for (const std::int32_t v : t) sum[v] = sum[v] + n;
  }
  for (std::size_t v = 0; v < sum.size(); ++v) {
    if (!(dot(face.normal[v], face.normal[v]) > 0.5)) face.normal[v] = unit(sum[v]);
    if (!(dot(face.normal[v], face.normal[v]) > 0.5)) face.normal[v] = {0, 0, 1};
  }
}

void set_normals(GradingWork& work, const GradedFace& face, std::size_t first) {
  for (std::size_t v = 0; v < face.uv.size(); ++v) {
    work.graph.places[first + v].normal = face.normal[v];
    work.sizes->orient(first + v);
  }
}

void add_triangles(GradingWork& work, const FaceDomain& domain, GradedFace& face, std::size_t first) {
  const auto place = [first](std::int32_t v) { return static_cast<int>(first) + v; };
  std::vector<std::array<int, 2>> imposed;
  for (const PlaneEdge& e : domain.plane.edges)
    if (e.kind != PlaneEdgeKind::degenerate) imposed.push_back({std::min(e.a, e.b), std::max(e.a, e.b)});
  std::sort(imposed.begin(), imposed.end());
  const auto n = static_cast<std::int32_t>(domain.origin.size());
  for (const auto& t : face.triangles) {
    std::uint8_t sides = 0;
    bool flat = false;
    for (int i = 0; i < 3; ++i) {
      const std::int32_t a = t[i], b = t[i == 2 ? 0 : i + 1];
      flat = flat || work.graph.places[place(a)].vertex == work.graph.places[place(b)].vertex;
      if (a < n && b < n &&
          std::binary_search(imposed.begin(), imposed.end(), std::array<int, 2>{std::min(a, b), std::max(a, b)}))
        sides = static_cast<std::uint8_t>(sides | 1 << i);
    }
    face.smooth.push_back(1);
    face.on_curve.push_back(sides);
    if (flat) continue;
    work.graph.triangles.push_back({place(t[0]), place(t[1]), place(t[2])});
    work.sides.push_back(sides);
  }
}

// Samples are sources for the corners of the triangles around them.
void locate_samples(GradingWork& work, std::size_t f) {
  const GradedFace& face = work.faces[f];
  for (GradingWork::Sample& s : work.samples[f]) {
    const TrianglePlace place = face.tree.find(s.uv);
    s.triangle = place.triangle;
    for (int i = 0; i < 3; ++i) {
      const std::int32_t v = face.triangles[s.triangle][i];
      s.promised[i] = place.weight[i];
      const Vec3 way = step_on_surface(face.normal[v], s.xyz - face.xyz[v]);
      work.sizes->add_source(static_cast<int>(work.place_of[f]) + v, s, way);
    }
  }
}

PatchInput input_of(const GradingWork& work, std::size_t f, const SizeLimits& limits) {
  const FaceDomain& domain = *work.domains.domain[f];
  return {.face = static_cast<int>(f),
          .ref = work.model.model.faces[f].ref,
          .domain = &domain,
          .curve_xyz = positions_on_curves(domain, work.curves, work.model.topology),
          .isotropic = work.sizes->isotropic(),
          .limits = limits,
          .tolerance = shares::notable};
}

void add_face(GradingWork& work, std::size_t f, FaceInGraph& made) {
  const FaceDomain& domain = *work.domains.domain[f];
  GradedFace& face = work.faces[f];
  face.uv = std::move(made.mesh.vertices);
  face.triangles = std::move(made.mesh.triangles);
  face.xyz = positions_on_curves(domain, work.curves, work.model.topology);
  face.xyz.resize(face.uv.size());
  const std::size_t first = work.graph.places.size(), imposed = domain.origin.size();
  for (std::size_t v = 0; v < face.uv.size(); ++v) {
    const DomainVertexOrigin origin = v < imposed ? domain.origin[v] : DomainVertexOrigin{};
    const int vertex = origin.corner >= 0  ? origin.corner
                       : origin.curve >= 0 ? work.node_of[origin.curve][origin.node]
                                           : static_cast<int>(work.graph.xyz.size());
    if (origin.curve < 0) {
      work.graph.xyz.emplace_back();
      work.h.push_back(infinity);
    }
    work.graph.places.push_back({vertex, {}});
  }
  take_over(work, domain, made, face, first);
  mend_normals(face);
  set_normals(work, face, first);
  add_triangles(work, domain, face, first);
  face.tree = TriangleTree(face.uv, face.triangles, work.monitor);
  work.samples[f] = std::move(made.samples);
  locate_samples(work, f);
}

/// Makes the faces whose domains are valid, by the threads and processes of the run.
std::vector<FaceInGraph> make_faces(const GradingWork& work, const std::vector<std::size_t>& which, const SizeLimits& limits) {
  const auto make = [&](std::size_t i, Monitor& monitor) {
    monitor.checkpoint();
    return face_in_graph(work, input_of(work, which[i], limits), monitor);
  };
  const auto put = [](PacketWriter& packet, const FaceInGraph& face) { face.put(packet); };
  const auto get = [](PacketReader& packet) { return FaceInGraph::from(packet); };
  const bool bound = !asks_from_threads(work.options, work.model.cad);
  return shared_work<FaceInGraph>(work.options.executor, "faces of a graph", which.size(), bound, make, put, get,
                                  work.monitor);
}

void add_faces(GradingWork& work, const SizeLimits& limits, const GradedModel& before) {
  work.faces.resize(work.model.model.faces.size());
  work.place_of.resize(work.faces.size());
  work.samples.resize(work.faces.size());
  work.missed = before.missed;
  work.missed.resize(work.faces.size());
  std::vector<std::size_t> which;
  for (std::size_t f = 0; f < work.faces.size(); ++f)
    if (work.domains.domain[f]) which.push_back(f);
  std::vector<FaceInGraph> made = make_faces(work, which, limits);
  for (std::size_t f = 0, i = 0; f < work.faces.size(); ++f) {
    work.monitor.checkpoint();
    work.place_of[f] = work.graph.places.size();
    if (!work.domains.domain[f]) continue;
    FaceInGraph& face = made[i++];
    work.missed[f] = std::move(face.missed);
    if (!face.mesh.triangles.empty()) add_face(work, f, face);
    face = {};
  }
}

}  // namespace

void make_graph(GradingWork& work, const std::vector<SizeSamples>& raw, const GradedModel& before) {
  const SizeLimits limits{before.field.get(), graph_factor, work.largest};
  for (std::size_t c = 0; c < raw.size(); ++c) {
    work.monitor.checkpoint();
    const SizeSamples coarse = coarsened(work, before.curves.empty() ? raw[c] : before.curves[c]);
    work.curves.push_back(
        discretise_curve(work.model, static_cast<int>(c), work.rules, {.lss = work.options.lss, .known = &coarse}));
  }
  share_vertices(work.periodic, work.model, work.curves);
  separate_coincident_curves(work.model, work.curves);
  complete_classes(work.periodic, work.model, work.curves);
  work.domains = refine_domains(work.model, work.rules, work.options, limits, {}, work.curves, work.monitor, &work.periodic);
  number_vertices(work, raw);
  join_vertices(work);
  add_faces(work, limits, before);
  work.sizes->complete();
}

}  // namespace carreau::detail
