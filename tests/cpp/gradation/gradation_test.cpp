// SPDX-License-Identifier: BSD-3-Clause
// Cones of the gradation: plane, sphere, seam, crease, joined patches; bounds, order, bad input.
#include "gradation/gradation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <tuple>

#include "control_space/sample_gradation.h"
#include "gradation/graded_field.h"
#include "gradation/metric_grading.h"
#include "gradation/place_fans.h"
#include "plane/plane_mesher.h"
#include "support/error.h"
#include "support/infinity.h"

namespace carreau {
namespace {

using std::numbers::pi;
constexpr double unknown = infinity;
using Map = std::function<Vec3(Vec2)>;

// A polygon with `n` edges a side, meshed with unit edges of a field of sizes in the plane.
PlaneMesh meshed(const std::vector<Vec2>& corners, const std::vector<int>& n, const std::function<double(Vec2)>& size) {
  PlaneDomain domain;
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (int k = 0; k < n[i]; ++k)
      domain.vertices.push_back(lerp(corners[i], corners[(i + 1) % corners.size()], static_cast<double>(k) / n[i]));
  const int m = static_cast<int>(domain.vertices.size());
  SampledDomain sampled{domain.vertices, {}};
  for (int i = 0; i < m; ++i) {
    domain.edges.push_back({i, (i + 1) % m});
    sampled.edges.emplace_back(i, (i + 1) % m);
  }
  Monitor monitor;
  const MetricSampler sampler = [&](std::span<const Vec2> uv, std::span<Metric2> metric) {
    for (std::size_t i = 0; i < uv.size(); ++i) metric[i] = induced_metric({1, 0, 0}, {0, 1, 0}, size(uv[i]));
  };
  return mesh_plane(domain, ControlSpace::build(sampled, sampler, {}, monitor), {}, monitor);
}

PlaneMesh rectangle(double a, double b, double h) {
  const int m = std::max(1, static_cast<int>(std::lround(a / h))),
            n = std::max(1, static_cast<int>(std::lround(b / h)));
  return meshed({{0, 0}, {a, 0}, {a, b}, {0, b}}, {m, n, m, n}, [h](Vec2) { return h; });
}

// Adds a patch; vertices at one position in space are one.
class Builder {
 public:
  void add(const PlaneMesh& mesh, const Map& map, double turned = 1) {
    const int first = static_cast<int>(graph.places.size());
    for (const Vec2& p : mesh.vertices) {
      const Vec3 x = map(p);
      const auto key = std::tuple{std::llround(x.x() * 1e7), std::llround(x.y() * 1e7), std::llround(x.z() * 1e7)};
      const auto [at, fresh] = vertex_at_.emplace(key, static_cast<int>(graph.xyz.size()));
      if (fresh) graph.xyz.push_back(x);
      constexpr double d = 1e-5;
      const Vec3 su = map({p.x() + d, p.y()}) - map({p.x() - d, p.y()}),
                 sv = map({p.x(), p.y() + d}) - map({p.x(), p.y() - d});
      const Vec3 n = cross(su, sv);
      graph.places.push_back({at->second, (turned / norm(n)) * n});
    }
    for (const auto& t : mesh.triangles) graph.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  [[nodiscard]] int nearest(Vec3 p) const {
    return static_cast<int>(std::min_element(graph.xyz.begin(), graph.xyz.end(),
                                             [&](Vec3 a, Vec3 b) { return norm(a - p) < norm(b - p); }) -
                            graph.xyz.begin());
  }
  GradationGraph graph;

 private:
  std::map<std::tuple<long long, long long, long long>, int> vertex_at_;
};

/// The result of grade_fronts at a vertex.
struct GradedSize {
  double h;
  Vec3 slope;  // derivative of h in the tangent plane of the vertex's first place
};

std::vector<GradedSize> grade_sizes(const GradationGraph& graph, const std::vector<double>& h, double slope,
                                    Monitor& monitor) {
  const GradationFronts fronts = grade_fronts(graph, h, {}, slope, monitor);
  std::vector<GradedSize> sizes;
  for (const double size : fronts.h) sizes.push_back({size, {}});
  for (std::size_t p = graph.places.size(); p-- > 0;) {
    const Vec3& line = fronts.front[p].line;
    const double length = norm(line);
    sizes[graph.places[p].vertex].slope = length > 0 ? Vec3((slope / length) * line) : Vec3{};
  }
  return sizes;
}

// Largest relative error of the graded sizes of one source against h0 + slope * distance.
double cone_error(const GradationGraph& graph, int source, double h0, double slope,
                  const std::function<double(Vec3)>& distance) {
  std::vector<double> h(graph.xyz.size(), unknown);
  h[source] = h0;
  Monitor monitor;
  const auto graded = grade_sizes(graph, h, slope, monitor);
  double worst = 0;
  for (std::size_t v = 0; v < graded.size(); ++v) {
    const double exact = h0 + slope * distance(graph.xyz[v]);
    worst = std::max(worst, std::abs(graded[v].h / exact - 1));
  }
  return worst;
}

TEST(Gradation, LinearLawIsTheCorrectionOfBorouchakiHechtAndFrey) {
  // (q / p)^(1 / l) with l the unit length between sizes p and q under the linear law.
  for (const double beta : {1.1, 1.3, 2.}) {
    const double p = 0.3, d = 0.7, q = p + slope_of_gradation(beta) * d;
    const double l = d * std::log(q / p) / (q - p);
    EXPECT_NEAR(std::pow(q / p, 1 / l), beta, 1e-12);
  }
}

TEST(Gradation, ConeOnAPlane) {
  const Map plane = [](Vec2 p) { return Vec3{p.x(), p.y(), 0}; };
  for (const double h : {0.1, 0.03}) {
    Builder b;
    b.add(rectangle(1, 1, h), plane);
    for (const Vec3& at : {Vec3{0, 0, 0}, Vec3{0.5, 0.5, 0}, Vec3{0.3, 1, 0}}) {
      const int source = b.nearest(at);
      const Vec3 s = b.graph.xyz[source];
      EXPECT_LT(cone_error(b.graph, source, 1e-3, std::log(1.3), [&](Vec3 x) { return norm(x - s); }), 0.002);
    }
  }
}

TEST(Gradation, ConeOnATriangulationOfVaryingSize) {
  Builder b;
  b.add(meshed({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {20, 20, 20, 20},
               [](Vec2 p) {
                 return 0.01 + 0.1 * norm(p - Vec2{0.3, 0.4});
               }),
        [](Vec2 p) {
          return Vec3{p.x(), p.y(), 0};
        });
  const int source = b.nearest({0.3, 0.4, 0});
  const Vec3 s = b.graph.xyz[source];
  EXPECT_LT(cone_error(b.graph, source, 0.01, std::log(2.), [&](Vec3 x) { return norm(x - s); }), 0.01);
}

TEST(Gradation, RidgeBetweenTwoSourcesAndPlaneWaveFromALine) {
  Builder b;
  b.add(rectangle(1, 1, 0.04), [](Vec2 p) { return Vec3{p.x(), p.y(), 0}; });
  Monitor monitor;
  // A side of the square and its opposite corner.
  std::vector<double> h(b.graph.xyz.size(), unknown);
  for (std::size_t v = 0; v < h.size(); ++v)
    if (b.graph.xyz[v].x() == 0) h[v] = 0.02 + 0.1 * b.graph.xyz[v].y();
  const int corner = b.nearest({1, 1, 0});
  h[corner] = 0.03;
  const double slope = std::log(1.3), climb = 0.1 / slope;
  const auto graded = grade_sizes(b.graph, h, slope, monitor);
  for (std::size_t v = 0; v < h.size(); ++v) {
    const Vec3 x = b.graph.xyz[v];
    // The plane wave of the side leaves it at the angle whose cosine along the side is 0.1 / slope.
    const double foot = std::clamp(x.y() - x.x() * climb / std::sqrt(1 - climb * climb), 0., 1.);
    const double from_side = 0.02 + 0.1 * foot + slope * norm(x - Vec3{0, foot, 0});
    const double exact = std::min(from_side, 0.03 + slope * norm(x - Vec3{1, 1, 0}));
    EXPECT_NEAR(graded[v].h / exact, 1, 0.02) << x.x() << ' ' << x.y();
  }
}

TEST(Gradation, ConeAcrossTheSeamOfACylinder) {
  Builder b;
  b.add(rectangle(2 * pi, 3, 0.15), [](Vec2 p) { return Vec3{std::cos(p.x()), std::sin(p.x()), p.y()}; });
  const int source = b.nearest({std::cos(0.4), std::sin(0.4), 1.2});
  const Vec3 s = b.graph.xyz[source];
  const double turn = std::atan2(s.y(), s.x());
  EXPECT_LT(cone_error(b.graph, source, 0.01, std::log(1.3),
                       [&](Vec3 x) {
                         return std::hypot(std::remainder(std::atan2(x.y(), x.x()) - turn, 2 * pi), x.z() - s.z());
                       }),
            0.02);
}

TEST(Gradation, ConeAcrossACreaseWhateverTheSidesOfTheFaces) {
  // Unfolded, two squares at an angle of the crease x = 1 are the rectangle [0, 2] x [0, 1].
  for (const double angle : {0.5, pi / 2, 2.5})
    for (const double turned : {1., -1.}) {
      Builder b;
      const PlaneMesh square = rectangle(1, 1, 0.07);
      b.add(square, [](Vec2 p) { return Vec3{p.x(), p.y(), 0}; });
      b.add(
          square,
          [angle](Vec2 p) {
            return Vec3{1 + p.x() * std::cos(angle), p.y(), p.x() * std::sin(angle)};
          },
          turned);
      const int source = b.nearest({0.6, 0.2, 0});
      const Vec3 s = b.graph.xyz[source];
      EXPECT_LT(cone_error(b.graph, source, 0.01, std::log(1.3),
                           [&](Vec3 x) {
                             const double beyond = std::hypot(x.x() - 1, x.z());
                             const bool second = x.z() > 1e-9;
                             return std::hypot((second ? 1 + beyond : x.x()) - s.x(), x.y() - s.y());
                           }),
                0.02)
          << angle << ' ' << turned;
    }
}

TEST(Gradation, ConeOnASphereOfTwoPatches) {
  // Hemispheres by stereographic projection, joined along the equator.
  for (const double h : {0.15, 0.06}) {
    std::vector<Vec2> disc;
    const int n = static_cast<int>(2 * pi / h);
    for (int k = 0; k < n; ++k) disc.push_back({std::cos(2 * pi * k / n), std::sin(2 * pi * k / n)});
    const PlaneMesh mesh = meshed(disc, std::vector<int>(n, 1), [h](Vec2 p) { return h * (1 + dot(p, p)) / 2; });
    Builder b;
    for (const double side : {1., -1.})
      b.add(mesh, [side](Vec2 p) {
        const double k = 2 / (1 + dot(p, p));
        return Vec3{k * p.x(), k * p.y(), side * (k - 1)};
      });
    for (const Vec3& at : {Vec3{0, 0, 1}, Vec3{0.8, 0, 0.6}, Vec3{0, 1, 0}}) {
      const int source = b.nearest(at);
      const Vec3 s = b.graph.xyz[source];
      EXPECT_LT(cone_error(b.graph, source, 0.01, std::log(1.3),
                           [&](Vec3 x) { return 2 * std::asin(std::min(1., norm(x - s) / 2)); }),
                0.02)
          << h << ' ' << at.x() << ' ' << at.z();
    }
  }
}

TEST(Gradation, PathsGoAroundAHole) {
  // A wall from (0, 0.5) to (0.8, 0.5): the way leads around its end.
  Builder b;
  b.add(meshed({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0.52}, {0.8, 0.52}, {0.8, 0.48}, {0, 0.48}},
               {20, 20, 20, 10, 16, 1, 16, 10}, [](Vec2) { return 0.05; }),
        [](Vec2 p) {
          return Vec3{p.x(), p.y(), 0};
        });
  std::vector<double> h(b.graph.xyz.size(), unknown);
  const int source = b.nearest({0, 0, 0}), target = b.nearest({0, 1, 0});
  h[source] = 0.01;
  Monitor monitor;
  const auto graded = grade_sizes(b.graph, h, 1, monitor);
  const double exact = 0.01 + std::hypot(0.8, 0.48) * 2 + 0.04;
  EXPECT_NEAR(graded[target].h / exact, 1, 0.05);
}

TEST(Gradation, NeverRaisesASizeAndBoundsEveryEdge) {
  Builder b;
  b.add(rectangle(1, 1, 0.03), [](Vec2 p) { return Vec3{p.x(), p.y(), 0.3 * std::sin(4 * p.x()) * p.y()}; });
  std::vector<double> h(b.graph.xyz.size());
  std::uint64_t state = 12345;
  for (double& x : h) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    x = 0.01 + 0.2 * static_cast<double>(state >> 40) / static_cast<double>(1 << 24);
  }
  Monitor monitor;
  for (const double beta : {1.1, 1.3, 2.}) {
    const double slope = slope_of_gradation(beta);
    const auto graded = grade_sizes(b.graph, h, slope, monitor);
    double steepest = 0, longest = 0;
    for (std::size_t v = 0; v < h.size(); ++v) EXPECT_LE(graded[v].h, h[v]);
    for (const auto& t : b.graph.triangles)
      for (int i = 0; i < 3; ++i) {
        const int p = t[i], q = t[(i + 1) % 3];
        longest = std::max(longest, norm(b.graph.xyz[p] - b.graph.xyz[q]));
        steepest = std::max(steepest, std::abs(graded[p].h - graded[q].h) / norm(b.graph.xyz[p] - b.graph.xyz[q]));
      }
    EXPECT_LE(steepest, 1.01 * slope);
    // Grading again changes nothing but ridges: the field that is linear in triangles is lower between two slopes than
    // they are. The difference is at most 1 - sqrt(3) / 2 = 0.134 of its rise along an equilateral edge.
    std::vector<double> once(h.size());
    for (std::size_t v = 0; v < h.size(); ++v) once[v] = graded[v].h;
    const auto twice = grade_sizes(b.graph, once, slope, monitor);
    for (std::size_t v = 0; v < h.size(); ++v) {
      EXPECT_LE(twice[v].h, once[v]);
      EXPECT_GE(twice[v].h, once[v] - 0.134 * slope * longest);
    }
  }
}

// Sizes along edges, from both ends: a size that is lowered by next to nothing while it waits also passes to its
// neighbours.
TEST(Gradation, NoEdgeIsSteeperByDirection) {
  Builder b;
  b.add(rectangle(1, 1, 0.03), [](Vec2 p) { return Vec3{p.x(), p.y(), 0.3 * std::sin(4 * p.x()) * p.y()}; });
  std::uint64_t state = 12345;
  const auto random = [&state] {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state >> 40) / static_cast<double>(1 << 24);
  };
  std::vector<TangentMetric> sizes;
  for (const GradationGraph::Place& p : b.graph.places) {
    const Vec3 t = cross(p.normal, {0, 1, 0}), e = (1 / norm(t)) * t, f = cross(p.normal, e);
    const double turn = pi * random();
    sizes.push_back({std::cos(turn) * e + std::sin(turn) * f, std::cos(turn) * f - std::sin(turn) * e,
                     0.01 + 0.2 * random(), 0.01 + 0.2 * random()});
  }
  Monitor monitor;
  for (const double beta : {1.1, 1.3, 2.}) {
    const double slope = slope_of_gradation(beta);
    const auto graded = grade_metrics(b.graph, sizes, {}, slope, monitor);
    double steepest = 0;
    for (const auto& t : b.graph.triangles)
      for (int i = 0; i < 3; ++i)
        for (const auto& [p, q] : {std::pair{t[i], t[(i + 1) % 3]}, std::pair{t[(i + 1) % 3], t[i]}}) {
          const Vec3 way = step_on_surface(b.graph.places[p].normal, b.graph.xyz[q] - b.graph.xyz[p]);
          const double l = norm(way);
          const Vec3 e = (1 / l) * way, there = detail::roll(e, b.graph.places[p].normal, b.graph.places[q].normal);
          steepest = std::max(steepest, (graded[q].along(there) - graded[p].along(e)) / l);
        }
    EXPECT_LE(steepest, 1.02 * slope);
  }
}

// A strip whose lower side has one vertex of a small size. Amid the edge above it, whose ends are far, sizes are
// bounded by the gradation from that vertex.
TEST(Gradation, HoldsByDirectionAcrossAStrip) {
  constexpr double width = 0.1, slope = 0.25;
  Builder b;
  GradedFace face;
  for (const double y : {0., width})
    for (int i = 0; i < 6; ++i) face.uv.push_back({2. * i + (y > 0 ? 1 : 0), y});
  for (std::int32_t i = 0; i < 5; ++i)
    face.triangles.insert(face.triangles.end(), {{i, i + 1, i + 6}, {i + 1, i + 7, i + 6}});
  Monitor monitor;
  b.add({face.uv, face.triangles}, [](Vec2 p) { return Vec3{p.x(), p.y(), 0}; });
  face.xyz = b.graph.xyz;
  std::vector<TangentMetric> sizes(12, {{1, 0, 0}, {0, 1, 0}, 4, 4});
  sizes[3].h1 = 1, sizes[3].h2 = 1;
  face.metric = grade_metrics(b.graph, sizes, {}, slope, monitor);
  face.normal.assign(12, {0, 0, 1});
  face.smooth.assign(10, 0);
  face.on_curve.assign(10, 0);
  face.tree = TriangleTree(face.uv, face.triangles, monitor);
  const GradedField field(slope, {face});
  for (double x = 5; x <= 7; x += 0.125) {
    const TangentMetric there = field.sizes(0, {x, width}, {x, width, 0}, {{1, 0, 0}, {0, 1, 0}, 4, 4});
    EXPECT_LE(std::max(there.h1, there.h2), 1 + slope * std::hypot(x - 6, width) + 1e-12) << x;
    EXPECT_GE(std::min(there.h1, there.h2), 1 + 0.98 * slope * std::hypot(x - 6, width)) << x;
  }
}

TEST(Gradation, DoesNotDependOnTheOrderOfTriangles) {
  Builder b;
  b.add(rectangle(1, 1, 0.05), [](Vec2 p) { return Vec3{p.x(), p.y(), 0}; });
  std::vector<double> h(b.graph.xyz.size());
  for (std::size_t v = 0; v < h.size(); ++v) h[v] = 0.01 + 0.5 * std::abs(std::sin(40. * static_cast<double>(v * v)));
  Monitor monitor;
  const auto before = grade_sizes(b.graph, h, 0.2, monitor);
  GradationGraph other = b.graph;
  std::reverse(other.triangles.begin(), other.triangles.end());
  for (auto& t : other.triangles) std::rotate(t.begin(), t.begin() + 1, t.end());
  const auto after = grade_sizes(other, h, 0.2, monitor);
  for (std::size_t v = 0; v < h.size(); ++v) EXPECT_NEAR(after[v].h / before[v].h, 1, 1e-3);
}

TEST(Gradation, CurvesWithoutTrianglesCarrySizes) {
  GradationGraph graph;
  for (int i = 0; i <= 10; ++i) graph.xyz.push_back({0.1 * i, 0, 0});
  for (int i = 0; i < 10; ++i) graph.segments.push_back({i, i + 1});
  std::vector<double> h(11, 1);
  h[3] = 0.05;
  Monitor monitor;
  const auto graded = grade_sizes(graph, h, 0.5, monitor);
  for (int i = 0; i <= 10; ++i) EXPECT_NEAR(graded[i].h, 0.05 + 0.05 * std::abs(i - 3), 1e-12);
}

TEST(Gradation, RejectsMeaninglessInput) {
  Monitor monitor;
  EXPECT_THROW(slope_of_gradation(1), InvalidArgument);
  EXPECT_THROW(slope_of_gradation(0.9), InvalidArgument);
  EXPECT_THROW(slope_of_gradation(std::nan("")), InvalidArgument);
  GradationGraph graph;
  graph.xyz = {{0, 0, 0}};
  EXPECT_THROW(grade_sizes(graph, {}, 0.2, monitor), InvalidArgument);
  EXPECT_THROW(grade_sizes(graph, {-1}, 0.2, monitor), InvalidArgument);
  EXPECT_THROW(grade_sizes(graph, {1}, 0, monitor), InvalidArgument);
  graph.segments = {{0, 1}};
  EXPECT_THROW(grade_sizes(graph, {1}, 0.2, monitor), InvalidArgument);
}

// A sheared grid, two triangles a square; sizes by `h` of the place in space.
SampledField sheared_grid(const std::function<double(Vec2)>& h) {
  constexpr int n = 20;
  SampledField field;
  // x = u + v / 2, y = 2 v
  const Metric2 form{1, 0.5, 4.25};
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const Vec2 uv{1.0 * i / n, 1.0 * j / n};
      const double size = h({uv.x() + 0.5 * uv.y(), 2 * uv.y()});
      field.samples.push_back({uv, (1 / (size * size)) * form, form});
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int k = j * (n + 1) + i;
      field.triangles.push_back({k, k + 1, k + n + 2});
      field.triangles.push_back({k, k + n + 2, k + n + 1});
    }
  return field;
}

