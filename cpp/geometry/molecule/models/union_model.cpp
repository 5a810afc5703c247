// SPDX-License-Identifier: BSD-3-Clause
// The boundary of a union of balls as faces, curves and points.
#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "geometry/molecule/face_builder.h"
#include "geometry/molecule/models/ses_model.h"
#include "geometry/molecule/molecule.h"
#include "geometry/molecule/poles.h"
#include "geometry/molecule/sphere_patch.h"
#include "model/union_find.h"
#include "support/error.h"

namespace carreau::molecule {

namespace {

/// References of curves and points: arcs too short to be seen have references of points.
class References {
 public:
  explicit References(const Arrangement& a) : first_curve_(a.arcs.size(), 0), points_(a.vertices.size()) {
    for (std::size_t k = 0; k < a.arcs.size(); ++k) {
      const Arc& arc = a.arcs[k];
      if (arc.tiny) {
        if (!arc.whole()) points_.merge(static_cast<std::size_t>(arc.start), static_cast<std::size_t>(arc.end));
        continue;
      }
      first_curve_[k] = next_curve_;
      next_curve_ += arc.whole() ? 2 : 1;
    }
    next_point_ = static_cast<int>(a.vertices.size()) + 1;
  }

  [[nodiscard]] bool vanishes(int arc) const { return first_curve_[arc] == 0; }
  [[nodiscard]] int curve(int arc) const { return first_curve_[arc]; }
  /// A whole circle has two curves, from its first point to its second one and back.
  [[nodiscard]] int point_of_curve(int curve, int which) const { return next_point_ + 2 * curve + which; }
  /// Reference of a circle without arcs.
  int add_circle() { return std::exchange(next_curve_, next_curve_ + 2); }
  [[nodiscard]] int point(int vertex) { return static_cast<int>(points_.find(static_cast<std::size_t>(vertex))) + 1; }

 private:
  std::vector<int> first_curve_;  // 0: none
  UnionFind points_;
  int next_curve_ = 1, next_point_ = 1;
};

class UnionBuilder {
 public:
  UnionBuilder(const Molecule& molecule, const Arrangement& a) : a_(a), references_(a), faces_(molecule) {}

  void add(const Component& component) {
    const Ball& ball = a_.balls[component.ball];
    Face face;
    std::vector<SpaceArc> border;
    for (const Loop& loop : component.loops)
      for (const ArcUse& use : loop) add_arc(use, face, border);
    if (!border.empty())
      faces_.add_part_of_ball(
          component.ball, std::move(face),
          std::make_unique<SpherePatch>(ball, find_pole(a_, component).direction, std::move(border)));
    else if (component.loops.empty() || area_of(a_, component) > ball.radius * ball.radius)  // except for tiny holes
      add_whole_ball(component.ball);
  }

  BuiltGeometry built() && { return std::move(faces_).built(); }

 private:
  void add_whole_ball(int ball) {
    const int curve = references_.add_circle();
    faces_.add_whole_ball(ball, a_.balls[ball], curve, references_.point_of_curve(curve, 0));
  }

  void add_arc(const ArcUse& use, Face& face, std::vector<SpaceArc>& border) {
    if (references_.vanishes(use.arc)) return;
    const Arc& arc = a_.arcs[use.arc];
    const int ref = references_.curve(use.arc);
    const auto add = [&](int curve, int start, int end, double a, double b) {
      if (!use.forward) std::swap(start, end);
      face.curves.push_back({.ref = curve, .end1 = start, .end2 = end});
      border.push_back(a_.space_arc(use));
      border.back().a = a, border.back().b = b;
    };
    if (!arc.whole()) return add(ref, references_.point(arc.start), references_.point(arc.end), arc.a, arc.b);
    const int p = references_.point_of_curve(ref, 0), q = references_.point_of_curve(ref, 1);
    const double middle = (arc.a + arc.b) / 2;
    if (use.forward) add(ref, p, q, arc.a, middle);
    add(ref + 1, q, p, middle, arc.b);
    if (!use.forward) add(ref, p, q, arc.a, middle);
  }

  const Arrangement& a_;
  References references_;
  FaceBuilder faces_;
};

void check_numbers(const Molecule& molecule) {
  if (molecule.numbers.empty()) return;
  std::unordered_set<int> seen;
  for (const int number : molecule.numbers)
    if (number <= 0 || !seen.insert(number).second)
      throw InvalidArgument("the atom number " + std::to_string(number) +
                            (number <= 0 ? " is not positive" : " is given to two atoms"));
}

/// [component]
std::vector<char> kept_components(const UnionMeasures& m, bool cavities) {
  std::vector<char> kept;
  for (const int shell : m.shell) kept.push_back(cavities || m.shell_volume[shell] > 0 ? 1 : 0);
  return kept;
}

BuiltGeometry build_union(const Molecule& molecule, const Arrangement& a, const std::vector<char>& kept) {
  UnionBuilder builder(molecule, a);
  for (std::size_t c = 0; c < a.components.size(); ++c)
    if (kept[c] != 0) builder.add(a.components[c]);
  return std::move(builder).built();
}

}  // namespace

Arrangement arrange(const Molecule& molecule, const SurfaceOptions& options, Monitor& monitor) {
  check_balls(molecule.balls);
  if (options.kind == SurfaceKind::vws) return arrange(molecule.balls, options.threads, monitor);
  if (!std::isfinite(options.probe) || options.probe < 0)
    throw InvalidArgument("the radius of the probe must be finite and not negative");
  std::vector<Ball> grown = molecule.balls;
  for (Ball& ball : grown) ball.radius += options.probe;
  return arrange(grown, options.threads, monitor);
}

BuiltGeometry build_surface(const Molecule& molecule, const SurfaceOptions& options, Monitor& monitor,
                            MoleculeSummary* summary) {
  check_numbers(molecule);
  const Arrangement a = arrange(molecule, options, monitor);
  UnionMeasures m = measure(a);
  const std::vector<char> kept = kept_components(m, options.cavities);
  const bool excluded = options.kind == SurfaceKind::ses && options.probe > 0;
  ExcludedMeasures parts;
  BuiltGeometry built =
      excluded ? build_excluded(molecule, a, options.probe, kept, parts) : build_union(molecule, a, kept);
  if (excluded) {
    m.area = parts.convex + parts.torus + parts.concave, m.volume = parts.volume;
    m.ball_area = std::move(parts.ball_area);
  }
  if (summary != nullptr) {
    *summary = {molecule.numbers, molecule.names, std::move(m), euler_number_of(built.model),
                a.moved.size(),   parts.torus,    parts.concave, std::move(parts.ball_torus), std::move(parts.ball_concave)};
    summary->ball_torus.resize(a.balls.size(), 0), summary->ball_concave.resize(a.balls.size(), 0);
    for (int i = 1; molecule.numbers.empty() && i <= static_cast<int>(a.balls.size()); ++i)
      summary->numbers.push_back(i);
  }
  return built;
}

}  // namespace carreau::molecule
