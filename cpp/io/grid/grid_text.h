// SPDX-License-Identifier: BSD-3-Clause
// Functions that the readers of grids share.
#pragma once

#include <string>
#include <string_view>

namespace carreau {

/// True if the beginning of a file has characters of text only.
bool is_text(std::string_view content) noexcept;

/// Throws FileError when a file is binary.
void require_text(std::string_view content, const std::string& name);

}  // namespace carreau
