// SPDX-License-Identifier: BSD-3-Clause
// Replaces cad_file_input.cpp if OpenCASCADE is not built in.
#include "base/failure.h"
#include "inputs/cad/open_cad.h"

namespace command {

std::unique_ptr<CadInput> open_cad(const std::string& path, const CadChoice&, const ReadingProgress&) {
  throw Failure("'" + path +
                "' cannot be read: this program was built without OpenCASCADE, which STEP, IGES and BREP files need.");
}

}  // namespace command
