// SPDX-License-Identifier: BSD-3-Clause
// Plane domains, which the library evaluates itself.
#include "inputs/built/plane_input.h"

#include <carreau_geometry.h>

#include "base/failure.h"
#include "base/text_file.h"
#include "inputs/base/built_input.h"

namespace command {
namespace {

carreau_status load(carreau_session* session, const std::string& path, const PlaneChoice& choice) {
  if (const carreau_status status = carreau_set_integer(session, "sol_field", choice.field); status != CARREAU_OK) return status;
  return carreau_load_plane_domain(session, path.c_str(), choice.sizes.empty() ? nullptr : choice.sizes.c_str(),
                                   choice.corner_angle);
}

class PlaneInput final : public BuiltInput {
 public:
  PlaneInput(SessionHandle session, const std::string& path, const PlaneChoice& choice)
      : BuiltInput(std::move(session), path), path_(path), choice_(choice) {}

  [[nodiscard]] bool locate(std::int32_t, double u, double v, Place& place) const noexcept override {
    place = {u, v, 0, u, v};
    return true;
  }

  carreau_status give_to(carreau_session* session) override { return load(session, path_, choice_); }

  [[nodiscard]] bool has_sizes() const override {
    std::int32_t answer = 0;
    return ask([&](carreau_session* session) { return carreau_plane_has_sizes(session, &answer); }) == CARREAU_OK &&
           answer != 0;
  }

 private:
  [[nodiscard]] std::string kind(std::int32_t) const override { return "plane"; }

  std::string path_;
  PlaneChoice choice_;
};

}  // namespace

bool is_plane_file(const std::string& path) {
  const std::string suffix = suffix_of(path);
  return suffix == ".poly" || suffix == ".node" || suffix == ".dat" || suffix == ".mesh" || suffix == ".meshb" || suffix == ".bl2d" || suffix == ".data" ||
         suffix == ".g";
}

std::unique_ptr<CadInput> open_plane(const std::string& path, const PlaneChoice& choice) {
  SessionHandle session = make_silent_session();
  require(session.get(), load(session.get(), path, choice));
  return std::make_unique<PlaneInput>(std::move(session), path, choice);
}

}  // namespace command
