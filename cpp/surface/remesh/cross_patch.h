// SPDX-License-Identifier: BSD-3-Clause
// Meshes of the prescribed sizes whatever the patches (HDR sec. 4.5.5).
#pragma once

#include <functional>
#include <span>

#include "curve/curve_model.h"
#include "curve/discrete_curve.h"
#include "surface/remesh/frame.h"

namespace carreau {

/// RemeshingFrame::elements.
using ElementMaker = std::function<void(const SurfaceMesh& before, const RemeshingFrame& frame, CrossPatchResult& made)>;

/// Parts of a mesh that stay: nothing is swapped over their edges, and none of their vertices moves. Empty lists: none.
struct FixedParts {
  std::span<const char> faces = {};   ///< by face, 1: its triangles stay
  std::span<const char> curves = {};  ///< by curve, 1: its edges stay
};

/// Remeshes the mesh of `result` across the borders of patches that are not sharp: lengths, shapes, references, curves and (u, v) of its
/// corners. `curves`: the curves that it was made with; `by_direction`: sizes may differ by direction, by the control spaces of the patches.
/// Periodic borders are `fixed`. `elements` may be empty. Returns false, and the mesh stays, if the new mesh would have a defect or more crossing triangles. Sentences
/// about faces that have vanished go to `monitor`. Throws what the host throws, and Cancelled: then nothing is changed.
bool remesh_across_patches(const CurveModel& model, std::span<const DiscreteCurve> curves, const CompositeOptions& options,
                           bool by_direction, const FixedParts& fixed, const ElementMaker& elements, CompositeResult& result, Monitor& monitor);

/// Keeps the triangles: only `elements`, which is not empty, crosses borders.
void make_elements_across_patches(const CurveModel& model, std::span<const DiscreteCurve> curves, const CompositeOptions& options,
                                  bool by_direction, const FixedParts& fixed, const ElementMaker& elements, CompositeResult& result,
                                  Monitor& monitor);

}  // namespace carreau
