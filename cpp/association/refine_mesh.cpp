// SPDX-License-Identifier: BSD-3-Clause
#include "association/refine_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "association/mesh_curves.h"
#include "association/thresholds.h"
#include "cad/batches.h"
#include "mesh/editable_mesh.h"
#include "mesh/quality.h"
#include "mesh/trial.h"
#include "predicates/predicates.h"
#include "support/error.h"
#include "surface/elements/base/curve_middles.h"
#include "surface/elements/base/invalid_report.h"
#include "surface/elements/second_order/quadratic.h"

namespace carreau {

namespace {

using namespace thresholds::association;
using Key = std::array<std::int32_t, 2>;
using Triangle = std::array<std::int32_t, 3>;

Key ordered(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// Edges by the lesser of their vertices, numbered in ascending order.
class EdgeList {
 public:
  explicit EdgeList(std::vector<Key> edges, std::size_t vertices) : edges_(std::move(edges)), first_(vertices + 1, 0) {
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    for (const Key& edge : edges_) ++first_[edge[0] + 1];
    for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
  }
  [[nodiscard]] std::size_t size() const noexcept { return edges_.size(); }
  [[nodiscard]] const Key& operator[](std::size_t e) const { return edges_[e]; }
  /// -1: there is no such edge.
  [[nodiscard]] std::int32_t find(std::int32_t a, std::int32_t b) const {
    const Key key = ordered(a, b);
    if (key[0] < 0 || static_cast<std::size_t>(key[0]) + 1 >= first_.size()) return -1;
    const auto begin = edges_.begin() + first_[key[0]], end = edges_.begin() + first_[key[0] + 1];
    const auto found = std::lower_bound(begin, end, key);
    return found != end && *found == key ? static_cast<std::int32_t>(found - edges_.begin()) : -1;
  }

 private:
  std::vector<Key> edges_;
  std::vector<std::int32_t> first_;
};

// Sides of the elements of a face: diagonals of quadrilaterals are none.
template <typename Use>
void for_sides(const FaceMesh& face, const Use& use) {
  for (std::size_t t = 0; t < face.triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      if (t < 2 * static_cast<std::size_t>(face.quads) && i == (t % 2 == 0 ? 2U : 0U)) continue;
      use(face.triangles[t][i], face.triangles[t][(i + 1) % 3], t, i);
    }
  for (const Triangle& t : face.flattened)
    for (std::size_t i = 0; i < 3; ++i)
      if (face.vertex[t[i]] != face.vertex[t[(i + 1) % 3]]) use(t[i], t[(i + 1) % 3], face.triangles.size(), i);
}

class Refiner {
 public:
  Refiner(const CurveModel& model, const SizeRules& rules, const CompositeOptions& options, Monitor& monitor, CompositeResult& result)
      : model_(model), rules_(rules), options_(options), monitor_(monitor), result_(result), mesh_(result.mesh),
        curves_(curves_of_mesh(model, result.mesh, result.curve_parameters)), quadratic_(!result.mesh.mid_vertices.empty()) {}

  void run(const RefineRequest& request) {
    std::vector<double> sizes = request.sizes;
    if (!request.edges.empty() || !request.elements.empty()) {
      begin_round();
      mark_edges(request.edges), mark_elements(request.elements);
      refine(sizes, true);
    }
    for (int round = 0; !sizes.empty() && round < max_size_rounds; ++round) {
      begin_round();
      if (!mark_long(sizes)) break;
      refine(sizes, true);
    }
    for (int k = 0; k < request.halvings; ++k) {
      begin_round();
      std::fill(marked_.begin(), marked_.end(), 1);
      refine(sizes, false);
    }
    if (quadratic_) make_nodes();
    result_.curve_parameters = parameters_of_curves(model_, curves_);
    for (std::size_t c = 0; c < curves_.size(); ++c) result_.gaps[c] = {curves_[c].gap, curves_[c].gap_use};
  }

 private:
  void begin_round() {
    std::vector<Key> all;
    all.reserve(2 * mesh_.triangle_count());
    for (const FaceMesh& face : mesh_.faces)
      for_sides(face, [&](std::int32_t a, std::int32_t b, std::size_t, std::size_t) { all.push_back(ordered(face.vertex[a], face.vertex[b])); });
    for (const CurveMesh& curve : mesh_.curves)
      for (std::size_t k = 1; k < curve.vertices.size(); ++k) all.push_back(ordered(curve.vertices[k - 1], curve.vertices[k]));
    edges_.emplace(std::move(all), mesh_.vertices.size());
    marked_.assign(edges_->size(), 0);
  }

  void mark_edges(const std::vector<Key>& edges) {
    for (const Key& edge : edges) {
      const std::int32_t e = edges_->find(edge[0], edge[1]);
      if (e < 0) throw InvalidArgument("the mesh has no edge between the vertices " + std::to_string(edge[0]) + " and " + std::to_string(edge[1]));
      marked_[e] = 1;
    }
  }

  void mark_elements(std::vector<std::int64_t> elements) {
    std::sort(elements.begin(), elements.end());
    std::int64_t first = 0;
    auto next = elements.begin();
    if (!elements.empty() && *next < 0) throw InvalidArgument("there is no element " + std::to_string(*next));
    for (const FaceMesh& face : mesh_.faces) {
      const auto count = static_cast<std::int64_t>(face.cell_count());
      for (; next != elements.end() && *next < first + count; ++next) {
        const std::int64_t k = *next - first, quads = face.quads;
        for (std::int64_t t = k < quads ? 2 * k : k + quads; t < (k < quads ? 2 * k + 2 : k + quads + 1); ++t)
          for (int i = 0; i < 3; ++i) {
            const Triangle& corners = face.triangles[t];
            const std::int32_t e = edges_->find(face.vertex[corners[i]], face.vertex[corners[(i + 1) % 3]]);
            if (e >= 0 && !(k < quads && i == (t % 2 == 0 ? 2 : 0))) marked_[e] = 1;
          }
      }
      first += count;
    }
    if (next != elements.end()) throw InvalidArgument("there is no element " + std::to_string(*next) + ": the mesh has " + std::to_string(first));
  }

  bool mark_long(const std::vector<double>& sizes) {
    bool any = false;
    for (std::size_t e = 0; e < edges_->size(); ++e) {
      const auto [a, b] = (*edges_)[e];
      if (norm(mesh_.vertices[b] - mesh_.vertices[a]) > max_length * std::sqrt(sizes[a] * sizes[b])) marked_[e] = 1, any = true;
    }
    return any;
  }

  [[nodiscard]] double length(std::int32_t e) const { return norm(mesh_.vertices[(*edges_)[e][1]] - mesh_.vertices[(*edges_)[e][0]]); }

  // Each triangle with a halved edge halves its longest edge (Rivara 1984): angles stay bounded.
  void close_marks() {
    for (bool changed = true; changed;) {
      changed = false;
      for (const FaceMesh& face : mesh_.faces)
        for (std::size_t t = 2 * static_cast<std::size_t>(face.quads); t < face.triangles.size(); ++t) {
          const std::array<std::int32_t, 3> sides = sides_of(face, face.triangles[t]);
          if (marked_[sides[0]] + marked_[sides[1]] + marked_[sides[2]] == 0) continue;
          const std::int32_t longest = *std::max_element(sides.begin(), sides.end(), [&](std::int32_t d, std::int32_t e) {
            return std::pair(length(d), d) < std::pair(length(e), e);
          });
          if (marked_[longest] == 0) marked_[longest] = 1, changed = true;
        }
    }
  }

  [[nodiscard]] std::array<std::int32_t, 3> sides_of(const FaceMesh& face, const Triangle& t) const {
    std::array<std::int32_t, 3> sides{};
    for (std::size_t i = 0; i < 3; ++i) sides[i] = edges_->find(face.vertex[t[i]], face.vertex[t[(i + 1) % 3]]);
    return sides;
  }

  void refine(std::vector<double>& sizes, bool improves) {
    monitor_.checkpoint();
    if (improves) close_marks();
    check_limit();
    const auto before = static_cast<std::int32_t>(mesh_.vertices.size());
    std::vector<std::vector<CurveSide>> sides(mesh_.faces.size());
    {
      const ElementWork work{model_, curves_, rules_, options_, result_, monitor_};
      for (std::size_t f = 0; f < mesh_.faces.size(); ++f)
        if (!mesh_.faces[f].triangles.empty()) sides[f] = curve_sides(work, f);
    }
    split_.assign(edges_->size(), -1);
    number_segments();
    divide_curves();
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f)
      if (!mesh_.faces[f].triangles.empty()) divide_face(f, sides[f]);
    finish_curves();
    grow_values(sizes);
    mesh_.mid_vertices.clear();
    for (CurveMesh& curve : mesh_.curves) curve.mid.clear();
    std::vector<std::int32_t> centres;
    if (improves) {
      centres.resize(mesh_.vertices.size() - static_cast<std::size_t>(before));
      std::iota(centres.begin(), centres.end(), before);
    } else {  // two edges of a curve open to a straight line at the corner between
      for (const CurveMesh& curve : mesh_.curves) centres.insert(centres.end(), curve.vertices.begin(), curve.vertices.end());
      std::sort(centres.begin(), centres.end());
      centres.erase(std::unique(centres.begin(), centres.end()), centres.end());
    }
    swap_edges(centres, improves ? 1 : poor_shape);
  }

  void check_limit() const {
    std::int64_t triangles = 0;
    for (const FaceMesh& face : mesh_.faces) triangles += static_cast<std::int64_t>(face.triangles.size());
    const auto marks = std::count(marked_.begin(), marked_.end(), 1);
    if (options_.max_triangles > 0 && triangles + 2 * marks > options_.max_triangles) refuse_triangles({}, static_cast<double>(triangles + 2 * marks), options_.max_triangles);
  }

  // New vertices of curves, in their order. Old vertices stay.
  void divide_curves() {
    for (std::size_t c = 0; c < curves_.size(); ++c) {
      const std::vector<std::int32_t>& chain = mesh_.curves[c].vertices;
      DiscreteCurve& d = curves_[c];
      if (d.indivisible || chain.size() < 2) continue;
      const auto owner = static_cast<std::size_t>(d.owner);
      const CurveUse& use = model_.curve(d.curve).uses[owner];
      std::vector<double> r, t;
      std::vector<char> is_new;
      for (std::size_t k = 1; k < chain.size(); ++k) {
        if (marked_[edges_->find(chain[k - 1], chain[k])] != 0) {
          const double middle = (d.r[k - 1] + d.r[k]) / 2, left = d.t_of_use[owner][k - 1], right = d.t_of_use[owner][k];
          // The support's error at the ends holds between them too.
          double at = parameter_at(model_, use, middle) + (left - parameter_at(model_, use, d.r[k - 1]) + right - parameter_at(model_, use, d.r[k])) / 2;
          if (!(std::min(left, right) < at && at < std::max(left, right))) at = (left + right) / 2;
          r.push_back(middle), t.push_back(at), is_new.push_back(1);
        }
        if (k + 1 < chain.size()) r.push_back(d.r[k]), t.push_back(d.t_of_use[owner][k]), is_new.push_back(0);
      }
      if (r.size() + 2 == d.r.size()) continue;
      const std::vector<Vec3> old = d.xyz;
      place_vertices_at(d, r, t, model_);
      for (std::size_t i = 0, k = 1; i < is_new.size(); ++i) {
        if (is_new[i] == 0) {
          d.xyz[i + 1] = old[k++];
          continue;
        }
        split_[edges_->find(chain[k - 1], chain[k])] = add_vertex(d.xyz[i + 1]);
      }
    }
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
    if (d.indivisible || marked_[edges_->find(chain.vertices[side.segment], chain.vertices[side.segment + 1])] == 0) return {};
    return d.uv_of_use[side.use][rank + 1];
  }

  void number_segments() {
    first_of_segment_.assign(curves_.size(), {});
    for (std::size_t c = 0; c < curves_.size(); ++c) {
      std::size_t rank = 0;
      const std::vector<std::int32_t>& chain = mesh_.curves[c].vertices;
      for (std::size_t k = 1; k < chain.size(); ++k) {
        first_of_segment_[c].push_back(rank);
        rank += 1 + static_cast<std::size_t>(marked_[edges_->find(chain[k - 1], chain[k])] != 0 && !curves_[c].indivisible);
      }
    }
  }

  // The place that the way from `other` reaches: a pole has any place of its side.
  struct Box {
    Vec2 low, high;
  };
  static Vec2 arrival(const FaceMesh& face, const std::map<std::int32_t, Box>& poles, std::int32_t v, std::int32_t other) {
    Vec2 p = face.uv[v];
    const auto pole = poles.find(face.vertex[v]);
    if (pole == poles.end() || poles.contains(face.vertex[other])) return p;
    const auto& [low, high] = pole->second;
    if (low.y() == high.y()) p.x() = std::clamp(face.uv[other].x(), low.x(), high.x());
    if (low.x() == high.x()) p.y() = std::clamp(face.uv[other].y(), low.y(), high.y());
    return p;
  }

  static std::map<std::int32_t, Box> poles_of(const FaceMesh& face) {
    std::map<std::int32_t, Box> poles;
    for (const Triangle& t : face.flattened)
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int32_t a = t[i], b = t[(i + 1) % 3];
        if (face.vertex[a] != face.vertex[b]) continue;
        const Box box{face.uv[a].cwiseMin(face.uv[b]), face.uv[a].cwiseMax(face.uv[b])};
        const auto [pole, is_new] = poles.try_emplace(face.vertex[a], box);
        if (!is_new) pole->second = {pole->second.low.cwiseMin(box.low), pole->second.high.cwiseMax(box.high)};
      }
    return poles;
  }

