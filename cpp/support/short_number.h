// SPDX-License-Identifier: BSD-3-Clause
// Numbers for people.
#pragma once

#include <string>

namespace carreau {

/// A number rounded to `digits` significant decimal digits, from 1 to 17, without zeros at its end: 0.0001235,
/// 4.166e-22.
std::string short_number(double value, int digits = 4);

}  // namespace carreau
