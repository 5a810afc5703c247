// SPDX-License-Identifier: BSD-3-Clause
// A source of prescriptions made of functions.
#pragma once

#include <functional>

#include "metric/prescription.h"

namespace carreau::testing {

/// A function that is empty does not answer.
struct FieldSource : PrescriptionSource {
  std::function<Prescription(int face, Vec2 uv, Vec3 xyz)> surface;
  std::function<Prescription(int face, int ic, double t, Vec2 uv, Vec3 xyz)> curve;
  std::function<Prescription(int point, Vec3 xyz)> point;

  Prescription on_surface(int face, Vec2 uv, Vec3 xyz) override {
    return surface ? surface(face, uv, xyz) : Prescription{};
  }
  Prescription on_curve(int face, int ic, double t, Vec2 uv, Vec3 xyz) override {
    return curve ? curve(face, ic, t, uv, xyz) : Prescription{};
  }
  Prescription at_point(int ref, Vec3 xyz) override { return point ? point(ref, xyz) : Prescription{}; }
};

/// The same function of space everywhere.
inline FieldSource field_of_space(std::function<Prescription(Vec3)> f) {
  FieldSource source;
  source.surface = [f](int, Vec2, Vec3 xyz) { return f(xyz); };
  source.curve = [f](int, int, double, Vec2, Vec3 xyz) { return f(xyz); };
  source.point = [f](int, Vec3 xyz) { return f(xyz); };
  return source;
}

}  // namespace carreau::testing
