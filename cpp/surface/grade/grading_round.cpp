#include "surface/grade/grading_round.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "gradation/facing.h"
#include "gradation/place_fans.h"
#include "gradation/proximity.h"
#include "plane/plane_mesher.h"
#include "surface/lift/lift.h"
#include "surface/lift/steep_places.h"
#include "surface/sample/face_metric.h"

namespace carreau::detail {

namespace {

// Sizes of the graph over the prescribed ones; its longest edges where these are large, as a share of diag.
constexpr double graph_factor = 2, graph_share = 1. / 20;
// Of its control spaces: sizes and positions are asked at its vertices again.
constexpr double graph_tolerance = 0.1;
// Least cosine of normals that differ by rounding.
constexpr double parallel = 1 - 1e-9;

}  // namespace

GradingRound::GradingRound(const CurveModel& model, SizeRules& rules, const CompositeOptions& options, double diag,
                           Monitor& monitor)
    : model_(model),
      rules_(rules),
      options_(options),
      monitor_(monitor),
      metrics_(rules.uses_metrics()),
      largest_(diag * graph_share) {
  options_.check_close_edges = options_.check_adjacent_edges = options_.check_well_defined = 0;
}

GradedModel GradingRound::run(const std::vector<SizeSamples>& raw, const GradedModel& before) {
  const SizeLimits limits{before.field.get(), graph_factor, largest_};
  for (std::size_t c = 0; c < raw.size(); ++c) {
    monitor_.checkpoint();
    const SizeSamples coarse = coarsened(before.curves.empty() ? raw[c] : before.curves[c]);
    curves_.push_back(discretise_curve(model_, static_cast<int>(c), rules_, {.lss = options_.lss, .known = &coarse}));
  }
  separate_coincident_curves(model_, curves_);
  domains_ = refine_domains(model_, rules_, options_, limits, {}, curves_, monitor_);
  number_vertices(raw);
  faces_.resize(model_.model.faces.size());
  place_of_.resize(faces_.size());
  samples_.resize(faces_.size());
  missed_ = before.missed;
  missed_.resize(faces_.size());
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    monitor_.checkpoint();
    place_of_[f] = graph_.places.size();
    if (!domains_.domain[f]) continue;
    try {
      add_face(f, limits);
    } catch (const DomainError&) {
      faces_[f] = {};  // it will fail again, and then say so
      samples_[f].clear();
    } catch (const UnevenSpeed&) {
      faces_[f] = {};  // sizes grow inside it by its own control space alone
      samples_[f].clear();
    }
  }
  prescribed_ = metric_;
  prescribed_h_ = h_;
  if (options_.proximity > 0) {
    bound_narrow_zones();
    bound_facing_faces();
  }
  GradedModel result = metrics_ ? grade_by_direction(raw) : grade(raw);
  result.missed = std::move(missed_);
  return result;
}

SizeSamples GradingRound::coarsened(SizeSamples samples) const {
  for (double& h : samples.h) h = std::min(graph_factor * h, largest_);
  return samples;
}

// Corners first, then the other vertices of the curves.
void GradingRound::number_vertices(const std::vector<SizeSamples>& raw) {
  const Topology& topology = model_.topology;
  for (std::size_t p = 0; p < topology.points.size(); ++p) {
    graph_.xyz.push_back(topology.points[p].position);
    h_.push_back(rules_.at_point(static_cast<int>(p)));
  }
  for (std::size_t c = 0; c < curves_.size(); ++c) {
    const Curve& curve = topology.curves[c];
    h_[curve.end1] = std::min(h_[curve.end1], raw[c].h.front());
    h_[curve.end2] = std::min(h_[curve.end2], raw[c].h.back());
    std::vector<int> nodes{curve.end1};
    for (std::size_t i = 1; i + 1 < curves_[c].r.size(); ++i) {
      nodes.push_back(static_cast<int>(graph_.xyz.size()));
      graph_.xyz.push_back(curves_[c].xyz[i]);
      h_.push_back(raw[c].size_at(curves_[c].r[i]));
    }
    nodes.push_back(curve.end2);
    if (!curve.degenerate) lower_by_samples(c, raw[c], nodes);
    if (!curve.degenerate)
      for (std::size_t i = 1; i < nodes.size(); ++i) graph_.segments.push_back({nodes[i - 1], nodes[i]});
    node_of_.push_back(std::move(nodes));
  }
}