double size_of(const SampledField::Sample& s) { return std::sqrt(s.form.a / s.metric.a); }
Vec2 place_of(const SampledField::Sample& s) { return {s.uv.x() + 0.5 * s.uv.y(), 2 * s.uv.y()}; }

TEST(BoundSlopes, NoPairIsSteeperAndNothingIsSmallerThanItMustBe) {
  // Two small places: cones that meet in a ridge.
  constexpr double slope = 0.3;
  const Vec2 one{0, 0}, two{1.5, 2};
  SampledField field = sheared_grid([&](Vec2 x) { return x == one || x == two ? 0.01 : 10; });
  Monitor monitor;
  const auto changed = bound_slopes(field, slope, monitor);
  EXPECT_EQ(changed.size(), field.samples.size() - 2);
  double steepest = 0;
  for (const auto& a : field.samples)
    for (const auto& b : field.samples)
      if (const double d = norm(place_of(a) - place_of(b)); d > 0)
        steepest = std::max(steepest, (size_of(b) - size_of(a)) / d);
  EXPECT_LE(steepest, 1.06 * slope) << "straight fronts are exact, those of points late";
  for (const auto& s : field.samples) {
    const double d = std::min(norm(place_of(s) - one), norm(place_of(s) - two));
    EXPECT_GE(size_of(s), (1 - 1e-6) * (0.01 + slope * d) - 0.1 * slope * 0.11)
        << "ridges are cut, by a tenth of a side";
    EXPECT_LE(size_of(s), 0.01 + slope * 1.1 * d + 1e-9) << "fronts of triangles are late";
  }
}