  void divide_face(std::size_t f, const std::vector<CurveSide>& curve_sides_of_face) {
    FaceMesh& face = mesh_.faces[f];
    std::vector<Key> keys;
    keys.reserve(2 * face.triangles.size());
    bool any = false;
    for_sides(face, [&](std::int32_t a, std::int32_t b, std::size_t, std::size_t) {
      keys.push_back(ordered(a, b));
      any = any || marked_[edges_->find(face.vertex[a], face.vertex[b])] != 0;
    });
    if (!any) {
      face.mid.clear(), face.mid_uv.clear(), face.mid_vertex.clear();
      return;
    }
    const EdgeList local(std::move(keys), face.uv.size());
    middle_.assign(local.size(), -1);
    struct New {
      std::size_t edge;
      Vec2 from, to, uv;
      Vec3 xyz;
    };
    std::vector<New> inside;
    const std::map<std::int32_t, Box> poles = poles_of(face);
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
      const std::int32_t in_space = edges_->find(face.vertex[side.a], face.vertex[side.b]);
      if (e < 0 || in_space < 0 || marked_[in_space] == 0 || middle_[e] >= 0) continue;
      if (const std::optional<Vec2> uv = on_curve(side)) middle_[e] = add_local(*uv, split_[in_space]);
    }
    for (std::size_t e = 0; e < local.size(); ++e)
      if (const auto twice = joined.find(ordered(face.vertex[local[e][0]], face.vertex[local[e][1]])); twice != joined.end() && middle_[e] >= 0) twice->second = middle_[e];
    const std::vector<std::int32_t> mids = quadratic_ ? mids_of_edges(face, local) : std::vector<std::int32_t>{};
    for (std::size_t e = 0; e < local.size(); ++e) {
      const auto [a, b] = local[e];
      const std::int32_t in_space = edges_->find(face.vertex[a], face.vertex[b]);
      if (marked_[in_space] == 0 || middle_[e] >= 0) continue;
      const auto twice = joined.find(ordered(face.vertex[a], face.vertex[b]));
      if (twice != joined.end() && twice->second >= 0) {
        middle_[e] = twice->second;
        continue;
      }
      const Vec2 p = arrival(face, poles, a, b), q = arrival(face, poles, b, a);
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
        if (!(std::abs(shift) > off_middle) || step + 1 == middle_steps) return true;
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
    divide_elements(face, local);
  }

