// SPDX-License-Identifier: BSD-3-Clause
// The MED library (libmedC), which the program loads when a .med file is named: it brings HDF5 and MPI.
#pragma once

#include <med.h>

namespace command {

/// Functions of the library under their names without the prefix MED.
struct MedLibrary {
#define CARREAU_MED_FUNCTION(name) decltype(&MED##name) name = nullptr;
#include "files/med_functions.h"
#undef CARREAU_MED_FUNCTION
};

/// Loads the library at the first call. Throws Failure.
const MedLibrary& med_library();

}  // namespace command
