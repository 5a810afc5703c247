// SPDX-License-Identifier: BSD-3-Clause
#include "control_space/sample_gradation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "control_space/thresholds.h"
#include "gradation/gradation.h"
#include "gradation/metric_grading.h"
#include "gradation/place_fans.h"
#include "gradation/smallest_first.h"
#include "support/incidence.h"
#include "support/rounding_of.h"

namespace carreau {

namespace {

using namespace thresholds::control_space;

/// Common steps of both kinds of bounds: applies all of them once, then, from small to large, the bounds of changed
/// samples, and sets the metrics at the end. Returns the samples that have changed. Members of `bounds`:
/// look_at(t)           bounds the corners of a triangle by each other, as far as necessary;
/// by_corner(s, t)      bounds the other corners of t by s;
/// bound(from, to)      bounds one end of a link by the other one; all of them push() samples that they lower;
/// counts(size, s)      returns whether s still has the size with which it was pushed;
/// apply(s)             gives the sample its metric, and returns whether it has changed.
template <typename Bounds>
std::vector<std::int32_t> bound_all(Bounds bounds, SampledField& field, Monitor& monitor) {
  const Incidence triangles(field.samples.size(), field.triangles), links(field.samples.size(), field.links);
  for (const auto& t : field.triangles) bounds.look_at(t);
  for (const auto& link : field.links) {
    bounds.bound(link[0], link[1]);
    bounds.bound(link[1], link[0]);
  }
  const auto hand_on = [&](std::int32_t s) {
    for (const std::int32_t t : triangles.of(s)) bounds.by_corner(s, field.triangles[t]);
    for (const std::int32_t l : links.of(s)) bounds.bound(s, field.links[l][field.links[l][0] == s ? 1 : 0]);
  };
  bounds.queue().run([&](double size, std::int32_t s) { return bounds.counts(size, s); }, hand_on, monitor);
  std::vector<std::int32_t> changed;
  for (std::int32_t s = 0; s < static_cast<std::int32_t>(field.samples.size()); ++s)
    if (bounds.apply(s)) changed.push_back(s);
  return changed;
}

using Triangle = std::array<std::int32_t, 3>;

class IsotropicBounds {
 public:
  IsotropicBounds(SampledField& field, double slope) : field_(field), slope_(slope) {
    // The trace: it determines the size even if the parametrisation is degenerate in the other direction.
    for (const auto& s : field.samples) h_.push_back(std::sqrt((s.form.a + s.form.c) / (s.metric.a + s.metric.c)));
    before_ = h_;
  }

  void look_at(const Triangle& t) {
    if (too_steep(t))
      for (int i = 0; i < 3; ++i) bound_corner(t, i);
  }
  void by_corner(std::int32_t s, const Triangle& t) {
    for (int i = 0; i < 3; ++i)
      if (t[i] != s) bound_corner(t, i);
  }
  void bound(std::int32_t from, std::int32_t to) {
    const auto &a = field_.samples[from], &b = field_.samples[to];
    lower(to, h_[from] + slope_ * length(0.5 * (a.form + b.form), b.uv - a.uv));
  }
  [[nodiscard]] bool counts(double size, std::int32_t s) const noexcept { return size == h_[s]; }
  [[nodiscard]] SmallestFirst& queue() noexcept { return queue_; }
  bool apply(std::int32_t s) {
    if (!(h_[s] < before_[s])) return false;
    const double k = before_[s] / h_[s];
    field_.samples[s].metric = (k * k) * field_.samples[s].metric;
    return true;
  }

