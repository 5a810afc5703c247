// SPDX-License-Identifier: BSD-3-Clause
// Adds faces to a model and their patches to an evaluator.
#pragma once

#include <memory>

#include "geometry/molecule/molecule.h"
#include "geometry/molecule/patch_cad.h"

namespace carreau::molecule {

class FaceBuilder {
 public:
  explicit FaceBuilder(const Molecule& molecule);

  /// Adds a part of a ball, with the number of its atom, or as a part of the face with this number. By ball.
  void add_part_of_ball(int ball, Face face, std::unique_ptr<const Patch> patch);
  /// Adds a face with a new reference; `ball` gives the name.
  void add_own(int ball, Face face, std::unique_ptr<const Patch> patch);

  /// Adds two hemispheres of a sphere about a ball's centre. They have curves `curve` and the next one, points `point`
  /// and the next one.
  void add_whole_ball(int ball, const Ball& sphere, int curve, int point);

  BuiltGeometry built() && { return {std::move(cad_), std::move(model_)}; }

 private:
  [[nodiscard]] int number(int ball) const;
  void add(int ball, Face face, std::unique_ptr<const Patch> patch);

  const Molecule& molecule_;
  std::shared_ptr<PatchCad> cad_ = std::make_shared<PatchCad>();
  Model model_;
  int next_ref_ = 1, last_ball_ = -1;
};

/// Euler number of a closed surface, from the points, curves and loops of its model.
int euler_number_of(const Model& model);

}  // namespace carreau::molecule