  template <typename Use>
  void evaluate(int ref, const std::vector<Vec2>& uv, const Use& use) {
    const int threads = asks_from_threads(options_, model_.cad) ? options_.threads : 1;
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

  [[nodiscard]] double shape(const FaceMesh& face, const Triangle& t) const {
    if (orientation(face.uv[t[0]], face.uv[t[1]], face.uv[t[2]]) <= 0) return -1;
    return quality_q2(mesh_.vertices[face.vertex[t[0]]], mesh_.vertices[face.vertex[t[1]]], mesh_.vertices[face.vertex[t[2]]]);
  }

  // Cuts ears of a polygon, the best shape first.
  void triangulate(const FaceMesh& face, std::vector<std::int32_t> polygon, std::vector<Triangle>& out) const {
    while (polygon.size() > 3) {
      const std::size_t n = polygon.size();
      std::size_t best = 0;
      double found = -2;
      for (std::size_t i = 0; i < n; ++i) {
        double now = shape(face, {polygon[(i + n - 1) % n], polygon[i], polygon[(i + 1) % n]});
        if (n == 4) now = std::min(now, shape(face, {polygon[(i + 1) % n], polygon[(i + 2) % n], polygon[(i + 3) % n]}));
        if (now > found) found = now, best = i;
      }
      out.push_back({polygon[(best + n - 1) % n], polygon[best], polygon[(best + 1) % n]});
      polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(best));
    }
    out.push_back({polygon[0], polygon[1], polygon[2]});
  }

