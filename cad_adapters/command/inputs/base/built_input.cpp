// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/base/built_input.h"

#include <carreau_geometry.h>

#include <array>

#include "base/failure.h"
#include "inputs/base/face_model.h"

namespace command {

BuiltInput::BuiltInput(SessionHandle session, const std::string& path)
    : ModelInput(model_of(session.get())), session_(std::move(session)) {
  measure(path);
}

bool BuiltInput::locate(std::int32_t face, double u, double v, Place& place) const noexcept {
  const std::array<double, 2> uv{u, v};
  std::array<double, 3> x{};
  const std::lock_guard lock(mutex_);
  if (carreau_geometry_points(session_.get(), face, 1, uv.data(), x.data()) != CARREAU_OK) return false;
  place = {x[0], x[1], x[2], u, v};
  return true;
}

bool BuiltInput::on_curve(std::int32_t face, std::int32_t ic, double share, double& u, double& v) const noexcept {
  std::array<double, 2> uv{};
  const std::lock_guard lock(mutex_);
  if (carreau_geometry_curve(session_.get(), face, ic, share, uv.data()) != CARREAU_OK) return false;
  u = uv[0], v = uv[1];
  return true;
}

SessionHandle make_silent_session() {
  SessionHandle session = make_session();
  require(session.get(), carreau_set_integer(session.get(), "verb", 0));
  return session;
}

}  // namespace command
