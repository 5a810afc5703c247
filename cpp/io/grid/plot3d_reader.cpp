// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "io/grid/grid_files.h"
#include "io/grid/grid_text.h"
#include "io/raw_numbers.h"
#include "io/text.h"
#include "io/words.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

using grid::Block;
using grid::Grid;
using Counts = std::array<std::int32_t, 3>;

std::string block_name(std::size_t b) { return "block " + std::to_string(b + 1); }

std::string shape_of(const Counts& n) {
  return std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x " + std::to_string(n[2]);
}

std::uint64_t nodes_of(const Counts& n) {
  return static_cast<std::uint64_t>(n[0]) * static_cast<std::uint64_t>(n[1]) * static_cast<std::uint64_t>(n[2]);
}

/// The defect of the counts of a block; "" if they are sound.
std::string defect_of(const Counts& n) {
  int ones = 0;
  for (const std::int32_t k : n) {
    if (k < 1) return "has " + shape_of(n) + " nodes; all three counts must be positive";
    if (k == 1) ++ones;
  }
  if (ones > 1) return "has " + shape_of(n) + " nodes, one row only; a surface has two or more";
  if (nodes_of(n) > std::numeric_limits<std::int32_t>::max()) return "has more than 2^31 nodes";
  return "";
}

bool is_volume(const Counts& n) noexcept { return n[0] > 1 && n[1] > 1 && n[2] > 1; }

Block empty_block(const Counts& n) {
  Block block;
  block.columns = n[0] == 1 ? n[1] : n[0];
  block.rows = n[2] == 1 ? n[1] : n[2];
  if (is_volume(n)) block.rows = n[1] * n[2];  // until with_outer_faces() takes the nodes
  block.nodes.resize(static_cast<std::size_t>(nodes_of(n)));
  return block;
}

void leave_out(Vec3& node) { node = Vec3::Constant(std::numeric_limits<double>::quiet_NaN()); }

/// Side `last` (0: the first nodes, 1: the last ones) across the axis of a volume.
Block face_of(const Block& volume, const Counts& n, std::size_t axis, int last) {
  const std::size_t across = (axis + 1) % 3, up = (axis + 2) % 3;
  Block face;
  face.line = volume.line, face.measured = volume.measured;
  face.columns = n[across], face.rows = n[up];
  std::array<std::int32_t, 3> at{};
  at[axis] = last == 0 ? 0 : n[axis] - 1;
  for (at[up] = 0; at[up] < n[up]; ++at[up])
    for (at[across] = 0; at[across] < n[across]; ++at[across])
      face.nodes.push_back(volume.nodes[static_cast<std::size_t>(at[0]) +
                                        static_cast<std::size_t>(n[0]) * (static_cast<std::size_t>(at[1]) +
                                                                          static_cast<std::size_t>(n[1]) * static_cast<std::size_t>(at[2]))]);
  return face;
}

/// The corners of a block and its counts, whatever way it runs.
std::vector<double> signature_of(const Block& block) {
  const auto columns = static_cast<std::size_t>(block.columns), rows = static_cast<std::size_t>(block.rows);
  std::array<std::array<double, 3>, 4> corners{};
  const std::size_t ranks[] = {0, columns - 1, columns * (rows - 1), columns * rows - 1};
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t c = 0; c < 3; ++c) {
      const double x = block.nodes[ranks[k]][static_cast<Eigen::Index>(c)];
      corners[k][c] = std::isnan(x) ? 0 : x;
    }
  std::ranges::sort(corners);
  std::vector<double> signature;
  for (const auto& corner : corners) signature.insert(signature.end(), corner.begin(), corner.end());
  signature.push_back(std::min(block.columns, block.rows)), signature.push_back(std::max(block.columns, block.rows));
  return signature;
}

/// Replaces volumes by their six sides, except sides that two volumes share.
std::vector<Block> with_outer_faces(std::vector<Block> blocks, const std::vector<Counts>& counts) {
  std::vector<Block> made;
  std::map<std::vector<double>, std::size_t> of_volumes;
  std::vector<char> shared;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (!is_volume(counts[b])) {
      made.push_back(std::move(blocks[b])), shared.push_back(0);
      continue;
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int last : {0, 1}) {
        made.push_back(face_of(blocks[b], counts[b], axis, last)), shared.push_back(0);
        const auto [known, added] = of_volumes.emplace(signature_of(made.back()), made.size() - 1);
        if (!added) shared[known->second] = shared.back() = 1;
      }
  }
  std::vector<Block> outer;
  for (std::size_t b = 0; b < made.size(); ++b)
    if (shared[b] == 0) outer.push_back(std::move(made[b]));
  return outer;
}

