// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/differences.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "adapt/thresholds.h"
#include "metric/metric3_algebra.h"
#include "support/error.h"
#include "support/infinity.h"
#include "support/work_sizes.h"

namespace carreau {

namespace {

using namespace thresholds::adapt;

/// A mesh with the middles of its edges: each triangle becomes four.
struct Refined {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::array<std::int32_t, 2>> edges;  ///< of the coarse mesh; their middles follow its vertices
};

Refined refine(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles) {
  Refined fine;
  fine.vertices.assign(vertices.begin(), vertices.end());
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
  const auto middle = [&](std::int32_t a, std::int32_t b) {
    const auto [place, is_new] =
        middles.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(fine.vertices.size()));
    if (is_new) {
      fine.vertices.push_back(0.5 * (vertices[static_cast<std::size_t>(a)] + vertices[static_cast<std::size_t>(b)]));
      fine.edges.push_back({a, b});
    }
    return place->second;
  };
  for (const auto& t : triangles) {
    const std::int32_t p = middle(t[0], t[1]), q = middle(t[1], t[2]), r = middle(t[2], t[0]);
    fine.triangles.push_back({t[0], p, r});
    fine.triangles.push_back({p, t[1], q});
    fine.triangles.push_back({r, q, t[2]});
    fine.triangles.push_back({p, q, r});
  }
  return fine;
}

/// `share` of the shortest edge at each vertex.
std::vector<double> steps_of(std::span<const Vec3> vertices, std::span<const std::array<std::int32_t, 3>> triangles, double share) {
  Vec3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  for (const Vec3& p : vertices) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double diagonal = norm(high - low);
  std::vector<double> steps(vertices.size(), largest_step * diagonal);
  for (const auto& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = static_cast<std::size_t>(t[k]), b = static_cast<std::size_t>(t[(k + 1) % 3]);
      // Shorter steps would be lost in rounding.
      const double step = std::max(share * norm(vertices[b] - vertices[a]), largest_step * largest_step * diagonal);
      steps[a] = std::min(steps[a], step);
      steps[b] = std::min(steps[b], step);
    }
  return steps;
}

// Functions of the ranks, at every so many points.
void require_same_function(std::span<const Vec3> points, const FieldFunction& exact, const Executor& executor) {
  const auto sum_of_values = [&] {
    std::vector<Vec3> some;
    for (std::size_t i = 0; i < points.size(); i += work_sizes::places_of_one_compared) some.push_back(points[i]);
    std::vector<double> values(some.size());
    exact(some, values);
    LongChecksum sum;
    sum.add(some), sum.add(values);
    return sum.text();
  };
  executor.require_same<InvalidModel>("field", sum_of_values, [](int rank) {
    return "the field differs on rank " + std::to_string(rank) +
           " from rank 0: its callback differs, or its parameters do";
  });
}

double length_along(const VertexPrescriptions& p, std::size_t vertex, const Vec3& edge) {
  return p.metrics.empty() ? norm(edge) / p.sizes[vertex] : length(p.metrics[vertex], edge);
}

}  // namespace

std::vector<LocalDerivatives> difference_derivatives(std::span<const Vec3> points, std::span<const double> steps,
                                                     const FieldFunction& exact) {
  // Rows of 3 x 3 points about each point.
  std::vector<Vec3> stencil;
  stencil.reserve(9 * points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) stencil.push_back(points[i] + steps[i] * Vec3{double(x), double(y), 0});
  std::vector<double> f(stencil.size());
  exact(stencil, f);
  std::vector<LocalDerivatives> derivatives(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double* g = f.data() + 9 * i;
    for (std::size_t k = 0; k < 9; ++k) check_value(g[k], "at a point");
    const double h = steps[i], h2 = h * h;
    derivatives[i].gradient = {(g[5] - g[3]) / (2 * h), (g[7] - g[1]) / (2 * h)};
    derivatives[i].hessian = {(g[5] - 2 * g[4] + g[3]) / h2, (g[8] - g[6] - g[2] + g[0]) / (4 * h2),
                              (g[7] - 2 * g[4] + g[1]) / h2};
  }
  return derivatives;
}

FieldFunction shared_function(const FieldFunction& exact, const Executor& executor, Monitor& monitor) {
  if (executor.is_alone()) return exact;
  return [&exact, executor, &monitor](std::span<const Vec3> points, std::span<double> values) {
    require_same_function(points, exact, executor);
    const auto ask = [&](std::size_t first, std::size_t last, double* out, Monitor&) {
      exact(points.subspan(first, last - first), {out, last - first});
    };
    const std::size_t n = points.size();
    const std::vector<double> all = shared_rows(
        executor, "values of a field", {.count = n, .at_once = work_sizes::piece_of(n), .bound = true}, ask, monitor);
    std::ranges::copy(all, values.begin());
  };
}

double estimated_error(const ScalarField& field, const FieldFunction& exact, const EstimatorOptions& options) {
  check_field(field);
  return estimated_error(field, difference_derivatives(field.vertices, steps_of(field.vertices, field.triangles, 0.25), exact), options);
}

VertexPrescriptions estimate_function(std::span<const Vec3> vertices,
                                      std::span<const std::array<std::int32_t, 3>> triangles,
                                      const FieldFunction& exact, const EstimatorOptions& options, const Executor& executor,
                                      Monitor* monitor) {
  for (const Vec3& p : vertices)
    if (p.z() != 0)
      throw InvalidArgument("a field is estimated by its own derivatives on meshes of the plane z = 0 only");
  const Refined fine = refine(vertices, triangles);
  std::vector<double> values(fine.vertices.size());
  exact(fine.vertices, values);
  const VertexPrescriptions all = estimate({fine.vertices, fine.triangles, values},
                                           difference_derivatives(fine.vertices, steps_of(fine.vertices, fine.triangles, 0.5), exact), options, executor,
                                           monitor);
  VertexPrescriptions result = all;
  for (std::size_t e = 0; e < fine.edges.size(); ++e) {
    const std::size_t ends[2] = {static_cast<std::size_t>(fine.edges[e][0]),
                                 static_cast<std::size_t>(fine.edges[e][1])};
    const std::size_t middle = vertices.size() + e;
    const Vec3 edge = vertices[ends[1]] - vertices[ends[0]];
    const double seen = std::max(length_along(all, ends[0], edge), length_along(all, ends[1], edge));
    if (length_along(all, middle, edge) <= blind * seen) continue;
    for (const std::size_t end : ends) {
      if (all.metrics.empty())
        result.sizes[end] = std::min(result.sizes[end], all.sizes[middle]);
      else
        result.metrics[end] = intersection(result.metrics[end], all.metrics[middle]);
    }
  }
  if (!result.sizes.empty()) result.sizes.resize(vertices.size());
  if (!result.metrics.empty()) result.metrics.resize(vertices.size());
  return result;
}

}  // namespace carreau
