// SPDX-License-Identifier: BSD-3-Clause
#include "surface/layers/row_obstacles.h"

#include <algorithm>

#include "support/angles.h"
#include "support/shares.h"
#include "surface/layers/thresholds.h"

namespace carreau {

using namespace thresholds::layers;

RowObstacles::RowObstacles(const RowFace& face) : face_(face) {
  for (const PlaneEdge& edge : face_.plane.edges) {
    if (!face_.is_on_curve(edge.a) || !face_.is_on_curve(edge.b)) continue;
    Obstacle obstacle{.a = face_.xyz(edge.a), .b = face_.xyz(edge.b)};
    const Vec2 middle = 0.5 * (face_.uv(edge.a) + face_.uv(edge.b));
    obstacle.sagitta = (face_.halved ? 0.25 : 1) *
                       norm(surface_at(face_.cad, face_.input.ref, want_position, middle).s - 0.5 * (obstacle.a + obstacle.b));
    obstacle.bulge = face_.layers.bulge(edge);
    if (const int layers = face_.layers_of(edge); layers >= 0) {
      obstacle.up = RowFace::unit(cross(face_.normal_at(edge.a), face_.direction(edge.a, edge.b)));
      for (const double h : face_.layers.heights(layers, norm(obstacle.b - obstacle.a))) obstacle.total += h;
    }
    obstacles_.push_back(obstacle);
    if (!(obstacle.total > 0) || edge.kind != PlaneEdgeKind::internal) continue;
    obstacle.up = -obstacle.up;
    obstacles_.push_back(obstacle);
  }
  for (std::size_t v = face_.on_curves; v < face_.plane.vertices.size(); ++v) {
    const Vec3 p = surface_at(face_.cad, face_.input.ref, want_position, face_.plane.vertices[v]).s;
    obstacles_.push_back({.a = p, .b = p});
  }
  std::vector<BoxTree::Box> boxes;
  std::vector<Vec3> centres;
  for (const Obstacle& obstacle : obstacles_) {
    boxes.emplace_back().add(obstacle.a), boxes.back().add(obstacle.b);
    centres.push_back(0.5 * (obstacle.a + obstacle.b));
  }
  tree_ = BoxTree(boxes, centres);
}

Vec3 RowObstacles::nearest_on(const Obstacle& edge, const Vec3& p) {
  const Vec3 along = edge.b - edge.a;
  const double length2 = dot(along, along);
  const double share = length2 > 0 ? std::clamp(dot(p - edge.a, along) / length2, 0.0, 1.0) : 0;
  return edge.a + share * along;
}

void RowObstacles::end(Column& column) const {
  if (column.on_side || !column.stands) return;
  double total = 0;
  for (const double h : column.heights) total += h;
  const Vec3 base = face_.xyz(column.base);
  const double reach = (2 * total + column.heights.back()) * std::max(1.0, column.stretch) + total;
  std::vector<const Obstacle*> near;
  tree_.all_that_meet([&](const BoxTree::Box& box) { return box.squared_distance(base) <= reach * reach; },
                      [&](const BoxTree::Node& leaf) {
                        for (const std::int32_t k : tree_.things(leaf)) near.push_back(&obstacles_[static_cast<std::size_t>(k)]);
                      });
  double height = 0, sagitta = 0, bulge = 0;
  for (const Obstacle* own : near)
    if (own->a == base || own->b == base)
      sagitta = std::max(sagitta, own->sagitta), bulge = std::max(bulge, dot(own->bulge, column.up));
  for (int k = 0; k < column.levels; ++k) {
    const double h = column.heights[static_cast<std::size_t>(k)];
    height += h;
    const Vec3& p = face_.xyz(column.at[static_cast<std::size_t>(k) + 1]);
    const bool free = std::all_of(near.begin(), near.end(), [&](const Obstacle* o) { return is_clear(column, *o, p, height, h, sagitta, bulge); });
    if (!free) {
      column.levels = k;
      return;
    }
  }
}

// Triangles between two chords lean, or turn over, by the sagittas of the chords over the gap.
bool RowObstacles::is_clear(const Column& column, const Obstacle& obstacle, const Vec3& p, double height, double row,
                            double sagitta, double bulge) const {
  const Vec3 nearest = nearest_on(obstacle, p);
  const double distance = norm(nearest - p);
  // Vertices and nodes in the middles of edges leave the chords, towards each other or away.
  const double approach = bulge + std::max(0.0, dot(obstacle.bulge, RowFace::unit(p - nearest)));
  const double upright = std::max({sagitta, obstacle.sagitta, approach});
  if (!(obstacle.total > 0)) {
    if (nearest == face_.xyz(column.base)) return true;
    return distance >= std::max(wall_clearance * row, upright);
  }
  const Vec3 plain_up = RowFace::unit(column.up - dot(column.up, column.along) * column.along);
  const Vec3& base = face_.xyz(column.base);
  // The base is not behind the edge: the other side of an inner curve does not count.
  const bool faces = dot(obstacle.up, plain_up) < -angles::cosine_of_45 && dot(nearest - base, plain_up) > shares::notable * height &&
                     dot(base - obstacle.a, obstacle.up) > 0;
  return distance >= (faces ? std::min(height, obstacle.total) + std::max(row, upright) : min_clearance * height);
}

}  // namespace carreau
