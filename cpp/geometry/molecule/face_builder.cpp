// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/molecule/face_builder.h"

#include <algorithm>
#include <numbers>
#include <set>

#include "geometry/molecule/sphere_patch.h"

namespace carreau::molecule {

FaceBuilder::FaceBuilder(const Molecule& molecule) : molecule_(molecule) {
  for (std::size_t i = 0; i < molecule.balls.size(); ++i)
    next_ref_ = std::max(next_ref_, number(static_cast<int>(i)) + 1);
}

int FaceBuilder::number(int ball) const {
  return molecule_.numbers.empty() ? ball + 1 : molecule_.numbers[static_cast<std::size_t>(ball)];
}

void FaceBuilder::add_part_of_ball(int ball, Face face, std::unique_ptr<const Patch> patch) {
  const bool first = ball != last_ball_;
  last_ball_ = ball;
  face.ref = first ? number(ball) : next_ref_++;
  face.part_of = first ? 0 : number(ball);
  add(ball, std::move(face), std::move(patch));
}

void FaceBuilder::add_own(int ball, Face face, std::unique_ptr<const Patch> patch) {
  face.ref = next_ref_++;
  add(ball, std::move(face), std::move(patch));
}

void FaceBuilder::add(int ball, Face face, std::unique_ptr<const Patch> patch) {
  if (!molecule_.names.empty()) face.name = molecule_.names[static_cast<std::size_t>(ball)];
  cad_->add(face.ref, std::move(patch));
  model_.faces.push_back(std::move(face));
}

void FaceBuilder::add_whole_ball(int ball, const Ball& sphere, int curve, int point) {
  constexpr double pi = std::numbers::pi;
  const int p = point, q = point + 1;
  const auto half = [&](double a, bool backward) {
    return SpaceArc{sphere.centre, {1, 0, 0}, {0, 1, 0}, sphere.radius, a, a + pi, backward};
  };
  Face lower, upper;
  // Seen from outside, the upper half lies on the left of the equator run forward.
  upper.curves = {{.ref = curve, .end1 = p, .end2 = q}, {.ref = curve + 1, .end1 = q, .end2 = p}};
  lower.curves = {{.ref = curve + 1, .end1 = p, .end2 = q}, {.ref = curve, .end1 = q, .end2 = p}};
  add_part_of_ball(ball, std::move(lower),
                   std::make_unique<SpherePatch>(sphere, Vec3{0, 0, 1}, SpaceLoop{half(pi, true), half(0, true)}));
  add_part_of_ball(ball, std::move(upper),
                   std::make_unique<SpherePatch>(sphere, Vec3{0, 0, -1}, SpaceLoop{half(0, false), half(pi, false)}));
}

int euler_number_of(const Model& model) {
  std::set<int> points, curves;
  int number = 0;
  for (const Face& face : model.faces) {
    int start = 0, loops = 0;
    for (const FaceCurve& curve : face.curves) {
      points.insert(curve.end1);
      if (curve.end1 == curve.end2) continue;  // one point of space
      curves.insert(curve.ref);
      if (start == 0) start = curve.end1, ++loops;
      if (curve.end2 == start) start = 0;
    }
    number += 2 - loops;
  }
  return number + static_cast<int>(points.size()) - static_cast<int>(curves.size());
}

}  // namespace carreau::molecule
