// x.pardom: parameter domains and references (RT-0232 sec. 3.2, fig. 11).
#pragma once

#include <string>
#include <string_view>

#include "model/model.h"

namespace carreau {

/// Reads the free format with `!` comments. `name` goes into messages and Model::source. Throws FileError with file and
/// line for anything that is not as fig. 11 says (a missing number, a word that is not a number, a negative count, text
/// after the end).
Model read_pardom_text(std::string_view text, const std::string& name);
Model read_pardom(const std::string& path);

/// In the layout of the manual's x.pardom.new; read_pardom_text reads it back to the same model.
std::string pardom_text(const Model& model);

}  // namespace carreau
