// Small fixed-size vectors: plain numbers, no invariants.
#pragma once

#include <cmath>

namespace carreau {

/// A point or vector of a parameter plane (u, v).
struct Vec2 {
  double x = 0, y = 0;
  friend bool operator==(const Vec2&, const Vec2&) = default;
};

/// A point or vector of space.
struct Vec3 {
  double x = 0, y = 0, z = 0;
  friend bool operator==(const Vec3&, const Vec3&) = default;
};

constexpr Vec2 operator+(Vec2 p, Vec2 q) noexcept { return {p.x + q.x, p.y + q.y}; }
constexpr Vec2 operator-(Vec2 p, Vec2 q) noexcept { return {p.x - q.x, p.y - q.y}; }
constexpr Vec2 operator*(double s, Vec2 p) noexcept { return {s * p.x, s * p.y}; }
constexpr double dot(Vec2 p, Vec2 q) noexcept { return p.x * q.x + p.y * q.y; }
/// Signed area of the parallelogram (p, q). Not for topological decisions: see predicates/.
constexpr double cross(Vec2 p, Vec2 q) noexcept { return p.x * q.y - p.y * q.x; }
inline double norm(Vec2 p) noexcept { return std::sqrt(dot(p, p)); }
inline bool is_finite(Vec2 p) noexcept { return std::isfinite(p.x) && std::isfinite(p.y); }

constexpr Vec3 operator+(Vec3 p, Vec3 q) noexcept { return {p.x + q.x, p.y + q.y, p.z + q.z}; }
constexpr Vec3 operator-(Vec3 p, Vec3 q) noexcept { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
constexpr Vec3 operator*(double s, Vec3 p) noexcept { return {s * p.x, s * p.y, s * p.z}; }
constexpr double dot(Vec3 p, Vec3 q) noexcept { return p.x * q.x + p.y * q.y + p.z * q.z; }
constexpr Vec3 cross(Vec3 p, Vec3 q) noexcept {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}
inline double norm(Vec3 p) noexcept { return std::sqrt(dot(p, p)); }
inline bool is_finite(Vec3 p) noexcept { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// Linear interpolation, exact at both ends.
template <typename V>
constexpr V lerp(V p, V q, double w) noexcept {
  return (1 - w) * p + w * q;
}

}  // namespace carreau
