// Whole files, read and written safely.
#pragma once

#include <string>
#include <string_view>

namespace carreau {

/// Throws FileError when the file cannot be read or is larger than `limit` bytes.
std::string read_file(const std::string& path, std::size_t limit = std::size_t{1} << 33);

/// Writes to a temporary name in the same folder, then renames: `path` holds either its old content or all of the new.
/// Throws FileError.
void write_file(const std::string& path, std::string_view content);

}  // namespace carreau
