// SPDX-License-Identifier: BSD-3-Clause
#include "draw/labels.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <map>
#include <utility>

namespace command {
namespace {

using Bytes = std::array<std::uint8_t, 3>;
constexpr Bytes ink{24, 28, 36}, paper{255, 255, 255};
constexpr int glyph_width = 5, glyph_height = 7, pitch = glyph_width + 1;

/// Rows from the upper one, five bits each, the left one highest.
using Glyph = std::array<std::uint8_t, glyph_height>;

Glyph glyph_of(char c) {
  switch (c) {
    case '0':
      return {14, 17, 19, 21, 25, 17, 14};
    case '1':
      return {4, 12, 4, 4, 4, 4, 14};
    case '2':
      return {14, 17, 1, 2, 4, 8, 31};
    case '3':
      return {31, 2, 4, 2, 1, 17, 14};
    case '4':
      return {2, 6, 10, 18, 31, 2, 2};
    case '5':
      return {31, 16, 30, 1, 1, 17, 14};
    case '6':
      return {6, 8, 16, 30, 17, 17, 14};
    case '7':
      return {31, 1, 2, 4, 8, 8, 8};
    case '8':
      return {14, 17, 17, 14, 17, 17, 14};
    case '9':
      return {14, 17, 17, 15, 1, 2, 12};
    case '.':
      return {0, 0, 0, 0, 0, 12, 12};
    case '-':
      return {0, 0, 0, 31, 0, 0, 0};
    case '+':
      return {0, 4, 4, 31, 4, 4, 0};
    case 'e':
      return {0, 0, 14, 17, 31, 16, 14};
    case 'i':
      return {4, 0, 12, 4, 4, 4, 14};
    case 's':
      return {0, 0, 15, 16, 14, 1, 30};
    case 'z':
      return {0, 0, 31, 2, 4, 8, 31};
    case 'Q':
      return {14, 17, 17, 17, 21, 18, 13};
    default:
      return {};
  }
}

/// Pixels a point of a glyph has: about one for each 450 pixels of the picture.
int scale_of(const Image& image) { return std::max(1, (std::min(image.width, image.height) + 225) / 450); }
int width_of(const std::string& text, int scale) { return (static_cast<int>(text.size()) * pitch - 1) * scale; }

void set(Image& image, int x, int y, const Bytes& colour) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
  const std::size_t at =
      (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x)) * 3;
  std::copy(colour.begin(), colour.end(), image.bytes.begin() + static_cast<std::ptrdiff_t>(at));
}

void fill(Image& image, int x, int y, int width, int height, const Bytes& colour) {
  for (int j = y; j < y + height; ++j)
    for (int i = x; i < x + width; ++i) set(image, i, j, colour);
}

/// The upper left corner is at (x, y).
void write(Image& image, const std::string& text, int x, int y, int scale) {
  for (const char c : text) {
    const Glyph glyph = glyph_of(c);
    for (int row = 0; row < glyph_height; ++row)
      for (int column = 0; column < glyph_width; ++column)
        if ((glyph[static_cast<std::size_t>(row)] >> (glyph_width - 1 - column) & 1) != 0)
          fill(image, x + column * scale, y + row * scale, scale, scale, ink);
    x += pitch * scale;
  }
}

/// Steps, also slanting ones, to the nearest pixel of another face or cell; 1 at the border of a region.
std::vector<int> distances(const std::vector<std::int32_t>& seen, int width, int height, Grid grid) {
  std::vector<int> distance(seen.size());
  const auto cell = [&](int x, int y) { return y * grid.rows / height * grid.columns + x * grid.columns / width; };
  const auto index = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  };
  const auto beside = [&](int x, int y, int i, int j) {
    if (i < 0 || j < 0 || i >= width || j >= height) return 0;
    return seen[index(i, j)] == seen[index(x, y)] && cell(i, j) == cell(x, y) ? distance[index(i, j)] : 0;
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      distance[index(x, y)] = 1 + std::min({beside(x, y, x - 1, y), beside(x, y, x - 1, y - 1), beside(x, y, x, y - 1),
                                            beside(x, y, x + 1, y - 1)});
  for (int y = height; y-- > 0;)
    for (int x = width; x-- > 0;)
      distance[index(x, y)] =
          std::min(distance[index(x, y)], 1 + std::min({beside(x, y, x + 1, y), beside(x, y, x + 1, y + 1),
                                                        beside(x, y, x, y + 1), beside(x, y, x - 1, y + 1)}));
  return distance;
}

}  // namespace