  void divide_elements(FaceMesh& face, const EdgeList& local) {
    const auto middle = [&](std::int32_t a, std::int32_t b) {
      const std::int32_t e = local.find(a, b);
      return e < 0 ? -1 : middle_[e];
    };
    std::vector<std::array<std::int32_t, 4>> quads;
    std::vector<Triangle> triangles;
    triangles.reserve(4 * face.triangles.size());
    std::vector<std::int32_t> centres;
    for (std::size_t k = 0; k < static_cast<std::size_t>(face.quads); ++k) {
      const std::array<std::int32_t, 4> q = face.quad(k);
      std::array<std::int32_t, 4> m{};
      std::vector<std::int32_t> polygon;
      for (std::size_t i = 0; i < 4; ++i) {
        m[i] = middle(q[i], q[(i + 1) % 4]);
        polygon.push_back(q[i]);
        if (m[i] >= 0) polygon.push_back(m[i]);
      }
      if (polygon.size() == 4) {
        quads.push_back(q);
      } else if (polygon.size() == 8) {
        Vec2 uv{0, 0};
        for (const std::int32_t v : m) uv += 0.25 * face.uv[v];
        face.uv.push_back(uv), face.vertex.push_back(add_vertex({0, 0, 0}));
        const auto centre = static_cast<std::int32_t>(face.uv.size()) - 1;
        centres.push_back(centre);
        for (std::size_t i = 0; i < 4; ++i) quads.push_back({q[i], m[i], centre, m[(i + 3) % 4]});
      } else {
        triangulate(face, polygon, triangles);
      }
    }
    std::vector<Vec2> uv;
    for (const std::int32_t c : centres) uv.push_back(face.uv[c]);
    evaluate(face.ref, uv, [&](std::size_t k, const Vec3& s) { mesh_.vertices[face.vertex[centres[k]]] = s; });
    for (std::size_t t = 2 * static_cast<std::size_t>(face.quads); t < face.triangles.size(); ++t) divide_triangle(face, face.triangles[t], middle, triangles);
    std::vector<Triangle> flattened;
    for (const Triangle& t : face.flattened) divide_flattened(face, t, middle, flattened);
    face.flattened = std::move(flattened);
    face.mid.clear(), face.mid_uv.clear(), face.mid_vertex.clear();
    if (quads.empty()) {
      face.quads = 0, face.triangles = std::move(triangles);
    } else {
      set_cells(face, quads, triangles, mesh_.vertices);
    }
  }

