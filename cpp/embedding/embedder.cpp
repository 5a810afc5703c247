// SPDX-License-Identifier: BSD-3-Clause
#include "embedding/embedder.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "embedding/thresholds.h"
#include "model/geometries.h"
#include "support/error.h"
#include "support/infinity.h"

namespace carreau {

namespace {

namespace limit = thresholds::embedding;
using embedding::End;
using embedding::Ground;
using embedding::Piece;

constexpr int parts_of_span = 4;  // chords of a Hermite span, in which crossings are sought

/// Curves of wires are no part of any surface.
Model without_wires(Model model) {
  for (Face& face : model.faces)
    if (face.is_wire()) face.curves.clear();
  return model;
}

double lerp1(double p, double q, double w) { return (1 - w) * p + w * q; }

struct Samples {
  std::vector<double> t;
  std::vector<Vec2> uv;
};

Samples samples_of(const EmbeddedCurve& curve, double a, double b) {
  Samples samples;
  const auto add = [&](double t) { samples.t.push_back(t), samples.uv.push_back(curve.at(t).c); };
  add(a);
  for (std::size_t i = 0; i + 1 < curve.t.size(); ++i)
    for (int k = 0; k < parts_of_span; ++k)
      if (const double t = curve.t[i] + (curve.t[i + 1] - curve.t[i]) * k / parts_of_span; t > a && t < b) add(t);
  add(b);
  return samples;
}

/// Shares of two segments at which their lines cross; false if they are parallel or cross beyond the ends.
bool crossing(const Vec2& p, const Vec2& p_end, const Vec2& q, const Vec2& q_end, double& s, double& r) {
  if (std::max(p.x(), p_end.x()) < std::min(q.x(), q_end.x()) || std::max(q.x(), q_end.x()) < std::min(p.x(), p_end.x()) ||
      std::max(p.y(), p_end.y()) < std::min(q.y(), q_end.y()) || std::max(q.y(), q_end.y()) < std::min(p.y(), p_end.y()))
    return false;
  const Vec2 d = p_end - p, e = q_end - q, f = q - p;
  const double det = cross(d, e);
  if (!(std::abs(det) > 1e-14 * norm(d) * norm(e))) return false;
  constexpr double beyond = 1e-9;
  s = cross(f, e) / det, r = cross(f, d) / det;
  return s >= -beyond && s <= 1 + beyond && r >= -beyond && r <= 1 + beyond;
}

/// Newton's method for c(t) = d(s), from a crossing of chords.
template <typename Curve, typename Other>
void meet(const Curve& c, const Other& d, Interval of_t, Interval of_s, double& t, double& s) {
  for (int k = 0; k < 12; ++k) {
    const CurveJet p = c(t), q = d(s);
    const Vec2 r = q.c - p.c;
    const double det = cross(p.ct, q.ct);
    if (det == 0) return;
    const double dt = cross(r, q.ct) / det, ds = cross(r, p.ct) / det;
    t = std::clamp(t + dt, of_t.a, of_t.b), s = std::clamp(s + ds, of_s.a, of_s.b);
    if (std::abs(dt) <= 1e-15 * (of_t.b - of_t.a) && std::abs(ds) <= 1e-15 * (of_s.b - of_s.a)) return;
  }
}

/// The part of a curve between two parameters.
EmbeddedCurve part_of_curve(const EmbeddedCurve& curve, double a, double b) {
  std::vector<double> t{a};
  for (const double at : curve.t)
    if (at > a && at < b) t.push_back(at);
  t.push_back(b);
  EmbeddedCurve part;
  for (std::size_t i = 0; i < t.size(); ++i) {
    part.t.push_back(t[i]), part.uv.push_back(curve.at(t[i]).c);
    if (i == 0) continue;
    // The span that holds the middle has both derivatives.
    const auto behind = std::upper_bound(curve.t.begin() + 1, curve.t.end() - 1, (t[i - 1] + t[i]) / 2);
    const auto k = static_cast<std::size_t>(behind - curve.t.begin()) - 1;
    part.start.push_back(t[i - 1] == curve.t[k] ? curve.start[k] : curve.at(t[i - 1]).ct);
    part.finish.push_back(t[i] == curve.t[k + 1] ? curve.finish[k] : curve.at(t[i]).ct);
  }
  return part;
}

}  // namespace

Embedder::Embedder(std::shared_ptr<Cad> cad, std::shared_ptr<const discrete::DiscreteCad> triangles, Model model, EmbeddedCurves curves, int threads,
                   Monitor& monitor)
    : cad_(std::move(cad)),
      monitor_(monitor),
      threads_(threads),
      model_(std::move(model)),
      curves_(std::move(curves)),
      projector_(std::make_shared<EmbeddedCad>(cad_, curves_), std::move(triangles), without_wires(model_)) {
  for (const Face& face : model_.faces) {
    if (!face.left_out.empty() || face.is_wire()) continue;
    has_curves_ = has_curves_ || !face.curves.empty();
    has_points_ = has_points_ || !face.curves.empty() || !face.points.empty();
  }
  diagonal_ = projector_.diagonal(threads_, monitor_);
  const LargestReferences largest = largest_references(model_);
  last_curve_ = largest.curve, last_point_ = largest.point;
}

std::size_t Embedder::index_of(int face) const {
  for (std::size_t f = 0; f < model_.faces.size(); ++f)
    if (model_.faces[f].ref == face && !model_.faces[f].is_wire()) return f;
  throw InvalidArgument("the model has no face with the reference " + std::to_string(face));
}

Ground Embedder::ground(double tolerance) {
  Ground ground;
  ground.closest = [this](int dimension, const Vec3& x, int ref) -> Ground::Place {
    ProjectedPoint found;
    projector_.project(dimension, ref, {&x, 1}, {&found, 1}, 1, monitor_);
    if (dimension == 2 && model_.faces[index_of(found.ref)].discrete)
      throw InvalidArgument(Where{.face = found.ref}, "it is given by triangles, in which no point or curve can be embedded");
    return {found.ref, found.parameters, found.xyz, found.distance};
  };
  ground.surface = [this](int face, unsigned want, const Vec2& uv) { return surface_at(*cad_, face, want, uv); };
  ground.border = [this](int face, int other, const Vec3& a, const Vec3& b, Vec3& y) { return border(face, other, a, b, y); };
  ground.other_face = [this](int curve, std::span<const Vec3> points) {
    for (const Face& face : model_.faces) {
      if (face.is_wire() || face.discrete || !face.left_out.empty()) continue;
      if (std::any_of(face.curves.begin(), face.curves.end(), [&](const FaceCurve& each) { return origin(each.ref) == curve; })) continue;
      const bool on = std::all_of(points.begin(), points.end(), [&](const Vec3& x) {
        ProjectedPoint found;
        projector_.project(2, face.ref, {&x, 1}, {&found, 1}, 1, monitor_);
        return found.distance <= limit::same_place * diagonal_;
      });
      if (on) return face.ref;
    }
    return 0;
  };
  ground.has = [this](int face, int curve) {
    const std::vector<FaceCurve>& curves = model_.faces[index_of(face)].curves;
    return std::any_of(curves.begin(), curves.end(), [&](const FaceCurve& each) { return origin(each.ref) == curve; });
  };
  ground.has_curves = has_curves_, ground.has_points = has_points_;
  ground.diagonal = diagonal_;
  ground.tolerance = tolerance;
  return ground;
}

Interval Embedder::interval(const Use& use) const {
  const Face& face = model_.faces[use.face];
  const FaceCurve& curve = face.curves[use.curve];
  if (curve.part_of != 0) return {curve.part_a, curve.part_b};
  const auto own = curves_.find({face.ref, static_cast<int>(use.curve) + 1});
  if (own != curves_.end()) return {own->second->t.front(), own->second->t.back()};
  return cad_->curve_interval(face.ref, static_cast<int>(use.curve) + 1);
}

Embedder::Place Embedder::at(const Use& use, double t) const {
  const Face& face = model_.faces[use.face];
  const int rank = host_rank(face, use.curve);
  const auto own = curves_.find({face.ref, rank});
  const CurveJet jet = own != curves_.end() ? own->second->at(t) : cad_->curve(face.ref, rank, want_position | want_first, t);
  const SurfaceJet s = surface_at(*cad_, face.ref, want_position | want_first, jet.c);
  return {t, 0, jet.c, s.s, Vec3(jet.ct.x() * s.su + jet.ct.y() * s.sv)};
}

// Gauss and Newton's method from the nearest of some samples: places that are sought lie on the curve, or nearly.
Embedder::Place Embedder::nearest(const Use& use, const Vec3& x) const {
  const auto [a, b] = interval(use);
  constexpr int n = limit::samples_of_curve;
  const auto measured = [&](double t) {
    Place place = at(use, t);
    place.distance = norm(place.xyz - x);
    return place;
  };
  Place best;
  best.distance = infinity;
  for (int i = 0; i < n; ++i)
    if (const Place place = measured(i + 1 < n ? a + i * (b - a) / (n - 1) : b); place.distance < best.distance) best = place;
  for (int k = 0; k < 40; ++k) {
    const double speed = dot(best.tangent, best.tangent);
    if (!(speed > 0)) break;
    double way = dot(x - best.xyz, best.tangent) / speed;
    Place next;
    bool better = false;
    for (int h = 0; h < 8 && !better; ++h, way /= 2) {
      next = measured(std::clamp(best.t + way, a, b));
      better = next.distance < best.distance;
    }
    if (!better) break;
    best = next;
  }
  return best;
}

bool Embedder::border(int face, int other, const Vec3& a, const Vec3& b, Vec3& y) const {
  const std::size_t f = index_of(face), g = index_of(other);
  std::set<int> common;
  for (const FaceCurve& curve : model_.faces[f].curves) common.insert(curve.ref);
  double least = infinity;
  for (std::size_t c = 0; c < model_.faces[g].curves.size(); ++c) {
    const FaceCurve& curve = model_.faces[g].curves[c];
    if (!common.contains(curve.ref) || curve.type != CurveType::boundary) continue;
    const Use use{g, c};
    const auto [from, to] = interval(use);
    const auto way = [&](const Place& p) { return norm(p.xyz - a) + norm(p.xyz - b); };
    const auto slope = [&](const Place& p) {
      const Vec3 d = (p.xyz - a) / std::max(norm(p.xyz - a), 1e-300), e = (p.xyz - b) / std::max(norm(p.xyz - b), 1e-300);
      return dot(Vec3(d + e), p.tangent);
    };
    constexpr int n = limit::samples_of_curve;
    const double step = (to - from) / (n - 1);
    Place best = at(use, from);
    for (int i = 1; i < n; ++i)
      if (const Place place = at(use, i + 1 < n ? from + i * step : to); way(place) < way(best)) best = place;
    double low = std::max(from, best.t - step), high = std::min(to, best.t + step);
    if (slope(at(use, low)) < 0 && slope(at(use, high)) > 0) {
      for (int k = 0; k < 60; ++k) {
        const double middle = (low + high) / 2;
        (slope(at(use, middle)) < 0 ? low : high) = middle;
      }
      best = at(use, (low + high) / 2);
    }
    if (way(best) < least) least = way(best), y = best.xyz;
  }
  return least < infinity;
}

int Embedder::origin(int curve) const {
  const auto found = origins_.find(curve);
  return found == origins_.end() ? curve : found->second;
}

int Embedder::new_point(const Vec3& x) {
  points_.emplace_back(x, ++last_point_);
  return last_point_;
}

// All faces have the curve in two parts. The first part in the first face keeps its reference.
void Embedder::divide(int curve, const Vec3& x, int point) {
  const int second = ++last_curve_;
  origins_[second] = origin(curve);
  Vec3 direction;
  for (std::size_t f = 0; f < model_.faces.size(); ++f) {
    Face& face = model_.faces[f];
    if (!face.left_out.empty() || face.discrete || face.is_wire()) continue;
    const std::size_t n = face.curves.size();
    for (std::size_t c = 0; c < n; ++c) {
      if (face.curves[c].ref != curve) continue;
      const Place place = nearest({f, c}, x);
      const auto [a, b] = interval({f, c});
      const double size = norm(direction);
      if (size == 0) direction = place.tangent;
      const bool turned = size > 0 && dot(direction, place.tangent) < 0;
      FaceCurve other = face.curves[c];
      FaceCurve& first = face.curves[c];
      const int shown = first.shown_as != 0 ? first.shown_as : first.ref;
      other.part_of = host_rank(face, c), other.part_a = place.t, other.part_b = b, other.end1 = point;
      first.part_of = other.part_of, first.part_a = a, first.part_b = place.t, first.end2 = point;
      (turned ? first : other).ref = second;
      (turned ? first : other).shown_as = shown;
      face.curves.push_back(std::move(other));
    }
  }
}

void Embedder::rename_point(int from, int to) {
  for (Face& face : model_.faces) {
    for (FaceCurve& curve : face.curves)
      for (int* end : {&curve.end1, &curve.end2})
        if (*end == from) *end = to;
    for (FacePoint& point : face.points)
      if (point.ref == from) point.ref = to;
  }
}

// A part of the curve ends at the point, which may have another reference there.
void Embedder::join_end(int curve, const Vec3& x, int point) {
  const double near = limit::same_place * diagonal_;
  for (std::size_t f = 0; f < model_.faces.size(); ++f) {
    if (!model_.faces[f].left_out.empty() || model_.faces[f].discrete) continue;
    for (std::size_t c = 0; c < model_.faces[f].curves.size(); ++c) {
      const FaceCurve& use = model_.faces[f].curves[c];
      if (origin(use.ref) != curve) continue;
      const Place place = nearest({f, c}, x);
      if (place.distance > near) continue;
      const auto [a, b] = interval({f, c});
      for (const bool at_end : {false, true})
        if (norm(at({f, c}, at_end ? b : a).xyz - x) <= near) {
          if (const int ref = at_end ? use.end2 : use.end1; ref != point) rename_point(ref, point);
          return;
        }
      return divide(use.ref, x, point);
    }
  }
}

const FaceCurve* Embedder::part_between(int curve, int point, int other) const {
  for (const Face& face : model_.faces)
    for (const FaceCurve& use : face.curves)
      if (origin(use.ref) == curve && ((use.end1 == point && use.end2 == other) || (use.end1 == other && use.end2 == point))) return &use;
  return nullptr;
}

int Embedder::point_at(const End& end, std::size_t face, Vec2& uv) {
  const Face& of = model_.faces[face];
  const double near = limit::same_place * diagonal_;
  if (end.point != 0) {
    double least = infinity;
    Vec2 best = uv;
    const auto look = [&](const Vec2& at) {
      if (const double d = norm(at - uv); d < least) least = d, best = at;
    };
    for (std::size_t c = 0; c < of.curves.size(); ++c) {
      const auto [a, b] = interval({face, c});
      if (of.curves[c].end1 == end.point) look(at({face, c}, a).uv);
      if (of.curves[c].end2 == end.point) look(at({face, c}, b).uv);
    }
    for (const FacePoint& point : of.points)
      if (point.ref == end.point) look(point.uv);
    if (least < infinity) uv = best;
    return end.point;
  }
  if (end.curve != 0) {
    std::optional<Use> use;
    Place best;
    for (std::size_t c = 0; c < of.curves.size(); ++c) {
      if (of.curves[c].ref != end.curve && origin(of.curves[c].ref) != end.curve) continue;
      const Place place = nearest({face, c}, end.at);
      const bool tie = use && std::abs(place.distance - best.distance) <= near;
      if (!use || (tie ? norm(place.uv - uv) < norm(best.uv - uv) : place.distance < best.distance)) use = Use{face, c}, best = place;
    }
    if (use && best.distance <= near) {
      uv = best.uv;
      const FaceCurve curve = of.curves[use->curve];
      const auto [a, b] = interval(*use);
      for (const bool at_end : {false, true})
        if (const Place tip = at(*use, at_end ? b : a); norm(tip.xyz - best.xyz) <= near && std::abs(best.t - tip.t) <= 0.5 * (b - a)) {
          uv = tip.uv;
          return at_end ? curve.end2 : curve.end1;
        }
      const int point = new_point(best.xyz);
      divide(curve.ref, best.xyz, point);
      return point;
    }
  }
  for (const auto& [x, ref] : points_)
    if (norm(x - end.at) <= near) return ref;
  return new_point(end.at);
}

// An end inside of a face may lie on a curve that was embedded before.
void Embedder::touch(End& end, std::size_t face) const {
  if (end.curve != 0 || end.point != 0) return;
  const Face& of = model_.faces[face];
  for (std::size_t c = 0; c < of.curves.size(); ++c)
    if (of.curves[c].type == CurveType::internal && nearest({face, c}, end.at).distance <= limit::same_place * diagonal_) {
      end.curve = of.curves[c].ref;
      return;
    }
}

std::vector<Embedder::Cut> Embedder::cuts_of(const Piece& piece) const {
  const std::size_t f = index_of(piece.face);
  const Face& face = model_.faces[f];
  const double a = piece.curve.t.front(), b = piece.curve.t.back(), near = limit::same_place * diagonal_;
  const Samples own = samples_of(piece.curve, a, b);
  const auto on_piece = [&](double t) { return piece.curve.at(t); };
  const auto inside = [&](double t) { return t - a > near && b - t > near; };
  std::vector<Cut> cuts;
  const auto add = [&](double t, int curve) {
    for (const Cut& cut : cuts)
      if (std::abs(cut.t - t) <= near) return;
    if (inside(t)) cuts.push_back({t, End{surface_at(*cad_, piece.face, want_position, on_piece(t).c).s, curve}});
  };
  double s = 0, r = 0;
  for (std::size_t c = 0; c < face.curves.size(); ++c) {
    if (face.curves[c].type != CurveType::internal) continue;
    const Use use{f, c};
    const Interval of_use = interval(use);
    const auto known = curves_.find({face.ref, host_rank(face, c)});
    const auto on_use = [&](double t) {
      return known != curves_.end() ? known->second->at(t) : cad_->curve(face.ref, host_rank(face, c), want_position | want_first, t);
    };
    Samples other;
    if (known != curves_.end()) {
      other = samples_of(*known->second, of_use.a, of_use.b);
    } else {
      constexpr int n = 2 * limit::samples_of_curve - 1;
      for (int i = 0; i < n; ++i) {
        const double t = i + 1 < n ? of_use.a + i * (of_use.b - of_use.a) / (n - 1) : of_use.b;
        other.t.push_back(t), other.uv.push_back(on_use(t).c);
      }
    }
    for (std::size_t i = 0; i + 1 < own.t.size(); ++i)
      for (std::size_t j = 0; j + 1 < other.t.size(); ++j)
        if (crossing(own.uv[i], own.uv[i + 1], other.uv[j], other.uv[j + 1], s, r)) {
          double t = lerp1(own.t[i], own.t[i + 1], s), t_other = lerp1(other.t[j], other.t[j + 1], r);
          meet(on_piece, on_use, {a, b}, of_use, t, t_other);
          add(t, face.curves[c].ref);
        }
  }
  for (std::size_t i = 0; i + 1 < own.t.size(); ++i)
    for (std::size_t j = i + 2; j + 1 < own.t.size(); ++j)
      if (crossing(own.uv[i], own.uv[i + 1], own.uv[j], own.uv[j + 1], s, r)) {
        double t = lerp1(own.t[i], own.t[i + 1], s), t_other = lerp1(own.t[j], own.t[j + 1], r);
        meet(on_piece, on_piece, {own.t[i], own.t[i + 1]}, {own.t[j], own.t[j + 1]}, t, t_other);
        add(t, 0), add(t_other, 0);
      }
  std::sort(cuts.begin(), cuts.end(), [](const Cut& p, const Cut& q) { return p.t < q.t; });
  return cuts;
}

void Embedder::place(const Piece& piece, int& whole) {
  const std::size_t f = index_of(piece.face);
  std::vector<Cut> cuts = cuts_of(piece);
  cuts.insert(cuts.begin(), Cut{piece.curve.t.front(), piece.begin});
  cuts.push_back({piece.curve.t.back(), piece.end});
  for (Cut& cut : cuts) touch(cut.end, f);
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    EmbeddedCurve curve = part_of_curve(piece.curve, cuts[i].t, cuts[i + 1].t);
    FaceCurve added{.type = CurveType::internal};
    added.end1 = point_at(cuts[i].end, f, curve.uv.front());
    added.end2 = point_at(cuts[i + 1].end, f, curve.uv.back());
    const FaceCurve* joined = nullptr;
    if (piece.along != 0) {
      join_end(piece.along, cuts[i].end.at, added.end1), join_end(piece.along, cuts[i + 1].end.at, added.end2);
      joined = part_between(piece.along, added.end1, added.end2);
    }
    added.ref = joined != nullptr ? joined->ref : ++last_curve_;
    if (joined != nullptr) whole = joined->shown_as != 0 ? joined->shown_as : joined->ref;
    if (whole == 0) whole = added.ref;
    if (whole != added.ref) added.shown_as = whole;
    Face& face = model_.faces[f];
    std::erase_if(face.points, [&](const FacePoint& point) { return point.ref == added.end1 || point.ref == added.end2; });
    face.curves.push_back(added);
    curves_[{face.ref, static_cast<int>(face.curves.size())}] = std::make_shared<const EmbeddedCurve>(std::move(curve));
  }
}

