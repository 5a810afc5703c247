// SPDX-License-Identifier: BSD-3-Clause
// x.pardom: parameter domains and references (RT-0232 sec. 3.2, fig. 11).
#pragma once

#include <string>
#include <string_view>

#include "model/model.h"

namespace carreau {

/// Reads the free format: numbers separated by blanks, ends of line or a comma, `!` comments, Fortran exponents. `name`
/// goes into messages and Model::source; the `line` members are filled. Throws FileError with file and line for
/// deviations from fig. 11: a missing number, an invalid number, a count that is negative or larger than the file can
/// hold, no surface or no curve. Also for a typc other than 1 and 2, an orientation that is neither the rank of a curve
/// nor 0. Ranks in messages count from 1. find_model_defects() checks rules between entities. The reader ignores text
/// after the last surface, as Fortran's input does: *line_of_rest receives its line, or 0.
Model read_pardom_text(std::string_view text, const std::string& name, int* line_of_rest = nullptr);
/// Throws FileError also when the file cannot be read or is larger than 256 MiB.
Model read_pardom(const std::string& path, int* line_of_rest = nullptr);

/// In the layout of the manual's x.pardom.new; read_pardom_text reads it back to the same model. A part of a curve is a
/// separate curve, with its place in the host's curve as a comment, which read_pardom_text understands. Throws
/// InvalidArgument for a point that is not finite.
std::string pardom_text(const Model& model);

}  // namespace carreau
