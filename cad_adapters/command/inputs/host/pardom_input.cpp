// SPDX-License-Identifier: BSD-3-Clause
// Faces of a file x.pardom whose geometry is in a shared library, as a host of the C interface.
#include <cmath>

#include "inputs/host/pardom_input.h"
#include "base/failure.h"
#include "inputs/base/model_input.h"
#include "inputs/host/shared_host.h"

namespace command {
namespace {

class PardomInput final : public ModelInput {
 public:
  PardomInput(const std::string& path, const std::string& host) : ModelInput(read_pardom(path)), host_(host) {
    // Routines answer after cad_init, and carreau_set_cad_m calls that once for each session.
    if (host_.routines().cad_init != nullptr) host_.routines().cad_init();
    routines_ = host_.routines();
    routines_.cad_init = nullptr;
    measure(path);
  }

  [[nodiscard]] bool locate(std::int32_t face, double u, double v, Place& place) const noexcept override {
    const double uv[2] = {u, v};
    double S[3];
    routines_.surf0(&face, uv, S);
    place = {S[0], S[1], S[2], u, v};
    return std::isfinite(S[0]) && std::isfinite(S[1]) && std::isfinite(S[2]);
  }

  [[nodiscard]] bool on_curve(std::int32_t face, std::int32_t ic, double share, double& u,
                              double& v) const noexcept override {
    double a = 0, b = 0, C[2];
    routines_.curv_int(&face, &ic, &a, &b);
    const double t = share < 1 ? a + share * (b - a) : b;
    routines_.curv0(&face, &ic, &t, C);
    u = C[0], v = C[1];
    return std::isfinite(u) && std::isfinite(v);
  }

 private:
  [[nodiscard]] std::string kind(std::int32_t) const override { return "of the host"; }
  carreau_status give_geometry(carreau_session* session) override { return carreau_set_cad_m(session, &routines_); }

  SharedHost host_;
  carreau_cad_m routines_{};
};

}  // namespace

std::unique_ptr<CadInput> open_pardom(const std::string& path, const std::string& host) {
  return std::make_unique<PardomInput>(path, host);
}

}  // namespace command
