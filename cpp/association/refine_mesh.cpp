// SPDX-License-Identifier: BSD-3-Clause
#include "association/refine_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "association/divide_elements.h"
#include "association/edge_marks.h"
#include "association/keep_shapes.h"
#include "association/mesh_curves.h"
#include "association/periodic_refinement.h"
#include "association/pole_corners.h"
#include "association/thresholds.h"
#include "cad/batches.h"
#include "mesh/editable_mesh.h"
#include "mesh/shape_levels.h"
#include "periodic/shared_curves.h"
#include "support/error.h"
#include "support/rounding_of.h"
#include "support/shares.h"
#include "support/work_bounds.h"
#include "surface/carry/periodic_links.h"
#include "surface/elements/base/curve_middles.h"
#include "surface/elements/base/invalid_report.h"
#include "surface/elements/base/poles.h"
#include "surface/elements/second_order/quadratic.h"

namespace carreau {

namespace {

using namespace thresholds::association;
using namespace refining;

class Refiner {
 public:
  Refiner(const CurveModel& model, const SizeRules& rules, const CompositeOptions& options, Monitor& monitor, CompositeResult& result)
      : model_(model), rules_(rules), options_(options), monitor_(monitor), result_(result), mesh_(result.mesh),
        curves_(curves_of_mesh(model, result.mesh, result.curve_parameters)), quadratic_(!result.mesh.mid_vertices.empty()) {
    if (!mesh_.periodic.empty()) periodic_.emplace(model, result.report.diag, mesh_);
  }

  void run(const RefineRequest& request) {
    const std::vector<WorstShape> before = worst_shapes(mesh_);
    std::vector<double> sizes = request.sizes;
    if (!request.edges.empty() || !request.elements.empty()) {
      marks_.emplace(mesh_);
      marks_->mark_edges(request.edges), marks_->mark_elements(request.elements);
      refine(sizes, true);
    }
    for (int round = 0; !sizes.empty() && round < rounding_of::halvings; ++round) {
      marks_.emplace(mesh_);
      if (!marks_->mark_long(sizes)) break;
      refine(sizes, true);
    }
    for (int k = 0; k < request.halvings; ++k) {
      marks_.emplace(mesh_);
      marks_->mark_all();
      refine(sizes, false);
    }
    if (quadratic_) make_nodes();
    if (periodic_) link_nodes(periodic_->model(), model_.topology, curves_, mesh_);
    report_losses(mesh_, before, "refinement", monitor_);
    result_.curve_parameters = parameters_of_curves(model_, curves_);
    for (std::size_t c = 0; c < curves_.size(); ++c) result_.gaps[c] = {curves_[c].gap, curves_[c].gap_use};
  }

 private:
  void refine(std::vector<double>& sizes, bool improves) {
    monitor_.checkpoint();
    if (improves) marks_->close();
    while (periodic_ && improves && periodic_->spread(curves_, *marks_)) marks_->close();
    check_limit();
    const auto first_new = static_cast<std::int32_t>(mesh_.vertices.size());
    if (periodic_) periodic_->begin();
    added_.assign(mesh_.faces.size(), {});
    std::vector<std::vector<CurveSide>> sides(mesh_.faces.size());
    {
      const ElementWork work{model_, curves_, rules_, options_, result_, monitor_};
      for (std::size_t f = 0; f < mesh_.faces.size(); ++f)
        if (!mesh_.faces[f].triangles.empty()) sides[f] = curve_sides(work, f);
    }
    split_.assign(marks_->edges().size(), -1);
    number_segments();
    divide_curves();
    std::vector<std::vector<float>> shapes(mesh_.faces.size());  // of the parents of the triangles
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f)
      if (!mesh_.faces[f].triangles.empty()) shapes[f] = divide_face(f, sides[f]);
    finish_curves();
    grow_values(sizes);
    mesh_.mid_vertices.clear();
    for (CurveMesh& curve : mesh_.curves) curve.mid.clear();
    if (improves) swap_edges(first_new);
    ShapeKeeper keeper(mesh_, first_new, model_.cad, !rules_.uses_metrics(), quadratic_, monitor_);
    for (std::size_t f = 0; f < shapes.size(); ++f)
      if (!shapes[f].empty() && !(periodic_ && periodic_->is_slave(f))) keeper.restore(f, shapes[f]);
    if (periodic_) periodic_->finish(added_);
  }

