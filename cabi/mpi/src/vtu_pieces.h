// SPDX-License-Identifier: BSD-3-Clause
// A mesh in parts as VTK reads it: one file a rank, and one that names them.
#pragma once

#include <string>
#include <vector>

#include "part.h"

namespace carreau_mpi {

/// The file of one part, as bytes, one string behind the other (VTK XML, raw appended data).
std::vector<std::string> vtu_of_part(const ListedPart& listed, int rank);

/// "a/x.pvtu" and 3: "a/x_3.vtu".
std::string name_of_piece(const std::string& path, int rank);

/// The file that names the pieces of "x.pvtu", which lie beside it.
std::string pvtu_text(const std::string& path, int size);

}  // namespace carreau_mpi
