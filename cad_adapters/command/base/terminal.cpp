// SPDX-License-Identifier: BSD-3-Clause
#include "base/terminal.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace command {

bool is_terminal() {
  const char* const kind = std::getenv("TERM");
  return isatty(STDERR_FILENO) != 0 && (kind == nullptr || std::strcmp(kind, "dumb") != 0);
}

bool shows_colours() {
  const char* const none = std::getenv("NO_COLOR");
  return is_terminal() && (none == nullptr || *none == '\0');
}

void print_marked(const char* word, const char* colour, const char* text) {
  if (shows_colours())
    std::fprintf(stderr, "%s%s:%s %s\n", colour, word, colour::plain, text);
  else
    std::fprintf(stderr, "%s: %s\n", word, text);
}

}  // namespace command
