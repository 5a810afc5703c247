// SPDX-License-Identifier: BSD-3-Clause
// A session about to mesh an analytic model by edges of one size.
#pragma once

#include <algorithm>
#include <memory>

#include "common/analytic_cad.h"
#include "mesh/quality.h"
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

/// The same with the boundary parameters of `carreau mesh`.
inline std::unique_ptr<Session> session_of_command(const AnalyticCad& cad, double size, Monitor& monitor) {
  auto session = session_of_size(cad, size, monitor);
  Parameters& parameters = session->parameters();
  parameters.set("hphymin", 1e-7);
  parameters.set("CheckCloseEdges", 20);
  parameters.set("CheckAdjacentEdges", 20);
  parameters.set("CoefRectangle", 0.06);
  parameters.set("edge_gradation", 1.5);
  return session;
}

inline double worst_q2(const FlatMesh& mesh) {
  double worst = 1;
  for (const auto& [a, b, c] : mesh.triangles)
    worst = std::min(worst, quality_q2(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]));
  return worst;
}

}  // namespace carreau::testing
