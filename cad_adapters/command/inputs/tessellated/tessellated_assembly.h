// SPDX-License-Identifier: BSD-3-Clause
// Where the tessellated parts of a STEP assembly stand.
#pragma once

#include <array>
#include <vector>

#include "inputs/tessellated/step_records.h"

namespace command {

/// x -> axes x + origin; `axes` by rows.
struct Placement {
  std::array<std::array<double, 3>, 3> axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::array<double, 3> origin = {};

  [[nodiscard]] std::array<double, 3> operator()(const std::array<double, 3>& x) const;
  [[nodiscard]] Placement operator*(const Placement& inner) const;
  [[nodiscard]] Placement inverse() const;  ///< of a motion
};

/// An item of a representation and its place in the whole assembly, in the units of the file.
struct PlacedItem {
  int item = 0;
  Placement placement = {};
};

/// The items of all representations, once for each place where assemblies (NEXT_ASSEMBLY_USAGE_OCCURRENCE with
/// CONTEXT_DEPENDENT_SHAPE_REPRESENTATION) and MAPPED_ITEMs put them. Empty when the file has neither. Throws Failure
/// with the file and the entity.
std::vector<PlacedItem> placed_items(const StepRecords& records);

}  // namespace command
