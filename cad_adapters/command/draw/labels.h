// SPDX-License-Identifier: BSD-3-Clause
// Numbers and legends on a picture.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "draw/raster.h"
#include "draw/scene.h"

namespace command {

/// The cells of a picture that shows several views.
struct Grid {
  int columns = 1, rows = 1;
};

/// A face whose number is drawn, in a cell of the picture.
struct Label {
  std::int32_t face = 0;
  int cell = 0;      ///< row by row
  int x = 0, y = 0;  ///< the middle of the text, in pixels
};

/// A place for each face that is seen in a cell: its pixel that is farthest from all others, the largest faces first.
/// Faces whose text would cover another text get no label. `seen`: the face of each pixel, row by row; 0: no face.
std::vector<Label> place_labels(const std::vector<std::int32_t>& seen, int width, int height, Grid grid);

void draw_labels(const std::vector<Label>& labels, Image& image);

/// A bar of the colours of Paint::quality or Paint::size in the lower left corner, with the numbers of its ends.
void draw_legend(Paint paint, const SizeScale& sizes, Image& image);

}  // namespace command
