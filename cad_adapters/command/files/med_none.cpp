// SPDX-License-Identifier: BSD-3-Clause
// Stands in place of med_library.cpp, med_reader.cpp and med_writer.cpp where the MED library is not built in.
#include "base/failure.h"
#include "files/med_file.h"

namespace command {

void require_med() {
  throw Failure(
      "Files .med cannot be read or written: this program was built without the MED library (Debian package "
      "libmedc-dev).");
}

std::string med_as_gmsh(const std::string&) {
  require_med();
  return "";
}

void write_med(carreau_mesh*, const std::string&) { require_med(); }

}  // namespace command
