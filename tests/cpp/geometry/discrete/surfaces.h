// SPDX-License-Identifier: BSD-3-Clause
// Triangulated surfaces in closed form.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include "geometry/discrete/surface.h"
#include "mesh/flat_mesh.h"

namespace carreau::discrete {

inline FlatMesh icosahedron() {
  FlatMesh mesh;
  const double g = std::numbers::phi;
  for (const double s : {-1.0, 1.0})
    for (const double t : {-g, g}) {
      mesh.vertices.push_back(Vec3{0, s, t}.normalized());
      mesh.vertices.push_back(Vec3{s, t, 0}.normalized());
      mesh.vertices.push_back(Vec3{t, 0, s}.normalized());
    }
  const double side = 2 / std::sqrt(1 + g * g);
  const auto near = [&](std::size_t i, std::size_t j) {
    return norm(mesh.vertices[i] - mesh.vertices[j]) < 1.01 * side;
  };
  for (std::int32_t i = 0; i < 12; ++i)
    for (std::int32_t j = i + 1; j < 12; ++j)
      for (std::int32_t k = j + 1; k < 12; ++k) {
        const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j), c = static_cast<std::size_t>(k);
        if (!near(a, b) || !near(b, c) || !near(c, a)) continue;
        const Vec3 &p = mesh.vertices[a], &q = mesh.vertices[b], &r = mesh.vertices[c];
        if (dot(cross(q - p, r - p), p) > 0)
          mesh.triangles.push_back({i, j, k});
        else
          mesh.triangles.push_back({i, k, j});
      }
  return mesh;
}

/// Each triangle cut into n^2, vertices put where `onto` sends them; joined by Triangulation.
inline FlatMesh cut(const FlatMesh& coarse, int n, const std::function<Vec3(const Vec3&)>& onto) {
  FlatMesh fine;
  for (std::size_t t = 0; t < coarse.triangles.size(); ++t) {
    // Weights in the order of the vertices, so that both sides of an edge have the same bits.
    std::array<std::int32_t, 3> v = coarse.triangles[t];
    const auto at = [&](int i, int j) {
      const std::array<int, 3> w{n - i - j, i, j};
      std::array<std::size_t, 3> order{0, 1, 2};
      std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return v[a] < v[b]; });
      Vec3 p = Vec3::Zero();
      for (const std::size_t k : order)
        p += (static_cast<double>(w[k]) / n) * coarse.vertices[static_cast<std::size_t>(v[k])];
      fine.vertices.push_back(onto(p));
      return static_cast<std::int32_t>(fine.vertices.size()) - 1;
    };
    const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
      fine.triangles.push_back({a, b, c});
      if (!coarse.triangle_refs.empty()) fine.triangle_refs.push_back(coarse.triangle_refs[t]);
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        add(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j + 1 < n) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
  }
  return fine;
}

inline FlatMesh sphere(int n) {
  return cut(icosahedron(), n, [](const Vec3& p) -> Vec3 { return p.normalized(); });
}

/// Nodes of a grid that is closed both ways.
inline FlatMesh torus(int around, int across, double R = 2, double r = 0.7) {
  FlatMesh mesh;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
      mesh.vertices.emplace_back((R + r * std::cos(v)) * std::cos(u), (R + r * std::cos(v)) * std::sin(u),
                                 r * std::sin(v));
      const std::int32_t a = i * across + j, b = (i + 1) % around * across + j,
                         c = (i + 1) % around * across + (j + 1) % across, d = i * across + (j + 1) % across;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  return mesh;
}
inline double distance_to_torus(const Vec3& p, double R = 2, double r = 0.7) {
  return std::abs(std::hypot(std::hypot(p.x(), p.y()) - R, p.z()) - r);
}

/// [0, 1]^3, each side in n x n squares of two triangles.
inline FlatMesh cube(int n) {
  FlatMesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, 1})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto corner = [&](int di, int dj) {
            Vec3 p;
            p[axis] = side, p[(axis + 1) % 3] = static_cast<double>(i + di) / n,
            p[(axis + 2) % 3] = static_cast<double>(j + dj) / n;
            mesh.vertices.push_back(p);
            return static_cast<std::int32_t>(mesh.vertices.size()) - 1;
          };
          std::array<std::int32_t, 4> c{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
          if (side == 0) std::swap(c[1], c[3]);
          mesh.triangles.push_back({c[0], c[1], c[2]});
          mesh.triangles.push_back({c[0], c[2], c[3]});
        }
  return mesh;
}

/// Radius 1 and height h, with bottom and top, of n sides.
inline FlatMesh cylinder(int n, double h = 2) {
  FlatMesh mesh;
  for (int i = 0; i < n; ++i)
    for (const double z : {0.0, h})
      mesh.vertices.emplace_back(std::cos(2 * std::numbers::pi * i / n), std::sin(2 * std::numbers::pi * i / n), z);
  mesh.vertices.emplace_back(0, 0, 0), mesh.vertices.emplace_back(0, 0, h);
  for (int i = 0; i < n; ++i) {
    const std::int32_t a = 2 * i, b = 2 * ((i + 1) % n);
    mesh.triangles.push_back({a, b, b + 1});
    mesh.triangles.push_back({a, b + 1, a + 1});
    mesh.triangles.push_back({b, a, 2 * n});
    mesh.triangles.push_back({a + 1, b + 1, 2 * n + 1});
  }
  return mesh;
}

inline DiscreteSurface surface_of(const FlatMesh& mesh, const SharpOptions& options = {}) {
  Triangulation triangulation(mesh);
  SharpLines lines = find_sharp_lines(triangulation, options);
  return {std::move(triangulation), std::move(lines)};
}

/// The largest of `distance` over points of all patches.
template <typename Distance>
double largest(const DiscreteSurface& surface, Distance&& distance, int n = 6) {
  double most = 0;
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(surface.triangles()); ++t)
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j)
        most = std::max(
            most, distance(surface.at(t, {static_cast<double>(i) / n, static_cast<double>(j) / n}, want_position).s));
  return most;
}

}  // namespace carreau::discrete