int Embedder::embed_point(const Vec3& x, double tolerance) {
  const Ground on = ground(tolerance);
  if (!is_finite(x)) throw InvalidArgument("a coordinate of the point is not finite");
  const Ground::Place place = on.closest(2, x, 0);
  if (!(place.distance <= on.tolerance)) embedding::report_far("the point", x, place, on.tolerance);
  End end{place.xyz};
  if (has_points_)
    if (const Ground::Place near = on.closest(0, x, 0); near.distance <= on.tolerance) return near.ref;
  if (has_curves_)
    if (const Ground::Place near = on.closest(1, x, 0); near.distance <= on.tolerance) end = {near.xyz, near.ref};
  const std::size_t f = index_of(place.ref);
  touch(end, f);
  Vec2 uv = place.uv;
  const int point = point_at(end, f, uv);
  if (end.curve == 0) model_.faces[f].points.push_back({.ref = point, .uv = uv});
  return point;
}

void Embedder::restore(Content content) {
  model_ = std::move(content.model), curves_ = std::move(content.curves);
  origins_ = std::move(content.origins), points_ = std::move(content.points);
}

int Embedder::embed_polyline(std::span<const Vec3> points, double tolerance) {
  Content before = content();
  try {
    const Ground on = ground(tolerance);
    int whole = 0;
    for (const Piece& piece : embedding::trace(on, points)) place(piece, whole);
    return whole;
  } catch (...) {
    restore(std::move(before));
    throw;
  }
}

