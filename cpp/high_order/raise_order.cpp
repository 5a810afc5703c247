// SPDX-License-Identifier: BSD-3-Clause
#include "high_order/raise_order.h"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "association/mesh_curves.h"
#include "high_order/thresholds.h"
#include "mesh/local_search.h"
#include "model/nodes_by_place.h"
#include "periodic/closest.h"
#include "periodic/thresholds.h"
#include "support/error.h"
#include "support/infinity.h"
#include "support/pieces.h"
#include "support/rounding_of.h"

namespace carreau {

namespace {

using namespace thresholds::high_order;
using Key = std::array<std::int32_t, 2>;

constexpr std::size_t at_once = 512;

/// An element of a face: local corners, and its nodes.
struct Element {
  std::int32_t face = 0;
  int corners = 3;
  std::array<std::int32_t, 4> local{-1, -1, -1, -1};
  std::array<std::int32_t, 25> node{};
};

class Raiser {
 public:
  Raiser(const CurveModel& model, const CompositeResult& result, int order, NodePlaces places, bool lowers, Monitor& monitor)
      : model_(model), result_(result), mesh_(result.mesh), lowers_(lowers), monitor_(monitor), places_(places_on_edge(order, places)), triangle_(false, order, places),
        quad_(true, order, places), p_(static_cast<std::size_t>(order)) {
    out_.order = order, out_.places = places;
    out_.nodes = mesh_.vertices, out_.corners = static_cast<std::int32_t>(mesh_.vertices.size());
    out_.corner_refs = mesh_.vertex_ref;
    node_uv_.resize(out_.nodes.size(), Vec2{0, 0});
  }

  HighOrderMesh run() {
    place_curves();
    list_elements();
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) place_edges(f);
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) place_inside(f);
    repair();
    for (const PeriodicLink& link : mesh_.periodic) link_nodes(link);
    follow_masters();
    fill();
    associate_nodes();
    return std::move(out_);
  }

 private:
  static Key ordered(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }
  [[nodiscard]] const ElementShape& shape(const Element& e) const { return e.corners == 4 ? quad_ : triangle_; }

  /// First of the nodes on an edge, from its lesser vertex.
  std::int32_t add_nodes(std::size_t n) {
    const auto first = static_cast<std::int32_t>(out_.nodes.size());
    out_.nodes.resize(out_.nodes.size() + n), node_uv_.resize(out_.nodes.size(), Vec2{0, 0});
    return first;
  }

  // The places between two vertices, at shares of the length between them.
  void place_curves() {
    const std::vector<DiscreteCurve> curves = curves_of_mesh(model_, mesh_, result_.curve_parameters);
    for (std::size_t c = 0; c < curves.size(); ++c) {
      const DiscreteCurve& d = curves[c];
      const std::vector<std::int32_t>& chain = mesh_.curves[c].vertices;
      if (d.indivisible || chain.size() < 2) continue;
      const auto owner = static_cast<std::size_t>(d.owner);
      const CurveUse& use = model_.curve(d.curve).uses[owner];
      std::vector<double> r, t;
      for (std::size_t k = 1; k < chain.size(); ++k) {
        const double left = d.t_of_use[owner][k - 1], right = d.t_of_use[owner][k];
        const double off_left = left - parameter_at(model_, use, d.r[k - 1]), off_right = right - parameter_at(model_, use, d.r[k]);
        for (std::size_t i = 1; i < p_; ++i) {
          const double s = places_[i], share = d.r[k - 1] + s * (d.r[k] - d.r[k - 1]);
          double at = parameter_at(model_, use, share) + (1 - s) * off_left + s * off_right;
          if (!(std::min(left, right) < at && at < std::max(left, right))) at = (1 - s) * left + s * right;
          r.push_back(share), t.push_back(at);
        }
        if (k + 1 < chain.size()) r.push_back(d.r[k]), t.push_back(right);
      }
      DiscreteCurve fine = d;
      place_vertices_at(fine, r, t, model_);
      for (std::size_t k = 1; k < chain.size(); ++k) {
        const bool forward = chain[k - 1] < chain[k];
        const auto [found, is_new] = edges_.try_emplace(ordered(chain[k - 1], chain[k]), Edge{});
        if (!is_new) continue;
        found->second = {add_nodes(p_ - 1), true};
        for (std::size_t i = 1; i < p_; ++i) {
          const std::int32_t node = found->second.first + static_cast<std::int32_t>(forward ? i : p_ - i) - 1;
          const std::size_t at = (k - 1) * p_ + i;
          out_.nodes[node] = fine.xyz[at];
          on_curves_.push_back({node, mesh_.curves[c].shown_ref(), fine.t_of_use[owner][at]});
          place_of_[node] = {on_curves_.size() - 1, on_sides_.size(), &use};
          const std::vector<CurveUse>& uses = model_.curve(d.curve).uses;
          for (std::size_t u = 0; u < uses.size(); ++u) on_sides_.push_back({node, uses[u].face, fine.uv_of_use[u][at]});
        }
      }
    }
  }

