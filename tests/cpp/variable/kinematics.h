// SPDX-License-Identifier: BSD-3-Clause
// The two examples of HDR sec. 3.4.6 with displacements and damage given by formulas in place of a solver.
#pragma once

#include <memory>
#include <string>

#include "variable/remesh.h"

namespace carreau::testing {

/// A piece under tools, increment by increment of .1 mm.
class Kinematics {
 public:
  virtual ~Kinematics() = default;
  /// The state with the next increment added: the input of remesh().
  virtual const variable::RemeshInput& advance() = 0;
  /// Takes the result of the remeshing.
  void accept(variable::RemeshResult result) {
    input_.piece = std::move(result.piece);
    input_.damage = std::move(result.damage);
    input_.fields = std::move(result.fields);
  }
  void measure() noexcept { input_.measure = true; }
  [[nodiscard]] double moved() const noexcept { return moved_; }  ///< mm, of the tool

 protected:
  variable::RemeshInput input_;
  double moved_ = 0;
};

/// A disc of 50 mm between two planes: homogeneous flow without change of volume, nodes in front of the upper plane go
/// with it. Damage grows in two diagonal bands; from 40 % on a crack runs from the centre along one of them and opens.
std::unique_ptr<Kinematics> brazilian_test();

/// A tool of rake 5 degrees and edge radius .2 mm takes a chip of 2 mm off a block: material in front of a shear plane
/// rests, behind it it runs along the rake. Material in front of the edge is damaged; at 29.7 mm the chip's base.
std::unique_ptr<Kinematics> orthogonal_cutting();

}  // namespace carreau::testing
