// SPDX-License-Identifier: BSD-3-Clause
// Domains of the plane for the regions of a triangulation, with C1 transitions and a partition of unity (Atlas
// sec. 5.5).
#pragma once

#include <array>
#include <optional>

#include "atlas/annulus.h"
#include "atlas/covering/clusters.h"
#include "atlas/covering/shared_triangle.h"

namespace carreau::atlas {

/// A corner of a triangle T: the index of T, and the corner's index.
struct Corner {
  std::int32_t triple = 0;
  int corner = 0;
};

/// The domain Omega_i of a region.
struct Chart {
  Frame frame;
  Annulus annulus;                    ///< the shared region; phi has a period of pi / 3 a corner
  std::vector<Corner> corners;        ///< counterclockwise: corner k has phi from k pi / 3 to (k + 1) pi / 3
  std::vector<std::int32_t> members;  ///< vertices of its cluster
  std::vector<std::int32_t> around;   ///< vertices of the region's border
};

/// Three charts that meet, counterclockwise, and the index of the corner in each.
struct Triple {
  std::array<std::int32_t, 3> chart{0, 0, 0};
  std::array<std::int32_t, 3> slot{0, 0, 0};
};

/// A place of a chart's domain.
enum class Zone { pure, shared, outside };

struct CoveringOptions {
  int hops = 1;  ///< about how many edges a cluster reaches from its middle
  OuterBorder border = OuterBorder::spline;
  bool outer_first = false;  ///< see AnnulusOptions
};

class Covering {
 public:
  /// Makes the clusters itself, and divides triangles in four until clusters are found. Throws InvalidArgument (see
  /// Fans), DomainError with a vertex.
  explicit Covering(const Triangulation& surface, const CoveringOptions& options = {});
  /// Uses given clusters. Throws DomainError with the vertex where they do not make a well-formed covering.
  Covering(const Triangulation& surface, const Partition& partition, const CoveringOptions& options);

  /// The covered surface: the triangulation given, or its division.
  [[nodiscard]] const Triangulation& surface() const { return surface_; }
  [[nodiscard]] const Fans& fans() const { return fans_; }
  [[nodiscard]] const std::vector<Chart>& charts() const { return charts_; }
  [[nodiscard]] const std::vector<Triple>& triples() const { return triples_; }

  /// A place of a shared zone on its T; empty elsewhere.
  template <typename Number>
  struct OnT {
    Corner corner;
    Pair<Number> place;
  };
  template <typename Number>
  [[nodiscard]] std::optional<OnT<Number>> on_t(std::size_t chart, const Pair<Number>& m) const;
  /// Point of the chart at a corner of a T. Beyond its region the result is meaningless.
  template <typename Number>
  [[nodiscard]] Pair<Number> from_t(std::int32_t triple, int corner, const Pair<Number>& place) const;

  [[nodiscard]] Zone zone(std::size_t chart, const Vec2& m) const;
  /// The transition phi_ij. Empty if m is in no zone that both share.
  [[nodiscard]] std::optional<Vec2> transition(std::size_t i, std::size_t j, const Vec2& m) const;
  /// Weights of the three corners of a T at a place: they are alpha_i, and their sum is 1 (Atlas sec. 5.5.2).
  template <typename Number>
  [[nodiscard]] static std::array<Number, 3> weights(const Pair<Number>& place);
  /// alpha_i at a place of chart i.
  [[nodiscard]] double weight(std::size_t chart, const Vec2& m) const;

 private:
  void build(const Partition& partition, const CoveringOptions& options);

  Triangulation surface_;
  Fans fans_;
  std::vector<Chart> charts_;
  std::vector<Triple> triples_;
};

template <typename Number>
std::array<Number, 3> Covering::weights(const Pair<Number>& place) {
  std::array<Number, 3> w;
  Number sum = 0.0;
  for (int c = 0; c < 3; ++c) {
    const Number share = share_of(to_polar(c, place));
    auto& mine = w[static_cast<std::size_t>(c)];
    mine = value_of(share) <= 0 ? Number(1.0) : (value_of(share) >= 1 ? Number(0.0) : Number(beta(share)));
    sum = sum + mine;
  }
  for (Number& mine : w) mine = mine / sum;
  return w;
}

template <typename Number>
std::optional<Covering::OnT<Number>> Covering::on_t(std::size_t chart, const Pair<Number>& m) const {
  const Chart& c = charts_[chart];
  const auto strata = c.annulus.find(m);
  if (!strata) return {};
  const auto n = static_cast<long>(c.corners.size());
  const double turns = std::floor(value_of(strata->phi) / sixth_turn);
  const long slot = ((static_cast<long>(turns) % n) + n) % n;
  const Corner corner = c.corners[static_cast<std::size_t>(slot)];
  return OnT<Number>{corner,
                     from_polar(corner.corner, polar_at(strata->tau, Number(strata->phi - turns * sixth_turn)))};
}

template <typename Number>
Pair<Number> Covering::from_t(std::int32_t triple, int corner, const Pair<Number>& place) const {
  const Triple& t = triples_[static_cast<std::size_t>(triple)];
  const auto k = static_cast<std::size_t>(corner);
  const Polar<Number> polar = to_polar(corner, place);
  return charts_[static_cast<std::size_t>(t.chart[k])].annulus.at(share_of(polar),
                                                                  Number(polar.phi + t.slot[k] * sixth_turn));
}

}  // namespace carreau::atlas
