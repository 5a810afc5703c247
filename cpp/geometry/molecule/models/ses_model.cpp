// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/molecule/models/ses_model.h"

#include <algorithm>

#include <cmath>

#include "geometry/molecule/face_builder.h"
#include "geometry/molecule/models/probes.h"
#include "geometry/molecule/models/torus_patch.h"
#include "geometry/molecule/poles.h"
#include "geometry/molecule/sphere_patch.h"
#include "model/union_find.h"
#include "support/error.h"

namespace carreau::molecule {

namespace {

/// A place where a probe touches the two balls of a circle. It has references of the points there and of the probe's
/// arc between them, which a spindle has in two pieces.
struct Station {
  double angle = 0;
  int low = 0, high = 0;            ///< points on balls i and j
  int curve = 0, second_curve = 0;  ///< all of the arc, or up to the tips; 0: no spindle
};

/// The surface that a probe sweeps between two stations.
struct Sweep {
  Station from, to;
  int arc = 0, low_curve = 0, high_curve = 0;
};

class ExcludedBuilder {
 public:
  ExcludedBuilder(const Molecule& molecule, const Arrangement& a, double probe, const std::vector<char>& kept,
                  ExcludedMeasures& measures)
      : molecule_(molecule), a_(a), probe_(probe), kept_(kept), measures_(measures), faces_(molecule) {
    for (const Ball& ball : a.balls) middle_ += ball.centre / static_cast<double>(a.balls.size());
  }

  void build() {
    prepare_circles();
    prepare_sweeps();
    join_tiny();
    mark_kept();
    for (std::size_t c = 0; c < a_.components.size(); ++c) add_convex(c);
    for (const Sweep& sweep : sweeps_) add_torus(sweep);
    add_probes();
  }

  BuiltGeometry built() && { return std::move(faces_).built(); }

 private:
  void prepare_circles() {
    for (const Circle& c : a_.circles) {
      tubes_.push_back(tube_of(c, probe_));
      Tips tips;
      if (const Tube& tube = tubes_.back(); tube.spindle) {
        const double height = probe_ * std::sin(tube.tip);
        tips = {next_.point++, next_.point++, c.centre - height * c.axis, c.centre + height * c.axis};
      }
      tips_.push_back(tips);
    }
  }

  Station station(int arc, double angle) {
    const bool spindle = tubes_[a_.arcs[arc].circle].spindle;
    Station s{.angle = angle, .low = next_.point++, .high = next_.point++, .curve = next_.curve++};
    if (spindle) s.second_curve = next_.curve++;
    return s;
  }

  /// Three arcs end at a vertex, two of them on each of its balls.
  void share_points(int vertex, const Circle& c, Station& s) {
    const std::array<int, 3>& balls = a_.vertices[vertex].balls;
    for (std::size_t k = 0; k < 3; ++k) {
      int& point = contact_[vertex][k];
      if (balls[k] != c.i && balls[k] != c.j) continue;
      int& mine = balls[k] == c.i ? s.low : s.high;
      if (point == 0) point = mine;
      mine = point;
    }
  }

  void prepare_sweeps() {
    contact_.assign(a_.vertices.size(), {0, 0, 0});
    at_vertex_.resize(a_.vertices.size());
    for (std::size_t k = 0; k < a_.arcs.size(); ++k) {
      const Arc& arc = a_.arcs[k];
      const int rank = static_cast<int>(k);
      Station from = station(rank, arc.a), to = station(rank, arc.whole() ? (arc.a + arc.b) / 2 : arc.b);
      if (!arc.whole()) {
        share_points(arc.start, a_.circles[arc.circle], from), share_points(arc.end, a_.circles[arc.circle], to);
        at_vertex_[arc.start].push_back({rank, from, true}), at_vertex_[arc.end].push_back({rank, to, false});
      }
      first_sweep_.push_back(sweeps_.size());
      sweeps_.push_back({from, to, rank, next_.curve, next_.curve + 1});
      next_.curve += 2;
      if (!arc.whole()) continue;
      Station again = from;
      again.angle = arc.b;
      sweeps_.push_back({to, again, rank, next_.curve, next_.curve + 1});
      next_.curve += 2;
    }
    first_sweep_.push_back(sweeps_.size());
  }

