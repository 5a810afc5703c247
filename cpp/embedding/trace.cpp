// SPDX-License-Identifier: BSD-3-Clause
#include "embedding/trace.h"

#include <cmath>
#include <numbers>
#include <optional>

#include "embedding/thresholds.h"
#include "model/format_point.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau::embedding {

namespace {

namespace limit = thresholds::embedding;

constexpr unsigned everything = want_position | want_first | want_second;

/// The projection of a place of a chord.
struct Foot {
  double t = 0;
  Vec3 x;
  int face = 0;
  Vec2 uv;
  Vec3 xyz;
  SurfaceJet jet;
};

struct Span {
  Foot from, to;
  Vec2 start, finish;  // derivatives of (u, v)
};

/// A span, or a step to another face or across a seam.
struct Item {
  std::optional<Span> span = {};
  End step = {};
};

/// The projection jumps between places that are apart.
struct Gap {
  Foot before, behind;
};

class Tracer {
 public:
  explicit Tracer(const Ground& ground) : ground_(ground) {}

  std::vector<Piece> trace(std::span<const Vec3> points);

 private:
  [[nodiscard]] double length(double share) const { return share * ground_.diagonal; }
  Foot foot(const Vec3& x, double t, int preferred);
  Vec3 vertex(const Vec3& x, std::size_t rank, bool end);
  void chord(const Vec3& from, const Vec3& to, int depth);
  void refine(const Foot& a, const Foot& b, const Vec3& direction, const Vec3& origin, double t0);
  void step(const Foot& a, const Foot& b);
  static Vec2 slope(const Foot& foot, const Vec3& direction);
  std::vector<Piece> pieces();
  void attach(End& end);
  std::vector<Piece> checked(Piece piece);

