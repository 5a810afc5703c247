// Geometries that the library evaluates itself.
#pragma once

#include <mutex>

#include "model_input.h"
#include "session_handle.h"

namespace command {

/// A geometry in a session of its own, which answers where points are.
class BuiltInput : public ModelInput {
 public:
  [[nodiscard]] bool locate(std::int32_t face, double u, double v, Place& place) const noexcept override;
  [[nodiscard]] bool on_curve(std::int32_t face, std::int32_t ic, double share, double& u,
                              double& v) const noexcept override;

 protected:
  explicit BuiltInput(SessionHandle session);
  /// To be used by one thread at a time.
  [[nodiscard]] carreau_session* session() const noexcept { return session_.get(); }

 private:
  carreau_status give_geometry(carreau_session* session) override { return give_to(session); }

  SessionHandle session_;
  mutable std::mutex mutex_;
};

/// A session that tells no warning: they come when the mesh is made. Throws Failure.
SessionHandle make_silent_session();

}  // namespace command