  /// The torus part of a tiny arc is left out: its two sides are one curve.
  void join_tiny() {
    UnionFind points(static_cast<std::size_t>(next_.point)), curves(static_cast<std::size_t>(next_.curve));
    const auto merge = [](UnionFind& sets, int p, int q) {
      sets.merge(static_cast<std::size_t>(p), static_cast<std::size_t>(q));
    };
    for (const Sweep& s : sweeps_) {
      if (!a_.arcs[s.arc].tiny) continue;
      merge(points, s.from.low, s.to.low), merge(points, s.from.high, s.to.high);
      merge(curves, s.from.curve, s.to.curve), merge(curves, s.from.second_curve, s.to.second_curve);
    }
    const auto rename = [&](Station& s) {
      for (int* point : {&s.low, &s.high}) *point = static_cast<int>(points.find(static_cast<std::size_t>(*point)));
      for (int* curve : {&s.curve, &s.second_curve})
        *curve = static_cast<int>(curves.find(static_cast<std::size_t>(*curve)));
    };
    for (Sweep& s : sweeps_) rename(s.from), rename(s.to);
    for (std::vector<End>& ends : at_vertex_)
      for (End& end : ends) rename(end.station);
  }

  void mark_kept() {
    kept_arc_.assign(a_.arcs.size(), 0);
    kept_vertex_.assign(a_.vertices.size(), 0);
    for (std::size_t c = 0; c < a_.components.size(); ++c)
      for (const Loop& loop : a_.components[c].loops)
        for (const ArcUse& use : loop) {
          const Arc& arc = a_.arcs[use.arc];
          if (kept_[c] == 0) continue;
          kept_arc_[use.arc] = 1;
          if (!arc.whole()) kept_vertex_[arc.start] = kept_vertex_[arc.end] = 1;
        }
  }

  /// Adds a contact circle as the border of a convex part: the circle of the grown balls shrunk to the centre.
  void add_contacts(const ArcUse& use, double share, Face& face, std::vector<SpaceArc>& border) {
    if (a_.arcs[use.arc].tiny) return;
    SpaceArc arc = a_.space_arc(use);
    const Vec3& centre = a_.balls[use.forward ? a_.circle_of(use).j : a_.circle_of(use).i].centre;
    arc.centre = centre + share * (arc.centre - centre), arc.radius *= share;
    std::span<const Sweep> sweeps(sweeps_.data() + first_sweep_[use.arc],
                                  first_sweep_[use.arc + 1] - first_sweep_[use.arc]);
    for (std::size_t k = 0; k < sweeps.size(); ++k) {
      const Sweep& sweep = sweeps[use.forward ? k : sweeps.size() - 1 - k];
      arc.a = sweep.from.angle, arc.b = sweep.to.angle;
      border.push_back(arc);
      if (use.forward)
        face.curves.push_back({.ref = sweep.high_curve, .end1 = sweep.from.high, .end2 = sweep.to.high});
      else
        face.curves.push_back({.ref = sweep.low_curve, .end1 = sweep.to.low, .end2 = sweep.from.low});
    }
  }

  void add_convex(std::size_t rank) {
    const Component& component = a_.components[rank];
    const Ball& grown = a_.balls[component.ball];
    const Ball ball{grown.centre, grown.radius - probe_};
    const double share = ball.radius / grown.radius, area = area_of(a_, component) * share * share;
    measures_.convex += area;
    measures_.ball_area[component.ball] += area;
    measures_.volume +=
        (ball.radius * area + share * share * dot(ball.centre - middle_, vector_area(a_, component))) / 3;
    if (kept_[rank] == 0) return;
    Face face;
    std::vector<SpaceArc> border;
    for (const Loop& loop : component.loops)
      for (const ArcUse& use : loop) add_contacts(use, share, face, border);
    if (border.empty() && !component.loops.empty() && area < ball.radius * ball.radius) return;  // a tiny part
    if (border.empty()) {
      faces_.add_whole_ball(component.ball, ball, next_.curve, next_.point);
      next_.curve += 2, next_.point += 2;
      return;
    }
    faces_.add_part_of_ball(component.ball, std::move(face),
                            std::make_unique<SpherePatch>(ball, find_pole(a_, component).direction, std::move(border)));
  }

