// SPDX-License-Identifier: BSD-3-Clause
#include "high_order/shape.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "metric/least_squares.h"
#include "support/infinity.h"

namespace carreau {

namespace {

using Index = std::array<int, 2>;

double binomial(int n, int k) {
  double value = 1;
  for (int i = 1; i <= k; ++i) value = value * (n - k + i) / i;
  return value;
}
double trinomial(int n, int i, int k) { return binomial(n, i) * binomial(n - i, k); }

// Bernstein polynomials: of degree n in both variables of the square, or of total degree n.
double bernstein(bool quad, int n, const Index& index, const Vec2& at) {
  const auto [i, k] = index;
  const double s = at.x(), t = at.y();
  if (quad) return binomial(n, i) * std::pow(s, i) * std::pow(1 - s, n - i) * binomial(n, k) * std::pow(t, k) * std::pow(1 - t, n - k);
  return trinomial(n, i, k) * std::pow(s, i) * std::pow(t, k) * std::pow(1 - s - t, n - i - k);
}

std::vector<Index> lattice(bool quad, int n) {
  std::vector<Index> all;
  for (int i = 0; i <= n; ++i)
    for (int k = 0; k <= (quad ? n : n - i); ++k) all.push_back({i, k});
  return all;
}

// P'_p at x in [-1, 1], and its derivative, by the recursion of Legendre's polynomials.
std::array<double, 2> legendre_derivatives(int p, double x) {
  double before = 1, now = x;
  for (int n = 2; n <= p; ++n) {
    const double next = ((2 * n - 1) * x * now - (n - 1) * before) / n;
    before = now, now = next;
  }
  const double first = p * (before - x * now) / (1 - x * x);
  return {first, (2 * x * first - p * (p + 1) * now) / (1 - x * x)};
}

/// Halves of Bernstein coefficients of a scalar, for lower bounds. `values`: by lattice(quad, n).
class Parts {
 public:
  Parts(bool quad, int n) : quad_(quad), n_(n), indices_(lattice(quad, n)) {
    const std::size_t count = indices_.size();
    std::vector<double> at_nodes(count * count), there(count * count);
    for (std::size_t r = 0; r < count; ++r)
      for (std::size_t c = 0; c < count; ++c) at_nodes[r * count + c] = bernstein(quad, n, indices_[c], node(indices_[r]));
    const std::vector<double> inverse = inverse_of(at_nodes, count);
    for (int part = 0; part < 4; ++part) {
      for (std::size_t r = 0; r < count; ++r)
        for (std::size_t c = 0; c < count; ++c) there[r * count + c] = bernstein(quad, n, indices_[c], in_part(part, node(indices_[r])));
      part_[part].assign(count * count, 0);
      for (std::size_t r = 0; r < count; ++r)
        for (std::size_t k = 0; k < count; ++k)
          for (std::size_t c = 0; c < count; ++c) part_[part][r * count + c] += inverse[r * count + k] * there[k * count + c];
    }
  }

  /// A lower bound of the polynomial.
  [[nodiscard]] double least(const std::vector<double>& values, int depth) const {
    const double low = *std::min_element(values.begin(), values.end());
    if (low > 0 || depth == 0) return low;
    double corner = infinity;  // values that the polynomial takes
    for (std::size_t i = 0; i < indices_.size(); ++i) {
      const auto [a, b] = indices_[i];
      if ((a == 0 || a == n_) && (b == 0 || b == n_)) corner = std::min(corner, values[i]);
    }
    if (corner <= 0) return low;
    double least_part = infinity;
    for (const std::vector<double>& part : part_) {
      std::vector<double> there(values.size(), 0);
      for (std::size_t r = 0; r < there.size(); ++r)
        for (std::size_t c = 0; c < there.size(); ++c) there[r] += part[r * there.size() + c] * values[c];
      least_part = std::min(least_part, least(there, depth - 1));
      if (least_part <= low) break;
    }
    return std::max(low, least_part);
  }

