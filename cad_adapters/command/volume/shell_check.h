// SPDX-License-Identifier: BSD-3-Clause
// Shells of solids, and the sides of their material.
#pragma once

#include "volume/solid_surface.h"

namespace command {

/// Throws Failure if a shell of a solid has its material on the wrong side, or lies in the material of another solid. The
/// sentence names the solids and the faces of the shell.
void check_shells(const SolidSurface& surface);

}  // namespace command
