// SPDX-License-Identifier: BSD-3-Clause
#include "metric_cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <vector>

namespace carreau::testing {

namespace {

/// Metric of sizes `across` along the unit vector n and `along` in the other direction.
Metric2 stretched_metric(Vec2 n, double across, double along) {
  const double p = 1 / (across * across), q = 1 / (along * along);
  return {p * n.x() * n.x() + q * n.y() * n.y(), (p - q) * n.x() * n.y(), p * n.y() * n.y() + q * n.x() * n.x()};
}

double metric_length(const MetricCase& c, Vec2 p, Vec2 q) {
  // Eight points of Gauss and Legendre.
  static constexpr std::array<double, 4> x = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                              0.9602898564975363};
  static constexpr std::array<double, 4> w = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                              0.1012285362903763};
  const Vec2 d = q - p;
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (const double s : {-x[i], x[i]}) sum += 0.5 * w[i] * length(c.metric(lerp(p, q, 0.5 * (1 + s))), d);
  return sum;
}

void append_side(MetricCase& c, Vec2 p, Vec2 q) {
  constexpr int samples = 200000;
  std::vector<double> total(samples + 1, 0);
  for (int i = 0; i < samples; ++i) {
    const Vec2 middle = lerp(p, q, (i + 0.5) / samples);
    total[i + 1] = total[i] + length(c.metric(middle), q - p) / samples;
  }
  const int pieces = std::max(1, static_cast<int>(total[samples] + 0.5));
  int k = 0;
  for (int piece = 0; piece < pieces; ++piece) {
    const double target = total[samples] * piece / pieces;
    while (total[k + 1] < target) ++k;
    c.domain.vertices.push_back(lerp(p, q, (k + (target - total[k]) / (total[k + 1] - total[k])) / samples));
  }
}

MetricCase on_box(std::string name, Vec2 low, Vec2 high, std::function<Metric2(Vec2)> metric) {
  MetricCase c{.name = std::move(name), .metric = std::move(metric), .domain = {}};
  const std::array<Vec2, 4> corner = {low, Vec2{high.x(), low.y()}, high, Vec2{low.x(), high.y()}};
  for (std::size_t i = 0; i < 4; ++i) append_side(c, corner[i], corner[(i + 1) % 4]);
  const int n = static_cast<int>(c.domain.vertices.size());
  for (int i = 0; i < n; ++i) c.domain.edges.push_back({.a = i, .b = (i + 1) % n});
  return c;
}

/// Across the layer the size grows by 0.2 a unit of distance, until the field is isotropic.
Metric2 layer(Vec2 normal, double distance, double h, double ratio) {
  const double along = ratio * h;
  // A smooth maximum of h and 0.2 |distance|.
  const double across = std::min(along, std::sqrt(h * h + 0.04 * distance * distance));
  return stretched_metric(normal, across, along);
}

}  // namespace

ControlSpace control_space(const MetricCase& c) {
  SampledDomain domain;
  domain.vertices = c.domain.vertices;
  for (const PlaneEdge& edge : c.domain.edges) domain.edges.emplace_back(edge.a, edge.b);
  Monitor monitor;
  return ControlSpace::build(
      domain,
      [&](std::span<const Vec2> uv, std::span<Metric2> metric) {
        for (std::size_t i = 0; i < uv.size(); ++i) metric[i] = c.metric(uv[i]);
      },
      {}, monitor);
}

MetricCase layer_on_line(double h, double ratio) {
  const Vec2 n{std::sin(0.4), std::cos(0.4)};
  return on_box("layer on a line", {0, 0}, {1, 1}, [=](Vec2 p) {
    return layer(n, dot(n, p - Vec2{0.5, 0.5}), h, ratio);
  });
}

MetricCase layer_on_circle(double h, double ratio) {
  return on_box("layer on a circle", {-1, -1}, {1, 1}, [=](Vec2 p) {
    const double r = norm(p);
    const Vec2 n = r > 1e-12 ? (1 / r) * p : Vec2{1, 0};
    return layer(n, r - 0.5, h, ratio);
  });
}

