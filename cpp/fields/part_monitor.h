// SPDX-License-Identifier: BSD-3-Clause
// Progress of a part of a run.
#pragma once

#include "support/monitor.h"

namespace carreau {

/// A part of a longer run: its fractions, 0 to 1, become fractions of the whole from `from` to `to`. Everything else is
/// handed on.
class PartMonitor final : public Monitor {
 public:
  PartMonitor(Monitor& whole, double from, double to) : whole_(whole), from_(from), to_(to) {}

  void message(Level level, std::string_view text) override { whole_.message(level, text); }
  [[nodiscard]] bool hears(Level level) const override { return whole_.hears(level); }
  void progress(Phase phase, int entity, double fraction) override {
    reached_ = from_ + (to_ - from_) * fraction;
    whole_.progress(phase, entity, reached_);
  }
  void checkpoint() override { whole_.checkpoint(); }
  /// Fraction of the whole at the last report of progress.
  [[nodiscard]] double reached() const noexcept { return reached_; }

 private:
  Monitor& whole_;
  double from_, to_, reached_ = from_;
};

}  // namespace carreau