// Sizes known between the vertices of a curve bound those at its vertices.
void GradingRound::lower_by_samples(std::size_t c, const SizeSamples& raw, const std::vector<int>& nodes) {
  const DiscreteCurve& d = curves_[c];
  const double length = model_.length(static_cast<int>(c)), slope = slope_of_gradation(options_.gradation);
  for (std::size_t i = 0; i < raw.r.size(); ++i) {
    const auto above = std::upper_bound(d.r.begin() + 1, d.r.end() - 1, raw.r[i]);
    const auto k = static_cast<std::size_t>(above - d.r.begin()) - 1;
    for (const std::size_t n : {k, k + 1}) {
      double& h = h_[nodes[n]];
      h = std::min(h, raw.h[i] + slope * length * std::abs(raw.r[i] - d.r[n]));
    }
  }
}

void GradingRound::add_face(std::size_t f, const SizeLimits& limits) {
  const FaceDomain& domain = *domains_.domain[f];
  PatchInput input{.face = static_cast<int>(f),
                   .ref = model_.model.faces[f].ref,
                   .domain = &domain,
                   .curve_xyz = positions_on_curves(domain, curves_, model_.topology),
                   .limits = limits,
                   .tolerance = graph_tolerance};
  PlaneMesh mesh = mesh_face(input);
  GradedFace& face = faces_[f];
  face.uv = std::move(mesh.vertices);
  face.triangles = std::move(mesh.triangles);
  face.xyz = std::move(input.curve_xyz);
  face.xyz.resize(face.uv.size());
  face.normal.resize(face.uv.size());
  const std::size_t first = graph_.places.size(), imposed = domain.origin.size();
  for (std::size_t v = 0; v < face.uv.size(); ++v) {
    const DomainVertexOrigin origin = v < imposed ? domain.origin[v] : DomainVertexOrigin{};
    const int vertex = origin.corner >= 0  ? origin.corner
                       : origin.curve >= 0 ? node_of_[origin.curve][origin.node]
                                           : static_cast<int>(graph_.xyz.size());
    if (origin.curve < 0) {
      graph_.xyz.emplace_back();
      h_.push_back(infinity);
    }
    graph_.places.push_back({vertex, {}});
  }
  evaluate(input, face, first);
  mend_normals(face, first);
  add_triangles(domain, face, first);
  face.tree = TriangleTree(face.uv, face.triangles, monitor_);
  locate_samples(f);
}

// Samples are sources for the corners of the triangles around them.
void GradingRound::locate_samples(std::size_t f) {
  const GradedFace& face = faces_[f];
  for (Sample& s : samples_[f]) {
    const TrianglePlace place = face.tree.find(s.uv);
    s.triangle = place.triangle;
    for (int i = 0; i < 3; ++i) {
      const std::int32_t v = face.triangles[s.triangle][i];
      s.promised[i] = place.weight[i];
      const Vec3 way = step_on_surface(face.normal[v], s.xyz - face.xyz[v]);
      const int at = static_cast<int>(place_of_[f]) + v;
      if (metrics_)
        metric_sources_.push_back({at, s.sizes, way});
      else
        sources_.push_back({at, {s.h, -1 * way}});
    }
  }
}

// Where fields are known to be steep they are looked at, as in the mesh to come: sizes would grow from there within the
// face only.
PlaneMesh GradingRound::mesh_face(const PatchInput& input) {
  const PlaneMesherOptions how{.frontal = options_.frontal, .max_triangles = options_.max_triangles};
  const PlaneDomain& domain = input.domain->plane;
  std::vector<Vec2> probe_points = rules_.steep_places(input.face);
  std::vector<Vec2>& known = missed_[input.face];
  probe_points.insert(probe_points.end(), known.begin(), known.end());
  ControlSpace space = sample(input, probe_points);
  PatchMesh mesh;
  mesh.plane = mesh_plane(domain, space, how, monitor_);
  if (rules_.steep_in_space().empty()) return std::move(mesh.plane);
  lift_patch(input, model_.cad, mesh, monitor_);
  const std::vector<Vec2> missed = missed_steep_places(input, space, model_.cad, rules_, mesh, monitor_);
  if (missed.empty()) return std::move(mesh.plane);
  known.insert(known.end(), missed.begin(), missed.end());
  probe_points.insert(probe_points.end(), missed.begin(), missed.end());
  samples_[input.face].clear();
  space = sample(input, probe_points);
  return mesh_plane(domain, space, how, monitor_);
}

