// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/discrete/refinement.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "support/error.h"

namespace carreau::discrete {

namespace {

std::uint64_t key_of(std::int32_t v, std::int32_t w) noexcept {
  const Edge e = edge_of(v, w);
  return static_cast<std::uint64_t>(e[0]) << 32 | static_cast<std::uint64_t>(e[1]);
}

class Refiner {
 public:
  Refiner(const DiscreteSurface& surface, const RefinementWish& wish, const RefinementLimits& limits, Monitor& monitor)
      : surface_(surface), wish_(wish), limits_(limits), monitor_(monitor), mesh_(unrefined(surface)) {}

  RefinedMesh run() {
    for (int depth = 0;; ++depth) {
      monitor_.checkpoint();
      middle_.clear();
      mark();
      if (middle_.empty()) break;
      if (depth == limits_.depth) {
        mesh_.complete = false;
        break;
      }
      if (wish_.triangle) close();
      if (static_cast<std::int64_t>(mesh_.triangles.size() + 2 * middle_.size()) > limits_.triangles)
        throw LimitError("the refined mesh has more than " + std::to_string(limits_.triangles) + " triangles");
      cut();
    }
    return std::move(mesh_);
  }

 private:
  static constexpr std::int32_t wanted = -1;

  void mark() {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto& c = mesh_.triangles[t];
      const bool all = wish_.triangle && wish_.triangle(mesh_, t);
      for (std::size_t i = 0; i < 3; ++i)
        if (const std::int32_t v = c[i], w = c[(i + 1) % 3];
            all || (wish_.edge && wish_.edge(mesh_, std::min(v, w), std::max(v, w))))
          middle_.emplace(key_of(v, w), wanted);
    }
  }

  [[nodiscard]] int halved(const std::array<std::int32_t, 3>& c) const {
    int n = 0;
    for (std::size_t i = 0; i < 3; ++i) n += middle_.contains(key_of(c[i], c[(i + 1) % 3])) ? 1 : 0;
    return n;
  }

  // A triangle with two halves needs the third one halved, and so on.
  void close() {
    for (bool more = true; more;) {
      more = false;
      for (const auto& c : mesh_.triangles)
        if (halved(c) == 2)
          for (std::size_t i = 0; i < 3; ++i)
            more = middle_.emplace(key_of(c[i], c[(i + 1) % 3]), wanted).second || more;
    }
  }

  std::int32_t middle(std::size_t t, std::size_t i) {
    const auto& c = mesh_.triangles[t];
    std::int32_t& m = middle_.at(key_of(c[i], c[(i + 1) % 3]));
    if (m == wanted) {
      m = static_cast<std::int32_t>(mesh_.vertices.size());
      mesh_.vertices.push_back(surface_.at(mesh_.parent[t], middle_uv(t, i), want_position).s);
    }
    return m;
  }
  [[nodiscard]] Vec2 middle_uv(std::size_t t, std::size_t i) const {
    return 0.5 * (mesh_.uv[t][i] + mesh_.uv[t][(i + 1) % 3]);
  }

  void cut() {
    RefinedMesh next;
    next.triangles.reserve(mesh_.triangles.size() + 2 * middle_.size());
    const auto add = [&](std::size_t t, const std::array<std::int32_t, 3>& c, const std::array<Vec2, 3>& uv) {
      next.triangles.push_back(c), next.uv.push_back(uv), next.parent.push_back(mesh_.parent[t]);
    };
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto c = mesh_.triangles[t];
      const auto uv = mesh_.uv[t];
      const int n = halved(c);
      if (n == 0) {
        add(t, c, uv);
      } else if (n == 1) {
        std::size_t i = 0;
        while (!middle_.contains(key_of(c[i], c[(i + 1) % 3]))) ++i;
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        const std::int32_t m = middle(t, i);
        add(t, {c[i], m, c[k]}, {uv[i], middle_uv(t, i), uv[k]});
        add(t, {m, c[j], c[k]}, {middle_uv(t, i), uv[j], uv[k]});
      } else if (n == 2) {
        std::size_t k = 0;  // the corner between the halved sides
        while (middle_.contains(key_of(c[(k + 1) % 3], c[(k + 2) % 3]))) ++k;
        const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
        const std::int32_t ma = middle(t, k), mb = middle(t, b);
        const Vec2 pa = middle_uv(t, k), pb = middle_uv(t, b);
        add(t, {c[k], ma, mb}, {uv[k], pa, pb});
        // The shorter diagonal of the remaining quadrilateral.
        const auto at = [&](std::int32_t v) -> const Vec3& { return mesh_.vertices[index(v)]; };
        if (norm(at(c[a]) - at(mb)) <= norm(at(c[b]) - at(ma))) {
          add(t, {ma, c[a], mb}, {pa, uv[a], pb});
          add(t, {mb, c[a], c[b]}, {pb, uv[a], uv[b]});
        } else {
          add(t, {ma, c[a], c[b]}, {pa, uv[a], uv[b]});
          add(t, {mb, ma, c[b]}, {pb, pa, uv[b]});
        }
      } else {
        const std::array<std::int32_t, 3> m{middle(t, 0), middle(t, 1), middle(t, 2)};
        const std::array<Vec2, 3> p{middle_uv(t, 0), middle_uv(t, 1), middle_uv(t, 2)};
        add(t, m, p);
        for (std::size_t i = 0; i < 3; ++i) add(t, {c[i], m[i], m[(i + 2) % 3]}, {uv[i], p[i], p[(i + 2) % 3]});
      }
    }
    mesh_.triangles = std::move(next.triangles), mesh_.uv = std::move(next.uv), mesh_.parent = std::move(next.parent);
    for (auto& line : mesh_.lines) {
      std::vector<std::int32_t> finer{line.front()};
      for (std::size_t k = 1; k < line.size(); ++k) {
        if (const auto found = middle_.find(key_of(line[k - 1], line[k])); found != middle_.end())
          finer.push_back(found->second);
        finer.push_back(line[k]);
      }
      line = std::move(finer);
    }
  }

