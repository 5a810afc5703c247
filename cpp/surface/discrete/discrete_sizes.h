// SPDX-License-Identifier: BSD-3-Clause
// Sizes of meshes of surfaces given as triangles.
#pragma once

#include <optional>
#include <vector>

#include "geometry/discrete/discrete_cad.h"
#include "geometry/discrete/refinement.h"
#include "gradation/metric_grading.h"
#include "surface/discrete/curvature_tensors.h"
#include "surface/remesh/base/tangent_metrics.h"
#include "surface/options.h"

namespace carreau {

/// Sizes at the vertices of a mesh of the surface.
struct MeshSizes {
  std::vector<double> h;            ///< at vertices; sqrt(h1 h2) where sizes differ by direction
  std::vector<Metric3> metric;      ///< at vertices, for all sides of sharp lines; empty: of no direction
  std::vector<PlaneMetric> corner;  ///< by triangle and corner, 3 t + k; empty: of no direction

  [[nodiscard]] bool by_direction() const noexcept { return !metric.empty(); }
  /// Length of the straight edge between two vertices.
  [[nodiscard]] double length(const discrete::RefinedMesh& mesh, std::int32_t v, std::int32_t w) const;
  /// sqrt(h1 h2) over a triangle, in the mean.
  [[nodiscard]] double over(const discrete::RefinedMesh& mesh, std::size_t triangle) const;
};

/// Computes sizes at the vertices of a mesh of the surface from size rules and curvature.
class DiscreteSizes {
 public:
  /// Keeps references. `cad`: the surface itself, or its wrapper.
  DiscreteSizes(const Model& model, Cad& cad, const discrete::DiscreteCad& surface, const CompositeOptions& options);

  /// Sizes at the vertices, with the gradation of the options over the mesh.
  [[nodiscard]] MeshSizes at_vertices(const discrete::RefinedMesh& mesh, Monitor& monitor) const;

 private:
  struct Sides;
  [[nodiscard]] double clamped_geometric(double h) const;
  [[nodiscard]] double largest_curvature(std::int32_t triangle, const Vec2& uv) const;
  [[nodiscard]] double isotropic_at(std::int32_t triangle, const Vec2& uv) const;
  [[nodiscard]] std::vector<int> face_of_triangles() const;
  [[nodiscard]] std::optional<TangentMetric> geometric_at(std::int32_t triangle, const Vec2& uv, const Vec3& p,
                                                          const Vec3& q) const;
  void keep_flat(std::int32_t triangle, const Vec2& uv, TangentMetric& sizes) const;
  [[nodiscard]] TangentMetric wanted_at(const SizeRules& rules, int face, std::int32_t triangle, const Vec2& uv) const;
  [[nodiscard]] std::vector<double> isotropic(const discrete::RefinedMesh& mesh, double prescribed) const;
  [[nodiscard]] MeshSizes by_direction(const discrete::RefinedMesh& mesh, const Sides& sides, GradationGraph graph,
                                       std::vector<TangentMetric> sizes, Monitor& monitor) const;

  const Model& model_;
  Cad& cad_;
  const discrete::DiscreteCad& surface_;
  const CompositeOptions& options_;
  GeometricRule rule_;
  std::vector<double> radius_;  // by corner of the surface's triangles: smallest radius of curvature
  std::optional<CurvatureTensors> curvature_;  // if geometric sizes differ by direction
};

}  // namespace carreau
