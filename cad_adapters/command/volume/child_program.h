// SPDX-License-Identifier: BSD-3-Clause
// Programs that this one runs.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace command {

/// A folder for files of an engine, removed with the object.
class TemporaryFolder {
 public:
  TemporaryFolder();  ///< Throws Failure.
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const std::string& path() const noexcept { return path_; }

 private:
  std::string path_;
};

struct ProgramLimits {
  double seconds = 0;    ///< 0: none
  double gigabytes = 0;  ///< of memory; 0: none
};

struct ProgramResult {
  bool succeeded = false;
  std::string why;                      ///< "exit status 1", "signal 11 (Segmentation fault)", "it exceeded 10 s"; "" after success
  std::vector<std::string> last_lines;  ///< of its output
  double seconds = 0;
};

/// Path of a program beside this one or in PATH; "": not found.
std::string find_program(const std::string& name);

/// Runs a program in a folder until it ends; it dies with this process. each_second(seconds) reports progress.
ProgramResult run_program(const std::vector<std::string>& words, const std::string& folder, const ProgramLimits& limits,
                          const std::function<void(double)>& each_second);

}  // namespace command
