// SPDX-License-Identifier: BSD-3-Clause
#include "volume/child_program.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "base/failure.h"

namespace command {
namespace {

constexpr std::size_t kept_lines = 8;
constexpr int poll_milliseconds = 200;

bool is_program(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(path, error) && access(path.c_str(), X_OK) == 0;
}

/// Keeps the last lines of an output.
class LastLines {
 public:
  void add(const char* bytes, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) {
      if (bytes[i] != '\n' && bytes[i] != '\r') {
        if (line_.size() < 400 && static_cast<unsigned char>(bytes[i]) >= ' ') line_ += bytes[i];
        continue;
      }
      end_line();
    }
  }
  std::vector<std::string> take() {
    end_line();
    return std::move(lines_);
  }

 private:
  void end_line() {
    if (line_.find_first_not_of(' ') != std::string::npos) lines_.push_back(line_);
    if (lines_.size() > kept_lines) lines_.erase(lines_.begin());
    line_.clear();
  }
  std::string line_;
  std::vector<std::string> lines_;
};

/// In the child: only functions that POSIX allows after fork().
[[noreturn]] void become(char* const* words, const char* folder, const ProgramLimits& limits, int output) {
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  if (limits.gigabytes > 0) {
    const auto bytes = static_cast<rlim_t>(limits.gigabytes * 1073741824.0);
    const rlimit memory{bytes, bytes};
    setrlimit(RLIMIT_AS, &memory);
  }
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXFSZ}) std::signal(signal, SIG_DFL);
  const int nothing = open("/dev/null", O_RDONLY);
  if (nothing >= 0) dup2(nothing, STDIN_FILENO);
  dup2(output, STDOUT_FILENO), dup2(output, STDERR_FILENO);
  if (chdir(folder) == 0) execv(words[0], words);
  _exit(127);
}

std::string end_of(int status) {
  if (WIFEXITED(status)) return WEXITSTATUS(status) == 0 ? "" : "exit status " + std::to_string(WEXITSTATUS(status));
  return "signal " + std::to_string(WTERMSIG(status)) + " (" + strsignal(WTERMSIG(status)) + ")";
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::error_code error;
  path_ = (std::filesystem::temp_directory_path(error) / "carreau-XXXXXX").string();
  if (error || mkdtemp(path_.data()) == nullptr)
    throw Failure("A temporary folder cannot be made: " + (error ? error.message() : std::strerror(errno)) + ".");
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code error;
  std::filesystem::remove_all(path_, error);
}

std::string find_program(const std::string& name) {
  std::error_code error;
  const std::filesystem::path own = std::filesystem::read_symlink("/proc/self/exe", error);
  if (const std::string beside = own.parent_path() / name; !error && is_program(beside)) return beside;
  const char* const paths = std::getenv("PATH");
  std::string left = paths != nullptr ? paths : "/usr/bin:/bin";
  while (!left.empty()) {
    const std::size_t end = left.find(':');
    const std::string folder = left.substr(0, end);
    left = end == std::string::npos ? "" : left.substr(end + 1);
    if (const std::string path = folder + "/" + name; !folder.empty() && is_program(path)) return path;
  }
  return "";
}

ProgramResult run_program(const std::vector<std::string>& words, const std::string& folder, const ProgramLimits& limits,
                          const std::function<void(double)>& each_second) {
  using Clock = std::chrono::steady_clock;
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  int ends[2];
  if (pipe(ends) != 0) throw Failure("'" + words.front() + "' cannot be run: " + std::strerror(errno) + ".");
  const Clock::time_point start = Clock::now();
  const pid_t child = fork();
  if (child == 0) become(arguments.data(), folder.c_str(), limits, ends[1]);
  close(ends[1]);
  if (child < 0) {
    close(ends[0]);
    throw Failure("'" + words.front() + "' cannot be run: " + std::strerror(errno) + ".");
  }
  ProgramResult result;
  LastLines lines;
  double told = 0;
  bool late = false;
  for (char buffer[4096];;) {
    pollfd wait{ends[0], POLLIN, 0};
    const int ready = poll(&wait, 1, poll_milliseconds);
    result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (!late && limits.seconds > 0 && result.seconds > limits.seconds) kill(child, SIGKILL), late = true;
    if (result.seconds > told + 1) told = std::floor(result.seconds), each_second(told);
    if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
    const ssize_t n = read(ends[0], buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    lines.add(buffer, static_cast<std::size_t>(n));
  }
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  result.why = late ? "it exceeded " + std::to_string(std::lround(limits.seconds)) + " s" : end_of(status);
  result.succeeded = result.why.empty();
  result.last_lines = lines.take();
  return result;
}

}  // namespace command
