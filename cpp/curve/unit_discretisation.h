// SPDX-License-Identifier: BSD-3-Clause
// Unit discretisation of a curve in a size field (RR-2818 sec. 4-5).
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "size/size_law.h"

namespace carreau {

/// Integral of ds / h(s) over a segment of length d along which h goes from h1 to h2 (RR-2818 sec. 5.1-5.4, closed
/// forms).
double normalised_length(SizeLaw law, double h1, double h2, double d) noexcept;

/// Inverse: the distance from the start at which the normalised length reaches `target`, in [0, d].
double distance_at_normalised_length(SizeLaw law, double h1, double h2, double d, double target) noexcept;

/// Number of unit edges for a normalised length l: max(int(l), 1), plus 1 if n(n+1) < l^2 (RR-2818 sec. 4.5, HDR
/// eq. 2.14). The largest int when there are more.
int unit_edge_count(double l) noexcept;

/// Normalised length of a curve on which sizes h[i] > 0 are known at abscissae s[i] (ascending). Throws
/// InvalidArgument when the arrays do not fit or a size is not positive and finite.
double normalised_length(std::span<const double> s, std::span<const double> h, SizeLaw law);

/// Splits a curve on which sizes h[i] > 0 are known at abscissae s[i] (strictly increasing) into
/// unit_edge_count() edges, and at least `at_least`, of equal normalised length. Returns the n + 1 abscissae, first
/// s.front(), last s.back(). Throws InvalidArgument as normalised_length, LimitError beyond 20 million edges.
std::vector<double> split_by_sizes(std::span<const double> s, std::span<const double> h, SizeLaw law, int at_least = 1);

/// The general case: `speed(w)` is sqrt(T^t M T) at abscissa w of [0, total], finite and >= 0; measured by
/// measure_curve (metric_length_table.h; RR-2818 sec. 4.4-4.6). Returns n + 1 abscissae. Throws InvalidArgument when
/// total or lss is not positive or a speed is not finite, LimitError beyond 20 million edges.
std::vector<double> split_by_metric(const std::function<double(double)>& speed, double total, double lss);

}  // namespace carreau