TEST(BoundSlopes, GentleSizesStay) {
  SampledField field = sheared_grid([](Vec2 x) { return 0.05 + 0.3 * norm(x); });
  Monitor monitor;
  EXPECT_TRUE(bound_slopes(field, 0.3 + 1e-9, monitor).empty()) << "a cone is convex";
}

TEST(BoundSlopes, LinksBoundSizesThatNoTriangleBounds) {
  SampledField field;
  field.samples = {{{0, 0}, {100, 0, 100}, {1, 0, 1}}, {{1, 0}, {1, 0, 1}, {1, 0, 1}}, {{3, 0}, {1, 0, 1}, {1, 0, 1}}};
  field.links = {{0, 1}, {2, 1}};
  Monitor monitor;
  EXPECT_EQ(bound_slopes(field, 0.2, monitor), (std::vector<std::int32_t>{1, 2}));
  EXPECT_NEAR(size_of(field.samples[1]), 0.3, 1e-12);
  EXPECT_NEAR(size_of(field.samples[2]), 0.7, 1e-12);
}

// The sheared grid with sizes by direction of space: `sizes(x)` are those along x and along y, turned by `angle(x)`.
SampledField directed_grid(const std::function<Vec2(Vec2)>& sizes, const std::function<double(Vec2)>& angle) {
  SampledField field = sheared_grid([](Vec2) { return 1; });
  for (auto& s : field.samples) {
    const Vec2 x = place_of(s), h = sizes(x);
    const double c = std::cos(angle(x)), t = std::sin(angle(x));
    const TangentMetric m{{c, t, 0}, {-t, c, 0}, h.x(), h.y()};
    SurfaceJet jet;
    jet.su = {1, 0, 0}, jet.sv = {0.5, 2, 0};
    s.metric = metric_of(jet, m);
    s.tangents = {jet.su, jet.sv};
  }
  return field;
}
TangentMetric sizes_at(const SampledField::Sample& s) {
  SurfaceJet jet;
  jet.su = {1, 0, 0}, jet.sv = {0.5, 2, 0};
  return *tangent_metric(jet, s.metric);
}

