// SPDX-License-Identifier: BSD-3-Clause
// Images of periodic faces that are turned over in (u, v): their masters are made finer.
#include <memory>
#include <optional>

#include "pipeline/base/inspector.h"

namespace carreau {

namespace {

class PeriodicInspector final : public Inspector {
 public:
  void inspect(CompositeRun& run) override {
    now_ = 0;
    for (const auto& sources : run.turned) now_ += sources.size();
  }
  [[nodiscard]] bool is_better(const CompositeRun& /*run*/) const override { return now_ < best_; }
  void keep() override { best_ = now_; }
  [[nodiscard]] std::optional<RefinementRequests> requests(const CompositeRun& run) override {
    if (round_++ == run.options.crossing_rounds || now_ == 0) return {};
    return RefinementRequests{.segments = {}, .sizes = run.turned};
  }
  [[nodiscard]] bool keeps_patches() const override { return true; }
  // The loop reports the faces that stay failed.
  void report(CompositeRun& /*run*/) override {}

 private:
  std::size_t now_ = 0, best_ = 0;
  int round_ = 0;
};

}  // namespace

std::unique_ptr<Inspector> make_periodic_inspector() { return std::make_unique<PeriodicInspector>(); }

}  // namespace carreau
