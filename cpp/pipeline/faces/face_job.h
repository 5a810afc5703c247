// SPDX-License-Identifier: BSD-3-Clause
// One face on its way through sampling, plane mesh and lift.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cad/reparametrisation.h"
#include "control_space/control_space.h"
#include "pipeline/base/face_outcome.h"
#include "support/error.h"
#include "support/stepped_tasks.h"
#include "surface/layers/layer_rows.h"
#include "surface/lift/surface_agreement.h"
#include "surface/options.h"
#include "surface/result.h"
#include "surface/sample/face_sampling.h"

namespace carreau {

/// Samples, meshes and lifts; repeats the last two while the lift finds details that the sampling has missed. The mesh step
/// alone calls no host.
class FaceJob final : public SteppedTask {
 public:
  /// Keeps references to `cad`, `layers` and `options`.
  FaceJob(PatchInput input, Cad& cad, const SizeRules& rules, const LayerCurves& layers, const CompositeOptions& options,
          bool reentrant)
      : given_(std::move(input)),
        input_(given_),
        cad_(&cad),
        rules_(&rules),
        layers_(layers),
        options_(options),
        reentrant_(reentrant),
        given_slope_(input_.slope),
        squares_(has_quads(options.element) && !options.independent) {}

  [[nodiscard]] bool finished() const override { return next_ == Step::none; }
  [[nodiscard]] bool bound() const override { return !reentrant_ && next_ != Step::mesh; }
  void step(Monitor& monitor) override;

  /// The job of this face from its beginning, for all processes of the team to make it together, step by step, and share
  /// the work.
  [[nodiscard]] std::unique_ptr<FaceJob> shared() const;
  /// Triangles that its samples require, when it has been sampled and not been meshed; else 0.
  [[nodiscard]] double promised() const noexcept {
    return next_ == Step::mesh && space_ && !mesh_ && !best_ && !squares_ ? space_->measure() : 0;
  }

  /// Takes the outcome of the face, once, after it has finished.
  FaceOutcome take_outcome();

 private:
  enum class Step { sample, mesh, lift, none };

  void sample(Monitor& monitor);
  void mesh(Monitor& monitor);
  void lift(Monitor& monitor);
  void fail(const std::string& what);
  void bound_growth_from_edges(Monitor& monitor);
  void refuse_unsound(Monitor& monitor) const;
  void refuse_jumps(std::size_t most, Monitor& monitor) const;
  void check_agreement(const std::vector<int>& doubtful, Monitor& monitor);
  [[nodiscard]] bool sample_bounded(Monitor& monitor);
  bool take_best(Monitor& monitor);
  void set_rows_apart();
  void add_remark(const std::string& what);
  bool refill_undersampled(std::vector<Vec2>& places, Monitor& monitor);
  bool sample_again(const std::vector<Vec2>& places, Monitor& monitor);
  void refuse_beyond_limit(double expected) const;
  [[nodiscard]] ControlSpace sampled(Monitor& monitor, SampledFacts* facts) const;
  void even_out(const UnevenSpeed& speed, Monitor& monitor);
  [[nodiscard]] double max_uneven() const noexcept;
  void return_to_host(Monitor& monitor);
  [[nodiscard]] Vec2 host_uv(const Vec2& p) const { return even_ ? even_->map.to_host(p) : p; }

  /// The face in other parameters than the host's.
  struct Even {
    Reparametrisation map;
    FaceDomain domain;
    std::unique_ptr<Cad> cad;
    std::optional<SizeRules> rules;
    // The host's own:
    const FaceDomain* host_domain = nullptr;
    Cad* host_cad = nullptr;
    const SizeRules* host_rules = nullptr;
  };

  PatchInput given_, input_;
  std::optional<LayerRows> rows_;  // along curves with layers: input_ is the rest of the face
  bool rows_known_ = false;
  std::vector<std::array<Vec3, 3>> turned_;  // FaceOutcome::turned
  Cad* cad_;
  const SizeRules* rules_;
  const LayerCurves& layers_;
  const CompositeOptions& options_;
  bool reentrant_;
  double given_slope_;
  EdgeSizes bounded_edges_;  // in place of the edges of input_ if these are too small
  std::optional<LimitError> beyond_limit_;
  Step next_ = Step::sample;
  int corrections_ = 0, refills_ = 0;
  std::size_t vertices_when_refilled_ = 0;
  std::vector<std::vector<Vec2>> undersampled_;  // that meshes so far have missed
  std::vector<Vec2> probe_points_;
  std::unique_ptr<Even> even_;  // null: the host's parameters will do
  bool evened_out_ = false;     // once is enough
  std::optional<ControlSpace> space_;
  SampledNormals normals_;
  /// The best mesh so far, while the job makes another mesh.
  struct Attempt {
    PatchMesh mesh;
    ControlSpace space;
    SurfaceAgreement agreement;
    bool bounded = false;  // by SizeLimits::lean
  };
  std::optional<Attempt> best_;
  SurfaceAgreement prescribed_;  // of the mesh of the sizes prescribed
  int bounded_rounds_ = 0;       // that had them bounded
  bool squares_ = false;         // points are placed for quadrilaterals
  std::optional<PatchMesh> mesh_;
  std::string failure_, remark_;
  CompositeReport report_;
};

}  // namespace carreau
