// SPDX-License-Identifier: BSD-3-Clause
// Checks of every grid that was read.
#pragma once

#include <cmath>
#include <cstdint>

#include "fuzz_check.h"
#include "io/grid/grid_files.h"
#include "support/error.h"

namespace carreau {

/// Any bytes are blocks with the number of nodes of their counts, all finite, or a FileError that names the file.
template <typename Read>
int fuzz_grid(const std::uint8_t* data, std::size_t size, Read&& read) {
  grid::Grid grid;
  try {
    grid = read(std::string_view(reinterpret_cast<const char*>(data), size), "x");
  } catch (const FileError& error) {
    FUZZ_CHECK(error.where().file == "x");
    return 0;
  }
  FUZZ_CHECK(!grid.blocks.empty());
  for (const grid::Block& block : grid.blocks) {
    FUZZ_CHECK(block.columns >= 2 && block.rows >= 2);
    FUZZ_CHECK(block.nodes.size() == static_cast<std::size_t>(block.columns) * static_cast<std::size_t>(block.rows));
  }
  return 0;
}

}  // namespace carreau
