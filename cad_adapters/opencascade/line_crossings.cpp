// SPDX-License-Identifier: BSD-3-Clause
#include "line_crossings.h"

#include <Geom2dAdaptor_Curve.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <algorithm>
#include <cmath>

namespace carreau_occ {
namespace {

std::vector<double> parameters(const Geom2dAdaptor_Curve& curve) {
  constexpr int of_polynomial = 16, least = 48;
  const int n = curve.NbIntervals(GeomAbs_CN);
  TColStd_Array1OfReal ends(1, n + 1);
  curve.Intervals(ends, GeomAbs_CN);
  const int each = std::max(of_polynomial, (least + n - 1) / n);
  std::vector<double> at;
  for (int i = 1; i <= n; ++i)
    for (int k = 0; k < each; ++k) at.push_back(ends(i) + k * (ends(i + 1) - ends(i)) / each);
  at.push_back(ends(n + 1));
  return at;
}

}  // namespace

std::vector<gp_Pnt2d> sampled(const Handle(Geom2d_Curve) & curve, double first, double last) {
  const Geom2dAdaptor_Curve adaptor(curve, first, last);
  std::vector<gp_Pnt2d> points;
  for (const double t : parameters(adaptor)) points.push_back(adaptor.Value(t));
  return points;
}

std::vector<double> crossings(const Handle(Geom2d_Curve) & curve, double first, double last, bool of_u, double at,
                              double near, double run) {
  const Geom2dAdaptor_Curve adaptor(curve, first, last);
  const std::vector<double> t = parameters(adaptor);
  const auto height = [&](double s) {
    const gp_Pnt2d p = adaptor.Value(s);
    return (of_u ? p.X() : p.Y()) - at;
  };
  std::vector<double> h;
  for (const double s : t) h.push_back(height(s));
  const auto side = [&](double x) { return x > near ? 1 : x < -near ? -1 : 0; };
  /// Between a place where `holds` does and one where it does not.
  const auto bisected = [&](double yes, double no, const auto& holds) {
    for (int i = 0; i < 200; ++i) {
      const double middle = (yes + no) / 2;
      if (middle == yes || middle == no) break;
      (holds(height(middle)) ? yes : no) = middle;
    }
    return yes;
  };
  std::vector<double> found;
  const std::size_t n = t.size();
  for (std::size_t i = 0; i + 1 < n; ++i)
    if (side(h[i]) * side(h[i + 1]) < 0)
      found.push_back(bisected(t[i], t[i + 1], [up = h[i] > 0](double x) { return (x > 0) == up; }));
  // Runs of samples on the line.
  for (std::size_t i = 0, j = 0; i < n; i = j) {
    j = i + 1;
    if (side(h[i]) != 0) continue;
    while (j < n && side(h[j]) == 0) ++j;
    const auto on_line = [&](double x) { return side(x) == 0; };
    const gp_Pnt2d a = adaptor.Value(t[i]), b = adaptor.Value(t[j - 1]);
    const bool whole = i == 0 && j == n, brief = j == i + 1 || std::abs(of_u ? b.Y() - a.Y() : b.X() - a.X()) <= run;
    if (whole || (brief && (i == 0 || j == n))) continue;
    if (brief) {
      const bool through = (h[i - 1] > 0) != (h[j] > 0);
      found.push_back(through ? bisected(t[i - 1], t[j], [up = h[i - 1] > 0](double x) { return (x > 0) == up; })
                              : (t[i] + t[j - 1]) / 2);
      continue;
    }
    if (i > 0) found.push_back(bisected(t[i], t[i - 1], on_line));
    if (j < n) found.push_back(bisected(t[j - 1], t[j], on_line));
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace carreau_occ