TEST(BoundSlopesByDirection, ALayerGrowsInBothDirectionsByItsOwnMetric) {
  constexpr double slope = 0.3, across = 0.05, along = 0.2;
  SampledField field = directed_grid(
      [=](Vec2 x) {
        return x.y() < 1e-9 ? Vec2{along, across} : Vec2{10, 10};
      },
      [](Vec2) { return 0; });
  Monitor monitor;
  bound_slopes_by_direction(field, slope, monitor);
  for (const auto& s : field.samples) {
    const double h = across + slope * place_of(s).y();
    const TangentMetric m = sizes_at(s);
    EXPECT_NEAR(m.along({0, 1, 0}) / h, 1, 0.02) << place_of(s).y();
    EXPECT_NEAR(m.along({1, 0, 0}) / (along / across * h), 1, 0.02) << place_of(s).y();
  }
}

TEST(BoundSlopesByDirection, GentleSizesStay) {
  const auto growing = [](Vec2 x) -> Vec2 { return (1 + 6 * x.y()) * Vec2{0.2, 0.05}; };
  SampledField field = directed_grid(growing, [](Vec2) { return 0; });
  const SampledField before = field;
  Monitor monitor;
  EXPECT_TRUE(bound_slopes_by_direction(field, 0.3, monitor).empty()) << "sizes across are .05 + .3 y";
  for (std::size_t k = 0; k < field.samples.size(); ++k) EXPECT_EQ(field.samples[k].metric, before.samples[k].metric);
}

