// SPDX-License-Identifier: BSD-3-Clause
#include "kinematics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pieces.h"

namespace carreau::testing {

using namespace variable;

namespace {

Vec2 centre_of(const Piece& piece, std::size_t t) {
  const auto& v = piece.triangles[t];
  return (piece.vertices[static_cast<std::size_t>(v[0])] + piece.vertices[static_cast<std::size_t>(v[1])] +
          piece.vertices[static_cast<std::size_t>(v[2])]) /
         3;
}

/// Distance of p from the line through c along d (a unit vector), and the abscissa on it.
struct OnLine {
  double across, along;
};
OnLine on_line(const Vec2& p, const Vec2& c, const Vec2& d) { return {cross(d, p - c), dot(d, p - c)}; }

/// Smoothly from 0 to 1 while x goes from -1 to 1.
double step_of(double x) {
  const double t = std::clamp((x + 1) / 2, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

class Brazilian final : public Kinematics {
 public:
  Brazilian() {
    input_ = input_of(disc({0, 25}, 25, 3), 1, 6);
    input_.step = increment;
    input_.keep_all_parts = true;
    input_.damage.assign(input_.piece.triangles.size(), 0);
    input_.tools = {Tool{{{100, 0}, {-100, 0}}, {}, false}, Tool{{{-100, 50}, {100, 50}}, {}, false}};
    // Solids on the left: below the first, which runs to the left, is its left side.
    add_fields();
  }
  const RemeshInput& advance() override {
    moved_ += increment;
    const double height = 50 - moved_, before = height + increment;
    const double crack = crack_length();
    input_.displacement.clear();
    for (Vec2& p : input_.piece.vertices) {
      const Vec2 old = p;
      // Four fifths of the tool's motion, so that it comes upon more and more of the piece.
      const double strain = 0.8 * increment / before;
      p += strain * Vec2{p.x(), before / 2 - p.y()};
      p.y() -= increment / 2;
      if (crack > 0) p += opening(p, height, crack);
      p.y() = std::clamp(p.y(), 0.0, height);
      input_.displacement.emplace_back(p - old);
    }
    input_.tools[1].points = {{-100, height}, {100, height}};
    set_damage(height, crack);
    return input_;
  }

 private:
  static constexpr double increment = 0.1;

  void add_fields() {
    RemeshField place{.name = "place", .kind = FieldKind::nodal, .components = 2, .values = {}};
    for (const Vec2& p : input_.piece.vertices) place.values.insert(place.values.end(), {p.x(), p.y()});
    RemeshField density{.name = "mass", .kind = FieldKind::element_conserved, .components = 1, .values = {}};
    density.values.assign(input_.piece.triangles.size(), 1);
    input_.fields = {place, density};
  }
  /// Half of it, along a band from the centre.
  [[nodiscard]] double crack_length() const { return moved_ < 20 ? 0 : 2 + (moved_ - 20) * 25; }
  [[nodiscard]] Vec2 band(double height, int which) const {
    const Vec2 d{which == 0 ? 1. : -1., height / 50};
    return d / norm(d);
  }
  /// The two sides of the crack part, more where it has been open for long.
  [[nodiscard]] Vec2 opening(const Vec2& p, double height, double crack) const {
    const Vec2 d = band(height, 0);
    const auto [across, along] = on_line(p, {0, height / 2}, d);
    const double reach = std::max(0.0, 1 - std::pow(along / crack, 2));
    return std::copysign(0.03 * std::sqrt(reach), across) * Vec2{-d.y(), d.x()};
  }
  void set_damage(double height, double crack) {
    for (std::size_t t = 0; t < input_.piece.triangles.size(); ++t) {
      const Vec2 p = centre_of(input_.piece, t);
      double damage = 0;
      for (int which = 0; which < 2; ++which) {
        const auto [across, along] = on_line(p, {0, height / 2}, band(height, which));
        damage = std::max(damage, std::min(0.95, moved_ / 20) * std::exp(-std::pow(across / 3, 2)));
        if (which == 0 && std::abs(along) < crack && std::abs(across) < 0.6) damage = 1;
      }
      input_.damage[t] = damage;
    }
  }
};

class Cutting final : public Kinematics {
 public:
  Cutting() {
    const std::vector<Vec2> block = polygon({{-40, 0}, {0, 0}, {0, 12}, {-40, 12}}, 2);
    input_ = input_of(meshed({block}, [](Vec2) { return 2.; }), 0.1, 10);
    input_.step = increment;
    input_.keep_all_parts = true;
    input_.damage.assign(input_.piece.triangles.size(), 0);
    input_.imposed_smoothing = 2;
    input_.tools = {tool()};
  }
  const RemeshInput& advance() override {
    moved_ += increment;
    input_.tools = {tool()};
    const Tools tools(input_.tools);
    input_.displacement.clear();
    for (Vec2& p : input_.piece.vertices) {
      const Vec2 old = p;
      p += velocity(p) * increment;
      if (const ToolPlace place = tools.nearest(p); place.in_solid) p = place.point;
      input_.displacement.emplace_back(p - old);
    }
    set_damage();
    return input_;
  }

 private:
  static constexpr double increment = 0.05;  // half the least size
  static constexpr double depth = 2, top = 12, rake = 5 * std::numbers::pi / 180, radius = 0.2;
  static constexpr double clearance = 8 * std::numbers::pi / 180, shear = 30 * std::numbers::pi / 180;

  /// The place at which rake and clearance faces would meet without the radius: it comes from the right, at the height
  /// of the cut.
  [[nodiscard]] Vec2 tip() const { return {1 - moved_, top - depth}; }
  [[nodiscard]] Tool tool() const {
    const Vec2 up{std::sin(rake), std::cos(rake)}, back{std::cos(clearance), std::sin(clearance)};
    // From the rake face down to the edge and back along the clearance face: the solid is on the left.
    return {{tip() + 30 * up, tip(), tip() + 30 * back}, {0, radius, 0}, false};
  }
  /// Displacement for a unit one of the tool.
  [[nodiscard]] Vec2 velocity(const Vec2& p) const {
    const Vec2 edge = tip();
    const Vec2 along{-std::cos(shear), std::sin(shear)};  // the shear plane, from the edge up and forwards
    const double behind = cross(along, p - edge) < 0 ? norm_across(p, edge, along) : -norm_across(p, edge, along);
    const double chip_speed = std::sin(shear) / std::cos(shear - rake);
    // It comes nearer to the rake all the time.
    const Vec2 chip = Vec2{-0.96, 0} + chip_speed * Vec2{std::sin(rake), std::cos(rake)};
    const double above = step_of((p.y() - edge.y()) / 0.15);
    // Material that has passed under the edge rests.
    const Vec2 face{std::sin(rake), std::cos(rake)};
    if (p.x() > edge.x() && cross(face, p - edge) < -0.15) return {0, 0};
    return above * step_of(behind / 0.5) * chip;
  }
  static double norm_across(const Vec2& p, const Vec2& c, const Vec2& d) { return std::abs(on_line(p, c, d).across); }
  void set_damage() {
    const Vec2 edge = tip(), along{-std::cos(shear), std::sin(shear)};
    for (std::size_t t = 0; t < input_.piece.triangles.size(); ++t) {
      const Vec2 p = centre_of(input_.piece, t);
      const double across = on_line(p, edge, along).across;
      const bool above = p.y() > edge.y() - 0.3;
      double damage = above ? 0.97 * std::exp(-std::pow(across / 0.6, 2)) : 0;
      const Vec2 d = p - edge;
      if (d.x() > -0.35 && d.x() < 0.2 && std::abs(d.y()) < 0.15) damage = 1;             // before the edge
      if (moved_ > 29.65 && above && d.x() < 0.2 && std::abs(across) < 0.15) damage = 1;  // the chip's base
      input_.damage[t] = damage;
    }
  }
};

}  // namespace

std::unique_ptr<Kinematics> brazilian_test() { return std::make_unique<Brazilian>(); }
std::unique_ptr<Kinematics> orthogonal_cutting() { return std::make_unique<Cutting>(); }

}  // namespace carreau::testing
