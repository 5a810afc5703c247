// SPDX-License-Identifier: BSD-3-Clause
// Mesh of a composite surface: supports, sizes, curves, domains, patches, assembly (design: "From input to mesh").
#pragma once

#include "surface/layers/layer_curves.h"
#include "surface/options.h"
#include "surface/result.h"
#include "surface/supports.h"

namespace carreau {

/// `layers` grow from curves, and receive their cells; null: none.
CompositeResult mesh_composite(const Model& model, const Topology& topology, const ModelSupports& supports, Cad& cad,
                               const CompositeOptions& options, Monitor& monitor, MeshLayers* layers = nullptr);

}  // namespace carreau
