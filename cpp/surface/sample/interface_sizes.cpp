// SPDX-License-Identifier: BSD-3-Clause
#include "surface/sample/interface_sizes.h"

#include <algorithm>
#include <cmath>

namespace carreau {

namespace {

PlaneDomain without_points(const PlaneDomain& domain, const std::vector<double>& sizes,
                           std::vector<double>& kept_sizes) {
  PlaneDomain kept;
  std::vector<int> rank(domain.vertices.size(), -1);
  for (std::size_t v = 0; v < domain.vertices.size(); ++v) {
    if (!(sizes[v] > 0)) continue;
    rank[v] = static_cast<int>(kept.vertices.size());
    kept.vertices.push_back(domain.vertices[v]);
    kept_sizes.push_back(sizes[v]);
  }
  for (PlaneEdge edge : domain.edges) {
    edge.a = rank[edge.a];
    edge.b = rank[edge.b];
    if (edge.a >= 0 && edge.b >= 0) kept.edges.push_back(edge);
  }
  return kept;
}

/// Neighbours across the edge opposite to each corner, or -1.
std::vector<std::array<int, 3>> find_neighbours(const PlaneMesh& mesh) {
  struct Side {
    std::array<int, 2> key;
    int triangle, corner;
  };
  std::vector<Side> sides;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
    for (int i = 0; i < 3; ++i) {
      const int a = mesh.triangles[t][(i + 1) % 3], b = mesh.triangles[t][(i + 2) % 3];
      sides.push_back({{std::min(a, b), std::max(a, b)}, t, i});
    }
  std::sort(sides.begin(), sides.end(),
            [](const Side& p, const Side& q) { return p.key != q.key ? p.key < q.key : p.triangle < q.triangle; });
  std::vector<std::array<int, 3>> neighbours(mesh.triangles.size(), {-1, -1, -1});
  for (std::size_t i = 1; i < sides.size(); ++i)
    if (sides[i].key == sides[i - 1].key) {
      neighbours[sides[i].triangle][sides[i].corner] = sides[i - 1].triangle;
      neighbours[sides[i - 1].triangle][sides[i - 1].corner] = sides[i].triangle;
    }
  return neighbours;
}

std::vector<std::array<int, 2>> sorted_edges(const PlaneDomain& domain) {
  std::vector<std::array<int, 2>> edges;
  edges.reserve(domain.edges.size());
  for (const PlaneEdge& e : domain.edges) edges.push_back({std::min(e.a, e.b), std::max(e.a, e.b)});
  std::sort(edges.begin(), edges.end());
  return edges;
}

}  // namespace

/// Numerator and denominator of the mean value, or the value itself where the point lies on an interface.
struct InterfaceSizes::Sums {
  double values = 0, weights = 0;
  bool on_interface = false;
  double value_there = 0;
};

InterfaceSizes::InterfaceSizes(const PlaneDomain& domain, const std::vector<double>& sizes, SizeLaw law,
                               Monitor& monitor)
    : law_(law) {
  const PlaneDomain kept = without_points(domain, sizes, value_);
  mesh_ = triangulate_domain(kept, monitor);
  neighbour_ = find_neighbours(mesh_);
  across_ = neighbour_;
  const std::vector<std::array<int, 2>> imposed = sorted_edges(kept);
  for (std::size_t t = 0; t < across_.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = mesh_.triangles[t][(i + 1) % 3], b = mesh_.triangles[t][(i + 2) % 3];
      if (std::binary_search(imposed.begin(), imposed.end(), std::array<int, 2>{std::min(a, b), std::max(a, b)}))
        across_[t][i] = -1;
    }
  if (law_ == SizeLaw::geometric)
    for (double& h : value_) h = std::log(h);
  // The units of u and v may differ.
  Vec2 high = low_ = mesh_.vertices.front();
  for (const Vec2& p : mesh_.vertices) {
    low_ = low_.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  scale_ = {1 / (high.x() - low_.x()), 1 / (high.y() - low_.y())};
  for (Vec2& p : mesh_.vertices) p = {(p.x() - low_.x()) * scale_.x(), (p.y() - low_.y()) * scale_.y()};
}

/// Barycentric coordinates.
std::array<double, 3> InterfaceSizes::weights(int triangle, const Vec2& uv) const {
  const Triangle& c = mesh_.triangles[triangle];
  const Vec2 p = mesh_.vertices[c[0]], q = mesh_.vertices[c[1]], r = mesh_.vertices[c[2]];
  const double area = cross(q - p, r - p);
  return {cross(q - uv, r - uv) / area, cross(r - uv, p - uv) / area, cross(p - uv, q - uv) / area};
}

int InterfaceSizes::triangle_at(const Vec2& p) const {
  int t = last_;
  // A walk in a constrained triangulation may meet the border first, or turn in circles: then all triangles are
  // searched.
  for (std::size_t step = 0; step < 64 + 2 * mesh_.triangles.size(); ++step) {
    const auto w = weights(t, p);
    const int worst = static_cast<int>(std::min_element(w.begin(), w.end()) - w.begin());
    if (w[worst] >= -1e-12) return t;
    if (neighbour_[t][worst] < 0) break;
    t = neighbour_[t][worst];
  }
  double best = -1e300;
  for (int k = 0; k < static_cast<int>(mesh_.triangles.size()); ++k) {
    const auto w = weights(k, p);
    const double low = *std::min_element(w.begin(), w.end());
    if (low > best) best = low, t = k;
  }
  return t;
}

double InterfaceSizes::operator()(const Vec2& uv) const {
  const Vec2 from{(uv.x() - low_.x()) * scale_.x(), (uv.y() - low_.y()) * scale_.y()};
  last_ = triangle_at(from);
  const Triangle& home = mesh_.triangles[last_];
  const auto size_of = [&](double mean) { return law_ == SizeLaw::geometric ? std::exp(mean) : mean; };
  const auto at = weights(last_, from);
  // A vertex has no directions to its edges.
  for (int i = 0; i < 3; ++i)
    if (at[i] >= 1 - 1e-12) return size_of(value_[home[i]]);
  Sums sums;
  views_.clear();
  for (int i = 0; i < 3; ++i)
    views_.push_back({last_, i, mesh_.vertices[home[(i + 1) % 3]] - from, mesh_.vertices[home[(i + 2) % 3]] - from});
  while (!views_.empty() && !sums.on_interface) {
    const View view = views_.back();
    views_.pop_back();
    if (is_interface(view))
      add(view, from, sums);
    else
      look_through(view, from);
  }
  double mean = sums.on_interface ? sums.value_there : sums.values / sums.weights;
  // Outside by a rounding error of the border, or by more: the nearest triangle's corners.
  if (!std::isfinite(mean)) {
    mean = 0;
    double total = 0;
    for (int i = 0; i < 3; ++i) {
      const double part = std::clamp(at[i], 0.0, 1.0);
      mean += part * value_[home[i]];
      total += part;
    }
    mean /= total;
  }
  return size_of(mean);
}

/// Into the neighbour: its two other edges, each between the directions in which it is seen.
void InterfaceSizes::look_through(const View& view, const Vec2& from) const {
  const int t = neighbour_[view.triangle][view.side];
  int side = 0;
  while (neighbour_[t][side] != view.triangle) ++side;
  // Seen from here: right corner, far corner, left corner.
  const Triangle& c = mesh_.triangles[t];
  const Vec2 far = mesh_.vertices[c[side]] - from;
  const bool right_in_view = cross(view.right, far) > 0, left_in_view = cross(far, view.left) > 0;
  const int right_side = (side + 1) % 3, left_side = (side + 2) % 3;
  if (right_in_view) views_.push_back({t, right_side, view.right, left_in_view ? far : view.left});
  if (left_in_view) views_.push_back({t, left_side, right_in_view ? far : view.right, view.left});
}

/// Mean value weights tan(alpha / 2) / r of both ends of the visible part of an edge. Source: Floater's formula for a
/// polygon with these corners.
void InterfaceSizes::add(const View& view, Vec2 from, Sums& sums) const {
  const Triangle& c = mesh_.triangles[view.triangle];
  const int a = c[(view.side + 1) % 3], b = c[(view.side + 2) % 3];
  const Vec2 p = mesh_.vertices[a] - from, d = mesh_.vertices[b] - mesh_.vertices[a];
  // The place on the edge in a given direction: cross(direction, p + s d) = 0.
  const auto place = [&](Vec2 direction, double otherwise) {
    const double across = cross(direction, d);
    return across > 0 ? std::clamp(-cross(direction, p) / across, 0.0, 1.0) : otherwise;
  };
  const double s0 = place(view.right, 0), s1 = place(view.left, 1);
  const Vec2 p0 = p + s0 * d, p1 = p + s1 * d;
  const double f0 = value_[a] + s0 * (value_[b] - value_[a]), f1 = value_[a] + s1 * (value_[b] - value_[a]);
  const double r0 = norm(p0), r1 = norm(p1), sine = cross(p0, p1), cosine = dot(p0, p1);
  if (sine <= 1e-12 * r0 * r1) {
    if (cosine > 0) return;  // a point, or an edge seen from its end on
    sums.on_interface = true;
    sums.value_there = r0 + r1 > 0 ? (r1 * f0 + r0 * f1) / (r0 + r1) : f0;
    return;
  }
  const double tangent = (r0 * r1 - cosine) / sine;
  sums.values += tangent * (f0 / r0 + f1 / r1);
  sums.weights += tangent * (1 / r0 + 1 / r1);
}

}  // namespace carreau
