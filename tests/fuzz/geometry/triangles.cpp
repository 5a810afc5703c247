// SPDX-License-Identifier: BSD-3-Clause
// Random triangulations: needles, caps, folds, several shells, edges of many triangles, triangles twice or without area.
#include <array>
#include <cstdint>
#include <numbers>
#include <vector>

#include "geometry_fuzz.h"
#include "session_handle.h"

namespace geometry_fuzz {
namespace {

using Point = std::array<double, 3>;
using Triangle = std::array<std::int32_t, 3>;

struct Surface {
  std::vector<Point> points;
  std::vector<Triangle> triangles;

  std::int32_t add(const Point& p) {
    points.push_back(p);
    return static_cast<std::int32_t>(points.size()) - 1;
  }
};

/// Points of a small lattice or anywhere, joined at random.
Surface soup(Random& random) {
  Surface s;
  const int n = 3 + random.below(12), lattice = random.chance(0.5) ? 2 + random.below(3) : 0;
  for (int i = 0; i < n; ++i) {
    Point p;
    for (double& x : p) x = lattice > 0 ? random.below(lattice) : random.uniform();
    s.add(p);
  }
  for (int t = 1 + random.below(24); t > 0; --t) s.triangles.push_back({random.below(n), random.below(n), random.below(n)});
  return s;
}

/// A net of columns x rows with steps in geometric progression, bent and folded; joined to a tube where `closes`.
Surface net(Random& random) {
  Surface s;
  const int columns = 2 + random.below(7), rows = 2 + random.below(7);
  const double ratio = random.chance(0.5) ? 1 : random.power(-1, 1), fold = random.chance(0.4) ? random.uniform(0, 2) : 0;
  const double height = random.chance(0.3) ? 0 : random.power(-4, 0.5);
  double x = 0, step = 1;
  for (int i = 0; i <= columns; ++i, x += step, step *= ratio)
    for (int j = 0; j <= rows; ++j)
      s.add({x + fold * random.uniform(-1, 1), j + fold * random.uniform(-1, 1), height * random.uniform(-1, 1)});
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      const std::int32_t a = i * (rows + 1) + j, b = a + rows + 1, c = b + 1, d = a + 1;
      if (random.chance(0.5))
        s.triangles.push_back({a, b, c}), s.triangles.push_back({a, c, d});
      else
        s.triangles.push_back({a, b, d}), s.triangles.push_back({b, c, d});
    }
  return s;
}

/// A prism over a star of `n` corners, its ends cut into a fan from one corner, as programs write flat ends.
void add_prism(Random& random, const Point& at, Surface& s) {
  const int n = 3 + random.below(14);
  const double height = random.power(-2, 1), wobble = random.chance(0.5) ? 0 : random.uniform(0, 0.6);
  const bool centre = random.chance(0.3), cone = random.chance(0.2);
  std::vector<std::int32_t> low, high;
  for (int i = 0; i < n; ++i) {
    const double a = 2 * std::numbers::pi * i / n, r = 1 - wobble * random.uniform();
    low.push_back(s.add({at[0] + r * std::cos(a), at[1] + r * std::sin(a), at[2]}));
    if (!cone) high.push_back(s.add({at[0] + r * std::cos(a), at[1] + r * std::sin(a), at[2] + height}));
  }
  if (cone) high.assign(static_cast<std::size_t>(n), s.add({at[0], at[1], at[2] + height}));
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    s.triangles.push_back({low[i], low[j], high[j]});
    if (!cone) s.triangles.push_back({low[i], high[j], high[i]});
  }
  const std::int32_t middle = centre ? s.add(at) : low[0];
  for (int i = centre ? 0 : 1; i + (centre ? 0 : 1) < n; ++i) {
    s.triangles.push_back({middle, low[(i + 1) % n], low[i]});
    if (!cone && !centre) s.triangles.push_back({high[0], high[i], high[i + 1]});
  }
  if (centre && !cone) {
    const std::int32_t top = s.add({at[0], at[1], at[2] + height});
    for (int i = 0; i < n; ++i) s.triangles.push_back({top, high[i], high[(i + 1) % n]});
  }
}

/// A sphere of rings, smooth enough for wide regions.
void add_ball(Random& random, const Point& at, Surface& s) {
  const int columns = 3 + random.below(10), rows = 2 + random.below(6);
  const double noise = random.chance(0.5) ? 0 : random.power(-3, -0.5);
  const auto place = [&](double polar, double azimuth) -> Point {
    const double r = 1 + noise * random.uniform(-1, 1);
    return {at[0] + r * std::sin(polar) * std::cos(azimuth), at[1] + r * std::sin(polar) * std::sin(azimuth),
            at[2] + r * std::cos(polar)};
  };
  const std::int32_t north = s.add(place(0, 0)), south = s.add(place(std::numbers::pi, 0));
  std::vector<std::int32_t> ring;
  for (int j = 1; j < rows; ++j)
    for (int i = 0; i < columns; ++i)
      ring.push_back(s.add(place(std::numbers::pi * j / rows, 2 * std::numbers::pi * i / columns)));
  for (int i = 0; i < columns; ++i) {
    const int k = (i + 1) % columns, last = (rows - 2) * columns;
    s.triangles.push_back({north, ring[i], ring[k]});
    s.triangles.push_back({south, ring[last + k], ring[last + i]});
    for (int j = 0; j + 2 < rows; ++j) {
      const std::int32_t a = ring[j * columns + i], b = ring[j * columns + k], c = ring[(j + 1) * columns + k],
                         d = ring[(j + 1) * columns + i];
      s.triangles.push_back({a, d, c}), s.triangles.push_back({a, c, b});
    }
  }
}

