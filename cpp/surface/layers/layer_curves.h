// SPDX-License-Identifier: BSD-3-Clause
// The curves along which cells lie in rows, and the heights of the rows.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "curve/discrete_curve.h"
#include "mesh/layer_cell.h"
#include "mesh/plane_mesh.h"
#include "surface/layers/row_limits.h"

namespace carreau {

/// Rows of cells that grow from curves: the first row is `first` high, each other row `ratio` times as high as the row
/// below it. Rows end after `count`, or before they would be higher than the edges of the curve are long.
struct CurveLayers {
  std::vector<int> curves;  ///< references
  double first = 0;         ///< model length, > 0
  double ratio = 1.2;       ///< >= 1
  int count = 1;            ///< >= 1
};

/// Layers of a run, and their cells in its mesh by face: the halves of the cells are the last triangles of a face. Empty:
/// no face has layers.
struct MeshLayers {
  std::vector<CurveLayers> given;
  std::vector<std::vector<LayerCell>> cells = {};
};

/// The layers of a run, by curve of the topology.
class LayerCurves {
 public:
  LayerCurves() = default;
  /// Throws InvalidArgument if a reference names no curve on a face, or if layers name one curve twice.
  /// `halved`: cells will be cut in two each way, so rows are two rows high, and there are half as many (rounded up).
  /// `bent`: edges will get vertices or nodes on their curves.
  LayerCurves(const Model& model, const Topology& topology, std::span<const CurveLayers> layers, bool halved = false,
              bool bent = false);

  [[nodiscard]] bool empty() const noexcept { return layers_.empty(); }
  /// Index of the layers of a curve (index in Topology::curves), or -1.
  [[nodiscard]] int of_curve(int curve) const noexcept {
    return curve < 0 || of_curve_.empty() ? -1 : of_curve_[static_cast<std::size_t>(curve)];
  }
  /// Heights of the rows, lowest first, as long as they are at most `longest`. There is one row at least.
  [[nodiscard]] std::vector<double> heights(int layers, double longest) const;
  /// Limits of rows, in all faces.
  [[nodiscard]] const std::vector<RowLimit>& limits() const noexcept { return limits_; }
  void add_limit(const RowLimit& limit) { limits_.push_back(limit); }
  /// Finds the bulges of edges that will bend. The curves have their vertices.
  void find_bulges(const CurveModel& model, std::span<const DiscreteCurve> curves);
  /// The vector from the middle of an edge to its curve if the edge will bend, else zero.
  [[nodiscard]] Vec3 bulge(const PlaneEdge& edge) const {
    if (edge.curve < 0 || static_cast<std::size_t>(edge.curve) >= bulges_.size()) return {0, 0, 0};
    const std::vector<Vec3>& of = bulges_[static_cast<std::size_t>(edge.curve)];
    return static_cast<std::size_t>(edge.segment) < of.size() ? of[static_cast<std::size_t>(edge.segment)] : Vec3(0, 0, 0);
  }
  /// Share of the height of a row that its lower half has, when it is cut.
  [[nodiscard]] double lower_half(int layers) const noexcept {
    return 1 / (1 + std::sqrt(layers_[static_cast<std::size_t>(layers)].ratio));
  }

 private:
  std::vector<CurveLayers> layers_;
  std::vector<int> of_curve_;
  std::vector<RowLimit> limits_;
  bool bent_ = false;
  std::vector<std::vector<Vec3>> bulges_;  // by curve and segment
};

/// Moves vertices of curves that end at curves with layers: they lie at the heights of the rows.
void place_rows_on_sides(const LayerCurves& layers, const CurveModel& model, std::vector<DiscreteCurve>& curves);

}  // namespace carreau
