// SPDX-License-Identifier: BSD-3-Clause
// Vertices and nodes of elements on a mesh that is free of patches, and the surface that they lie on.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "surface/free_elements/thresholds.h"
#include "surface/independent/base/free_mesh.h"
#include "surface/independent/line_places.h"

namespace carreau {

/// The surface under a free mesh. A factor scales the sizes that the mesh was made with. Keeps references.
class FreeSurface final : public SurfaceAround {
 public:
  FreeSurface(const Charts& charts, Cad& cad) : charts_(charts), cad_(cad) {}

  [[nodiscard]] std::optional<SurfacePlace> towards(const SurfacePlace& from, const Vec3& target) const override {
    return charts_.towards(cad_, from, target, false, thresholds::free_elements::near_foot);
  }
  [[nodiscard]] WantedSize wanted(const SurfacePlace& place) const override { return wanted_at({&place, 1}); }
  /// The size at a vertex with several places.
  [[nodiscard]] WantedSize wanted_at(std::span<const SurfacePlace> places) const;
  [[nodiscard]] bool by_direction() const noexcept override { return charts_.by_direction(); }

  /// Returns the result of towards(), or the place beside the target on a barrier that is in the way.
  [[nodiscard]] std::optional<SurfacePlace> beside(const SurfacePlace& from, const Vec3& target) const {
    return from.regular ? charts_.towards(cad_, from, target, true, thresholds::free_elements::near_foot) : std::nullopt;
  }
  void scale_sizes(double factor) noexcept { factor_ *= factor; }
  [[nodiscard]] const Charts& charts() const noexcept { return charts_; }
  [[nodiscard]] Cad& cad() const noexcept { return cad_; }

 private:
  const Charts& charts_;
  Cad& cad_;
  double factor_ = 1;
};

/// The vertices of a free mesh, under the same numbers; new ones follow.
class ElementVertices final : public PlacedVertices {
 public:
  explicit ElementVertices(const FreeMesh& mesh);

  [[nodiscard]] std::size_t vertices() const override { return place_.size(); }
  [[nodiscard]] bool is_free(std::int32_t v) const override { return several_[v] < 0; }
  [[nodiscard]] std::span<const SurfacePlace> places(std::int32_t v) const override;
  [[nodiscard]] Vec3 position(std::int32_t v) const override { return place_[v].xyz; }
  [[nodiscard]] double size(std::int32_t v) const override { return wanted_[v].h; }
  [[nodiscard]] double size_along(std::int32_t v, std::int32_t w) const override;
  [[nodiscard]] bool by_direction() const noexcept override { return by_direction_; }
  [[nodiscard]] const WantedSize& wanted(std::int32_t v) const { return wanted_[v]; }
  /// The place of a vertex on the side of a normal.
  [[nodiscard]] const SurfacePlace& place_towards(std::int32_t v, const Vec3& normal) const;

  std::int32_t add(const SurfacePlace& place, const WantedSize& wanted);
  std::int32_t add_kept(KeptPlaces places, const WantedSize& wanted);
  /// Sets the place of a free vertex.
  void put(std::int32_t v, const SurfacePlace& place, const WantedSize& wanted) { place_[v] = place, wanted_[v] = wanted; }
  void scale_sizes(double factor);

 private:
  bool by_direction_;
  std::vector<SurfacePlace> place_;
  std::vector<WantedSize> wanted_;
  std::vector<std::int32_t> several_;  // by vertex: index in kept_, -1: free
  std::vector<KeptPlaces> kept_;
};

}  // namespace carreau
