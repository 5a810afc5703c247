// SPDX-License-Identifier: BSD-3-Clause
// Sizes on the graph of the gradation: the same in all directions, or by direction. Private to this room.
#pragma once

#include <memory>
#include <vector>

#include "gradation/facing.h"
#include "surface/grade/grading_work.h"
#include "surface/sample/face_metric.h"

namespace carreau::detail {

/// Prescribed and graded sizes. Keeps a reference to the work. Several threads may call keep_sample() and keep_vertex().
class GraphSizes {
 public:
  explicit GraphSizes(GradingWork& work) : work_(work) {}
  virtual ~GraphSizes() = default;
  GraphSizes(const GraphSizes&) = delete;
  GraphSizes& operator=(const GraphSizes&) = delete;

  [[nodiscard]] virtual bool isotropic() const noexcept = 0;

  /// Appends a sample of a face, if its size is known.
  virtual void keep_sample(Vec2 uv, const SurfaceJet& jet, Metric2 metric,
                           std::vector<GradingWork::Sample>& samples) const = 0;
  /// Appends the size at the next vertex of a face.
  virtual void keep_vertex(FaceMetric& prescribed, Vec2 uv, const SurfaceJet& jet, Metric2 metric,
                           FaceInGraph& face) const = 0;
  /// Takes over the sizes at the vertices of a face; `first`: its first place.
  virtual void add_face(const FaceInGraph& made, std::size_t first) = 0;
  /// Turns the directions at a place into the tangent plane there.
  virtual void orient(std::size_t place) = 0;
  /// Adds a sample that lies `way` from a place.
  virtual void add_source(int place, const GradingWork::Sample& sample, const Vec3& way) = 0;
  /// Called when all faces are in the graph.
  virtual void complete() = 0;

  /// Bounds the size at a vertex across a gap.
  virtual void bound_across(int vertex, const Vec3& across, double h) = 0;
  [[nodiscard]] virtual double largest_at(int place) const = 0;
  /// Bounds the sizes at both ends of a gap between faces.
  virtual void bound_facing(const FacingPlace& facing, double h) = 0;

  virtual void grade(const std::vector<SizeSamples>& raw, double slope) = 0;
  /// Returns the graded size at a place along a unit vector.
  [[nodiscard]] virtual double along(int place, const Vec3& direction) const noexcept = 0;
  /// Hands the graded sizes of a face over to it, and marks where the prescribed sizes do not obey.
  virtual void give_to_face(std::size_t face) = 0;
  /// Returns the graded size along a curve at a node of the graph.
  [[nodiscard]] virtual double at_node(std::size_t curve, std::size_t node, const SizeSamples& raw) const = 0;
  /// Returns the graded size at a share `w` of the way to the next node: `h` is the interpolated size, `known` the size of
  /// the curve.
  [[nodiscard]] virtual double between_nodes(std::size_t curve, std::size_t node, double w, double h, double known,
                                             const GradedField& field) const = 0;

 protected:
  GradingWork& work_;
};

std::unique_ptr<GraphSizes> isotropic_graph_sizes(GradingWork& work);
std::unique_ptr<GraphSizes> directional_graph_sizes(GradingWork& work);

}  // namespace carreau::detail