  const Ground& ground_;
  std::vector<Item> items_;
  double t_ = 0;  // length of the chords before
  std::optional<Gap> gap_;
  int face_ = 0;  // of the last item; behind a step, the next one
  int projections_ = 0;
  std::size_t rank_ = 0;  // of the chord
};

// The trace stays on the preferred face if faces touch.
Foot Tracer::foot(const Vec3& x, double t, int preferred) {
  // Chords that need more projections do not follow the surface.
  if (++projections_ > 4000)
    throw InvalidArgument("segment " + std::to_string(rank_) + " of the polyline does not follow the faces near " + format_point(x) + ": more points are required");
  Ground::Place place = ground_.closest(2, x, 0);
  if (preferred != 0 && place.ref != preferred)
    if (const Ground::Place other = ground_.closest(2, x, preferred); other.distance <= place.distance + length(limit::jump)) place = other;
  return {t, x, place.ref, place.uv, place.xyz, ground_.surface(place.ref, everything, place.uv)};
}

// An end within the tolerance of a point or curve joins it.
Vec3 Tracer::vertex(const Vec3& x, std::size_t rank, bool end) {
  if (!is_finite(x)) throw InvalidArgument("a coordinate of point " + std::to_string(rank) + " of the polyline is not finite");
  const Ground::Place place = ground_.closest(2, x, 0);
  if (!(place.distance <= ground_.tolerance))
    report_far("point " + std::to_string(rank) + " of the polyline", x, place, ground_.tolerance);
  if (end)
    for (const int dimension : {0, 1}) {
      if (!(dimension == 0 ? ground_.has_points : ground_.has_curves)) continue;
      if (const Ground::Place near = ground_.closest(dimension, x, 0); near.distance <= ground_.tolerance) return near.xyz;
    }
  return place.xyz;
}

// The derivative of the closest point's parameters when the place moves along the chord.
Vec2 Tracer::slope(const Foot& foot, const Vec3& direction) {
  const SurfaceJet& s = foot.jet;
  const Vec3 r = s.s - foot.x;
  const double a = dot(s.su, s.su) + dot(r, s.suu), b = dot(s.su, s.sv) + dot(r, s.suv), c = dot(s.sv, s.sv) + dot(r, s.svv);
  const double p = dot(s.su, direction), q = dot(s.sv, direction), det = a * c - b * b;
  if (!(std::abs(det) > 1e-14 * std::abs(a * c))) return {0, 0};
  return {(c * p - b * q) / det, (a * q - b * p) / det};
}

void Tracer::step(const Foot& a, const Foot& b) {
  if (norm(a.xyz - b.xyz) > length(limit::same_place)) {
    gap_ = Gap{a, b};
    return;
  }
  const Vec3 y = (a.xyz + b.xyz) / 2;
  End end{y};
  if (ground_.has_points)
    if (const Ground::Place near = ground_.closest(0, y, 0); near.distance <= length(limit::same_place)) end.at = near.xyz, end.point = near.ref;
  if (end.point == 0) {
    Ground::Place near;
    if (ground_.has_curves) near = ground_.closest(1, y, 0);
    if (near.ref == 0 || near.distance > length(limit::same_place))
      throw InvalidArgument("the polyline passes " + format_point(y) + " of face " + std::to_string(a.face) + ", where (u, v) is not continuous");
    end.at = near.xyz, end.curve = near.ref;
  }
  items_.push_back({std::nullopt, end});
  face_ = b.face;
}

void Tracer::refine(const Foot& a, const Foot& b, const Vec3& direction, const Vec3& origin, double t0) {
  if (gap_) return;
  const double h = b.t - a.t, t = (a.t + b.t) / 2;
  if (h <= length(limit::jump) && (a.face != b.face || norm(a.uv - b.uv) > 0)) {
    const bool near = a.face == b.face && norm(ground_.surface(a.face, want_position, (a.uv + b.uv) / 2).s - (a.xyz + b.xyz) / 2) <= length(limit::accuracy);
    if (!near) return step(a, b);
    const Vec2 d = (b.uv - a.uv) / h;
    items_.push_back({Span{a, b, d, d}, {}});
    face_ = b.face;
    return;
  }
  const Foot middle = foot(origin + (t - t0) * direction, t, a.face);
  if (a.face == b.face && middle.face == a.face) {
    const Vec2 start = slope(a, direction), finish = slope(b, direction);
    const Vec2 uv = (a.uv + b.uv) / 2 + h / 8 * (start - finish);
    if (norm(ground_.surface(a.face, want_position, uv).s - middle.xyz) <= length(limit::accuracy)) {
      items_.push_back({Span{a, b, start, finish}, {}});
      face_ = b.face;
      return;
    }
  }
  refine(a, middle, direction, origin, t0);
  refine(middle, b, direction, origin, t0);
}

void Tracer::chord(const Vec3& from, const Vec3& to, int depth) {
  const double size = norm(to - from);
  if (size <= length(limit::jump)) return;
  const std::size_t before = items_.size();
  const int face_before = face_;
  gap_.reset();
  const Foot first = foot(from, t_, face_), last = foot(to, t_ + size, first.face);
  refine(first, last, Vec3((to - from) / size), from, t_);
  if (!gap_) {
    t_ += size;
    return;
  }
  const Gap gap = *gap_;
  items_.resize(before), face_ = face_before;
  Vec3 y;
  if (depth >= limit::divisions || gap.before.face == gap.behind.face || !ground_.border(gap.before.face, gap.behind.face, first.xyz, last.xyz, y))
    throw InvalidArgument("segment " + std::to_string(rank_) + " of the polyline leaves the surface at " + format_point(gap.before.x) + ", between face " +
                          std::to_string(gap.before.face) + " and face " + std::to_string(gap.behind.face) + ": more points are required");
  chord(from, y, depth + 1);
  chord(y, to, depth + 1);
}

std::vector<Piece> Tracer::trace(std::span<const Vec3> points) {
  if (points.size() < 2) throw InvalidArgument("a polyline has at least two points, not " + std::to_string(points.size()));
  const bool closed = points.size() > 2 && points.front() == points.back();
  std::vector<Vec3> vertices;
  for (std::size_t i = 0; i < points.size(); ++i)
    vertices.push_back(closed && i + 1 == points.size() ? vertices.front() : vertex(points[i], i, i == 0 || i + 1 == points.size()));
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    rank_ = i - 1, projections_ = 0;
    const std::size_t before = items_.size();
    chord(vertices[i - 1], vertices[i], 0);
    if (before == 0 || before == items_.size()) continue;
    const Item &left = items_[before - 1], &right = items_[before];
    if (!left.span || !right.span || left.span->to.face != right.span->from.face) continue;
    const auto tangent = [](const Foot& at, const Vec2& d) -> Vec3 { return d.x() * at.jet.su + d.y() * at.jet.sv; };
    const Vec3 p = tangent(left.span->to, left.span->finish), q = tangent(right.span->from, right.span->start);
    if (std::atan2(norm(cross(p, q)), dot(p, q)) > limit::corner * std::numbers::pi / 180)
      items_.insert(items_.begin() + static_cast<std::ptrdiff_t>(before), Item{std::nullopt, End{left.span->to.xyz}});
  }
  return pieces();
}

