// SPDX-License-Identifier: BSD-3-Clause
#include "volume/shell_check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <set>
#include <unordered_set>

namespace command {
namespace {

/// Connected triangles of one solid.
struct Shell {
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< seen from outside of the solid
  std::set<std::int32_t> faces;
  std::unordered_set<std::int32_t> vertices;
  Point low{}, high{};
};

class SolidShells {
 public:
  SolidShells(const SolidSurface& surface, std::int32_t solid) : surface_(surface), parent_(surface.vertices.size()) {
    std::iota(parent_.begin(), parent_.end(), 0);
    const auto is_of = [&](std::size_t t) { return (surface.sides[t][0] == solid) != (surface.sides[t][1] == solid); };
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
      if (is_of(t))
        for (const std::int32_t v : surface.triangles[t]) parent_[static_cast<std::size_t>(root(v))] = root(surface.triangles[t][0]);
    std::map<std::int32_t, Shell> by_root;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      if (!is_of(t)) continue;
      std::array<std::int32_t, 3> corners = surface.triangles[t];
      if (surface.sides[t][1] == solid) std::swap(corners[1], corners[2]);
      Shell& shell = by_root[root(corners[0])];
      shell.triangles.push_back(corners);
      shell.vertices.insert(corners.begin(), corners.end());
      shell.faces.insert(surface.refs[t]);
    }
    for (auto& [vertex, shell] : by_root) {
      shell.low = shell.high = at(shell.triangles.front()[0]);
      for (const auto& corners : shell.triangles)
        for (const std::int32_t v : corners)
          for (std::size_t k = 0; k < 3; ++k) shell.low[k] = std::min(shell.low[k], at(v)[k]), shell.high[k] = std::max(shell.high[k], at(v)[k]);
      shells_.push_back(std::move(shell));
    }
  }

  [[nodiscard]] const std::vector<Shell>& shells() const { return shells_; }
  /// A vertex of the shell that the solid does not have lies in its material.
  [[nodiscard]] bool holds(const Shell& shell) const {
    const auto is_foreign = [&](std::int32_t v) {
      return std::none_of(shells_.begin(), shells_.end(), [&](const Shell& own) { return own.vertices.contains(v); });
    };
    for (const auto& corners : shell.triangles)
      for (const std::int32_t v : corners)
        if (is_foreign(v)) {
          double sum = 0;
          for (const Shell& own : shells_) sum += winding_of(own, at(v));
          return sum > .5;
        }
    return false;
  }

  /// The first shell on whose wrong side the material lies; null: none.
  [[nodiscard]] const Shell* wrong(bool& inside) const {
    for (const Shell& shell : shells_) {
      inside = false;
      for (const Shell& other : shells_)
        if (&other != &shell && std::abs(winding_of(other, at(shell.triangles.front()[0]))) > .5) inside = !inside;
      if ((volume_of(shell) < 0) != inside) return &shell;
    }
    return nullptr;
  }

 private:
  std::int32_t root(std::int32_t v) {
    while (parent_[static_cast<std::size_t>(v)] != v) {
      std::int32_t& up = parent_[static_cast<std::size_t>(v)];
      v = up = parent_[static_cast<std::size_t>(up)];
    }
    return v;
  }
  [[nodiscard]] const Point& at(std::int32_t v) const { return surface_.vertices[static_cast<std::size_t>(v)]; }

  [[nodiscard]] double volume_of(const Shell& shell) const {
    const Point& origin = at(shell.triangles.front()[0]);
    double sum = 0;
    for (const auto& [a, b, c] : shell.triangles) sum += triple(minus(at(a), origin), minus(at(b), origin), minus(at(c), origin)) / 6;
    return sum;
  }

  // Solid angles of triangles: van Oosterom and Strackee, "The solid angle of a plane triangle", 1983, eq. 8.
  [[nodiscard]] double winding_of(const Shell& shell, const Point& p) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (p[k] < shell.low[k] || p[k] > shell.high[k]) return 0;
    double sum = 0;
    for (const auto& [i, j, k] : shell.triangles) {
      const Point a = minus(at(i), p), b = minus(at(j), p), c = minus(at(k), p);
      const double la = std::sqrt(dot(a, a)), lb = std::sqrt(dot(b, b)), lc = std::sqrt(dot(c, c));
      sum += 2 * std::atan2(triple(a, b, c), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
    return sum / (4 * std::numbers::pi);
  }

  const SolidSurface& surface_;
  std::vector<std::int32_t> parent_;  // of vertices, to the root of their shell
  std::vector<Shell> shells_;
};

std::string list_of_faces(const std::set<std::int32_t>& faces) {
  constexpr std::size_t listed = 5;
  std::string text = faces.size() == 1 ? "face " : "faces ";
  std::size_t k = 0;
  for (auto face = faces.begin(); face != faces.end() && k < listed; ++face, ++k) text += (k > 0 ? ", " : "") + std::to_string(*face);
  return faces.size() > listed ? text + " and " + std::to_string(faces.size() - listed) + " more" : text;
}

std::string name_of_solid(const SolidSurface& surface, std::int32_t solid) {
  const auto found = surface.solids.find(solid);
  return "solid " + std::to_string(solid) + (found == surface.solids.end() || found->second.empty() ? "" : " (" + found->second + ")");
}

std::string text_of_shell(const SolidSurface& surface, const Shell& shell) {
  const Point& p = surface.vertices[static_cast<std::size_t>(shell.triangles.front()[0])];
  char place[100];
  std::snprintf(place, sizeof place, " at (%.9g, %.9g, %.9g)", p[0], p[1], p[2]);
  return "shell of " + list_of_faces(shell.faces) + place;
}

}  // namespace

void check_shells(const SolidSurface& surface) {
  std::vector<std::pair<std::int32_t, SolidShells>> all;
  for (const auto& [solid, volume] : surface.volumes) {
    const SolidShells& shells = all.emplace_back(solid, SolidShells(surface, solid)).second;
    bool inside = false;
    if (const Shell* shell = shells.wrong(inside))
      throw Failure("No engine can fill " + name_of_solid(surface, solid) + ": the normals of its " + text_of_shell(surface, *shell) +
                    (inside ? " point out of this shell, which lies inside the solid. A cavity requires the reversed shell."
                            : " point into this shell, which no other shell of the solid holds. The solid requires the reversed shell."));
  }
  for (const auto& [solid, shells] : all)
    for (const auto& [other, own] : all)
      for (const Shell& shell : own.shells())
        if (other != solid && shells.holds(shell))
          throw Failure("No engine can fill the mesh: the " + text_of_shell(surface, shell) + " of " + name_of_solid(surface, other) +
                        " lies inside " + name_of_solid(surface, solid) + ", which has no cavity there. For CAD files, see --imprint.");
}

}  // namespace command
