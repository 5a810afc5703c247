// SPDX-License-Identifier: BSD-3-Clause
#include "variable/remesh.h"

#include <algorithm>
#include <numbers>
#include <optional>

#include "gradation/gradation.h"
#include "plane/plane_mesher.h"
#include "support/segment.h"
#include "support/work_bounds.h"
#include "variable/base/erosion.h"
#include "variable/base/thresholds.h"
#include "variable/boundary/boundary_cut.h"
#include "variable/self_overlap.h"
#include "variable/transfer/piece_transfer.h"

namespace carreau::variable {

namespace {

double area_of(const std::vector<BoundaryLoop>& loops) {
  double sum = 0;
  for (const BoundaryLoop& loop : loops)
    for (std::size_t i = 0; i < loop.size(); ++i) sum += cross(loop.nodes[i].point, loop.nodes[loop.after(i)].point);
  return sum / 2;
}

/// The area inside the curves, by polygons of `pieces` edges for each of their edges.
double area_of(const std::vector<BoundaryShape>& shapes, int pieces) {
  double sum = 0;
  for (const BoundaryShape& shape : shapes)
    for (const RunCurve& curve : shape.curves)
      for (std::size_t k = 0; k < curve.edges(); ++k)
        for (int i = 0; i < pieces; ++i)
          sum += cross(curve.at(k, double(i) / pieces), curve.at(k, double(i + 1) / pieces));
  return sum / 2;
}

/// One increment, step by step (HDR sec. 3.4.1).
class Remeshing {
 public:
  Remeshing(const RemeshInput& input, Monitor& monitor)
      : in_(input), monitor_(monitor), slope_(slope_of_gradation(input.gradation)) {}

  RemeshResult run() {
    tools_ = Tools(in_.tools);
    damage_ = in_.damage;
    erode_piece();
    if (in_.remove_overlaps) remove_overlaps();
    search_ = TriangleSearch(in_space(eroded_.piece.vertices), eroded_.piece.triangles, &monitor_);
    tell_erosion();
    mesh_at_the_most_faithful_boundary();
    transfer();
    return std::move(result_);
  }

 private:
  void erode_piece() { eroded_ = erode(in_.piece, damage_, in_.damage_limit, in_.keep_all_parts, in_.vertex_kinds); }

  /// Overlapping elements are removed as damaged ones are; the elements that they bare may overlap, too.
  void remove_overlaps() {
    for (int round = 0; round < work_bounds::passes; ++round) {
      const std::vector<std::int32_t> found = crossing_triangles(eroded_);
      if (found.empty()) return;
      damage_.resize(in_.piece.triangles.size(), 0);
      for (const std::int32_t t : found)
        damage_[static_cast<std::size_t>(eroded_.triangle_of[static_cast<std::size_t>(t)])] = 1;
      result_.summary.overlapping += static_cast<std::int64_t>(found.size());
      erode_piece();
    }
  }

  void tell_erosion() {
    RemeshSummary& told = result_.summary;
    told.damaged = eroded_.damaged - told.overlapping, told.at_multiple_vertices = eroded_.at_multiple_vertices;
    told.dangling = eroded_.dangling, told.in_parts = eroded_.in_parts;
    told.parts_found = eroded_.parts_found, told.parts_kept = eroded_.parts_kept;
    told.area_given = in_.piece.area(), told.area_removed = eroded_.removed_area;
  }

  /// Splines and moved nodes may cross near edges; the piece's own boundary does not.
  void mesh_at_the_most_faithful_boundary() {
    Faithfulness how = Faithfulness::smooth;
    while (true) {
      try {
        mesh(how);
        result_.summary.boundary = how;
        return;
      } catch (const DomainError& error) {
        if (how == Faithfulness::as_given) throw;
        how = error.where().uv && add_rough_place(*error.where().uv) ? Faithfulness::partly
              : how < Faithfulness::kept                             ? Faithfulness::kept
                                                                     : Faithfulness::as_given;
      }
    }
  }
  bool add_rough_place(const Vec2& p) {
    if (rough_.size() >= thresholds::variable::max_rough_places) return false;
    const bool known = std::any_of(rough_.begin(), rough_.end(), [&](const Vec2& q) { return p == q; });
    if (!known) rough_.push_back(p);
    return !known;
  }
  /// Does the run pass a rough place within the length of its edge there?
  [[nodiscard]] bool is_rough(const BoundaryLoop& loop, const BoundaryRun& run) const {
    for (const Vec2& p : rough_)
      for (std::size_t k = 0; k < run.count; ++k) {
        const std::size_t i = (run.first + k) % loop.size();
        const Vec2 a = loop.nodes[i].point, b = loop.nodes[loop.after(i)].point;
        if (distance_to_segment(p, a, b) <= std::max(norm(b - a), in_.h_min)) return true;
      }
    return false;
  }

