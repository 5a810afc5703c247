// SPDX-License-Identifier: BSD-3-Clause
// Common data of the passes over the mesh of one domain.
#pragma once

#include "plane/kernel/frame.h"
#include "plane/kernel/shapes.h"
#include "plane/kernel/triangulation.h"
#include "support/monitor.h"

namespace carreau::plane {

/// A pass is a function of this; the arrays that it needs beside are its own. No pass moves or removes the first
/// `fixed` vertices, touches imposed edges or frozen triangles, or turns a triangle over.
struct PlaneWork {
  Triangulation& mesh;
  const Field& field;
  Monitor& monitor;
  Shapes shapes{mesh, field};
  int fixed = 0;  ///< imposed vertices, and vertices of the fans of degenerate sides
};

}  // namespace carreau::plane
