// SPDX-License-Identifier: BSD-3-Clause
#include "support/error.h"

#include "support/format.h"

namespace carreau {

std::string Where::prefix() const {
  std::string text;
  const auto add = [&text](const std::string& part) {
    if (!text.empty()) text += ", ";
    text += part;
  };
  if (!file.empty()) add(file);
  if (line > 0) add("line " + std::to_string(line));
  if (face != 0) add("face " + std::to_string(face));
  if (curve_index != 0) add("curve " + std::to_string(curve_index));
  if (curve != 0) {
    if (curve_index != 0)
      text += " (reference " + std::to_string(curve) + ")";
    else
      add("curve of reference " + std::to_string(curve));
  }
  if (point != 0) add("point of reference " + std::to_string(point));
  if (uv) add("u = " + format_number(uv->x()) + ", v = " + format_number(uv->y()));
  if (t) add("t = " + format_number(*t));
  return text.empty() ? text : text + ": ";
}

}  // namespace carreau