std::vector<Label> place_labels(const std::vector<std::int32_t>& seen, int width, int height, Grid grid) {
  struct Region {
    Label label;
    int distance = 0;
    std::int64_t pixels = 0;
  };
  const std::vector<int> distance = distances(seen, width, height, grid);
  std::map<std::pair<int, std::int32_t>, Region> regions;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::size_t at =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      if (seen[at] == 0) continue;
      const int cell = y * grid.rows / height * grid.columns + x * grid.columns / width;
      Region& region = regions[{cell, seen[at]}];
      ++region.pixels;
      if (distance[at] <= region.distance) continue;
      region.distance = distance[at];
      region.label = {seen[at], cell, x, y};
    }
  std::vector<Region> sorted;
  for (const auto& [key, region] : regions) sorted.push_back(region);
  std::stable_sort(sorted.begin(), sorted.end(), [](const Region& a, const Region& b) { return a.pixels > b.pixels; });
  const int scale = scale_of({width, height, {}});
  std::vector<Label> labels;
  for (const Region& region : sorted) {
    const auto overlaps = [&](const Label& other) {
      const int room =
          (width_of(std::to_string(region.label.face), scale) + width_of(std::to_string(other.face), scale)) / 2;
      return std::abs(other.x - region.label.x) < room + 4 * scale &&
             std::abs(other.y - region.label.y) < (glyph_height + 4) * scale;
    };
    if (std::none_of(labels.begin(), labels.end(), overlaps)) labels.push_back(region.label);
  }
  return labels;
}

void draw_labels(const std::vector<Label>& labels, Image& image) {
  const int scale = scale_of(image);
  for (const Label& label : labels) {
    const std::string text = std::to_string(label.face);
    const int width = width_of(text, scale), height = glyph_height * scale;
    const int x = std::clamp(label.x - width / 2, 2 * scale, std::max(2 * scale, image.width - width - 2 * scale));
    const int y = std::clamp(label.y - height / 2, 2 * scale, std::max(2 * scale, image.height - height - 2 * scale));
    fill(image, x - 2 * scale, y - 2 * scale, width + 4 * scale, height + 4 * scale, ink);
    fill(image, x - scale, y - scale, width + 2 * scale, height + 2 * scale, paper);
    write(image, text, x, y, scale);
  }
}

void draw_legend(Paint paint, const SizeScale& sizes, Image& image) {
  if (paint != Paint::quality && paint != Paint::size) return;
  const int scale = scale_of(image), width = image.width / 4, height = 6 * scale;
  if (width < 8 * pitch * scale || image.height < 12 * height) return;  // no room for two numbers
  const auto number = [](double x) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", x);
    return std::string(text);
  };
  const std::string low = number(paint == Paint::size ? sizes.smallest : 0);
  const std::string high = number(paint == Paint::size ? sizes.largest : 1);
  const std::string name = paint == Paint::size ? "size" : "Q2";
  const int x = 4 * scale, y = image.height - (glyph_height + 6) * scale - height;
  fill(image, x - 2 * scale, y - 2 * scale, width + 4 * scale, height + (glyph_height + 6) * scale, paper);
  for (int i = 0; i < width; ++i) {
    const Colour colour = scale_colour((i + 0.5) / width);
    fill(image, x + i, y, 1, height, {to_srgb(colour[0]), to_srgb(colour[1]), to_srgb(colour[2])});
  }
  const int text = y + height + 2 * scale;
  write(image, low, x, text, scale);
  write(image, name, x + (width - width_of(name, scale)) / 2, text, scale);
  write(image, high, x + width - width_of(high, scale), text, scale);
}

}  // namespace command
