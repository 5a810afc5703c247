// SPDX-License-Identifier: BSD-3-Clause
// Surfaces by formulas: z = f(x, y), Cartesian (HDR sec. 4.8), or x, y and z of u and v.
#pragma once

#include <memory>
#include <string>

namespace command {

class CadInput;

inline constexpr const char* usual_domain = "box:-1,-1,1,1";

/// Whether an input is no file that is there but "z = ..." or "x = ...; y = ...; z = ...".
bool is_formula(const std::string& input);
/// "" or what is wrong with a domain of the parameter plane: "box:x0,y0,x1,y1", "disc:x,y,radius", "ring:x,y,r0,r1".
std::string domain_defect(const std::string& text);

/// `domain`: empty: usual_domain. Throws Failure.
std::unique_ptr<CadInput> open_formula(const std::string& input, const std::string& domain);

}  // namespace command
