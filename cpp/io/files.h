// Whole files, read and written safely.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace carreau {

/// Content of a file. Throws FileError, with the absolute path and the system's reason, when the file cannot be read,
/// is a folder or a device, or is larger than `limit` bytes.
std::string read_file(const std::string& path, std::size_t limit = std::size_t{1} << 33);

/// Writes to a temporary name in the same folder, then renames: `path` holds either its old content or all of the new,
/// and the temporary is removed after a failure. The permissions of an older file are kept; a symbolic link stays one,
/// and the file it points to is replaced. What is not an ordinary file (/dev/stdout, a pipe) is written to directly.
/// Throws FileError with the absolute path and the system's reason.
void write_file(const std::string& path, std::string_view content);

}  // namespace carreau
