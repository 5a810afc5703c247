// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/size_map.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <mutex>

#include "base/failure.h"
#include "base/text_file.h"
#include "files/session_handle.h"

namespace command {
namespace {

/// Suffixes that no formula has.
constexpr std::array other_meshes{".vtu", ".msh", ".msh2", ".stl", ".med"};

bool exists(const std::string& path) { return access(path.c_str(), F_OK) == 0; }

/// The first of `suffixes` that makes a file of `stem`. Throws Failure.
std::string partner(const std::string& path, const std::string& stem, std::initializer_list<const char*> suffixes) {
  if (!exists(path)) throw Failure("--size-map '" + path + "': there is no such file.");
  std::string names;
  for (const char* suffix : suffixes) {
    if (exists(stem + suffix)) return stem + suffix;
    names += (names.empty() ? "'" : " nor '") + stem + suffix + "'";
  }
  throw Failure("--size-map '" + path + "' is one of the two files of a background mesh, but there is neither " +
                names + " beside it.");
}

std::string place_text(const Place& p) {
  char text[160];
  std::snprintf(text, sizeof text, "x = %.6g, y = %.6g, z = %.6g, u = %.6g, v = %.6g", p.x, p.y, p.z, p.u, p.v);
  return text;
}

}  // namespace

SizeMap::SizeMap(const std::string& text) {
  if (text.empty()) return;
  const std::string suffix = suffix_of(text), stem = text.substr(0, text.size() - suffix.size());
  if (suffix == ".mesh" || suffix == ".meshb")
    mesh_ = text, solution_ = partner(text, stem, {".sol", ".solb"});
  else if (suffix == ".sol" || suffix == ".solb")
    solution_ = text, mesh_ = partner(text, stem, {".mesh", ".meshb"});
  else if (std::any_of(other_meshes.begin(), other_meshes.end(), [&](const char* each) { return suffix == each; }))
    throw Failure("--size-map '" + text + "': a background mesh is a file .mesh or .meshb, with .sol or .solb beside.");
  else
    formula_.emplace(text);
}

void SizeMap::give_to(carreau_session* session, const CadInput& input) {
  input_ = &input;
  session_ = session;
  carreau_metric_callbacks callbacks{};
  callbacks.struct_size = sizeof callbacks;
  callbacks.user = this;
  callbacks.surface_metric = surface_metric;  // curves and points get the sizes of the faces beside
  require(session, carreau_set_metric_callbacks(session, &callbacks));
  if (!mesh_.empty()) require(session, carreau_set_background_mesh(session, mesh_.c_str(), solution_.c_str()));
}

std::function<double(const Point&)> SizeMap::in_space() const {
  std::shared_ptr<const Formula> formula;
  try {
    formula = std::make_shared<const Formula>(formula_->text(), "xyz");
  } catch (const Failure&) {  // it is valid with u and v
    return {};
  }
  return [formula](const Point& p) { return (*formula)({p[0], p[1], p[2], 0, 0}); };
}

std::int32_t SizeMap::surface_metric(std::int32_t face, double u, double v, std::int32_t* kind, double* value,
                                     void* user) noexcept {
  try {
    double size = 0;
    const std::int32_t status = static_cast<SizeMap*>(user)->size_at(face, u, v, size);
    if (status == 0) *kind = CARREAU_METRIC_SIZE, *value = size;
    return status;
  } catch (...) {  // no memory for a sentence
    return 1;
  }
}

std::int32_t SizeMap::size_at(std::int32_t face, double u, double v, double& size) {
  const double of_face = input_->face_size(face);
  if (!formula_) {
    size = of_face;
    return of_face > 0 ? 0 : CARREAU_NO_ANSWER;
  }
  Place place;
  if (!input_->locate(face, u, v, place)) return 1;  // the geometry reports its failure itself
  size = (*formula_)(place);
  if (std::isfinite(size) && size > 0) {
    if (of_face > 0) size = std::min(size, of_face);
    return 0;
  }
  static std::mutex one_at_a_time;  // callbacks may come from several threads
  const std::lock_guard lock(one_at_a_time);
  char number[32];
  std::snprintf(number, sizeof number, "%.6g", std::isnan(size) ? NAN : size);  // without a sign
  if (failure_.empty())
    failure_ = "the size map '" + formula_->text() + "' gives " + number + ", which is not a size, on face " +
               std::to_string(input_->whole_face(face)) + " at " + place_text(place);
  carreau_stop(session_);  // a failure would be the face's, and another run without it would begin
  return CARREAU_NO_ANSWER;
}

}  // namespace command
