// SPDX-License-Identifier: BSD-3-Clause
// The effect of Ctrl-C, `kill` and a closed terminal.
#pragma once

namespace command {

/// From here on SIGINT, SIGTERM and SIGHUP end the program at once, wherever it is; `$?` is 128 + the signal's number.
/// Files under way and a bar on the terminal are removed first. Signals that were ignored stay ignored. A file that
/// grows above a limit of the system becomes an error of writing.
void catch_signals();

/// Tells the handler whether a progress bar is on the terminal.
void bar_is_shown(bool shown) noexcept;

}  // namespace command
