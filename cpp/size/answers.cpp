// SPDX-License-Identifier: BSD-3-Clause
#include "size/answers.h"

#include <cmath>
#include <string>

#include "metric/metric3_algebra.h"
#include "support/format.h"

namespace carreau {

namespace {

std::string text_of(const Metric3& m) {
  return "(xx, xy, xz, yy, yz, zz) = (" + format_number(m.xx) + ", " + format_number(m.xy) + ", " +
         format_number(m.xz) + ", " + format_number(m.yy) + ", " + format_number(m.yz) + ", " + format_number(m.zz) +
         ")";
}

std::string text_of(Metric2 m) {
  return "(a, b, c) = (" + format_number(m.a) + ", " + format_number(m.b) + ", " + format_number(m.c) + ")";
}

}  // namespace

void check(const Prescription& p, const PrescriptionSource& source, const Where& where) {
  const auto reject = [&](const std::string& what) { throw CallbackError(where, source.name() + " returned " + what); };
  const auto finite = [](auto... x) { return (std::isfinite(x) && ...); };
  switch (p.kind) {
    case Prescription::Kind::none:
      return;
    case Prescription::Kind::size:
      if (!finite(p.size)) reject("the size " + format_number(p.size) + ", which is not a finite number");
      if (!(p.size > 0)) reject("the size " + format_number(p.size) + ", which is not positive");
      return;
    case Prescription::Kind::space: {
      const Metric3& m = p.space;
      if (!finite(m.xx, m.xy, m.xz, m.yy, m.yz, m.zz)) reject("the metric " + text_of(m) + ", which is not finite");
      if (!is_positive_definite(m)) reject("the metric " + text_of(m) + ", which is not positive definite");
      return;
    }
    case Prescription::Kind::parameter: {
      const Metric2 m = p.parameter;
      if (!finite(m.a, m.b, m.c)) reject("the metric " + text_of(m) + ", which is not finite");
      if (!is_positive_definite(m)) reject("the metric " + text_of(m) + ", which is not positive definite");
      return;
    }
  }
}

Prescription enlarged(Prescription p, double factor) noexcept {
  const double k = 1 / (factor * factor);
  p.size *= factor;
  for (double* m : {&p.space.xx, &p.space.xy, &p.space.xz, &p.space.yy, &p.space.yz, &p.space.zz}) *m *= k;
  p.parameter = k * p.parameter;
  return p;
}

}  // namespace carreau
