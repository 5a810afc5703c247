// SPDX-License-Identifier: BSD-3-Clause
// Thresholds of this folder: their meaning, unit, reason and evidence.
#pragma once

namespace carreau::thresholds::measure {
}  // namespace carreau::thresholds::measure
