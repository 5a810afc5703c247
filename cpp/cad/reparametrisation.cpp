// SPDX-License-Identifier: BSD-3-Clause
#include "cad/reparametrisation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "cad/difference_cad.h"
#include "support/error.h"
#include "support/pieces.h"

namespace carreau {

namespace {

// Steps of Newton's method or bisection for an inverse: 2^-60 of a piece.
constexpr int max_steps = 60;
constexpr std::size_t batch = 256;

/// Slope between two pieces: the harmonic mean of their slopes, with more weight for the shorter piece.
double slope_between(double h0, double s0, double h1, double s1) noexcept {
  const double a = (h0 + 2 * h1) / (3 * (h0 + h1));
  return s0 * s1 / ((1 - a) * s0 + a * s1);
}

class ReparametrisedCad final : public Cad {
 public:
  ReparametrisedCad(Cad& host, int face, const Reparametrisation& map) : host_(host), face_(face), map_(map) {}

  void surface(int face, unsigned want, std::span<const Vec2> xy, std::span<SurfaceJet> out) override {
    if (face != face_) return host_.surface(face, want, xy, out);
    // Second derivatives along x need the first ones.
    const unsigned asked = (want & want_second) != 0 ? want | want_first : want;
    std::array<Vec2, batch> uv;
    for_pieces(xy.size(), batch, [&](std::size_t begin, std::size_t n) {
      for (std::size_t k = 0; k < n; ++k) uv[k] = map_.to_host(xy[begin + k]);
      host_.surface(face, asked, std::span(uv).first(n), out.subspan(begin, n));
      if ((asked & want_first) == 0) return;
      for (std::size_t k = 0; k < n; ++k) differentiate(xy[begin + k], out[begin + k]);
    });
  }
  Interval curve_interval(int face, int ic) override { return host_.curve_interval(face, ic); }
  CurveJet curve(int face, int ic, unsigned want, double t) override { return host_.curve(face, ic, want, t); }
  std::optional<double> surface_size(int face, Vec2 xy) override { return host_.surface_size(face, host_uv(face, xy)); }
  std::optional<double> curve_size(int face, int ic, double t) override { return host_.curve_size(face, ic, t); }
  std::optional<double> point_size(int point) override { return host_.point_size(point); }
  std::optional<double> surface_radius(int face, Vec2 xy) override {
    return host_.surface_radius(face, host_uv(face, xy));
  }
  std::optional<double> curve_radius(int face, int ic, double t) override { return host_.curve_radius(face, ic, t); }
  [[nodiscard]] bool reentrant() const noexcept override { return host_.reentrant(); }
  [[nodiscard]] CallCounts counts() const noexcept override { return host_.counts(); }
  [[nodiscard]] unsigned surface_gives() const noexcept override { return host_.surface_gives(); }
  [[nodiscard]] unsigned curve_gives() const noexcept override { return host_.curve_gives(); }

 private:
  [[nodiscard]] Vec2 host_uv(int face, const Vec2& xy) const noexcept { return face == face_ ? map_.to_host(xy) : xy; }
  void differentiate(Vec2 xy, SurfaceJet& jet) const noexcept {
    const MonotoneMap::Jet u = map_.u.jet(xy.x()), v = map_.v.jet(xy.y());
    jet.suu = (u.first * u.first) * jet.suu + u.second * jet.su;
    jet.suv = (u.first * v.first) * jet.suv;
    jet.svv = (v.first * v.first) * jet.svv + v.second * jet.sv;
    jet.su = u.first * jet.su;
    jet.sv = v.first * jet.sv;
  }

  Cad& host_;
  int face_;
  const Reparametrisation& map_;
};

}  // namespace

MonotoneMap::MonotoneMap(std::vector<double> x, std::vector<double> u) : x_(std::move(x)), u_(std::move(u)) {
  const std::size_t n = x_.size();
  bool sound = n >= 2 && u_.size() == n;
  for (std::size_t k = 1; sound && k < n; ++k) sound = x_[k] > x_[k - 1] && u_[k] > u_[k - 1];
  if (!sound) throw InvalidArgument("a map of parameters must increase from each of its points to the next");
  const auto width = [&](std::size_t k) { return x_[k + 1] - x_[k]; };
  const auto secant = [&](std::size_t k) { return (u_[k + 1] - u_[k]) / width(k); };
  slope_.resize(n);
  slope_.front() = secant(0), slope_.back() = secant(n - 2);
  for (std::size_t k = 1; k + 1 < n; ++k) slope_[k] = slope_between(width(k - 1), secant(k - 1), width(k), secant(k));
}

// Hermite's cubic about its left end.
MonotoneMap::Jet MonotoneMap::jet_in(std::size_t k, double x) const noexcept {
  const double h = x_[k + 1] - x_[k], s = x - x_[k], secant = (u_[k + 1] - u_[k]) / h;
  const double c2 = (3 * secant - 2 * slope_[k] - slope_[k + 1]) / h,
               c3 = (slope_[k] + slope_[k + 1] - 2 * secant) / (h * h);
  return {std::clamp(u_[k] + s * (slope_[k] + s * (c2 + s * c3)), u_[k], u_[k + 1]),
          slope_[k] + s * (2 * c2 + s * 3 * c3), 2 * c2 + 6 * c3 * s};
}

MonotoneMap::Jet MonotoneMap::jet(double x) const noexcept {
  if (x <= x_.front()) return {u_.front(), slope_.front(), jet_in(0, x_.front()).second};
  if (x >= x_.back()) return {u_.back(), slope_.back(), jet_in(x_.size() - 2, x_.back()).second};
  const auto next = std::upper_bound(x_.begin(), x_.end(), x);
  return jet_in(static_cast<std::size_t>(next - x_.begin()) - 1, x);
}

double MonotoneMap::inverse(double u) const noexcept {
  if (u <= u_.front()) return x_.front();
  if (u >= u_.back()) return x_.back();
  const std::size_t k = static_cast<std::size_t>(std::upper_bound(u_.begin(), u_.end(), u) - u_.begin()) - 1;
  if (u == u_[k]) return x_[k];
  double low = x_[k], high = x_[k + 1];
  double x = low + (high - low) * ((u - u_[k]) / (u_[k + 1] - u_[k]));
  for (int step = 0; step < max_steps; ++step) {
    const Jet at = jet_in(k, x);
    if (at.u == u) break;
    (at.u < u ? low : high) = x;
    const double newton = x - (at.u - u) / at.first;
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    if (next == x || next <= low || next >= high) break;
    x = next;
  }
  return x;
}

std::unique_ptr<Cad> reparametrised(Cad& host, int face, const Reparametrisation& map) {
  auto cad = std::make_unique<ReparametrisedCad>(host, face, map);
  const unsigned gives = host.surface_gives() | want_position;
  if ((gives & (want_first | want_second)) == (want_first | want_second)) return cad;
  auto differences = std::make_unique<DifferenceCad>(std::move(cad), gives, host.curve_gives());
  differences->set_parameter_box(face, {map.u.first(), map.v.first()}, {map.u.last(), map.v.last()});
  return differences;
}

}  // namespace carreau
