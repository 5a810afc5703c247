// SPDX-License-Identifier: BSD-3-Clause
// Several files that appear together, whole, or not at all.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace command {

enum class WrittenFiles { none, some, all };

/// Files are written in a hidden folder beside each, and get their names together; symbolic links stay. A signal that
/// ends the program before that removes the hidden files.
class OutputFiles {
 public:
  /// Throws Failure for a suffix that is not in `suffixes`, a file that comes twice or is one of `inputs`, or a folder
  /// that cannot be written in.
  OutputFiles(std::vector<std::string> paths, const std::vector<std::string>& suffixes,
              const std::vector<std::string>& inputs = {});
  ~OutputFiles();
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;

  /// Calls make(hidden) with a name to write to for each path: the same name in a hidden folder, one folder for all
  /// that have one folder. Then the files get their own names. Throws Failure, and what `make` throws.
  void write(const std::function<void(const std::vector<std::string>& hidden)>& make);

  /// Removes the files of a write() under way; for signal handlers. Returns which files are complete: all when write()
  /// succeeded for every object.
  static WrittenFiles remove_in_handler() noexcept;

 private:
  std::vector<std::string> paths_, targets_;  ///< as they were named; behind symbolic links
  bool succeeded_ = false;
};

}  // namespace command