void Tracer::attach(End& end) {
  if (end.curve != 0 || end.point != 0) return;
  if (ground_.has_points)
    if (const Ground::Place near = ground_.closest(0, end.at, 0); near.distance <= length(limit::same_place)) {
      end.point = near.ref;
      return;
    }
  if (ground_.has_curves)
    if (const Ground::Place near = ground_.closest(1, end.at, 0); near.distance <= length(limit::same_place)) end.curve = near.ref;
}

// A piece along a curve of another face joins it. The piece may have been found on a sheet whose foot lies on a body.
std::vector<Piece> Tracer::checked(Piece piece) {
  if (!ground_.has_curves) return {piece};
  int along = 0;
  for (const double share : {0.31, 0.5, 0.77}) {
    const double t = piece.curve.t.front() + share * (piece.curve.t.back() - piece.curve.t.front());
    const Ground::Place near = ground_.closest(1, ground_.surface(piece.face, want_position, piece.curve.at(t).c).s, 0);
    if (near.distance > length(limit::same_place)) return {piece};
    along = near.ref;
  }
  if (!ground_.has(piece.face, along)) {
    piece.along = along;
    return {piece};
  }
  std::vector<Vec3> points;
  for (const Vec2& uv : piece.curve.uv) points.push_back(ground_.surface(piece.face, want_position, uv).s);
  if (const int other = ground_.other_face(along, points); other != 0) {
    Ground on_other = ground_;
    on_other.closest = [this, other](int dimension, const Vec3& x, int ref) { return ground_.closest(dimension, x, dimension == 2 ? other : ref); };
    return Tracer(on_other).trace(points);
  }
  throw InvalidArgument("the polyline runs along curve " + std::to_string(along) + " of the model from " + format_point(piece.begin.at) + " to " +
                        format_point(piece.end.at));
}

std::vector<Piece> Tracer::pieces() {
  std::vector<Piece> found;
  Piece piece;
  std::optional<End> begin;
  const auto finish = [&](const std::optional<End>& end) {
    if (!piece.curve.t.empty()) {
      if (piece.curve.t.back() - piece.curve.t.front() > length(limit::same_place)) {
        piece.end = *end;
        found.push_back(std::move(piece));
      } else if (!found.empty() && !end) {
        found.back().end = *begin;
      }
    }
    piece = {};
    begin = end;
  };
  Vec3 last;
  for (const Item& item : items_) {
    if (!item.span) {
      finish(item.step);
      continue;
    }
    const Span& span = *item.span;
    last = span.to.xyz;
    EmbeddedCurve& curve = piece.curve;
    if (curve.t.empty()) {
      piece.face = span.from.face, piece.begin = begin ? *begin : End{span.from.xyz};
      curve.t.push_back(span.from.t), curve.uv.push_back(span.from.uv);
    }
    curve.t.push_back(span.to.t), curve.uv.push_back(span.to.uv);
    curve.start.push_back(span.start), curve.finish.push_back(span.finish);
  }
  const End final_end{last};
  if (!piece.curve.t.empty() && piece.curve.t.back() - piece.curve.t.front() > length(limit::same_place)) finish(final_end);
  if (found.empty()) throw InvalidArgument("the points of the polyline are one");
  std::vector<Piece> all;
  for (Piece& each : found) {
    attach(each.begin), attach(each.end);
    for (Piece& part : checked(std::move(each))) all.push_back(std::move(part));
  }
  return all;
}

}  // namespace

void report_far(const std::string& which, const Vec3& x, const Ground::Place& nearest, double tolerance) {
  throw InvalidArgument(which + ", " + format_point(x) + ", is " + format_number(nearest.distance) + " from the nearest face, " +
                        std::to_string(nearest.ref) + ": more than embed_tolerance = " + format_number(tolerance));
}

std::vector<Piece> trace(const Ground& ground, std::span<const Vec3> points) { return Tracer(ground).trace(points); }

}  // namespace carreau::embedding
