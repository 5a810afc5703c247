// SPDX-License-Identifier: BSD-3-Clause
// Replaces cad_info.cpp if OpenCASCADE is not built in.
#include "commands/commands.h"
#include "inputs/cad/open_cad.h"

namespace command {

int print_cad_info(const InfoOptions& options) {
  open_cad(options.input, options.cad, {});
  return 0;
}

}  // namespace command
