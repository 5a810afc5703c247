// The command line: sub-commands and their options. Help, completion of shells and the check of the manual pages are
// made from it.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "commands.h"

namespace command {

/// Kinds of values, as help shows them; completion of shells knows the first four.
namespace kind {
inline constexpr const char* file = "FILE";
inline constexpr const char* parameter = "NAME";
inline constexpr const char* setting = "NAME=VALUE";
inline constexpr const char* view = "VIEW";
inline constexpr const char* length = "LENGTH";
inline constexpr const char* number = "N";
inline constexpr const char* rounds = "ROUNDS";
}  // namespace kind

/// The parser and what it fills.
class CommandLine {
 public:
  CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// Parses and runs. The exit code; throws Failure.
  int run(int argc, char** argv);

  [[nodiscard]] const CLI::App& app() const noexcept { return app_; }

 private:
  CLI::App* add(const char* name, const char* description);
  void add_mesh();
  void add_plane();
  void add_adapt();
  /// How fields become sizes: the parameters adapt_* by options.
  void add_estimator_options(CLI::App* app);
  /// What governs a mesh: of `mesh` and `fields`.
  static void add_mesh_options(CLI::App* app, MeshOptions& options);
  static void add_molecule_options(CLI::App* app, MoleculeChoice& choice);
  static void add_grid_options(CLI::App* app, GridChoice& choice);
  static void add_triangles_options(CLI::App* app, TrianglesChoice& choice);
  void add_refine();
  void add_info();
  void add_areas();
  void add_picture();
  void add_check();
  void add_fields();
  void add_params();
  void add_completion();
  int run_command();
  /// `carreau help [COMMAND]`.
  int help(const std::string& command);
  /// A sentence for a command line that cannot be parsed, with what may have been meant.
  [[nodiscard]] std::string sentence_of(const CLI::ParseError& error, const CLI::App& sub,
                                        const std::vector<std::string>& words) const;

  CLI::App app_;
  MeshOptions mesh_, plane_, adapt_;
  RefineOptions refine_;
  InfoOptions info_;
  AreasOptions areas_;
  PictureOptions picture_;
  std::string picture_size_ = "1200x900", paint_ = "face", label_;
  CheckOptions check_;
  FieldsOptions fields_;
  std::string field_size_ = "1024", shell_;
  ParamsOptions params_;
};

}  // namespace command
