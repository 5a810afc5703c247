// SPDX-License-Identifier: BSD-3-Clause
#include "plane_cases.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carreau::testing {

namespace {

constexpr double pi = std::numbers::pi;

PlaneCase make(const std::string& name, Vec2 low, Vec2 high, double h, std::function<Vec3(Vec2)> surface) {
  PlaneCase c;
  c.name = name;
  c.low = low, c.high = high;
  c.size = [h](Vec2) { return h; };
  c.surface = std::move(surface);
  return c;
}

void append_box(PlaneCase& c) { append_polygon(c, {c.low, {c.high.x(), c.low.y()}, c.high, {c.low.x(), c.high.y()}}); }

std::function<Vec2(double)> line(Vec2 p, Vec2 q) {
  return [p, q](double t) { return lerp(p, q, t); };
}

std::function<Vec2(double)> circle(Vec2 centre, double r, bool hole) {
  return [=](double t) {
    const double a = 2 * pi * t;
    return Vec2{centre.x() + r * std::cos(a), centre.y() + (hole ? -r : r) * std::sin(a)};
  };
}

// Interior points of the subdivision of a curve into equal parts of about unit length.
std::vector<Vec2> unit_points(const PlaneCase& c, const std::function<Vec2(double)>& curve) {
  constexpr int samples = 20000;
  std::vector<double> length(samples + 1, 0);
  Vec2 before = curve(0);
  for (int i = 1; i <= samples; ++i) {
    const Vec2 now = curve(static_cast<double>(i) / samples);
    const double h = 0.5 * (c.size(before) + c.size(now));
    length[i] = length[i - 1] + norm(c.surface(now) - c.surface(before)) / h;
    before = now;
  }
  const int pieces = std::max(1, static_cast<int>(length[samples] + 0.5));
  std::vector<Vec2> points;
  int k = 0;
  for (int piece = 1; piece < pieces; ++piece) {
    const double target = length[samples] * piece / pieces;
    while (length[k + 1] < target) ++k;
    const double w = (target - length[k]) / (length[k + 1] - length[k]);
    points.push_back(curve((k + w) / samples));
  }
  return points;
}

PlaneCase with_polar_sides(PlaneCase c) {
  // (0, 0) and (0, 2 pi) are one point of space.
  auto& v = c.domain.vertices;
  v = {{c.low.x(), c.low.y()}, {c.high.x(), c.low.y()}, {c.high.x(), c.high.y()}, {c.low.x(), c.high.y()}};
  append_curve(c, line(v[0], v[1]), PlaneEdgeKind::boundary, 0, 1);
  append_curve(c, line(v[1], v[2]), PlaneEdgeKind::boundary, 1, 2);
  append_curve(c, line(v[2], v[3]), PlaneEdgeKind::boundary, 2, 3);
  c.domain.edges.push_back({3, 0, PlaneEdgeKind::degenerate, 3, 0, 3});
  return c;
}

}  // namespace

Metric2 true_metric(const PlaneCase& c, Vec2 uv) {
  const double e = 1e-5 * (c.high.x() - c.low.x()), f = 1e-5 * (c.high.y() - c.low.y());
  const Vec3 su = (0.5 / e) * (c.surface({uv.x() + e, uv.y()}) - c.surface({uv.x() - e, uv.y()}));
  const Vec3 sv = (0.5 / f) * (c.surface({uv.x(), uv.y() + f}) - c.surface({uv.x(), uv.y() - f}));
  return induced_metric(su, sv, c.size(uv));
}

ControlSpace control_space(const PlaneCase& c, double tolerance) {
  SampledDomain domain;
  domain.vertices = c.domain.vertices;
  for (const PlaneEdge& edge : c.domain.edges)
    if (edge.kind != PlaneEdgeKind::internal) domain.edges.emplace_back(edge.a, edge.b);
  Monitor monitor;
  ControlSpaceOptions options;
  options.tolerance = tolerance;
  return ControlSpace::build(
      domain,
      [&](std::span<const Vec2> uv, std::span<Metric2> metric) {
        for (std::size_t i = 0; i < uv.size(); ++i) metric[i] = true_metric(c, uv[i]);
      },
      options, monitor);
}

