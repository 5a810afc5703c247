// SPDX-License-Identifier: BSD-3-Clause
// Unit mesh of a large domain in pieces, by several threads.
#pragma once

#include <optional>

#include "control_space/control_space.h"
#include "mesh/plane_mesh.h"
#include "plane/division/options.h"
#include "plane/kernel/frame.h"
#include "plane/kernel/thresholds.h"
#include "support/monitor.h"

namespace carreau::plane {

/// True if the metric promises enough triangles.
bool is_worth_dividing(const Field::Known& known, const PlaneMesherOptions& options) noexcept;

/// `a_piece`: triangles that a piece has, about. The mesh does not depend on the number of threads. Empty: the domain
/// cannot be divided, or a piece cannot be meshed. Throws DomainError for a domain that is wrong as a whole;
/// LimitError, Cancelled.
std::optional<PlaneMesh> mesh_divided(const PlaneDomain& domain, const ControlSpace& metric, Field::Known known,
                                      const PlaneMesherOptions& options, Monitor& monitor,
                                      double a_piece = triangles_a_piece);

}  // namespace carreau::plane
