// SPDX-License-Identifier: BSD-3-Clause
// A solid one face of which OpenCASCADE evaluates in a way of the test's own.
#pragma once

#include <TopoDS_Shape.hxx>
#include <functional>

namespace adapters {

/// A cylinder of radius 1 and height 2. `before(u, v)` is called before each evaluation of its round face, which is
/// face 1.
TopoDS_Shape odd_cylinder(std::function<void(double, double)> before);

/// Returns true if a place of its parameters [0, 2 pi] x [0, 2] is away from the boundary.
inline bool is_inside(double u, double v) { return u > 3 && u < 6 && v > 0.1 && v < 1.9; }

}  // namespace adapters
