// SPDX-License-Identifier: BSD-3-Clause
#include "changes/shape_changes.h"

const carreau_occ::ShapeChanges* carreau_shape_changes() {
  static constexpr carreau_occ::ShapeChanges changes{&carreau_occ::imprint, &carreau_occ::mirror, &carreau_occ::remove_small_features};
  return &changes;
}
