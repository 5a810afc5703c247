// SPDX-License-Identifier: BSD-3-Clause
#include "io/grid/grid_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "support/error.h"

namespace carreau {
namespace {

using grid::Block;
using grid::Grid;
using grid::Measured;

template <typename Read>
std::string refusal(Read&& read, const std::string& text) {
  try {
    read(text, "g");
  } catch (const FileError& error) {
    EXPECT_EQ(error.where().file, "g");
    return error.what();
  }
  return "";
}

const auto heights = [](std::string_view text, const std::string& name) { return read_heights(text, name); };
const auto scan = [](std::string_view text, const std::string& name) { return read_scan(text, name); };

/// Node (i, j) of the blocks that follow.
Vec3 node(int block, int i, int j) { return {block + 0.25 * i, 2.0 * j, i * 0.5 - j}; }

constexpr int counts[2][3] = {{3, 1, 2}, {2, 4, 1}};  // columns and rows: 3 x 2, 2 x 4

void expect_blocks(const Grid& grid, bool missing = false) {
  ASSERT_EQ(grid.blocks.size(), 2U);
  for (int b = 0; b < 2; ++b) {
    const Block& block = grid.blocks[static_cast<std::size_t>(b)];
    ASSERT_EQ(block.columns, b == 0 ? 3 : 2);
    ASSERT_EQ(block.rows, b == 0 ? 2 : 4);
    for (int j = 0; j < block.rows; ++j)
      for (int i = 0; i < block.columns; ++i)
        if (missing && i == 1 && j == 1)
          EXPECT_FALSE(block.has(i, j));
        else
          EXPECT_EQ(block.node(i, j), node(b, i, j));
  }
}

/// All x, all y, all z of a block, then its IBLANK if requested.
std::vector<double> numbers_of(int b, bool blanks) {
  const int columns = b == 0 ? 3 : 2, rows = b == 0 ? 2 : 4;
  std::vector<double> numbers;
  for (int axis = 0; axis < 3; ++axis)
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i) numbers.push_back(node(b, i, j)[axis]);
  for (int j = 0; blanks && j < rows; ++j)
    for (int i = 0; i < columns; ++i) numbers.push_back(i == 1 && j == 1 ? 0 : 1);
  return numbers;
}

std::string text_of(bool blanks) {
  std::string text = "2\n3 1 2\n2 4 1\n";
  for (int b = 0; b < 2; ++b)
    for (const double x : numbers_of(b, blanks)) text += std::to_string(x) + (x == 0 ? "\n" : " ");
  return text;
}

class Binary {
 public:
  Binary(bool records, bool swapped, bool doubles) : records_(records), swapped_(swapped), doubles_(doubles) {}

  std::string of(bool blanks) {
    begin(), put<std::int32_t>(2), end();
    begin();
    for (const auto& n : counts)
      for (const std::int32_t k : n) put(k);
    end();
    for (int b = 0; b < 2; ++b) {
      begin();
      const std::vector<double> numbers = numbers_of(b, blanks);
      const std::size_t reals = b == 0 ? 18 : 24;
      for (std::size_t k = 0; k < numbers.size(); ++k) {
        if (k >= reals)
          put(static_cast<std::int32_t>(numbers[k]));
        else if (doubles_)
          put(numbers[k]);
        else
          put(static_cast<float>(numbers[k]));
      }
      end();
    }
    return bytes_;
  }

 private:
  template <typename T>
  std::string raw(T value) const {
    std::string text(sizeof value, '\0');
    std::memcpy(text.data(), &value, sizeof value);
    if (swapped_) std::reverse(text.begin(), text.end());
    return text;
  }
  template <typename T>
  void put(T value) {
    record_ += raw(value);
  }
  void begin() { record_.clear(); }
  void end() {
    const std::string mark = records_ ? raw(static_cast<std::int32_t>(record_.size())) : "";
    bytes_ += mark + record_ + mark;
  }