  void check_limit() const {
    std::int64_t triangles = 0;
    for (const FaceMesh& face : mesh_.faces) triangles += static_cast<std::int64_t>(face.triangles.size());
    const std::int64_t after = triangles + 2 * marks_->count();
    if (options_.max_triangles > 0 && after > options_.max_triangles) refuse_triangles({}, static_cast<double>(after), options_.max_triangles);
  }

  /// The vertices of a divided curve: for each inside, 1 if it is new; and the places before.
  struct Divided {
    std::vector<char> is_new;
    std::vector<Vec3> old;
  };

  // New vertices of curves, in their order. Old vertices stay.
  void divide_curves() {
    std::vector<Divided> divided(curves_.size());
    for (std::size_t c = 0; c < curves_.size(); ++c)
      if (!curves_[c].indivisible && mesh_.curves[c].vertices.size() > 1) divided[c] = divide_curve(c);
    if (periodic_) carry_vertices(periodic_->model(), model_, curves_);
    for (std::size_t c = 0; c < curves_.size(); ++c) {
      const std::vector<std::int32_t>& chain = mesh_.curves[c].vertices;
      DiscreteCurve& d = curves_[c];
      for (std::size_t i = 0, k = 1; i < divided[c].is_new.size(); ++i) {
        if (divided[c].is_new[i] == 0) {
          d.xyz[i + 1] = divided[c].old[k++];
          continue;
        }
        split_[marks_->edges().find(chain[k - 1], chain[k])] = add_vertex(d.xyz[i + 1]);
      }
    }
  }

  Divided divide_curve(std::size_t c) {
    const std::vector<std::int32_t>& chain = mesh_.curves[c].vertices;
    DiscreteCurve& d = curves_[c];
    Divided divided{{}, d.xyz};
    const auto owner = static_cast<std::size_t>(d.owner);
    const CurveUse& use = model_.curve(d.curve).uses[owner];
    std::vector<double> r, t;
    for (std::size_t k = 1; k < chain.size(); ++k) {
      if (marks_->has(chain[k - 1], chain[k])) {
        const double middle = (d.r[k - 1] + d.r[k]) / 2, left = d.t_of_use[owner][k - 1], right = d.t_of_use[owner][k];
        // The support's error at the ends holds between them too.
        double at = parameter_at(model_, use, middle) + (left - parameter_at(model_, use, d.r[k - 1]) + right - parameter_at(model_, use, d.r[k])) / 2;
        if (!(std::min(left, right) < at && at < std::max(left, right))) at = (left + right) / 2;
        r.push_back(middle), t.push_back(at), divided.is_new.push_back(1);
      }
      if (k + 1 < chain.size()) r.push_back(d.r[k]), t.push_back(d.t_of_use[owner][k]), divided.is_new.push_back(0);
    }
    if (r.size() + 2 > d.r.size()) place_vertices_at(d, r, t, model_);
    return divided;
  }

  std::int32_t add_vertex(const Vec3& p) {
    mesh_.vertices.push_back(p), mesh_.vertex_ref.push_back(0);
    return static_cast<std::int32_t>(mesh_.vertices.size()) - 1;
  }

  /// The place in (u, v) of the middle of a local edge, known from its curve.
  [[nodiscard]] std::optional<Vec2> on_curve(const CurveSide& side) const {
    if (side.use < 0 || static_cast<std::size_t>(side.curve) >= curves_.size()) return {};
    const DiscreteCurve& d = curves_[side.curve];
    const CurveMesh& chain = mesh_.curves[side.curve];  // not divided yet
    // Rank of the new vertex: every marked edge before adds one.
    const std::size_t rank = first_of_segment_[side.curve][side.segment];
    if (d.indivisible || !marks_->has(chain.vertices[side.segment], chain.vertices[side.segment + 1])) return {};
    return d.uv_of_use[side.use][rank + 1];
  }

  void number_segments() {
    first_of_segment_.assign(curves_.size(), {});
    for (std::size_t c = 0; c < curves_.size(); ++c) {
      std::size_t rank = 0;
      const std::vector<std::int32_t>& chain = mesh_.curves[c].vertices;
      for (std::size_t k = 1; k < chain.size(); ++k) {
        first_of_segment_[c].push_back(rank);
        rank += 1 + static_cast<std::size_t>(marks_->has(chain[k - 1], chain[k]) && !curves_[c].indivisible);
      }
    }
  }

