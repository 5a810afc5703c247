// Meshes whose sizes are what was asked for, whatever the patches (HDR sec. 4.5.5).
#pragma once

#include <span>

#include "curve/curve_model.h"
#include "curve/discrete_curve.h"
#include "surface/options.h"
#include "surface/result.h"

namespace carreau {

/// `curves`: what it was made with. Makes the mesh of `result` free of borders that are not sharp: lengths, shapes, references, curves and (u, v) of its
/// corners. It stays as it is where the outcome would have a defect or triangles that cross and did not. Sentences
/// about faces that have vanished go to `monitor`. Throws what the host throws, and Cancelled: then nothing is changed.
void free_from_patches(const CurveModel& model, std::span<const DiscreteCurve> curves, const CompositeOptions& options,
                       CompositeResult& result, Monitor& monitor);

}  // namespace carreau
