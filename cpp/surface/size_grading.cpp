#include "surface/size_grading.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "curve/unit_discretisation.h"
#include "size/proximity.h"
#include "surface/boundary_refinement.h"
#include "surface/face_mesher.h"

namespace carreau {

namespace {

// Sizes of the graph over the prescribed ones; its longest edges where these are large, as a share of diag.
constexpr double graph_factor = 2, graph_share = 1. / 20;
// The graph is too coarse where an edge is longer than this, in unit edges of the graded sizes.
constexpr double too_long = 3.2;
constexpr int most_rounds = 5;
// Prescribed sizes are smooth where they are what linear interpolation in the graph promises, up to this share.
constexpr double roughness = 0.01;
constexpr double rough_metric = 0.1;
constexpr std::size_t most_tips = 50;
// Of sizes along curves, which are interpolated between samples.
constexpr double interpolation_error = 0.02;
// Of its control spaces: sizes and positions are asked at its vertices again.
constexpr double graph_tolerance = 0.1;
// Samples of a curve's sizes on each of its edges in the graph.
constexpr int samples_per_edge = 4;
constexpr std::size_t batch = 512;
constexpr double infinity = std::numeric_limits<double>::infinity();

Vec3 unit(Vec3 v) noexcept {
  const double l = norm(v);
  return l > 0 ? (1 / l) * v : Vec3{};
}

/// What the host has said at a place of a face.
struct Sample {
  Vec2 uv;
  Vec3 xyz;
  double h = 0;
  TangentMetric sizes{};  // instead of h where sizes differ by direction
  std::int32_t triangle = 0;
  std::array<double, 3> promised{};  // weights of its corners
};

/// One graph: curves, domains and plane meshes of all faces.
class Round {
 public:
  Round(const CurveModel& model, SizeRules& rules, const CompositeOptions& options, double diag, Monitor& monitor)
      : model_(model),
        rules_(rules),
        options_(options),
        monitor_(monitor),
        metrics_(rules.uses_metrics()),
        largest_(diag * graph_share) {
    options_.check_close_edges = options_.check_adjacent_edges = options_.check_well_defined = 0;
  }

  /// `raw`: prescribed sizes of the curves; `before`: what the graph is made with.
  GradedModel run(const std::vector<SizeSamples>& raw, const GradedModel& before) {
    const SizeLimits limits{before.field.get(), graph_factor, largest_};
    for (std::size_t c = 0; c < raw.size(); ++c) {
      monitor_.checkpoint();
      const SizeSamples coarse = coarsened(before.curves.empty() ? raw[c] : before.curves[c]);
      curves_.push_back(discretise_curve(model_, static_cast<int>(c), rules_, {.lss = options_.lss, .known = &coarse}));
    }
    separate_coincident_curves(model_, curves_);
    domains_ = refine_domains(model_, rules_, options_, limits, curves_, monitor_);
    number_vertices(raw);
    faces_.resize(model_.model.faces.size());
    place_of_.resize(faces_.size());
    samples_.resize(faces_.size());
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      monitor_.checkpoint();
      if (!domains_.domain[f]) continue;
      try {
        add_face(f, limits);
      } catch (const DomainError&) {
        faces_[f] = {};  // it will fail again, and then say so
        samples_[f].clear();
      }
    }
    prescribed_ = metric_;
    if (options_.proximity > 0) bound_narrow_zones();
    return metrics_ ? grade_by_direction(raw) : grade(raw);
  }

  /// Edges of the graph that are too long for the graded sizes.
  [[nodiscard]] std::size_t long_edges() const noexcept { return long_edges_; }

 private:
  [[nodiscard]] SizeSamples coarsened(SizeSamples samples) const {
    for (double& h : samples.h) h = std::min(graph_factor * h, largest_);
    return samples;
  }

