// SPDX-License-Identifier: BSD-3-Clause
// The actions of blsurf.env (RT-0232 sec. 3.3, fig. 12).
#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>

#include "io/model/env.h"
#include "session/file_adaptation.h"
#include "session/session.h"
#include "support/short_number.h"

namespace carreau {

namespace {

constexpr std::array<std::string_view, 5> actions{"inimesh", "export", "exit", "measure", "adapt"};

// Parameters have their defaults from here on and again at the end of the scope, which an exception may end.
class DefaultsAround {
 public:
  explicit DefaultsAround(Parameters& parameters) : parameters_(parameters) { parameters_.reset_all(); }
  ~DefaultsAround() { parameters_.reset_all(); }
  DefaultsAround(const DefaultsAround&) = delete;
  DefaultsAround& operator=(const DefaultsAround&) = delete;

 private:
  Parameters& parameters_;
};

class EnvRunner {
 public:
  /// `load_pardom` is empty when the host has given a model.
  EnvRunner(Session& session, const std::string& path, std::function<void(const std::string&)> load_pardom)
      : session_(session),
        path_(path),
        folder_(std::filesystem::path(path).parent_path()),
        load_pardom_(std::move(load_pardom)) {}

  void run() {
    const std::vector<EnvPair> pairs = read_env(path_);
    const DefaultsAround around(session_.parameters());
    const auto exit = std::find_if(pairs.begin(), pairs.end(),
                                   [](const EnvPair& pair) { return pair.name == "call" && pair.value == "exit"; });
    const auto calls = std::count_if(pairs.begin(), exit, [](const EnvPair& pair) { return pair.name == "call"; });
    share_ = calls > 0 ? 1.0 / static_cast<double>(calls) : 1;
    for (auto pair = pairs.begin(); pair != exit; ++pair) {
      if (pair->name != "call") {
        set(*pair);
        continue;
      }
      call(*pair);
      done_ += share_;
      session_.parameters().reset_all();
    }
  }

  /// The parameters before the first action.
  void read() {
    for (const EnvPair& pair : carreau::read_env(path_)) {
      if (pair.name == "call") break;
      set(pair);
    }
    find_beside_env({"background_mesh", "background_sol"});
  }

 private:
  [[nodiscard]] Where at(const EnvPair& pair) const { return {.file = path_, .line = pair.line}; }

  void set(const EnvPair& pair) {
    try {
      session_.parameters().set_from_text(pair.name, pair.value, pair.quoted);
    } catch (const InvalidArgument& error) {
      throw InvalidArgument(at(pair), error.what());
    }
  }

  [[nodiscard]] std::string beside_env(const std::string& suffix) {
    return (folder_ / (session_.parameters().text("pref") + suffix)).string();
  }

  /// Relative names of files refer to the folder of the env file.
  void find_beside_env(std::initializer_list<const char*> names) {
    for (const char* name : names)
      if (const std::string file = session_.parameters().text(name); !file.empty())
        session_.parameters().set(name, (folder_ / file).string());
  }

  // The action and the variables that the file has set for it.
  void describe(const EnvPair& pair) {
    Monitor& monitor = session_.monitor();
    if (!monitor.hears(Level::debug)) return;
    std::string text = at(pair).prefix() + "call " + pair.value, separator = " with ";
    for (const ParameterInfo& info : parameter_table()) {
      const Parameters& values = session_.parameters();
      if (!values.is_set(info.name)) continue;
      text += separator + info.name + " " +
              (info.type == ParameterType::text      ? "'" + values.text(info.name) + "'"
               : info.type == ParameterType::integer ? std::to_string(values.integer(info.name))
                                                     : short_number(values.real(info.name)));
      separator = ", ";
    }
    monitor.message(Level::debug, text);
  }

  void call(const EnvPair& pair) {
    describe(pair);
    if (pair.value == actions[0]) {
      if (load_pardom_) load_pardom_(beside_env(".pardom"));
      find_beside_env({"background_mesh", "background_sol"});
      session_.make_mesh(done_, done_ + share_);
    } else if (pair.value == actions[1]) {
      if (!session_.has_mesh()) throw InvalidArgument(at(pair), "call export comes before any call inimesh");
      session_.write(beside_env("." + session_.parameters().text("format")));
    } else if (pair.value == actions[3]) {
      if (!session_.has_mesh()) throw InvalidArgument(at(pair), "call measure comes before any call inimesh");
      session_.write_delivered(beside_env(".json"));
    } else if (pair.value == actions[4]) {
      if (load_pardom_) load_pardom_(beside_env(".pardom"));
      find_beside_env({"adapt_mesh", "adapt_sol", "adapt_out"});
      adapt_by_files(session_, session_.monitor());
    } else {
      throw InvalidArgument(
          at(pair), "unknown action \"" + pair.value + "\": the actions are inimesh, adapt, measure, export and exit");
    }
  }

  Session& session_;
  std::string path_;
  std::filesystem::path folder_;
  std::function<void(const std::string&)> load_pardom_;
  double done_ = 0, share_ = 1;  // of the run
};

}  // namespace

void Session::run_env(const std::string& path) {
  std::function<void(const std::string&)> load;
  if (!has_model_from_host()) load = [this](const std::string& pardom) { load_pardom_of_env(pardom); };
  EnvRunner(*this, path, std::move(load)).run();
}

void Session::read_env(const std::string& path) {
  const Parameters before = parameters();
  try {
    EnvRunner(*this, path, {}).read();
  } catch (...) {
    parameters() = before;
    throw;
  }
}

}  // namespace carreau
