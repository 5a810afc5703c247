// SPDX-License-Identifier: BSD-3-Clause
#include "check/quality_json.h"

#include <nlohmann/json.hpp>

namespace command {

nlohmann::ordered_json quality_json(const carreau_quality& q) {
  return {{"vertices", q.vertices},     {"triangles", q.triangles}, {"edges", q.edges},
          {"open_edges", q.open_edges}, {"area", q.area},           {"q1_mean", q.q1_mean},
          {"q1_p1", q.q1_p1},           {"q1_min", q.q1_min},       {"q2_mean", q.q2_mean},
          {"q2_p1", q.q2_p1},           {"q2_min", q.q2_min},       {"angle_min", q.angle_min},
          {"angle_max", q.angle_max},   {"edge_min", q.edge_min},   {"edge_mean", q.edge_mean},
          {"edge_max", q.edge_max},     {"degree6", q.degree6}};
}

nlohmann::ordered_json elements_json(const carreau_cell_quality& q) {
  return {{"triangles3", q.triangles3},
          {"triangles6", q.triangles6},
          {"quads4", q.quads4},
          {"quads8", q.quads8},
          {"area", q.area},
          {"triangle_share", q.triangle_share},
          {"shape_mean", q.shape_mean},
          {"shape_min", q.shape_min},
          {"scaled_jacobian_mean", q.scaled_jacobian_mean},
          {"scaled_jacobian_min", q.scaled_jacobian_min},
          {"least_jacobian_mean", q.least_jacobian_mean},
          {"least_jacobian_min", q.least_jacobian_min},
          {"angle_min", q.angle_min},
          {"angle_max", q.angle_max},
          {"invalid", q.invalid}};
}

}  // namespace command
