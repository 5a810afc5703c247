// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/discrete/normals.h"

#include <algorithm>
#include <cmath>

#include "geometry/discrete/thresholds.h"
#include "support/angles.h"
#include "support/incidence.h"
#include "support/infinity.h"
#include "support/rounding_of.h"

namespace carreau::discrete {

namespace {


Vec3 unit(const Vec3& v) noexcept {
  const double length = norm(v);
  return length > 0 ? Vec3(v / length) : Vec3::Zero();
}

/// The unit vector of `n` without its component along the unit vector `t`; `n` itself if nothing remains.
Vec3 across(const Vec3& n, const Vec3& t) noexcept {
  const Vec3 left = n - dot(n, t) * t;
  return norm(left) > rounding_of::heights ? unit(left) : n;
}

/// The sharp edges at each vertex.
class LinesAt {
 public:
  LinesAt(const Triangulation& mesh, const SharpLines& lines)
      : mesh_(mesh), lines_(lines), at_(mesh.vertices.size(), mesh.edges) {}
  [[nodiscard]] std::vector<std::int32_t> of(std::int32_t v) const {
    std::vector<std::int32_t> found;
    for (const std::int32_t e : at_.of(v))
      if (lines_.sharp[index(e)] != 0) found.push_back(e);
    return found;
  }
  [[nodiscard]] Vec3 leaving(std::int32_t e, std::int32_t v) const {
    const Edge& edge = mesh_.edges[index(e)];
    return mesh_.at(edge[0] == v ? edge[1] : edge[0]) - mesh_.at(v);
  }

 private:
  const Triangulation& mesh_;
  const SharpLines& lines_;
  Incidence at_;
};

/// Normals of sectors: of all corners at a vertex between sharp edges.
class SectorNormals {
 public:
  SectorNormals(const Triangulation& mesh, UnionFind& sectors) : mesh_(mesh) {
    first_.reserve(3 * mesh.triangles.size());
    for (std::size_t c = 0; c < 3 * mesh.triangles.size(); ++c) first_.push_back(sectors.find(c));
  }

  /// Means by the angles of triangles (eq. 4.96). A mean by areas replaces a mean by angles if that lifts an edge of a
  /// large triangle too far. The limit is the reach of the small triangles that turn the mean: beside a rounding the
  /// flat face keeps its plane.
  Frames run() const {
    Frames frames{
        .normal = means([&](std::size_t c) { return mesh_.angle(triangle(c), rank(c)); }), .reach = {}, .tangent = {}};
    const std::vector<Vec3> by_area = means([&](std::size_t c) { return norm(cross(side(c, 1), side(c, 2))); });
    const std::vector<double> lift = lifts(frames.normal), other_lift = lifts(by_area);
    frames.reach = reaches(frames.normal);
    for (std::size_t c = 0; c < first_.size(); ++c)
      if (lift[c] > frames.reach[c] && other_lift[c] < thresholds::lower_lift * lift[c]) frames.normal[c] = by_area[c];
    frames.reach = reaches(frames.normal);
    spread(frames.normal), spread(frames.reach);
    return frames;
  }

 private:
  static std::int32_t triangle(std::size_t c) { return static_cast<std::int32_t>(c / 3); }
  static int rank(std::size_t c) { return static_cast<int>(c % 3); }
  [[nodiscard]] Vec3 side(std::size_t c, int k) const {
    return mesh_.at(mesh_.corner(triangle(c), rank(c) + k)) - mesh_.at(mesh_.corner(triangle(c), rank(c)));
  }
  template <class Value>
  void spread(std::vector<Value>& of_first) const {
    for (std::size_t c = 0; c < first_.size(); ++c) of_first[c] = of_first[first_[c]];
  }

  // The following values are known at the first corner of each sector.
  template <class Weight>
  [[nodiscard]] std::vector<Vec3> means(const Weight& weight) const {
    std::vector<Vec3> normal(first_.size(), Vec3::Zero());
    for (std::size_t c = 0; c < first_.size(); ++c) normal[first_[c]] += weight(c) * mesh_.normal(triangle(c));
    for (std::size_t c = 0; c < first_.size(); ++c) {
      if (first_[c] != c) continue;
      const Vec3 n = unit(normal[c]);
      normal[c] = norm(n) > 0 ? n : mesh_.normal(triangle(c));
    }
    return normal;
  }

  // Largest distance of edges from the tangent plane.
  [[nodiscard]] std::vector<double> lifts(const std::vector<Vec3>& normal) const {
    std::vector<double> lift(first_.size(), 0);
    for (std::size_t c = 0; c < first_.size(); ++c)
      for (const int k : {1, 2})
        lift[first_[c]] = std::max(lift[first_[c]], std::abs(dot(normal[first_[c]], side(c, k))));
    return lift;
  }

