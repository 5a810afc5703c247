// SPDX-License-Identifier: BSD-3-Clause
#include "base/output_files.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <set>

#include "base/failure.h"
#include "base/text_file.h"

namespace command {
namespace {

/// The files that a signal handler removes: fixed before `active` becomes true, and only read after that.
struct Staged {
  std::string folder, file, temporary;
};
std::vector<Staged> staged;
volatile std::sig_atomic_t active = 0;
/// Counts over all OutputFiles: writes that have succeeded, and objects without one.
volatile std::sig_atomic_t successes = 0, unwritten = 0;

void remove_staged() noexcept {
  // Another thread may create a file after the removal of files and before the removal of the folder, but only once.
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

/// The target of a path: itself (also if links form a ring), or the end of a chain of symbolic links, which need not
/// exist.
std::string behind_links(const std::string& path) {
  namespace fs = std::filesystem;
  constexpr int longest_chain = 40;  // as the kernel's own limit
  fs::path target = path;
  for (int i = 0; i < longest_chain; ++i) {
    std::error_code error;
    if (!fs::is_symlink(target, error) || error) return target.string();
    const fs::path next = fs::read_symlink(target, error);
    if (error) return target.string();
    target = next.is_absolute() ? next : target.parent_path() / next;
  }
  return path;
}

/// A sentence about hidden files, about the files as they will be called.
std::string without_hidden_folders(std::string sentence) {
  for (const Staged& s : staged) {
    const std::string hidden = s.folder.substr(s.folder.find_last_of('/'));
    for (std::size_t at = 0; (at = sentence.find(hidden + "/", at)) != std::string::npos;)
      sentence.erase(at, hidden.size());
  }
  return sentence;
}

/// Signals wait while files get their names; the handler runs in this thread only.
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

/// Returns one name for all names of a file, whether it exists or not: its place behind symbolic links.
std::string place_of(const std::string& given) {
  const std::string path = behind_links(given);
  const auto resolved = [](const std::string& name) {
    char* const real = realpath(name.c_str(), nullptr);
    const std::string result = real != nullptr ? real : "";
    std::free(real);
    return result;
  };
  const std::string whole = resolved(path);
  return whole.empty() ? resolved(folder_of(path)) + "/" + name_of(path) : whole;
}

void check(const std::string& path, const std::string& target, const std::vector<std::string>& suffixes) {
  if (std::find(suffixes.begin(), suffixes.end(), suffix_of(path)) == suffixes.end()) {
    std::string known;
    for (const std::string& each : suffixes) known += (known.empty() ? "" : ", ") + each;
    refuse(path, "its suffix is not " + std::string(suffixes.size() > 1 ? "one of " : "") + known);
  }
  struct stat status {};
  const bool known = stat(target.c_str(), &status) == 0;
  if (!known && errno == ELOOP) refuse(path, std::strerror(ELOOP));
  if (known && !S_ISREG(status.st_mode)) refuse(path, "it is not an ordinary file");
  if (access(folder_of(target).c_str(), W_OK | X_OK) != 0)
    refuse(path, "folder '" + folder_of(target) + "': " + std::strerror(errno));
}

}  // namespace

OutputFiles::OutputFiles(std::vector<std::string> paths, const std::vector<std::string>& suffixes,
                         const std::vector<std::string>& inputs)
    : paths_(std::move(paths)) {
  std::set<std::string> read, places;
  for (const std::string& path : inputs)
    if (!path.empty()) read.insert(place_of(path));
  for (const std::string& path : paths_) {
    targets_.push_back(behind_links(path));
    check(path, targets_.back(), suffixes);
    const std::string place = place_of(path);
    if (read.contains(place)) refuse(path, "it is an input");
    if (!places.insert(place).second) refuse(path, "it is named twice");
  }
  unwritten = unwritten + 1;
}

OutputFiles::~OutputFiles() {
  if (!succeeded_) unwritten = unwritten - 1;
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
    // Beside the file itself, not beside a link to it, which may lie on another file system.
    std::map<std::pair<std::string, std::string>, std::string> folders;
    for (std::size_t i = 0; i < paths_.size(); ++i) {
      const std::string &path = paths_[i], beside = folder_of(targets_[i]);
      std::string& folder = folders[{beside, folder_of(path)}];  // where names differ
      if (folder.empty()) {
        folder = beside + "/.carreau-XXXXXX";
        if (mkdtemp(folder.data()) == nullptr) refuse(path, std::strerror(errno));
      }
      hidden.push_back(folder + "/" + name_of(path));
      staged.push_back({folder, hidden.back(), hidden.back() + ".0.tmp"});
    }
  }
  try {
    make(hidden);
  } catch (const Failure& failure) {
    throw Failure(without_hidden_folders(failure.what()));
  }
  const SignalsBlocked blocked;
  for (std::size_t i = 0; i < staged.size(); ++i) {
    struct stat old {};
    if (stat(targets_[i].c_str(), &old) == 0) chmod(staged[i].file.c_str(), old.st_mode & 07777);
    if (std::rename(staged[i].file.c_str(), targets_[i].c_str()) != 0) refuse(paths_[i], std::strerror(errno));
  }
  active = 0;
  succeeded_ = true;
  successes = 1;
  unwritten = unwritten - 1;
  remove_staged();  // the folders
  staged.clear();
}

WrittenFiles OutputFiles::remove_in_handler() noexcept {
  if (active != 0) remove_staged();
  if (successes == 0) return WrittenFiles::none;
  return unwritten == 0 ? WrittenFiles::all : WrittenFiles::some;
}

}  // namespace command
