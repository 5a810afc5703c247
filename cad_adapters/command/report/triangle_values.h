// SPDX-License-Identifier: BSD-3-Clause
// Values of each triangle in a report: its shape, its size, its distance and angle to the surface.
#pragma once

#include <carreau.h>

#include <cstdint>
#include <string>
#include <vector>

#include "files/mesh_file.h"

namespace command {

enum class Scale { linear, logarithmic };

/// A value a triangle. NaN: it has none.
struct TriangleValues {
  std::string key;    ///< "quality", "size", "a0", "a1"
  std::string title;  ///< for a person
  std::string unit;   ///< "", "degrees", "model length"
  std::string help;   ///< a sentence
  Scale scale = Scale::linear;
  std::vector<double> values = {};
  double low = 0, high = 1;  ///< ends of the colours and of the histogram, low < high; values beyond get the end colours
};

/// The halves of quadrilaterals among the triangles of a mesh. 0: the triangle is an element itself; 1, 2: the first
/// and the second half of a quadrilateral, (a, b, c) and (a, c, d).
std::vector<std::uint8_t> halves_of(const MeshArrays& mesh);

/// Quality: Q2 (HDR eq. 1.6) of a triangle, the shape of a quadrilateral (HDR sec. 1.1.1) for both its halves. Size: the
/// side of the equilateral triangle of the same area. Vertices must be finite.
std::vector<TriangleValues> shape_values(const MeshArrays& mesh, const std::vector<std::uint8_t>& halves);

/// A0 and A1 of the mesh of a session, which is measured for it when it has not been. Throws Failure.
std::vector<TriangleValues> surface_values(carreau_session* session, std::size_t triangles);

}  // namespace command