  std::vector<BoundaryShape> shapes_of(Faithfulness how) {
    std::vector<BoundaryLoop> loops = boundary_of(eroded_);
    const double before = area_of(loops);
    if (how != Faithfulness::as_given)
      bind_to_tools(loops, tools_, {in_.step, in_.reach < 0 ? in_.step : in_.reach}, in_.h_min);
    std::vector<BoundaryShape> shapes(loops.size());
    for (std::size_t l = 0; l < loops.size(); ++l) {
      if (how < Faithfulness::kept) {
        smooth_imposed(loops[l], in_.imposed_smoothing);
        cut_tips(loops[l], tools_, in_.h_min);
        join_close_ends(loops[l], tools_, in_.corner_angle, in_.h_min);
      }
      shapes[l].loop = loops[l];
      shapes[l].runs = runs_of(shapes[l].loop, in_.corner_angle);
      for (const BoundaryRun& run : shapes[l].runs)
        shapes[l].curves.emplace_back(shapes[l].loop, run, tools_, in_.smoothness,
                                      how >= Faithfulness::kept || is_rough(shapes[l].loop, run));
    }
    result_.summary.area_bound = area_of(loops) - before;
    return shapes;
  }

  /// H_phi1 and H_phi2 (HDR sec. 3.4.3), bounded.
  const std::vector<double>& physical_sizes() {
    if (!physical_.empty()) return physical_;
    physical_.assign(eroded_.piece.vertices.size(), in_.h_max);
    if (!in_.damage.empty() && in_.sizes_by_damage)
      physical_ = damage_sizes(eroded_.piece, kept(in_.damage, eroded_.triangle_of, 1), in_.h_min, in_.h_max);
    if (in_.error_field < 0) return physical_;
    const std::vector<Vec3> vertices = in_space(eroded_.piece.vertices);
    const std::vector<double> values =
        kept(in_.fields[static_cast<std::size_t>(in_.error_field)].values, eroded_.vertex_of, 1);
    EstimatorOptions options = in_.estimator;
    options.shape = ErrorShape::isotropic, options.hmin = in_.h_min, options.hmax = in_.h_max;
    const VertexPrescriptions found = estimate(ScalarField{vertices, eroded_.piece.triangles, values}, options);
    for (std::size_t v = 0; v < physical_.size(); ++v) physical_[v] = std::min(physical_[v], found.sizes[v]);
    return physical_;
  }

  SizeMap size_map(const std::vector<BoundaryShape>& shapes, std::vector<EdgeSizes::Source>& sources) {
    BoundarySizes geometric =
        boundary_sizes(shapes, tools_, eroded_.piece.vertices.size(), in_.curvature_angle, in_.h_min);
    sources = std::move(geometric.along_tools);
    std::vector<double> sizes = physical_sizes();
    const EdgeSizes growing(sources, slope_);
    for (std::size_t v = 0; v < sizes.size(); ++v) {
      sizes[v] = std::min(sizes[v], geometric.at_vertices[v]);
      if (!growing.empty()) {
        const Vec2& p = eroded_.piece.vertices[v];
        sizes[v] = growing.at({p.x(), p.y(), 0}, sizes[v]);
      }
    }
    grade_sizes(eroded_.piece, slope_, sizes);
    SizeMap map(eroded_.piece, search_, std::move(sizes), {in_.h_min, in_.h_max});
    map.set_sources(sources, slope_);
    return map;
  }

  void mesh(Faithfulness how) {
    const std::vector<BoundaryShape> shapes = shapes_of(how);
    result_.summary.area_geometry = (4 * area_of(shapes, 8) - area_of(shapes, 4)) / 3;  // of fourth order
    std::vector<EdgeSizes::Source> sources;
    SizeMap sizes = size_map(shapes, sources);
    CutBoundary boundary = cut_boundary(shapes, tools_, sizes);
    add_short_edges(boundary, sources);
    sizes.set_sources(std::move(sources), slope_);
    PlaneMesh plane = mesh_domain(boundary.domain, sizes);
    result_.piece = {std::move(plane.vertices), std::move(plane.triangles)};
    take_boundary(boundary);
    if (in_.measure) result_.summary.in_range = share_in_range(sizes);
  }

  /// Share of all edges; inner edges count twice.
  [[nodiscard]] double share_in_range(const SizeMap& sizes) const {
    std::size_t fitting = 0, all = 0;
    std::int32_t guess = 0;
    for (const auto& t : result_.piece.triangles)
      for (std::size_t k = 0; k < 3; ++k, ++all) {
        const Vec2 a = result_.piece.vertices[static_cast<std::size_t>(t[k])],
                   b = result_.piece.vertices[static_cast<std::size_t>(t[(k + 1) % 3])];
        const double length = norm(b - a) / sizes.at((a + b) / 2, guess);
        if (length >= std::numbers::sqrt2 / 2 && length <= std::numbers::sqrt2) ++fitting;
      }
    return static_cast<double>(fitting) / static_cast<double>(all);
  }

