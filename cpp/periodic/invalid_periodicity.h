// SPDX-License-Identifier: BSD-3-Clause
// Errors of periodicities.
#pragma once

#include "support/error.h"

namespace carreau {

/// A periodicity does not hold. No mesh without the face that the error names can mend it.
struct InvalidPeriodicity : InvalidModel {
  using InvalidModel::InvalidModel;
};

}  // namespace carreau
