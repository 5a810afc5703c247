// SPDX-License-Identifier: BSD-3-Clause
// A model whose curves are divided where points and other curves are embedded.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "embedding/curve_uses.h"
#include "embedding/trace.h"
#include "model/model.h"

namespace carreau::embedding {

/// Adds points and pieces of curves to the faces of a model, and gives them references.
class DividedModel {
 public:
  /// `cad` evaluates the faces and their own curves. Places nearer than a share of the diagonal are one.
  DividedModel(std::shared_ptr<Cad> cad, Model model, EmbeddedCurves curves, double diagonal);

  [[nodiscard]] const Model& model() const noexcept { return model_; }
  [[nodiscard]] const EmbeddedCurves& curves() const noexcept { return curves_; }
  [[nodiscard]] CurveUses uses() const noexcept { return {*cad_, model_, curves_}; }
  [[nodiscard]] double diagonal() const noexcept { return diagonal_; }
  [[nodiscard]] double near() const noexcept { return near_; }
  /// The reference that a part of a curve had before it was divided.
  [[nodiscard]] int origin(int curve) const;

  /// Places a point in a face, or at the curve or point of `end`. Returns its reference.
  int place(End end, int face, Vec2 uv);
  /// Places a piece as internal curves, and cuts the curves that it meets. `whole`: the reference of all pieces in results; 0 before the first.
  void place(const Piece& piece, int& whole);
  void remove_face(std::size_t f) { model_.faces.erase(model_.faces.begin() + static_cast<std::ptrdiff_t>(f)); }
  /// Names a point (dimension 0) or curve (1).
  void set_name(int dimension, int ref, const std::string& name) { (dimension == 0 ? model_.names.points : model_.names.curves)[ref] = name; }

  /// The members that a placement changes. References that were given are not given again.
  struct Content {
    Model model;
    EmbeddedCurves curves;
    std::map<int, int> origins;
    std::vector<std::pair<Vec3, int>> points;
  };
  [[nodiscard]] Content content() const { return {model_, curves_, origins_, points_}; }
  void restore(Content content);

 private:
  void divide(int curve, const Vec3& x, int point);
  void join_end(int curve, const Vec3& x, int point);
  void rename_point(int from, int to);
  [[nodiscard]] const FaceCurve* part_between(int curve, int point, int other) const;
  int point_at(const End& end, std::size_t face, Vec2& uv);
  int new_point(const Vec3& x);
  void touch(End& end, std::size_t face) const;

  std::shared_ptr<Cad> cad_;
  Model model_;
  EmbeddedCurves curves_;
  std::map<int, int> origins_;                // of curves that were divided: reference in the model as it was
  std::vector<std::pair<Vec3, int>> points_;  // made here
  double diagonal_ = 0, near_ = 0;            // model length
  int last_curve_ = 0, last_point_ = 0;       // references
};

}  // namespace carreau::embedding
