// SPDX-License-Identifier: BSD-3-Clause
// Sizes that vary from place to place: `--size-map`, and `--face-size` for geometries that do not answer it themselves.
#pragma once

#include <carreau.h>

#include <functional>
#include <optional>
#include <string>

#include "inputs/base/cad_input.h"
#include "files/mesh_file.h"
#include "inputs/built/formula.h"

namespace command {

/// A formula, or the two files of a background mesh.
class SizeMap {
 public:
  /// "bg.mesh", "bg.meshb", "bg.sol" or "bg.solb": the mesh and the solution beside it of the same name; any other text
  /// is a formula; "": no map. Throws Failure with a sentence.
  explicit SizeMap(const std::string& text);

  [[nodiscard]] bool is_formula() const noexcept { return formula_.has_value(); }
  [[nodiscard]] bool is_empty() const noexcept { return !formula_ && mesh_.empty(); }

  /// Mesh of a background mesh; "" of a formula.
  [[nodiscard]] const std::string& mesh_file() const noexcept { return mesh_; }

  /// Makes a session call this map, and the face sizes of `input`, for sizes. `input` and this map outlive the runs of
  /// the session. Throws Failure.
  void give_to(carreau_session* session, const CadInput& input);

  /// The size by a formula in x, y and z at any place, for as long as this map lives; empty if it uses u or v.
  [[nodiscard]] std::function<double(const Point&)> in_space() const;

  /// An invalid value of the formula, with its place; "": none.
  [[nodiscard]] const std::string& failure() const noexcept { return failure_; }

 private:
  static std::int32_t surface_metric(std::int32_t face, double u, double v, std::int32_t* kind, double* value,
                                     void* user) noexcept;
  std::int32_t size_at(std::int32_t face, double u, double v, double& size);

  std::optional<Formula> formula_;
  std::string mesh_, solution_;
  const CadInput* input_ = nullptr;
  carreau_session* session_ = nullptr;
  std::string failure_;
};

}  // namespace command
