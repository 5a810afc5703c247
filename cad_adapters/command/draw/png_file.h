// SPDX-License-Identifier: BSD-3-Clause
// Writing PNG files.
#pragma once

#include <string>

#include "draw/raster.h"

namespace command {

/// Throws Failure.
void write_png(const Image& image, const std::string& path);

}  // namespace command
