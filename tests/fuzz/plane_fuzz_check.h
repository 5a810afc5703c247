// SPDX-License-Identifier: BSD-3-Clause
// Checks of every plane domain that was read.
#pragma once

#include <cstdint>

#include "fuzz_check.h"
#include "geometry/plane/arrangement.h"
#include "geometry/plane/plane_geometry.h"
#include "io/plane/plane_files.h"
#include "support/error.h"

namespace carreau {

/// Larger domains take too long for a fuzzer.
constexpr int max_built = 16;
constexpr double coarse = 0.5;  ///< share of an edge; where arcs conflict polylines are a thousand times finer

/// Any domain becomes a geometry whose curves begin and end at their points, or an InvalidModel.
inline void build(const PlaneDomainInput& input) {
  try {
    const PlaneGeometry plane = build_plane_geometry(input, coarse);
    for (const Face& face : plane.built.model.faces)
      for (int ic = 1; ic <= static_cast<int>(face.curves.size()); ++ic) {
        const Interval all = plane.built.cad->curve_interval(face.ref, ic);
        for (const double t : {all.a, (all.a + all.b) / 2, all.b})
          FUZZ_CHECK(is_finite(plane.built.cad->curve(face.ref, ic, 0, t).c));
      }
  } catch (const InvalidModel& error) {
    FUZZ_CHECK(error.what()[0] != '\0');
  }
}

/// Any bytes are a domain or a FileError that names the file and a line. Points that curves name exist.
template <typename Read>
int fuzz_plane(const std::uint8_t* data, std::size_t size, Read&& read) {
  PlaneDomainInput input;
  try {
    input = read(std::string_view(reinterpret_cast<const char*>(data), size), "x");
  } catch (const FileError& error) {
    FUZZ_CHECK(error.where().file == "x" && error.where().line > 0);
    return 0;
  }
  const int n = static_cast<int>(input.points.size());
  for (const PlaneCurve& curve : input.curves) {
    FUZZ_CHECK(curve.points.size() >= 2 && curve.before < n && curve.after < n);
    for (const int p : curve.points) FUZZ_CHECK(p >= 0 && p < n);
    FUZZ_CHECK(!curve.arcs || (!curve.smooth && curve.points.size() % 2 == 1 && curve.points.size() >= 3));
  }
  for (const PlaneSide& side : input.sides)
    FUZZ_CHECK(side.curve >= 0 && side.curve < static_cast<int>(input.curves.size()));
  if (input.arrange && n <= max_built) {
    try {
      arrange_segments(input);
    } catch (const InvalidModel& error) {
      FUZZ_CHECK(error.what()[0] != '\0');
      return 0;
    }
  }
  const auto segments = [&] {
    std::size_t all = 0;
    for (const PlaneCurve& curve : input.curves) all += curve.points.size() - 1;
    return all;
  };
  const std::size_t before = segments();
  if (n <= max_built) build(input);
  smooth_polygons(input, usual_corner_angle);
  FUZZ_CHECK(segments() == before);  // chains lose none
  return 0;
}

}  // namespace carreau
