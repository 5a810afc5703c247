// SPDX-License-Identifier: BSD-3-Clause
// What Ctrl-C, `kill` and a closed terminal do.
#pragma once

namespace command {

/// From here on SIGINT, SIGTERM and SIGHUP end the program at once, wherever it is, as whoever sent them expects (a
/// shell sees the signal, `$?` is 128 + its number); files that were being written are removed first, and so is a bar
/// on the terminal. Signals that were ignored stay ignored. A file that grows above a limit of the system becomes an
/// error of writing.
void catch_signals();

/// Tells the handler whether a progress bar is on the terminal.
void bar_is_shown(bool shown) noexcept;

}  // namespace command