  void add_torus_face(const Sweep& sweep, double low, double high, std::vector<FaceCurve> curves) {
    const Circle& c = a_.circles[a_.arcs[sweep.arc].circle];
    const Tube& tube = tubes_[a_.arcs[sweep.arc].circle];
    const double a = sweep.from.angle, b = sweep.to.angle;
    const TorusMeasures m = measure_torus(c, tube, a, b, low, high, middle_);
    const double middle = std::clamp(0.0, low, high);
    const double of_i = measure_torus(c, tube, a, b, low, middle, middle_).area;
    measures_.ball_torus[static_cast<std::size_t>(c.i)] += of_i;
    measures_.ball_torus[static_cast<std::size_t>(c.j)] += m.area - of_i;
    measures_.torus += m.area;
    measures_.volume += m.flux / 3;
    if (kept_arc_[sweep.arc] == 0 || a_.arcs[sweep.arc].tiny) return;
    Face face;
    face.curves = std::move(curves);
    faces_.add_own(c.i, std::move(face), std::make_unique<TorusPatch>(c, tube, a, b, low, high));
  }

  void add_torus(const Sweep& s) {
    const int circle = a_.arcs[s.arc].circle;
    const Tube& tube = tubes_[circle];
    const Tips& tips = tips_[circle];
    const FaceCurve bottom{.ref = s.low_curve, .end1 = s.from.low, .end2 = s.to.low};
    const FaceCurve top{.ref = s.high_curve, .end1 = s.to.high, .end2 = s.from.high};
    if (!tube.spindle)
      return add_torus_face(s, tube.low, tube.high,
                            {bottom,
                             {.ref = s.to.curve, .end1 = s.to.low, .end2 = s.to.high},
                             top,
                             {.ref = s.from.curve, .end1 = s.from.high, .end2 = s.from.low}});
    add_torus_face(s, tube.low, -tube.tip,
                   {bottom,
                    {.ref = s.to.curve, .end1 = s.to.low, .end2 = tips.low},
                    {.ref = next_.curve++, .end1 = tips.low, .end2 = tips.low},
                    {.ref = s.from.curve, .end1 = tips.low, .end2 = s.from.low}});
    add_torus_face(s, tube.tip, tube.high,
                   {{.ref = next_.curve++, .end1 = tips.high, .end2 = tips.high},
                    {.ref = s.to.second_curve, .end1 = tips.high, .end2 = s.to.high},
                    top,
                    {.ref = s.from.second_curve, .end1 = s.from.high, .end2 = tips.high}});
  }

  /// An arc that ends at a vertex, or starts there.
  struct End {
    int arc = 0;
    Station station;
    bool starts = false;
  };

  /// The side of a probe's triangle beside a torus part, which it runs against.
  void add_sides(int vertex, const End& end, std::vector<ProbeArc>& pieces) const {
    const int circle = a_.arcs[end.arc].circle;
    const Circle& c = a_.circles[circle];
    const Tube& tube = tubes_[circle];
    const Tips& tips = tips_[circle];
    const Vec3 out = std::cos(end.station.angle) * c.e1 + std::sin(end.station.angle) * c.e2;
    const auto add = [&](int curve, int low_point, int high_point, double low, double high) {
      const SpaceArc arc{a_.vertices[vertex].x, -out, c.axis, probe_, low, high, !end.starts};
      pieces.push_back({curve, end.starts ? low_point : high_point, end.starts ? high_point : low_point, arc});
    };
    const Station& s = end.station;
    if (!tube.spindle) return add(s.curve, s.low, s.high, tube.low, tube.high);
    add(s.curve, s.low, tips.low, tube.low, -tube.tip);
    add(s.second_curve, tips.high, s.high, tube.tip, tube.high);
  }

  void add_probes() {
    std::vector<ProbeTriangle> probes;
    std::vector<Ball> balls;
    for (std::size_t v = 0; v < a_.vertices.size(); ++v) {
      probes.emplace_back(a_, static_cast<int>(v), probe_);
      balls.push_back(probes.back().ball());
    }
    if (probes.empty()) return;
    std::vector<std::vector<ProbeArc>> pieces(probes.size());
    for (std::size_t v = 0; v < probes.size(); ++v)
      for (const End& end : at_vertex_[v]) add_sides(static_cast<int>(v), end, pieces[v]);
    for (const ProbeCrossing& crossing : find_crossings(a_, probes, tips_, next_)) {
      pieces[crossing.v].push_back(crossing.arc);
      ProbeArc back = crossing.arc;
      back.arc.backward = true;
      std::swap(back.start, back.end);
      pieces[crossing.w].push_back(back);
    }
    const Neighbours neighbours(balls);
    for (std::size_t v = 0; v < probes.size(); ++v)
      add_probe(static_cast<int>(v), probes[v], CoverOfProbes{balls, neighbours.of(static_cast<int>(v))},
                std::move(pieces[v]));
  }

