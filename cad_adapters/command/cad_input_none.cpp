// SPDX-License-Identifier: BSD-3-Clause
// In place of cad_input_opencascade.cpp where OpenCASCADE is not built in.
#include "cad_input.h"
#include "commands.h"
#include "failure.h"

namespace command {

std::unique_ptr<CadInput> open_cad(const std::string& path, bool, const ReadingProgress&) {
  throw Failure("'" + path +
                "' cannot be read: this program was built without OpenCASCADE, which STEP, IGES and BREP files need.");
}

int print_cad_info(const InfoOptions& options) {
  open_cad(options.input, false, {});
  return 0;
}

}  // namespace command