MetricCase layer_on_spiral(double h, double ratio) {
  // r = pitch (angle / 2 pi + k): the nearest turn; away from the origin, which has no nearest turn.
  constexpr double pitch = 0.3;
  return on_box("layer on a spiral", {0.2, 0.2}, {1.2, 1.2}, [=](Vec2 p) {
    const double r = norm(p), turn = r / pitch - std::atan2(p.y(), p.x()) / (2 * std::numbers::pi);
    const double distance = pitch * (turn - std::round(turn));
    // Gradient of r - pitch angle / (2 pi), made a unit vector.
    const double bend = pitch / (2 * std::numbers::pi * r);
    const Vec2 radial = (1 / r) * p;
    const Vec2 n = (1 / std::sqrt(1 + bend * bend)) * (radial - bend * Vec2{-radial.y(), radial.x()});
    return layer(n, distance / std::sqrt(1 + bend * bend), h, ratio);
  });
}

MetricCase layer_on_sine(double h, double ratio) {
  return on_box("layer on a sine", {0, -2}, {2 * std::numbers::pi, 2}, [=](Vec2 p) {
    const double slope = std::cos(p.x()), k = 1 / std::sqrt(1 + slope * slope);
    return layer({-k * slope, k}, k * (p.y() - std::sin(p.x())), h, ratio);
  });
}

MetricCase rings(double h, double ratio) {
  return on_box("rings", {0, 0}, {1, 1}, [=](Vec2 p) {
    const Vec2 d = p - Vec2{0.2, 0.3};
    const double r = norm(d);
    const Vec2 n = r > 0 ? (1 / r) * d : Vec2{1, 0};
    return stretched_metric(n, h, std::clamp(r / 3, h, ratio * h));
  });
}

MetricCase constant_stretch(double h, double ratio) {
  return on_box("constant stretch", {0, 0}, {1, 1}, [=](Vec2) {
    return stretched_metric({std::sin(0.4), std::cos(0.4)}, h, ratio * h);
  });
}

MetricCase turning_stretch(double h, double ratio) {
  return on_box("turning stretch", {0.3, 0.3}, {1.3, 1.3},
                [=](Vec2 p) { return stretched_metric((1 / norm(p)) * p, h, ratio * h); });
}

MetricQuality measure(const MetricCase& c, const PlaneMesh& mesh) {
  MetricQuality q;
  q.triangles = mesh.triangles.size();
  q.vertices = mesh.vertices.size();
  q.shortest = 1e300;
  std::map<std::array<int, 2>, double> lengths;
  std::vector<int> degree(mesh.vertices.size(), 0);
  std::vector<double> quality;
  double sum = 0;
  std::size_t fitting = 0;
  for (const auto& t : mesh.triangles) {
    double squares = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = t[i], b = t[(i + 1) % 3];
      const auto [place, is_new] = lengths.try_emplace({std::min(a, b), std::max(a, b)}, 0);
      if (is_new) {
        const double l = metric_length(c, mesh.vertices[a], mesh.vertices[b]);
        place->second = l;
        sum += l;
        fitting += l >= std::numbers::sqrt2 / 2 && l <= std::numbers::sqrt2;
        q.shortest = std::min(q.shortest, l), q.longest = std::max(q.longest, l);
        ++degree[a], ++degree[b];
      }
      squares += place->second * place->second;
    }
    const Vec2 p = mesh.vertices[t[0]], u = mesh.vertices[t[1]] - p, v = mesh.vertices[t[2]] - p;
    const double area = 0.5 * cross(u, v) * std::sqrt(determinant(c.metric(p + (1.0 / 3) * (u + v))));
    quality.push_back(4 * std::numbers::sqrt3 * area / squares);
  }
  const auto edges = static_cast<double>(lengths.size());
  q.mean_length = sum / edges;
  q.fitting = static_cast<double>(fitting) / edges;
  std::sort(quality.begin(), quality.end());
  for (const double x : quality) q.mean += x / static_cast<double>(quality.size());
  q.p1 = quality[quality.size() / 100];
  q.worst = quality[0];
  const std::size_t imposed = c.domain.vertices.size();
  const auto six = std::count(degree.begin() + static_cast<std::ptrdiff_t>(imposed), degree.end(), 6);
  q.degree_six = static_cast<double>(six) / static_cast<double>(std::max<std::size_t>(1, degree.size() - imposed));
  return q;
}

std::string to_string(const MetricQuality& q) {
  std::array<char, 256> line{};
  std::snprintf(line.data(), line.size(),
                "%zu triangles, metric Q2 %.4f/%.4f/%.4f, length %.4f, in range %.5f, %.2f..%.2f, degree 6 %.3f",
                q.triangles, q.mean, q.p1, q.worst, q.mean_length, q.fitting, q.shortest, q.longest, q.degree_six);
  return line.data();
}

}  // namespace carreau::testing