  struct CoverOfProbes {
    std::span<const Ball> balls;
    std::span<const int> others;
    [[nodiscard]] bool operator()(const Vec3& p) const {
      for (const int l : others)
        if (norm(p - balls[l].centre) < balls[l].radius) return true;
      return false;
    }
  };

  void add_probe(int v, const ProbeTriangle& triangle, const CoverOfProbes& covered, std::vector<ProbeArc> pieces) {
    const auto parts =
        parts_of_probe(v, triangle, std::move(pieces), [&](const Vec3& p) { return triangle.holds(p) && !covered(p); });
    if (!parts) throw InvalidModel("the crossings of the probe at atoms " + atoms_of(v) + " do not close");
    for (const ProbePart& part : *parts) add_concave(triangle.ball(), part);
  }

  [[nodiscard]] std::string atoms_of(int v) const {
    std::string text;
    for (const int ball : a_.vertices[v].balls)
      text += (text.empty() ? "" : ", ") +
              std::to_string(molecule_.numbers.empty() ? ball + 1 : molecule_.numbers[static_cast<std::size_t>(ball)]);
    return text;
  }

  void add_concave(const Ball& probe, const ProbePart& part) {
    std::vector<SpaceLoop> loops;
    std::vector<SpaceArc> border;
    Face face;
    for (const ProbeLoop& loop : part.loops) {
      SpaceLoop arcs;
      for (const ProbeArc& piece : loop) {
        arcs.push_back(piece.arc);
        border.push_back(piece.arc);
        face.curves.push_back({.ref = piece.curve, .end1 = piece.start, .end2 = piece.end});
      }
      loops.push_back(std::move(arcs));
    }
    const double area = area_on_sphere(probe, loops, Side::inner);
    measures_.concave += area;
    for (const int ball : a_.vertices[part.vertex].balls)
      measures_.ball_concave[static_cast<std::size_t>(ball)] += area / 3;
    // The loops run seen from inside: their vector area belongs to the normal towards the probe.
    measures_.volume += (dot(probe.centre - middle_, vector_area(probe, loops)) - probe.radius * area) / 3;
    if (kept_vertex_[part.vertex] == 0) return;
    const std::array<int, 3>& balls = a_.vertices[part.vertex].balls;
    Vec3 towards;
    for (const int ball : balls) {
      const Vec3 d = a_.balls[ball].centre - probe.centre;
      towards += d / norm(d);
    }
    faces_.add_own(balls[0], std::move(face),
                   std::make_unique<SpherePatch>(probe, -towards / norm(towards), std::move(border), Side::inner));
  }

  const Molecule& molecule_;
  const Arrangement& a_;
  double probe_;
  const std::vector<char>& kept_;
  ExcludedMeasures& measures_;
  FaceBuilder faces_;
  Vec3 middle_;
  NextReferences next_;
  std::vector<Tube> tubes_;  // [circle], as are the tips
  std::vector<Tips> tips_;
  std::vector<Sweep> sweeps_;
  std::vector<std::size_t> first_sweep_;     // [arc]
  std::vector<std::array<int, 3>> contact_;  // [vertex]: points on its balls
  std::vector<std::vector<End>> at_vertex_;
  std::vector<char> kept_arc_, kept_vertex_;
};

}  // namespace

BuiltGeometry build_excluded(const Molecule& molecule, const Arrangement& a, double probe,
                             const std::vector<char>& kept, ExcludedMeasures& measures) {
  for (auto* of_ball : {&measures.ball_area, &measures.ball_torus, &measures.ball_concave})
    of_ball->assign(a.balls.size(), 0);
  ExcludedBuilder builder(molecule, a, probe, kept, measures);
  builder.build();
  return std::move(builder).built();
}

}  // namespace carreau::molecule
