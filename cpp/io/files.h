// SPDX-License-Identifier: BSD-3-Clause
// Whole files, read and written safely.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace carreau {

/// Content of a file. Throws FileError, with the absolute path and the system's reason, when the file cannot be read,
/// is a folder or a device, or is larger than `limit` bytes.
std::string read_file(const std::string& path, std::size_t limit = std::size_t{1} << 33);

/// ".mesh" of "a/b.c.MESH": the last dot of the name and the text behind it, in small letters; "" without a dot.
std::string suffix_of(const std::string& path);

/// True if the content of a file is binary GMF (.meshb, .solb): it starts with the number 1 in 32 bits, in either byte order.
bool starts_as_gmf(std::string_view bytes) noexcept;

/// Writes to a temporary name in the same folder, then renames: `path` holds either its old content or all of the new,
/// and the temporary is removed after a failure. The permissions of an older file are kept; a symbolic link stays one,
/// and the file it points to is replaced. Writes directly to special files (/dev/stdout, a pipe). Throws FileError with
/// the absolute path and the system's reason.
void write_file(const std::string& path, std::string_view content);

/// Writes a file piece by piece, in any order of positions. Nothing appears at `path` before commit(); without it the
/// temporary is removed. For one thread at a time.
class NewFile {
 public:
  /// Throws FileError.
  explicit NewFile(const std::string& path);
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  /// Throws FileError; commit() must not follow then.
  void write_at(std::uint64_t position, std::string_view bytes);
  /// Gives the file its name. Once. Throws FileError.
  void commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace carreau
