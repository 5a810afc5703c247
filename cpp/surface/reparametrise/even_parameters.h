// SPDX-License-Identifier: BSD-3-Clause
// New parameters that turn an extreme parametrisation into an ordinary one.
#pragma once

#include <optional>

#include "cad/reparametrisation.h"
#include "control_space/control_space.h"
#include "surface/sample/face_sampling.h"

namespace carreau {

/// Finds x(u) and y(v) along which a surface runs evenly. x grows by the longest chord that an iso-line of the domain
/// has there, so that derivatives along it are about 1 or shorter. Squares of a control space, and straight edges,
/// cannot follow speeds that change a thousand times within a tiny interval (knots 1e-6 apart, weights of 1e4). Between
/// such places x and y are proportional to u and v. Evaluates positions only, some thousand, in the domain. `at`: a
/// place where the speed is extreme. Empty if speeds do not differ by parameter lines, so that no x and y help. Throws
/// DomainError with the place where the surface jumps.
std::optional<Reparametrisation> even_parameters(int ref, Cad& cad, const SampledDomain& domain, const Vec2& at,
                                                 Monitor& monitor);

/// The domain in (x, y).
FaceDomain reparametrised(const FaceDomain& domain, const Reparametrisation& map);

/// Brings a mesh back to (u, v); imposed vertices get their places in `host` again. If speeds change much within a
/// triangle it can be turned over in (u, v), but not in (x, y) or in space. Edges are swapped if shapes in space stay
/// good. Returns how many triangles remain turned.
std::size_t return_to_host(const PlaneDomain& host, const Reparametrisation& map, PatchMesh& mesh, Monitor& monitor);

/// The metric of a control space in (x, y), in (u, v). Does not evaluate the host.
ControlSpace returned_to_host(const PlaneDomain& host, const Reparametrisation& map, const ControlSpace& space,
                              Monitor& monitor);

}  // namespace carreau
