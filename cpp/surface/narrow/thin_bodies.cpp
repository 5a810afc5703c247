// SPDX-License-Identifier: BSD-3-Clause
#include "surface/narrow/thin_bodies.h"

#include <algorithm>
#include <optional>

#include "support/angles.h"
#include "surface/domain/domain_builder.h"
#include "surface/narrow/thresholds.h"

namespace carreau {
namespace {

using namespace thresholds::narrow;

class Bodies {
 public:
  Bodies(const CurveModel& model, const std::vector<DiscreteCurve>& curves) : model_(model), curves_(curves) {}

  [[nodiscard]] bool is_thickness(const NarrowFace& strip) const {
    const std::optional<Vec3> one = way_out(strip, 0), other = way_out(strip, 1);
    return one && other && dot(*one, *other) > angles::cosine_of_26;
  }

 private:
  [[nodiscard]] double length_of(const NarrowFace& strip, const SidePart& part) const {
    return model_.supports[strip.face][part.curve].length();
  }

  /// The direction in which the only other face at the longest curve of a side leaves it, across the curve.
  [[nodiscard]] std::optional<Vec3> way_out(const NarrowFace& strip, int i) const {
    const Side& side = strip.side[i];
    const SidePart& longest = *std::max_element(side.begin(), side.end(), [&](const SidePart& p, const SidePart& q) {
      return length_of(strip, p) < length_of(strip, q);
    });
    const int curve = model_.topology.curve_of[strip.face][longest.curve];
    const std::vector<CurveUse>& uses = model_.curve(curve).uses;
    if (uses.size() != 2 || uses[0].face == uses[1].face) return {};
    return way_into(uses[0].face == strip.face ? uses[1].face : uses[0].face, curve);
  }

  [[nodiscard]] std::optional<Vec3> way_into(int face, int curve) const {
    PlaneDomain domain;
    try {
      domain = build_face_domain(model_.model, model_.topology, curves_, face).plane;
    } catch (const DomainError&) {
      return {};
    }
    const int middle = curves_[curve].segments() / 2;
    for (const PlaneEdge& edge : domain.edges) {  // the face is on their left
      if (edge.curve != curve || edge.segment != middle) continue;
      const Vec2 a = domain.vertices[edge.a], along = domain.vertices[edge.b] - a;
      const SurfaceJet jet = surface_at(model_.cad, model_.model.faces[face].ref, want_first, a + 0.5 * along);
      const Vec3 tangent = along.x() * jet.su + along.y() * jet.sv, inside = -along.y() * jet.su + along.x() * jet.sv;
      const double square = dot(tangent, tangent);
      if (!(square > 0)) return {};
      const Vec3 across = inside - (dot(inside, tangent) / square) * tangent;
      const double length = norm(across);
      if (!(length > 0)) return {};
      return (1 / length) * across;
    }
    return {};
  }

  const CurveModel& model_;
  const std::vector<DiscreteCurve>& curves_;
};

}  // namespace

void keep_thin_bodies(const CurveModel& model, const std::vector<DiscreteCurve>& curves, NarrowModel& narrow) {
  const Bodies bodies(model, curves);
  std::vector<char> stays(model.model.faces.size(), 0);
  std::erase_if(narrow.strips, [&](const NarrowFace& strip) {
    if (bodies.is_thickness(strip)) stays[strip.face] = 1;
    return stays[strip.face] != 0;
  });
  std::erase_if(narrow.points, [&](const NarrowFace& point) {
    for (const int c : model.topology.curve_of[point.face])
      for (const CurveUse& use : model.curve(c).uses)
        if (use.face != point.face && stays[use.face] == 0) return false;
    return true;
  });
}

}  // namespace carreau
