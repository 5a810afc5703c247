// SPDX-License-Identifier: BSD-3-Clause
// libcarreau_cad, which is loaded when the first CAD file is opened. OpenCASCADE's libraries take longer to load than a
// small mesh takes to make, and most inputs do not need them.
#pragma once

#include <carreau_cad.h>

namespace command {

/// Functions of carreau_cad.h that the command calls, without their prefix.
struct CadLibrary {
#define CARREAU_CAD_FUNCTION(name) decltype(&carreau_cad_##name) name = nullptr;
#include "inputs/cad/cad_functions.h"
#undef CARREAU_CAD_FUNCTION
};

/// Loads the library at the first call. Throws Failure when it is not there.
const CadLibrary& cad_library();

}  // namespace command
