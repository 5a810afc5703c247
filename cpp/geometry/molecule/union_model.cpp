// The boundary of a union of balls as faces, curves and points.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_set>
#include <utility>

#include "geometry/molecule/molecule.h"
#include "geometry/molecule/patch_cad.h"
#include "geometry/molecule/poles.h"
#include "geometry/molecule/sphere_patch.h"
#include "model/union_find.h"
#include "support/error.h"

namespace carreau::molecule {

namespace {

constexpr double tiny = 1e-6;  // of the smaller radius of the two balls of an arc

/// References of curves and points: those of arcs too short to be seen are points.
class References {
 public:
  explicit References(const Arrangement& a) : a_(a), first_curve_(a.arcs.size(), 0), points_(a.vertices.size()) {
    for (std::size_t k = 0; k < a.arcs.size(); ++k) {
      const Arc& arc = a.arcs[k];
      const Circle& c = a.circles[arc.circle];
      const double length = c.radius * (arc.b - arc.a);
      if (length <= tiny * std::min(a.balls[c.i].radius, a.balls[c.j].radius)) {
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
  /// Of a circle that no arc has.
  int add_circle() { return std::exchange(next_curve_, next_curve_ + 2); }
  [[nodiscard]] int point(int vertex) { return static_cast<int>(points_.find(static_cast<std::size_t>(vertex))) + 1; }

 private:
  const Arrangement& a_;
  std::vector<int> first_curve_;  // 0: none
  UnionFind points_;
  int next_curve_ = 1, next_point_ = 1;
};

class UnionBuilder {
 public:
  UnionBuilder(const Molecule& molecule, const Arrangement& a)
      : molecule_(molecule), a_(a), references_(a), cad_(std::make_shared<PatchCad>()) {
    for (std::size_t i = 0; i < a.balls.size(); ++i) next_ref_ = std::max(next_ref_, number(static_cast<int>(i)) + 1);
  }

  void add(const Component& component) {
    if (component.loops.empty()) return add_whole_ball(component.ball);
    Face face;
    std::vector<SpaceArc> border;
    for (const Loop& loop : component.loops)
      for (const ArcUse& use : loop) add_arc(use, face, border);
    if (!border.empty())
      add_face(component.ball, std::move(face), find_pole(a_, component).direction, std::move(border));
    else if (const double r = a_.balls[component.ball].radius; area_of(a_, component) > r * r)
      add_whole_ball(component.ball);  // but for tiny holes
  }

  BuiltGeometry built() && { return {std::move(cad_), std::move(model_)}; }

 private:
  [[nodiscard]] int number(int ball) const {
    return molecule_.numbers.empty() ? ball + 1 : molecule_.numbers[static_cast<std::size_t>(ball)];
  }

  void add_arc(const ArcUse& use, Face& face, std::vector<SpaceArc>& border) {
    if (references_.vanishes(use.arc)) return;
    const Arc& arc = a_.arcs[use.arc];
    const Circle& c = a_.circles[arc.circle];
    const SpaceArc whole{c.centre, c.e1, c.e2, c.radius, arc.a, arc.b, !use.forward};
    const int ref = references_.curve(use.arc);
    const auto add = [&](int curve, int start, int end, double a, double b) {
      if (!use.forward) std::swap(start, end);
      face.curves.push_back({.ref = curve, .end1 = start, .end2 = end});
      border.push_back(whole);
      border.back().a = a, border.back().b = b;
    };
    if (!arc.whole()) return add(ref, references_.point(arc.start), references_.point(arc.end), arc.a, arc.b);
    const int p = references_.point_of_curve(ref, 0), q = references_.point_of_curve(ref, 1);
    const double middle = (arc.a + arc.b) / 2;
    add(ref, p, q, arc.a, middle);
    add(ref + 1, q, p, middle, arc.b);
    if (use.forward) return;
    std::swap(face.curves.back(), face.curves[face.curves.size() - 2]);
    std::swap(border.back(), border[border.size() - 2]);
  }

  void add_face(int ball, Face face, const Vec3& pole, std::vector<SpaceArc> border) {
    const bool first = ball != last_ball_;
    last_ball_ = ball;
    face.ref = first ? number(ball) : next_ref_++;
    face.part_of = first ? 0 : number(ball);
    if (!molecule_.names.empty()) face.name = molecule_.names[static_cast<std::size_t>(ball)];
    cad_->add(face.ref, std::make_unique<SpherePatch>(a_.balls[ball], pole, std::move(border)));
    model_.faces.push_back(std::move(face));
  }

  /// Two hemispheres.
  void add_whole_ball(int ball) {
    const Ball& b = a_.balls[ball];
    const double pi = std::numbers::pi;
    const int curve = references_.add_circle();
    const int p = references_.point_of_curve(curve, 0), q = references_.point_of_curve(curve, 1);
    for (const bool upper : {false, true}) {
      // From the lower pole the upper half is on the left of the equator run forward, seen from outside.
      const SpaceArc equator{b.centre, {1, 0, 0}, {0, 1, 0}, b.radius, 0, pi, !upper};
      std::vector<SpaceArc> border{equator, equator};
      Face face;
      border[upper ? 1 : 0].a = pi, border[upper ? 1 : 0].b = 2 * pi;
      const FaceCurve there{.ref = curve, .end1 = p, .end2 = q}, back{.ref = curve + 1, .end1 = q, .end2 = p};
      const FaceCurve there_reversed{.ref = curve, .end1 = q, .end2 = p},
          back_reversed{.ref = curve + 1, .end1 = p, .end2 = q};
      if (upper)
        face.curves = {there, back};
      else
        face.curves = {back_reversed, there_reversed};
      add_face(ball, std::move(face), {0, 0, upper ? -1.0 : 1.0}, std::move(border));
    }
  }

  const Molecule& molecule_;
  const Arrangement& a_;
  References references_;
  std::shared_ptr<PatchCad> cad_;
  Model model_;
  int next_ref_ = 1, last_ball_ = -1;
};

void check_numbers(const Molecule& molecule) {
  if (molecule.numbers.empty()) return;
  std::unordered_set<int> seen;
  for (const int number : molecule.numbers)
    if (number <= 0 || !seen.insert(number).second)
      throw InvalidArgument("the atom number " + std::to_string(number) +
                            (number <= 0 ? " is not positive" : " is given to two atoms"));
}

std::vector<char> kept_shells(const UnionMeasures& m, bool cavities) {
  std::vector<char> kept;
  for (const double volume : m.shell_volume) kept.push_back(cavities || volume > 0);
  return kept;
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
  const std::vector<char> kept = kept_shells(m, options.cavities);
  UnionBuilder builder(molecule, a);
  for (std::size_t c = 0; c < a.components.size(); ++c)
    if (kept[m.shell[c]] != 0) builder.add(a.components[c]);
  if (summary != nullptr) {
    *summary = {molecule.numbers, molecule.names, std::move(m), a.euler_number(), a.moved.size()};
    for (int i = 1; molecule.numbers.empty() && i <= static_cast<int>(a.balls.size()); ++i)
      summary->numbers.push_back(i);
  }
  return std::move(builder).built();
}

}  // namespace carreau::molecule