  /// Returns the shapes of the parents of its triangles; none if nothing was divided.
  std::vector<float> divide_face(std::size_t f, const std::vector<CurveSide>& curve_sides_of_face) {
    FaceMesh& face = mesh_.faces[f];
    bool any = false;
    for_sides(face, [&](std::int32_t a, std::int32_t b) { any = any || marks_->has(face.vertex[a], face.vertex[b]); });
    if (!any) {
      face.mid.clear(), face.mid_uv.clear(), face.mid_vertex.clear();
      return {};
    }
    const Poles poles(face);
    if (!periodic_ && !quadratic_) part_poles(face, poles, curve_sides_of_face);
    std::vector<Key> keys;
    keys.reserve(2 * face.triangles.size());
    for_sides(face, [&](std::int32_t a, std::int32_t b) { keys.push_back(ordered(a, b)); });
    const EdgeList local(std::move(keys), face.uv.size());
    middle_.assign(local.size(), -1);
    struct New {
      std::size_t edge;
      Vec2 from, to, uv;
      Vec3 xyz;
    };
    std::vector<New> inside;
    std::map<Key, std::int32_t> joined;  // edges that flattened triangles have twice
    for (const Triangle& t : face.flattened)
      for (std::size_t i = 0; i < 3; ++i)
        if (face.vertex[t[i]] != face.vertex[t[(i + 1) % 3]]) joined.emplace(ordered(face.vertex[t[i]], face.vertex[t[(i + 1) % 3]]), -1);
    const auto add_local = [&](const Vec2& uv, std::int32_t vertex) {
      face.uv.push_back(uv), face.vertex.push_back(vertex);
      return static_cast<std::int32_t>(face.uv.size()) - 1;
    };
    for (const CurveSide& side : curve_sides_of_face) {
      const std::int32_t e = local.find(side.a, side.b);
      const std::int32_t in_space = marks_->edges().find(face.vertex[side.a], face.vertex[side.b]);
      if (e < 0 || in_space < 0 || !marks_->has(in_space) || middle_[e] >= 0) continue;
      if (const std::optional<Vec2> uv = on_curve(side)) middle_[e] = add_local(*uv, split_[in_space]);
    }
    for (std::size_t e = 0; e < local.size(); ++e)
      if (const auto twice = joined.find(ordered(face.vertex[local[e][0]], face.vertex[local[e][1]])); twice != joined.end() && middle_[e] >= 0) twice->second = middle_[e];
    const std::vector<std::int32_t> mids = quadratic_ ? mids_of_edges(face, local) : std::vector<std::int32_t>{};
    for (std::size_t e = 0; e < local.size(); ++e) {
      const auto [a, b] = local[e];
      const std::int32_t in_space = marks_->edges().find(face.vertex[a], face.vertex[b]);
      if (!marks_->has(in_space) || middle_[e] >= 0) continue;
      const auto twice = joined.find(ordered(face.vertex[a], face.vertex[b]));
      if (twice != joined.end() && twice->second >= 0) {
        middle_[e] = twice->second;
        continue;
      }
      const Vec2 p = poles.arrival(a, b), q = poles.arrival(b, a);
      const std::int32_t mid = mids.empty() ? -1 : mids[e];
      const Vec2 uv = mid >= 0 ? face.mid_uv[mid] : Vec2(0.5 * (p + q));
      const std::int32_t vertex = add_vertex({0, 0, 0});
      middle_[e] = add_local(uv, vertex);
      if (split_[in_space] < 0) split_[in_space] = vertex;
      if (twice != joined.end()) twice->second = middle_[e];
      if (mid >= 0)
        mesh_.vertices[vertex] = mesh_.mid_vertices[face.mid_vertex[mid]];
      else
        inside.push_back({e, p, q, uv, {}});
    }
    std::vector<Vec2> uv;
    std::vector<std::size_t> asked(inside.size());
    std::iota(asked.begin(), asked.end(), std::size_t{0});
    for (int step = 0; step < middle_steps && !asked.empty(); ++step) {
      uv.clear();
      for (const std::size_t k : asked) uv.push_back(inside[k].uv);
      evaluate(face.ref, uv, [&](std::size_t k, const Vec3& s) { inside[asked[k]].xyz = s; });
      std::erase_if(asked, [&](std::size_t k) {
        New& point = inside[k];
        const auto [a, b] = local[point.edge];
        const double left = norm(point.xyz - mesh_.vertices[face.vertex[a]]), right = norm(mesh_.vertices[face.vertex[b]] - point.xyz);
        const double shift = (right - left) / (2 * (left + right));
        if (!(std::abs(shift) > shares::small) || step + 1 == middle_steps) return true;
        const Vec2 way = point.to - point.from;
        const double share = std::clamp(dot(point.uv - point.from, way) / dot(way, way) + shift, 0.1, 0.9);
        point.uv = lerp(point.from, point.to, share);
        return false;
      });
    }
    for (const New& point : inside) {
      const std::int32_t m = middle_[point.edge];
      face.uv[m] = point.uv, mesh_.vertices[face.vertex[m]] = point.xyz;
    }
    if (periodic_)
      for (std::size_t e = 0; e < local.size(); ++e)
        if (middle_[e] >= 0) added_[f].middles.emplace(local[e], middle_[e]);
    return divide_elements(
        face, local, middle_, mesh_.vertices, [&](const Vec2& at) { return add_local(at, add_vertex({0, 0, 0})); },
        [&](std::span<const std::int32_t> centres) {
          std::vector<Vec2> at;
          for (const std::int32_t c : centres) at.push_back(face.uv[c]);
          added_[f].centres.assign(centres.begin(), centres.end());
          evaluate(face.ref, at, [&](std::size_t k, const Vec3& s) { mesh_.vertices[face.vertex[centres[k]]] = s; });
        });
  }

