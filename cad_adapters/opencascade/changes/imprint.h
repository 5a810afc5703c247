// SPDX-License-Identifier: BSD-3-Clause
// Parts of an assembly that touch become parts that share faces and edges.
#pragma once

#include <Message_ProgressRange.hxx>

#include "shape_file.h"

namespace carreau_occ {

/// Replaces the solids, and the shells and faces outside of solids, by their general fuse. Faces and edges that lie at
/// one place become one, and each is divided where others end on it. Names, colours and doubts follow OpenCASCADE's
/// history. Parts that overlap are divided, too, and the common piece belongs to both.
///
/// `tolerance` is a length: distances up to it count as contact, beside the tolerances of the file. When the fuse
/// fails, or would change the volume of a solid (imprint_volume), the file stays as it is, and a loss reports the
/// reason. Throws Standard_Failure when OpenCASCADE does.
void imprint(ShapeFile& file, double tolerance, const Message_ProgressRange& progress);

}  // namespace carreau_occ
