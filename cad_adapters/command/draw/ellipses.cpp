// SPDX-License-Identifier: BSD-3-Clause
#include "draw/ellipses.h"

#include <cmath>
#include <numbers>

namespace command {
namespace {

constexpr int sides = 48;                ///< of a ring
constexpr double stroke = 1.3;           ///< pixels
/// Share of the longer half axis: rings are drawn so much nearer to the eye, or they would go under triangles that
/// bend towards it. On edges of two sines of 30 degrees of the radius a surface leaves its tangent plane by a quarter.
constexpr double nearer = 0.25;
constexpr Colour axis_colour{0.55f, 0.02f, 0.03f};  ///< linear light

/// Normals of vertices by area; 0 where no triangle is. `used`: vertices of triangles and edges.
std::vector<Point> normals_of(const MeshArrays& mesh, std::vector<char>& used) {
  std::vector<Point> normals(mesh.vertices.size(), Point{0, 0, 0});
  used.assign(mesh.vertices.size(), 0);
  for (const auto& t : mesh.triangles) {
    const Point n = cross(minus(mesh.vertices[t[1]], mesh.vertices[t[0]]), minus(mesh.vertices[t[2]], mesh.vertices[t[0]]));
    for (const std::int32_t v : t) {
      used[v] = 1;
      for (int k = 0; k < 3; ++k) normals[v][k] += n[k];
    }
  }
  for (const auto& edge : mesh.edges)
    for (const std::int32_t v : edge) used[v] = 1;
  return normals;
}

struct Frame {
  Point e1, e2;  ///< unit vectors across `n`
  explicit Frame(const Point& n)
      : e1(unit(std::abs(n[0]) < 0.9 ? cross(n, {1, 0, 0}) : cross(n, {0, 1, 0}))), e2(cross(n, e1)) {}
};

struct Ellipse {
  Point major{}, minor{};  ///< half axes
};

/// In the plane of two unit vectors.
Ellipse ellipse_in(const Point& e1, const Point& e2, const std::array<double, 6>& m) {
  const auto form = [&](const Point& a, const Point& b) {
    return a[0] * (m[0] * b[0] + m[1] * b[1] + m[2] * b[2]) + a[1] * (m[1] * b[0] + m[3] * b[1] + m[4] * b[2]) +
           a[2] * (m[2] * b[0] + m[4] * b[1] + m[5] * b[2]);
  };
  const double a = form(e1, e1), b = form(e1, e2), c = form(e2, e2);
  const double angle = std::atan2(2 * b, a - c) / 2, mean = (a + c) / 2, half = std::hypot((a - c) / 2, b);
  const double h1 = 1 / std::sqrt(mean + half), h2 = 1 / std::sqrt(std::max(mean - half, 1e-300));
  Ellipse ellipse;
  for (int k = 0; k < 3; ++k) {
    ellipse.minor[k] = h1 * (std::cos(angle) * e1[k] + std::sin(angle) * e2[k]);
    ellipse.major[k] = h2 * (std::cos(angle) * e2[k] - std::sin(angle) * e1[k]);
  }
  return ellipse;
}

/// A line between two points of the picture.
void add_stroke(const Point& p, const Point& q, std::vector<ScreenTriangle>& triangles) {
  const double length = std::hypot(q[0] - p[0], q[1] - p[1]);
  if (!(length > 0)) return;
  const double x = -(q[1] - p[1]) / length * stroke / 2, y = (q[0] - p[0]) / length * stroke / 2;
  const Point a{p[0] + x, p[1] + y, p[2]}, b{p[0] - x, p[1] - y, p[2]}, c{q[0] - x, q[1] - y, q[2]},
      d{q[0] + x, q[1] + y, q[2]};
  triangles.push_back({.corners = {a, b, c}, .colour = axis_colour});
  triangles.push_back({.corners = {a, c, d}, .colour = axis_colour});
}

}  // namespace

VertexMetrics read_metrics(carreau_mesh* mesh, std::size_t vertices, const std::string& path) {
  VertexMetrics metrics(vertices);
  if (vertices > 0)
    require(mesh, carreau_mesh_read_metrics(mesh, path.c_str(), static_cast<std::int64_t>(vertices),
                                            metrics.front().data()));
  return metrics;
}

VertexMetrics metrics_of_triangles(const MeshArrays& mesh) {
  std::vector<char> used;
  const std::vector<Point> normals = normals_of(mesh, used);
  // For each vertex, the sum of (x^2, xy, y^2) over the sides of the triangles around, in its own frame, and their number.
  std::vector<std::array<double, 4>> sums(mesh.vertices.size());
  for (const auto& t : mesh.triangles)
    for (const std::int32_t v : t) {
      const Frame frame(unit(normals[v]));
      for (int k = 0; k < 3; ++k) {
        const Point side = minus(mesh.vertices[t[(k + 1) % 3]], mesh.vertices[t[k]]);
        const double x = dot(side, frame.e1), y = dot(side, frame.e2);
        sums[v][0] += x * x, sums[v][1] += x * y, sums[v][2] += y * y;
      }
      ++sums[v][3];
    }
  VertexMetrics metrics(mesh.vertices.size(), {1, 0, 0, 1, 0, 1});
  for (std::size_t v = 0; v < metrics.size(); ++v) {
    const double xx = sums[v][0], xy = sums[v][1], yy = sums[v][2], n = sums[v][3];
    const double k = 1.5 * n / (xx * yy - xy * xy);  // of the inverse of 2/3 of the mean
    if (!(n > 0) || !std::isfinite(k)) continue;
    const Frame frame(unit(normals[v]));
    const Point &e1 = frame.e1, &e2 = frame.e2;
    const auto entry = [&](int i, int j) {
      return k * (yy * e1[i] * e1[j] - xy * (e1[i] * e2[j] + e2[i] * e1[j]) + xx * e2[i] * e2[j]);
    };
    metrics[v] = {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)};
  }
  return metrics;
}

void add_ellipses(const MeshArrays& mesh, const VertexMetrics& metrics, double scale, const Projection& projection,
                  std::vector<ScreenTriangle>& triangles) {
  std::vector<char> used;
  const std::vector<Point> normals = normals_of(mesh, used);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (used[v] == 0) continue;
    Point n = unit(normals[v]);
    if (projection.in_camera(n)[2] < projection.in_camera({0, 0, 0})[2]) n = {-n[0], -n[1], -n[2]};
    const Frame frame(n);
    const Ellipse ellipse = ellipse_in(frame.e1, frame.e2, metrics[v]);
    const double ahead = nearer * scale * std::sqrt(dot(ellipse.major, ellipse.major));
    const auto at = [&](int i) {
      const double angle = 2 * std::numbers::pi * i / sides;
      Point p = mesh.vertices[v];
      for (int k = 0; k < 3; ++k)
        p[k] += scale * (std::cos(angle) * ellipse.major[k] + std::sin(angle) * ellipse.minor[k]);
      return projection.ahead(p, ahead);
    };
    for (int i = 0; i < sides; ++i) add_stroke(at(i), at(i + 1), triangles);
  }
}

}  // namespace command
