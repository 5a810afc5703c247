// SPDX-License-Identifier: BSD-3-Clause
#include "size/size_law.h"

#include <cmath>
#include <numbers>

namespace carreau {

double interpolate_size(SizeLaw law, double h1, double h2, double r) noexcept {
  switch (law) {
    case SizeLaw::linear:
      return h1 + r * (h2 - h1);
    case SizeLaw::geometric:
      return h1 * std::pow(h2 / h1, r);
    case SizeLaw::sinusoidal:
      return (h1 + h2 + (h1 - h2) * std::cos(std::numbers::pi * r)) / 2;
  }
  return h1;
}

}  // namespace carreau
