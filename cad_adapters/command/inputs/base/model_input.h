// SPDX-License-Identifier: BSD-3-Clause
// Common base of inputs whose model is in memory: Bezier patches, and faces with a shared library.
#pragma once

#include "inputs/base/cad_input.h"
#include "inputs/base/face_model.h"

namespace command {

/// A thing that a mesher may stumble over: a face, or one of its sides.
struct ModelDanger {
  std::string kind;
  std::int32_t face = 0, ic = 0;  ///< ic: 0: the face as a whole
  std::string text;
};

struct ModelFigures {
  int faces = 0, sides = 0, points = 0;
  int poles = 0;                     ///< sides that are one point in space
  double shortest = 0;               ///< length of the shortest other side
  std::vector<ModelDanger> dangers;  ///< by kind
};

class ModelInput : public CadInput {
 public:
  carreau_status give_to(carreau_session* session) override;
  /// Diagonal of the box of the curves, sampled: the `diag` of parameters.
  [[nodiscard]] double diagonal() const final { return diagonal_; }
  /// Properties of the sides, sampled: poles, tiny sides (below a thousandth of the diagonal), places where the
  /// geometry fails.
  [[nodiscard]] ModelFigures look_at() const;
  [[nodiscard]] std::string summary() const override;
  [[nodiscard]] std::vector<FaceLook> faces() const final;
  [[nodiscard]] std::vector<std::int32_t> face_numbers() const final;
  bool set_face_size(const std::string& face, double size) final;
  [[nodiscard]] bool answers_face_sizes() const final { return false; }
  [[nodiscard]] double face_size(std::int32_t face) const final;
  [[nodiscard]] std::vector<std::int32_t> curves(std::int32_t face) const final;

 protected:
  explicit ModelInput(FaceModel model) : model_(std::move(model)) {}
  /// To be called by constructors once geometry answers. Throws Failure when the curves have no extent.
  void measure(const std::string& path);

  [[nodiscard]] const FaceModel& model() const noexcept { return model_; }
  virtual carreau_status give_geometry(carreau_session* session) = 0;
  /// "Bezier 3 x 3".
  [[nodiscard]] virtual std::string kind(std::int32_t face) const = 0;

 private:
  [[nodiscard]] FaceLook look_at(const FaceModel::Face& face) const;
  /// Each `step`-th place of `samples` + 1 points of a curve; calls visit(place), or failed() where the geometry fails.
  template <typename Visit, typename Failed>
  void walk(std::int32_t face, std::int32_t ic, int step, Visit&& visit, Failed&& failed) const;

  FaceModel model_;
  double diagonal_ = 0;
};

}  // namespace command
