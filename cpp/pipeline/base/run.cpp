// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/base/run.h"

#include <algorithm>
#include <utility>

#include "gradation/gradation.h"
#include "support/ranks/team.h"
#include "surface/elements/quads/quadrilaterals.h"

#if defined(__unix__)
#include <unistd.h>

#include "pipeline/base/thresholds.h"
#endif

namespace carreau {

namespace {

using namespace thresholds::patches;

std::int64_t triangles_by_memory() {
#if defined(__unix__)
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    // A triangle may cost 200 bytes while a patch is meshed, with the mesh itself and copies. Twice the memory of a whole process leaves
    // room for metrics, curved elements and copies of hosts.
    // [Memory.AMillionTrianglesNeedAtMostFortyBytesEachAboveTheMesh]
  if (pages > 0 && page > 0)
    return static_cast<std::int64_t>(0.8 * static_cast<double>(pages) * static_cast<double>(page) / 200);
#endif
  return INT64_C(50'000'000);
}

// Ratio by which sizes grow from triangles that requests make smaller, and from prescribed edges, if no growth is given.
constexpr double usual_growth = 1.5;

std::int64_t limit_by_memory() { return std::min<std::int64_t>(triangles_by_memory(), INT32_MAX / 4); }

// True if all steps work on a mesh in parts.
bool work_on_parts(const CompositeOptions& options, const SizeRules& rules) {
  const bool graded = options.gradation > 0 && !(rules.constant() && options.proximity == 0);
  return options.element == Element::p1 && !options.independent && !options.cracks && !graded;
}

}  // namespace

CompositeRun::CompositeRun(const Model& given_model, const Topology& given_topology,
                           const ModelSupports& given_supports, Cad& given_cad, const CompositeOptions& given_options,
                           PeriodicModel given_periodic, Monitor& given_monitor)
    : model(given_model),
      topology(given_topology),
      supports(given_supports),
      cad(given_cad),
      options(given_options),
      monitor(given_monitor),
      rules(model, topology, cad, enlarged(options.size, enlargement_for(options.element))),
      curve_model{model, topology, supports.of_face, cad},
      periodic(std::move(given_periodic)) {
  options.size = enlarged(options.size, enlargement_for(options.element));
  options.parts = options.parts && work_on_parts(options, rules) && periodic.empty();
  if (options.max_triangles <= 0) options.max_triangles = limit_by_memory() * (options.parts ? options.executor.team->size() : 1);
  result.report.diag = supports.diag;
  for (const std::string& remark : periodic.remarks) report(Level::warning, remark);
  if (periodic.empty()) return;
  if (!rules.constant()) slave_sizes.emplace(curve_model, periodic.pairs);
  rules.join(periodic.corners, slave_sizes ? &*slave_sizes : nullptr);
}

void CompositeRun::make_whole() {
  options.parts = false;
  options.max_triangles = std::min(options.max_triangles, limit_by_memory());
}

double CompositeRun::slope_of_edges() const {
  return slope_of_gradation(options.edge_gradation > 0 ? options.edge_gradation : usual_growth);
}

void CompositeRun::fail(std::size_t face, const std::string& why) {
  result.mesh.faces[face].status = FaceStatus::failed;
  result.mesh.faces[face].why = why;
  report(Level::error, why);
}

void CompositeRun::report_kept(int curve, const std::string& what_requires_others) {
  report(Level::warning, Where{.curve = topology.curves[static_cast<std::size_t>(curve)].ref}.prefix() +
                          "the edges prescribed on it stay, although " + what_requires_others + " requires others");
}

void CompositeRun::report(Level level, const std::string& what) {
  if (!trying && reported.insert(what).second) monitor.message(level, what);
}

}  // namespace carreau