  template <typename Use>
  void evaluate(int ref, const std::vector<Vec2>& uv, const Use& use) {
    const int threads = asks_from_threads(options_, model_.cad) ? options_.executor.threads : 1;
    for_batches(model_.cad, ref, want_position, uv, threads, monitor_, [&](std::size_t first, std::span<const Vec2> here, std::span<const SurfaceJet> jets) {
      for (std::size_t k = 0; k < here.size(); ++k) use(first + k, jets[k].s);
    });
  }

  static std::vector<std::int32_t> mids_of_edges(const FaceMesh& face, const EdgeList& local) {
    std::vector<std::int32_t> mids(local.size(), -1);
    for (std::size_t t = 0; t < face.mid.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i)
        if (face.mid[t][i] >= 0) mids[local.find(face.triangles[t][i], face.triangles[t][(i + 1) % 3])] = face.mid[t][i];
    return mids;
  }

  void finish_curves() {
    for (std::size_t c = 0; c < curves_.size(); ++c) {
      CurveMesh& curve = mesh_.curves[c];
      std::vector<std::int32_t> chain;
      std::vector<double> size;
      const bool sized = result_.curve_size[c].size() == curve.vertices.size();
      for (std::size_t k = 0; k < curve.vertices.size(); ++k) {
        if (k > 0) {
          const std::int32_t e = marks_->edges().find(curve.vertices[k - 1], curve.vertices[k]);
          if (e >= 0 && split_[e] >= 0) {
            chain.push_back(split_[e]);
            if (sized) size.push_back((result_.curve_size[c][k - 1] + result_.curve_size[c][k]) / 2);
          }
        }
        chain.push_back(curve.vertices[k]);
        if (sized) size.push_back(result_.curve_size[c][k]);
      }
      curve.vertices = std::move(chain);
      if (sized) result_.curve_size[c] = std::move(size);
    }
  }

  // Sizes at new vertices: means of the ends of their edges, or of the vertices around.
  void grow_values(std::vector<double>& sizes) {
    const std::size_t n = result_.vertex_size.size();
    const auto grow = [&](std::vector<double>& values) {
      if (values.empty()) return;
      values.resize(mesh_.vertices.size(), 0);
      for (std::size_t e = 0; e < marks_->edges().size(); ++e)
        if (split_[e] >= 0) values[split_[e]] = std::sqrt(values[marks_->edges()[e][0]] * values[marks_->edges()[e][1]]);
      for (const FaceMesh& face : mesh_.faces)
        for (const Triangle& t : face.triangles)
          for (std::size_t i = 0; i < 3; ++i)
            if (const std::int32_t v = face.vertex[t[i]]; static_cast<std::size_t>(v) >= n && values[v] == 0)
              values[v] = std::max(values[face.vertex[t[(i + 1) % 3]]], values[face.vertex[t[(i + 2) % 3]]]);
    };
    grow(result_.vertex_size), grow(sizes);
  }

