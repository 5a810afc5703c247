// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/several_input.h"
#include "inputs/open_input.h"

#include <carreau_geometry.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "base/failure.h"
#include "base/text_file.h"
#include "inputs/base/built_input.h"
#include "inputs/built/formula_input.h"
#include "inputs/built/triangles_input.h"

namespace command {
namespace {

class SeveralInput final : public CadInput {
 public:
  explicit SeveralInput(std::vector<std::unique_ptr<CadInput>> parts)
      : parts_(std::move(parts)), session_(make_silent_session()) {
    require(session_.get(), give_to(session_.get()));
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      carreau_geometry& range = ranges_.emplace_back();
      range.struct_size = sizeof range;
      require(session_.get(), carreau_geometry_info(session_.get(), static_cast<std::int64_t>(k), &range));
      any_triangles_ = any_triangles_ || range.kind == CARREAU_GEOMETRY_TRIANGLES;
      all_triangles_ = all_triangles_ && range.kind == CARREAU_GEOMETRY_TRIANGLES;
    }
    if (any_triangles_) report_ = triangles_report(session_.get());
    measure();
  }

  carreau_status give_to(carreau_session* session) override {
    for (const auto& part : parts_)
      if (const carreau_status status = part->give_to(session); status != CARREAU_OK) return status;
    return CARREAU_OK;
  }
  [[nodiscard]] double diagonal() const override { return diagonal_; }
  [[nodiscard]] std::string summary() const override {
    std::string text;
    for (const auto& part : parts_) text += (text.empty() ? "" : "; ") + part->summary();
    return text;
  }
  bool set_face_size(const std::string& face, double size) override {
    if (face.find_first_not_of("0123456789") != std::string::npos || face.empty() || face.size() > 9) return false;
    const auto number = static_cast<std::int32_t>(std::stol(face));
    const std::size_t k = part_of(number);
    return k < parts_.size() && parts_[k]->set_face_size(std::to_string(own(k, number)), size);
  }
  [[nodiscard]] bool answers_face_sizes() const override { return false; }
  [[nodiscard]] double face_size(std::int32_t face) const override {
    const std::size_t k = part_of(face);
    return k < parts_.size() ? parts_[k]->face_size(own(k, face)) : 0;
  }
  [[nodiscard]] bool locate(std::int32_t face, double u, double v, Place& place) const noexcept override {
    const std::lock_guard lock(mutex_);
    return locate_by(session_.get(), face, u, v, place);
  }
  [[nodiscard]] std::vector<FaceLook> faces() const override {
    std::vector<FaceLook> all;
    for (std::size_t k = 0; k < parts_.size(); ++k)
      for (FaceLook look : parts_[k]->faces()) {
        look.number += ranges_[k].first_face - 1;
        all.push_back(std::move(look));
      }
    return all;
  }
  [[nodiscard]] std::vector<std::int32_t> face_numbers() const override {
    std::vector<std::int32_t> all;
    for (std::size_t k = 0; k < parts_.size(); ++k)
      for (const std::int32_t face : parts_[k]->face_numbers()) all.push_back(face + ranges_[k].first_face - 1);
    return all;
  }
  [[nodiscard]] std::string face_name(std::int32_t face) const override {
    const std::size_t k = part_of(face);
    return k < parts_.size() ? parts_[k]->face_name(own(k, face)) : "";
  }
  [[nodiscard]] std::vector<std::int32_t> curves(std::int32_t face) const override {
    const std::size_t k = part_of(face);
    if (k == parts_.size()) return {};
    std::vector<std::int32_t> refs = parts_[k]->curves(own(k, face));
    for (std::int32_t& ref : refs)
      if (ref > 0) ref += ranges_[k].first_curve - 1;
    return refs;
  }
  [[nodiscard]] bool on_curve(std::int32_t face, std::int32_t ic, double share, double& u,
                              double& v) const noexcept override {
    double uv[2] = {};
    const std::lock_guard lock(mutex_);
    if (carreau_geometry_curve(session_.get(), face, ic, share, uv) != CARREAU_OK) return false;
    u = uv[0], v = uv[1];
    return true;
  }
  [[nodiscard]] bool has_arbitrary_borders() const override {
    return std::any_of(parts_.begin(), parts_.end(), [](const auto& part) { return part->has_arbitrary_borders(); });
  }
  [[nodiscard]] std::vector<std::string> losses() const override {
    std::vector<std::string> all;
    for (const auto& part : parts_)
      for (std::string& loss : part->losses()) all.push_back(std::move(loss));
    return all;
  }
  [[nodiscard]] Part part_of_face(std::int32_t face) const override {
    const std::size_t k = part_of(face);
    return k < parts_.size() ? Part{static_cast<std::int32_t>(k) + 1, ""} : Part{};
  }
  [[nodiscard]] const char* part_word() const override { return "file"; }
  [[nodiscard]] std::vector<std::string> notes() const override {
    std::vector<std::string> all;
    for (const auto& part : parts_)
      for (std::string& note : part->notes()) all.push_back(std::move(note));
    return all;
  }
  [[nodiscard]] bool closed() const override { return all_triangles_ && report_.border_edges == 0; }
  [[nodiscard]] std::string of_mesh(carreau_session* session) const override {
    return any_triangles_ ? distances_line(session, report_.deviation) : "";
  }

 private:
  /// parts_.size(): none.
  [[nodiscard]] std::size_t part_of(std::int32_t face) const noexcept {
    std::size_t k = 0;
    while (k < ranges_.size() && (face < ranges_[k].first_face || face > ranges_[k].last_face)) ++k;
    return k;
  }
  [[nodiscard]] std::int32_t own(std::size_t part, std::int32_t face) const noexcept {
    return face - ranges_[part].first_face + 1;
  }

  void measure() {
    diagonal_ = report_.diagonal;
    if (all_triangles_) return;
    Point low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (const FaceLook& look : faces())
      for (std::size_t c = 0; c < 3; ++c)
        low[c] = std::min(low[c], look.low[c]), high[c] = std::max(high[c], look.high[c]);
    diagonal_ = std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
    if (!(diagonal_ > 0) || !std::isfinite(diagonal_)) throw Failure("The files have no extent in space.");
  }

  std::vector<std::unique_ptr<CadInput>> parts_;
  SessionHandle session_;
  mutable std::mutex mutex_;
  std::vector<carreau_geometry> ranges_;
  carreau_triangles_report report_{};
  double diagonal_ = 0;
  bool any_triangles_ = false, all_triangles_ = true;
};

}  // namespace

std::unique_ptr<CadInput> open_several(const std::vector<std::string>& paths, const InputChoice& choice) {
  std::vector<std::unique_ptr<CadInput>> parts;
  for (const std::string& path : paths) {
    const bool known = !is_formula(path) && (is_triangles(path) || is_grid(path, choice.grid) ||
                                             is_molecule(path) || suffix_of(path) == ".bpt");
    if (!known)
      throw Failure("'" + path + "' cannot be meshed beside other files: triangles, Bezier patches (.bpt), grids and molecules can.");
    parts.push_back(open_input(path, choice));
  }
  return std::make_unique<SeveralInput>(std::move(parts));
}

}  // namespace command
