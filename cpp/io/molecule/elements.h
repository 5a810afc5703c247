// SPDX-License-Identifier: BSD-3-Clause
// Radii of elements.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace carreau {

/// "Cl" of "CL": a symbol as it is written.
std::string element_symbol(std::string_view letters);
/// Van der Waals radius in angstrom of an element of the periodic table: A. Bondi, J. Phys. Chem. 68, 1964, 441; for
/// elements that Bondi lacks S. Alvarez, Dalton Trans. 42, 2013, 8617; for elements that Alvarez lacks M. Mantina et
/// al., J. Phys. Chem. A 113, 2009, 5806, or D. V. Fedorov et al., Phys. Rev. Lett. 121, 2018, 183401, by
/// polarizabilities of P. Schwerdtfeger and J. K. Nagle, Mol. Phys. 117, 2019, 1200. Empty: there is no such element.
std::optional<double> van_der_waals_radius(std::string_view symbol);

/// Radii by symbols that replace radii of the table.
using Radii = std::map<std::string, double>;

/// Reads lines "symbol radius"; comments start with '#'. Throws FileError with the line: no symbol, a radius that is not
/// positive, a symbol that comes twice.
Radii read_radii(std::string_view text, const std::string& name);

}  // namespace carreau
