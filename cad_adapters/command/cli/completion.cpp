// SPDX-License-Identifier: BSD-3-Clause
#include "cli/completion.h"

#include <carreau.h>

#include <cstdio>
#include <vector>

#include "base/suggestions.h"
#include "cli/command_line.h"
#include "cli/option_groups.h"

namespace command {
namespace {

enum class Values { none, any, files, words, settings };

/// An option as a shell needs it.
struct Completed {
  std::vector<std::string> names;  ///< "-o", "--output"; empty: positional
  std::string help;
  Values values = Values::none;
  std::string words;  ///< of Values::words, a blank between each two
};

std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : between) + word;
  return all;
}

/// CLI11 writes the choices of an option as "{a,b,c}" into the name of its type.
std::string choices_of(const std::string& type) {
  const std::size_t open = type.find('{'), close = type.find('}');
  if (open == std::string::npos || close == std::string::npos) return "";
  std::string words = type.substr(open + 1, close - open - 1);
  for (char& c : words)
    if (c == ',') c = ' ';
  return words;
}

Completed completed(const CLI::Option& option) {
  Completed result;
  for (const std::string& name : option.get_snames()) result.names.push_back(std::string("-").append(name));
  for (const std::string& name : option.get_lnames()) result.names.push_back(std::string("--").append(name));
  result.help = option.get_description();
  if (option.get_items_expected_max() == 0) return result;
  const std::string type = option.get_type_name();
  result.words = choices_of(type);
  result.values = Values::any;
  const std::string base = type.substr(0, type.find(':'));
  if (!result.words.empty()) result.values = Values::words;
  if (base == kind::file) result.values = Values::files;
  if (base == kind::setting) result.values = Values::settings, result.words = joined(parameter_names(), " ");
  if (base == kind::parameter) result.values = Values::words, result.words = joined(parameter_names(), " ");
  if (base == kind::view) result.values = Values::words, result.words = "iso front back left right top bottom";
  return result;
}

std::vector<Completed> options_of(const CLI::App& app) {
  std::vector<Completed> options;
  for (const CLI::Option* option : app.get_options())
    if (!option->get_group().empty()) options.push_back(completed(*option));  // the others are hidden
  return options;
}

/// Every single quote of a text that stands in single quotes.
std::string quoted(const std::string& text, const char* quote) {
  std::string result;
  for (const char c : text) c == '\'' ? result += quote : result += c;
  return result;
}

std::string commands_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* sub : app.get_subcommands({})) names.push_back(sub->get_name());
  return joined(names, " ");
}

// ---- bash ----

std::string bash_values(const Completed& option) {
  switch (option.values) {
    case Values::files:
      return "_carreau_files \"$cur\"";
    case Values::words:
      return "_carreau_words '" + option.words + "' \"$cur\"";
    case Values::settings:
      return "_carreau_settings '" + option.words + "' \"$cur\"";
    default:
      return ":";
  }
}

void print_bash(const CLI::App& app) {
  std::printf(
      "# bash completion of carreau; made by `carreau completion bash`\n"
      "_carreau_words() { mapfile -t COMPREPLY < <(compgen -W \"$1\" -- \"$2\"); }\n"
      "_carreau_files() { compopt -o filenames; mapfile -t COMPREPLY < <(compgen -f -- \"$1\"); }\n"
      "_carreau_settings() { compopt -o nospace; mapfile -t COMPREPLY < <(compgen -S = -W \"$1\" -- \"$2\"); }\n"
      "_carreau() {\n"
      "  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]}\n"
      "  COMPREPLY=()\n"
      "  if ((COMP_CWORD == 1)); then\n"
      "    _carreau_words '%s %s' \"$cur\"\n"
      "    return\n"
      "  fi\n"
      "  case ${COMP_WORDS[1]} in\n",
      commands_of(app).c_str(), "--help --version");
  for (const CLI::App* sub : app.get_subcommands({})) {
    std::printf("    %s)\n      case $prev in\n", sub->get_name().c_str());
    std::string flags, positional = ":";
    for (const Completed& option : options_of(*sub)) {
      if (!flags.empty()) flags += ' ';
      flags += joined(option.names, " ");
      if (option.names.empty())
        positional = bash_values(option);
      else if (option.values != Values::none)
        std::printf("        %s) %s; return ;;\n", joined(option.names, "|").c_str(), bash_values(option).c_str());
    }
    std::printf("      esac\n      if [[ $cur == -* ]]; then _carreau_words '%s' \"$cur\"; else %s; fi ;;\n",
                flags.c_str(), positional.c_str());
  }
  std::printf("  esac\n}\ncomplete -F _carreau carreau\n");
}

