// SPDX-License-Identifier: BSD-3-Clause
// A model in memory: the description of faces for a session.
#pragma once

#include <carreau.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace command {

/// Faces with their curves and imposed points, as carreau_model_add_face and its like take them.
struct FaceModel {
  struct Curve {
    std::int32_t type = CARREAU_BOUNDARY, ref = 0, end1 = 0, end2 = 0;
  };
  struct Point {
    std::int32_t ref = 0;
    double u = 0, v = 0;
  };
  struct Face {
    std::int32_t ref = 0, orientation = 1;
    std::vector<Curve> curves;
    std::vector<Point> points;
    double size = 0;  ///< on this face; 0: none
  };
  std::vector<Face> faces;

  /// The face of this reference, or nullptr.
  [[nodiscard]] Face* find(std::int32_t ref);
  [[nodiscard]] const Face* find(std::int32_t ref) const;
};

/// The model in a file x.pardom. Throws Failure with the library's sentence.
FaceModel read_pardom(const std::string& path);

/// The model that a session has. Throws Failure with the library's sentence.
FaceModel model_of(carreau_session* session);

/// Replaces the model of a session.
carreau_status give_model(const FaceModel& model, carreau_session* session);

}  // namespace command
