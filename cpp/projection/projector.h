// SPDX-License-Identifier: BSD-3-Clause
// Closest points of a model, and its surface at given places.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "cad/cad.h"
#include "model/model.h"
#include "support/monitor.h"
#include "support/vec.h"

namespace carreau {

namespace discrete {
class DiscreteCad;
}

/// The closest point of an entity.
struct ProjectedPoint {
  int ref = 0;      ///< reference of the face, curve or point
  Vec2 parameters;  ///< (u, v) in the face; t and 0 on the curve; 0 at a point
  Vec3 xyz;
  double distance = 0;
};

/// A model whose references are known, as a geometry evaluates it. Searches do not depend on the number of threads.
class Projector {
 public:
  /// `triangles` evaluates the faces of triangles; may be null if there are none.
  Projector(std::shared_ptr<Cad> cad, std::shared_ptr<const discrete::DiscreteCad> triangles, const Model& model);
  ~Projector();
  Projector(const Projector&) = delete;
  Projector& operator=(const Projector&) = delete;

  /// Evaluates a face (dimension 2) at (u, v), or a curve (1) at t and 0: of a curve su and suu are the derivatives by t. Throws
  /// InvalidArgument for an unknown entity, and the exceptions of the geometry.
  void evaluate(int dimension, int ref, unsigned want, std::span<const Vec2> parameters, std::span<SurfaceJet> out, int threads, Monitor& monitor);

  /// The closest point of all faces (dimension 2), curves (1) or points (0), or of the entity `ref` if it is not 0. The first call makes
  /// the trees. Returns by reference the faces on which the host failed, with its reasons: the results are closest points of the others. Throws InvalidArgument for an unknown entity, and the exceptions of the geometry.
  std::map<int, std::string> project(int dimension, int ref, std::span<const Vec3> x, std::span<ProjectedPoint> out, int threads, Monitor& monitor);

  /// The diagonal of the box of faces and curves.
  [[nodiscard]] double diagonal(int threads, Monitor& monitor);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace carreau