// The graph's own control space; what the host says meanwhile is kept.
ControlSpace GradingRound::sample(const PatchInput& input, std::span<const Vec2> probe_points) {
  FaceMetric prescribed = unlimited_prescription_of(input, rules_, monitor_);
  std::vector<Sample>& samples = samples_[input.face];
  std::vector<SurfaceJet> jets;
  SpeedWatch speeds(rules_.asks_sources() ? infinity : uneven_speed, 0);
  const MetricSampler sampler = [&](std::span<const Vec2> uv, std::span<Metric2> metric) {
    jets.resize(uv.size());
    model_.cad.surface(input.ref, want_position | prescribed.wants(), uv, jets);
    speeds.look(uv, jets);
    prescribed.at(uv, jets, metric);
    for (std::size_t i = 0; i < uv.size(); ++i) keep_sample(uv[i], jets[i], metric[i], samples);
    if (metrics_)
      apply_metric_limits(input.limits, input.face, uv, jets, metric);
    else
      apply_limits(input.limits, input.face, uv, jets, metric);
  };
  ControlSpaceOptions options;
  options.tolerance = input.tolerance;
  options.thorough = true;
  options.probe_points = probe_points;
  return ControlSpace::build(sampled_domain(input.domain->plane), sampler, options, monitor_);
}

void GradingRound::keep_sample(Vec2 uv, const SurfaceJet& jet, Metric2 metric, std::vector<Sample>& samples) const {
  if (!metrics_) {
    if (const double h = isotropic_size(jet, metric); h > 0) samples.push_back({uv, jet.s, h});
  } else if (const auto sizes = tangent_metric(jet, metric)) {
    samples.push_back({uv, jet.s, 0, *sizes});
  }
}

// Positions, normals and prescribed sizes; on curves those of the face count beside those of the curve, so that
// nothing jumps at its border.
void GradingRound::evaluate(const PatchInput& input, GradedFace& face, std::size_t first) {
  FaceMetric prescribed = unlimited_prescription_of(input, rules_, monitor_);
  const auto keep = [&](std::size_t v, const SurfaceJet& jet, Metric2 metric) {
    const int vertex = graph_.places[first + v].vertex;
    const bool on_curve = v < input.domain->origin.size() && input.domain->origin[v].curve >= 0;
    if (!on_curve) graph_.xyz[vertex] = face.xyz[v] = jet.s;
    face.normal[v] = unit(cross(jet.su, jet.sv));
    if (metrics_) {
      auto sizes = tangent_metric(jet, metric);
      if (!sizes) sizes = prescribed.limit(face.uv[v], jet);
      metric_.push_back(sizes ? *sizes : TangentMetric{});
    } else if (const double h = isotropic_size(jet, metric); h > 0) {
      h_[vertex] = std::min(h_[vertex], h);
    }
  };
  prescribed.sample(model_.cad, input.ref, want_position, face.uv, keep);
}

// Where the parametrisation is degenerate, the mean of the triangles around.
void GradingRound::mend_normals(GradedFace& face, std::size_t) {
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

void GradingRound::add_triangles(const FaceDomain& domain, GradedFace& face, std::size_t first) {
  const auto place = [first](std::int32_t v) { return static_cast<int>(first) + v; };
  for (std::size_t v = 0; v < face.uv.size(); ++v) {
    const Vec3 n = graph_.places[first + v].normal = face.normal[v];
    if (!metrics_) continue;
    // A pole has no directions of its own.
    TangentMetric& m = metric_[first + v];
    if (!std::isfinite(m.h1)) {
      m.d1 = unit(cross(n, std::abs(n.x()) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0})), m.d2 = cross(n, m.d1);
      continue;
    }
    // Those of a limit lie in the tangent plane of a meridian, where what a bound says along the normal of that plane
    // would make all sizes vanish.
    const Vec3 of_limit = cross(m.d1, m.d2), near = dot(of_limit, n) < 0 ? -1 * of_limit : of_limit;
    if (dot(near, n) < parallel) m.d1 = roll(m.d1, near, n), m.d2 = roll(m.d2, near, n);
  }
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
      flat = flat || graph_.places[place(a)].vertex == graph_.places[place(b)].vertex;
      if (a < n && b < n &&
          std::binary_search(imposed.begin(), imposed.end(), std::array<int, 2>{std::min(a, b), std::max(a, b)}))
        sides = static_cast<std::uint8_t>(sides | 1 << i);
    }
    face.smooth.push_back(1);
    face.on_curve.push_back(sides);
    if (flat) continue;
    graph_.triangles.push_back({place(t[0]), place(t[1]), place(t[2])});
    sides_.push_back(sides);
  }
}

