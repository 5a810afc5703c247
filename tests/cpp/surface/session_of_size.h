// A session about to mesh an analytic model by edges of one size.
#pragma once

#include <memory>

#include "common/analytic_cad.h"
#include "session/session.h"

namespace carreau::testing {

/// Sizes from a hundredth to ten times `size` are allowed. To be set further, and meshed.
inline std::unique_ptr<Session> session_of_size(const AnalyticCad& cad, double size, Monitor& monitor) {
  auto session = std::make_unique<Session>(monitor);
  session->set_cad(std::make_shared<AnalyticCad>(cad));
  session->set_model(unglued(cad));
  session->parameters().set("hphydef", size);
  session->parameters().set("hphymin", size / 100);
  session->parameters().set("hphymax", size * 10);
  return session;
}

}  // namespace carreau::testing