  static const Parts& of(bool quad, int n) {
    static const std::map<std::array<int, 2>, Parts> all = [] {
      std::map<std::array<int, 2>, Parts> made;
      for (int p = 2; p <= 4; ++p) made.emplace(std::array<int, 2>{0, 2 * p - 2}, Parts(false, 2 * p - 2)), made.emplace(std::array<int, 2>{1, 2 * p - 1}, Parts(true, 2 * p - 1));
      return made;
    }();
    return all.at({quad ? 1 : 0, n});
  }

 private:
  [[nodiscard]] Vec2 node(const Index& index) const { return {static_cast<double>(index[0]) / n_, static_cast<double>(index[1]) / n_}; }
  [[nodiscard]] Vec2 in_part(int part, const Vec2& p) const {
    if (part == 3 && !quad_) return {0.5 - 0.5 * p.x(), 0.5 - 0.5 * p.y()};
    return {0.5 * p.x() + (part % 2 == 1 ? 0.5 : 0), 0.5 * p.y() + (part >= 2 ? 0.5 : 0)};
  }

  bool quad_;
  int n_;
  std::vector<Index> indices_;
  std::array<std::vector<double>, 4> part_;  // matrices by rows
};

constexpr int part_depth = 3;

}  // namespace

std::vector<double> places_on_edge(int order, NodePlaces places) {
  std::vector<double> all;
  for (int k = 0; k <= order; ++k) all.push_back(static_cast<double>(k) / order);
  if (places == NodePlaces::equidistant) return all;
  for (int k = 1; k < order; ++k) {
    double x = -std::cos(std::acos(-1.0) * k / order);
    for (int step = 0; step < 30; ++step) {
      const auto [value, slope] = legendre_derivatives(order, x);
      x -= value / slope;
    }
    all[k] = (1 + x) / 2;
  }
  for (int k = 1; 2 * k <= order; ++k) all[order - k] = 1 - all[k];
  if (order % 2 == 0) all[order / 2] = 0.5;
  return all;
}

std::vector<Index> node_indices(bool quad, int order) {
  std::vector<Index> all;
  for (int first = 0, p = order; p >= 0; first += 1, p -= quad ? 2 : 3) {
    const auto add = [&](int i, int k) { all.push_back({first + i, first + k}); };
    add(0, 0);
    if (p == 0) break;
    add(p, 0);
    if (quad) add(p, p);
    add(0, p);
    for (int i = 1; i < p; ++i) add(i, 0);
    for (int i = 1; i < p; ++i) quad ? add(p, i) : add(p - i, i);
    if (quad)
      for (int i = 1; i < p; ++i) add(p - i, p);
    for (int i = 1; i < p; ++i) add(0, p - i);
  }
  return all;
}

std::vector<Vec2> node_coordinates(bool quad, int order, NodePlaces places, std::span<const Index> indices) {
  const std::vector<double> x = places_on_edge(order, places);
  std::vector<Vec2> all;
  for (const auto& [i, k] : indices) {
    if (quad) {
      all.push_back({x[i], x[k]});
    } else {
      const double sum = x[i] + x[k] + x[order - i - k];
      all.push_back({x[i] / sum, x[k] / sum});
    }
  }
  return all;
}

ElementShape::ElementShape(bool quad, int order, NodePlaces places)
    : quad_(quad), order_(order), reference_(node_coordinates(quad, order, places, node_indices(quad, order))), indices_(node_indices(quad, order)) {
  const std::size_t n = reference_.size();
  std::vector<double> values(n * n);
  for (std::size_t r = 0; r < n; ++r)
    for (std::size_t c = 0; c < n; ++c) values[r * n + c] = bernstein(quad, order, indices_[c], reference_[r]);
  to_bezier_ = inverse_of(values, n);
  fill_inner(places_on_edge(order, places));
  fill_products();
}

void ElementShape::fill_products() {
  const int p = order_;
  coefficients_ = lattice(quad_, quad_ ? 2 * p - 1 : 2 * p - 2);
  const auto add = [&](int i, int k, int m, int l, double weight) {
    products_.push_back({{static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(k), static_cast<std::uint8_t>(m), static_cast<std::uint8_t>(l)}, weight});
  };
  if (!quad_) {
    for (const auto& [i, k] : lattice(false, p - 1))
      for (const auto& [m, l] : lattice(false, p - 1)) add(i, k, m, l, trinomial(p - 1, i, k) * trinomial(p - 1, m, l) / trinomial(2 * p - 2, i + m, k + l));
    return;
  }
  for (int i = 0; i < p; ++i)
    for (int k = 0; k <= p; ++k)
      for (int m = 0; m <= p; ++m)
        for (int l = 0; l < p; ++l)
          add(i, k, m, l, binomial(p - 1, i) * binomial(p, m) / binomial(2 * p - 1, i + m) * binomial(p, k) * binomial(p - 1, l) / binomial(2 * p - 1, k + l));
}

std::vector<double> ElementShape::values_at(std::span<const Vec2> places) const {
  const std::size_t n = node_count();
  std::vector<double> all(places.size() * n, 0);
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t b = 0; b < n; ++b) {
      const double weight = bernstein(quad_, order_, indices_[b], places[i]);
      for (std::size_t k = 0; k < n; ++k) all[i * n + k] += weight * to_bezier_[b * n + k];
    }
  return all;
}

