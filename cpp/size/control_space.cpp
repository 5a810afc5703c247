#include "size/control_space.h"

#include "size/control_space_writer.h"

namespace carreau {

ControlSpace ControlSpace::build(const SampledDomain& domain, const MetricSampler& sampler,
                                 const ControlSpaceOptions& options, Monitor& monitor) {
  detail::ControlSpaceSampling sampling(domain, sampler, options, monitor);
  sampling.run();
  return ControlSpaceWriter(sampling, monitor).run();
}

ControlSpace ControlSpace::constant(Metric2 metric) {
  ControlSpace space;
  // The root (0, 1; 1, 1) has the square (1, 1; 1, 2): at() gives back the very metric.
  space.unit_ = {metric.a, metric.b, 0.5 * metric.c};
  space.leaves_[0].c[0] = {0, 1, 1};
  return space;
}

}  // namespace carreau
