// SPDX-License-Identifier: BSD-3-Clause
#include "assembly/common_area.h"

#include <algorithm>
#include <cmath>

namespace carreau_occ {
namespace {

/// The deepest division of a strip, and the share of the largest coordinate below which a length is linear.
constexpr int deepest_division = 20;
constexpr double linear = 1e-12;

using Segments = std::vector<Segment>;

/// From the lower to the upper end; level segments bound no length.
Segments upward(const Segments& given, double low, double high) {
  Segments all;
  for (Segment s : given) {
    if (s.a[1] > s.b[1]) std::swap(s.a, s.b);
    if (s.a[1] < s.b[1] && s.b[1] > low && s.a[1] < high) all.push_back(s);
  }
  std::sort(all.begin(), all.end(), [](const Segment& s, const Segment& t) { return s.a[1] < t.a[1]; });
  return all;
}

double extreme(const Segments& all, bool highest) {
  double y = highest ? -HUGE_VAL : HUGE_VAL;
  for (const Segment& s : all) y = highest ? std::max({y, s.a[1], s.b[1]}) : std::min({y, s.a[1], s.b[1]});
  return y;
}

double crossing(const Segment& s, double y) {
  return std::lerp(s.a[0], s.b[0], std::clamp((y - s.a[1]) / (s.b[1] - s.a[1]), 0.0, 1.0));
}

/// The segments that cross a strip, for strips that ascend.
class Active {
 public:
  explicit Active(const Segments& all) : all_(all) {}

  void move_to(double low, double high) {
    const double middle = (low + high) / 2;
    for (; next_ < all_.size() && all_[next_].a[1] < middle; ++next_) now_.push_back(next_);
    std::erase_if(now_, [&](std::size_t k) { return all_[k].b[1] < middle; });
  }
  void at(double y, std::vector<double>& x) const {
    x.clear();
    for (const std::size_t k : now_) x.push_back(crossing(all_[k], y));
    std::sort(x.begin(), x.end());
  }

 private:
  const Segments& all_;
  std::size_t next_ = 0;
  std::vector<std::size_t> now_;
};

class Sweep {
 public:
  Sweep(const Segments& p, const Segments& q) : p_(p), q_(q) {
    for (const Segments* all : {&p, &q})
      for (const Segment& s : *all) rounding_ = std::max({rounding_, linear * std::abs(s.a[0]), linear * std::abs(s.b[0])});
  }

  double strip(double low, double high) {
    p_.move_to(low, high), q_.move_to(low, high);
    return integral(low, length(low), high, length(high), 0);
  }
  [[nodiscard]] const std::array<double, 2>& inside() const { return inside_; }

 private:
  double length(double y) {
    p_.at(y, xp_), q_.at(y, xq_);
    double sum = 0;
    for (std::size_t i = 0, k = 0; i + 1 < xp_.size() && k + 1 < xq_.size();) {
      const double begin = std::max(xp_[i], xq_[k]), end = std::min(xp_[i + 1], xq_[k + 1]);
      if (end > begin) {
        sum += end - begin;
        if (end - begin > longest_) longest_ = end - begin, inside_ = {(begin + end) / 2, y};
      }
      (xp_[i + 1] < xq_[k + 1] ? i : k) += 2;
    }
    return sum;
  }

  /// The length is linear in y but where borders of both regions cross.
  double integral(double low, double at_low, double high, double at_high, int depth) {
    const double middle = (low + high) / 2, at_middle = length(middle), mean = (at_low + at_high) / 2;
    if (depth >= deepest_division) return mean * (high - low);
    // Two kinks may be symmetric about the middle.
    constexpr double elsewhere = 0.3;
    if (std::abs(at_middle - mean) <= rounding_ &&
        std::abs(length(std::lerp(low, high, elsewhere)) - std::lerp(at_low, at_high, elsewhere)) <= rounding_)
      return mean * (high - low);
    return integral(low, at_low, middle, at_middle, depth + 1) + integral(middle, at_middle, high, at_high, depth + 1);
  }

  Active p_, q_;
  std::vector<double> xp_, xq_;
  double longest_ = 0, rounding_ = 0;
  std::array<double, 2> inside_{};
};

}  // namespace

double common_area(const Segments& p, const Segments& q, std::array<double, 2>& inside) {
  const double low = std::max(extreme(p, false), extreme(q, false)), high = std::min(extreme(p, true), extreme(q, true));
  if (!(low < high)) return 0;
  const Segments up = upward(p, low, high), uq = upward(q, low, high);
  std::vector<double> levels{low, high};
  for (const Segments* all : {&up, &uq})
    for (const Segment& s : *all)
      for (const double y : {s.a[1], s.b[1]})
        if (y > low && y < high) levels.push_back(y);
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  Sweep sweep(up, uq);
  double area = 0;
  for (std::size_t i = 0; i + 1 < levels.size(); ++i) area += sweep.strip(levels[i], levels[i + 1]);
  inside = sweep.inside();
  return area;
}

}  // namespace carreau_occ
