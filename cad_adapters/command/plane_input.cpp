// Plane domains, which the library evaluates itself.
#include "plane_input.h"

#include <carreau_geometry.h>

#include <array>
#include <mutex>

#include "face_model.h"
#include "failure.h"
#include "model_input.h"
#include "session_handle.h"
#include "text_file.h"

namespace command {
namespace {

carreau_status load(carreau_session* session, const std::string& path, const PlaneChoice& choice) {
  return carreau_load_plane_domain(session, path.c_str(), choice.sizes.empty() ? nullptr : choice.sizes.c_str(),
                                   choice.corner_angle);
}

/// A domain in a session of its own, which answers where points are.
class PlaneInput final : public ModelInput {
 public:
  PlaneInput(SessionHandle session, const std::string& path, const PlaneChoice& choice)
      : ModelInput(model_of(session.get())), session_(std::move(session)), path_(path), choice_(choice) {
    measure(path);
  }

  [[nodiscard]] bool locate(std::int32_t, double u, double v, Place& place) const noexcept override {
    place = {u, v, 0, u, v};
    return true;
  }

  [[nodiscard]] bool on_curve(std::int32_t face, std::int32_t ic, double share, double& u,
                              double& v) const noexcept override {
    std::array<double, 2> uv{};
    const std::lock_guard lock(mutex_);
    if (carreau_geometry_curve(session_.get(), face, ic, share, uv.data()) != CARREAU_OK) return false;
    u = uv[0], v = uv[1];
    return true;
  }

  carreau_status give_to(carreau_session* session) override { return load(session, path_, choice_); }

  [[nodiscard]] bool has_sizes() const override {
    std::int32_t answer = 0;
    const std::lock_guard lock(mutex_);
    return carreau_plane_has_sizes(session_.get(), &answer) == CARREAU_OK && answer != 0;
  }

 private:
  [[nodiscard]] std::string kind(std::int32_t) const override { return "plane"; }
  carreau_status give_geometry(carreau_session* session) override { return give_to(session); }

  SessionHandle session_;
  mutable std::mutex mutex_;  // a session is used by one thread at a time
  std::string path_;
  PlaneChoice choice_;
};

}  // namespace

bool is_plane_file(const std::string& path) {
  const std::string suffix = suffix_of(path);
  return suffix == ".poly" || suffix == ".mesh" || suffix == ".meshb" || suffix == ".bl2d" || suffix == ".data" ||
         suffix == ".g";
}

std::unique_ptr<CadInput> open_plane(const std::string& path, const PlaneChoice& choice) {
  SessionHandle session = make_session();
  require(session.get(), carreau_set_integer(session.get(), "verb", 0));  // warnings come when the mesh is made
  require(session.get(), load(session.get(), path, choice));
  return std::make_unique<PlaneInput>(std::move(session), path, choice);
}

}  // namespace command
