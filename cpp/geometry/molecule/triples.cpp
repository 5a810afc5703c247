// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/molecule/triples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carreau::molecule {

namespace {

constexpr double rounding = 1e-13;  // of products of three or four lengths of one size

/// Offset of the circle's plane from the centre of p: HDR sec. 4.6.2, step 1.
double plane_offset(const Ball& p, const Ball& q, double distance) {
  return (distance + (p.radius - q.radius) * ((p.radius + q.radius) / distance)) / 2;
}

/// The two points of three spheres are centre of the first + middle +- height * across.
struct Triple {
  Vec3 middle, across;
  double height = 0;     ///< 0: no point
  double tolerance = 0;  ///< of the points
  bool doubtful = false;
};

Triple meet(const Ball& p, const Ball& q, const Ball& r) {
  const Vec3 pq = q.centre - p.centre, pr = r.centre - p.centre;
  const double dq = norm(pq), dr = norm(pr);
  const Vec3 a = pq / dq, b = pr / dr, w = cross(a, b);
  const double xq = plane_offset(p, q, dq), xr = plane_offset(p, r, dr);
  const double g = dot(a, b), w2 = dot(w, w), square = p.radius * p.radius;
  const double rest = square * w2 - (xq - xr) * (xq - xr) - 2 * xq * xr * (1 - g);
  const double size = std::max({p.radius, q.radius, r.radius});
  Triple triple;
  triple.doubtful = std::abs(rest) <= rounding * size * size;
  if (triple.doubtful || rest <= 0) return triple;
  triple.middle = ((xq - g * xr) / w2) * a + ((xr - g * xq) / w2) * b;
  triple.across = w / std::sqrt(w2);
  triple.height = std::sqrt(rest / w2);
  triple.tolerance = rounding * size * (10 + size / std::sqrt(rest));
  return triple;
}

}  // namespace

std::vector<int> Doubts::list() const {
  std::vector<int> sorted = balls_;
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  return sorted;
}

double Circle::angle(const Vec3& p) const {
  const Vec3 d = p - centre;
  const double angle = std::atan2(dot(d, e2), dot(d, e1));
  return angle < 0 ? angle + 2 * std::numbers::pi : angle;
}

Circle circle_of_pair(std::span<const Ball> balls, int i, int j) {
  const Ball &p = balls[i], &q = balls[j];
  const Vec3 pq = q.centre - p.centre;
  const double distance = norm(pq);
  Circle c{.i = i, .j = j};
  c.axis = pq / distance;
  c.offset_i = plane_offset(p, q, distance), c.offset_j = plane_offset(q, p, distance);
  c.radius = std::sqrt((p.radius - c.offset_i) * (p.radius + c.offset_i));
  c.centre = p.centre + c.offset_i * c.axis;
  c.e1 = across(c.axis);
  c.e2 = cross(c.axis, c.e1);
  return c;
}

Cover CoverTest::of(const Vec3& p, std::span<const int> but, int& doubtful_ball) const {
  Cover answer = Cover::no;
  for (const int l : others) {
    if (std::find(but.begin(), but.end(), l) != but.end()) continue;
    const Vec3 d = p - balls[l].centre;
    const double r = balls[l].radius, outside = dot(d, d) - r * r, doubt = 2 * r * tolerance;
    if (outside < -doubt) return Cover::yes;
    if (outside <= doubt) answer = Cover::doubtful, doubtful_ball = l;
  }
  return answer;
}

void find_vertices(std::span<const Ball> balls, const Neighbours& neighbours, int i, std::vector<Vertex>& vertices,
                   Doubts& doubts) {
  const std::span<const int> all = neighbours.of(i);
  // Balls that cover most of the sphere come first: most points are covered.
  std::vector<std::pair<double, int>> by_cover;
  for (const int l : all)
    by_cover.push_back({plane_offset(balls[i], balls[l], norm(balls[l].centre - balls[i].centre)), l});
  std::sort(by_cover.begin(), by_cover.end());
  std::vector<int> others;
  for (const auto& [offset, l] : by_cover) others.push_back(l);
  for (auto j = std::upper_bound(all.begin(), all.end(), i); j != all.end(); ++j)
    for (auto k = j + 1; k != all.end(); ++k) {
      if (!spheres_meet(balls[*j], balls[*k])) continue;
      const Triple triple = meet(balls[i], balls[*j], balls[*k]);
      if (triple.doubtful) doubts.add({i, *j, *k});
      if (triple.height <= 0) continue;
      const std::array<int, 3> but{i, *j, *k};
      const CoverTest test{balls, others, triple.tolerance};
      for (const double side : {1.0, -1.0}) {
        const Vec3 x = balls[i].centre + triple.middle + side * triple.height * triple.across;
        int ball = -1;
        const Cover cover = test.of(x, but, ball);
        if (cover == Cover::doubtful) doubts.add({i, *j, *k, ball});
        if (cover == Cover::no) vertices.push_back({but, x});
      }
    }
}

}  // namespace carreau::molecule
