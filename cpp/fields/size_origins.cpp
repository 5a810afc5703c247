// SPDX-License-Identifier: BSD-3-Clause
#include "fields/size_origins.h"

#include <algorithm>
#include <cmath>

#include "support/error.h"
#include "support/infinity.h"
#include "support/pieces.h"

namespace carreau {

namespace {

constexpr TangentSizes unknown{nan, nan, nan, nan};
// Points at a time, as elsewhere.
constexpr std::size_t points_at_a_time = 1024;
// Bounds so many times as wide bound no size of a mesh; squares of their ratio are still far from overflow.
constexpr double widening = 1e6;
// Sizes that differ by a smaller share are equal: metrics are decomposed to some 1e-12.
constexpr double same_size = 1e-6;

SizeParameters physical_of(SizeParameters size) {
  size.geometric = GeometricSizes::ignored;
  size.geo_anisotropic = false;
  size.geo_rule = GeometricCriterion::angle;
  return size;
}

SizeParameters geometric_of(SizeParameters size) {
  size.physical = PhysicalSizes::ignored;
  return size;
}

SizeParameters widened(SizeParameters size) {
  size.hphymin /= widening, size.hgeomin /= widening;
  size.hphymax *= widening, size.hgeomax *= widening;
  return size;
}

bool differ(double a, double b) noexcept { return std::abs(a - b) > same_size * b; }

/// The least size; infinity if no size is prescribed.
double least(const TangentSizes& sizes) noexcept { return std::isnan(sizes.h1) ? infinity : sizes.h1; }

}  // namespace

OriginRules::OriginRules(const Model& model, const Topology& topology, Cad& cad, const SizeParameters& parameters)
    : both(model, topology, cad, parameters), size(parameters) {
  const auto set = [&](std::optional<SizeRules>& clamped, std::optional<SizeRules>& any, const SizeParameters& part) {
    clamped.emplace(model, topology, cad, part);
    any.emplace(model, topology, cad, widened(part));
  };
  if (size.physical != PhysicalSizes::ignored) set(physical, any_physical, physical_of(size));
  if (size.geometric != GeometricSizes::ignored) set(geometric, any_geometric, geometric_of(size));
}

SizeOrigins::SizeOrigins(int face, const OriginRules& rules, const FaceInterfaces& interfaces, bool graded,
                         Monitor& monitor)
    : size_(rules.size) {
  const auto set = [&](Part& part, const std::optional<SizeRules>& own) {
    if (own) part.metric.emplace(face, *own, interfaces, monitor);
  };
  set(physical_, rules.physical), set(any_physical_, rules.any_physical);
  set(geometric_, rules.geometric), set(any_geometric_, rules.any_geometric);
  if (graded) both_.metric.emplace(face, rules.both, interfaces, monitor);
}

void SizeOrigins::ask(Part& part, std::span<const Vec2> uv, std::span<const SurfaceJet> jets) {
  part.sizes.assign(uv.size(), unknown);
  if (!part.metric) return;
  std::vector<Metric2> metric(uv.size());
  const auto known = [&](std::size_t i, std::size_t n) {
    try {
      part.metric->at(uv.subspan(i, n), jets.subspan(i, n), std::span(metric).subspan(i, n));
    } catch (const Cancelled&) {
      throw;
    } catch (const Error&) {  // reported for the prescribed sizes
      return false;
    }
    for (std::size_t k = i; k < i + n; ++k) part.sizes[k] = tangent_sizes(jets[k], metric[k]);
    return true;
  };
  if (known(0, uv.size())) return;
  for (std::size_t i = 0; i < uv.size(); ++i) known(i, 1);
}

/// Only a size on one of its bounds can have been moved there; elsewhere `any` equals `own`.
void SizeOrigins::ask_beyond(Part& any, const Part& own, double low, double high, std::span<const Vec2> uv,
                             std::span<const SurfaceJet> jets) {
  const bool on_bound = std::any_of(own.sizes.begin(), own.sizes.end(), [&](const TangentSizes& sizes) {
    return !differ(sizes.h1, low) || !differ(sizes.h1, high);
  });
  if (on_bound)
    ask(any, uv, jets);
  else
    any.sizes = own.sizes;
}

void SizeOrigins::at(std::span<const Vec2> uv, std::span<const SurfaceJet> jets, std::span<const Metric2> prescribed,
                     std::span<OriginsAt> origins) {
  for_pieces(uv.size(), points_at_a_time, [&](std::size_t first, std::size_t n) {
    const auto points = uv.subspan(first, n);
    const auto there = jets.subspan(first, n);
    for (Part* part : {&physical_, &geometric_, &both_}) ask(*part, points, there);
    ask_beyond(any_physical_, physical_, size_.hphymin, size_.hphymax, points, there);
    ask_beyond(any_geometric_, geometric_, size_.hgeomin, size_.hgeomax, points, there);
    for (std::size_t i = 0; i < n; ++i) {
      OriginsAt& here = origins[first + i];
      here = {physical_.sizes[i], geometric_.sizes[i], {}};
      const double graded = tangent_sizes(there[i], prescribed[first + i]).h1;
      const double whole = both_.metric ? both_.sizes[i].h1 : graded;
      if (std::isnan(graded) || std::isnan(whole)) continue;
      const bool geometric = least(here.geometric) < least(here.physical);
      const TangentSizes &own = geometric ? here.geometric : here.physical,
                         &any = geometric ? any_geometric_.sizes[i] : any_physical_.sizes[i];
      here.governs = geometric ? SizeOrigin::geometric : SizeOrigin::physical;
      if (differ(own.h1, any.h1)) here.governs = SizeOrigin::bounds;
      if (graded < whole && differ(graded, whole)) here.governs = SizeOrigin::gradation;
    }
  });
}

}  // namespace carreau
