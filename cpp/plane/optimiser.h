// Swaps and moves that make triangles equilateral in the metric, and degrees six.
#pragma once

#include <cstdint>
#include <vector>

#include "plane/triangulation.h"
#include "size/control_space.h"
#include "support/monitor.h"

namespace carreau::plane {

/// Never moves the first `imposed` vertices, never touches imposed edges, never turns a triangle over.
class Optimiser {
 public:
  Optimiser(Triangulation& mesh, int imposed, const ControlSpace& space, Monitor& monitor);
  void run(int sweeps);

 private:
  void swap_to_delaunay(int passes);
  void swap_to_degree_six();
  void sweep();
  void rescue_worst();
  [[nodiscard]] bool wants_swap(int t, int i) const;
  [[nodiscard]] double quality(int p, int q, int r) const;
  [[nodiscard]] bool sound(const Triangle& T) const;

  Triangulation& mesh_;
  int imposed_;
  const ControlSpace& space_;
  Monitor& monitor_;
  std::vector<double> sum_x_, sum_y_;
  std::vector<float> weight_;
  std::vector<Vec2> old_;
  std::vector<std::uint8_t> degree_;
  std::vector<std::uint8_t> wanted_degree_;
};

}  // namespace carreau::plane