  template <typename Middle>
  void divide_triangle(const FaceMesh& face, const Triangle& t, const Middle& middle, std::vector<Triangle>& out) const {
    const std::array<std::int32_t, 3> m{middle(t[0], t[1]), middle(t[1], t[2]), middle(t[2], t[0])};
    const auto cuts = std::count_if(m.begin(), m.end(), [](std::int32_t v) { return v >= 0; });
    if (cuts == 0) {
      out.push_back(t);
    } else if (cuts == 3) {
      out.insert(out.end(), {{t[0], m[0], m[2]}, {m[0], t[1], m[1]}, {m[2], m[1], t[2]}, {m[0], m[1], m[2]}});
    } else {
      if (cuts == 1) {
        const std::size_t i = static_cast<std::size_t>(std::find_if(m.begin(), m.end(), [](std::int32_t v) { return v >= 0; }) - m.begin());
        out.insert(out.end(), {{t[i], m[i], t[(i + 2) % 3]}, {m[i], t[(i + 1) % 3], t[(i + 2) % 3]}});
      } else {  // the corner between both cuts, then the better diagonal of the rest
        std::size_t i = 0;
        while (m[i] < 0 || m[(i + 2) % 3] < 0) ++i;
        const std::int32_t a = t[i], p = m[i], q = m[(i + 2) % 3], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
        out.push_back({a, p, q});
        const double first = std::min(shape(face, {p, b, c}), shape(face, {p, c, q})), second = std::min(shape(face, {p, b, q}), shape(face, {b, c, q}));
        if (first >= second)
          out.insert(out.end(), {{p, b, c}, {p, c, q}});
        else
          out.insert(out.end(), {{p, b, q}, {b, c, q}});
      }
    }
  }