// So many layers n between two boundaries, where sizes differ by direction across the gap only. Edges of a unit mesh
// are up to sqrt(2) sizes long: a way of n - 1 of them does not cross the gap if (n - 1) sqrt(2) h is less than it. Up
// to three layers a size of gap / n is enough.
void GradingRound::bound_narrow_zones() {
  const double layers = options_.proximity, share = 1 / std::max(layers, (layers - 1) * std::numbers::sqrt2);
  if (metrics_) collect_places();
  std::vector<double> wanted = h_;  // diag where nothing is known
  for (double& h : wanted) h = std::min(h, largest_ / graph_share);
  for (const NarrowPlace& n : find_narrow_places(graph_, sides_, wanted, monitor_)) {
    const double h = n.gap * share;
    if (!metrics_) {
      h_[n.vertex] = std::min(h_[n.vertex], h);
      continue;
    }
    for (const int p : places_of_[n.vertex]) {
      const Vec3 normal = graph_.places[p].normal, across = unit(n.across - dot(n.across, normal) * normal);
      metric_[p].bound_along(across, h);
    }
  }
}

// As many layers between two faces that face each other: a size of the gap over their number in all directions of both.
void GradingRound::bound_facing_faces() {
  std::vector<std::vector<int>> points(model_.model.faces.size());
  for (const Curve& c : model_.topology.curves)
    for (const CurveUse& use : c.uses) points[use.face].insert(points[use.face].end(), {c.end1, c.end2});
  const auto apart = [&](int p, int q) {
    const int f = face_of(p), g = face_of(q);
    if (f == g) return false;
    return std::find_first_of(points[f].begin(), points[f].end(), points[g].begin(), points[g].end()) ==
           points[f].end();
  };
  const double layers = options_.proximity;
  const auto reach = [&](int p) {
    const double h = metrics_ ? std::max(metric_[p].h1, metric_[p].h2) : h_[graph_.places[p].vertex];
    return layers * std::min(h, largest_ / graph_share);  // diag where nothing is known
  };
  for (const FacingPlace& f : find_facing_places(graph_, reach, apart, monitor_)) {
    const double h = f.gap / layers;
    // What no size that is allowed can resolve is contact.
    if (h < smallest_size()) continue;
    if (metrics_) {
      metric_[f.place].h1 = std::min(metric_[f.place].h1, h);
      metric_[f.place].h2 = std::min(metric_[f.place].h2, h);
      continue;
    }
    double& known = h_[graph_.places[f.place].vertex];
    known = std::min(known, h);
    // The other face may have no vertex near the foot.
    for (const int p : graph_.triangles[f.triangle]) {
      const Vec3 way = step_on_surface(graph_.places[p].normal, f.foot - graph_.xyz[graph_.places[p].vertex]);
      sources_.push_back({p, {h, -1 * way}});
    }
  }
}

double GradingRound::smallest_size() const {
  const SizeParameters& size = options_.size;
  if (size.physical == PhysicalSizes::ignored) return size.hgeomin;
  return size.geometric == GeometricSizes::ignored ? size.hphymin : std::min(size.hphymin, size.hgeomin);
}

// Places of a face are numbered together; a face without any has the first of the next one.
int GradingRound::face_of(int place) const {
  const auto after = std::upper_bound(place_of_.begin(), place_of_.end(), static_cast<std::size_t>(place));
  return static_cast<int>(after - place_of_.begin()) - 1;
}

}  // namespace carreau::detail