// Chords of a curve that leave it by at most a small share of the diagonal.
std::vector<Vec3> Embedder::points_of(const Use& use) const {
  const auto [a, b] = interval(use);
  std::vector<Vec3> points{at(use, a).xyz};
  const std::function<void(double, double, const Vec3&, int)> add = [&](double from, double to, const Vec3& end, int depth) {
    const double middle = (from + to) / 2;
    const Vec3 between = at(use, middle).xyz, start = points.back();
    if (depth < limit::divisions_of_wire && (depth < 2 || norm(between - (start + end) / 2) > limit::chord_of_wire * diagonal_)) {
      add(from, middle, between, depth + 1);
      add(middle, to, end, depth + 1);
    } else {
      points.push_back(end);
    }
  };
  add(a, b, at(use, b).xyz, 0);
  const FaceCurve& curve = model_.faces[use.face].curves[use.curve];
  if (curve.end1 == curve.end2) points.back() = points.front();
  return points;
}

void Embedder::embed_wire(std::size_t wire, double tolerance) {
  const Face known = model_.faces[wire];
  for (std::size_t c = 0; c < known.curves.size(); ++c) {
    const int ref = embed_polyline(points_of({wire, c}), tolerance);
    const auto name = model_.names.curves.find(known.curves[c].ref);
    const std::string own = name != model_.names.curves.end() ? name->second : known.name;
    if (!own.empty()) set_name(1, ref, own);
  }
}

int Embedder::embed_wires(double tolerance, std::vector<std::string>& remarks) {
  int count = 0;
  for (std::size_t f = 0; f < model_.faces.size();) {
    if (!model_.faces[f].is_wire() || !model_.faces[f].left_out.empty()) {
      ++f;
      continue;
    }
    Content before = content();
    try {
      embed_wire(f, tolerance);
      model_.faces.erase(model_.faces.begin() + static_cast<std::ptrdiff_t>(f));
      ++count;
    } catch (const InvalidArgument& error) {
      restore(std::move(before));
      remarks.push_back("wire " + std::to_string(model_.faces[f].ref) + " is not embedded: " + error.what());
      ++f;
    }
  }
  return count;
}

}  // namespace carreau
