// SPDX-License-Identifier: BSD-3-Clause
#include "cli/help.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace command {
namespace {

struct GroupOf {
  const char* option;
  const char* group;
};

constexpr const char* picture = "Picture";

/// All options of all commands, in the order of help.
constexpr GroupOf groups_of_options[] = {
    {"--output", "Output"},           {"--json", "Output"},         {"--quiet", "Output"},
    {"--verbose", "Output"},
    {"--limit", "Lists"},             {"--worst", "Lists"},         {"--faces", "Lists"},
    {"--atoms", "Lists"},             {"--closed", "Defects"},      {"--allow-crossings", "Defects"},
    {"--view", picture},              {"--color", picture},         {"--edges", picture},
    {"--label", picture},             {"--around", picture},        {"--metric", picture},
    {"--ellipses", picture},          {"--samples", picture},
    {"--size", "Sizes"},              {"--min", "Sizes"},           {"--max", "Sizes"},
    {"--gradation", "Sizes"},         {"--face-size", "Sizes"},     {"--size-map", "Sizes"},
    {"--size-on", "Sizes"},           {"--near", "Sizes"},          {"--sizes", "Sizes"},
    {"--layers", "Sizes"},
    {"--sol-field", "Sizes"},         {"--curve-edges", "Sizes"},   {"--curve-vertices", "Sizes"},
    {"--law", "Sizes"},               {"--through", "Splines"},       {"--deviation", "Splines"},
    {"--angle", "Curvature"},         {"--segments-per-circle", "Curvature"},
    {"--chord", "Curvature"},         {"--anisotropic", "Curvature"},
    {"--depth", "Curvature"},         {"--element", "Elements"},    {"--cross-patch", "Elements"},
    {"--sharp-angle", "Elements"},    {"--periodic", "Elements"},   {"--mirror", "Elements"},       {"--halvings", "Elements"},
    {"--nodes", "Elements"},          {"--centre-nodes", "Elements"}, {"--association", "Elements"},
    {"--carry-from", "Last mesh"},    {"--match", "Last mesh"},     {"--mesh", "Last mesh"},      {"--sol", "Last mesh"},
    {"--use", "Last mesh"},           {"--transfer", "Last mesh"},  {"--formula", "Field by a formula"},
    {"--iterations", "Field by a formula"},                         {"--convergence", "Field by a formula"},
    {"--differences", "Field by a formula"},                        {"--tolerance", "Error estimate"},
    {"--relative", "Error estimate"}, {"--floor", "Error estimate"}, {"--source", "Error estimate"},
    {"--shape", "Error estimate"},    {"--ratio", "Error estimate"}, {"--recovery", "Error estimate"},
    {"--pixels", "Images"},           {"--face", "Images"},         {"--channels", "Images"},
    {"--multi-part", "Images"},       {"--piz", "Images"},          {"--raw", "Images"},
    {"--points", "Places"},           {"--on", "Places"},           {"--only", "Places"},
    {"--embed-point", "Places"},      {"--embed-curve", "Places"},  {"--embed-wires", "Places"},
    {"--group", "CAD files"},         {"--group-by", "CAD files"},  {"--imprint", "CAD files"},
    {"--imprint-tolerance", "CAD files"},                           {"--min-feature", "CAD files"},
    {"--unit", "CAD files"},          {"--scale", "CAD files"},
    {"--loose-edges", "CAD files"},   {"--sharp", "Triangles"},     {"--corner", "Triangles"},
    {"--given-edges", "Triangles"},   {"--ignore-references", "Triangles"},
    {"--reach", "Triangles"},         {"--border", "Triangles"},
    {"--surface", "Molecules"},       {"--probe", "Molecules"},     {"--radii", "Molecules"},
    {"--drop-cavities", "Molecules"}, {"--grid", "Grids"},          {"--smooth", "Grids"},
    {"--lengths", "Grids"},           {"--step", "Grids"},          {"--fill", "Grids"},
    {"--join", "Grids"},              {"--join-nodes", "Grids"},    {"--continuity", "Grids"},
    {"--ridges", "Grids"},            {"--domain", "Formulas and hosts"},
    {"--host", "Formulas and hosts"}, {"--env", "Parameters"},      {"--effort", "Parameters"},   {"--set", "Parameters"},
    {"--engine", "Solids"},           {"--engine-seconds", "Solids"},  {"--engine-memory", "Solids"},
    {"--threads", "Processes"},       {"--parts", "Processes"},     {"--dump-failed", "Diagnosis"},
    {"--help", "Help"},               {"--help-all", "Help"},
};

/// The options that the short help prints.
constexpr const char* most_used[] = {"--output", "--size", "--angle",   "--chord",       "--max", "--gradation", "--face-size",
                                     "--anisotropic", "--element", "--cross-patch", "--mesh", "--sol", "--formula", "--tolerance", "--engine", "--threads", "--set"};

constexpr std::size_t short_enough = 18;  // options that the short help prints as a whole
constexpr std::size_t name_width = 32;

bool has_name(const CLI::Option& option, const char* name) {
  const std::vector<std::string>& names = option.get_lnames();
  return std::any_of(names.begin(), names.end(), [&](const std::string& each) { return each == name + 2; });
}

const GroupOf* group_of(const CLI::Option& option) {
  const auto* const found = std::find_if(std::begin(groups_of_options), std::end(groups_of_options), [&](const GroupOf& each) { return has_name(option, each.option); });
  return found == std::end(groups_of_options) ? nullptr : found;
}

/// Options of a command in the order of help; options that are not in the table come first.
std::vector<const CLI::Option*> ordered(const CLI::App& app) {
  std::vector<const CLI::Option*> options =
      app.get_options([](const CLI::Option* option) { return option->nonpositional() && !option->get_group().empty(); });
  std::stable_sort(options.begin(), options.end(), [](const CLI::Option* a, const CLI::Option* b) { return group_of(*a) < group_of(*b); });
  return options;
}

/// "LENGTH" of "LENGTH:FLOAT in [0 - 1e+09]", "{vws,sas}" of "TEXT:{vws,sas}".
std::string value_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  if (option.get_items_expected_max() == 0 || type.empty()) return "";
  if (const std::size_t open = type.find('{'); open != std::string::npos && type.compare(0, 4, "TEXT") == 0) return "NAME";
  return type.substr(0, type.find(':'));
}

