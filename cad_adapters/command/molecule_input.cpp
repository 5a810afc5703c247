// Molecules, whose surfaces the library evaluates itself.
#include "molecule_input.h"

#include <carreau_geometry.h>

#include <algorithm>
#include <array>
#include <mutex>

#include "face_model.h"
#include "failure.h"
#include "model_input.h"
#include "text_file.h"

namespace command {
namespace {

carreau_molecule_options options_of(const MoleculeChoice& choice) {
  carreau_molecule_options options{};
  options.struct_size = sizeof options;
  options.surface = choice.surface == "vws" ? CARREAU_VWS : choice.surface == "sas" ? CARREAU_SAS : CARREAU_SES;
  options.drop_cavities = choice.drop_cavities ? 1 : 0;
  options.probe = choice.probe;
  return options;
}

/// A molecule in a session of its own, which answers where points are.
class MoleculeInput final : public ModelInput {
 public:
  MoleculeInput(SessionHandle session, const std::string& path, const MoleculeChoice& choice)
      : ModelInput(model_of(session.get())), session_(std::move(session)), path_(path), choice_(choice) {
    measure(path);
  }

  [[nodiscard]] bool locate(std::int32_t face, double u, double v, Place& place) const noexcept override {
    const std::array<double, 2> uv{u, v};
    std::array<double, 3> x{};
    const std::lock_guard lock(mutex_);
    if (carreau_geometry_points(session_.get(), face, 1, uv.data(), x.data()) != CARREAU_OK) return false;
    place = {x[0], x[1], x[2], u, v};
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

  carreau_status give_to(carreau_session* session) override {
    const carreau_molecule_options options = options_of(choice_);
    return carreau_load_molecule(session, &options, path_.c_str());
  }

  [[nodiscard]] std::string summary() const override {
    carreau_molecule_measures measures{};
    measures.struct_size = sizeof measures;
    require(session_.get(), carreau_molecule_measure(session_.get(), &measures));
    return std::to_string(measures.atoms) + " atoms, " + std::to_string(measures.exposed_atoms) + " exposed, " +
           ModelInput::summary();
  }

  [[nodiscard]] bool closed() const override { return true; }

  /// Short arcs are exact, and no mistake of a file.
  [[nodiscard]] double ends_tolerance() const override { return 1e-9 * diagonal(); }

 private:
  [[nodiscard]] std::string kind(std::int32_t) const override { return "sphere"; }
  carreau_status give_geometry(carreau_session* session) override { return give_to(session); }

  SessionHandle session_;
  mutable std::mutex mutex_;  // a session is used by one thread at a time
  std::string path_;
  MoleculeChoice choice_;
};

}  // namespace

bool is_molecule(const std::string& path) {
  const std::string suffix = suffix_of(path);
  return std::any_of(std::begin(molecule_suffixes), std::end(molecule_suffixes),
                     [&](const char* known) { return suffix == known; });
}

void load_molecule(carreau_session* session, const std::string& path, const MoleculeChoice& choice) {
  const carreau_molecule_options options = options_of(choice);
  require(session, carreau_load_molecule(session, &options, path.c_str()));
}

std::unique_ptr<CadInput> open_molecule(const std::string& path, const MoleculeChoice& choice) {
  SessionHandle session = make_session();
  require(session.get(), carreau_set_integer(session.get(), "verb", 0));  // warnings come when the mesh is made
  load_molecule(session.get(), path, choice);
  return std::make_unique<MoleculeInput>(std::move(session), path, choice);
}

}  // namespace command
