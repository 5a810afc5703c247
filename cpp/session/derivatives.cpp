// SPDX-License-Identifier: BSD-3-Clause
#include "session/derivatives.h"

#include <algorithm>
#include <array>

#include "cad/derivative_check.h"
#include "session/left_out.h"
#include "support/infinity.h"
#include "support/stepped_tasks.h"

namespace carreau {

namespace {

struct Box {
  Vec2 low, high;
};

Box box_of(const std::vector<CurveSupport>& supports) {
  Box box{{infinity, infinity}, {-infinity, -infinity}};
  for (const CurveSupport& support : supports)
    for (const Vec2& p : support.uv) {
      box.low = box.low.cwiseMin(p);
      box.high = box.high.cwiseMax(p);
    }
  return box;
}

// Points on curves, which are certainly in the host's domain, moved a little towards each other's mean: a few for each
// face.
std::vector<Vec2> sample_points(const std::vector<CurveSupport>& supports) {
  std::vector<Vec2> points;
  constexpr std::size_t most = 3;
  for (std::size_t c = 0; c < supports.size() && points.size() < most;
       c += std::max<std::size_t>(1, supports.size() / most)) {
    const auto& uv = supports[c].uv;
    const auto& opposite = supports[(c + supports.size() / 2) % supports.size()].uv;
    points.push_back(lerp(uv[uv.size() / 2], opposite[opposite.size() / 3], 0.02));
  }
  return points;
}

}  // namespace

void check_derivatives(const Model& model, const ModelSupports& supports, Cad& cad, const CompositeOptions& options,
                       Model* known, Monitor& monitor) {
  const bool second = options.size.geometric == GeometricSizes::curvature;
  std::vector<std::vector<WrongDerivative>> of_face(model.faces.size());
  const auto look = [&](std::size_t f, Monitor&) {
    const auto take = [&](std::vector<WrongDerivative>&& more) {
      of_face[f].insert(of_face[f].end(), more.begin(), more.end());
    };
    const Box box = box_of(supports.of_face[f]);
    if (box.high.x() > box.low.x() && box.high.y() > box.low.y())
      take(find_wrong_surface_derivatives(cad, model.faces[f].ref, sample_points(supports.of_face[f]), box.low,
                                          box.high, second));
    for (std::size_t c = 0; c < supports.of_face[f].size(); ++c) {
      const Interval range{supports.of_face[f][c].t.front(), supports.of_face[f][c].t.back()};
      const std::array<double, 1> middle{range.a + 0.43 * (range.b - range.a)};
      take(find_wrong_curve_derivatives(cad, model.faces[f].ref, static_cast<int>(c) + 1, middle, range, second));
    }
  };
  run_each(model.faces.size(), !cad.reentrant(), options.executor.threads, look, monitor);
  std::vector<WrongDerivative> wrong;
  for (const auto& some : of_face) wrong.insert(wrong.end(), some.begin(), some.end());
  if (wrong.empty()) return;
  const WrongDerivative& first = wrong.front();
  for (std::size_t i = 1; i < wrong.size(); ++i) {
    const CallbackError error(wrong[i].where, wrong[i].sentence);
    monitor.message(Level::error, error.what());
    if (known != nullptr && error.where().face != first.where.face) leave_out(*known, error);
  }
  throw CallbackError(first.where, first.sentence);
}

}  // namespace carreau
