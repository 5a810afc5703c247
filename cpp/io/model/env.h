// SPDX-License-Identifier: BSD-3-Clause
// blsurf.env: pairs of words (RT-0232 sec. 3.3). Syntax only; names and values are judged by the session.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace carreau {

struct EnvPair {
  std::string name, value;
  bool quoted = false;  ///< the value stood in quotes, '…' or "…" (and so is text even when empty)
  int line = 0;  ///< of the name
};

/// Blanks, tabs, `=` and ends of lines separate words. A quote is doubled within its own quotes. `!` starts a comment that
/// ends with the line, except within quotes. The reader ignores everything after `call exit`. Throws FileError with file
/// and line: a name without a value, a quote that does not close, a character that is not printable.
std::vector<EnvPair> read_env_text(std::string_view text, const std::string& name);
std::vector<EnvPair> read_env(const std::string& path);

}  // namespace carreau