int append_curve(PlaneCase& c, const std::function<Vec2(double)>& curve, PlaneEdgeKind kind, int start, int end) {
  auto& vertices = c.domain.vertices;
  const auto add = [&](Vec2 p) {
    vertices.push_back(p);
    return static_cast<int>(vertices.size()) - 1;
  };
  const std::vector<Vec2> points = unit_points(c, curve);
  const int rank = c.domain.edges.empty() ? 0 : c.domain.edges.back().curve + 1;
  int a = start < 0 ? add(curve(0)) : start, segment = 0;
  for (const Vec2& p : points) {
    const int b = add(p);
    c.domain.edges.push_back({a, b, kind, rank, segment++});
    a = b;
  }
  const int b = end < 0 ? add(curve(1)) : end;
  c.domain.edges.push_back({a, b, kind, rank, segment});
  return b;
}

int append_closed_curve(PlaneCase& c, const std::function<Vec2(double)>& curve) {
  c.domain.vertices.push_back(curve(0));
  const int first = static_cast<int>(c.domain.vertices.size()) - 1;
  return append_curve(c, curve, PlaneEdgeKind::boundary, first, first);
}

void append_polygon(PlaneCase& c, const std::vector<Vec2>& corners) {
  c.domain.vertices.push_back(corners[0]);
  const int first = static_cast<int>(c.domain.vertices.size()) - 1;
  int a = first;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const bool last = i + 1 == corners.size();
    a = append_curve(c, line(corners[i], corners[last ? 0 : i + 1]), PlaneEdgeKind::boundary, a, last ? first : -1);
  }
}

PlaneCase flat_square(double h) {
  PlaneCase c = make("flat square", {0, 0}, {1, 1}, h, [](Vec2 p) { return Vec3{p.x(), p.y(), 0}; });
  append_box(c);
  return c;
}

PlaneCase paraboloid(double h) {
  PlaneCase c = make("paraboloid", {-2.5, -2.5}, {2.5, 2.5}, h, [](Vec2 p) { return Vec3{p.x(), p.y(), 0.5 * dot(p, p)}; });
  append_box(c);
  return c;
}

PlaneCase hemisphere(double h) {
  PlaneCase c = make("hemisphere", {-1, -1}, {1, 1}, h, [](Vec2 p) {
    const double d = 1 + dot(p, p);
    return Vec3{2 * p.x() / d, 2 * p.y() / d, (2 - d) / d};
  });
  append_closed_curve(c, circle({0, 0}, 1, false));
  return c;
}

PlaneCase torus_patch(double h) {
  PlaneCase c = make("torus patch", {0, 0}, {pi, pi}, h, [](Vec2 p) {
    const double r = 2 + std::cos(p.y());
    return Vec3{r * std::cos(p.x()), r * std::sin(p.x()), std::sin(p.y())};
  });
  append_box(c);
  return c;
}

PlaneCase swirl(double h, double turns) {
  PlaneCase c = make("swirl", {-1, -1}, {1, 1}, h, [turns](Vec2 p) {
    const double r2 = dot(p, p), g = turns * (1 - r2) * (1 - r2), x = std::cos(g), y = std::sin(g);
    return Vec3{x * p.x() - y * p.y(), y * p.x() + x * p.y(), 0.3 * r2};
  });
  append_closed_curve(c, circle({0, 0}, 1, false));
  return c;
}

PlaneCase stretched(double h) {
  PlaneCase c = make("stretched", {0, 0}, {1, 50}, h, [](Vec2 p) {
    const double u = p.x(), w = p.y() / 50;
    return Vec3{u + 0.8 * u * u * u + 0.7 * w, w + 0.3 * w * w, 0.3 * std::sin(2 * u) * std::cos(2 * w)};
  });
  append_box(c);
  return c;
}

PlaneCase size_field(double h) {
  PlaneCase c = make("size field", {-2, -2}, {2, 2}, h, [](Vec2 p) {
    return Vec3{p.x(), p.y(), 0.25 * std::sin(p.x()) * std::cos(p.y())};
  });
  c.size = [h](Vec2 p) {
    const double ring = norm(p) - 1.2, d = std::sqrt(ring * ring + 1e-4);
    return h * std::min(0.01 + 0.26 * (d - 0.01), 0.1);
  };
  append_box(c);
  return c;
}