  const DiscreteSurface& surface_;
  const RefinementWish& wish_;
  const RefinementLimits& limits_;
  Monitor& monitor_;
  RefinedMesh mesh_;
  std::unordered_map<std::uint64_t, std::int32_t> middle_;  // of halved edges; never iterated
};

}  // namespace

RefinedMesh unrefined(const DiscreteSurface& surface) {
  RefinedMesh mesh;
  mesh.vertices = surface.mesh().vertices;
  mesh.triangles = surface.mesh().triangles;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) mesh.parent.push_back(static_cast<std::int32_t>(t));
  mesh.uv.assign(mesh.triangles.size(), {Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}});
  for (const Line& line : surface.lines().lines) mesh.lines.push_back(line.vertices);
  return mesh;
}

RefinedMesh refine(const DiscreteSurface& surface, const RefinementWish& wish, const RefinementLimits& limits,
                   Monitor& monitor) {
  return Refiner(surface, wish, limits, monitor).run();
}

RefinementWish wish_of_angle(const DiscreteSurface& surface, double angle) {
  constexpr double right = 90;
  if (!(angle > 0 && angle <= right))
    throw InvalidArgument("the angle of refinement must lie above 0 and not above 90 degrees");
  const double cosine = std::cos(angle * std::numbers::pi / (2 * right));
  RefinementWish wish;
  wish.triangle = [&surface, cosine](const RefinedMesh& mesh, std::size_t t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3 n =
        cross(mesh.vertices[index(b)] - mesh.vertices[index(a)], mesh.vertices[index(c)] - mesh.vertices[index(a)]);
    const double length = norm(n);
    return std::ranges::any_of(mesh.uv[t], [&](const Vec2& uv) {
      const SurfaceJet jet = surface.at(mesh.parent[t], uv, want_first);
      const Vec3 m = cross(jet.su, jet.sv);
      return dot(m, n) < cosine * norm(m) * length;
    });
  };
  return wish;
}

std::vector<std::int32_t> face_refs(const DiscreteSurface& surface) {
  if (!surface.faces().empty()) return surface.faces();
  const std::vector<std::int32_t>& given = surface.mesh().refs;
  const bool several = std::ranges::any_of(given, [&](std::int32_t ref) { return ref != given.front(); });
  const std::int32_t shift = several ? std::max(0, 1 - *std::ranges::min_element(given)) : 0;
  std::vector<std::int32_t> refs;
  for (std::size_t t = 0; t < given.size(); ++t)
    refs.push_back(several ? given[t] + shift : surface.lines().region[t] + 1);
  return refs;
}

FlatMesh flat_mesh(const DiscreteSurface& surface, const RefinedMesh& mesh) {
  FlatMesh flat;
  flat.vertices = mesh.vertices;
  flat.triangles = mesh.triangles;
  const std::vector<std::int32_t> refs = face_refs(surface);
  for (const std::int32_t parent : mesh.parent) flat.triangle_refs.push_back(refs[index(parent)]);
  flat.vertex_refs.assign(mesh.vertices.size(), 0);
  std::int32_t number = 0;
  for (const std::int32_t v : surface.lines().corners) flat.vertex_refs[index(v)] = ++number;
  number = 0;
  for (const auto& line : mesh.lines) {
    ++number;
    for (std::size_t k = 1; k < line.size(); ++k) {
      flat.edges.push_back({line[k - 1], line[k]});
      flat.edge_refs.push_back(number);
    }
  }
  return flat;
}

}  // namespace carreau::discrete
