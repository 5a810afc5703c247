// SPDX-License-Identifier: BSD-3-Clause
// Describes places of a model in the sentences of errors and remarks.
#pragma once

#include <string>

#include "model/model.h"
#include "support/error.h"

namespace carreau {

/// Face, rank (the host's) and reference of a curve; file and line when the model was read from a file. Indices from 0.
inline Where place_of(const Model& model, std::size_t face, std::size_t curve) {
  const FaceCurve& c = model.faces[face].curves[curve];
  Where where{.face = model.faces[face].ref, .curve_index = host_rank(model.faces[face], curve), .curve = c.ref};
  if (c.line > 0) where.file = model.source, where.line = c.line;
  return where;
}

/// " (line 4)", or "" for a model from memory.
inline std::string of_line(int line) { return line > 0 ? " (line " + std::to_string(line) + ")" : ""; }

}  // namespace carreau
