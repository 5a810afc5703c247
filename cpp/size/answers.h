// SPDX-License-Identifier: BSD-3-Clause
// Answers of hosts and sources at one place.
#pragma once

#include <optional>
#include <type_traits>
#include <vector>

#include "metric/prescription.h"
#include "support/error.h"

namespace carreau {

template <typename Size>
constexpr bool has_directions = std::is_same_v<Size, Metric2>;

/// Throws CallbackError if the answer is not positive and finite. A definite metric within 1e-12 of a semi-definite one
/// is not usable either.
void check(const Prescription& p, const PrescriptionSource& source, const Where& where);

/// The prescription of sizes that are larger by a factor.
Prescription enlarged(Prescription p, double factor) noexcept;

/// The answers at one place.
template <typename Size>
struct Answers {
  std::optional<double> size;

  [[nodiscard]] bool empty() const noexcept { return !size; }
  void add_size(double h) { size = h; }
};
template <>
struct Answers<Metric2> {
  std::vector<Prescription> all;

  [[nodiscard]] bool empty() const noexcept { return all.empty(); }
  void add(const Prescription& p) { all.push_back(p); }
  void add_size(double h) { add(Prescription::of_size(h)); }
};

}  // namespace carreau
