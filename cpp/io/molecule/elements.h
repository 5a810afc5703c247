// SPDX-License-Identifier: BSD-3-Clause
// Radii of elements.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace carreau {

/// "Cl" of "CL": a symbol as it is written.
std::string element_symbol(std::string_view letters);
/// Van der Waals radius in angstrom (A. Bondi, J. Phys. Chem. 68, 1964, 441); of deuterium that of hydrogen. Nothing:
/// the table has none.
std::optional<double> bondi_radius(std::string_view symbol);

}  // namespace carreau
