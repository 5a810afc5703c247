// Several files that appear together, whole, or not at all.
#pragma once

#include <carreau.h>

#include <string>
#include <vector>

namespace command {

/// Files are written in a hidden folder beside each, and get their names together. A signal that ends the program in
/// between removes what was written.
class OutputFiles {
 public:
  /// Throws Failure for a suffix that cannot be written, a name that comes twice, or a folder that cannot be written
  /// in.
  explicit OutputFiles(std::vector<std::string> paths);
  ~OutputFiles();
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;

  /// The mesh of `session`, and its fields into .exr files. Throws Failure with the library's sentence.
  void write(carreau_session* session, carreau_mesh* mesh);

  /// Removes the files of a write() under way; for signal handlers. Whether a write() has succeeded before.
  static bool remove_in_handler() noexcept;

 private:
  std::vector<std::string> paths_;
};

}  // namespace command