  bool records_, swapped_, doubles_;
  std::string bytes_, record_;
};

TEST(GridFiles, Plot3dIsReadFromTextAndAllKindsOfBinaryFiles) {
  for (const bool blanks : {false, true}) {
    expect_blocks(read_plot3d(text_of(blanks), "g"), blanks);
    for (const bool records : {false, true})
      for (const bool swapped : {false, true})
        for (const bool doubles : {false, true})
          expect_blocks(read_plot3d(Binary(records, swapped, doubles).of(blanks), "g"), blanks);
  }
}

TEST(GridFiles, Plot3dHasOneBlockRepeatedNumbersAndFortransExponents) {
  const Grid grid = read_plot3d("2 2 1\n0 1.D0 0 1 2*0 2*1\n4*0.5", "g");
  ASSERT_EQ(grid.blocks.size(), 1U);
  EXPECT_EQ(grid.blocks[0].node(1, 1), (Vec3{1, 1, 0.5}));
  EXPECT_EQ(grid.blocks[0].measured, Measured::points);
}

TEST(GridFiles, Plot3dVolumesAreTheirOuterFaces) {
  // Boxes [0, 2] x [0, 1] x [0, 3] side by side along x: the side between them is inside.
  const auto box = [](double shift) {
    std::string text;
    for (int axis = 0; axis < 3; ++axis)
      for (int k = 0; k < 4; ++k)
        for (int j = 0; j < 2; ++j)
          for (int i = 0; i < 3; ++i)
            text += std::to_string(axis == 0 ? i + shift : axis == 1 ? j : k) + " ";
    return text;
  };
  for (const int boxes : {1, 2}) {
    std::string text = std::to_string(boxes) + "\n";
    for (int b = 0; b < boxes; ++b) text += "3 2 4\n";
    for (int b = 0; b < boxes; ++b) text += box(2.0 * b) + "\n";
    const Grid grid = read_plot3d(text, "g");
    EXPECT_EQ(grid.blocks.size(), boxes == 1 ? 6U : 10U);
    double area = 0;
    for (const auto& block : grid.blocks) {
      const auto columns = static_cast<std::size_t>(block.columns);
      ASSERT_EQ(block.nodes.size(), columns * static_cast<std::size_t>(block.rows));
      const Vec3 across = block.nodes[columns - 1] - block.nodes[0], up = block.nodes[block.nodes.size() - columns] - block.nodes[0];
      area += norm(cross(across, up));
    }
    EXPECT_NEAR(area, boxes == 1 ? 22 : 38, 1e-9);
  }
}

TEST(GridFiles, WrongPlot3dIsRejectedWithBlockAndLine) {
  EXPECT_EQ(refusal(read_plot3d, "3 1 1\n"), "g, line 1: block 1 has 3 x 1 x 1 nodes, one row only; a surface has two or more");
  EXPECT_EQ(refusal(read_plot3d, "2 2 0\n"), "g, line 1: block 1 has 2 x 2 x 0 nodes; all three counts must be positive");
  EXPECT_EQ(refusal(read_plot3d, "2 2 1\n0 1 0 1\n0 0 1 1\n0 0 0"), "g, line 4: the file ends where z of block 1 was expected");
  EXPECT_EQ(refusal(read_plot3d, "2 2 1\n0 1 0 1\n0 0 x 1\n"), "g, line 3: y of block 1 should be a number, not 'x'");
  EXPECT_EQ(refusal(read_plot3d, "2 2 1\n0 1 0 1\n0 0 1 1\n0 0 0 0 7"),
            "g, line 4: the file ends where IBLANK of block 1 was expected");
  EXPECT_EQ(refusal(read_plot3d, "2 2 1\n0 1 0 1\n0 0 1 1\n0 0 0 0 1 1 1 1 1"),
            "g, line 4: the file goes on behind the last block: '1'");
  EXPECT_EQ(refusal(read_plot3d, "1 2\n"), "g, line 1: the first line should be a number of blocks, or the three counts of one, "
                                           "and has 2 words");
  EXPECT_NE(refusal(read_plot3d, "30000 30000 1\n1").find("more than the file can hold"), std::string::npos);
  std::string cut = Binary(true, false, true).of(false);
  cut.pop_back();
  EXPECT_NE(refusal(read_plot3d, cut).find("bytes are not PLOT3D"), std::string::npos);
}

TEST(GridFiles, EsriGridsStartInTheNorthAndHaveCells) {
  const Grid grid = read_heights(
      "ncols 3\nnrows 2\nxllcorner 10\nyllcorner 20\ncellsize 4\nNODATA_value -1\n1 2 3\n4 -1 6\n", "g");
  const Block& block = grid.blocks.at(0);
  EXPECT_EQ(block.measured, Measured::heights);
  EXPECT_EQ(block.node(0, 1), (Vec3{12, 26, 1}));
  EXPECT_EQ(block.node(2, 0), (Vec3{20, 22, 6}));
  EXPECT_FALSE(block.has(1, 0));
  EXPECT_EQ(read_heights("ncols 2\nnrows 2\nxllcenter 1\nyllcenter 2\ncellsize 4\n0 0\n0 0\n", "g").blocks[0].node(0, 0),
            (Vec3{1, 2, 0}));
}

TEST(GridFiles, PlainHeightsHaveAHeaderOrNone) {
  EXPECT_EQ(read_heights("3 2\n1 2 3\n4 5 6\n", "g", 10).blocks[0].node(2, 1), (Vec3{20, 10, 6}));
  EXPECT_EQ(read_heights("3 2 0.5 2 7 8\n1 2 3\n4 nan 6\n", "g").blocks[0].node(2, 1), (Vec3{8, 10, 6}));
  EXPECT_EQ(read_heights("1 2 3\n4 5 6\n7 8 9\n", "g").blocks[0].node(1, 2), (Vec3{1, 2, 8}));
  const Grid volcano = read_grid(std::string(CARREAU_SOURCE_DIR) + "/tests/data/grid/volcano.txt", GridFormat::by_suffix, 10);
  EXPECT_EQ(volcano.blocks[0].columns, 87);
  EXPECT_EQ(volcano.blocks[0].rows, 61);
  double low = HUGE_VAL, high = 0;
  for (const Vec3& p : volcano.blocks[0].nodes) low = std::min(low, p.z()), high = std::max(high, p.z());
  EXPECT_EQ(low, 94);
  EXPECT_EQ(high, 195);
}

TEST(GridFiles, WrongHeightsAreRejectedWithTheLine) {
  EXPECT_EQ(refusal(heights, ""), "g, line 1: the file is empty");
  EXPECT_EQ(refusal(heights, "1 2 3\n4 5\n"), "g, line 2: the row has 2 heights, the first one has 3");
  EXPECT_EQ(refusal(heights, "1 2 3 4 5 6 7\n"), "g, line 1: the grid has 7 x 1 nodes; a surface needs two rows and two columns");
  EXPECT_EQ(refusal(heights, "3 2\n1 2 3\n4 5\n"), "g, line 4: the file ends where a height was expected");
  EXPECT_EQ(refusal(heights, "3 2\n1 2 3\n4 5 6\n7\n"), "g, line 4: the file goes on behind the last node: '7'");
  EXPECT_EQ(refusal(heights, "ncols 3\nnrow 2\n1 2 3\n"), "g, line 2: the header has no word 'nrow'");
  EXPECT_EQ(refusal(heights, std::string("1 2\0 3", 6)), "g: the file is binary; text is expected");
  EXPECT_EQ(refusal(heights, "3 2 -1 1\n1 2 3\n4 5 6\n"), "g, line 1: the step of the grid must be finite and positive");
}

/// Columns from 1, as the format counts.
void put(std::string& record, std::size_t column, const std::string& word, std::size_t width) {
  record.replace(column - 1 + width - word.size(), word.size(), word);
}

TEST(GridFiles, DemOfUsgsHasProfilesThatStartWhereTheyLike) {
  std::string file(1024, ' ');
  put(file, 817, "0.300000E+02", 12), put(file, 829, "0.300000E+02", 12), put(file, 841, "0.500000E+00", 12);
  put(file, 853, "1", 6), put(file, 859, "2", 6);
  for (int i = 0; i < 2; ++i) {
    const int n = 200 - i;  // more than one block of 146 heights
    std::string profile(2048, ' ');
    put(profile, 13, std::to_string(n), 6), put(profile, 19, "1", 6);
    put(profile, 25, i == 0 ? "0.100000000000000D+03" : "0.130000000000000D+03", 24);
    put(profile, 49, i == 0 ? "0.0D+00" : "0.300000000000000D+02", 24), put(profile, 73, "0.1D+01", 24);
    for (int k = 0; k < n; ++k)
      put(profile, k < 146 ? 145 + 6 * k : 1024 + 1 + 6 * (k - 146), k == 3 ? "-32767" : std::to_string(k), 6);
    file += profile;
  }
  const Block block = read_heights(file, "g").blocks.at(0);
  EXPECT_EQ(block.columns, 2);
  EXPECT_EQ(block.rows, 200);
  EXPECT_EQ(block.node(0, 199), (Vec3{100, 30 * 199, 1 + 0.5 * 199}));
  EXPECT_EQ(block.node(1, 199), (Vec3{130, 30 * 199, 1 + 0.5 * 198}));
  EXPECT_FALSE(block.has(0, 3));
  EXPECT_FALSE(block.has(1, 0));
  EXPECT_FALSE(block.has(1, 4));
}

TEST(GridFiles, ScansAreClosed) {
  const Block block = read_scan("4 2 0.5 -3\n1 2 1 2\n1 1 1 nan\n", "g").blocks.at(0);
  EXPECT_EQ(block.columns, 5);
  EXPECT_EQ(block.measured, Measured::radii);
  EXPECT_LE(norm(block.node(1, 0) - Vec3{0, 2, -3}), 1e-15);
  EXPECT_EQ(block.node(4, 1), block.node(0, 1));
  EXPECT_FALSE(block.has(3, 1));
  EXPECT_EQ(refusal(scan, "4 2\n1 1 1 1\n1 -1 1 1\n"), "g, line 3: the distance from the axis is -1; it must be positive");
  EXPECT_EQ(refusal(scan, "4\n"), "g, line 1: the first line of a scan is 'angles heights [dz [z]]'");
}

TEST(GridFiles, ListsOfNodesComeInAnyOrder) {
  const Grid grid = read_nodes("# i j x y z\n2 1 1 0 0\n1 1 0 0 0\n1 2 0 1 0\n", "g");
  EXPECT_EQ(grid.blocks.at(0).columns, 2);
  EXPECT_EQ(grid.blocks[0].node(1, 0), (Vec3{1, 0, 0}));
  EXPECT_FALSE(grid.blocks[0].has(1, 1));
  EXPECT_EQ(read_nodes("1 0 0 0 0 0\n1 1 1 1 1 1\n7 0 0 0 0 0\n7 1 1 0 0 0\n", "g").blocks.size(), 2U);
  EXPECT_EQ(refusal(read_nodes, "1 1 0 0 0\n1 1 0 0 0\n2 2 0 0 0\n"), "g, line 2: node (1, 1) of block 1 is given twice");
  EXPECT_EQ(refusal(read_nodes, "1 1 0 0 0\n1 2 0 0 0\n"),
            "g, line 1: block 1 has 1 x 2 nodes; a surface needs two rows and two columns");
  EXPECT_EQ(refusal(read_nodes, "1 1 0 0 0\n9999 9999 0 0 0\n"),
            "g, line 1: block 1 would have 9999 x 9999 nodes, and only 2 are given");
  EXPECT_EQ(refusal(read_nodes, "1 1 0\n"), "g, line 1: lines of nodes are 'i j x y z' or 'block i j x y z'");
}

TEST(GridFiles, AnErrorForOtherSuffixesListsTheFormats) {
  EXPECT_THROW(read_grid("x.foo"), FileError);
  EXPECT_THROW(read_grid("does not exist.fmt"), FileError);
}

}  // namespace
}  // namespace carreau
