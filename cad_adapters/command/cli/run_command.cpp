// SPDX-License-Identifier: BSD-3-Clause
// From words to one command with its options.
#include <algorithm>
#include <cstdio>

#include "base/failure.h"
#include "base/json_output.h"
#include "base/lengths.h"
#include "base/text_file.h"
#include "cli/command_line.h"
#include "cli/completion.h"
#include "cli/option_scope.h"
#include "cli/parse_errors.h"
#include "inputs/built/plane_input.h"
#include "mesh/sizes_file.h"

namespace command {

namespace {

constexpr int unusable = 2;  // exit code

void parse_picture_size(const std::string& text, PictureOptions& options) {
  const auto size = parse_pixels(text);
  if (!size || std::min(size->first, size->second) < 16 || std::max(size->first, size->second) > 20000)
    throw Failure("The size '" + text + "' is not WIDTHxHEIGHT with numbers from 16 to 20000.");
  options.width = size->first, options.height = size->second;
}

/// "800x600", or the longer side alone.
void parse_field_size(const std::string& text, FieldsOptions& options) {
  if (const auto size = parse_pixels(text)) {
    options.width = size->first, options.height = size->second;
    return;
  }
  const auto longest = parse_count(text);
  if (!longest) throw Failure("The size '" + text + "' is neither a number of pixels nor WIDTHxHEIGHT.");
  options.longest = *longest;
}

const CLI::App* find_command(const std::string& name, const CLI::App& app) {
  for (const CLI::App* sub : app.get_subcommands({}))
    if (sub->get_name() == name) return sub;
  return nullptr;
}

/// A probe has no meaning on a van der Waals surface: without --surface it chooses the solvent excluded surface.
void choose_surface(const CLI::App& sub, MoleculeChoice& molecule, bool quiet) {
  if (sub.count("--probe") == 0 || sub.count("--surface") > 0) return;
  molecule.surface = "ses";
  if (!quiet) std::fputs("surface ses (default with --probe)\n", stderr);
}

}  // namespace

int CommandLine::help(const std::string& command) {
  if (command.empty()) return std::fputs(app_.help().c_str(), stdout), 0;
  if (const CLI::App* const sub = find_command(command, app_))
    return std::fputs(sub->help("carreau").c_str(), stdout), 0;
  throw Failure(unknown_command(command, app_));
}

int CommandLine::run(int argc, char** argv) {
  const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  const std::string first = words.empty() ? "" : words.front();
  const bool json = std::find(words.begin(), words.end(), "--json") != words.end();
  try {
    if (first.empty())
      throw Failure("No command given. Commands: " + command_names(app_) + ". More: carreau help, man carreau.");
    if (first == "help") return help(words.size() > 1 ? words[1] : "");
    const CLI::App* const sub = find_command(first, app_);
    if (sub == nullptr && !first.starts_with('-')) throw Failure(unknown_command(first, app_));
    try {
      app_.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      if (error.get_exit_code() == 0) return app_.exit(error), 0;
      throw Failure(sub == nullptr ? std::string(error.what()) : sentence_of(error, *sub, words));
    }
    for (std::string* repeat : {&mesh_.repeat, &volume_.repeat, &plane_.repeat, &adapt_.repeat, &report_.repeat})
      *repeat = shell_line("carreau", words);
    return run_command();
  } catch (const std::bad_alloc&) {
    if (json) print_json_error(first, "there is not enough memory", unusable);
    throw;
  } catch (const std::exception& error) {
    if (json) print_json_error(first, error.what(), unusable);
    throw;
  }
}

int CommandLine::run_command() {
  const std::string& command = app_.get_subcommands().front()->get_name();
  for (MeshOptions* options : {&mesh_, &plane_, &adapt_, &fields_.mesh}) read_sizes(*options);
  if (command == "mesh") {
    mesh_.input = inputs_.front(), mesh_.more_inputs.assign(inputs_.begin() + 1, inputs_.end());
    check_scope(*app_.get_subcommand("mesh"), inputs_, mesh_, false);
    choose_surface(*app_.get_subcommand("mesh"), mesh_.molecule, mesh_.quiet);
    return mesh(mesh_);
  }
  if (command == "volume") {
    volume_.input = solids_.front(), volume_.more_inputs.assign(solids_.begin() + 1, solids_.end());
    check_scope(*app_.get_subcommand("volume"), solids_, volume_, false);
    choose_surface(*app_.get_subcommand("volume"), volume_.molecule, volume_.quiet);
    return mesh(volume_);
  }
  if (command == "plane") return mesh(plane_);
  if (command == "adapt") {
    adapt_.plane.is_plane = is_plane_file(adapt_.input);
    check_scope(*app_.get_subcommand("adapt"), {adapt_.input}, adapt_, adapt_.plane.is_plane);
    return mesh(adapt_);
  }
  if (command == "refine") return refine(refine_);
  if (command == "info") {
    check_scope(*app_.get_subcommand("info"), {info_.input}, info_, false);
    return info(info_);
  }
  if (command == "areas") return areas(areas_);
  if (command == "curve") return curve(curve_);
  if (command == "project") {
    check_scope(*app_.get_subcommand("project"), {project_.input}, project_, false);
    return project(project_);
  }
  if (command == "check") return check(check_);
  if (command == "picture") {
    parse_picture_size(picture_size_, picture_);
    picture_.scene.paint = paint_ == "face"        ? Paint::face
                           : paint_ == "reference" ? Paint::reference
                           : paint_ == "quality"   ? Paint::quality
                           : paint_ == "size"      ? Paint::size
                                                   : Paint::none;
    picture_.labels = !label_.empty();
    if (around_.size() == 4) picture_.scene.around = {around_[0], around_[1], around_[2], around_[3]};
    if (picture_.scene.around && !(around_[3] > 0)) throw Failure("--around requires a radius above 0 as its fourth number.");
    return picture(picture_);
  }
  if (command == "report") return report(report_);
  if (command == "fields") {
    parse_field_size(field_size_, fields_);
    if (suffix_of(fields_.mesh.input) != ".env")
      check_scope(*app_.get_subcommand("fields"), {fields_.mesh.input}, fields_.mesh, false);
    return fields(fields_);
  }
  if (command == "completion") return print_completion(app_, shell_);
  return params(params_);
}

}  // namespace command
