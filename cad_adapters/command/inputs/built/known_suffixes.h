// SPDX-License-Identifier: BSD-3-Clause
// Suffixes of the files that commands read, for sentences.
#pragma once

#include <string>

namespace command {

/// "'x.cml' cannot be read: ... reads .step, ...": of a geometry whose suffix is not known.
std::string unknown_geometry(const std::string& path);
/// The same of a file of triangles.
std::string unknown_triangles(const std::string& path);

}  // namespace command
