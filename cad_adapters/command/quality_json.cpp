#include "quality_json.h"

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

}  // namespace command