  // Least extent of triangles that turn the normal, in the direction of the turn.
  [[nodiscard]] std::vector<double> reaches(const std::vector<Vec3>& normal) const {
    std::vector<double> reach(first_.size(), infinity);
    for (std::size_t c = 0; c < first_.size(); ++c) {
      const Vec3 &n = normal[first_[c]], of_triangle = mesh_.normal(triangle(c));
      const Vec3 turn = of_triangle - dot(of_triangle, n) * n;
      const double sine = norm(turn);
      if (!(sine > thresholds::clear_turn)) continue;
      const double extent = std::max(std::abs(dot(turn, side(c, 1))), std::abs(dot(turn, side(c, 2)))) / sine;
      reach[first_[c]] = std::min(reach[first_[c]], extent);
    }
    return reach;
  }

  const Triangulation& mesh_;
  std::vector<std::size_t> first_;
};

/// Tangents of the lines that pass vertices.
std::vector<Vec3> line_tangents(const Triangulation& mesh, const SharpLines& lines, const std::vector<Vec3>& normal) {
  std::vector<Vec3> tangent(mesh.vertices.size(), Vec3::Zero());
  const LinesAt at(mesh, lines);
  for (const Line& line : lines.lines)
    for (const std::int32_t v : line.vertices) {
      if (norm(tangent[index(v)]) > 0 || std::ranges::binary_search(lines.corners, v)) continue;
      const std::vector<std::int32_t> two = at.of(v);
      if (two.size() != 2) continue;
      // Along the polyline, with the inverse of each edge's length as weight: the tangent of a parabola.
      const Vec3 p = at.leaving(two[0], v), q = at.leaving(two[1], v);
      Vec3 t = unit(q / dot(q, q) - p / dot(p, p));
      const auto both = mesh.sides(two[0]);
      if (both.size() == 2) {
        const auto normal_in = [&](const Side& s) {
          const int k = mesh.corner(s.triangle, s.side) == v ? s.side : s.side + 1;
          return normal[3 * index(s.triangle) + static_cast<std::size_t>(k % 3)];
        };
        const Vec3 crease = cross(normal_in(both[0]), normal_in(both[1]));
        if (norm(crease) > thresholds::clear_crease) t = unit(dot(crease, t) < 0 ? Vec3(-crease) : crease);
      }
      tangent[index(v)] = t;
    }
  return tangent;
}

/// The curve of a sharp edge. At a corner it is free: a parabola, or the straight edge.
Cubic line_curve(const Vec3& p, const Vec3& q, const Vec3& tp, const Vec3& tq) noexcept {
  const double length = norm(q - p);
  const auto along = [&](const Vec3& t) -> Vec3 { return dot(t, q - p) < 0 ? Vec3(-t) : t; };
  const bool free_p = norm(tp) == 0, free_q = norm(tq) == 0;
  Vec3 z1 = p + length / 3 * along(tp), z2 = q - length / 3 * along(tq);
  if (free_p && free_q) return {p, lerp(p, q, 1. / 3), lerp(p, q, 2. / 3), q};
  if (free_p) z1 = 0.5 * (p + z2);
  if (free_q) z2 = 0.5 * (z1 + q);
  return {p, z1, z2, q};
}

/// Moves the inner points of a curve so that they are no farther from its chord than the reach of the triangles that
/// turn the tangents.
Cubic kept_near(Cubic z, double reach_start, double reach_end) noexcept {
  const Vec3 u = unit(z[3] - z[0]);
  const auto keep = [&](Vec3& point, double reach) {
    const Vec3 along = dot(point - z[0], u) * u, off = point - z[0] - along;
    const double far = norm(off);
    if (far > reach) point = z[0] + along + (reach / far) * off;
  };
  keep(z[1], reach_start), keep(z[2], reach_end);
  return z;
}

/// Moves the inner points of the curve of a sharp edge no farther inside the triangles of the edge than halfway to the
/// other sides. A curve beyond these would fold patches, or bend long edges there.
Cubic kept_outside(const Triangulation& mesh, std::int32_t e, Cubic z) noexcept {
  for (const Side& side : mesh.sides(e)) {
    const std::int32_t first = mesh.corner(side.triangle, side.side);
    const bool forward = mesh.edges[index(e)][0] == first;
    for (const int end : {0, 1}) {
      const int k = side.side + end;
      const Vec3 &p = mesh.at(mesh.corner(side.triangle, k)),
                 &q = mesh.at(mesh.corner(side.triangle, side.side + 1 - end)), &other = mesh.at(mesh.corner(side.triangle, side.side + 2));
      const Vec3 u = unit(q - p), inside = unit(other - p - dot(other - p, u) * u);
      Vec3& point = z[forward == (end == 0) ? 1 : 2];
      const Vec3 along = dot(point - p, u) * u, off = point - p - along;
      const double from = std::clamp(dot(along, u), 0.0, norm(q - p));
      const double here = mesh.angle(side.triangle, k % 3), there = mesh.angle(side.triangle, (side.side + 1 - end) % 3);
      const double allowed = std::min(std::tan(here / 2) * from, std::tan(there / 2) * (norm(q - p) - from));
      if (const double far = dot(off, inside); far > allowed) point = p + along + (allowed / far) * off;
    }
  }
  return z;
}

/// The shortest sharp edge at each vertex.
std::vector<double> shortest_sharp(const Triangulation& mesh, const SharpLines& lines) {
  std::vector<double> shortest(mesh.vertices.size(), infinity);
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    if (const auto& [p, q] = mesh.edges[e]; lines.sharp[e] != 0)
      for (const std::int32_t v : {p, q})
        shortest[index(v)] = std::min(shortest[index(v)], norm(mesh.at(q) - mesh.at(p)));
  return shortest;
}

/// At corners the region has the plane of the two lines beside it.
void set_corner_planes(const Triangulation& mesh, const SharpLines& lines, const std::vector<Cubic>& curves,
                       Frames& frames) {
  UnionFind sectors = sectors_of(mesh, lines.sharp);
  std::vector<std::array<Vec3, 2>> beside(3 * mesh.triangles.size());
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(mesh.triangles.size()); ++t)
    for (int i = 0; i < 3; ++i) {
      const std::int32_t e = mesh.edge(t, i);
      if (lines.sharp[index(e)] == 0) continue;
      const Cubic& z = curves[index(e)];
      for (const int k : {i, (i + 1) % 3}) {
        const std::int32_t v = mesh.corner(t, k);
        const bool at_start = mesh.edges[index(e)][0] == v;
        auto& two = beside[sectors.find(3 * index(t) + static_cast<std::size_t>(k))];
        two[k == i ? 0 : 1] = unit(at_start ? z[1] - z[0] : z[2] - z[3]);
      }
    }
  for (std::size_t c = 0; c < beside.size(); ++c) {
    const std::int32_t v = mesh.triangles[c / 3][c % 3];
    if (!std::ranges::binary_search(lines.corners, v)) continue;
    const auto& [first, second] = beside[sectors.find(c)];
    Vec3& n = frames.normal[c];
    const Vec3 plane = cross(first, second);
    const double sine = norm(plane);
    const Vec3 of_lines = dot(plane, n) < 0 ? Vec3(-plane) : plane;
    if (sine > thresholds::clear_corner && dot(of_lines, n) > angles::cosine_of_45 * sine)
      n = of_lines / sine;
    else if (norm(first) > 0)
      n = across(n, first);
  }
}

}  // namespace

