// Elements other than straight triangles, made of the whole mesh.
#include "surface/elements/work.h"
#include "surface/run.h"

namespace carreau {

void make_elements(CompositeRun& run) {
  if (run.options.element == Element::p1) return;
  const ElementWork work{run.curve_model, run.curves, run.rules, run.options, run.result, run.monitor};
  (void)work;
}

}  // namespace carreau