Surface shells(Random& random) {
  Surface s;
  for (int n = 1 + random.below(3); n > 0; --n) {
    Point at{};
    if (random.chance(0.7))
      for (double& x : at) x = random.chance(0.5) ? random.uniform(-2, 2) : random.below(3);
    random.chance(0.5) ? add_prism(random, at, s) : add_ball(random, at, s);
  }
  return s;
}

/// One change to a few triangles, as in broken files.
void spoil(Random& random, Surface& s) {
  const auto any_point = [&] { return random.below(static_cast<int>(s.points.size())); };
  const auto any_triangle = [&] { return random.below(static_cast<int>(s.triangles.size())); };
  Triangle& t = s.triangles[static_cast<std::size_t>(any_triangle())];
  Point& p = s.points[static_cast<std::size_t>(any_point())];
  switch (random.below(9)) {
    case 0: std::swap(t[0], t[1]); break;                              // turned over
    case 1: s.triangles.push_back(Triangle(t)); break;                 // twice
    case 2: t[random.below(3)] = any_point(); break;                   // somewhere else
    case 3: t = s.triangles.back(), s.triangles.pop_back(); break;     // a hole
    case 4: p = s.points[static_cast<std::size_t>(any_point())]; break;  // at the place of another point
    case 5:                                                            // near another point
      for (int k = 0; k < 3; ++k) p[k] = s.points[static_cast<std::size_t>(t[0])][k] * (1 + 1e-9 * random.uniform());
      break;
    case 6: {  // a cap: a point on the side of a triangle, or beside it by little
      const Point &a = s.points[static_cast<std::size_t>(t[0])], &b = s.points[static_cast<std::size_t>(t[1])];
      const double share = random.uniform(), beside = random.chance(0.5) ? 0 : random.power(-12, -2);
      Point q;
      for (int k = 0; k < 3; ++k) q[k] = a[k] + share * (b[k] - a[k]) + beside * random.uniform(-1, 1);
      const Triangle before = t;
      const std::int32_t m = s.add(q);
      s.triangles.push_back({before[0], m, before[2]}), s.triangles.push_back({m, before[1], before[2]});
      if (random.chance(0.7)) s.triangles.push_back({before[0], before[1], m});
      break;
    }
    case 7:
      for (double& x : p) x += random.uniform(-1, 1) * random.power(-6, 1);
      break;
    default: {  // an edge of three triangles
      const Triangle before = t;
      s.triangles.push_back({before[0], before[1], any_point()});
    }
  }
}

}  // namespace

Outcome run_triangles(std::uint64_t seed) {
  Random random(seed);
  Surface s;
  switch (random.below(4)) {
    case 0: s = soup(random); break;
    case 1: s = net(random); break;
    default: s = shells(random);
  }
  for (int n = random.chance(0.4) ? 0 : random.below(6); n > 0 && !s.triangles.empty(); --n) spoil(random, s);
  const double scale = random.chance(0.7) ? 1 : random.power(-6, 6), away = random.chance(0.8) ? 0 : random.power(0, 4);
  const bool single = random.chance(0.5);
  std::vector<double> xyz;
  double low[3] = {1e300, 1e300, 1e300}, high[3] = {-1e300, -1e300, -1e300};
  for (const Point& p : s.points)
    for (int k = 0; k < 3; ++k) {
      double x = scale * (p[k] + away);
      if (single) x = static_cast<float>(x);
      xyz.push_back(x), low[k] = std::min(low[k], x), high[k] = std::max(high[k], x);
    }
  std::vector<std::int32_t> corners, refs;
  for (const Triangle& t : s.triangles) {
    corners.insert(corners.end(), t.begin(), t.end());
    refs.push_back(1 + random.below(3));
  }
  carreau_triangles given = sized<carreau_triangles>();
  given.vertex_count = static_cast<std::int64_t>(s.points.size()), given.vertices = xyz.data();
  given.triangle_count = static_cast<std::int64_t>(s.triangles.size()), given.triangles = corners.data();
  if (random.chance(0.2)) given.triangle_refs = refs.data();
  carreau_triangles_options options = sized<carreau_triangles_options>();
  constexpr double angles[] = {0, 0, 5, 30, 80, 170};
  options.sharp_angle = angles[random.below(6)];
  const SessionHandle session;
  const carreau_status status = carreau_add_triangles(session, &options, &given);
  if (status != CARREAU_OK) return {Result::rejected, fault_of(session, status, "carreau_add_triangles")};
  carreau_triangles_report report = sized<carreau_triangles_report>();
  carreau_triangles_measure(session, &report);
  set_parameters(session, std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]), random);
  return mesh_and_check(session, report.border_edges == 0, random);
}

}  // namespace geometry_fuzz
