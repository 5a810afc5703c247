#include "size/space_gradation.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <span>
#include <utility>

#include "size/gradation.h"

namespace carreau {

namespace {

// Changes below this share are rounding.
constexpr double negligible = 1e-6;
constexpr std::size_t steps_between_checks = 1 << 14;

/// For each sample what it belongs to.
class Incidence {
 public:
  template <std::size_t N>
  Incidence(std::size_t samples, const std::vector<std::array<std::int32_t, N>>& members) : start_(samples + 1, 0) {
    for (const auto& m : members)
      for (const std::int32_t s : m) ++start_[s + 1];
    for (std::size_t s = 0; s < samples; ++s) start_[s + 1] += start_[s];
    of_.resize(N * members.size());
    std::vector<std::int32_t> fill(start_.begin(), start_.end() - 1);
    for (std::size_t k = 0; k < members.size(); ++k)
      for (const std::int32_t s : members[k]) of_[fill[s]++] = static_cast<std::int32_t>(k);
  }
  [[nodiscard]] std::span<const std::int32_t> of(std::int32_t sample) const noexcept {
    return std::span(of_).subspan(static_cast<std::size_t>(start_[sample]),
                                  static_cast<std::size_t>(start_[sample + 1] - start_[sample]));
  }

 private:
  std::vector<std::int32_t> start_, of_;
};

class Bounding {
 public:
  Bounding(SampledField& field, double slope, Monitor& monitor)
      : field_(field),
        slope_(slope),
        monitor_(monitor),
        triangles_(field.samples.size(), field.triangles),
        links_(field.samples.size(), field.links) {
    // The trace: where the parametrisation is degenerate the other direction still tells.
    for (const auto& s : field.samples) h_.push_back(std::sqrt((s.form.a + s.form.c) / (s.metric.a + s.metric.c)));
  }

  std::vector<std::int32_t> run() {
    const std::vector<double> before = h_;
    for (const auto& t : field_.triangles)
      if (too_steep(t))
        for (int i = 0; i < 3; ++i) bound(t, i);
    for (const auto& link : field_.links) {
      bound(link[0], link[1]);
      bound(link[1], link[0]);
    }
    spread();
    std::vector<std::int32_t> changed;
    for (std::size_t s = 0; s < h_.size(); ++s) {
      if (!(h_[s] < before[s])) continue;
      changed.push_back(static_cast<std::int32_t>(s));
      const double k = before[s] / h_[s];
      field_.samples[s].metric = (k * k) * field_.samples[s].metric;
    }
    return changed;
  }

 private:
  /// The triangle rolled into a plane, its first corner at the origin.
  [[nodiscard]] std::array<Vec3, 3> unrolled(const std::array<std::int32_t, 3>& t) const noexcept {
    const auto &a = field_.samples[t[0]], &b = field_.samples[t[1]], &c = field_.samples[t[2]];
    const Metric2 g = (1. / 3) * (a.form + b.form + c.form);
    const double root = std::sqrt(std::max(g.a, 0.)), mixed = root > 0 ? g.b / root : 0;
    const double height = std::sqrt(std::max(g.c - mixed * mixed, 0.));
    const auto place = [&](Vec2 d) { return Vec3{root * d.x + mixed * d.y, height * d.y, 0}; };
    return {Vec3{}, place(b.uv - a.uv), place(c.uv - a.uv)};
  }

  [[nodiscard]] bool too_steep(const std::array<std::int32_t, 3>& t) const noexcept {
    const std::array<Vec3, 3> p = unrolled(t);
    const double area = p[1].x * p[2].y - p[1].y * p[2].x;
    const double b = h_[t[1]] - h_[t[0]], c = h_[t[2]] - h_[t[0]];
    // area times the gradient
    const double x = b * p[2].y - c * p[1].y, y = c * p[1].x - b * p[2].x;
    return !(x * x + y * y <= slope_ * slope_ * area * area);
  }

  void lower(std::int32_t s, double h) {
    if (!(h < (1 - negligible) * h_[s])) return;
    h_[s] = h;
    queue_.emplace(h, s);
  }

  // Corner i by the opposite side.
  void bound(const std::array<std::int32_t, 3>& t, int i) {
    const std::array<Vec3, 3> p = unrolled(t);
    const int a = (i + 1) % 3, b = (i + 2) % 3;
    lower(t[i], size_from_segment(h_[t[a]], h_[t[b]], p[b] - p[a], p[i] - p[a], slope_));
  }

  void bound(std::int32_t from, std::int32_t to) {
    const auto &a = field_.samples[from], &b = field_.samples[to];
    lower(to, h_[from] + slope_ * length(0.5 * (a.form + b.form), b.uv - a.uv));
  }

  // From small to large: few samples are lowered twice.
  void spread() {
    std::size_t steps = 0;
    while (!queue_.empty()) {
      const auto [h, s] = queue_.top();
      queue_.pop();
      if (h != h_[s]) continue;
      if (++steps % steps_between_checks == 0) monitor_.checkpoint();
      for (const std::int32_t k : triangles_.of(s))
        for (int i = 0; i < 3; ++i)
          if (field_.triangles[k][i] != s) bound(field_.triangles[k], i);
      for (const std::int32_t k : links_.of(s)) bound(s, field_.links[k][field_.links[k][0] == s ? 1 : 0]);
    }
  }

  SampledField& field_;
  double slope_;
  Monitor& monitor_;
  Incidence triangles_, links_;
  std::vector<double> h_;
  using Entry = std::pair<double, std::int32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace

std::vector<std::int32_t> bound_slopes(SampledField& field, double slope, Monitor& monitor) {
  return Bounding(field, slope, monitor).run();
}

}  // namespace carreau
