// SPDX-License-Identifier: BSD-3-Clause
// Numbers in fields of a fixed width.
#pragma once

#include <cstddef>
#include <string>

namespace carreau {

/// The shortest form that reads back as the same double when it has at most `width` characters, else the nearest that
/// fits: "-1.2345e-7". width >= 8; the value is finite.
std::string number_within(double value, std::size_t width);

/// The form of Nastran's reals: with a point, ".5" in place of "0.5", "1.5-7" in place of "1.5e-07".
std::string nastran_number(double value, std::size_t width);

}  // namespace carreau