  // The two sides that meet at the apex are one in space, and so are their middles: only the part at the pole stays.
  template <typename Middle>
  void divide_flattened(const FaceMesh& face, const Triangle& t, const Middle& middle, std::vector<Triangle>& flattened) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
      if (face.vertex[a] != face.vertex[b]) continue;
      const std::int32_t m = middle(b, c), n = middle(c, a);
      if (m < 0 && n < 0) break;
      if (m == n) {
        flattened.push_back({a, b, m});
      } else {  // sides of a seam, which have two places
        flattened.insert(flattened.end(), {{a, b, m}, {a, m, n}});
        flattened.push_back({n, m, c});
      }
      return;
    }
    flattened.push_back(t);
  }

  void finish_curves() {
    for (std::size_t c = 0; c < curves_.size(); ++c) {
      CurveMesh& curve = mesh_.curves[c];
      std::vector<std::int32_t> chain;
      std::vector<double> size;
      const bool sized = result_.curve_size[c].size() == curve.vertices.size();
      for (std::size_t k = 0; k < curve.vertices.size(); ++k) {
        if (k > 0) {
          const std::int32_t e = edges_->find(curve.vertices[k - 1], curve.vertices[k]);
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
      for (std::size_t e = 0; e < edges_->size(); ++e)
        if (split_[e] >= 0) values[split_[e]] = std::sqrt(values[(*edges_)[e][0]] * values[(*edges_)[e][1]]);
      for (const FaceMesh& face : mesh_.faces)
        for (const Triangle& t : face.triangles)
          for (std::size_t i = 0; i < 3; ++i)
            if (const std::int32_t v = face.vertex[t[i]]; static_cast<std::size_t>(v) >= n && values[v] == 0)
              values[v] = std::max(values[face.vertex[t[(i + 1) % 3]]], values[face.vertex[t[(i + 2) % 3]]]);
    };
    grow(result_.vertex_size), grow(sizes);
  }

  // Swaps edges around `centres` whose triangles are below the shape.
  void swap_edges(const std::vector<std::int32_t>& centres, double below) {
    if (centres.empty() || mesh_.cells_are_not_triangles()) return;
    EditableMesh mesh(mesh_, centres, 1);
    for (int pass = 0; pass < swap_passes; ++pass) {
      bool changed = false;
      monitor_.checkpoint();
      for (const std::int32_t v : centres) {
        if (!mesh.is_known(v)) continue;
        const std::vector<EditableMesh::Place> fan = mesh.fan(v);
        for (const EditableMesh::Place& place : fan)
          for (int side = 0; side < 3; ++side) changed = try_swap(mesh, place, side, below) || changed;
      }
      if (!changed) break;
    }
  }

  bool try_swap(EditableMesh& mesh, EditableMesh::Place place, int side, double below) const {
    const std::optional<EditableMesh::Quad> quad = mesh.quad(place, side);
    if (!quad || quad->mixed) return false;
    const FaceMesh& face = mesh_.faces[quad->face];
    const auto worst = [&](const Triangle& t, const Triangle& u) { return std::min(shape(face, t), shape(face, u)); };
    const auto after = EditableMesh::swapped(*quad);
    const double before = worst(mesh.at({quad->face, quad->t}), mesh.at({quad->face, quad->u}));
    if (before >= below || !(worst(after[0], after[1]) > before + min_swap_gain)) return false;
    const Vec3 normal = mesh.mean_normal(quad->places());
    for (const Triangle& t : after) {
      const Vec3 n = mesh.normal(quad->face, t);
      if (!(dot(n, normal) > swap_cosine * norm(n))) return false;
    }
    return mesh.swap(*quad);
  }

  void make_nodes() {
    const ElementWork work{model_, curves_, rules_, options_, result_, monitor_};
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
  std::optional<EdgeList> edges_;  // of the mesh in space
  std::vector<char> marked_;       // of edges_
  std::vector<std::int32_t> split_;  // of edges_: the new vertex
  std::vector<std::vector<std::size_t>> first_of_segment_;  // [curve][segment]: rank of its first vertex in the divided curve
  std::vector<std::int32_t> middle_;  // of edges of a face: the new local vertex
};

}  // namespace

void refine_mesh(const CurveModel& model, const SizeRules& rules, const CompositeOptions& options, const RefineRequest& request, Monitor& monitor,
                 CompositeResult& result) {
  if (!result.mesh.periodic.empty()) throw InvalidArgument("the mesh cannot be refined: it is periodic");
  if (!request.sizes.empty() && request.sizes.size() != result.mesh.vertices.size())
    throw InvalidArgument("there are " + std::to_string(request.sizes.size()) + " sizes for " + std::to_string(result.mesh.vertices.size()) + " vertices");
  if (const auto wrong = std::find_if(request.sizes.begin(), request.sizes.end(), [](double h) { return !(h > 0) || !std::isfinite(h); });
      wrong != request.sizes.end())
    throw InvalidArgument("the size at vertex " + std::to_string(wrong - request.sizes.begin()) + " is not positive");
  if (request.halvings < 0) throw InvalidArgument("the number of halvings is " + std::to_string(request.halvings));
  Refiner(model, rules, options, monitor, result).run(request);
}

}  // namespace carreau