  void add_short_edges(const CutBoundary& boundary, std::vector<EdgeSizes::Source>& sources) const {
    for (std::size_t i = 0; i < boundary.domain.edges.size(); ++i) {
      const PlaneEdge& edge = boundary.domain.edges[i];
      const Vec2 a = boundary.domain.vertices[static_cast<std::size_t>(edge.a)],
                 b = boundary.domain.vertices[static_cast<std::size_t>(edge.b)];
      const double length = norm(b - a);
      if (length < thresholds::variable::short_edge * boundary.edge_sizes[i])
        sources.push_back({{a.x(), a.y(), 0}, {b.x(), b.y(), 0}, length});
    }
  }

  PlaneMesh mesh_domain(const PlaneDomain& domain, const SizeMap& sizes) {
    SampledDomain sampled{domain.vertices, {}};
    for (const PlaneEdge& edge : domain.edges) sampled.edges.emplace_back(edge.a, edge.b);
    std::int32_t guess = 0;
    const auto sampler = [&](std::span<const Vec2> places, std::span<Metric2> metrics) {
      for (std::size_t i = 0; i < places.size(); ++i) {
        const double h = sizes.at(places[i], guess);
        metrics[i] = {1 / (h * h), 0, 1 / (h * h)};
      }
    };
    PlaneMesherOptions options;
    options.max_triangles = in_.max_triangles;
    return mesh_plane(domain, ControlSpace::build(sampled, sampler, {}, monitor_), options, monitor_);
  }

  void take_boundary(CutBoundary& boundary) {
    result_.vertex_kinds = std::move(boundary.vertex_kinds);
    RemeshSummary& told = result_.summary;
    told.bound_vertices = told.free_vertices = told.imposed_vertices = 0;
    for (const std::int32_t kind : result_.vertex_kinds)
      ++(kind >= Kind::bound     ? told.bound_vertices
         : kind == Kind::imposed ? told.imposed_vertices
                                 : told.free_vertices);
    result_.vertex_kinds.resize(result_.piece.vertices.size(), Kind::inside);
    result_.edges.clear();
    for (const PlaneEdge& edge : boundary.domain.edges) result_.edges.push_back({edge.a, edge.b});
    result_.edge_kinds = std::move(boundary.edge_kinds);
    result_.parts = parts_of(adjacency_of(result_.piece)).first;
    told.area = result_.piece.area();
  }

  static std::vector<double> kept(const std::vector<double>& values, const std::vector<std::int32_t>& rows,
                                  int components) {
    const auto n = static_cast<std::size_t>(components);
    std::vector<double> result;
    result.reserve(n * rows.size());
    for (const std::int32_t row : rows)
      for (std::size_t c = 0; c < n; ++c) result.push_back(values[n * static_cast<std::size_t>(row) + c]);
    return result;
  }

  void transfer() {
    PieceTransfer carry(eroded_.piece, eroded_.adjacency, search_, result_.piece);
    if (!in_.damage.empty()) result_.damage = carry.means(kept(in_.damage, eroded_.triangle_of, 1), 1);
    for (double& d : result_.damage) d = std::clamp(d, 0.0, 1.0);  // sums of shares round
    for (const RemeshField& field : in_.fields) {
      monitor_.checkpoint();
      RemeshField& there = result_.fields.emplace_back(
          RemeshField{.name = field.name, .kind = field.kind, .components = field.components, .values = {}});
      const bool nodal = field.kind == FieldKind::nodal;
      const std::vector<double> values =
          kept(field.values, nodal ? eroded_.vertex_of : eroded_.triangle_of, field.components);
      there.values = nodal                                        ? carry.nodal(values, field.components)
                     : field.kind == FieldKind::element_conserved ? carry.conserved(values, field.components)
                                                                  : carry.means(values, field.components);
    }
  }

  const RemeshInput& in_;
  Monitor& monitor_;
  double slope_;
  Tools tools_;
  std::vector<double> damage_;  // 1 if elements overlap
  Eroded eroded_;
  TriangleSearch search_;
  std::vector<double> physical_;
  std::vector<Vec2> rough_;  // crossings of new edges
  RemeshResult result_;
};

}  // namespace

RemeshResult remesh(const RemeshInput& input, Monitor& monitor) {
  check_input(input);
  return Remeshing(input, monitor).run();
}

}  // namespace carreau::variable
