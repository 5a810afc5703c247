// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/adaptation.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/failure.h"
#include "base/text_file.h"
#include "files/session_handle.h"
#include "mesh/progress.h"

namespace command {
namespace {

void require_file(const std::string& option, const std::string& path) {
  if (!path.empty() && access(path.c_str(), R_OK) != 0)
    throw Failure(option + " '" + path + "': there is no such file, or it cannot be read.");
}

std::string text_of(carreau_session* session, const char* name) {
  const char* value = nullptr;
  require(session, carreau_get_text(session, name, &value));
  return value;
}

double real_of(carreau_session* session, const char* name) {
  double value = 0;
  require(session, carreau_get_real(session, name, &value));
  return value;
}

template <typename Value>
Value choice_of(const std::string& text, std::initializer_list<std::pair<const char*, Value>> words) {
  for (const auto& [word, value] : words)
    if (text == word) return value;
  return words.begin()->second;
}

/// The parameters adapt_* as the loop by a callback takes them. Bounds that are not given are shares of `diagonal`, as
/// they are by files.
carreau_estimator estimator_of(carreau_session* session, double diagonal) {
  carreau_estimator estimator{};
  estimator.struct_size = sizeof estimator;
  estimator.source = choice_of<std::int32_t>(
      text_of(session, "adapt_source"),
      {{"hessian", CARREAU_HESSIAN}, {"curvature", CARREAU_CURVATURE}, {"deformation", CARREAU_DEFORMATION}});
  estimator.shape = choice_of<std::int32_t>(
      text_of(session, "adapt_shape"),
      {{"isotropic", CARREAU_ISOTROPIC}, {"graph", CARREAU_GRAPH}, {"anisotropic", CARREAU_ANISOTROPIC}});
  estimator.recovery = choice_of<std::int32_t>(text_of(session, "adapt_recovery"),
                                               {{"fit", CARREAU_FIT}, {"projection", CARREAU_PROJECTION}, {"quadric", CARREAU_QUADRIC}});
  require(session, carreau_get_integer(session, "adapt_relative", &estimator.relative));
  estimator.tolerance = real_of(session, "adapt_tolerance");
  estimator.relative_floor = real_of(session, "adapt_floor");
  estimator.ratio = real_of(session, "adapt_ratio");
  constexpr double smallest_share = 1.0 / 500, largest_share = 1.0 / 5;
  const double low = real_of(session, "adapt_hmin"), high = real_of(session, "adapt_hmax");
  estimator.hmin = low > 0 ? low : smallest_share * diagonal;
  estimator.hmax = high > 0 ? high : largest_share * diagonal;
  return estimator;
}

carreau_background_report background_of(carreau_session* session) {
  carreau_background_report report{};
  report.struct_size = sizeof report;
  require(session, carreau_session_background(session, &report));
  return report;
}

}  // namespace

Adaptation::Adaptation(const AdaptChoice& choice) : choice_(choice) {
  if (!choice.is_adapt) return;
  const bool by_files = !choice.mesh.empty() || !choice.sol.empty();
  if (by_files == !choice.formula.empty())
    throw Failure(by_files ? "--formula stands in the place of --mesh and --sol: it does not go with them."
                           : "An adaptation requires --mesh and --sol, the last mesh and values at its vertices, or "
                             "--formula.");
  if (by_files && choice.sol.empty()) throw Failure("--mesh requires --sol: values, sizes or metrics at its vertices.");
  if (by_files && choice.mesh.empty()) throw Failure("--sol requires --mesh: its mesh.");
  if (by_files && (choice.differences || choice.convergence > 0))
    throw Failure(std::string(choice.differences ? "--differences" : "--convergence") +
                  " is about the loop of --formula: it does not go with --mesh and --sol.");
  if (!by_files && !choice.transfer.empty()) throw Failure("--transfer requires --mesh: the mesh of its fields.");
  require_file("--mesh", choice.mesh);
  require_file("--sol", choice.sol);
  require_file("--transfer", choice.transfer);
  if (!by_files) formula_ = std::make_unique<Formula>(choice.formula);
}

std::vector<std::string> Adaptation::inputs() const { return {choice_.mesh, choice_.sol, choice_.transfer}; }

bool is_solution(const std::string& path) { return suffix_of(path) == ".sol" || suffix_of(path) == ".solb"; }

std::vector<std::string> Adaptation::with_fields(std::vector<std::string> outputs) const {
  if (!choice_.is_adapt) return outputs;
  const bool any = !choice_.mesh.empty() && (!choice_.transfer.empty() || choice_.use == "values");
  if (const auto named = std::find_if(outputs.begin(), outputs.end(), is_solution); named != outputs.end()) {
    if (!any) throw Failure("There are no fields for '" + *named + "': --transfer FILE.sol names some.");
    return outputs;
  }
  if (!any) return outputs;
  for (const std::string& path : outputs) {
    const std::string suffix = suffix_of(path), stem = path.substr(0, path.size() - suffix.size());
    if (suffix != ".mesh" && suffix != ".meshb" && suffix != ".bl2d") continue;
    outputs.push_back(stem + (suffix == ".meshb" ? ".solb" : ".sol"));
    break;
  }
  return outputs;
}

carreau_status Adaptation::run(carreau_session* session, double diagonal) {
  if (!choice_.is_adapt) return carreau_mesh_generate(session);
  if (formula_) return run_formula(session, diagonal);
  const carreau_status status =
      choice_.use != "values" ? carreau_set_background_mesh(session, choice_.mesh.c_str(), choice_.sol.c_str())
                              : carreau_set_background_fields(session, choice_.mesh.c_str(), choice_.sol.c_str());
  return status == CARREAU_OK ? carreau_mesh_generate(session) : status;
}

carreau_status Adaptation::run_formula(carreau_session* session, double diagonal) {
  const carreau_estimator estimator = estimator_of(session, diagonal);
  carreau_adaptation adaptation{};
  adaptation.struct_size = sizeof adaptation;
  adaptation.estimator = &estimator;
  adaptation.field = field_at;
  adaptation.user = this;
  adaptation.iterations = choice_.iterations;
  adaptation.differences = choice_.differences ? 1 : 0;
  adaptation.convergence = choice_.convergence;
  report_ = {};
  report_.struct_size = sizeof report_;
  const carreau_status status = carreau_adapt(session, &adaptation, &report_);
  // The formula of another process may have failed at a place that this process did not evaluate.
  const std::string sentence = carreau_last_error(session);
  if (status == CARREAU_ERR_CALLBACK && failure_.empty() && sentence.find("callback of the field") != std::string::npos)
    failure_ = "the formula '" + formula_->text() + "' has no finite value somewhere (" + sentence + ")";
  return status;
}

std::int32_t Adaptation::field_at(std::int64_t n, const double* xyz, double* values, void* user) noexcept {
  auto& self = *static_cast<Adaptation*>(user);
  for (std::int64_t i = 0; i < n; ++i) {
    const double x = xyz[3 * i], y = xyz[3 * i + 1], z = xyz[3 * i + 2];
    values[i] = (*self.formula_)({x, y, z, x, y});
    if (std::isfinite(values[i])) continue;
    try {
      self.failure_ = "the formula '" + self.formula_->text() + "' has no finite value at x = " + std::to_string(x) +
                      ", y = " + std::to_string(y) + ", z = " + std::to_string(z);
    } catch (...) {  // no memory for a sentence
    }
    return 1;
  }
  return 0;
}

std::string Adaptation::line(carreau_session* session) const {
  if (!choice_.is_adapt) return "";
  const auto sentence = [](double error, double tolerance, const std::string& mesh) {
    std::ostringstream line;
    line << "tolerance  " << tolerance << (error <= tolerance ? " reached" : " not reached") << ": estimated error " << error << " on " << mesh;
    return line.str();
  };
  if (formula_)
    return sentence(report_.estimated_error, report_.tolerance,
                    "adaptation " + std::to_string(report_.best) + " of " + std::to_string(report_.iterations));
  const carreau_background_report report = background_of(session);
  return report.tolerance > 0 ? sentence(report.estimated_error, report.tolerance, "the last mesh") : "";
}

nlohmann::ordered_json Adaptation::json(carreau_session* session) const {
  if (!choice_.is_adapt) return nullptr;
  if (formula_)
    return {{"tolerance", report_.tolerance},   {"estimated_error", report_.estimated_error}, {"reached", report_.within != 0},
            {"mesh", report_.best},             {"meshes", report_.iterations},               {"error_max", report_.error_max},
            {"error_rms", report_.error_rms}};
  const carreau_background_report report = background_of(session);
  if (!(report.tolerance > 0)) return nullptr;
  return {{"tolerance", report.tolerance},
          {"estimated_error_of_last_mesh", report.estimated_error},
          {"reached_by_last_mesh", report.estimated_error <= report.tolerance}};
}

void Adaptation::write_fields(carreau_session* session, const std::string& path, Progress& progress) const {
  const std::string& fields = choice_.transfer.empty() ? choice_.sol : choice_.transfer;
  std::int64_t outside = 0;
  require(session, carreau_transfer_files(session, choice_.mesh.c_str(), fields.c_str(), path.c_str(), &outside));
  if (outside > 0)
    progress.warning(std::to_string(outside) + " vertices lie beside '" + choice_.mesh +
                     "': fields have the nearest values there");
}

}  // namespace command