 private:
  /// The triangle rolled into a plane, its first corner at the origin.
  [[nodiscard]] std::array<Vec3, 3> unrolled(const Triangle& t) const noexcept {
    const auto &a = field_.samples[t[0]], &b = field_.samples[t[1]], &c = field_.samples[t[2]];
    const Metric2 g = (1. / 3) * (a.form + b.form + c.form);
    const double root = std::sqrt(std::max(g.a, 0.)), mixed = root > 0 ? g.b / root : 0;
    const double height = std::sqrt(std::max(g.c - mixed * mixed, 0.));
    const auto place = [&](Vec2 d) { return Vec3{root * d.x() + mixed * d.y(), height * d.y(), 0}; };
    return {Vec3{}, place(b.uv - a.uv), place(c.uv - a.uv)};
  }

  [[nodiscard]] bool too_steep(const Triangle& t) const noexcept {
    const std::array<Vec3, 3> p = unrolled(t);
    const double area = p[1].x() * p[2].y() - p[1].y() * p[2].x();
    const double b = h_[t[1]] - h_[t[0]], c = h_[t[2]] - h_[t[0]];
    // area times the gradient
    const double x = b * p[2].y() - c * p[1].y(), y = c * p[1].x() - b * p[2].x();
    return !(x * x + y * y <= slope_ * slope_ * area * area);
  }

  void lower(std::int32_t s, double h) {
    if (!(h < (1 - rounding_of::sizes) * h_[s])) return;
    h_[s] = h;
    queue_.push(h, s);
  }

  // Corner i by the opposite side.
  void bound_corner(const Triangle& t, int i) {
    const std::array<Vec3, 3> p = unrolled(t);
    const int a = (i + 1) % 3, b = (i + 2) % 3;
    lower(t[i], size_from_segment(h_[t[a]], h_[t[b]], p[b] - p[a], p[i] - p[a], slope_));
  }

  SampledField& field_;
  double slope_;
  std::vector<double> h_, before_;
  SmallestFirst queue_;
};

/// A sample in the tangent plane.
struct DirectedSample {
  SurfaceTangents tangents;
  Vec3 normal;
  TangentMetric sizes;
  double log_ratio = 0;
  bool sound = false;

  explicit DirectedSample(const SampledField::Sample& s) noexcept : tangents(s.tangents) {
    const auto there = tangent_metric(jet(), s.metric);
    if (!there) return;
    sizes = *there, sound = true;
    const Vec3 n = cross(tangents.su, tangents.sv);
    normal = (1 / norm(n)) * n;
    set_ratio();
  }
  void set_ratio() noexcept { log_ratio = std::log(sizes.h2 / sizes.h1); }
  /// Lower bound of TangentMetric::matched(), which is convex in the square of the cosine: the tangents at both ends.
  [[nodiscard]] double least(const Vec3& w) const noexcept {
    const double b = dot(w, sizes.d2), t = b * b;
    return std::max(sizes.h1 * (1 + t * log_ratio), sizes.h2 * (1 - (1 - t) * log_ratio));
  }
  [[nodiscard]] SurfaceJet jet() const noexcept {
    SurfaceJet j;
    j.su = tangents.su, j.sv = tangents.sv;
    return j;
  }
  /// Size along an offset of parameters.
  [[nodiscard]] double along(const Vec2& e) const noexcept {
    const Vec3 w = e.x() * tangents.su + e.y() * tangents.sv;
    return sizes.along((1 / norm(w)) * w);
  }
};

class DirectedBounds {
 public:
  DirectedBounds(SampledField& field, double slope) : field_(field), slope_(slope), changed_(field.samples.size(), 0) {
    at_.reserve(field.samples.size());
    for (const auto& s : field.samples) at_.emplace_back(s);
  }

