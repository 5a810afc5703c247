// SPDX-License-Identifier: BSD-3-Clause
// Decides the places at which a control space is sampled. Private to control_space/.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "control_space/border.h"
#include "control_space/control_space.h"
#include "control_space/lattice.h"
#include "control_space/prediction.h"
#include "control_space/sample_gradation.h"
#include "control_space/survey.h"
#include "control_space/tree.h"
#include "predicates/polygon_locator.h"

namespace carreau::detail {

/// Samples the field: coarse cells everywhere. Cells are finer if they hold many vertices of the mesh to come, or if
/// prediction from coarser grids disagrees with a sample.
class ControlSpaceSampling {
 public:
  /// The arguments must outlive the object.
  /// `on_surface`: the sampler returns J^T J.
  ControlSpaceSampling(const SampledDomain& domain, const SurfaceSampler& sampler, bool on_surface,
                       const ControlSpaceOptions& options, Monitor& monitor);
  /// Call once, before all others.
  void run();
  /// Call once, after run(): applies carreau::bound_slopes(), or its version by direction, to the samples, joined in
  /// each leaf. The samples must be on_surface.
  void bound_slopes(double slope, bool directed);
  [[nodiscard]] bool bounds_slopes() const noexcept { return slope_ != 0; }
  /// A value predicted at a node of a leaf, bounded by the slope between it and the leaf's samples.
  [[nodiscard]] Metric2 within_slopes(std::int32_t node, const TreeCell& leaf, Metric2 root) const;

  [[nodiscard]] Tree& tree() noexcept { return *tree_; }
  [[nodiscard]] Lattice& lattice() noexcept { return *lattice_; }
  [[nodiscard]] NodePredictor& predictor() noexcept { return *predictor_; }
  [[nodiscard]] BorderSamples& border() noexcept { return *border_; }
  [[nodiscard]] const PolygonLocator& locator() const noexcept { return locator_; }
  [[nodiscard]] std::size_t samples() const noexcept { return samples_; }

 private:
  struct BorderPoint {
    int vertex;
    std::int32_t cell;
    Metric2 expected{};
  };
  /// A centre about to be sampled.
  struct CentreProbe {
    std::int32_t node, cell;
    Metric2 expected{};
  };
  /// A node inside a side of a cell, with the tested leaves on both sides.
  struct SideProbe {
    std::int32_t node, cell;
    int side;
    std::array<std::int32_t, 2> beside{-1, -1};
    Metric2 expected{};
  };

  void choose_grid(const Survey& s);
  [[nodiscard]] std::vector<Metric2> ask(std::span<const Vec2> uv);
  void set_sample(std::int32_t node, Metric2 metric, std::size_t rank);
  void sample_along_border();
  void keep_border(int vertex, Metric2 metric, std::size_t rank);
  void join_leaf(const TreeCell& cell, std::span<const std::int32_t> rank, SampledField& field) const;
  [[nodiscard]] Metric2 root_of(Metric2 metric) const noexcept;
  [[nodiscard]] Metric2 root_of_boxed(Metric2 metric) const noexcept;
  [[nodiscard]] Metric2 root_of_form(Metric2 form) const noexcept;
  [[nodiscard]] Metric2 root_in_cells(Metric2 boxed) const noexcept;
  [[nodiscard]] Metric2 boxed(Metric2 m) const noexcept {
    return {m.a * box_.x() * box_.x(), m.b * box_.x() * box_.y(), m.c * box_.y() * box_.y()};
  }
  [[nodiscard]] static bool is_much_stretched(Metric2 root) noexcept;
  void sample_roots();
  [[nodiscard]] Metric2 expected_at(const TreeCell& cell, int k);

  void balance_cells(std::vector<std::int32_t> active);
  void look_at_probe_points();
  [[nodiscard]] double samples_left() const noexcept {
    return static_cast<double>(options_.max_samples) - static_cast<double>(samples_);
  }
  void test(std::span<const std::int32_t> cells);
  [[nodiscard]] int nodes_inside(const TreeCell& cell) const noexcept;
  [[nodiscard]] std::vector<CentreProbe> centres_of(std::span<const std::int32_t> cells);
  [[nodiscard]] std::vector<BorderPoint> border_points_of(std::span<const std::int32_t> cells);
  void estimate_vertices();

  [[nodiscard]] double allowed_error(double vertices) const noexcept;
  [[nodiscard]] double tolerated_error(double vertices) const noexcept;
  [[nodiscard]] double samples_for_smooth_fields() const noexcept;
  [[nodiscard]] bool is_beyond_tolerance(const TreeCell& cell) const noexcept;
  [[nodiscard]] double error_between(Metric2 root, Metric2 truth, const TreeCell& cell) const noexcept;
  [[nodiscard]] bool can_be_filled(const TreeCell& cell) const noexcept;
  [[nodiscard]] double vertices_of(const TreeCell& cell, Metric2 root) const noexcept;
  [[nodiscard]] std::vector<std::int32_t> affordable(std::vector<std::int32_t> cells, std::size_t untested) const;
  std::vector<std::int32_t> refine(std::span<const std::int32_t> cells);
  [[nodiscard]] std::vector<SideProbe> middles_of(std::span<const std::int32_t> cells);
  [[nodiscard]] std::array<std::int32_t, 2> tested_beside(const SideProbe& probe) const noexcept;
  [[nodiscard]] std::vector<std::int32_t> sample_middles(std::span<const std::int32_t> cells);

  const SampledDomain& domain_;
  PolygonLocator locator_;
  const SurfaceSampler& sampler_;
  bool on_surface_;
  ControlSpaceOptions options_;
  Monitor& monitor_;
  Vec2 box_;
  double floor_ = 0;              // of eigenvalues of the metric in units of the box
  double vertices_ = 1;           // that the mesh will have
  double vertices_per_cell_ = 1;  // a cell that holds many more is split in any case
  std::optional<Lattice> lattice_;
  std::optional<BorderSamples> border_;
  std::optional<Tree> tree_;
  std::optional<NodePredictor> predictor_;
  std::vector<char> vertex_sampled_;
  std::size_t samples_ = 0;
  // Answers of a surface: at the points of its last call, at nodes and at samples of the border.
  struct OnSurface {
    Metric2 metric, form;
    SurfaceTangents tangents;
  };
  [[nodiscard]] OnSurface told(Metric2 metric, std::size_t rank) const noexcept;
  static double size_of(const OnSurface& s) noexcept;
  struct OnBorder {
    int vertex;
    OnSurface told;
  };
  double slope_ = 0;  // none yet
  bool directed_ = false;
  std::vector<SurfaceTangents> last_tangents_;
  std::vector<OnSurface> at_node_;
  std::vector<OnBorder> at_border_;
};

}  // namespace carreau::detail
