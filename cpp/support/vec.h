// SPDX-License-Identifier: BSD-3-Clause
// Small fixed-size vectors: Eigen's, unaligned, so that arrays of them are arrays of plain numbers.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <concepts>
#include <type_traits>

namespace carreau {

/// A column of n numbers, all 0 at first (EIGEN_INITIALIZE_MATRICES_BY_ZERO). Eigen's functions return expressions that
/// refer to their operands: a result that outlives a statement is declared as a vector, never as `auto`.
template <int n>
using Vec = Eigen::Matrix<double, n, 1, Eigen::DontAlign>;
/// A point or vector of a parameter plane (u, v).
using Vec2 = Vec<2>;
/// A point or vector of space.
using Vec3 = Vec<3>;

#ifndef EIGEN_INITIALIZE_MATRICES_BY_ZERO
#error "vectors without a value must be 0: link carreau_engine"
#endif
static_assert(sizeof(Vec2[2]) == 4 * sizeof(double) && alignof(Vec2) == alignof(double));
static_assert(sizeof(Vec3[2]) == 6 * sizeof(double) && alignof(Vec3) == alignof(double));

// Sums and multiples of points are points: Eigen's expressions give the same numbers and cost a tenth of the build's time.
template <int n>
concept PointSize = n == 2 || n == 3;
template <typename S>
concept Factor = std::is_arithmetic_v<S>;
template <int n>
  requires PointSize<n>
Vec<n> operator+(const Vec<n>& p, const Vec<n>& q) noexcept {
  if constexpr (n == 2)
    return {p.x() + q.x(), p.y() + q.y()};
  else
    return {p.x() + q.x(), p.y() + q.y(), p.z() + q.z()};
}
template <int n>
  requires PointSize<n>
Vec<n> operator-(const Vec<n>& p, const Vec<n>& q) noexcept {
  if constexpr (n == 2)
    return {p.x() - q.x(), p.y() - q.y()};
  else
    return {p.x() - q.x(), p.y() - q.y(), p.z() - q.z()};
}
template <int n>
  requires PointSize<n>
Vec<n> operator-(const Vec<n>& p) noexcept {
  if constexpr (n == 2)
    return {-p.x(), -p.y()};
  else
    return {-p.x(), -p.y(), -p.z()};
}
template <Factor S, int n>
  requires PointSize<n>
Vec<n> operator*(S s, const Vec<n>& p) noexcept {
  if constexpr (n == 2)
    return {s * p.x(), s * p.y()};
  else
    return {s * p.x(), s * p.y(), s * p.z()};
}
template <Factor S, int n>
  requires PointSize<n>
Vec<n> operator*(const Vec<n>& p, S s) noexcept {
  if constexpr (n == 2)
    return {p.x() * s, p.y() * s};
  else
    return {p.x() * s, p.y() * s, p.z() * s};
}
template <Factor S, int n>
  requires PointSize<n>
Vec<n> operator/(const Vec<n>& p, S s) noexcept {
  if constexpr (n == 2)
    return {p.x() / s, p.y() / s};
  else
    return {p.x() / s, p.y() / s, p.z() / s};
}

// Eigen's own dot() and norm() sum in an order that depends on the processor; these sum from left to right.
inline double dot(const Vec2& p, const Vec2& q) noexcept { return p.x() * q.x() + p.y() * q.y(); }
/// Signed area of the parallelogram (p, q). Not for topological decisions: see predicates/.
inline double cross(const Vec2& p, const Vec2& q) noexcept { return p.x() * q.y() - p.y() * q.x(); }
inline double norm(const Vec2& p) noexcept { return std::sqrt(dot(p, p)); }
inline bool is_finite(const Vec2& p) noexcept { return std::isfinite(p.x()) && std::isfinite(p.y()); }

inline double dot(const Vec3& p, const Vec3& q) noexcept { return p.x() * q.x() + p.y() * q.y() + p.z() * q.z(); }
inline Vec3 cross(const Vec3& p, const Vec3& q) noexcept {
  return {p.y() * q.z() - p.z() * q.y(), p.z() * q.x() - p.x() * q.z(), p.x() * q.y() - p.y() * q.x()};
}
inline double norm(const Vec3& p) noexcept { return std::sqrt(dot(p, p)); }
inline bool is_finite(const Vec3& p) noexcept {
  return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z());
}

// Matches expressions, which would fit both sizes.
template <typename P>
concept VectorLike = std::derived_from<P, Eigen::MatrixBase<P>> && (P::ColsAtCompileTime == 1);
template <typename P>
concept VectorExpression = VectorLike<P> && !std::same_as<P, Vec<P::RowsAtCompileTime>>;
template <VectorLike P, VectorLike Q>
  requires(VectorExpression<P> || VectorExpression<Q>)
double dot(const P& p, const Q& q) noexcept {
  return dot(Vec<P::RowsAtCompileTime>(p), Vec<Q::RowsAtCompileTime>(q));
}
template <VectorLike P, VectorLike Q>
  requires(VectorExpression<P> || VectorExpression<Q>)
auto cross(const P& p, const Q& q) noexcept {
  return cross(Vec<P::RowsAtCompileTime>(p), Vec<Q::RowsAtCompileTime>(q));
}
template <VectorExpression P>
double norm(const P& p) noexcept {
  return norm(Vec<P::RowsAtCompileTime>(p));
}
template <VectorExpression P>
bool is_finite(const P& p) noexcept {
  return is_finite(Vec<P::RowsAtCompileTime>(p));
}

/// Linear interpolation, exact at both ends.
template <VectorLike P, VectorLike Q>
Vec<P::RowsAtCompileTime> lerp(const P& p, const Q& q, double w) noexcept {
  return (1 - w) * p + w * q;
}

}  // namespace carreau