void ElementShape::fill_inner(std::span<const double> places) {
  const int p = order_, corners = corner_count();
  const std::size_t border = first_inner();
  // Lagrange polynomials of the inner places of an edge, of degree p - 2.
  const auto lagrange = [&](int k, double s) {
    double value = 1;
    for (int m = 1; m < p; ++m)
      if (m != k) value *= (s - places[m]) / (places[k] - places[m]);
    return value;
  };
  for (std::size_t i = border; i < reference_.size(); ++i) {
    const double s = reference_[i].x(), t = reference_[i].y();
    std::vector<double> weight(border, 0);
    std::vector<double> of_corner = quad_ ? std::vector<double>{(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t} : std::vector<double>{1 - s - t, s, t};
    for (int e = 0; e < corners; ++e) {
      const int a = e, b = (e + 1) % corners;
      for (int k = 1; k < p; ++k) {
        double share = 0;
        if (quad_) {  // the edge's coordinate, and the blend towards the opposite edge
          const std::array<double, 4> along{s, t, 1 - s, 1 - t}, blend{1 - t, s, t, 1 - s};
          const double x = along[e];
          share = blend[e] * lagrange(k, x) * x * (1 - x) / (places[k] * (1 - places[k]));
        } else {
          const double la = of_corner[a], lb = of_corner[b];
          share = la * lb * lagrange(k, (1 + lb - la) / 2) / (places[k] * (1 - places[k]));
        }
        weight[static_cast<std::size_t>(corners + e * (p - 1) + k - 1)] += share;
        weight[a] -= share * (1 - places[k]), weight[b] -= share * places[k];  // differences from the chord
      }
    }
    for (int c = 0; c < corners; ++c) weight[c] += of_corner[c];
    inner_.insert(inner_.end(), weight.begin(), weight.end());
  }
}

double ElementShape::least_jacobian(std::span<const Vec3> nodes) const {
  const std::size_t n = node_count();
  std::array<std::array<Vec3, 5>, 5> b;
  for (std::size_t r = 0; r < n; ++r) {
    Vec3 sum(0, 0, 0);
    for (std::size_t c = 0; c < n; ++c) sum += to_bezier_[r * n + c] * nodes[c];
    b[indices_[r][0]][indices_[r][1]] = sum;
  }
  const std::vector<Index>& all = coefficients_;
  std::array<std::array<Vec3, 8>, 8> c;
  for (auto& row : c) row.fill(Vec3(0, 0, 0));
  for (const auto& [at, weight] : products_) {
    const auto [i, k, m, l] = at;
    c[i + m][k + l] += weight * cross(Vec3(b[i + 1][k] - b[i][k]), Vec3(b[m][l + 1] - b[m][l]));
  }
  Vec3 mean(0, 0, 0);
  for (const auto& [i, k] : all) mean += c[i][k];
  mean *= 1.0 / static_cast<double>(all.size());
  const double square = dot(mean, mean);
  if (!(square > 0)) return 0;
  std::vector<double> along(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) along[i] = dot(c[all[i][0]][all[i][1]], mean) / square;
  return Parts::of(quad_, quad_ ? 2 * order_ - 1 : 2 * order_ - 2).least(along, part_depth);
}

}  // namespace carreau
