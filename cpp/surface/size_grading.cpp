#include "surface/size_grading.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "curve/unit_discretisation.h"
#include "surface/boundary_refinement.h"
#include "surface/face_mesher.h"

namespace carreau {

namespace {

// Sizes of the graph over the prescribed ones; its longest edges where these are large, as a share of diag.
constexpr double graph_factor = 2, graph_share = 1. / 20;
// The graph is too coarse where an edge is longer than this, in unit edges of the graded sizes.
constexpr double too_long = 3.3;
constexpr int most_rounds = 5;
// Samples of a curve's sizes on each of its edges in the graph.
constexpr int samples_per_edge = 4;
constexpr std::size_t batch = 512;
constexpr double infinity = std::numeric_limits<double>::infinity();

Vec3 unit(Vec3 v) noexcept {
  const double l = norm(v);
  return l > 0 ? (1 / l) * v : Vec3{};
}

/// One graph: curves, domains and plane meshes of all faces.
class Round {
 public:
  Round(const CurveModel& model, SizeRules& rules, const CompositeOptions& options, double diag, Monitor& monitor)
      : model_(model), rules_(rules), options_(options), monitor_(monitor), largest_(diag * graph_share) {
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
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      monitor_.checkpoint();
      if (!domains_.domain[f]) continue;
      try {
        add_face(f, limits);
      } catch (const DomainError&) {
        faces_[f] = {};  // it will fail again, and then say so
      }
    }
    return grade(raw);
  }

  [[nodiscard]] bool coarse() const noexcept { return coarse_; }

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
      if (!curve.degenerate)
        for (std::size_t i = 1; i < nodes.size(); ++i) graph_.segments.push_back({nodes[i - 1], nodes[i]});
      node_of_.push_back(std::move(nodes));
    }
  }

  void add_face(std::size_t f, const SizeLimits& limits) {
    const FaceDomain& domain = *domains_.domain[f];
    PatchInput input{.face = static_cast<int>(f),
                     .ref = model_.model.faces[f].ref,
                     .domain = &domain,
                     .curve_xyz = positions_on_curves(domain, curves_, model_.topology),
                     .limits = limits};
    const ControlSpace space = sample_face(input, model_.cad, rules_, {}, monitor_);
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
        if (const double h = isotropic_size(jet[k], metrics[k]); h > 0) h_[vertex] = std::min(h_[vertex], h);
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
    for (std::size_t v = 0; v < face.uv.size(); ++v) graph_.places[first + v].normal = face.normal[v];
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
      face.on_curve.push_back(sides);
      if (!flat) graph_.triangles.push_back({place(t[0]), place(t[1]), place(t[2])});
    }
  }

  GradedModel grade(const std::vector<SizeSamples>& raw) {
    const double slope = slope_of_gradation(options_.gradation);
    GradationFronts fronts = grade_fronts(graph_, h_, slope, monitor_);
    for (const auto& t : graph_.triangles)
      for (int i = 0; i < 3 && !coarse_; ++i) {
        const int a = graph_.places[t[i]].vertex, b = graph_.places[t[(i + 1) % 3]].vertex;
        coarse_ = normalised_length(SizeLaw::linear, fronts.h[a], fronts.h[b], norm(graph_.xyz[a] - graph_.xyz[b])) >
                  too_long;
      }
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (std::size_t v = 0; v < faces_[f].uv.size(); ++v) {
        faces_[f].front.push_back(fronts.front[place_of_[f] + v]);
        faces_[f].h.push_back(fronts.h[graph_.places[place_of_[f] + v].vertex]);
      }
    GradedModel result;
    result.triangles = graph_.triangles.size();
    result.field = std::make_shared<GradedField>(slope, std::move(faces_), monitor_);
    for (std::size_t c = 0; c < raw.size(); ++c) result.curves.push_back(bounded(c, raw[c], fronts.h, *result.field));
    return result;
  }

  // Sizes along a curve, between the graded ones at its vertices in the graph.
  [[nodiscard]] SizeSamples bounded(std::size_t c, const SizeSamples& raw, const std::vector<double>& h,
                                    const GradedField& field) const {
    const DiscreteCurve& d = curves_[c];
    const Curve& curve = model_.topology.curves[c];
    SizeSamples result;
    const auto add = [&](double r, double bound) {
      result.r.push_back(r);
      result.h.push_back(std::min(raw.size_at(r), bound));
      result.physical.push_back(raw.physical_at(r));
    };
    for (std::size_t k = 0; k + 1 < d.r.size(); ++k) {
      const double left = h[node_of_[c][k]], right = h[node_of_[c][k + 1]];
      add(d.r[k], left);
      if (d.indivisible) continue;
      std::vector<double> at;
      for (int i = 1; i < samples_per_edge; ++i)
        at.push_back(std::lerp(d.r[k], d.r[k + 1], static_cast<double>(i) / samples_per_edge));
      for (const double r : raw.r)
        if (r > d.r[k] && r < d.r[k + 1]) at.push_back(r);
      std::sort(at.begin(), at.end());
      at.erase(std::unique(at.begin(), at.end(), [](double p, double q) { return q - p < 1e-9; }), at.end());
      for (const double r : at) {
        const double w = (r - d.r[k]) / (d.r[k + 1] - d.r[k]);
        if (!(w > 1e-6 && w < 1 - 1e-6)) continue;
        double bound = std::lerp(left, right, w);
        const Vec3 xyz = lerp(d.xyz[k], d.xyz[k + 1], w);
        for (std::size_t u = 0; u < curve.uses.size(); ++u)
          bound = std::min(bound, field.at(curve.uses[u].face, lerp(d.uv_of_use[u][k], d.uv_of_use[u][k + 1], w), xyz));
        add(r, bound);
      }
    }
    add(d.r.back(), h[node_of_[c].back()]);
    return result;
  }

  const CurveModel& model_;
  SizeRules& rules_;
  CompositeOptions options_;
  Monitor& monitor_;
  double largest_;
  std::vector<DiscreteCurve> curves_;
  RefinedDomains domains_;
  GradationGraph graph_;
  std::vector<double> h_;                  // prescribed at the vertices of the graph
  std::vector<std::vector<int>> node_of_;  // [curve][node]: vertex of the graph
  std::vector<GradedFace> faces_;
  std::vector<std::size_t> place_of_;  // first place of a face
  bool coarse_ = false;
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
  for (int round = 1; round <= most_rounds; ++round) {
    Round next(model, rules, options, diag, monitor);
    graded = next.run(raw, graded);
    graded.rounds = round;
    if (!next.coarse()) break;
  }
  return graded;
}

}  // namespace carreau
