// SPDX-License-Identifier: BSD-3-Clause
// One layer of triangles between the two sides of a narrow face.
#include <algorithm>
#include <cmath>

#include "mesh/quality.h"
#include "predicates/predicates.h"
#include "support/infinity.h"
#include "surface/narrow/narrow_faces.h"
#include "surface/narrow/side_ruler.h"

namespace carreau {

namespace {

using Chain = std::vector<std::int32_t>;  // local vertices
using Triangle = std::array<std::int32_t, 3>;

class Ladder {
 public:
  Ladder(const CurveModel& model, const NarrowFace& narrow, const std::vector<DiscreteCurve>& curves)
      : model_(model), narrow_(narrow), curves_(curves) {}

  NarrowPatch run() {
    patch_.domain = collect_face_domain(model_.model, model_.topology, curves_, narrow_.face);
    collect_chains();
    patch_.mesh.plane.vertices = patch_.domain.plane.vertices;
    patch_.mesh.xyz = positions_on_curves(patch_.domain, curves_, model_.topology);
    patch_.mesh.size = patch_.domain.size;
    const SideRuler ruler(model_, narrow_.face, narrow_.side[1]);
    for (int k = 0; k < 2; ++k) side_[k] = chain_of(narrow_.side[k]);
    place_vertices_on(ruler);
    climb();
    turn();
    patch_.sound = !triangles().empty() && std::all_of(triangles().begin(), triangles().end(),
                                                       [this](const Triangle& t) { return is_sound(t); });
    return std::move(patch_);
  }

 private:
  std::vector<Triangle>& triangles() { return patch_.mesh.plane.triangles; }

  // The edges of a domain come curve by curve, in the direction of the curve's first use.
  void collect_chains() {
    const std::vector<int>& curve_of = model_.topology.curve_of[narrow_.face];
    std::size_t edge = 0;
    for (const int curve : curve_of) {
      Chain chain;
      for (int k = 0; k < curves_[curve].segments(); ++k, ++edge) {
        const PlaneEdge& e = patch_.domain.plane.edges[edge];
        if (k == 0) chain.push_back(e.a);
        chain.push_back(e.b);
      }
      of_curve_.push_back(std::move(chain));
    }
  }
  [[nodiscard]] Chain chain_of(const Side& side) const {
    const SideRuler ruler(model_, narrow_.face, side);
    Chain chain;
    for (std::size_t p = 0; p < side.size(); ++p) {
      Chain part = of_curve_[side[p].curve];
      if (ruler.against(p)) std::reverse(part.begin(), part.end());
      chain.insert(chain.end(), part.begin() + (chain.empty() ? 0 : 1), part.end());
    }
    return chain;
  }

  // Places the vertices of both sides along side[1]. A ring starts at the first vertex of side[0] and at its nearest
  // neighbour, and ends there.
  void place_vertices_on(const SideRuler& ruler) {
    const double length = ruler.length();
    for (const std::int32_t v : side_[0]) s_[0].push_back(ruler.place_of(patch_.mesh.xyz[v]).s);
    for (std::size_t p = 0; p < ruler.parts(); ++p) {
      std::vector<double> s;
      for (const double r : curves_[ruler.curve(p)].r) s.push_back(ruler.s_of(p, r));
      if (ruler.against(p)) std::reverse(s.begin(), s.end());
      s_[1].insert(s_[1].end(), s.begin() + (p == 0 ? 0 : 1), s.end());
    }
    if (narrow_.ring) start_rings_together(length);
    s_[0].front() = s_[1].front() = 0;
    s_[0].back() = s_[1].back() = length;
    for (std::size_t i = 1; i < s_[0].size(); ++i) s_[0][i] = std::clamp(s_[0][i], s_[0][i - 1], length);
  }
  void start_rings_together(double length) {
    Chain& other = side_[1];
    other.pop_back(), s_[1].pop_back();
    const double start = s_[0].front();
    std::size_t first = 0;
    const auto gap = [&](std::size_t i) { return std::abs(std::remainder(s_[1][i] - start, length)); };
    for (std::size_t i = 1; i < other.size(); ++i)
      if (gap(i) < gap(first)) first = i;
    std::rotate(other.begin(), other.begin() + static_cast<std::ptrdiff_t>(first), other.end());
    std::rotate(s_[1].begin(), s_[1].begin() + static_cast<std::ptrdiff_t>(first), s_[1].end());
    other.push_back(other.front()), s_[1].push_back(s_[1].front());
    const double origin = s_[1].front();
    for (auto& s : s_)
      for (double& x : s) {
        x -= origin;
        if (x < 0) x += length;
      }
  }