  void look_at(const Triangle& t) {
    for (int i = 0; i < 3; ++i) {
      const std::int32_t a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
      bound(a, b);
      bound(b, a);
      bound_by_middle(a, b, c);
    }
  }
  void by_corner(std::int32_t s, const Triangle& t) {
    for (int i = 0; i < 3; ++i) {
      const std::int32_t to = t[i], other = t[(i + 1) % 3];
      if (to == s) continue;
      bound(s, to);
      bound_by_middle(s, other == s ? t[(i + 2) % 3] : other, to);
    }
  }
  void bound(std::int32_t from, std::int32_t to) {
    if (!at_[from].sound || !at_[to].sound) return;
    const auto &a = field_.samples[from], &b = field_.samples[to];
    const Vec2 e = b.uv - a.uv;
    bound_by(
        to, e, at_[from].along(e), 0.5 * (a.form + b.form), [&](Vec3 w) { return matched(from, w, to); },
        [&](Vec3 w) { return least(from, w, to); });
  }
  [[nodiscard]] bool counts(double size, std::int32_t s) const noexcept { return size == key(s); }
  [[nodiscard]] SmallestFirst& queue() noexcept { return queue_; }
  bool apply(std::int32_t s) {
    if (changed_[s] != 0) field_.samples[s].metric = metric_of(at_[s].jet(), at_[s].sizes);
    return changed_[s] != 0;
  }

 private:
  [[nodiscard]] double key(std::int32_t s) const noexcept { return at_[s].sizes.h1 * at_[s].sizes.h2; }

  /// A tangent of sample `to` rolled over to sample `from`.
  [[nodiscard]] Vec3 rolled(const Vec3& w, std::int32_t to, std::int32_t from) const noexcept {
    return detail::roll(w, at_[to].normal, at_[from].normal);
  }
  [[nodiscard]] double matched(std::int32_t from, const Vec3& w, std::int32_t to) const noexcept {
    return at_[from].sizes.matched(rolled(w, to, from));
  }
  [[nodiscard]] double least(std::int32_t from, const Vec3& w, std::int32_t to) const noexcept {
    return at_[from].least(rolled(w, to, from));
  }

  // `e`: the offset that leads to the sample from where the size along it is `along`; `told` returns the size in a
  // direction there. `least` returns a lower bound, which costs less and mostly suffices.
  template <typename Told, typename Least>
  void bound_by(std::int32_t to, Vec2 e, double along, Metric2 form, const Told& told, const Least& least) {
    TangentMetric& q = at_[to].sizes;
    const double growth = 1 + slope_ * length(form, e) / along;
    const auto limit = [&](double h, Vec3 d) {
      if (h <= growth * least(d)) return h;
      const double most = growth * told(d);
      return h > (1 + directed_rounding) * most ? most : h;
    };
    const double h1 = limit(q.h1, q.d1), h2 = limit(q.h2, q.d2);
    if (h1 == q.h1 && h2 == q.h2) return;
    q.h1 = h1, q.h2 = h2;
    at_[to].set_ratio();
    changed_[to] = 1;
    queue_.push(key(to), to);
  }

  // Bounds from the middle between two samples, where sizes are means.
  void bound_by_middle(std::int32_t a, std::int32_t b, std::int32_t to) {
    if (!at_[a].sound || !at_[b].sound || !at_[to].sound) return;
    const auto &p = field_.samples[a], &q = field_.samples[b], &r = field_.samples[to];
    const Vec2 e = r.uv - lerp(p.uv, q.uv, 0.5);
    bound_by(
        to, e, 0.5 * (at_[a].along(e) + at_[b].along(e)), 0.25 * (p.form + q.form) + 0.5 * r.form,
        [&](Vec3 w) { return 0.5 * (matched(a, w, to) + matched(b, w, to)); },
        [&](Vec3 w) { return 0.5 * (least(a, w, to) + least(b, w, to)); });
  }

  SampledField& field_;
  double slope_;
  std::vector<DirectedSample> at_;
  std::vector<char> changed_;
  SmallestFirst queue_;
};

}  // namespace

std::vector<std::int32_t> bound_slopes_by_direction(SampledField& field, double slope, Monitor& monitor) {
  return bound_all(DirectedBounds(field, slope), field, monitor);
}

std::vector<std::int32_t> bound_slopes(SampledField& field, double slope, Monitor& monitor) {
  return bound_all(IsotropicBounds(field, slope), field, monitor);
}

}  // namespace carreau
