// SPDX-License-Identifier: BSD-3-Clause
// Rigid tools: polylines with rounded corners (HDR sec. 3.4.1, bound deformation).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "support/box_tree.h"
#include "support/infinity.h"
#include "support/vec.h"

namespace carreau::variable {

/// A polyline with the tool's solid on its left; closed ones run counterclockwise.
struct Tool {
  std::vector<Vec2> points;   ///< two or more, three or more if closed; the first is not repeated
  std::vector<double> radii;  ///< of the arcs that round the corners, 0: sharp; empty: all are
  bool closed = false;
};

/// A segment, or an arc of a circle, between abscissae of its tool.
struct ToolPart {
  std::int32_t tool = 0;
  Vec2 a, b;
  Vec2 centre;
  double radius = 0;                      ///< 0: a segment
  double start = 0, sweep = 0;            ///< of an arc: angle of a, and from there to b (negative: clockwise), radians
  double s = 0, length = 0;               ///< abscissa of a, length
  std::int32_t previous = -1, next = -1;  ///< parts; -1: an open end

  [[nodiscard]] Vec2 point(double along) const noexcept;
  /// Unit vector of travel.
  [[nodiscard]] Vec2 tangent(double along) const noexcept;
};

/// The nearest place of a tool.
struct ToolPlace {
  std::int32_t part = -1, tool = -1;
  double s = 0;  ///< abscissa on the tool
  Vec2 point;
  double distance = infinity;  ///< not negative
  bool in_solid = false;       ///< for the given point; not set if an open end is nearest
};

/// Some tools. Copies its arguments.
class Tools {
 public:
  Tools() = default;
  /// Throws InvalidArgument for too few points, repeated points, coordinates or radii that are not finite, a negative
  /// radius, a closed polyline that runs clockwise. Also for a radius that does not fit between the neighbours of its
  /// corner.
  explicit Tools(std::span<const Tool> tools);

  [[nodiscard]] bool empty() const noexcept { return parts_.empty(); }
  [[nodiscard]] std::size_t count() const noexcept { return tool_.size(); }
  /// Logarithmic in the number of parts. If places are equally near, returns the place of the lowest part.
  [[nodiscard]] ToolPlace nearest(const Vec2& p) const noexcept;
  [[nodiscard]] const ToolPart& part(std::int32_t index) const { return parts_[static_cast<std::size_t>(index)]; }
  [[nodiscard]] std::span<const ToolPart> parts() const noexcept { return parts_; }
  /// Ends of parts, and places on arcs between them every 15 degrees: the nodes of HDR sec. 3.4.2.
  [[nodiscard]] const std::vector<ToolPlace>& nodes() const noexcept { return nodes_; }

  /// Distance along the tool from abscissa p back to abscissa q: a boundary that has the tool on its right runs against
  /// it. Negative if the tool is open and q is ahead.
  [[nodiscard]] double way_back(std::int32_t tool, double p, double q) const noexcept;
  [[nodiscard]] ToolPlace at(std::int32_t tool, double s) const noexcept;
  /// Abscissae of sharp corners strictly between p and q, q a way back from p; in the order of that way, as distances.
  [[nodiscard]] std::vector<double> corners_back(std::int32_t tool, double p, double way) const;

 private:
  struct Extent {
    std::int32_t first = 0, last = 0;  // parts
    double length = 0;
    bool closed = false;
  };
  void add(const Tool& tool, std::int32_t index);
  void add_nodes();
  [[nodiscard]] bool is_in_solid(const ToolPlace& place, double along, const Vec2& p) const noexcept;

  std::vector<ToolPart> parts_;
  std::vector<Extent> tool_;
  std::vector<ToolPlace> nodes_;
  BoxTree tree_;
};

}  // namespace carreau::variable
