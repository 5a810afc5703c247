// Decides where a control space is sampled. Private to size/.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "predicates/polygon_locator.h"
#include "size/control_space.h"
#include "size/control_space_border.h"
#include "size/control_space_lattice.h"
#include "size/control_space_survey.h"
#include "size/control_space_tree.h"

namespace carreau::detail {

/// Samples the field: coarse cells everywhere, finer ones where a cell holds many vertices of the mesh to come, and
/// where prediction from coarser grids disagrees with a sample.
class ControlSpaceSampling {
 public:
  /// The arguments must outlive the object.
  ControlSpaceSampling(const SampledDomain& domain, const MetricSampler& sampler, const ControlSpaceOptions& options,
                       Monitor& monitor);
  /// Call once, before all others.
  void run();

  [[nodiscard]] Tree& tree() noexcept { return *tree_; }
  [[nodiscard]] Lattice& lattice() noexcept { return *lattice_; }
  [[nodiscard]] const BorderSamples& border() const noexcept { return *border_; }
  [[nodiscard]] const PolygonLocator& locator() const noexcept { return locator_; }
  [[nodiscard]] std::size_t samples() const noexcept { return samples_; }

 private:
  struct BorderPoint {
    int vertex;
    std::int32_t cell;
    Metric2 expected{};
  };
  /// A node about to be sampled: the centre of cell `cell`, or amid its side `side`.
  struct NodeProbe {
    std::int32_t node, cell;
    int side = 0;
    Metric2 expected{};
  };

  void choose_grid(const Survey& s);
  [[nodiscard]] std::vector<Metric2> ask(std::span<const Vec2> uv);
  [[nodiscard]] Metric2 root_of(Metric2 metric) const noexcept;
  [[nodiscard]] Metric2 root_of_boxed(Metric2 metric) const noexcept;
  void sample_roots();
  [[nodiscard]] Metric2 expected_at(std::int32_t node, std::int32_t size);

  void settle(std::vector<std::int32_t> active);
  void look_at_suspects();
  void test(std::span<const std::int32_t> cells);
  [[nodiscard]] bool predict_centre(const TreeCell& cell, Metric2& root) const;
  [[nodiscard]] int nodes_inside(const TreeCell& cell) const noexcept;
  [[nodiscard]] std::vector<NodeProbe> centres_of(std::span<const std::int32_t> cells);
  [[nodiscard]] std::vector<BorderPoint> border_points_of(std::span<const std::int32_t> cells);
  void estimate_vertices();

  [[nodiscard]] double allowed_error(double vertices) const noexcept;
  [[nodiscard]] double error_between(Metric2 root, Metric2 truth, const TreeCell& cell) const noexcept;
  [[nodiscard]] bool can_be_filled(const TreeCell& cell) const noexcept;
  [[nodiscard]] double vertices_of(const TreeCell& cell, Metric2 root) const noexcept;
  [[nodiscard]] std::vector<std::int32_t> affordable(std::vector<std::int32_t> cells, std::size_t untested) const;
  std::vector<std::int32_t> refine(std::span<const std::int32_t> cells);
  [[nodiscard]] std::vector<std::int32_t> sample_middles(std::span<const std::int32_t> cells);

  const SampledDomain& domain_;
  PolygonLocator locator_;
  const MetricSampler& sampler_;
  ControlSpaceOptions options_;
  Monitor& monitor_;
  Vec2 box_;
  double floor_ = 0;              // of eigenvalues of the metric in units of the box
  double vertices_ = 1;           // that the mesh will have
  double vertices_per_cell_ = 1;  // a cell that holds many more is split in any case
  std::optional<Lattice> lattice_;
  std::optional<BorderSamples> border_;
  std::optional<Tree> tree_;
  std::vector<char> vertex_sampled_;
  std::size_t samples_ = 0;
};

}  // namespace carreau::detail
