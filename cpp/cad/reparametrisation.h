// SPDX-License-Identifier: BSD-3-Clause
// Other parameters for a face whose own parameters run very unevenly.
#pragma once

#include <memory>
#include <vector>

#include "cad/cad.h"

namespace carreau {

/// An increasing function u(x) with a continuous derivative: the piecewise cubic of Fritsch and Butland (SIAM J. Sci.
/// Stat. Comput. 5 (1984), 300-304) through given points. Ends are mapped exactly onto ends; values beyond them do not
/// change.
class MonotoneMap {
 public:
  /// u(x) = x on [0, 1].
  MonotoneMap() : MonotoneMap({0, 1}, {0, 1}) {}
  /// Both arrays are strictly increasing, of equal length, at least two; else InvalidArgument.
  MonotoneMap(std::vector<double> x, std::vector<double> u);

  struct Jet {
    double u = 0, first = 0, second = 0;
  };
  [[nodiscard]] Jet jet(double x) const noexcept;
  [[nodiscard]] double operator()(double x) const noexcept { return jet(x).u; }
  /// x(u), to rounding.
  [[nodiscard]] double inverse(double u) const noexcept;

  [[nodiscard]] double first() const noexcept { return x_.front(); }
  [[nodiscard]] double last() const noexcept { return x_.back(); }

 private:
  [[nodiscard]] Jet jet_in(std::size_t piece, double x) const noexcept;

  std::vector<double> x_, u_, slope_;
};

/// (u, v) of a host from parameters (x, y), each by its own map.
struct Reparametrisation {
  MonotoneMap u, v;

  [[nodiscard]] Vec2 to_host(const Vec2& p) const noexcept { return {u(p.x()), v(p.y())}; }
  [[nodiscard]] Vec2 from_host(const Vec2& p) const noexcept { return {u.inverse(p.x()), v.inverse(p.y())}; }
};

/// The surface of one face as a function of (x, y), by the chain rule; derivatives that the host does not give are
/// differenced in (x, y). Sizes and radii are the host's. Curves stay in (u, v), because no caller evaluates them here.
/// Keeps references to both arguments. The parameters of CallbackErrors are the host's.
std::unique_ptr<Cad> reparametrised(Cad& host, int face, const Reparametrisation& map);

}  // namespace carreau
