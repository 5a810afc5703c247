// SPDX-License-Identifier: BSD-3-Clause
// `carreau adapt`: the source of sizes of the next mesh, files of the last mesh or a formula.
#pragma once

#include <carreau.h>

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "inputs/built/formula.h"

namespace command {

class Progress;

/// As typed.
struct AdaptChoice {
  bool is_adapt = false;           ///< the command is `carreau adapt`
  std::string mesh, sol;           ///< the last mesh and the values at its vertices
  std::string use = "values";      ///< kind of `sol`: "values", "sizes" or "metrics"
  std::string transfer;            ///< fields for the next mesh; empty: the values of `sol`, if any
  std::string formula;             ///< of a field, in place of `mesh` and `sol`
  std::vector<std::string> names;  ///< parameters adapt_* that options stand for, "name=value"
  int iterations = 5;              ///< by a formula
  bool differences = false;        ///< derivatives of the formula itself, not of its values at vertices
  double convergence = 0;          ///< share of triangles; 0: all iterations
};

/// True if the suffix belongs to files of values at vertices.
bool is_solution(const std::string& path);

/// A run of the command.
class Adaptation {
 public:
  /// Throws Failure for options that contradict each other, missing files, and an invalid formula.
  explicit Adaptation(const AdaptChoice& choice);

  /// Files that are read.
  [[nodiscard]] std::vector<std::string> inputs() const;
  /// Returns `outputs`. If there are fields for the next mesh and no output is a .sol, adds one beside the first mesh
  /// that has the format's name. Throws Failure for a .sol without fields.
  [[nodiscard]] std::vector<std::string> with_fields(std::vector<std::string> outputs) const;

  /// Makes the mesh in a session that has its model, of this diagonal, and its parameters. A status of carreau.h; the sentence is in the
  /// session, or in failure().
  carreau_status run(carreau_session* session, double diagonal);
  [[nodiscard]] const std::string& failure() const noexcept { return failure_; }

  /// The tolerance and the estimated error, as a line of the summary and as JSON: of the session's mesh for a formula, of the last mesh
  /// for files. "" and null: there was no estimate.
  [[nodiscard]] std::string line(carreau_session* session) const;
  [[nodiscard]] nlohmann::ordered_json json(carreau_session* session) const;

  /// Writes the fields on the session's mesh. Throws Failure.
  void write_fields(carreau_session* session, const std::string& path, Progress& progress) const;

 private:
  carreau_status run_formula(carreau_session* session, double diagonal);
  static std::int32_t field_at(std::int64_t n, const double* xyz, double* values, void* user) noexcept;

  AdaptChoice choice_;
  std::unique_ptr<Formula> formula_;
  carreau_adaptation_report report_{};  ///< of the loop by a formula
  std::string failure_;
};

}  // namespace command