std::string line_of(const CLI::Option& option) {
  std::string names;
  for (const std::string& name : option.get_snames()) names += (names.empty() ? "-" : ",-") + name;
  for (const std::string& name : option.get_lnames()) names += (names.empty() ? "--" : ",--") + name;
  if (const std::string value = value_of(option); !value.empty()) names += " " + value;
  names = "  " + names;
  names.resize(std::max(name_width, names.size() + 2), ' ');
  return names + option.get_description() + "\n";
}

class Formatter : public CLI::Formatter {
 public:
  [[nodiscard]] std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    return make_description(app) + make_usage(app, std::move(name)) + make_positionals(app) + option_groups(app, mode) +
           make_subcommands(app, CLI::AppFormatMode::Normal) + '\n' + make_footer(app);
  }

 private:
  static std::string option_groups(const CLI::App* app, CLI::AppFormatMode mode) {
    const std::vector<const CLI::Option*> options = ordered(*app);
    const bool all = mode == CLI::AppFormatMode::All || options.size() <= short_enough;
    const auto is_shown = [&](const CLI::Option* option) {
      return all || std::any_of(std::begin(most_used), std::end(most_used), [&](const char* name) { return has_name(*option, name); });
    };
    std::string text, group;
    for (const CLI::Option* option : options) {
      if (!is_shown(option)) continue;
      if (all && option->get_group() != group) text += "\n" + (group = option->get_group()) + ":\n";
      if (!all && text.empty()) text = "\nMost used options:\n";
      text += line_of(*option);
    }
    return text + (all ? "" : "  --help-all                    All options, in groups\n");
  }
};

}  // namespace

void set_help(CLI::App& app) {
  app.formatter(std::make_shared<Formatter>());
  app.set_help_flag("-h,--help", "Print help and exit");
  app.set_help_all_flag("--help-all", "Print help on all options and exit");
}

void arrange_options(CLI::App& app) {
  for (CLI::App* sub : app.get_subcommands({}))
    for (CLI::Option* option : sub->get_options())
      if (const GroupOf* found = group_of(*option); found != nullptr && !option->get_group().empty())
        option->group(sub->get_name() == "picture" && has_name(*option, "--size") ? picture : found->group);
}

}  // namespace command
