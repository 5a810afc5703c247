// SPDX-License-Identifier: BSD-3-Clause
// Rows of cells along curves of one face. The rest of the face is meshed as a domain of its own.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "surface/layers/layer_curves.h"
#include "surface/patch.h"

namespace carreau {

/// The rows of a face and the rest of its domain. Vertices count as in the whole mesh: vertices of the domain, then the
/// vertices of rows.
struct LayerRows {
  FaceDomain rest;                       ///< its vertices on curves include the tops of rows
  std::vector<Vec3> rest_xyz;            ///< PatchInput::curve_xyz of the rest
  std::vector<std::int32_t> of_rest;     ///< by vertex of the rest: vertex of the whole
  std::vector<Vec2> uv;                  ///< of the vertices of rows, like
  std::vector<Vec3> xyz, normal;
  std::vector<double> size;
  std::vector<LayerCell> cells;
};

/// Makes the rows of a face. Rows end early where they would meet a boundary, other rows, or a fold. Nothing if no curve
/// of the face has layers. `halved`: edges of curves will be cut in two, so their chords turn half as much. `limits`: of this face. Throws
/// the host's exceptions.
std::optional<LayerRows> make_layer_rows(const PatchInput& input, const LayerCurves& layers, Cad& cad, bool halved = false,
                                         std::span<const RowLimit> limits = {});

/// Adds the rows to the mesh of the rest. `domain`: of the whole face, with `curve_xyz`.
PatchMesh with_rows(const LayerRows& rows, const FaceDomain& domain, const std::vector<Vec3>& curve_xyz, PatchMesh rest);

}  // namespace carreau
