// SPDX-License-Identifier: BSD-3-Clause
// Unit ellipses of metrics on a mesh, as RR-2818 fig. 20 to 32 have them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "draw/raster.h"
#include "draw/view.h"
#include "files/mesh_file.h"

namespace command {

/// xx xy xz yy yz zz at each vertex, by the interface's order.
using VertexMetrics = std::vector<std::array<double, 6>>;

/// Sizes or metrics of a file at the vertices of a mesh. Throws Failure.
VertexMetrics read_metrics(carreau_mesh* mesh, std::size_t vertices, const std::string& path);

/// Metrics of the triangles themselves. At each vertex: the mean, over the triangles around, of the inverse of the
/// metric in which the triangle is equilateral with unit sides. This inverse is 2/3 of the sum of e e^T over its sides
/// e. In the plane of the triangles at the vertex; the unit if there are no triangles.
VertexMetrics metrics_of_triangles(const MeshArrays& mesh);

/// Rings for the curves {x : x^T M x = scale^2} around the vertices that triangles or edges have. Each lies in the
/// plane of the triangles at its vertex; z = 0 without any. `scale` 1: the unit ellipse, which the ends of unit edges
/// lie on; 1/2: ellipses of neighbours touch.
void add_ellipses(const MeshArrays& mesh, const VertexMetrics& metrics, double scale, const Projection& projection,
                  std::vector<ScreenTriangle>& triangles);

}  // namespace command
