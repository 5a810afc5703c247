// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "gradation/place_fans.h"
#include "support/infinity.h"
#include "surface/grade/grading_work.h"
#include "surface/grade/thresholds.h"
#include "surface/sample/face_metric.h"

namespace carreau::detail {

GradingWork::GradingWork(const CurveModel& curve_model, SizeRules& size_rules,
                         const CompositeOptions& composite_options, double diag, Monitor& run_monitor)
    : model(curve_model),
      rules(size_rules),
      options(composite_options),
      monitor(run_monitor),
      by_direction(size_rules.uses_metrics()),
      largest(diag * thresholds::grade::graph_share) {
  options.check_close_edges = options.check_adjacent_edges = options.check_well_defined = 0;
}

namespace {

using thresholds::grade::graph_factor;
using thresholds::grade::graph_tolerance;
using thresholds::grade::parallel;

SizeSamples coarsened(const GradingWork& work, SizeSamples samples) {
  for (double& h : samples.h) h = std::min(graph_factor * h, work.largest);
  return samples;
}

// Sizes known between the vertices of a curve bound those at its vertices.
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

// Positions, normals and prescribed sizes; on curves those of the face count beside those of the curve, so that
// nothing jumps at its border.
void evaluate(GradingWork& work, const PatchInput& input, GradedFace& face, std::size_t first) {
  FaceMetric prescribed = unlimited_prescription_of(input, work.rules, work.monitor);
  const auto keep = [&](std::size_t v, const SurfaceJet& jet, Metric2 metric) {
    const int vertex = work.graph.places[first + v].vertex;
    const bool on_curve = v < input.domain->origin.size() && input.domain->origin[v].curve >= 0;
    if (!on_curve) work.graph.xyz[vertex] = face.xyz[v] = jet.s;
    face.normal[v] = unit(cross(jet.su, jet.sv));
    if (work.by_direction) {
      auto sizes = tangent_metric(jet, metric);
      if (!sizes) sizes = prescribed.limit(face.uv[v], jet);
      work.metric.push_back(sizes ? *sizes : TangentMetric{});
    } else if (const double h = isotropic_size(jet, metric); h > 0) {
      work.h[vertex] = std::min(work.h[vertex], h);
    }
  };
  prescribed.sample(work.model.cad, input.ref, want_position, face.uv, keep);
}

// Where the parametrisation is degenerate, the mean of the triangles around.
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

// A metric and a normal for each place.
void set_normals(GradingWork& work, const GradedFace& face, std::size_t first) {
  for (std::size_t v = 0; v < face.uv.size(); ++v) {
    const Vec3 n = work.graph.places[first + v].normal = face.normal[v];
    if (!work.by_direction) continue;
    // A pole has no directions of its own.
    TangentMetric& m = work.metric[first + v];
    if (!std::isfinite(m.h1)) {
      m.d1 = unit(cross(n, std::abs(n.x()) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0})), m.d2 = cross(n, m.d1);
      continue;
    }
    // Those of a limit lie in the tangent plane of a meridian, where what a bound says along the normal of that plane
    // would make all sizes vanish.
    const Vec3 of_limit = cross(m.d1, m.d2), near = dot(of_limit, n) < 0 ? -1 * of_limit : of_limit;
    if (dot(near, n) < parallel) m.d1 = roll(m.d1, near, n), m.d2 = roll(m.d2, near, n);
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
      const int at = static_cast<int>(work.place_of[f]) + v;
      if (work.by_direction)
        work.metric_sources.push_back({at, s.sizes, way});
      else
        work.sources.push_back({at, {s.h, -1 * way}});
    }
  }
}

void add_face(GradingWork& work, std::size_t f, const SizeLimits& limits) {
  const FaceDomain& domain = *work.domains.domain[f];
  PatchInput input{.face = static_cast<int>(f),
                   .ref = work.model.model.faces[f].ref,
                   .domain = &domain,
                   .curve_xyz = positions_on_curves(domain, work.curves, work.model.topology),
                   .limits = limits,
                   .tolerance = graph_tolerance};
  PlaneMesh mesh = mesh_in_graph(work, input);
  GradedFace& face = work.faces[f];
  face.uv = std::move(mesh.vertices);
  face.triangles = std::move(mesh.triangles);
  face.xyz = std::move(input.curve_xyz);
  face.xyz.resize(face.uv.size());
  face.normal.resize(face.uv.size());
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
  evaluate(work, input, face, first);
  mend_normals(face);
  set_normals(work, face, first);
  add_triangles(work, domain, face, first);
  face.tree = TriangleTree(face.uv, face.triangles, work.monitor);
  locate_samples(work, f);
}

void add_faces(GradingWork& work, const SizeLimits& limits, const GradedModel& before) {
  work.faces.resize(work.model.model.faces.size());
  work.place_of.resize(work.faces.size());
  work.samples.resize(work.faces.size());
  work.missed = before.missed;
  work.missed.resize(work.faces.size());
  for (std::size_t f = 0; f < work.faces.size(); ++f) {
    work.monitor.checkpoint();
    work.place_of[f] = work.graph.places.size();
    if (!work.domains.domain[f]) continue;
    try {
      add_face(work, f, limits);
    } catch (const DomainError&) {
      work.faces[f] = {};  // it will fail again, and then say so
      work.samples[f].clear();
    } catch (const UnevenSpeed&) {
      work.faces[f] = {};  // sizes grow inside it by its own control space alone
      work.samples[f].clear();
    }
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
  separate_coincident_curves(work.model, work.curves);
  work.domains = refine_domains(work.model, work.rules, work.options, limits, {}, work.curves, work.monitor);
  number_vertices(work, raw);
  add_faces(work, limits, before);
  work.prescribed = work.metric;
  work.prescribed_h = work.h;
  if (!work.by_direction) return;
  work.places_of.resize(work.graph.xyz.size());
  for (std::size_t p = 0; p < work.graph.places.size(); ++p)
    work.places_of[work.graph.places[p].vertex].push_back(static_cast<int>(p));
}

}  // namespace carreau::detail
