// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/base/embedded_places.h"

#include <carreau_geometry.h>

#include <filesystem>

#include "base/failure.h"
#include "files/points_file.h"
#include "files/session_handle.h"

namespace command {

void embed(carreau_session* session, const EmbedChoice& choice) {
  std::int64_t wires = 0;
  if (choice.wires) {
    require(session, carreau_model_embed_wires(session, &wires));
    if (wires == 0) throw Failure("--embed-wires: no wire of the file lies on a face.");
  }
  if (choice.ridges > 0) require(session, carreau_model_embed_ridges(session, choice.ridges, nullptr));
  for (const std::string& file : choice.curves) {
    const std::vector<XYZ> points = read_points(file);
    const std::string name = std::filesystem::path(file).stem().string();
    if (carreau_model_embed_polyline(session, static_cast<std::int64_t>(points.size()), points.front().data(), name.c_str(), nullptr) != CARREAU_OK)
      throw Failure("--embed-curve " + file + ": " + carreau_last_error(session));
  }
  for (const std::string& text : choice.points) {
    const std::optional<XYZ> point = parse_xyz(text);
    if (!point) throw Failure("--embed-point '" + text + "': three numbers X,Y,Z are required.");
    if (carreau_model_embed_point(session, point->data(), nullptr, nullptr) != CARREAU_OK)
      throw Failure("--embed-point " + text + ": " + carreau_last_error(session));
  }
}

}  // namespace command
