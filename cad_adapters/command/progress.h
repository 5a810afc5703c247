// What a run tells the person who waits for it, on the standard error stream.
#pragma once

#include <carreau.h>

#include <chrono>
#include <cstdint>
#include <string>

namespace command {

/// A bar on a terminal, a line a tenth of the way in a log, nothing when quiet (errors are always told).
/// Errors are red, warnings yellow and the bar green on a terminal, unless NO_COLOR is set or TERM is dumb.
class Progress {
 public:
  explicit Progress(bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Messages and progress of this session come here; it must not outlive this object.
  void listen_to(carreau_session* session);
  /// How much of a file is read; a log gets a line a second.
  void reading(double fraction);
  /// A line of its own: what has begun, or a result.
  void line(const std::string& text);
  /// Something that may be wrong.
  void warning(const std::string& text);
  /// What a quiet run shows as well.
  void error(const std::string& text);
  /// Takes the bar away.
  void clear();

 private:
  static void on_message(std::int32_t level, const char* text, void* user);
  static std::int32_t on_progress(std::int32_t phase, std::int32_t entity, double fraction, void* user);
  void show(std::int32_t phase, std::int32_t entity, double fraction);

  using Clock = std::chrono::steady_clock;
  bool quiet_, terminal_, colours_, bar_ = false;
  int tenth_ = -1, phase_ = -1;
  Clock::time_point drawn_;
};

}  // namespace command
