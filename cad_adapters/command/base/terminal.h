// SPDX-License-Identifier: BSD-3-Clause
// The abilities of the standard error stream.
#pragma once

namespace command {

/// It is a terminal that moves its cursor: not a log, and TERM is not dumb.
bool is_terminal();

/// is_terminal(), and colours are not disabled (NO_COLOR set and not empty, https://no-color.org).
bool shows_colours();

namespace colour {
constexpr const char *red = "\033[31m", *yellow = "\033[33m", *green = "\033[32m", *plain = "\033[0m";
}

/// "word: text" in a line, the word in the colour where colours are shown.
void print_marked(const char* word, const char* colour, const char* text);

}  // namespace command