  void list_elements() {
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      const FaceMesh& face = mesh_.faces[f];
      first_element_.push_back(elements_.size());
      for (std::size_t k = 0; k < static_cast<std::size_t>(face.quads); ++k) elements_.push_back({static_cast<std::int32_t>(f), 4, face.quad(k), {}});
      for (std::size_t t = 2 * static_cast<std::size_t>(face.quads); t < face.triangles.size(); ++t) {
        const auto& [a, b, c] = face.triangles[t];
        elements_.push_back({static_cast<std::int32_t>(f), 3, {a, b, c, -1}, {}});
      }
    }
    first_element_.push_back(elements_.size());
  }

  struct Box {
    Vec2 low, high;
  };
  // Sides of (u, v) that are one point of space.
  static std::map<std::int32_t, Box> poles_of(const FaceMesh& face) {
    std::map<std::int32_t, Box> poles;
    for (std::size_t v = 0; v < face.uv.size(); ++v) {
      const auto [pole, is_new] = poles.try_emplace(face.vertex[v], Box{face.uv[v], face.uv[v]});
      if (!is_new) pole->second = {pole->second.low.cwiseMin(face.uv[v]), pole->second.high.cwiseMax(face.uv[v])};
    }
    std::map<std::int32_t, Box> found;
    for (const auto& t : face.flattened)
      for (std::size_t i = 0; i < 3; ++i)
        if (const std::int32_t v = face.vertex[t[i]]; v == face.vertex[t[(i + 1) % 3]]) found[v] = poles.at(v);
    return found;
  }
  static Vec2 arrival(const FaceMesh& face, const std::map<std::int32_t, Box>& poles, std::int32_t v, const Vec2& other) {
    Vec2 p = face.uv[v];
    const auto pole = poles.find(face.vertex[v]);
    if (pole == poles.end()) return p;
    const auto& [low, high] = pole->second;
    if (low.y() == high.y()) p.x() = std::clamp(other.x(), low.x(), high.x());
    if (low.x() == high.x()) p.y() = std::clamp(other.y(), low.y(), high.y());
    return p;
  }

  /// Nodes of a face with the points that they are near.
  struct Wanted {
    std::vector<std::int32_t> node;
    std::vector<Vec3> target;
    std::vector<Vec2> guess;
    std::vector<double> reach;  // farthest that a closest point may be
  };

  // Closest points; where the way leaves the sheet of the surface, or the host fails beside its domain, the guess.
  void place(std::size_t f, const Wanted& wanted) {
    const int ref = mesh_.faces[f].ref;
    for_pieces(wanted.node.size(), at_once, [&](std::size_t first, std::size_t n) {
      monitor_.checkpoint();
      std::vector<ClosestPoint> points;
      for (std::size_t i = first; i < first + n; ++i) points.push_back({wanted.guess[i], {}, 0});
      bool failed = false;
      try {
        find_closest(model_.cad, ref, std::span(wanted.target).subspan(first, n), points);
      } catch (const CallbackError&) {
        failed = true;
      }
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t k = first + i;
        if (failed || !(points[i].distance <= wanted.reach[k])) {
          points[i].uv = wanted.guess[k];
          points[i].xyz = surface_at(model_.cad, ref, want_position, wanted.guess[k]).s;
        }
        out_.nodes[wanted.node[k]] = points[i].xyz, node_uv_[wanted.node[k]] = points[i].uv;
      }
    });
  }

  void place_edges(std::size_t f) {
    const FaceMesh& face = mesh_.faces[f];
    const std::map<std::int32_t, Box> poles = poles_of(face);
    Wanted wanted;
    for (std::size_t k = first_element_[f]; k < first_element_[f + 1]; ++k) {
      const Element& e = elements_[k];
      for (int i = 0; i < e.corners; ++i) {
        std::int32_t a = e.local[i], b = e.local[(i + 1) % e.corners];
        if (face.vertex[a] > face.vertex[b]) std::swap(a, b);
        const auto [found, is_new] = edges_.try_emplace(Key{face.vertex[a], face.vertex[b]}, Edge{});
        if (!is_new) continue;
        found->second = {add_nodes(p_ - 1), false};
        const Vec3 &from = mesh_.vertices[face.vertex[a]], &to = mesh_.vertices[face.vertex[b]];
        const Vec2 uv_from = arrival(face, poles, a, face.uv[b]), uv_to = arrival(face, poles, b, face.uv[a]);
        for (std::size_t m = 1; m < p_; ++m) {
          wanted.node.push_back(found->second.first + static_cast<std::int32_t>(m) - 1);
          wanted.target.push_back(lerp(from, to, places_[m])), wanted.guess.push_back(lerp(uv_from, uv_to, places_[m]));
          wanted.reach.push_back(max_sagitta * norm(to - from));
        }
      }
    }
    place(f, wanted);
  }

  [[nodiscard]] std::int32_t node_of_side(const FaceMesh& face, const Element& e, int side, std::size_t m) const {
    return node_between(face.vertex[e.local[side]], face.vertex[e.local[(side + 1) % e.corners]], m);
  }

  void place_inside(std::size_t f) {
    const FaceMesh& face = mesh_.faces[f];
    Wanted wanted;
    for (std::size_t k = first_element_[f]; k < first_element_[f + 1]; ++k) {
      Element& e = elements_[k];
      const ElementShape& kind = shape(e);
      std::size_t n = 0;
      for (int i = 0; i < e.corners; ++i) e.node[n++] = face.vertex[e.local[i]];
      for (int i = 0; i < e.corners; ++i)
        for (std::size_t m = 1; m < p_; ++m) e.node[n++] = node_of_side(face, e, i, m);
      const std::int32_t first = add_nodes(kind.node_count() - n);
      for (std::size_t i = n; i < kind.node_count(); ++i) e.node[i] = first + static_cast<std::int32_t>(i - n);
      want_inner(e, wanted);
    }
    place(f, wanted);
  }

  [[nodiscard]] std::array<Vec3, 25> positions(const Element& e) const {
    std::array<Vec3, 25> x;
    for (std::size_t i = 0; i < shape(e).node_count(); ++i) x[i] = out_.nodes[e.node[i]];
    return x;
  }

  // (u, v) of a corner, which at a pole is the mean of the others.
  [[nodiscard]] std::array<Vec2, 4> corners_uv(const Element& e) const {
    const FaceMesh& face = mesh_.faces[e.face];
    const std::map<std::int32_t, Box>& poles = poles_known(e.face);
    std::array<Vec2, 4> uv;
    for (int i = 0; i < e.corners; ++i) {
      Vec2 mean{0, 0};
      for (int k = 1; k < e.corners; ++k) mean += face.uv[e.local[(i + k) % e.corners]] / (e.corners - 1);
      uv[i] = arrival(face, poles, e.local[i], mean);
    }
    return uv;
  }
  [[nodiscard]] const std::map<std::int32_t, Box>& poles_known(std::int32_t f) const {
    if (poles_of_ != f) poles_ = poles_of(mesh_.faces[f]), poles_of_ = f;
    return poles_;
  }

  void want_inner(const Element& e, Wanted& wanted) const {
    const ElementShape& kind = shape(e);
    std::array<Vec3, 25> x = positions(e);
    kind.place_inner(std::span(x.data(), kind.node_count()));
    const std::array<Vec2, 4> uv = corners_uv(e);
    double longest = 0;
    for (int i = 0; i < e.corners; ++i) longest = std::max(longest, norm(x[(i + 1) % e.corners] - x[i]));
    for (std::size_t i = kind.first_inner(); i < kind.node_count(); ++i) {
      const double s = kind.reference()[i].x(), t = kind.reference()[i].y();
      wanted.node.push_back(e.node[i]), wanted.target.push_back(x[i]);
      wanted.guess.push_back(e.corners == 4 ? Vec2((1 - s) * (1 - t) * uv[0] + s * (1 - t) * uv[1] + s * t * uv[2] + (1 - s) * t * uv[3])
                                            : Vec2((1 - s - t) * uv[0] + s * uv[1] + t * uv[2]));
      wanted.reach.push_back(max_sagitta * longest);
    }
  }

  [[nodiscard]] double score(const Element& e) const {
    const std::array<Vec3, 25> x = positions(e);
    return shape(e).least_jacobian(std::span(x.data(), shape(e).node_count()));
  }

  // ---- Repairs ----

  void repair() {
    std::vector<std::size_t> bad;
    for (std::size_t k = 0; k < elements_.size(); ++k) {
      if (k % 4096 == 0) monitor_.checkpoint();
      if (score(elements_[k]) < least_jacobian) bad.push_back(k);
    }
    if (bad.empty()) return;
    list_neighbours();
    const std::size_t first = bad.size();
    for (int round = 0; round < max_rounds && !bad.empty(); ++round) {
      for (const std::size_t k : bad) {
        monitor_.checkpoint();
        move_inner(k);
        if (score(elements_[k]) >= least_jacobian) continue;
        if (round == 0) follow_second_order(k);
        move_edges(k);
      }
      std::erase_if(bad, [&](std::size_t k) { return score(elements_[k]) >= least_jacobian; });
    }
    out_.repaired = static_cast<std::int64_t>(first - bad.size());
    if (lowers_) lower(bad);
    invalid_ = bad;
  }

  void list_neighbours() {
    for (std::size_t k = 0; k < elements_.size(); ++k)
      for (int i = 0; i < elements_[k].corners; ++i) {
        const Element& e = elements_[k];
        const FaceMesh& face = mesh_.faces[e.face];
        around_[ordered(face.vertex[e.local[i]], face.vertex[e.local[(i + 1) % e.corners]])].push_back(k);
      }
  }

  [[nodiscard]] std::array<Vec2, 2> box(const Element& e) const {
    Vec2 low{infinity, infinity}, high = -low;
    const std::array<Vec2, 4> uv = corners_uv(e);
    for (int i = 0; i < e.corners; ++i) low = low.cwiseMin(uv[i]), high = high.cwiseMax(uv[i]);
    return {low, high};
  }

  /// Moves one node in (u, v) to the best value of `judge`; the host may fail beside its domain.
  template <typename Judge>
  bool search(std::int32_t node, const Element& e, const Judge& judge) {
    const auto [low, high] = box(e);
    const Vec2 size = high - low, home = node_uv_[node];
    const int ref = mesh_.faces[e.face].ref;
    const Vec3 home_xyz = out_.nodes[node];
    const auto put = [&](const Vec2& uv) {
      try {
        out_.nodes[node] = surface_at(model_.cad, ref, want_position, uv).s;
      } catch (const CallbackError&) {
        return false;
      }
      node_uv_[node] = uv;
      return true;
    };
    const double before = judge();
    const Vec2 by = search_along_compass(before, first_step, last_step, [&](const Vec2& step, double) {
      const Vec2 uv = home + step.cwiseProduct(size);
      if ((uv.array() < (low - 0.5 * size).array()).any() || (uv.array() > (high + 0.5 * size).array()).any()) return -infinity;
      return put(uv) ? judge() : -infinity;
    });
    node_uv_[node] = home, out_.nodes[node] = home_xyz;
    if (by == Vec2{0, 0}) return (void)judge(), false;
    put(home + by.cwiseProduct(size));
    (void)judge();
    return true;
  }

  void move_inner(std::size_t k) {
    const Element& e = elements_[k];
    for (std::size_t i = shape(e).first_inner(); i < shape(e).node_count(); ++i) search(e.node[i], e, [&] { return std::min(good_jacobian, score(e)); });
  }

  /// Inner nodes where the edges imply them.
  void settle(const Element& e) {
    Wanted wanted;
    want_inner(e, wanted);
    place(static_cast<std::size_t>(e.face), wanted);
  }

  [[nodiscard]] double worst(const std::vector<std::size_t>& all) const {
    double least = good_jacobian;
    for (const std::size_t k : all) least = std::min(least, score(elements_[k]));
    return least;
  }

  /// The state of the elements at an edge, to undo.
  struct Saved {
    std::vector<std::int32_t> node;
    std::vector<Vec3> xyz;
    std::vector<Vec2> uv;
  };
  [[nodiscard]] Saved save(const std::vector<std::size_t>& all) const {
    Saved saved;
    for (const std::size_t k : all)
      for (std::size_t i = 0; i < shape(elements_[k]).node_count(); ++i) {
        const std::int32_t node = elements_[k].node[i];
        saved.node.push_back(node), saved.xyz.push_back(out_.nodes[node]), saved.uv.push_back(node_uv_[node]);
      }
    return saved;
  }
  void restore(const Saved& saved) {
    for (std::size_t i = 0; i < saved.node.size(); ++i) out_.nodes[saved.node[i]] = saved.xyz[i], node_uv_[saved.node[i]] = saved.uv[i];
  }

  /// Index in FaceMesh::mid_uv of the node of second order on a side of an element.
  [[nodiscard]] std::int32_t mid_of(std::size_t k, int side) const {
    const Element& e = elements_[k];
    const FaceMesh& face = mesh_.faces[e.face];
    const std::size_t first = k - first_element_[e.face];
    const std::size_t t = e.corners == 4 ? 2 * first + (side < 2 ? 0 : 1) : first + static_cast<std::size_t>(face.quads);
    return face.mid[t][e.corners == 4 && side >= 2 ? side - 1 : side];
  }

  [[nodiscard]] std::vector<std::size_t> neighbours(std::size_t k) const {
    const Element& e = elements_[k];
    const FaceMesh& face = mesh_.faces[e.face];
    std::vector<std::size_t> beside;
    for (int i = 0; i < e.corners; ++i)
      for (const std::size_t n : around_.at(ordered(face.vertex[e.local[i]], face.vertex[e.local[(i + 1) % e.corners]])))
        if (n != k) beside.push_back(n);
    return beside;
  }

  // Gives an element the polynomial of order 2.
  void take_second_order(std::size_t k) {
    const Element& e = elements_[k];
    const FaceMesh& face = mesh_.faces[e.face];
    for (int i = 0; i < e.corners; ++i) {
      const std::int32_t mid = mid_of(k, i);
      if (mid < 0) continue;
      const Vec3 &p = out_.nodes[e.node[i]], &q = out_.nodes[e.node[(i + 1) % e.corners]], &m = mesh_.mid_vertices[face.mid_vertex[mid]];
      for (std::size_t n = 1; n < p_; ++n) {
        const double s = places_[n];
        const std::int32_t node = e.node[static_cast<std::size_t>(e.corners) + static_cast<std::size_t>(i) * (p_ - 1) + n - 1];
        out_.nodes[node] = (1 - s) * (1 - 2 * s) * p + 4 * s * (1 - s) * m + s * (2 * s - 1) * q;
        node_uv_[node] = {nan, nan};  // beside the surface
      }
    }
    std::array<Vec3, 25> x = positions(e);
    shape(e).place_inner(std::span(x.data(), shape(e).node_count()));
    for (std::size_t i = shape(e).first_inner(); i < shape(e).node_count(); ++i) out_.nodes[e.node[i]] = x[i], node_uv_[e.node[i]] = {nan, nan};
  }

  // Elements of order 2 are valid: as polynomials of a higher order they are, too. Neighbours that become invalid follow.
  bool lower(std::size_t k, std::vector<std::size_t>& lowered) {
    std::vector<std::size_t> group{k};
    std::map<std::size_t, bool> was_valid{{k, false}};
    std::vector<Saved> saved{save(group)};
    for (int ring = 0; ring < max_rings; ++ring) {
      for (const std::size_t member : group)
        for (const std::size_t n : neighbours(member))
          if (was_valid.try_emplace(n, score(elements_[n]) >= least_jacobian).second) saved.push_back(save({n}));
      for (const std::size_t member : group) take_second_order(member);
      std::vector<std::size_t> broken;
      for (const auto& [n, valid] : was_valid) {
        if (std::find(group.begin(), group.end(), n) != group.end()) continue;
        settle(elements_[n]);
        if (valid && score(elements_[n]) < least_jacobian) broken.push_back(n);
      }
      if (broken.empty()) {
        if (std::any_of(group.begin(), group.end(), [&](std::size_t n) { return score(elements_[n]) < least_jacobian; })) break;
        lowered.insert(lowered.end(), group.begin(), group.end());
        return true;
      }
      group.insert(group.end(), broken.begin(), broken.end());
    }
    for (auto state = saved.rbegin(); state != saved.rend(); ++state) restore(*state);
    return false;
  }

  void lower(std::vector<std::size_t>& bad) {
    std::vector<std::size_t> lowered;
    for (const std::size_t k : bad)
      if (!mesh_.faces[elements_[k].face].mid.empty() && score(elements_[k]) < least_jacobian) lower(k, lowered);
    std::erase_if(bad, [&](std::size_t k) { return score(elements_[k]) >= least_jacobian; });
    std::sort(lowered.begin(), lowered.end());
    const auto count = std::unique(lowered.begin(), lowered.end()) - lowered.begin();
    if (count > 0)
      monitor_.message(Level::summary, std::to_string(count) + (count == 1 ? " element has" : " elements have") + " the shape of order 2: order " +
                                           std::to_string(p_) + " is invalid there or beside, where curves meet at no angle");
  }

  // The parabola through the node of second order, which repairs of that order have found.
  void follow_second_order(std::size_t k) {
    const Element& e = elements_[k];
    const FaceMesh& face = mesh_.faces[e.face];
    if (face.mid.empty()) return;
    for (int i = 0; i < e.corners; ++i) {
      const std::int32_t mid = mid_of(k, i);
      std::int32_t a = e.local[i], b = e.local[(i + 1) % e.corners];
      if (face.vertex[a] > face.vertex[b]) std::swap(a, b);
      const Key key{face.vertex[a], face.vertex[b]};
      const Edge& edge = edges_.at(key);
      if (mid < 0 || edge.fixed) continue;
      const std::vector<std::size_t>& beside = around_.at(key);
      const Saved saved = save(beside);
      const double before = worst(beside);
      const Vec3 &p = mesh_.vertices[key[0]], &q = mesh_.vertices[key[1]], &m = mesh_.mid_vertices[face.mid_vertex[mid]];
      Wanted wanted;
      for (std::size_t n = 1; n < p_; ++n) {
        const double s = places_[n];
        wanted.node.push_back(edge.first + static_cast<std::int32_t>(n) - 1);
        wanted.target.push_back((1 - s) * (1 - 2 * s) * p + 4 * s * (1 - s) * m + s * (2 * s - 1) * q);
        wanted.guess.push_back((1 - s) * (1 - 2 * s) * face.uv[a] + 4 * s * (1 - s) * face.mid_uv[mid] + s * (2 * s - 1) * face.uv[b]);
        wanted.reach.push_back(max_sagitta * norm(q - p));
      }
      place(static_cast<std::size_t>(e.face), wanted);
      for (const std::size_t n : beside) settle(elements_[n]);
      if (!(worst(beside) > before)) restore(saved);
    }
  }

  void move_edges(std::size_t k) {
    const Element& e = elements_[k];
    const FaceMesh& face = mesh_.faces[e.face];
    for (int i = 0; i < e.corners && score(e) < least_jacobian; ++i) {
      const Key key = ordered(face.vertex[e.local[i]], face.vertex[e.local[(i + 1) % e.corners]]);
      const Edge& edge = edges_.at(key);
      if (edge.fixed) continue;
      const std::vector<std::size_t>& beside = around_.at(key);
      for (std::size_t m = 0; m + 1 < p_; ++m) {
        const Saved saved = save(beside);
        const double before = worst(beside);
        search(edge.first + static_cast<std::int32_t>(m), e, [&] {
          for (const std::size_t n : beside) settle(elements_[n]);
          return worst(beside);
        });
        if (!(worst(beside) > before)) restore(saved);
      }
    }
  }

  void fill() {
    std::vector<std::int32_t> number(elements_.size());
    std::int32_t triangles = 0, quads = 0;
    for (const Element& e : elements_) {
      const int ref = mesh_.faces[e.face].shown_ref();
      std::vector<std::int32_t>& rows = e.corners == 4 ? out_.quads : out_.triangles;
      rows.insert(rows.end(), e.node.begin(), e.node.begin() + static_cast<std::ptrdiff_t>(shape(e).node_count()));
      (e.corners == 4 ? out_.quad_refs : out_.triangle_refs).push_back(ref);
      number[&e - elements_.data()] = e.corners == 4 ? quads++ : triangles++;
    }
    for (const std::size_t k : invalid_) out_.invalid.push_back(number[k] + (elements_[k].corners == 4 ? triangles : 0));
    std::sort(out_.invalid.begin(), out_.invalid.end());
    for (const std::size_t k : invalid_) list_coarse(elements_[k]);
    for (const CurveMesh& curve : mesh_.curves)
      for (std::size_t k = 1; k < curve.vertices.size(); ++k) {
        const std::int32_t a = curve.vertices[k - 1], b = curve.vertices[k];
        out_.edges.insert(out_.edges.end(), {a, b});
        for (std::size_t m = 1; m < p_; ++m) out_.edges.push_back(node_between(a, b, m));
        out_.edge_refs.push_back(curve.shown_ref());
      }
    for (const FaceMesh& face : mesh_.faces)
      if (!face.name.empty()) out_.face_names.emplace_back(face.shown_ref(), face.name);
  }

  /// The node of order p at rank m from vertex a to b.
  [[nodiscard]] std::int32_t node_between(std::int32_t a, std::int32_t b, std::size_t m) const {
    return edges_.at(ordered(a, b)).first + static_cast<std::int32_t>(a < b ? m : p_ - m) - 1;
  }

  // Nodes of edges follow their vertices; inner nodes are next to the images of their masters.
  void link_nodes(const PeriodicLink& of) {
    PeriodicLink link{of.dimension, of.master, of.slave, of.map, {}};
    std::map<std::int32_t, std::int32_t> master;
    for (const auto& [slave, image] : of.nodes)
      if (slave < out_.corners && image < out_.corners) master.emplace(slave, image), link.nodes.push_back({slave, image});
    const auto link_edge = [&](std::int32_t a, std::int32_t b) {
      const auto ma = master.find(a), mb = master.find(b);
      if (ma == master.end() || mb == master.end() || !edges_.contains(ordered(a, b)) || !edges_.contains(ordered(ma->second, mb->second))) return;
      for (std::size_t m = 1; m < p_; ++m) link.nodes.push_back({node_between(a, b, m), node_between(ma->second, mb->second, m)});
    };
    if (of.dimension == 1 && of.master == of.slave) return link_itself(of);
    if (of.dimension == 1)
      for (const CurveMesh& curve : mesh_.curves)
        for (std::size_t k = 1; curve.shown_ref() == of.slave && k < curve.vertices.size(); ++k) link_edge(curve.vertices[k - 1], curve.vertices[k]);
    if (of.dimension == 2) {
      std::map<std::vector<std::int32_t>, const Element*> masters;  // by ascending vertices
      const auto corners_of = [](const Element& e) { return std::vector<std::int32_t>(e.node.begin(), e.node.begin() + e.corners); };
      for (const Element& e : elements_) {
        if (mesh_.faces[e.face].shown_ref() != of.master) continue;
        std::vector<std::int32_t> corners = corners_of(e);
        std::sort(corners.begin(), corners.end());
        masters.emplace(std::move(corners), &e);
      }
      for (const Element& e : elements_) {
        if (mesh_.faces[e.face].shown_ref() != of.slave) continue;
        std::vector<std::int32_t> images;
        for (const std::int32_t v : corners_of(e))
          if (const auto image = master.find(v); image != master.end()) images.push_back(image->second);
        for (int i = 0; i < e.corners; ++i) link_edge(e.node[static_cast<std::size_t>(i)], e.node[static_cast<std::size_t>((i + 1) % e.corners)]);
        std::sort(images.begin(), images.end());
        const auto found = masters.find(images);
        if (found != masters.end()) link_inner(e, *found->second, link);
      }
    }
    std::sort(link.nodes.begin(), link.nodes.end());
    link.nodes.erase(std::unique(link.nodes.begin(), link.nodes.end()), link.nodes.end());
    out_.periodic.push_back(std::move(link));
  }

  // All maps of a curve onto itself at once, with the first of them.
  void link_itself(const PeriodicLink& of) {
    const auto is_of_curve = [&of](const PeriodicLink& link) { return link.dimension == 1 && link.master == of.master && link.slave == of.master; };
    if (std::any_of(out_.periodic.begin(), out_.periodic.end(), is_of_curve)) return;
    std::vector<std::int32_t> nodes;
    for (const CurveMesh& curve : mesh_.curves)
      if (curve.shown_ref() == of.master) nodes.insert(nodes.end(), curve.vertices.begin(), curve.vertices.end());
    for (const MeshAssociation::OnCurve& on : on_curves_)
      if (on.ref == of.master) nodes.push_back(on.node);
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    const NodesByPlace::Positions position = [this](std::int32_t v) { return out_.nodes[v]; };
    const NodesByPlace places(nodes, position, out_.corners, thresholds::periodic::max_gap * result_.report.diag);
    std::vector<NodeImages> images;
    for (const PeriodicLink& link : mesh_.periodic) {
      if (!is_of_curve(link)) continue;
      NodeImages& all = images.emplace_back();
      for (const std::int32_t v : nodes) places.for_near(link.map(out_.nodes[v]), v, [&](std::int32_t w) { all.push_back({v, w}); });
    }
    std::vector<NodeImages> pairs = pairs_of_orbits(images);
    std::size_t m = 0;
    for (const PeriodicLink& link : mesh_.periodic) {
      if (!is_of_curve(link)) continue;
      std::sort(pairs[m].begin(), pairs[m].end());
      out_.periodic.push_back({1, of.master, of.master, link.map, std::move(pairs[m++])});
    }
  }

  /// A node of a curve: its record there, its first record by use, and the use that has the curve's parameter.
  struct CurvePlace {
    std::size_t on_curve = 0, side = 0;
    const CurveUse* use = nullptr;
  };

  // Tables of lengths have placed nodes of curves; images of nodes have the places of the images, first on the roots of classes.
  void follow_on_curves() {
    const double exact = rounding_of::places * thresholds::periodic::max_gap * result_.report.diag;
    std::set<std::int32_t> moved;
    for (const bool itself : {true, false})
      for (const PeriodicLink& link : out_.periodic) {
        if (link.dimension != 1 || (link.master == link.slave) != itself) continue;
        for (const auto& [slave, master] : link.nodes)
          if (const auto found = place_of_.find(slave); found != place_of_.end() && move_on_curve(slave, found->second, master, link.map, exact))
            moved.insert(slave);
      }
    for (std::size_t k = 0; k < elements_.size() && !moved.empty(); ++k) {
      const Element& e = elements_[k];
      if (std::none_of(e.node.begin(), e.node.begin() + static_cast<std::ptrdiff_t>(shape(e).node_count()), [&](std::int32_t v) { return moved.contains(v); })) continue;
      std::erase(invalid_, k);
      if (score(e) < least_jacobian) invalid_.insert(std::lower_bound(invalid_.begin(), invalid_.end(), k), k);
    }
  }

  // True: by more than rounding.
  bool move_on_curve(std::int32_t node, const CurvePlace& place, std::int32_t master, const Isometry& map, double exact) {
    const Vec3 target = map(out_.nodes[master]);
    const bool is_near = norm(target - out_.nodes[node]) <= exact, is_off = !is_finite(node_uv_[master]);
    node_uv_[node] = node_uv_[master];
    if (is_near || is_off) {
      out_.nodes[node] = target;
      return !is_near;
    }
    const CurveSupport& support = model_.support(*place.use);
    double& t = on_curves_[place.on_curve].t;
    const CurvePoint found = find_closest(model_, *place.use, t, support.t.front(), support.t.back(), target);
    t = found.t;
    out_.nodes[node] = found.distance <= exact ? target : found.xyz;
    for (std::size_t k = place.side; k < on_sides_.size() && on_sides_[k].node == node; ++k) {
      ClosestPoint point{on_sides_[k].uv, {}, 0};
      find_closest(model_.cad, mesh_.faces[static_cast<std::size_t>(on_sides_[k].face)].ref, {&target, 1}, {&point, 1});
      on_sides_[k].uv = point.uv;
    }
    return true;
  }

  // Repairs have moved nodes of a face and of its image each in their own way: the image follows.
  void follow_masters() {
    follow_on_curves();
    std::vector<char> on_curve(out_.nodes.size(), 0);
    for (const MeshAssociation::OnCurve& on : on_curves_) on_curve[on.node] = 1;
    for (const PeriodicLink& link : out_.periodic) {
      if (link.dimension != 2) continue;
      const std::map<std::int32_t, std::int32_t> master = [&] {
        std::map<std::int32_t, std::int32_t> by_slave;
        for (const auto& [slave, image] : link.nodes) by_slave.emplace(slave, image);
        return by_slave;
      }();
      std::map<std::size_t, Wanted> wanted;  // by face
      std::vector<std::size_t> changed;
      for (std::size_t k = 0; k < elements_.size(); ++k) {
        const Element& e = elements_[k];
        if (mesh_.faces[e.face].shown_ref() != link.slave) continue;
        const double size = norm(out_.nodes[e.node[0]] - out_.nodes[e.node[2]]);
        for (std::size_t i = static_cast<std::size_t>(e.corners); i < shape(e).node_count(); ++i) {
          const auto found = master.find(e.node[i]);
          if (found == master.end() || on_curve[e.node[i]] != 0) continue;
          const Vec3 image = link.map(out_.nodes[found->second]);
          if (norm(image - out_.nodes[e.node[i]]) <= rounding_of::digits * size) continue;
          changed.push_back(k);
          if (is_finite(node_uv_[found->second]) && is_finite(node_uv_[e.node[i]])) {
            Wanted& of = wanted[static_cast<std::size_t>(e.face)];
            of.node.push_back(e.node[i]), of.target.push_back(image), of.guess.push_back(node_uv_[e.node[i]]), of.reach.push_back(rounding_of::sizes * size);
          } else {
            out_.nodes[e.node[i]] = image, node_uv_[e.node[i]] = {nan, nan};
          }
        }
      }
      for (const auto& [f, of] : wanted) place(f, of);
      std::erase_if(invalid_, [&](std::size_t k) { return std::binary_search(changed.begin(), changed.end(), k); });
      changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
      for (const std::size_t k : changed)
        if (score(elements_[k]) < least_jacobian) invalid_.push_back(k);
      std::sort(invalid_.begin(), invalid_.end());
    }
  }

  void link_inner(const Element& slave, const Element& master, PeriodicLink& link) const {
    for (std::size_t i = shape(slave).first_inner(); i < shape(slave).node_count(); ++i) {
      std::int32_t nearest = -1;
      double least = infinity;
      for (std::size_t k = shape(master).first_inner(); k < shape(master).node_count(); ++k)
        if (const double apart = norm(link.map(out_.nodes[master.node[k]]) - out_.nodes[slave.node[i]]); apart < least) least = apart, nearest = master.node[k];
      if (nearest >= 0) link.nodes.push_back({slave.node[i], nearest});
    }
  }

  // Nodes that repairs have moved off the surface have no parameters.
  void associate_nodes() {
    MeshAssociation& all = out_.association;
    const auto shown = [this](std::int32_t ref) {
      const auto found = model_.model.shown_points.find(ref);
      return found != model_.model.shown_points.end() ? found->second : ref;
    };
    all = associate(mesh_, result_.curve_parameters, {}, shown, [](std::size_t face, std::int32_t) { return face; });
    const auto corner = [this](const auto& record) { return record.node < out_.corners; };
    std::erase_if(all.curves, std::not_fn(corner)), std::erase_if(all.faces, std::not_fn(corner));
    all.entities.resize(static_cast<std::size_t>(out_.corners)), all.entities.resize(out_.nodes.size());
    all.cell_uv.clear();
    const auto is_on_surface = [this](std::int32_t node) { return is_finite(node_uv_[node]); };
    for (const MeshAssociation::OnCurve& on : on_curves_) {
      all.entities[on.node] = {1, on.ref};
      if (is_on_surface(on.node)) all.curves.push_back(on);
    }
    std::stable_sort(on_sides_.begin(), on_sides_.end(), [](const auto& a, const auto& b) { return a.node < b.node; });
    for (const auto& [node, face, uv] : on_sides_)
      if (is_on_surface(node)) all.faces.push_back({node, mesh_.faces[face].shown_ref(), uv});
    for (const int corners : {3, 4})
      for (const Element& e : elements_)
        if (e.corners == corners) associate_element(e, all);
    all.sort();
  }

  void associate_element(const Element& e, MeshAssociation& all) {
    const FaceMesh& face = mesh_.faces[e.face];
    const auto corner = [&](int i) -> Vec2 { return face.uv[e.local[i]]; };
    const auto inner = static_cast<std::size_t>(e.corners);
    for (std::size_t i = 0; i < shape(e).node_count(); ++i) {
      const std::int32_t node = e.node[i];
      if (i < inner) {
        all.cell_uv.push_back(corner(static_cast<int>(i)));
      } else if (all.entities[node].dimension == 2) {
        all.entities[node].ref = face.shown_ref();
        if (is_finite(node_uv_[node])) all.faces.push_back({node, face.shown_ref(), node_uv_[node]});
        all.cell_uv.push_back(node_uv_[node]);
      } else {  // on a curve, whose side of a seam is near the element
        const double s = shape(e).reference()[i].x(), t = shape(e).reference()[i].y();
        const Vec2 near = e.corners == 4 ? Vec2((1 - s) * (1 - t) * corner(0) + s * (1 - t) * corner(1) + s * t * corner(2) + (1 - s) * t * corner(3))
                                         : Vec2((1 - s - t) * corner(0) + s * corner(1) + t * corner(2));
        Vec2 best{nan, nan};
        auto on = std::lower_bound(on_sides_.begin(), on_sides_.end(), node, [](const auto& side, std::int32_t n) { return side.node < n; });
        for (; on != on_sides_.end() && on->node == node && is_finite(node_uv_[node]); ++on)
          if (on->face == e.face && !(norm(on->uv - near) >= norm(best - near))) best = on->uv;
        all.cell_uv.push_back(best);
      }
    }
  }

  void list_coarse(const Element& e) {
    const FaceMesh& face = mesh_.faces[e.face];
    const auto list = [&](bool of_curves) {
      for (int i = 0; i < e.corners; ++i) {
        const Key key = ordered(face.vertex[e.local[i]], face.vertex[e.local[(i + 1) % e.corners]]);
        if (of_curves || !edges_.at(key).fixed) out_.coarse.push_back(key);
      }
    };
    const std::size_t before = out_.coarse.size();
    list(false);
    if (out_.coarse.size() == before) list(true);
  }

  struct Edge {
    std::int32_t first = -1;
    bool fixed = false;  // on a curve
  };
  const CurveModel& model_;
  const CompositeResult& result_;
  const SurfaceMesh& mesh_;
  bool lowers_;
  Monitor& monitor_;
  std::vector<double> places_;
  ElementShape triangle_, quad_;
  std::size_t p_;
  HighOrderMesh out_;
  std::vector<Vec2> node_uv_;  // of inner nodes and nodes of inner edges
  std::map<Key, Edge> edges_;
  struct OnSide {
    std::int32_t node;
    int face;  // by index
    Vec2 uv;
  };
  std::vector<MeshAssociation::OnCurve> on_curves_;  // nodes of curves
  std::vector<OnSide> on_sides_;                     // the same by use
  std::map<std::int32_t, CurvePlace> place_of_;      // by node of a curve
  std::vector<Element> elements_;
  std::vector<std::size_t> first_element_;  // by face
  std::map<Key, std::vector<std::size_t>> around_;
  std::vector<std::size_t> invalid_;
  mutable std::map<std::int32_t, Box> poles_;  // of face poles_of_
  mutable std::int32_t poles_of_ = -1;
};

}  // namespace

