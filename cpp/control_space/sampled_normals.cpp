// SPDX-License-Identifier: BSD-3-Clause
#include "control_space/sampled_normals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "control_space/thresholds.h"
#include "support/rounding_of.h"
#include "support/shares.h"
#include "support/work_bounds.h"

namespace carreau {

namespace {

using namespace thresholds::control_space;

}  // namespace

/// Sums of a linear least squares fit, in coordinates in which the metric is the identity and the reach is one.
class SampledNormals::Fit {
 public:
  Fit(Metric2 m, double reach) noexcept
      : x_(std::sqrt(m.a) / reach),
        skew_(m.b / std::sqrt(m.a) / reach),
        y_(std::sqrt(std::max(m.c - m.b * m.b / m.a, 0.0)) / reach) {}

  void add(Vec2 d, Vec3 normal) noexcept {
    const double x = x_ * d.x() + skew_ * d.y(), y = y_ * d.y(), r2 = x * x + y * y;
    if (!(r2 < 1)) return;
    ++count_;
    const double w = (1 - r2) * (1 - r2) / (r2 * r2 + rounding_of::heights);
    weight_ += w, px_ += w * x, py_ += w * y, xx_ += w * x * x, xy_ += w * x * y, yy_ += w * y * y;
    sum_ = sum_ + w * normal, sum_x_ = sum_x_ + (w * x) * normal, sum_y_ = sum_y_ + (w * y) * normal;
  }
  [[nodiscard]] int count() const noexcept { return count_; }
  /// Returns whether the samples do not lie on a line.
  [[nodiscard]] bool is_sound() const noexcept {
    // A fit has three coefficients for each coordinate; twice as many samples are enough.
    if (count_ < 6) return false;
    const Moments m = moments();
    return m.xx * m.yy - m.xy * m.xy > shares::negligible * (m.xx + m.yy) * (m.xx + m.yy);
  }
  [[nodiscard]] Vec3 linear() const noexcept {
    const Moments m = moments();
    const double px = px_ / weight_, py = py_ / weight_, det = m.xx * m.yy - m.xy * m.xy;
    const Vec3 mean = (1 / weight_) * sum_, along_x = sum_x_ - px * sum_, along_y = sum_y_ - py * sum_;
    const Vec3 by_x = (1 / det) * (m.yy * along_x - m.xy * along_y);
    const Vec3 by_y = (1 / det) * (m.xx * along_y - m.xy * along_x);
    return unit(mean - px * by_x - py * by_y);
  }
  [[nodiscard]] Vec3 mean() const noexcept { return unit(sum_); }

 private:
  /// About the mean of the places.
  struct Moments {
    double xx, xy, yy;
  };
  [[nodiscard]] Moments moments() const noexcept {
    return {xx_ - px_ * px_ / weight_, xy_ - px_ * py_ / weight_, yy_ - py_ * py_ / weight_};
  }
  static Vec3 unit(const Vec3& n) noexcept {
    const double length = norm(n);
    return length > 0 ? (1 / length) * n : Vec3{};
  }
  double x_, skew_, y_;
  int count_ = 0;
  double weight_ = 0, px_ = 0, py_ = 0, xx_ = 0, xy_ = 0, yy_ = 0;
  Vec3 sum_{}, sum_x_{}, sum_y_{};
};

void SampledNormals::add(Vec2 uv, Vec3 normal) {
  const double length = norm(normal);
  if (!(length > 0) || !std::isfinite(length)) return;
  if (samples_.size() >= max_normals && differ_) return;
  const Vec3 unit = (1 / length) * normal;
  if (!samples_.empty() && !differ_) differ_ = norm(cross(samples_.front().normal, unit)) > rounding_of::sizes;
  if (samples_.size() < max_normals) samples_.push_back({uv, unit});
}

void SampledNormals::index(const ControlSpace& space) {
  space_ = &space;
  if (samples_.empty() || !differ_) return;
  const auto n = static_cast<double>(samples_.size());
  spacing_ = std::sqrt(std::numbers::sqrt3 / 4 * space.measure() / n);
  side_ = std::max(1, static_cast<int>(std::sqrt(n / 2.)));
  Vec2 high = low_ = samples_.front().uv;
  for (const Sample& s : samples_) {
    low_ = low_.cwiseMin(s.uv);
    high = high.cwiseMax(s.uv);
  }
  scale_ = {side_ / std::max(high.x() - low_.x(), std::numeric_limits<double>::min()),
            side_ / std::max(high.y() - low_.y(), std::numeric_limits<double>::min())};
  first_.assign(static_cast<std::size_t>(side_) * side_ + 1, 0);
  const auto bucket = [this](Vec2 uv) { return static_cast<std::size_t>(row(uv.y())) * side_ + column(uv.x()); };
  for (const Sample& s : samples_) ++first_[bucket(s.uv) + 1];
  for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
  std::stable_sort(samples_.begin(), samples_.end(),
                   [&](const Sample& p, const Sample& q) { return bucket(p.uv) < bucket(q.uv); });
}

int SampledNormals::column(double u) const noexcept {
  return static_cast<int>(std::clamp((u - low_.x()) * scale_.x(), 0.0, side_ - 1.0));
}

int SampledNormals::row(double v) const noexcept {
  return static_cast<int>(std::clamp((v - low_.y()) * scale_.y(), 0.0, side_ - 1.0));
}

void SampledNormals::gather(Vec2 uv, Metric2 m, double reach, Fit& fit) const noexcept {
  // The box of the ellipse.
  const double det = std::max(determinant(m), std::numeric_limits<double>::min());
  const double du = reach * std::sqrt(m.c / det), dv = reach * std::sqrt(m.a / det);
  const int left = column(uv.x() - du), right = column(uv.x() + du), top = row(uv.y() + dv);
  for (int j = row(uv.y() - dv); j <= top; ++j) {
    const std::size_t start = static_cast<std::size_t>(j) * side_;
    for (std::int32_t k = first_[start + left]; k < first_[start + right + 1]; ++k)
      fit.add(samples_[k].uv - uv, samples_[k].normal);
  }
}

Vec3 SampledNormals::at(const Vec2& uv) const noexcept {
  if (samples_.empty()) return {};
  if (!differ_) return samples_.front().normal;
  const Metric2 metric = space_->at(uv);
  double reach = spacing_;
  for (int k = 0;; ++k, reach *= reach_growth) {
    Fit fit(metric, reach);
    gather(uv, metric, reach, fit);
    if (fit.is_sound()) return fit.linear();
    if (k == work_bounds::rounds) return fit.mean();
  }
}

}  // namespace carreau
