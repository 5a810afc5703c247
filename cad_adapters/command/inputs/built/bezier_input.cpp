// SPDX-License-Identifier: BSD-3-Clause
// Bezier patches, which the library evaluates itself.
#include <carreau_geometry.h>

#include "inputs/built/bezier_input.h"
#include "inputs/base/built_input.h"

namespace command {
namespace {

class BezierInput final : public BuiltInput {
 public:
  BezierInput(SessionHandle session, const std::string& path) : BuiltInput(std::move(session), path), path_(path) {}

  carreau_status give_to(carreau_session* session) override { return carreau_load_bezier(session, path_.c_str()); }

 private:
  [[nodiscard]] std::string kind(std::int32_t face) const override {
    std::int32_t degrees[2] = {0, 0};
    ask([&](carreau_session* session) { require(session, carreau_bezier_degrees(session, face, degrees)); });
    return "Bezier " + std::to_string(degrees[0]) + " x " + std::to_string(degrees[1]);
  }

  std::string path_;
};

}  // namespace

std::unique_ptr<CadInput> open_bezier(const std::string& path) {
  SessionHandle session = make_silent_session();
  require(session.get(), carreau_load_bezier(session.get(), path.c_str()));
  return std::make_unique<BezierInput>(std::move(session), path);
}

}  // namespace command
