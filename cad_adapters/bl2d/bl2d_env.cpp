// SPDX-License-Identifier: BSD-3-Clause
#include "bl2d_env.h"

#include <charconv>
#include <fstream>
#include <sstream>

namespace bl2d {

namespace {

int number_of(const Setting& setting, const std::string& where, int most) {
  int value = -1;
  const char* end = setting.value.data() + setting.value.size();
  const auto [stop, error] = std::from_chars(setting.value.data(), end, value);
  if (error != std::errc() || stop != end || value < 0 || value > most)
    throw Failure(where + setting.name + " '" + setting.value + "' is not a whole number from 0 to " +
                  std::to_string(most));
  return value;
}

void take(const Setting& setting, const std::string& where, Env& env) {
  constexpr int most = 999999;
  if (setting.name == "base")
    env.base = setting.value;
  else if (setting.name == "geom")
    env.geometry = number_of(setting, where, most);
  else if (setting.name == "adapt")
    env.steps.push_back(number_of(setting, where, most));
  else if (setting.name == "file_h")
    env.writes_sizes = number_of(setting, where, 1) == 1;
  else
    env.settings.push_back(setting);
  if (setting.name == "element") env.writes_bl2d = setting.value == "p1";
}

}  // namespace

Env read_env(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw Failure("'" + path + "' cannot be read");
  Env env;
  env.path = path;
  const std::size_t slash = path.find_last_of('/');
  env.folder = slash == std::string::npos ? "" : path.substr(0, slash + 1);
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    const std::string where = path + ", line " + std::to_string(number) + ": ";
    std::istringstream words(line.substr(0, line.find("--")));
    Setting setting{.name = {}, .value = {}, .line = number};
    std::string more;
    if (!(words >> setting.name)) continue;
    if (!(words >> setting.value)) throw Failure(where + "'" + setting.name + "' has no value");
    if (words >> more) throw Failure(where + "'" + more + "' follows the value of '" + setting.name + "'");
    take(setting, where, env);
  }
  if (env.base.empty()) throw Failure(path + ": it does not give the base name of the files (base)");
  if (env.steps.empty()) env.steps.push_back(0);
  return env;
}

}  // namespace bl2d
