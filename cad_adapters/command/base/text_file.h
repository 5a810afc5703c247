// SPDX-License-Identifier: BSD-3-Clause
// Small text files as a whole.
#pragma once

#include <string>

namespace command {

/// Content of an ordinary file of at most 64 MB. Throws Failure with the file and the reason.
std::string read_text(const std::string& path);

/// Writes a whole file, in place. Throws Failure with the file and the reason.
void write_text(const std::string& path, const std::string& text);

/// ".bpt" of "a/b.BPT": the letters from the last dot of the name, in lower case; "" without a dot.
std::string suffix_of(const std::string& path);

}  // namespace command
