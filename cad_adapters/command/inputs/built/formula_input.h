// SPDX-License-Identifier: BSD-3-Clause
// Surfaces by formulas: z = f(x, y), Cartesian (HDR sec. 4.8), or x, y and z of u and v.
#pragma once

#include <memory>
#include <string>

namespace command {

class CadInput;

inline constexpr const char* usual_domain = "box:-1,-1,1,1";

/// True if an input is "z = ..." or "x = ...; y = ...; z = ..." and not an existing file.
bool is_formula(const std::string& input);
/// The error in a domain of the parameter plane: "box:x0,y0,x1,y1", "disc:x,y,radius", "ring:x,y,r0,r1". "": no error.
std::string domain_defect(const std::string& text);

/// `domain`: empty: usual_domain. Throws Failure.
std::unique_ptr<CadInput> open_formula(const std::string& input, const std::string& domain);

}  // namespace command
