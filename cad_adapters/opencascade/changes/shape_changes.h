// SPDX-License-Identifier: BSD-3-Clause
// Changes of whole shapes, behind pointers, since OpenCASCADE's toolkits for them take long to load.
#pragma once

#include "changes/imprint.h"
#include "changes/mirror.h"
#include "changes/small_features.h"

namespace carreau_occ {

struct ShapeChanges {
  decltype(&carreau_occ::imprint) imprint;
  decltype(&carreau_occ::mirror) mirror;
  decltype(&carreau_occ::remove_small_features) remove_small_features;
};

/// Returns the changes of this program, or of a library that is loaded for them. Throws std::runtime_error when both are missing.
const ShapeChanges& shape_changes();

}  // namespace carreau_occ

/// The export of the library of changes.
extern "C" __attribute__((visibility("default"))) const carreau_occ::ShapeChanges* carreau_shape_changes();
