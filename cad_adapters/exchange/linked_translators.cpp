// SPDX-License-Identifier: BSD-3-Clause
// Translators and changes of shapes that are linked to the program.
#include "changes/shape_changes.h"
#include "translator.h"

namespace carreau_occ {

Translator& step_translator() { return carreau_translate_step; }
Translator& iges_translator() { return carreau_translate_iges; }
const ShapeChanges& shape_changes() { return *carreau_shape_changes(); }

}  // namespace carreau_occ