Frames find_frames(const Triangulation& mesh, const SharpLines& lines) {
  UnionFind sectors = sectors_of(mesh, lines.sharp);
  Frames frames = SectorNormals(mesh, sectors).run();
  frames.tangent = line_tangents(mesh, lines, frames.normal);
  for (std::size_t c = 0; c < frames.normal.size(); ++c)
    if (const Vec3& t = frames.tangent[index(mesh.triangles[c / 3][c % 3])]; norm(t) > 0)
      frames.normal[c] = across(frames.normal[c], t);
  return frames;
}

Cubic curve_by_normals(const Vec3& p, const Vec3& q, const Vec3& np, const Vec3& nq) noexcept {
  const double length = norm(q - p);
  const Vec3 u = (q - p) / length;
  const double a = dot(np, nq), ap = dot(np, u), aq = dot(nq, u), below = 4 - a * a;
  const double rho = 6 * (2 * ap + a * aq) / below, sigma = 6 * (2 * aq + a * ap) / below;
  return {p, p + length / 18 * (6 * u - 2 * rho * np + sigma * nq),
          q - length / 18 * (6 * u + rho * np - 2 * sigma * nq), q};
}

std::vector<Cubic> find_curves(const Triangulation& mesh, const SharpLines& lines, Frames& frames) {
  std::vector<Cubic> curves(mesh.edges.size());
  const std::vector<double> shortest = shortest_sharp(mesh, lines);
  for (std::size_t e = 0; e < curves.size(); ++e)
    if (const auto& [p, q] = mesh.edges[e]; lines.sharp[e] != 0)
      curves[e] = kept_outside(
          mesh, static_cast<std::int32_t>(e),
          kept_near(line_curve(mesh.at(p), mesh.at(q), frames.tangent[index(p)], frames.tangent[index(q)]),
                    shortest[index(p)], shortest[index(q)]));
  set_corner_planes(mesh, lines, curves, frames);
  for (std::size_t e = 0; e < curves.size(); ++e) {
    if (lines.sharp[e] != 0) continue;
    const Side side = mesh.sides(static_cast<std::int32_t>(e)).front();
    const auto& [p, q] = mesh.edges[e];
    const bool forward = mesh.corner(side.triangle, side.side) == p;
    const auto normal = [&](int k) {
      return frames.normal[3 * index(side.triangle) + static_cast<std::size_t>((side.side + k) % 3)];
    };
    const auto reach = [&](int k) {
      return frames.reach[3 * index(side.triangle) + static_cast<std::size_t>((side.side + k) % 3)];
    };
    curves[e] = kept_near(curve_by_normals(mesh.at(p), mesh.at(q), normal(forward ? 0 : 1), normal(forward ? 1 : 0)),
                          reach(forward ? 0 : 1), reach(forward ? 1 : 0));
  }
  return curves;
}

}  // namespace carreau::discrete
