// SPDX-License-Identifier: BSD-3-Clause
// The place that a sentence names.
#pragma once

#include <string_view>

#include "support/error.h"

namespace carreau::abi {

/// Reads the face, curve, point, (u, v) and t of the part of a sentence that Where::prefix() has written; it starts at
/// "face ". All are 0 or absent without such a part.
Where place_in_sentence(std::string_view sentence);

}  // namespace carreau::abi
