// SPDX-License-Identifier: BSD-3-Clause
// Vertices of sharp lines: their places on the curves of the host, and other possible places.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "curve/curve_model.h"
#include "curve/discrete_curve.h"
#include "surface/remesh/base/charts.h"
#include "surface/remesh/base/sharp_edges.h"

namespace carreau {

/// Places of one vertex of a line, one for each use of its curve; the first one has the position.
using KeptPlaces = std::vector<SurfacePlace>;

/// A place on a curve in its first use.
struct OnCurve {
  std::int32_t curve = 0;  ///< index in SurfaceMesh::curves
  int face = 0, ic = 0;    ///< as in the cad_m routines
  double t = 0;
};

/// A line, parametrised by its length in space.
class LineGeometry {
 public:
  virtual ~LineGeometry() = default;
  /// A line with known places of its vertices.
  [[nodiscard]] virtual bool is_known() const noexcept = 0;
  /// Arc lengths of the vertices of the line, from 0, ascending.
  [[nodiscard]] virtual const std::vector<double>& arcs() const noexcept = 0;
  /// A point of the line there, or no farther from it than the accuracy of the line's data.
  [[nodiscard]] virtual Vec3 near(double arc) const = 0;
  /// Places on the surfaces beside.
  [[nodiscard]] virtual KeptPlaces at(double arc) = 0;
  /// Places on curves of the host: two places where one curve ends and the next begins; empty without curves.
  [[nodiscard]] virtual std::vector<OnCurve> on_curves(double /*arc*/) const { return {}; }
};

/// A line of curves by its length in space, as the supports of its curves measure it. Keeps references to its arguments.
class LinePlaces final : public LineGeometry {
 public:
  /// `known`: the discrete curves by index in SurfaceMesh::curves.
  LinePlaces(const SharpLine& line, const SurfaceMesh& mesh, const CurveModel& model,
             std::span<const DiscreteCurve> known, const Charts& charts, Cad& cad);

  /// Returns whether the vertices of the line's curves have the places of the discrete curves.
  [[nodiscard]] bool is_known() const noexcept override { return arc_.size() == line_.vertices.size(); }
  [[nodiscard]] const std::vector<double>& arcs() const noexcept override { return arc_; }
  [[nodiscard]] std::vector<OnCurve> on_curves(double arc) const override;
  /// A point as near to the curve as its support; no evaluation.
  [[nodiscard]] Vec3 near(double arc) const override;
  /// Places on the curves: about four evaluations for each use.
  [[nodiscard]] KeptPlaces at(double arc) override;

 private:
  /// A part of the line: a whole curve, or some edges.
  struct Part {
    std::int32_t curve = 0;
    double from = 0, to = 0;            ///< of the line
    double curve_from = 0, curve_to = 0;  ///< of the curve, in the direction of its first use
    std::size_t first_edge = 0;         ///< of the line
  };
  [[nodiscard]] std::optional<std::size_t> rank_on(std::int32_t curve, std::int32_t v, std::int32_t other) const;
  void add_part(std::size_t first, std::size_t last);
  [[nodiscard]] const Part& part_at(double arc) const;
  [[nodiscard]] double curve_arc(const Part& part, double arc) const;
  [[nodiscard]] std::int32_t triangle_beside(double arc, std::int32_t face, const Vec2& uv) const;

  const SharpLine& line_;
  const SurfaceMesh& mesh_;
  const CurveModel& model_;
  std::span<const DiscreteCurve> known_;
  const Charts& charts_;
  Cad& cad_;
  std::vector<double> arc_;
  std::vector<Part> parts_;
};

}  // namespace carreau