HighOrderMesh raise_order(const CurveModel& model, const CompositeResult& result, int order, NodePlaces places, bool lowers, Monitor& monitor) {
  if (order < 2 || order > 4) throw InvalidArgument("the order is " + std::to_string(order) + "; it must be 2, 3 or 4");
  return Raiser(model, result, order, places, lowers, monitor).run();
}

HighOrderMesh with_places(const HighOrderMesh& mesh, NodePlaces places) {
  if (mesh.places == places) return mesh;
  HighOrderMesh out = mesh;
  out.places = places, out.association = {};
  const auto move = [&](bool quad, const std::vector<std::int32_t>& rows) {
    const ElementShape before(quad, mesh.order, mesh.places), after(quad, mesh.order, places);
    const std::vector<double> values = before.values_at(after.reference());
    const std::size_t n = before.node_count();
    for (std::size_t row = 0; row < rows.size(); row += n)
      for (std::size_t i = static_cast<std::size_t>(before.corner_count()); i < n; ++i) {
        Vec3 sum(0, 0, 0);
        for (std::size_t k = 0; k < n; ++k) sum += values[i * n + k] * mesh.nodes[rows[row + k]];
        out.nodes[rows[row + i]] = sum;
      }
  };
  move(false, mesh.triangles), move(true, mesh.quads);
  const std::vector<double> from = places_on_edge(mesh.order, mesh.places), to = places_on_edge(mesh.order, places);
  const auto p = static_cast<std::size_t>(mesh.order);
  for (std::size_t row = 0; row < mesh.edges.size(); row += p + 1)  // edges without an element too
    for (std::size_t i = 1; i < p; ++i) {
      Vec3 sum(0, 0, 0);
      for (std::size_t k = 0; k <= p; ++k) {
        double weight = 1;
        for (std::size_t m = 0; m <= p; ++m)
          if (m != k) weight *= (to[i] - from[m]) / (from[k] - from[m]);
        sum += weight * mesh.nodes[mesh.edges[row + (k == 0 ? 0 : k == p ? 1 : k + 1)]];
      }
      out.nodes[mesh.edges[row + i + 1]] = sum;
    }
  return out;
}

}  // namespace carreau