  void climb() {
    const Chain &a = side_[0], &b = side_[1];
    const Chain last = closing_chain(1);
    Chain left = closing_chain(0);
    patch_.one.push_back(left);
    const double near = same_place_distance(narrow_, SideRuler(model_, narrow_.face, narrow_.side[1]));
    for (std::size_t i = 0, j = 0; i + 1 < a.size() || j + 1 < b.size();) {
      // The last step is for both sides.
      const bool a_ends = i + 2 >= a.size(), b_ends = j + 2 >= b.size();
      const double gap = a_ends || b_ends ? 0 : s_[0][i + 1] - s_[1][j + 1];
      if (a_ends == b_ends && std::abs(gap) <= near) {
        ++i, ++j;
        const Chain right = a_ends ? last : Chain{a[i], b[j]};
        add_cell(left, right);
        if (!(a_ends && narrow_.ring)) patch_.one.push_back(right);
        left = right;
        continue;
      }
      const bool on_a = a_ends == b_ends ? gap < 0 : b_ends;
      const std::int32_t apex = on_a ? a[++i] : b[++j];
      add_fan(apex, left);
      left = {a[i], b[j]};
      patch_.one.back().push_back(apex);
    }
  }

  // From side[0] to side[1] at its start or end.
  [[nodiscard]] Chain closing_chain(int end) const {
    const std::int32_t a = end == 0 ? side_[0].front() : side_[0].back();
    const std::int32_t b = end == 0 ? side_[1].front() : side_[1].back();
    if (!narrow_.end_cap[end].empty()) return chain_of(narrow_.end_cap[end]);
    return a == b ? Chain{a} : Chain{a, b};
  }

  static void add_fan_to(std::vector<Triangle>& to, std::int32_t apex, const Chain& left) {
    for (std::size_t q = 0; q + 1 < left.size(); ++q) to.push_back({apex, left[q + 1], left[q]});
  }
  void add_fan(std::int32_t apex, const Chain& left) { add_fan_to(triangles(), apex, left); }

  // The two ways to cut a cell between two chains that run from side[0] to side[1]: the better one is taken.
  void add_cell(const Chain& left, const Chain& right) {
    std::array<std::vector<Triangle>, 2> ways;
    for (int w = 0; w < 2; ++w) {
      const std::int32_t of_right = w == 0 ? right.front() : right.back(),
                         of_left = w == 0 ? left.back() : left.front();
      add_fan_to(ways[w], of_right, left);
      for (std::size_t p = 0; p + 1 < right.size(); ++p) ways[w].push_back({of_left, right[p], right[p + 1]});
    }
    const auto& way = ways[worst_of(ways[1]) > worst_of(ways[0]) ? 1 : 0];
    triangles().insert(triangles().end(), way.begin(), way.end());
  }
  [[nodiscard]] double worst_of(const std::vector<Triangle>& some) const {
    double worst = infinity;
    for (const Triangle& t : some)
      if (!is_flattened(t)) worst = std::min(worst, quality(t));
    return worst;
  }

  void turn() {
    double area = 0;
    const auto& uv = patch_.mesh.plane.vertices;
    for (const Triangle& t : triangles()) area += cross(uv[t[1]] - uv[t[0]], uv[t[2]] - uv[t[0]]);
    if (area < 0)
      for (Triangle& t : triangles()) std::swap(t[1], t[2]);
  }

  [[nodiscard]] double quality(const Triangle& t) const {
    const auto& p = patch_.mesh.xyz;
    return quality_q2(p[t[0]], p[t[1]], p[t[2]]);
  }
  // At a side of the parameter plane that is one point of space.
  [[nodiscard]] bool is_flattened(const Triangle& t) const {
    for (int i = 0; i < 3; ++i) {
      const int p = patch_.domain.origin[t[i]].corner, q = patch_.domain.origin[t[(i + 1) % 3]].corner;
      if (p >= 0 && p == q) return true;
    }
    return false;
  }
  [[nodiscard]] bool is_sound(const Triangle& t) const {
    const auto& uv = patch_.mesh.plane.vertices;
    return orientation(uv[t[0]], uv[t[1]], uv[t[2]]) > 0 && (is_flattened(t) || quality(t) > flat_quality);
  }

  const CurveModel& model_;
  const NarrowFace& narrow_;
  const std::vector<DiscreteCurve>& curves_;
  NarrowPatch patch_;
  std::vector<Chain> of_curve_;  // by curve of the face
  std::array<Chain, 2> side_;
  std::array<std::vector<double>, 2> s_;  // of the vertices of each side, along side[1]
};

}  // namespace

NarrowPatch mesh_between_sides(const CurveModel& model, const NarrowFace& narrow,
                               const std::vector<DiscreteCurve>& curves) {
  return Ladder(model, narrow, curves).run();
}

}  // namespace carreau
