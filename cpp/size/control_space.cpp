#include "size/control_space.h"

#include <algorithm>
#include <cmath>

namespace carreau {
namespace {
bool inside(const SampledDomain& d, Vec2 p) {
  bool in = false;
  for (const auto& [i, j] : d.edges) {
    const Vec2 a = d.vertices[i], b = d.vertices[j];
    if (cross(b - a, p - a) == 0 && dot(p - a, p - b) <= 0) return true;
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) in = !in;
  }
  return in;
}
}  // namespace
class ControlSpaceBuilder {
 public:
  static ControlSpace run(const SampledDomain& domain, const MetricSampler& sampler, const ControlSpaceOptions& options,
                          Monitor& monitor) {
    ControlSpace s;
    Vec2 low = domain.vertices[0], high = low;
    for (const Vec2 p : domain.vertices)
      low = {std::min(low.x, p.x), std::min(low.y, p.y)}, high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    s.low_ = low;
    int n = 8;
    std::vector<char> known((n + 1) * (n + 1), 0);
    std::vector<Metric2> nodes((n + 1) * (n + 1));
    const double w = high.x - low.x, h = high.y - low.y;
    for (int level = 0;; ++level) {
      monitor.checkpoint();
      std::vector<Vec2> ask;
      std::vector<int> where;
      std::vector<char> in((n + 1) * (n + 1), 0);
      for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
          const int k = j * (n + 1) + i;
          if (known[k]) continue;
          const Vec2 p{i == n ? high.x : low.x + w * i / n, j == n ? high.y : low.y + h * j / n};
          if (!inside(domain, p)) continue;
          ask.push_back(p), where.push_back(k);
        }
      std::vector<Metric2> got(ask.size());
      if (!ask.empty()) sampler(ask, got);
      s.samples_ += ask.size();
      double worst = level == 0 ? 1 : 0;
      for (std::size_t q = 0; q < ask.size(); ++q) {
        const double floor = 1e-4;
        Metric2 m = got[q];
        m.a = std::max(m.a, floor / (w * w)), m.c = std::max(m.c, floor / (h * h));
        const double big = 0.999999 * std::sqrt(m.a * m.c);
        m.b = std::clamp(m.b, -big, big);
        got[q] = m;
        if (level > 0) {
          const Metric2 g = nodes[where[q]];
          if (g.a > 0)
            worst = std::max(
                {worst, std::abs(g.a / m.a - 1), std::abs(g.c / m.c - 1), std::abs(g.b - m.b) / std::sqrt(m.a * m.c)});
        }
        nodes[where[q]] = m, known[where[q]] = 1;
      }
      // extrapolate outside
      std::vector<char> have = known;
      for (bool any = true; any;) {
        any = false;
        std::vector<char> next = have;
        for (int j = 0; j <= n; ++j)
          for (int i = 0; i <= n; ++i) {
            const int k = j * (n + 1) + i;
            if (have[k]) continue;
            Metric2 sum{0, 0, 0};
            int c = 0;
            for (int dj = -1; dj <= 1; ++dj)
              for (int di = -1; di <= 1; ++di) {
                const int a = i + di, b = j + dj, a2 = i + 2 * di, b2 = j + 2 * dj;
                if (a < 0 || b < 0 || a > n || b > n || !have[b * (n + 1) + a]) continue;
                Metric2 m = nodes[b * (n + 1) + a];
                if (a2 >= 0 && b2 >= 0 && a2 <= n && b2 <= n && have[b2 * (n + 1) + a2]) {
                  const Metric2 f = nodes[b2 * (n + 1) + a2];
                  Metric2 e = 2.0 * m + (-1.0) * f;
                  if (e.a > 0.3 * m.a && e.c > 0.3 * m.c && e.a < 3 * m.a && e.c < 3 * m.c &&
                      determinant(e) > 0.1 * determinant(m))
                    m = e;
                }
                sum = sum + m, ++c;
              }
            if (c) nodes[k] = (1.0 / c) * sum, next[k] = 1, any = true;
          }
        have.swap(next);
      }
      const bool none = std::none_of(have.begin(), have.end(), [](char c) { return c; });
      s.n_ = n;
      if (!none) {
        s.nodes_ = nodes;
        s.scale_ = {n / w, n / h};
        double area = 0;
        for (int j = 0; j < n; ++j)
          for (int i = 0; i < n; ++i) {
            const Vec2 c{low.x + w * (i + .5) / n, low.y + h * (j + .5) / n};
            if (inside(domain, c)) area += std::sqrt(std::max(determinant(s.at(c)), 0.0));
          }
        s.measure_ = area * w * h / n / n / 0.4330127018922193;
      }
      const double budget = std::max(400.0, 1.5 * s.measure_ / 2);
      if (!none && level > 0 &&
          (worst < 0.003 || 4.0 * n * n > budget || 4.0 * n * n > static_cast<double>(options.max_samples)))
        break;
      if (none && n > 500) throw DomainError("no sample falls inside the domain");
      const int m = 2 * n;
      std::vector<Metric2> finer((m + 1) * (m + 1));
      std::vector<char> finer_known((m + 1) * (m + 1), 0);
      for (int j = 0; j <= m; ++j)
        for (int i = 0; i <= m; ++i) {
          const int i0 = i / 2, j0 = j / 2, i1 = (i + 1) / 2, j1 = (j + 1) / 2;
          finer[j * (m + 1) + i] = 0.25 * (nodes[j0 * (n + 1) + i0] + nodes[j0 * (n + 1) + i1] +
                                           nodes[j1 * (n + 1) + i0] + nodes[j1 * (n + 1) + i1]);
          if (i % 2 == 0 && j % 2 == 0) finer_known[j * (m + 1) + i] = known[j0 * (n + 1) + i0];
        }
      nodes.swap(finer), known.swap(finer_known), n = m;
    }
    return s;
  }
};
ControlSpace ControlSpace::build(const SampledDomain& domain, const MetricSampler& sampler,
                                 const ControlSpaceOptions& options, Monitor& monitor) {
  return ControlSpaceBuilder::run(domain, sampler, options, monitor);
}
ControlSpace ControlSpace::constant(Metric2 metric) {
  ControlSpace s;
  s.nodes_.assign(4, metric);
  return s;
}
}  // namespace carreau
