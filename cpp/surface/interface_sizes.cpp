#include "surface/interface_sizes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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

}  // namespace

InterfaceSizes::InterfaceSizes(const PlaneDomain& domain, const std::vector<double>& sizes, SizeLaw law,
                               Monitor& monitor)
    : law_(law) {
  mesh_ = triangulate_domain(without_points(domain, sizes, sizes_), monitor);
  neighbours_ = find_neighbours(mesh_);
}

double InterfaceSizes::inside(int triangle, const std::array<double, 3>& weights) const {
  const auto& corners = mesh_.triangles[triangle];
  double sum = 0, total = 0;
  for (int i = 0; i < 3; ++i) {
    const double w = std::clamp(weights[i], 0.0, 1.0);
    // On an edge the two weights are t and 1 - t, and each law comes out as in RR-2818 sec. 5.1.
    const double share = law_ == SizeLaw::sinusoidal ? 0.5 * (1 - std::cos(std::numbers::pi * w)) : w;
    const double h = sizes_[corners[i]];
    sum += share * (law_ == SizeLaw::geometric ? std::log(h) : h);
    total += share;
  }
  return law_ == SizeLaw::geometric ? std::exp(sum / total) : sum / total;
}

double InterfaceSizes::operator()(Vec2 uv) const {
  int t = last_;
  std::array<double, 3> weights{};
  // A walk in a constrained triangulation may meet the border first, or turn in circles: then every triangle is looked
  // at.
  const auto weights_in = [&](int triangle) {
    const auto& c = mesh_.triangles[triangle];
    const Vec2 p = mesh_.vertices[c[0]], q = mesh_.vertices[c[1]], r = mesh_.vertices[c[2]];
    const double area = cross(q - p, r - p);
    return std::array<double, 3>{cross(q - uv, r - uv) / area, cross(r - uv, p - uv) / area,
                                 cross(p - uv, q - uv) / area};
  };
  for (std::size_t step = 0; step < 64 + 2 * mesh_.triangles.size(); ++step) {
    weights = weights_in(t);
    const int worst = static_cast<int>(std::min_element(weights.begin(), weights.end()) - weights.begin());
    if (weights[worst] >= -1e-12) {
      last_ = t;
      return inside(t, weights);
    }
    if (neighbours_[t][worst] < 0) break;
    t = neighbours_[t][worst];
  }
  double best = -1e300;
  for (int k = 0; k < static_cast<int>(mesh_.triangles.size()); ++k) {
    const auto w = weights_in(k);
    const double low = *std::min_element(w.begin(), w.end());
    if (low > best) best = low, t = k;
  }
  last_ = t;
  return inside(t, weights_in(t));
}

}  // namespace carreau
