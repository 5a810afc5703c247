// SPDX-License-Identifier: BSD-3-Clause
// Origin of the sizes of a face: physical, geometric, bounds or gradation.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "fields/field_samples.h"
#include "size/size_rules.h"
#include "surface/sample/face_metric.h"

namespace carreau {

/// The cause of the least size of a place. Values are part of the C ABI (channel `governs`).
enum class SizeOrigin : std::uint32_t {
  physical = 0,   ///< the host, hphydef, a background mesh
  geometric = 1,  ///< the curvature
  bounds = 2,     ///< the smaller of these two, moved by hphymin, hphymax, hgeomin or hgeomax
  gradation = 3,  ///< a place beside
};

/// The rules of a run, separately. Each may be missing: its size is ignored.
struct OriginRules {
  /// Keeps references to its arguments. Throws the exceptions of SizeRules.
  OriginRules(const Model& model, const Topology& topology, Cad& cad, const SizeParameters& parameters);

  std::optional<SizeRules> physical, geometric;          ///< clamped
  std::optional<SizeRules> any_physical, any_geometric;  ///< within bounds a million times as wide
  SizeRules both;
  SizeParameters size;
};

/// Origins at one place. All members of sizes are NaN if they are ignored or unknown.
struct OriginsAt {
  TangentSizes physical, geometric;
  std::optional<SizeOrigin> governs;  ///< of the least size in any direction; empty: not known
};

/// The origins of one face (index in Model::faces). Keeps references. For one thread.
class SizeOrigins {
 public:
  /// `graded`: prescribed sizes may be smaller than the sizes of the rules.
  SizeOrigins(int face, const OriginRules& rules, const FaceInterfaces& interfaces, bool graded, Monitor& monitor);

  /// `jets` hold the derivatives that FaceMetric::wants() of all rules returns; `prescribed`: the metric of FaceMetric
  /// there, with its gradation. Evaluates the host's sizes again; a place where the host fails has unknown origins.
  /// Throws Cancelled only.
  void at(std::span<const Vec2> uv, std::span<const SurfaceJet> jets, std::span<const Metric2> prescribed,
          std::span<OriginsAt> origins);

 private:
  struct Part {
    std::optional<FaceMetric> metric;
    std::vector<TangentSizes> sizes;  // of the batch
  };
  void ask(Part& part, std::span<const Vec2> uv, std::span<const SurfaceJet> jets);
  void ask_beyond(Part& any, const Part& own, double low, double high, std::span<const Vec2> uv,
                  std::span<const SurfaceJet> jets);

  const SizeParameters& size_;
  Part physical_, geometric_, any_physical_, any_geometric_, both_;
};

}  // namespace carreau