PlaneCase holes(double h) {
  PlaneCase c = make("holes", {-1, -1}, {1, 1}, h, [](Vec2 p) {
    return Vec3{p.x(), p.y(), 0.3 * std::sin(2 * p.x()) * std::sin(2 * p.y())};
  });
  append_box(c);
  append_closed_curve(c, circle({0.1, 0.1}, 0.35, true));
  append_closed_curve(c, circle({-0.55, -0.4}, 0.2, true));
  append_closed_curve(c, circle({0.7, -0.6}, 0.15, true));
  append_closed_curve(c, circle({-0.6, 0.6}, 0.02, true));
  append_closed_curve(c, circle({0.75, 0.8}, 0.1, true));
  append_polygon(c, {{-0.3, -0.75}, {-0.3, -0.74}, {0.4, -0.74}, {0.4, -0.75}});
  return c;
}

PlaneCase star(double h) {
  PlaneCase c = make("star", {-1, -1}, {1, 1}, h, [](Vec2 p) { return Vec3{p.x(), p.y(), 0.2 * (p.x() * p.x() - p.y() * p.y())}; });
  std::vector<Vec2> corners;
  for (int i = 0; i < 10; ++i) {
    const double r = i % 2 == 1 ? 0.32 : 0.98, a = pi * i / 5;
    corners.push_back({r * std::cos(a), r * std::sin(a)});
  }
  append_polygon(c, corners);
  append_closed_curve(c, circle({0.02, 0.03}, 0.1, true));
  return c;
}

PlaneCase internal_curves(double h) {
  PlaneCase c = make("internal curves", {-1, -1}, {1, 1}, h, [](Vec2 p) {
    return Vec3{p.x(), p.y(), 0.2 * std::cos(2 * p.x() + p.y())};
  });
  append_box(c);
  // A curve from corner to corner (vertex 0 is the corner (-1, -1)), a free arc and two points.
  int corner = 0;
  for (std::size_t v = 0; v < c.domain.vertices.size(); ++v)
    if (c.domain.vertices[v] == Vec2{1, 1}) corner = static_cast<int>(v);
  append_curve(
      c,
      [](double t) {
        return Vec2{2 * t - 1, 2 * t - 1 + 0.3 * std::sin(2 * pi * t)};
      },
      PlaneEdgeKind::internal, 0, corner);
  append_curve(
      c,
      [](double t) {
        return Vec2{-0.7 + 0.5 * std::cos(2 * t), 0.3 + 0.4 * std::sin(2 * t)};
      },
      PlaneEdgeKind::internal, -1, -1);
  c.domain.vertices.push_back({0.6, -0.6});
  c.domain.vertices.push_back({0.31, -0.2});
  return c;
}

PlaneCase polar_disc(double h) { return polar_cone(h, 0.5 * pi); }

PlaneCase polar_cone(double h, double half_angle) {
  const double s = std::sin(half_angle), k = std::cos(half_angle);
  return with_polar_sides(make("polar cone", {0, 0}, {1, 2 * pi}, h, [s, k](Vec2 p) {
    return Vec3{s * p.x() * std::cos(p.y()), s * p.x() * std::sin(p.y()), k * p.x()};
  }));
}

PlaneCase sphere_two_poles(double h) {
  PlaneCase c = make("sphere", {-0.5 * pi, 0}, {0.5 * pi, 2 * pi}, h, [](Vec2 p) {
    const double r = std::cos(p.x());
    return Vec3{r * std::cos(p.y()), r * std::sin(p.y()), std::sin(p.x())};
  });
  auto& v = c.domain.vertices;
  v = {{c.low.x(), c.low.y()}, {c.high.x(), c.low.y()}, {c.high.x(), c.high.y()}, {c.low.x(), c.high.y()}};
  append_curve(c, line(v[0], v[1]), PlaneEdgeKind::boundary, 0, 1);
  c.domain.edges.push_back({1, 2, PlaneEdgeKind::degenerate, 1, 0, 3});
  append_curve(c, line(v[2], v[3]), PlaneEdgeKind::boundary, 2, 3);
  c.domain.edges.push_back({3, 0, PlaneEdgeKind::degenerate, 3, 0, 3});
  return c;
}

}  // namespace carreau::testing
