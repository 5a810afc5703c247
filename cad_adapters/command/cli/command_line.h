// SPDX-License-Identifier: BSD-3-Clause
// The command line: sub-commands and their options. Help, completion of shells and the check of the manual pages are
// made from it.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>

#include "commands/commands.h"

namespace command {

/// The parser and its results.
class CommandLine {
 public:
  /// `first`: the first word of the command line. If it is a command, the others are left out, since their options take time to make.
  explicit CommandLine(std::string_view first = {});
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// Parses and runs. The exit code; throws Failure.
  int run(int argc, char** argv);

  [[nodiscard]] const CLI::App& app() const noexcept { return app_; }

 private:
  CLI::App* add(const char* name, const char* description);
  void add_mesh();
  void add_volume();
  void add_plane();
  void add_adapt();
  void add_refine();
  void add_info();
  void add_areas();
  void add_curve();
  void add_project();
  void add_picture();
  void add_report();
  void add_check();
  void add_fields();
  void add_params();
  void add_completion();
  int run_command();
  /// `carreau help [COMMAND]`.
  int help(const std::string& command);

  CLI::App app_;
  MeshOptions mesh_, volume_, plane_, adapt_;
  std::vector<std::string> inputs_, solids_;  // of `mesh` and `volume`
  RefineOptions refine_;
  InfoOptions info_;
  AreasOptions areas_;
  CurveOptions curve_;
  ProjectOptions project_;
  PictureOptions picture_;
  std::string picture_size_ = "1200x900", paint_ = "face", label_;
  std::vector<double> around_;
  ReportOptions report_;
  CheckOptions check_;
  FieldsOptions fields_;
  std::string field_size_ = "1024", shell_;
  ParamsOptions params_;
};

}  // namespace command
