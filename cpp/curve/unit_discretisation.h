// Unit discretisation of a curve in a size field (RR-2818 sec. 4-5).
#pragma once

#include <functional>
#include <span>
#include <vector>

namespace carreau {

/// Laws of interpolation of sizes between two points (hinterpol_flag, RT-0232 sec. 3.3).
enum class SizeLaw : int { linear = 0, geometric = 1, sinusoidal = 2 };

/// h at fraction r in [0, 1] between h1 and h2 (RR-2818 sec. 5.1).
double interpolate_size(SizeLaw law, double h1, double h2, double r) noexcept;

/// Integral of ds / h(s) over a segment of length d along which h goes from h1 to h2 (RR-2818 sec. 5.1-5.4, closed
/// forms).
double normalised_length(SizeLaw law, double h1, double h2, double d) noexcept;

/// Inverse: the distance from the start at which the normalised length reaches `target`.
double distance_at_normalised_length(SizeLaw law, double h1, double h2, double d, double target) noexcept;

/// Number of unit edges for a normalised length l: max(int(l), 1), plus 1 if n(n+1) < l^2 (RR-2818 sec. 4.5, HDR
/// eq. 2.14).
int unit_edge_count(double l) noexcept;

/// Splits a curve on which sizes h[i] are known at abscissae s[i] (strictly increasing, s[0] = 0) into
/// unit_edge_count() edges of equal normalised length. Returns the n+1 abscissae, first s.front(), last s.back().
std::vector<double> split_by_sizes(std::span<const double> s, std::span<const double> h, SizeLaw law);

/// The general case: `speed(w)` is sqrt(T^t M T) at abscissa w of [0, total]; adaptive trapezoid with threshold lss
/// (RR-2818 sec. 4.4-4.6). Returns n+1 abscissae.
std::vector<double> split_by_metric(const std::function<double(double)>& speed, double total, double lss);

}  // namespace carreau
