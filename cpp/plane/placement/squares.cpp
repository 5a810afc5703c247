// SPDX-License-Identifier: BSD-3-Clause
#include "plane/placement/squares.h"

#include <cmath>

#include "plane/kernel/thresholds.h"
#include "plane/placement/advancing_front.h"
#include "plane/placement/circumcentres.h"
#include "plane/placement/cross_field.h"

namespace carreau::plane {

namespace {

using Complex = std::complex<double>;

/// A mesh of this domain whose vertices know the field, with larger triangles inside if there are many.
Triangulation background_of(const Placement& placement) {
  Triangulation background = placement.mesh;
  const bool many = placement.field.measure() >= fewest_for_lattice;
  const Field coarse = placement.field.coarser(many ? background_size : 1);
  PlaneWork work{background, coarse, placement.monitor};
  Placement filling(work, placement.max_triangles);
  advance_front(filling);
  return background;
}

class Squares {
 public:
  Squares(Placement& placement, const Triangulation& background)
      : placement_(placement),
        mesh_(placement.mesh),
        background_(background),
        crosses_(background, placement.monitor) {}

  void run() {
    hint_.reserve(mesh_.vertices.size());
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) hint_.push_back(background_.vertices[v].triangle);
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) spawn(static_cast<std::int32_t>(v));
  }

 private:
  void spawn(std::int32_t v) {
    if (mesh_.vertices[v].triangle < 0) return;
    const Vec2 home = mesh_.at(v);
    const MetricFrame frame(mesh_.vertices[v].metric());
    int near = hint_[v];
    Complex arm = crosses_.arm(home, frame, near);
    for (int k = 0; k < 4; ++k, arm = Complex(-arm.imag(), arm.real())) {
      const Vec2 first = home + frame.from_frame(arm);
      const int start = mesh_.locate(first, mesh_.vertices[v].triangle);
      if (start < 0 || is_taken(first, start)) continue;
      int there = near;
      const Vec2 p = step(home, first, arm, frame, there);
      const int at = mesh_.locate(p, start);
      if (at >= 0) insert(p, at, there);
    }
  }

  // A vertex of the lattice is there already.
  [[nodiscard]] bool is_taken(const Vec2& p, int t) const {
    for (const std::int32_t w : mesh_.triangles[t].v) {
      const Vertex& W = mesh_.vertices[w];
      if (squared_length(W.metric(), p - W.point()) < point_distance * point_distance) return true;
    }
    return false;
  }

  // The end of the step with the metric and the cross halfway.
  Vec2 step(const Vec2& home, const Vec2& first, Complex arm, const MetricFrame& frame, int& triangle) const {
    const Vec2 halfway = 0.5 * (home + first);
    const MetricFrame there(placement_.field.at(halfway));
    const Complex along = there.to_frame(frame.from_frame(arm));
    Complex best = crosses_.arm(halfway, there, triangle);
    for (int k = 0; k < 3; ++k) {
      const Complex turned(-best.imag(), best.real());
      const auto agreement = [&](Complex z) { return z.real() * along.real() + z.imag() * along.imag(); };
      if (agreement(turned) > agreement(best)) best = turned;
    }
    return home + there.from_frame(best);
  }

  void insert(const Vec2& p, int start, int near) {
    placement_.tick();
    const Metric2 metric = placement_.field.at(p);
    const InsertRules rules{point_distance * point_distance, square_height, point_distance,
                            placement_.degenerate_ends};
    if (!mesh_.dig(p, metric, start, rules)) return;
    fill_cavity(placement_, p, metric, Bend::none);
    hint_.push_back(near);
  }

  Placement& placement_;
  Triangulation& mesh_;
  const Triangulation& background_;
  CrossField crosses_;
  std::vector<int> hint_;  // by vertex: a triangle of the background near it
};

}  // namespace

void place_squares(Placement& placement) {
  judge_all(placement);
  const Triangulation background = background_of(placement);
  Squares(placement, background).run();
  insert_circumcentres(placement, large_square_radius, point_distance);
}

}  // namespace carreau::plane
