// SPDX-License-Identifier: BSD-3-Clause
// Simple polygons: the representation of a loop of the plane. All decisions are exact.
#pragma once

#include <string>
#include <vector>

#include "support/vec.h"

namespace carreau::atlas {

/// Vertices in counterclockwise order, the first one not repeated.
using Polygon = std::vector<Vec2>;

/// Throws DomainError with the vertices, from 1, if a polygon is not simple, or not counterclockwise. `name` is for the
/// sentence: "the inner border".
void require_simple(const Polygon& polygon, const std::string& name);
/// Throws DomainError unless the inner polygon lies inside the outer one without touching it.
void require_annulus(const Polygon& inner, const Polygon& outer);

/// Returns whether the closed segments ab and cd have a common point.
bool segments_meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) noexcept;
/// Returns whether they cross at one point that is no end of either.
bool segments_cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) noexcept;

/// Is p strictly inside?
bool is_inside(const Polygon& polygon, const Vec2& p) noexcept;

/// The crossing of two segments that cross, as a share of ab.
double crossing_share(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) noexcept;

/// Index after i, and before it, in a cycle of n.
inline std::size_t next_of(std::size_t i, std::size_t n) { return i + 1 == n ? 0 : i + 1; }
inline std::size_t previous_of(std::size_t i, std::size_t n) { return i == 0 ? n - 1 : i - 1; }

/// Positive when counterclockwise. Plain doubles.
double signed_area(const Polygon& polygon) noexcept;

}  // namespace carreau::atlas
