// SPDX-License-Identifier: BSD-3-Clause
// Points and polylines of space as points and internal curves of a model.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "embedding/divided_model.h"
#include "embedding/embedded_curve.h"
#include "embedding/trace.h"
#include "model/model.h"
#include "projection/projector.h"
#include "support/monitor.h"

namespace carreau {

/// Embeds places in a model one after the other. Its trees serve all of them.
class Embedder {
 public:
  /// `model` has its references. `cad` evaluates its faces and its own curves. `monitor` outlives the embedder.
  Embedder(std::shared_ptr<Cad> cad, std::shared_ptr<const discrete::DiscreteCad> triangles, Model model, EmbeddedCurves curves, int threads,
           Monitor& monitor);

  [[nodiscard]] const Model& model() const noexcept { return divided_.model(); }
  [[nodiscard]] const EmbeddedCurves& curves() const noexcept { return divided_.curves(); }
  [[nodiscard]] double diagonal() const noexcept { return divided_.diagonal(); }
  /// Names a point (dimension 0) or curve (1).
  void set_name(int dimension, int ref, const std::string& name) { divided_.set_name(dimension, ref, name); }

  /// Embeds a point, which joins a curve or point within the tolerance; returns its reference. `tolerance`:
  /// model length. Throws InvalidArgument, and the exceptions of the geometry; changes nothing then.
  int embed_point(const Vec3& x, double tolerance);
  /// Embeds a polyline as curves whose reference in results is returned (trace()). Cuts the curves that it meets: boundaries of faces, internal
  /// curves, itself. Throws like embed_point().
  int embed_polyline(std::span<const Vec3> points, double tolerance);
  /// Embeds the curves of wires that lie on faces, with the names of their wires, and removes these wires. Returns their number; `remarks` has
  /// a sentence for each other wire. Throws the exceptions of the geometry.
  int embed_wires(double tolerance, std::vector<std::string>& remarks);

 private:
  [[nodiscard]] embedding::Ground ground(double tolerance);
  void embed_wire(std::size_t wire, double tolerance);

  std::shared_ptr<Cad> cad_;
  Monitor& monitor_;
  Projector projector_;  // of the model as it was
  embedding::DividedModel divided_;
  bool has_curves_ = false, has_points_ = false;
};

}  // namespace carreau
