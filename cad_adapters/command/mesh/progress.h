// SPDX-License-Identifier: BSD-3-Clause
// Progress and messages of a run, on the standard error stream.
#pragma once

#include <carreau.h>

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace command {

class CadInput;

/// A bar on a terminal, a line a tenth of the way in a log, nothing when quiet (errors are always shown). Errors are
/// red, warnings yellow and the bar green on a terminal, unless NO_COLOR is set or TERM is dumb. A few warnings that
/// differ in their numbers only are shown, and the others counted.
class Progress {
 public:
  explicit Progress(bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Messages and progress of this session, which has the geometry of `input`, come here; both must not outlive this
  /// object.
  void listen_to(carreau_session* session, const CadInput& input);
  /// Sets the share of all work that follows: bars and lines never go back.
  void part(double from, double to);
  /// Returns the finished share of all work, 0 to 1.
  [[nodiscard]] double reached() const noexcept { return reached_; }
  /// Shows the share of a file that is read; a log gets a line a second.
  void reading(double fraction);
  /// Prints a line about the next phase, or a result.
  void line(const std::string& text);
  /// Something that may be wrong.
  void warning(const std::string& text);
  /// Prints a marked line and its details.
  void attention(const char* word, const std::vector<std::string>& lines);
  /// All of them, in their order, also warnings that were not shown.
  [[nodiscard]] const std::vector<std::string>& warnings() const noexcept { return warnings_; }
  /// Prints a line that a quiet run shows, too.
  void error(const std::string& text);
  /// Takes the bar away.
  void clear();

 private:
  static void on_message(std::int32_t level, const char* text, void* user);
  static std::int32_t on_progress(std::int32_t phase, std::int32_t entity, double fraction, void* user);
  void show(std::int32_t phase, std::int32_t entity, double fraction);
  void tell_of_others();

  using Clock = std::chrono::steady_clock;
  const CadInput* input_ = nullptr;
  bool quiet_, terminal_, colours_, bar_ = false;
  double from_ = 0, to_ = 1, reached_ = 0;
  int tenth_ = -1, phase_ = -1;
  Clock::time_point drawn_;
  std::vector<std::string> warnings_;
  std::map<std::string, int> shown_;  // by text without its numbers
  int held_back_ = 0;                 // since a warning was shown or their number printed
};

}  // namespace command