// Samples that turn by any angle from one to the next do not shrink each other without end.
TEST(BoundSlopesByDirection, NoSizeIsSmallerThanTheSmallestAndDirectionsStay) {
  const auto wild = [](Vec2 x) { return 1e3 * std::sin(1e3 * (x.x() + 3 * x.y())); };
  SampledField field = directed_grid([&](Vec2 x) { return Vec2{0.02 + 0.001 * std::abs(wild(x)), 0.9}; }, wild);
  const SampledField before = field;
  double smallest = 1;
  for (const auto& s : before.samples) smallest = std::min(smallest, sizes_at(s).h1);
  Monitor monitor;
  EXPECT_FALSE(bound_slopes_by_direction(field, 0.1, monitor).empty());
  for (std::size_t k = 0; k < field.samples.size(); ++k) {
    const TangentMetric was = sizes_at(before.samples[k]), is = sizes_at(field.samples[k]);
    EXPECT_GE(std::min(is.h1, is.h2), (1 - 1e-9) * smallest);
    EXPECT_LE(is.along(was.d1), (1 + 1e-9) * was.h1);
    EXPECT_LE(is.along(was.d2), (1 + 1e-9) * was.h2);
    if (is.h2 > 1.001 * is.h1) {
      EXPECT_NEAR(std::abs(dot(is.d1, was.d1)) * std::abs(dot(is.d1, was.d2)), 0, 1e-6);
    }
  }
  EXPECT_TRUE(bound_slopes_by_direction(field, 0.1, monitor).empty()) << "a second time nothing changes";
}

