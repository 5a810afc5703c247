// SPDX-License-Identifier: BSD-3-Clause
// Points and polylines of space as points and internal curves of a model.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

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

  [[nodiscard]] const Model& model() const noexcept { return model_; }
  [[nodiscard]] const EmbeddedCurves& curves() const noexcept { return curves_; }
  [[nodiscard]] double diagonal() const noexcept { return diagonal_; }
  /// Names a point (dimension 0) or curve (1).
  void set_name(int dimension, int ref, const std::string& name) { (dimension == 0 ? model_.names.points : model_.names.curves)[ref] = name; }

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
  struct Use {
    std::size_t face = 0, curve = 0;  // indices
  };
  struct Place {
    double t = 0, distance = 0;
    Vec2 uv;
    Vec3 xyz, tangent;
  };
  struct Cut {
    double t = 0;
    embedding::End end;
  };
  [[nodiscard]] embedding::Ground ground(double tolerance);
  [[nodiscard]] std::size_t index_of(int face) const;
  [[nodiscard]] Interval interval(const Use& use) const;
  [[nodiscard]] Place at(const Use& use, double t) const;
  [[nodiscard]] Place nearest(const Use& use, const Vec3& x) const;
  bool border(int face, int other, const Vec3& a, const Vec3& b, Vec3& y) const;
  [[nodiscard]] int origin(int curve) const;
  void divide(int curve, const Vec3& x, int point);
  void join_end(int curve, const Vec3& x, int point);
  void rename_point(int from, int to);
  [[nodiscard]] const FaceCurve* part_between(int curve, int point, int other) const;
  int point_at(const embedding::End& end, std::size_t face, Vec2& uv);
  int new_point(const Vec3& x);
  void touch(embedding::End& end, std::size_t face) const;
  std::vector<Cut> cuts_of(const embedding::Piece& piece) const;
  void place(const embedding::Piece& piece, int& whole);
  [[nodiscard]] std::vector<Vec3> points_of(const Use& use) const;
  void embed_wire(std::size_t wire, double tolerance);

  /// The members that an embedding changes.
  struct Content {
    Model model;
    EmbeddedCurves curves;
    std::map<int, int> origins;
    std::vector<std::pair<Vec3, int>> points;
  };
  [[nodiscard]] Content content() const { return {model_, curves_, origins_, points_}; }
  void restore(Content content);

  std::shared_ptr<Cad> cad_;
  Monitor& monitor_;
  int threads_;
  Model model_;
  EmbeddedCurves curves_;
  Projector projector_;  // of the model as it was
  bool has_curves_ = false, has_points_ = false;
  std::map<int, int> origins_;                // of curves that were divided: reference in the model as it was
  std::vector<std::pair<Vec3, int>> points_;  // made here
  double diagonal_ = 0;
  int last_curve_ = 0, last_point_ = 0;  // references
};

}  // namespace carreau