  // Swaps edges around new vertices.
  void swap_edges(std::int32_t first_new) {
    std::vector<std::int32_t> centres(mesh_.vertices.size() - static_cast<std::size_t>(first_new));
    std::iota(centres.begin(), centres.end(), first_new);
    if (centres.empty() || mesh_.cells_are_not_triangles()) return;
    EditableMesh mesh(mesh_, centres, 1);
    for (int pass = 0; pass < work_bounds::rounds; ++pass) {
      bool changed = false;
      monitor_.checkpoint();
      for (const std::int32_t v : centres) {
        if (!mesh.is_known(v)) continue;
        const std::vector<EditableMesh::Place> fan = mesh.fan(v);
        for (const EditableMesh::Place& place : fan)
          for (int side = 0; side < 3; ++side) changed = try_swap(mesh, place, side) || changed;
      }
      if (!changed) break;
    }
  }

  bool try_swap(EditableMesh& mesh, EditableMesh::Place place, int side) const {
    const std::optional<EditableMesh::Quad> quad = mesh.quad(place, side);
    if (!quad || quad->mixed) return false;
    const FaceMesh& face = mesh_.faces[quad->face];
    const auto worst = [&](const Triangle& t, const Triangle& u) { return std::min(shape_of(face, t, mesh_.vertices), shape_of(face, u, mesh_.vertices)); };
    const auto after = EditableMesh::swapped(*quad);
    if (!(worst(after[0], after[1]) > worst(mesh.at({quad->face, quad->t}), mesh.at({quad->face, quad->u})) + shape_level::gain)) return false;
    const Vec3 normal = mesh.mean_normal(quad->places());
    for (const Triangle& t : after) {
      const Vec3 n = mesh.normal(quad->face, t);
      if (!(dot(n, normal) > swap_cosine * norm(n))) return false;
    }
    return mesh.swap(*quad);
  }

  void make_nodes() {
    const ElementWork work{model_, curves_, rules_, options_, result_, monitor_, periodic_ ? &periodic_->model() : nullptr};
    QuadraticReport made = make_quadratic(work);
    if (const std::vector<CuspEnd> cusps = made.cusps; !cusps.empty()) made = make_quadratic(work, cusps);
    for (const InvalidElements& invalid : made.invalid)
      monitor_.message(Level::warning, mark_invalid(mesh_.faces[invalid.face], invalid.uv, invalid.count));
  }

  const CurveModel& model_;
  const SizeRules& rules_;
  const CompositeOptions& options_;
  Monitor& monitor_;
  CompositeResult& result_;
  SurfaceMesh& mesh_;
  std::vector<DiscreteCurve> curves_;
  bool quadratic_;
  std::optional<PeriodicRefinement> periodic_;
  std::vector<AddedVertices> added_;  // by face
  std::optional<EdgeMarks> marks_;   // of the mesh before the round
  std::vector<std::int32_t> split_;  // by edge of marks_: the new vertex
  std::vector<std::vector<std::size_t>> first_of_segment_;  // [curve][segment]: rank of its first vertex in the divided curve
  std::vector<std::int32_t> middle_;  // of edges of a face: the new local vertex
};

}  // namespace

void refine_mesh(const CurveModel& model, const SizeRules& rules, const CompositeOptions& options, const RefineRequest& request, Monitor& monitor,
                 CompositeResult& result) {
  if (!request.sizes.empty() && request.sizes.size() != result.mesh.vertices.size())
    throw InvalidArgument("there are " + std::to_string(request.sizes.size()) + " sizes for " + std::to_string(result.mesh.vertices.size()) + " vertices");
  if (const auto wrong = std::find_if(request.sizes.begin(), request.sizes.end(), [](double h) { return !(h > 0) || !std::isfinite(h); });
      wrong != request.sizes.end())
    throw InvalidArgument("the size at vertex " + std::to_string(wrong - request.sizes.begin()) + " is not positive");
  if (request.halvings < 0) throw InvalidArgument("the number of halvings is " + std::to_string(request.halvings));
  Refiner(model, rules, options, monitor, result).run(request);
}

}  // namespace carreau