/// Numbers of a text, `5*0.25` standing for five of them.
class Numbers {
 public:
  Numbers(Words& words) : words_(words) {}  // NOLINT(google-explicit-constructor)

  double next(const char* what) {
    if (left_ > 0) return --left_, value_;
    const char* const before = words_.position();
    const std::string_view word = words_.word();
    const std::size_t star = word.find('*');
    if (star == std::string_view::npos) {
      words_.go_back(before);
      return words_.real_or_nan(what);
    }
    int times = 0;
    if (!parse_number(word.substr(0, star), times) || times < 1 || !parse_number(word.substr(star + 1), value_))
      words_.fail(word.data(), std::string(what) + " should be a number, not " + shown(word));
    left_ = times - 1;
    return value_;
  }

 private:
  Words& words_;
  int left_ = 0;
  double value_ = 0;
};

std::size_t words_on_first_line(std::string_view text, const std::string& name) {
  std::size_t n = 0;
  const std::string_view line = text.substr(0, text.find('\n'));
  for (Words words(line, name); !words.word().empty();) ++n;
  return n;
}

std::vector<Counts> read_counts(Words& words, std::size_t on_first_line, const std::string& name) {
  std::size_t blocks = 1;
  const char* const start = words.position();
  if (on_first_line != 3) {
    const std::int32_t n = words.integer("the number of blocks");
    if (on_first_line != 1 && on_first_line != 1 + 3 * static_cast<std::size_t>(n))
      words.fail(start, "the first line should be a number of blocks, or the three counts of one, and has " +
                            std::to_string(on_first_line) + " words");
    if (n == 0) throw FileError({.file = name, .line = 1}, "the file has no block");
    blocks = words.checked_count(n, start, "blocks", 3);
  }
  std::vector<Counts> counts(blocks);
  for (std::size_t b = 0; b < blocks; ++b) {
    for (std::int32_t& n : counts[b]) n = words.integer("a count of nodes");
    if (const std::string defect = defect_of(counts[b]); !defect.empty())
      words.fail(words.position() - 1, block_name(b) + " " + defect);
  }
  return counts;
}

void check_room(const Words& words, const std::vector<Counts>& counts, const std::string& name) {
  std::uint64_t nodes = 0;
  for (const Counts& n : counts) nodes += nodes_of(n);
  // `9*0 ` is the shortest way to write several numbers.
  constexpr std::uint64_t max_repeated = 1 << 20;
  const auto bytes = static_cast<std::uint64_t>(words.end() - words.position());
  if (nodes > max_repeated && nodes > bytes)
    throw FileError({.file = name}, std::to_string(nodes) + " nodes are announced, more than the file can hold");
}

/// The layout of a binary file.
struct Layout {
  bool records = false, swapped = false, single = false, blanks = false;
  std::size_t bytes = 8;  ///< of a real number
};

class BinaryFile {
 public:
  BinaryFile(std::string_view bytes, const Layout& layout) : bytes_(bytes), layout_(layout) {}

  /// True if header and size fit.
  bool fits() {
    std::uint64_t at = 0;
    std::int32_t blocks = 1;
    if (!layout_.single) {
      if (!enter(at, 4) || !integer(at, blocks) || blocks < 1 || !leave(at, 4)) return false;
      if (static_cast<std::uint64_t>(blocks) * 12 > bytes_.size()) return false;
    }
    const std::uint64_t header = 12 * static_cast<std::uint64_t>(blocks);
    if (!enter(at, header)) return false;
    counts_.resize(static_cast<std::size_t>(blocks));
    for (Counts& n : counts_)
      for (std::int32_t& k : n)
        if (!integer(at, k) || k < 1) return false;
    if (!leave(at, header)) return false;
    data_ = at;
    for (const Counts& n : counts_) {
      const std::uint64_t length = length_of(n);
      if (length > bytes_.size() || !enter(at, length)) return false;
      at += length;
      if (!leave(at, length)) return false;
    }
    return at == bytes_.size();
  }

  [[nodiscard]] const std::vector<Counts>& counts() const { return counts_; }

  [[nodiscard]] Grid grid() const {
    Grid made;
    std::uint64_t at = data_;
    for (const Counts& n : counts_) {
      at += layout_.records ? 4 : 0;
      made.blocks.push_back(block(n, at));
      at += length_of(n) + (layout_.records ? 4 : 0);
    }
    return made;
  }

