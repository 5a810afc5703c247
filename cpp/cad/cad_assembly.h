// SPDX-License-Identifier: BSD-3-Clause
// Geometries side by side as one, each with its own references.
#pragma once

#include <memory>
#include <vector>

#include "cad/continued_cad.h"

namespace carreau {

/// Forwards calls about faces and points of part k to it, by its own references. They are the references of the
/// assembly less first_face - 1 and first_point - 1. All others are the host's. Errors of a part name references of the
/// assembly. Re-entrant when all parts are; gives the orders that all parts give.
class CadAssembly final : public Cad, public ContinuedCad {
 public:
  struct Part {
    std::shared_ptr<Cad> cad;
    int first_face = 1, last_face = 0, first_point = 1, last_point = 0;
    /// The number of curves of each face that the part evaluates. The host evaluates the others, by references of the assembly. Empty: all.
    std::vector<int> curves = {};
  };
  /// `host` may be null. Ranges of parts ascend and do not overlap.
  CadAssembly(std::shared_ptr<Cad> host, std::vector<Part> parts) : host_(std::move(host)), parts_(std::move(parts)) {}

  void surface(int face, unsigned want, std::span<const Vec2> uv, std::span<SurfaceJet> out) override;
  Interval curve_interval(int face, int ic) override;
  CurveJet curve(int face, int ic, unsigned want, double t) override;
  std::optional<double> surface_size(int face, Vec2 uv) override;
  std::optional<double> curve_size(int face, int ic, double t) override;
  std::optional<double> point_size(int point) override;
  std::optional<double> surface_radius(int face, Vec2 uv) override;
  std::optional<double> curve_radius(int face, int ic, double t) override;
  [[nodiscard]] bool reentrant() const noexcept override;
  [[nodiscard]] CallCounts counts() const noexcept override;
  [[nodiscard]] unsigned surface_gives() const noexcept override;
  [[nodiscard]] unsigned curve_gives() const noexcept override;
  [[nodiscard]] bool is_continued(int face) const noexcept override;
  void set_parameter_box(int face, Vec2 low, Vec2 high) override;
  void set_boundary(int face, std::vector<BoundaryCurve> boundary) override;

 private:
  [[nodiscard]] const Part* part_of_face(int face) const noexcept;
  [[nodiscard]] Cad& host_of(int face) const;
  /// Calls ask(cad, face) with the part that has the face, or with the host for a curve beyond the part's own.
  template <typename Ask>
  auto of_face(int face, int ic, Ask&& ask);
  template <typename Visit>
  void each(Visit&& visit) const;

  std::shared_ptr<Cad> host_;
  std::vector<Part> parts_;
};

}  // namespace carreau
