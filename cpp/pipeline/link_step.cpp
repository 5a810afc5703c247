// SPDX-License-Identifier: BSD-3-Clause
// The pairs of vertices of the mesh that is delivered.
#include <string>

#include "pipeline/base/run.h"
#include "support/short_number.h"
#include "surface/carry/periodic_links.h"

namespace carreau {

void link_periodic(CompositeRun& run, bool reports) {
  if (run.periodic.empty()) return;
  const LinkFigures found = link_nodes(run.periodic, run.topology, run.curves, run.result.mesh);
  const bool of_curves = found.faces == 0;
  const std::size_t count = of_curves ? found.curves : found.faces;
  if (count == 0 || !reports) return;
  run.monitor.message(Level::summary, "periodic: " + std::to_string(count) + (count == 1 ? " pair" : " pairs") +
                                          (of_curves ? " of curves, " : " of faces, ") +
                                          std::to_string(of_curves ? found.nodes_of_curves : found.nodes_of_faces) + " pairs of vertices, " +
                                          short_number(found.worst) + " apart at most");
}

}  // namespace carreau