 private:
  [[nodiscard]] std::uint64_t length_of(const Counts& n) const {
    constexpr std::uint64_t too_many = std::uint64_t{1} << 40U;
    if (nodes_of({n[0], n[1], 1}) > too_many || nodes_of(n) > too_many) return ~std::uint64_t{0};
    return nodes_of(n) * (3 * layout_.bytes + (layout_.blanks ? 4 : 0));
  }
  bool integer(std::uint64_t& at, std::int32_t& value) const {
    if (at + 4 > bytes_.size()) return false;
    value = raw_number<std::int32_t>(bytes_.data() + at, layout_.swapped);
    at += 4;
    return true;
  }
  /// The mark of a record of Fortran.
  bool enter(std::uint64_t& at, std::uint64_t length) const {
    std::int32_t mark = 0;
    return !layout_.records || (integer(at, mark) && static_cast<std::uint32_t>(mark) == length);
  }
  bool leave(std::uint64_t& at, std::uint64_t length) const { return enter(at, length); }

  [[nodiscard]] double real(std::uint64_t at) const {
    const char* const p = bytes_.data() + at;
    return layout_.bytes == 8 ? raw_number<double>(p, layout_.swapped) : raw_number<float>(p, layout_.swapped);
  }

  [[nodiscard]] Block block(const Counts& n, std::uint64_t at) const {
    Block made = empty_block(n);
    for (int axis = 0; axis < 3; ++axis)
      for (Vec3& node : made.nodes) node[axis] = real(at), at += layout_.bytes;
    for (std::size_t k = 0; layout_.blanks && k < made.nodes.size(); ++k, at += 4)
      if (raw_number<std::int32_t>(bytes_.data() + at, layout_.swapped) == 0) leave_out(made.nodes[k]);
    return made;
  }

  std::string_view bytes_;
  Layout layout_;
  std::vector<Counts> counts_;
  std::uint64_t data_ = 0;
};

std::vector<Layout> layouts() {
  std::vector<Layout> all;
  for (const bool records : {true, false})
    for (const bool swapped : {false, true})
      for (const bool single : {false, true})
        for (const bool blanks : {false, true})
          for (const std::size_t bytes : {std::size_t{8}, std::size_t{4}})
            all.push_back({records, swapped, single, blanks, bytes});
  return all;
}

std::vector<Block> read_blocks(Words& words, const std::vector<Counts>& counts, bool blanks, std::string_view text) {
  constexpr std::array<const char*, 3> axes{"x", "y", "z"};
  Numbers numbers(words);
  std::vector<Block> blocks;
  for (std::size_t b = 0; b < counts.size(); ++b) {
    Block block = empty_block(counts[b]);
    block.line = line_at(text, static_cast<std::size_t>(words.position() - text.data()));
    for (int axis = 0; axis < 3; ++axis) {
      const std::string what = axes[static_cast<std::size_t>(axis)] + std::string(" of ") + block_name(b);
      for (Vec3& node : block.nodes) node[axis] = numbers.next(what.c_str());
    }
    const std::string what = "IBLANK of " + block_name(b);
    if (blanks)
      for (Vec3& node : block.nodes)
        if (numbers.next(what.c_str()) == 0) leave_out(node);
    blocks.push_back(std::move(block));
  }
  return blocks;
}

}  // namespace

Grid read_plot3d_text(std::string_view text, const std::string& name) {
  text = without_byte_order_mark(text);
  Words words(text, name);
  const std::vector<Counts> counts = read_counts(words, words_on_first_line(text, name), name);
  check_room(words, counts, name);
  const char* const start = words.position();
  Grid made{.blocks = read_blocks(words, counts, false, text), .source = name};
  if (words.word().empty()) {
    made.blocks = with_outer_faces(std::move(made.blocks), counts);
    return made;
  }
  words.go_back(start);
  made.blocks = with_outer_faces(read_blocks(words, counts, true, text), counts);
  if (const std::string_view more = words.word(); !more.empty())
    words.fail(more.data(), "the file goes on behind the last block: " + shown(more));
  return made;
}

Grid read_plot3d_binary(std::string_view bytes, const std::string& name) {
  for (const Layout& layout : layouts()) {
    BinaryFile file(bytes, layout);
    if (!file.fits()) continue;
    for (std::size_t b = 0; b < file.counts().size(); ++b)
      if (const std::string defect = defect_of(file.counts()[b]); !defect.empty())
        throw FileError({.file = name}, block_name(b) + " " + defect);
    Grid made = file.grid();
    made.blocks = with_outer_faces(std::move(made.blocks), file.counts());
    made.source = name;
    return made;
  }
  throw FileError({.file = name},
                  "the file is binary, but its " + std::to_string(bytes.size()) +
                      " bytes are not PLOT3D: counts and size agree for no byte order, precision and kind of records");
}

Grid read_plot3d(std::string_view content, const std::string& name) {
  return is_text(content) ? read_plot3d_text(content, name) : read_plot3d_binary(content, name);
}

}  // namespace carreau
