// The actions of blsurf.env (RT-0232 sec. 3.3, fig. 12).
#include <array>
#include <filesystem>

#include "io/env.h"
#include "session/session.h"

namespace carreau {

namespace {

constexpr std::array<std::string_view, 3> actions{"inimesh", "export", "exit"};

class EnvRunner {
 public:
  EnvRunner(Session& session, const std::string& path, bool model_from_host)
      : session_(session),
        path_(path),
        folder_(std::filesystem::path(path).parent_path()),
        model_from_host_(model_from_host) {}

  void run() {
    const std::vector<EnvPair> pairs = read_env(path_);
    session_.parameters().reset_all();
    for (const EnvPair& pair : pairs) {
      if (pair.name != "call") {
        set(pair);
        continue;
      }
      if (pair.value == "exit") break;
      call(pair);
      session_.parameters().reset_all();
    }
    session_.parameters().reset_all();
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

  void call(const EnvPair& pair) {
    if (pair.value == actions[0]) {
      if (!model_from_host_) session_.load_pardom(beside_env(".pardom"));
      session_.make_mesh();
    } else if (pair.value == actions[1]) {
      if (!session_.has_mesh()) throw InvalidArgument(at(pair), "call export comes before any call inimesh");
      session_.write(beside_env("." + session_.parameters().text("format")));
    } else {
      throw InvalidArgument(at(pair),
                            "unknown action \"" + pair.value + "\": the actions are inimesh, export and exit");
    }
  }

  Session& session_;
  std::string path_;
  std::filesystem::path folder_;
  bool model_from_host_;
};

}  // namespace

void Session::run_env(const std::string& path) { EnvRunner(*this, path, has_model_from_host()).run(); }

}  // namespace carreau
