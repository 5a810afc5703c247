#include "output_files.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <set>

#include "failure.h"
#include "text_file.h"

namespace command {
namespace {

/// What a signal handler removes: fixed before `active` becomes true, and only read after that.
struct Staged {
  std::string folder, file, temporary;
};
std::vector<Staged> staged;
volatile std::sig_atomic_t active = 0, written = 0;

void remove_staged() noexcept {
  // Another thread may open a file between its removal and that of its folder, but only once.
  constexpr int tries = 3;
  for (int i = 0; i < tries; ++i) {
    for (const Staged& s : staged) unlink(s.file.c_str()), unlink(s.temporary.c_str());
    for (const Staged& s : staged) rmdir(s.folder.c_str());
  }
}

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  return slash == std::string::npos ? "." : slash == 0 ? "/" : path.substr(0, slash);
}
std::string name_of(const std::string& path) { return path.substr(path.find_last_of('/') + 1); }

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw Failure("'" + path + "' cannot be written: " + why + ".");
}

/// Signals wait while files get their names.
class SignalsBlocked {
 public:
  SignalsBlocked() {
    sigset_t some;
    sigemptyset(&some);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&some, signal);
    sigprocmask(SIG_BLOCK, &some, &old_);
  }
  ~SignalsBlocked() { sigprocmask(SIG_SETMASK, &old_, nullptr); }
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;

 private:
  sigset_t old_;
};

/// The same for all names of one file, whether it exists or not: its own place, behind symbolic links.
std::string place_of(const std::string& path) {
  const auto resolved = [](const std::string& name) {
    char* const real = realpath(name.c_str(), nullptr);
    const std::string result = real != nullptr ? real : "";
    std::free(real);
    return result;
  };
  const std::string whole = resolved(path);
  return whole.empty() ? resolved(folder_of(path)) + "/" + name_of(path) : whole;
}

void check(const std::string& path, const std::vector<std::string>& suffixes) {
  if (std::find(suffixes.begin(), suffixes.end(), suffix_of(path)) == suffixes.end()) {
    std::string known;
    for (const std::string& each : suffixes) known += (known.empty() ? "" : ", ") + each;
    refuse(path, "its suffix is " + std::string(suffixes.size() > 1 ? "none of " : "not ") + known);
  }
  struct stat status {};
  if (stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) refuse(path, "it is not an ordinary file");
  if (access(folder_of(path).c_str(), W_OK | X_OK) != 0)
    refuse(path, "folder '" + folder_of(path) + "': " + std::strerror(errno));
}

}  // namespace

OutputFiles::OutputFiles(std::vector<std::string> paths, const std::vector<std::string>& suffixes,
                         const std::vector<std::string>& inputs)
    : paths_(std::move(paths)) {
  std::set<std::string> read, places;
  for (const std::string& path : inputs)
    if (!path.empty()) read.insert(place_of(path));
  for (const std::string& path : paths_) {
    check(path, suffixes);
    const std::string place = place_of(path);
    if (read.contains(place)) refuse(path, "it is what is read");
    if (!places.insert(place).second) refuse(path, "it is named twice");
  }
}

OutputFiles::~OutputFiles() {
  if (active == 0) return;
  active = 0;
  remove_staged();
  staged.clear();
}

void OutputFiles::write(const std::function<void(const std::vector<std::string>& hidden)>& make) {
  std::vector<std::string> hidden;
  {
    const SignalsBlocked blocked;  // a folder exists only once the handler knows of it
    staged.clear();
    staged.reserve(paths_.size());
    active = 1;
    std::map<std::string, std::string> folders;
    for (const std::string& path : paths_) {
      std::string& folder = folders[folder_of(path)];
      if (folder.empty()) {
        folder = folder_of(path) + "/.carreau-XXXXXX";
        if (mkdtemp(folder.data()) == nullptr) refuse(path, std::strerror(errno));
      }
      hidden.push_back(folder + "/" + name_of(path));
      staged.push_back({folder, hidden.back(), hidden.back() + ".0.tmp"});
    }
  }
  make(hidden);
  const SignalsBlocked blocked;
  for (std::size_t i = 0; i < staged.size(); ++i) {
    struct stat old {};
    if (stat(paths_[i].c_str(), &old) == 0) chmod(staged[i].file.c_str(), old.st_mode & 07777);
    char* const real = realpath(paths_[i].c_str(), nullptr);  // a symbolic link stays one
    const std::string target = real != nullptr ? real : paths_[i];
    std::free(real);
    if (std::rename(staged[i].file.c_str(), target.c_str()) != 0) refuse(paths_[i], std::strerror(errno));
  }
  active = 0;
  written = 1;
  remove_staged();  // the folders
  staged.clear();
}

bool OutputFiles::remove_in_handler() noexcept {
  if (active != 0) remove_staged();
  return written != 0;
}

}  // namespace command
