// SPDX-License-Identifier: BSD-3-Clause
// Numbers as text, the same in every locale.
#pragma once

#include <string>
#include <string_view>

namespace carreau {

/// Shortest decimal form that reads back as the same double ("0.1", "1e+30", "nan", "inf").
/// Independent of the locale.
std::string format_number(double value);

/// Appends format_number(value) to text without an allocation.
void append_number(std::string& text, double value);

/// Reads a whole word as a number, in the C locale; a Fortran exponent (1.5d0, 1.D-3) is
/// accepted, as are a leading '+' and "nan"/"inf". False when any character is left over.
bool parse_number(std::string_view word, double& value);
bool parse_number(std::string_view word, int& value);

}  // namespace carreau
