// SPDX-License-Identifier: BSD-3-Clause
// In place of formula.cpp where muParser is not built in.
#include <limits>

#include "base/failure.h"
#include "inputs/built/formula.h"

namespace command {

struct Formula::State {};

Formula::Formula(const std::string& text, const std::string&) : text_(text) {
  throw Failure("The formula '" + text +
                "' cannot be used: this program was built without muParser (Debian package libmuparser-dev). A "
                "background mesh can.");
}

Formula::~Formula() = default;

double Formula::operator()(const Place&) const noexcept { return std::numeric_limits<double>::quiet_NaN(); }

bool Formula::available() noexcept { return false; }

}  // namespace command
