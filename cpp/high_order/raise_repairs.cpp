// SPDX-License-Identifier: BSD-3-Clause
// Repairs of elements that are invalid in the higher order.
#include "high_order/raiser.h"
#include "high_order/thresholds.h"
#include "mesh/local_search.h"
#include "support/error.h"
#include "support/infinity.h"
#include "support/work_bounds.h"
#include "surface/elements/base/thresholds.h"

namespace carreau {

using namespace thresholds::high_order;

void Raiser::repair() {
  std::vector<std::size_t> bad;
  for (std::size_t k = 0; k < elements_.size(); ++k) {
    if (k % 4096 == 0) monitor_.checkpoint();
    if (score(elements_[k]) < least_jacobian) bad.push_back(k);
  }
  if (bad.empty()) return;
  list_neighbours();
  const std::vector<std::size_t> first = bad;
  for (int round = 0; round < work_bounds::rounds && !bad.empty(); ++round) {
    for (const std::size_t k : bad) {
      monitor_.checkpoint();
      move_inner(k);
      if (score(elements_[k]) >= least_jacobian) continue;
      if (round == 0) follow_second_order(k);
      move_edges(k);
    }
    bad = invalid_about(bad);
  }
  out_.repaired = std::count_if(first.begin(), first.end(), [&](std::size_t k) { return score(elements_[k]) >= least_jacobian; });
  if (lowers_) lower(bad);
  invalid_ = bad;
}

// A moved edge can mend one of its elements and break the other.
std::vector<std::size_t> Raiser::invalid_about(const std::vector<std::size_t>& moved) const {
  std::vector<std::size_t> all = moved;
  for (const std::size_t k : moved) {
    const std::vector<std::size_t> beside = neighbours(k);
    all.insert(all.end(), beside.begin(), beside.end());
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  std::erase_if(all, [&](std::size_t k) { return score(elements_[k]) >= least_jacobian; });
  return all;
}

void Raiser::list_neighbours() {
  for (std::size_t k = 0; k < elements_.size(); ++k)
    for (int i = 0; i < elements_[k].corners; ++i) {
      const Element& e = elements_[k];
      const FaceMesh& face = mesh_.faces[e.face];
      around_[ordered(face.vertex[e.local[i]], face.vertex[e.local[(i + 1) % e.corners]])].push_back(k);
    }
}

std::array<Vec2, 2> Raiser::box(const Element& e) const {
  Vec2 low{infinity, infinity}, high = -low;
  const std::array<Vec2, 4> uv = corners_uv(e);
  for (int i = 0; i < e.corners; ++i) low = low.cwiseMin(uv[i]), high = high.cwiseMax(uv[i]);
  return {low, high};
}

template <typename Judge>
bool Raiser::search(std::int32_t node, const Element& e, const Judge& judge) {
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
  const Vec2 by = search_along_compass(before, thresholds::elements::first_step, thresholds::elements::last_step, [&](const Vec2& step, double) {
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

void Raiser::move_inner(std::size_t k) {
  const Element& e = elements_[k];
  for (std::size_t i = shape(e).first_inner(); i < shape(e).node_count(); ++i) search(e.node[i], e, [&] { return std::min(good_jacobian, score(e)); });
}

void Raiser::settle(const Element& e) {
  Wanted wanted;
  want_inner(e, wanted);
  place(static_cast<std::size_t>(e.face), wanted);
}

double Raiser::worst(const std::vector<std::size_t>& all) const {
  double least = good_jacobian;
  for (const std::size_t k : all) least = std::min(least, score(elements_[k]));
  return least;
}

std::ptrdiff_t Raiser::invalid_among(const std::vector<std::size_t>& all) const {
  return std::count_if(all.begin(), all.end(), [&](std::size_t k) { return score(elements_[k]) < least_jacobian; });
}

Raiser::Saved Raiser::save(const std::vector<std::size_t>& all) const {
  Saved saved;
  for (const std::size_t k : all)
    for (std::size_t i = 0; i < shape(elements_[k]).node_count(); ++i) {
      const std::int32_t node = elements_[k].node[i];
      saved.node.push_back(node), saved.xyz.push_back(out_.nodes[node]), saved.uv.push_back(node_uv_[node]);
    }
  return saved;
}

std::int32_t Raiser::mid_of(std::size_t k, int side) const {
  const Element& e = elements_[k];
  const FaceMesh& face = mesh_.faces[e.face];
  const std::size_t first = k - first_element_[e.face];
  const std::size_t t = e.corners == 4 ? 2 * first + (side < 2 ? 0 : 1) : first + static_cast<std::size_t>(face.quads);
  return face.mid[t][e.corners == 4 && side >= 2 ? side - 1 : side];
}

std::vector<std::size_t> Raiser::neighbours(std::size_t k) const {
  const Element& e = elements_[k];
  const FaceMesh& face = mesh_.faces[e.face];
  std::vector<std::size_t> beside;
  for (int i = 0; i < e.corners; ++i)
    for (const std::size_t n : around_.at(ordered(face.vertex[e.local[i]], face.vertex[e.local[(i + 1) % e.corners]])))
      if (n != k) beside.push_back(n);
  return beside;
}

void Raiser::take_second_order(std::size_t k) {
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

bool Raiser::lower(std::size_t k, std::vector<std::size_t>& lowered) {
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

void Raiser::lower(std::vector<std::size_t>& bad) {
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

void Raiser::follow_second_order(std::size_t k) {
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
    const auto invalid = invalid_among(beside);
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
    if (!(worst(beside) > before) || invalid_among(beside) > invalid) restore(saved);
  }
}

void Raiser::move_edges(std::size_t k) {
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
      const auto invalid = invalid_among(beside);
      search(edge.first + static_cast<std::int32_t>(m), e, [&] {
        for (const std::size_t n : beside) settle(elements_[n]);
        return worst(beside);
      });
      if (!(worst(beside) > before) || invalid_among(beside) > invalid) restore(saved);
    }
  }
}

}  // namespace carreau
