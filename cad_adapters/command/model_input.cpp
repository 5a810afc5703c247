#include "model_input.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "failure.h"

namespace command {

void ModelInput::measure(const std::string& path) {
  constexpr int samples = 32;  // a circle's box is then known within 0.5 %
  Place low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (const FaceModel::Face& face : model_.faces)
    for (std::size_t c = 0; c < face.curves.size(); ++c)
      for (int i = 0; i <= samples; ++i) {
        double u = 0, v = 0;
        Place p;
        // What the geometry fails on is told with its place when the mesh is made.
        if (!on_curve(face.ref, static_cast<std::int32_t>(c + 1), static_cast<double>(i) / samples, u, v) ||
            !locate(face.ref, u, v, p))
          continue;
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
      }
  diagonal_ = std::hypot(high.x - low.x, high.y - low.y, high.z - low.z);
  if (!(diagonal_ > 0) || !std::isfinite(diagonal_) || low.x > high.x)
    throw Failure("'" + path + "': its curves have no extent in space.");
}

carreau_status ModelInput::give_to(carreau_session* session) {
  const carreau_status status = give_geometry(session);
  return status == CARREAU_OK ? give_model(model_, session) : status;
}

std::string ModelInput::summary() const {
  std::size_t curves = 0;
  for (const FaceModel::Face& face : model_.faces) curves += face.curves.size();
  return std::to_string(model_.faces.size()) + (model_.faces.size() == 1 ? " face, " : " faces, ") +
         std::to_string(curves) + (curves == 1 ? " side" : " sides");
}

bool ModelInput::set_face_size(const std::string& face, double size) {
  std::int32_t ref = 0;
  const auto [end, error] = std::from_chars(face.data(), face.data() + face.size(), ref);
  if (error != std::errc{} || end != face.data() + face.size()) return false;
  FaceModel::Face* const found = model_.find(ref);
  if (found == nullptr) return false;
  found->size = size;
  return true;
}

double ModelInput::face_size(std::int32_t face) const {
  const FaceModel::Face* const found = model_.find(face);
  return found == nullptr ? 0 : found->size;
}

bool ModelInput::exclude(int face, const std::string& why) {
  FaceModel::Face* const found = model_.find(face);
  if (found == nullptr || !found->excluded.empty()) return false;
  found->excluded = why;
  return true;
}

std::vector<std::pair<int, std::string>> ModelInput::excluded() const {
  std::vector<std::pair<int, std::string>> list;
  for (const FaceModel::Face& face : model_.faces)
    if (!face.excluded.empty()) list.emplace_back(face.ref, face.excluded);
  return list;
}

}  // namespace command
