// Registered derivatives against finite differences.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cad/cad.h"

namespace carreau {

/// Compares surf1 (and surf2 when `second`) at `uv` with differences of the order below inside the box [low, high]. One
/// sentence a routine that is wrong: face, (u, v), both values. A derivative is wrong when it disagrees at every step
/// tried and the differences themselves agree with each other: neither a pole nor a kink nor rounding is an alarm.
std::vector<std::string> find_wrong_surface_derivatives(Cad& cad, int face, std::span<const Vec2> uv, Vec2 low,
                                                        Vec2 high, bool second);

/// The same for curv1 (and curv2) at parameters `t` of a curve.
std::vector<std::string> find_wrong_curve_derivatives(Cad& cad, int face, int ic, std::span<const double> t,
                                                      Interval range, bool second);

}  // namespace carreau
