// SPDX-License-Identifier: BSD-3-Clause
// Mesh files that the library reads, and files that the program translates for it.
#pragma once

#include <string>

namespace command {

/// A mesh file, or its translation in a temporary folder, which goes with the object.
class ReadableMesh {
 public:
  /// Translates a file .med. Throws Failure.
  explicit ReadableMesh(const std::string& path);
  ~ReadableMesh();
  ReadableMesh(const ReadableMesh&) = delete;
  ReadableMesh& operator=(const ReadableMesh&) = delete;

  /// Returns the file that the library reads.
  [[nodiscard]] const std::string& path() const noexcept { return file_.empty() ? path_ : file_; }
  [[nodiscard]] bool is_translated() const noexcept { return !file_.empty(); }
  /// Returns a sentence of the library with the name of the file that the user named.
  [[nodiscard]] std::string in_terms_of_file(std::string sentence) const;

 private:
  std::string path_, folder_, file_;  ///< the last two are empty without a translation
};

}  // namespace command
