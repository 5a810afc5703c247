// A solid one face of which OpenCASCADE evaluates in a way of the test's own.
#pragma once

#include <TopoDS_Shape.hxx>
#include <functional>

namespace adapters {

/// A cylinder of radius 1 and height 2. `before(u)` is called before each evaluation of its round face, which is
/// face 1.
TopoDS_Shape odd_cylinder(std::function<void(double)> before);

}  // namespace adapters