// ---- zsh ----

std::string zsh_values(const Completed& option) {
  switch (option.values) {
    case Values::files:
      return ":file:_files";
    case Values::words:
      return ":value:(" + option.words + ")";
    case Values::settings:
      return ":parameter:_carreau_settings";
    case Values::any:
      return ":value: ";
    default:
      return "";
  }
}

/// Text inside '[...]' of a specification in single quotes.
std::string zsh_text(const std::string& text) {
  std::string result;
  for (const char c : quoted(text, "'\\''")) {
    if (c == '[' || c == ']' || c == ':') result += '\\';
    result += c;
  }
  return result;
}

void print_zsh(const CLI::App& app) {
  std::printf(
      "#compdef carreau\n# made by `carreau completion zsh`\n"
      "_carreau_settings() { compadd -S = -- %s; }\n"
      "_carreau() {\n  local context state line\n  typeset -A opt_args\n"
      "  if ((CURRENT == 2)); then\n    local -a commands=(\n",
      joined(parameter_names(), " ").c_str());
  for (const CLI::App* sub : app.get_subcommands({}))
    std::printf("      '%s:%s'\n", sub->get_name().c_str(), quoted(sub->get_description(), "'\\''").c_str());
  std::printf(
      "    )\n    _describe command commands\n    compadd -- --help --version\n    return\n  fi\n"
      "  local sub=$words[2]\n  shift words\n  ((CURRENT--))\n  case $sub in\n");
  for (const CLI::App* sub : app.get_subcommands({})) {
    std::printf("    %s)\n      _arguments", sub->get_name().c_str());
    for (const Completed& option : options_of(*sub)) {
      if (option.names.empty()) std::printf(" \\\n        '1%s'", zsh_values(option).c_str());
      for (const std::string& name : option.names)
        std::printf(" \\\n        '*%s[%s]%s'", name.c_str(), zsh_text(option.help).c_str(),
                    zsh_values(option).c_str());
    }
    std::printf(" ;;\n");
  }
  std::printf(
      "  esac\n}\nif [[ $zsh_eval_context[-1] == loadautofunc ]]; then _carreau \"$@\"; else compdef _carreau carreau; "
      "fi\n");
}

// ---- fish ----

void print_fish(const CLI::App& app) {
  std::printf("# fish completion of carreau; made by `carreau completion fish`\ncomplete -c carreau -f\n");
  for (const CLI::App* sub : app.get_subcommands({}))
    std::printf("complete -c carreau -n __fish_use_subcommand -a %s -d '%s'\n", sub->get_name().c_str(),
                quoted(sub->get_description(), "\\'").c_str());
  std::printf("complete -c carreau -n __fish_use_subcommand -l help\n");
  std::printf("complete -c carreau -n __fish_use_subcommand -l version\n");
  for (const CLI::App* sub : app.get_subcommands({}))
    for (const Completed& option : options_of(*sub)) {
      std::printf("complete -c carreau -n '__fish_seen_subcommand_from %s'", sub->get_name().c_str());
      for (const std::string& name : option.names)
        std::printf(name[1] == '-' ? " -l %s" : " -s %s", name.c_str() + (name[1] == '-' ? 2 : 1));
      // -x: a value, and no file.
      const char* needs_value = option.names.empty() ? "" : option.values == Values::files ? " -r" : " -x";
      if (option.values == Values::files) std::printf("%s -F", needs_value);
      if (option.values == Values::any) std::printf("%s", needs_value);
      if (option.values == Values::words) std::printf("%s -a '%s'", needs_value, option.words.c_str());
      if (option.values == Values::settings) {
        std::string words;
        for (const char c : option.words) {
          if (c == ' ') words += '=';
          words += c;
        }
        words += '=';
        std::printf("%s -a '%s'", needs_value, words.c_str());
      }
      std::printf(" -d '%s'\n", quoted(option.help, "\\'").c_str());
    }
}

}  // namespace

int print_completion(const CLI::App& app, const std::string& shell) {
  if (shell == "bash")
    print_bash(app);
  else if (shell == "zsh")
    print_zsh(app);
  else
    print_fish(app);
  return 0;
}

}  // namespace command