  // Corners first, then the other vertices of the curves.
  void number_vertices(const std::vector<SizeSamples>& raw) {
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
  void lower_by_samples(std::size_t c, const SizeSamples& raw, const std::vector<int>& nodes) {
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

  void add_face(std::size_t f, const SizeLimits& limits) {
    const FaceDomain& domain = *domains_.domain[f];
    PatchInput input{.face = static_cast<int>(f),
                     .ref = model_.model.faces[f].ref,
                     .domain = &domain,
                     .curve_xyz = positions_on_curves(domain, curves_, model_.topology),
                     .limits = limits,
                     .tolerance = graph_tolerance};
    const ControlSpace space = sample(input);
    PlaneMesh mesh = mesh_plane(domain.plane, space,
                                {.frontal = options_.frontal, .max_triangles = options_.max_triangles}, monitor_);
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
    place_of_[f] = first;
    evaluate(input, face, first);
    mend_normals(face, first);
    add_triangles(domain, face, first);
    face.tree = TriangleTree(face.uv, face.triangles, monitor_);
    locate_samples(f);
  }

  // Samples are sources for the corners of the triangles around them.
  void locate_samples(std::size_t f) {
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

  // Where some size is another vertex's, or some sample not what the corners of its triangle make of it, the
  // prescribed sizes do not obey the gradation.
  void find_rough(GradedFace& face, const std::vector<Sample>& samples) const {
    for (std::size_t t = 0; t < face.triangles.size(); ++t)
      for (const std::int32_t v : face.triangles[t])
        if (dot(face.front[v].line, face.front[v].line) > 0) face.smooth[t] = 0;
    for (const Sample& s : samples) {
      double linear = 0;
      for (int i = 0; i < 3; ++i) linear += s.promised[i] * face.h[face.triangles[s.triangle][i]];
      if (std::abs(linear - s.h) > roughness * s.h) face.smooth[s.triangle] = 0;
    }
    widen_rough(face);
  }

  // Nor do they beside: samples are few.
  static void widen_rough(GradedFace& face) {
    std::vector<char> beside(face.uv.size(), 0);
    for (std::size_t t = 0; t < face.triangles.size(); ++t)
      if (face.smooth[t] == 0)
        for (const std::int32_t v : face.triangles[t]) beside[v] = 1;
    for (std::size_t t = 0; t < face.triangles.size(); ++t)
      for (const std::int32_t v : face.triangles[t])
        if (beside[v] != 0) face.smooth[t] = 0;
  }

  // The graph's own control space; what the host says meanwhile is kept.
  ControlSpace sample(const PatchInput& input) {
    FaceMetric prescribed(input.face, rules_, input.domain->plane, input.domain->physical, monitor_);
    std::vector<Sample>& samples = samples_[input.face];
    std::vector<SurfaceJet> jets;
    const MetricSampler sampler = [&](std::span<const Vec2> uv, std::span<Metric2> metric) {
      jets.resize(uv.size());
      model_.cad.surface(input.ref, want_position | prescribed.wants(), uv, jets);
      prescribed.at(uv, jets, metric);
      for (std::size_t i = 0; i < uv.size(); ++i) keep_sample(uv[i], jets[i], metric[i], samples);
      if (metrics_)
        apply_metric_limits(input.limits, input.face, uv, jets, metric);
      else
        apply_limits(input.limits, input.face, uv, jets, metric);
    };
    ControlSpaceOptions options;
    options.tolerance = input.tolerance;
    return ControlSpace::build(sampled_domain(input.domain->plane), sampler, options, monitor_);
  }

  void keep_sample(Vec2 uv, const SurfaceJet& jet, Metric2 metric, std::vector<Sample>& samples) const {
    if (!metrics_) {
      if (const double h = isotropic_size(jet, metric); h > 0) samples.push_back({uv, jet.s, h});
    } else if (const auto sizes = tangent_metric(jet, metric)) {
      samples.push_back({uv, jet.s, 0, *sizes});
    }
  }

  // Positions, normals and prescribed sizes; on curves those of the face count beside those of the curve, so that
  // nothing jumps at its border.
  void evaluate(const PatchInput& input, GradedFace& face, std::size_t first) {
    FaceMetric metric(input.face, rules_, input.domain->plane, input.domain->physical, monitor_);
    std::vector<SurfaceJet> jets(batch);
    std::vector<Metric2> metrics(batch);
    const std::span<const Vec2> all = face.uv;
    for (std::size_t i = 0; i < all.size(); i += batch) {
      monitor_.checkpoint();
      const std::size_t n = std::min(batch, all.size() - i);
      const std::span<SurfaceJet> jet(jets.data(), n);
      model_.cad.surface(input.ref, want_position | metric.wants(), all.subspan(i, n), jet);
      metric.at(all.subspan(i, n), jet, {metrics.data(), n});
      for (std::size_t k = 0; k < n; ++k) {
        const std::size_t v = i + k;
        const int vertex = graph_.places[first + v].vertex;
        const bool on_curve = v < input.domain->origin.size() && input.domain->origin[v].curve >= 0;
        if (!on_curve) graph_.xyz[vertex] = face.xyz[v] = jet[k].s;
        face.normal[v] = unit(cross(jet[k].su, jet[k].sv));
        if (metrics_) {
          const auto sizes = tangent_metric(jet[k], metrics[k]);
          metric_.push_back(sizes ? *sizes : TangentMetric{});
        } else if (const double h = isotropic_size(jet[k], metrics[k]); h > 0) {
          h_[vertex] = std::min(h_[vertex], h);
        }
      }
    }
  }

  // Where the parametrisation is degenerate, the mean of the triangles around.
  static void mend_normals(GradedFace& face, std::size_t) {
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

  void add_triangles(const FaceDomain& domain, GradedFace& face, std::size_t first) {
    const auto place = [first](std::int32_t v) { return static_cast<int>(first) + v; };
    for (std::size_t v = 0; v < face.uv.size(); ++v) {
      const Vec3 n = graph_.places[first + v].normal = face.normal[v];
      if (!metrics_) continue;
      // A pole has no directions of its own.
      TangentMetric& m = metric_[first + v];
      if (!std::isfinite(m.h1))
        m.d1 = unit(cross(n, std::abs(n.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0})), m.d2 = cross(n, m.d1);
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

  // A vertex that is the source of all its neighbours.
  static void find_tips(GradedFace& face) {
    std::vector<char> tip(face.uv.size(), 1);
    for (const auto& t : face.triangles)
      for (int i = 0; i < 3; ++i)
        for (int k = 1; k < 3; ++k) {
          const std::int32_t v = t[i], w = t[(i + k) % 3];
          const GradationFront& f = face.front[w];
          if (dot(f.line, f.line) == 0 || f.source_h != face.h[v]) tip[v] = 0;
        }
    for (std::size_t v = 0; v < tip.size() && face.tips.size() < most_tips; ++v)
      if (tip[v] != 0) face.tips.push_back(face.uv[v]);
  }

  GradedModel grade(const std::vector<SizeSamples>& raw) {
    const double slope = slope_of_gradation(options_.gradation);
    const GradationFronts fronts = grade_fronts(graph_, h_, sources_, slope, monitor_);
    for (const auto& t : graph_.triangles)
      for (int i = 0; i < 3; ++i) {
        const int a = graph_.places[t[i]].vertex, b = graph_.places[t[(i + 1) % 3]].vertex;
        long_edges_ += normalised_length(SizeLaw::linear, fronts.h[a], fronts.h[b],
                                         norm(graph_.xyz[a] - graph_.xyz[b])) > too_long;
      }
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      for (std::size_t v = 0; v < faces_[f].uv.size(); ++v) {
        faces_[f].front.push_back(fronts.front[place_of_[f] + v]);
        faces_[f].h.push_back(fronts.h[graph_.places[place_of_[f] + v].vertex]);
      }
      find_rough(faces_[f], samples_[f]);
      find_tips(faces_[f]);
    }
    GradedModel result;
    result.triangles = graph_.triangles.size();
    result.field = std::make_shared<GradedField>(slope, std::move(faces_));
    for (std::size_t c = 0; c < raw.size(); ++c) result.curves.push_back(bounded(c, raw[c], fronts.h, *result.field));
    return result;
  }

  // So many layers between two boundaries: a size of the gap over their number, where sizes differ by direction across
  // the gap only.
  void bound_narrow_zones() {
    if (metrics_) collect_places();
    for (const NarrowPlace& n : find_narrow_places(graph_, sides_, monitor_)) {
      const double h = n.gap / options_.proximity;
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

  GradedModel grade_by_direction(const std::vector<SizeSamples>& raw) {
    const double slope = slope_of_gradation(options_.gradation);
    collect_places();
    const std::vector<TangentMetric>& prescribed = prescribed_;
    for (std::size_t c = 0; c < raw.size(); ++c) bound_by_curve(c, raw[c]);
    bound_by_points(raw);
    metric_ = grade_metrics(graph_, std::move(metric_), metric_sources_, slope, monitor_);
    for (const auto& t : graph_.triangles)
      for (int i = 0; i < 3; ++i) {
        const Vec3 e = graph_.xyz[graph_.places[t[(i + 1) % 3]].vertex] - graph_.xyz[graph_.places[t[i]].vertex];
        const TangentMetric &p = metric_[t[i]], &q = metric_[t[(i + 1) % 3]];
        long_edges_ += normalised_length(SizeLaw::linear, p.along(unit(e)), q.along(unit(e)), norm(e)) > too_long;
      }
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const auto first = metric_.begin() + static_cast<std::ptrdiff_t>(place_of_[f]);
      faces_[f].metric.assign(first, first + static_cast<std::ptrdiff_t>(faces_[f].uv.size()));
      find_rough_metrics(faces_[f], prescribed.data() + place_of_[f], samples_[f]);
    }
    GradedModel result;
    result.triangles = graph_.triangles.size();
    result.field = std::make_shared<GradedField>(slope, std::move(faces_));
    for (std::size_t c = 0; c < raw.size(); ++c) result.curves.push_back(bounded_along(c, raw[c]));
    return result;
  }

  void collect_places() {
    if (!places_of_.empty()) return;
    places_of_.resize(graph_.xyz.size());
    for (std::size_t p = 0; p < graph_.places.size(); ++p)
      places_of_[graph_.places[p].vertex].push_back(static_cast<int>(p));
  }

  // The unit tangent of a curve at a vertex, in the tangent plane of a place.
  [[nodiscard]] Vec3 tangent(std::size_t c, std::size_t node, int place) const {
    const std::vector<Vec3>& xyz = curves_[c].xyz;
    const std::size_t last = xyz.size() - 1;
    const Vec3 chord = xyz[std::min(node + 1, last)] - xyz[node > 0 ? node - 1 : 0], n = graph_.places[place].normal;
    return unit(chord - dot(chord, n) * n);
  }

  // Sizes of curves are sizes along them.
  void bound_by_curve(std::size_t c, const SizeSamples& raw) {
    if (curves_[c].indivisible) return;
    for (std::size_t k = 0; k < curves_[c].r.size(); ++k) {
      const double h = raw.size_at(curves_[c].r[k]);
      for (const int p : places_of_[node_of_[c][k]]) {
        const Vec3 t = tangent(c, k, p);
        // What is interpolated between samples differs a little from what holds at vertices.
        if (metric_[p].along(t) > (1 + interpolation_error) * h) metric_[p].bound_along(t, h);
      }
    }
  }

  // A point that is smaller than its curves has a size of its own.
  void bound_by_points(const std::vector<SizeSamples>& raw) {
    std::vector<double> of_curves(model_.topology.points.size(), infinity);
    for (std::size_t c = 0; c < raw.size(); ++c) {
      if (curves_[c].indivisible) continue;
      const Curve& curve = model_.topology.curves[c];
      of_curves[curve.end1] = std::min(of_curves[curve.end1], raw[c].h.front());
      of_curves[curve.end2] = std::min(of_curves[curve.end2], raw[c].h.back());
    }
    for (std::size_t v = 0; v < of_curves.size(); ++v) {
      const double h = rules_.at_point(static_cast<int>(v));
      if (h > (1 - interpolation_error) * of_curves[v]) continue;
      for (const int p : places_of_[v]) {
        metric_[p].h1 = std::min(metric_[p].h1, h);
        metric_[p].h2 = std::min(metric_[p].h2, h);
      }
    }
  }

  // As find_rough().
  static void find_rough_metrics(GradedFace& face, const TangentMetric* prescribed,
                                 const std::vector<Sample>& samples) {
    const auto less = [](double p, double q) { return p < (1 - roughness) * q; };
    for (std::size_t t = 0; t < face.triangles.size(); ++t)
      for (const std::int32_t v : face.triangles[t])
        if (less(face.metric[v].h1, prescribed[v].h1) || less(face.metric[v].h2, prescribed[v].h2)) face.smooth[t] = 0;
    for (const Sample& s : samples) {
      double h1 = 0, h2 = 0;
      for (int i = 0; i < 3; ++i) {
        const TangentMetric& corner = face.metric[face.triangles[s.triangle][i]];
        h1 += s.promised[i] * corner.nearest(s.sizes.d1);
        h2 += s.promised[i] * corner.nearest(s.sizes.d2);
      }
      if (less(s.sizes.h1, (1 - rough_metric) * h1) || less(s.sizes.h2, (1 - rough_metric) * h2))
        face.smooth[s.triangle] = 0;
    }
    widen_rough(face);
  }

  [[nodiscard]] SizeSamples bounded_along(std::size_t c, const SizeSamples& raw) const {
    const DiscreteCurve& d = curves_[c];
    SizeSamples result;
    std::vector<double> h;
    for (std::size_t k = 0; k < d.r.size(); ++k) {
      h.push_back(raw.size_at(d.r[k]));
      if (d.indivisible) continue;
      for (const int p : places_of_[node_of_[c][k]]) h.back() = std::min(h.back(), metric_[p].along(tangent(c, k, p)));
    }
    const auto add = [&](double r, double size) {
      result.r.push_back(r);
      result.h.push_back(std::min(size, raw.size_at(r)));
      result.physical.push_back(raw.physical_at(r));
    };
    for (std::size_t k = 0; k + 1 < d.r.size(); ++k) {
      add(d.r[k], h[k]);
      if (d.indivisible) continue;
      for (const double r : between(d.r[k], d.r[k + 1], raw.r))
        add(r, std::lerp(h[k], h[k + 1], (r - d.r[k]) / (d.r[k + 1] - d.r[k])));
    }
    add(d.r.back(), h.back());
    return result;
  }

  // Sizes along a curve, between the graded ones at its vertices in the graph.
  [[nodiscard]] SizeSamples bounded(std::size_t c, const SizeSamples& raw, const std::vector<double>& h,
                                    const GradedField& field) const {
    const DiscreteCurve& d = curves_[c];
    const Curve& curve = model_.topology.curves[c];
    SizeSamples result;
    const auto add = [&](double r, double size) {
      result.r.push_back(r);
      result.h.push_back(size);
      result.physical.push_back(raw.physical_at(r));
    };
    for (std::size_t k = 0; k + 1 < d.r.size(); ++k) {
      const double left = h[node_of_[c][k]], right = h[node_of_[c][k + 1]];
      add(d.r[k], left);
      if (d.indivisible) continue;
      for (const double r : between(d.r[k], d.r[k + 1], raw.r)) {
        const double w = (r - d.r[k]) / (d.r[k + 1] - d.r[k]);
        double size = std::lerp(left, right, w);
        const Vec3 xyz = lerp(d.xyz[k], d.xyz[k + 1], w);
        for (std::size_t u = 0; u < curve.uses.size(); ++u)
          size = std::min(
              size, field.size(curve.uses[u].face, lerp(d.uv_of_use[u][k], d.uv_of_use[u][k + 1], w), xyz, infinity));
        add(r, size);
      }
    }
    add(d.r.back(), h[node_of_[c].back()]);
    return result;
  }

  // Where the sizes of a curve are sampled inside an edge of the graph: at equal distances and where they are known.
  static std::vector<double> between(double from, double to, const std::vector<double>& known) {
    std::vector<double> at;
    for (int i = 1; i < samples_per_edge; ++i)
      at.push_back(std::lerp(from, to, static_cast<double>(i) / samples_per_edge));
    const double least = 1e-6 * (to - from);
    for (const double r : known)
      if (r > from + least && r < to - least) at.push_back(r);
    std::sort(at.begin(), at.end());
    at.erase(std::unique(at.begin(), at.end(), [least](double p, double q) { return q - p < least; }), at.end());
    return at;
  }

  const CurveModel& model_;
  SizeRules& rules_;
  CompositeOptions options_;
  Monitor& monitor_;
  bool metrics_;  // sizes may differ by direction
  double largest_;
  std::vector<DiscreteCurve> curves_;
  RefinedDomains domains_;
  GradationGraph graph_;
  std::vector<double> h_;                  // prescribed at the vertices of the graph
  std::vector<std::vector<int>> node_of_;  // [curve][node]: vertex of the graph
  std::vector<GradedFace> faces_;
  std::vector<std::size_t> place_of_;  // first place of a face
  std::vector<std::vector<Sample>> samples_;
  std::vector<GradationSource> sources_;
  std::vector<TangentMetric> metric_;      // of places, where sizes differ by direction
  std::vector<TangentMetric> prescribed_;  // before any bound
  std::vector<MetricSource> metric_sources_;
  std::vector<std::uint8_t> sides_;          // of the graph's triangles: those on curves
  std::vector<std::vector<int>> places_of_;  // of vertices
  std::size_t long_edges_ = 0;
};

}  // namespace

GradedModel grade_model(const CurveModel& model, SizeRules& rules, const CompositeOptions& options, double diag,
                        Monitor& monitor) {
  std::vector<SizeSamples> raw;
  for (std::size_t c = 0; c < model.topology.curves.size(); ++c) {
    monitor.checkpoint();
    raw.push_back(sample_sizes(model, static_cast<int>(c), rules, {.lss = options.lss}));
  }
  GradedModel graded;
  std::size_t long_before = SIZE_MAX;
  double triangles_before = 0;
  for (int round = 1; round <= most_rounds; ++round) {
    Round next(model, rules, options, diag, monitor);
    graded = next.run(raw, graded);
    graded.rounds = round;
    // Those of a pole stay.
    const double change = static_cast<double>(graded.triangles) / std::max(triangles_before, 1.) - 1;
    if (next.long_edges() == 0 || (std::abs(change) < 0.1 && 2 * next.long_edges() > long_before)) break;
    long_before = next.long_edges();
    triangles_before = static_cast<double>(graded.triangles);
  }
  return graded;
}

}  // namespace carreau
