// SPDX-License-Identifier: BSD-3-Clause
// Inputs whose geometry the library evaluates itself, in a session of their own that answers where points are.
#pragma once

#include <mutex>

#include "files/session_handle.h"
#include "inputs/base/model_input.h"

namespace command {

class BuiltInput : public ModelInput {
 public:
  [[nodiscard]] bool locate(std::int32_t face, double u, double v, Place& place) const noexcept override;
  [[nodiscard]] bool on_curve(std::int32_t face, std::int32_t ic, double share, double& u,
                              double& v) const noexcept override;

 protected:
  /// The session has a built-in geometry. `path` is for messages. Throws Failure.
  BuiltInput(SessionHandle session, const std::string& path);
  carreau_status give_geometry(carreau_session* session) final { return give_to(session); }
  /// Asks the session, which one thread uses at a time.
  template <typename Ask>
  auto ask(Ask&& question) const {
    const std::lock_guard lock(mutex_);
    return question(session_.get());
  }

 private:
  SessionHandle session_;
  mutable std::mutex mutex_;
};

/// A session for an input: silent, since warnings come when the mesh is made. Throws Failure.
SessionHandle make_silent_session();

}  // namespace command
