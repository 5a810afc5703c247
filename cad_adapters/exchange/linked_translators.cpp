// SPDX-License-Identifier: BSD-3-Clause
// Translators that are linked to the program.
#include "translator.h"

namespace carreau_occ {

Translator& step_translator() { return carreau_translate_step; }
Translator& iges_translator() { return carreau_translate_iges; }

}  // namespace carreau_occ