// A strip of 1 x 2 in two halves: the second one lies elsewhere, turned by the map, and the vertices between them are joined. Its
// metrics are the metrics of the whole strip, turned.
TEST(MetricGrading, CrossesJoinedVerticesByTheirMap) {
  constexpr int n = 10;
  Isometry map;
  map.row = {Vec3(0, -1, 0), Vec3(0.6, 0, -0.8), Vec3(0.8, 0, 0.6)};
  map.shift = {5, 6, 7};
  const auto strip = [&](int columns, int first, const Isometry& by, GradationGraph& graph) {
    const int begin = static_cast<int>(graph.xyz.size());
    for (int i = 0; i <= columns; ++i)
      for (int k = 0; k <= n; ++k) {
        graph.places.push_back({static_cast<int>(graph.xyz.size()), by.turn({0, 0, 1})});
        graph.xyz.push_back(by({static_cast<double>(first + i) / n, static_cast<double>(k) / n, 0}));
      }
    for (int i = 0; i < columns; ++i)
      for (int k = 0; k < n; ++k) {
        const int a = begin + i * (n + 1) + k, b = a + n + 1;
        graph.triangles.push_back({a, b, b + 1});
        graph.triangles.push_back({a, b + 1, a + 1});
      }
  };
  GradationGraph whole, halves;
  strip(2 * n, 0, {}, whole);
  strip(n, 0, {}, halves);
  strip(n, n, map, halves);
  for (int k = 0; k <= n; ++k) {
    halves.joined.push_back({n * (n + 1) + k, (n + 1) * (n + 1) + k});
    halves.joined_by.push_back(map);
  }
  const double angle = 0.3;
  const auto graded = [&](const GradationGraph& graph) {
    std::vector<TangentMetric> sizes;
    for (std::size_t p = 0; p < graph.places.size(); ++p) {
      const bool second = p >= static_cast<std::size_t>((n + 1) * (n + 1)) && graph.joined.size() > 0;
      const Vec3 d1(std::cos(angle), std::sin(angle), 0), d2(-std::sin(angle), std::cos(angle), 0);
      TangentMetric metric{second ? map.turn(d1) : d1, second ? map.turn(d2) : d2, 3, 3};
      if (p == 5 * (n + 1) + 5) metric.h1 = 0.1, metric.h2 = 0.5;  // at (.5, .5)
      sizes.push_back(metric);
    }
    Monitor monitor;
    return grade_metrics(graph, sizes, {}, 0.2, monitor);
  };
  const std::vector<TangentMetric> one = graded(whole), two = graded(halves);
  for (int i = 0; i <= n; ++i)
    for (int k = 0; k <= n; ++k) {
      const TangentMetric &p = one[(n + i) * (n + 1) + k], &q = two[(n + 1) * (n + 1) + i * (n + 1) + k];
      EXPECT_LT(q.h1, 2.9);
      EXPECT_NEAR(q.h1, p.h1, 0.03 * p.h1);
      EXPECT_NEAR(q.h2, p.h2, 0.03 * p.h2);
    }
}

}  // namespace
}  // namespace carreau
