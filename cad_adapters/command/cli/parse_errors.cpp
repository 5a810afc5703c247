// SPDX-License-Identifier: BSD-3-Clause
#include "cli/parse_errors.h"

#include <algorithm>

#include "base/suggestions.h"

namespace command {

namespace {

std::vector<std::string> names_of_commands(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* sub : app.get_subcommands({})) names.push_back(sub->get_name());
  return names;
}

/// The words in "{a,b,c}" of an option's kind of value.
std::vector<std::string> known_choices(const std::string& type) {
  const std::size_t open = type.find('{'), close = type.find('}');
  std::vector<std::string> words;
  if (open == std::string::npos || close == std::string::npos) return words;
  for (std::size_t from = open + 1; from < close;) {
    const std::size_t to = std::min(type.find(',', from), close);
    words.push_back(type.substr(from, to - from));
    from = to + 1;
  }
  return words;
}

/// The reason why a word is not a value of an option: not a number, not in its range, or not among its choices. "":
/// valid.
std::string choice_sentence(const std::string& name, const std::string& word, const CLI::Option& option) {
  const std::string type = option.get_type_name();
  if (const std::vector<std::string> choices = known_choices(type); !choices.empty()) {
    if (std::find(choices.begin(), choices.end(), word) != choices.end()) return "";
    std::string all;
    for (const std::string& each : choices) all += (all.empty() ? "" : ", ") + each;
    return name + " '" + word + "' is not one of: " + all + did_you_mean(word, choices);
  }
  const std::size_t range = type.find(" in [");
  double number = 0;
  if (range == std::string::npos || CLI::detail::lexical_cast(word, number)) return "";
  std::string bounds = type.substr(range + 5, type.find(']', range) - range - 5);
  if (const std::size_t between = bounds.find(" - "); between != std::string::npos) bounds.replace(between, 3, " to ");
  return name + " '" + word + "' is not a number from " + bounds;
}

}  // namespace

std::string command_names(const CLI::App& app) {
  std::string names;
  for (const std::string& name : names_of_commands(app)) names += (names.empty() ? "" : ", ") + name;
  return names;
}

std::string unknown_command(const std::string& word, const CLI::App& app) {
  return "There is no command '" + word + "'" + did_you_mean(word, names_of_commands(app)) + " There are " +
         command_names(app) + ".";
}

std::string sentence_of(const CLI::ParseError& error, const CLI::App& sub, const std::vector<std::string>& words) {
  std::vector<std::string> known;
  for (const CLI::Option* option : sub.get_options())
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  for (const std::string& word : words) {
    const std::string name = word.substr(0, word.find('='));
    if (!name.starts_with("--") || name.size() < 3 || std::find(known.begin(), known.end(), name) != known.end())
      continue;
    return "carreau " + sub.get_name() + " has no option '" + name + "'" + did_you_mean(name, known);
  }
  for (const CLI::Option* option : sub.get_options()) {
    const std::string name = option->get_lnames().empty() ? option->get_name() : "--" + option->get_lnames().front();
    const auto is_value = [&](const std::string& word) { return !choice_sentence(name, word, *option).empty(); };
    if (const auto wrong = std::find_if(option->results().begin(), option->results().end(), is_value);
        wrong != option->results().end())
      return choice_sentence(name, *wrong, *option);
  }
  return error.what();
}

}  // namespace command
