// SPDX-License-Identifier: BSD-3-Clause
// Suffixes of the files that commands read, for sentences.
#pragma once

#include <string>

namespace command {

/// The error for a geometry with an unknown suffix: "'x.cml' cannot be read: ... reads .step, ...".
std::string unknown_geometry(const std::string& path);
/// The error for a file of triangles.
std::string unknown_triangles(const std::string& path);

}  // namespace command
