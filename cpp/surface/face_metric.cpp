#include "surface/face_metric.h"

namespace carreau {

void FaceMetric::at(std::span<const Vec2> uv, std::span<const SurfaceJet> jets, std::span<Metric2> metric) {
  const auto fallback = [this](Vec2 p) {
    if (!interfaces_) interfaces_.emplace(plane_, physical_, rules_.law(), monitor_);
    return (*interfaces_)(p);
  };
  if (rules_.uses_metrics()) return rules_.metrics_on_surface(face_, uv, jets, fallback, metric);
  h_.resize(uv.size());
  rules_.on_surface(face_, uv, jets, fallback, h_);
  for (std::size_t i = 0; i < uv.size(); ++i) metric[i] = induced_metric(jets[i].su, jets[i].sv, h_[i]);
}

}  // namespace carreau
