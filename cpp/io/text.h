// SPDX-License-Identifier: BSD-3-Clause
// Functions that the readers of text files share.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace carreau {

/// Without the byte order mark of UTF-8 that some editors put in front.
std::string_view without_byte_order_mark(std::string_view text) noexcept;

/// Line, from 1, of the character at `offset` (or of the end of the text).
int line_at(std::string_view text, std::size_t offset) noexcept;

/// A name with '_' in place of control characters, which other formats could not hold.
std::string without_controls(std::string_view name);

/// Without blanks at both ends.
std::string_view trimmed(std::string_view text) noexcept;

/// Letters a to z as A to Z.
std::string in_capitals(std::string_view text);

/// A word of a file as a message shows it: in quotes, at most 40 characters, others than printable ASCII replaced by
/// '?'.
std::string shown(std::string_view word);

}  // namespace carreau
