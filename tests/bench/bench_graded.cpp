// SPDX-License-Identifier: BSD-3-Clause
// Unit meshes of surfaces under smooth size fields: quality, true lengths and time of each. bench_graded [SURFACE
// [FIELD [SLOPE [TRIANGLES [FILE]]]]]; "all" for any surface or field; without a slope 0.26 (gradation 1.3) with 20 000
// triangles and 0.11 with 100 000.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "common/graded_cases.h"

namespace {

using namespace carreau;
using namespace carreau::testing;

void run(const NamedSurface& surface, const NamedField& field, double slope, double triangles, const char* out) {
  const GradedRun made(surface, field.size, slope, triangles);
  const CompositeReport& r = made.session->report();
  const QualitySummary q = summarise_quality(made.session->exported());
  const MeshEvaluation& d = made.session->delivered();
  std::printf(
      "%-10s %-8s %.2f h %.5f %6zu: length %.4f fit %.5f (%lld short, %lld long) Q2 %.5f p1 %.4f min %.3f six %.4f; "
      "%.3f s sampling %.3f plane %.3f\n",
      surface.name, field.name, slope, made.h, q.triangles, d[EvaluationKind::length].spread.mean, d.share_in_range(),
      static_cast<long long>(d.short_edges), static_cast<long long>(d.long_edges), q.q2.mean, q.q2.p1, q.q2.min,
      q.degree6, made.seconds, r.seconds_sampling, r.seconds_plane);
  std::fflush(stdout);
  if (out != nullptr) made.session->write(out);
}

}  // namespace

int main(int argc, char** argv) {
  const auto wanted = [&](int i, const char* name) {
    return argc <= i || argv[i] == std::string("all") || argv[i] == std::string(name);
  };
  try {
    for (const NamedSurface& surface : graded_surfaces)
      for (const NamedField& field : size_fields) {
        if (!wanted(1, surface.name) || !wanted(2, field.name)) continue;
        if (argc > 4) {
          run(surface, field, std::atof(argv[3]), std::atof(argv[4]), argc > 5 ? argv[5] : nullptr);
          continue;
        }
        if (wanted(3, "0.26")) run(surface, field, 0.26, 20000, nullptr);
        if (wanted(3, "0.11")) run(surface, field, 0.11, 100000, nullptr);
      }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
