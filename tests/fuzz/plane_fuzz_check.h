// What holds for every plane domain that was read.
#pragma once

#include <cstdint>

#include "fuzz_check.h"
#include "io/plane/plane_files.h"
#include "support/error.h"

namespace carreau {

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
  }
  for (const PlaneSide& side : input.sides)
    FUZZ_CHECK(side.curve >= 0 && side.curve < static_cast<int>(input.curves.size()));
  const auto segments = [&] {
    std::size_t all = 0;
    for (const PlaneCurve& curve : input.curves) all += curve.points.size() - 1;
    return all;
  };
  const std::size_t before = segments();
  smooth_polygons(input, usual_corner_angle);
  FUZZ_CHECK(segments() == before);  // chains lose none
  return 0;
}

}  // namespace carreau
