// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>
#include <map>

#include "io/grid/grid_files.h"
#include "io/grid/grid_text.h"
#include "io/text.h"
#include "io/words.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

using grid::Block;
using grid::Grid;

struct Entry {
  int i, j;
  Vec3 p;
  const char* at;
};

std::size_t words_on_line(std::string_view text, const std::string& name) {
  std::size_t from = 0;
  while (from < text.size()) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    std::size_t n = 0;
    for (Words words(text.substr(from, end - from), name, '#'); !words.word().empty();) ++n;
    if (n > 0) return n;
    from = end + 1;
  }
  return 0;
}

std::map<int, std::vector<Entry>> read_entries(Words& words, bool with_block) {
  std::map<int, std::vector<Entry>> blocks;
  for (;;) {
    const char* const before = words.position();
    const std::string_view first = words.word();
    if (first.empty()) return blocks;
    words.go_back(before);
    const int block = with_block ? words.integer("a block") : 1;
    Entry entry{.i = words.integer("i"), .j = words.integer("j"), .p = {}, .at = first.data()};
    entry.p.x() = words.real_or_nan("x"), entry.p.y() = words.real_or_nan("y"), entry.p.z() = words.real_or_nan("z");
    blocks[block].push_back(entry);
  }
}

struct Range {
  std::int64_t low = std::numeric_limits<int>::max(), high = std::numeric_limits<int>::min();
  void add(int k) { low = std::min<std::int64_t>(low, k), high = std::max<std::int64_t>(high, k); }
  [[nodiscard]] std::int64_t count() const { return high - low + 1; }
};

Block block_of(const std::vector<Entry>& entries, const Words& words, const std::string& block) {
  Range i, j;
  for (const Entry& entry : entries) i.add(entry.i), j.add(entry.j);
  if (i.count() < 2 || j.count() < 2)
    words.fail(entries.front().at, block + " has " + std::to_string(i.count()) + " x " + std::to_string(j.count()) +
                                       " nodes; a surface needs two rows and two columns");
  constexpr std::int64_t max_missing = 1000;  // for each that is there: a mistake in an index, not a hole
  if (i.count() > std::numeric_limits<std::int32_t>::max() / j.count() ||
      i.count() * j.count() > max_missing * static_cast<std::int64_t>(entries.size()))
    words.fail(entries.front().at, block + " would have " + std::to_string(i.count()) + " x " +
                                       std::to_string(j.count()) + " nodes, and only " +
                                       std::to_string(entries.size()) + " are given");
  Block made{.columns = static_cast<int>(i.count()), .rows = static_cast<int>(j.count()), .nodes = {}};
  made.nodes.assign(static_cast<std::size_t>(i.count() * j.count()),
                    Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
  std::vector<char> seen(made.nodes.size(), 0);
  for (const Entry& entry : entries) {
    const std::size_t k = made.index(static_cast<int>(entry.i - i.low), static_cast<int>(entry.j - j.low));
    if (seen[k] != 0)
      words.fail(entry.at, "node (" + std::to_string(entry.i) + ", " + std::to_string(entry.j) + ") of " + block +
                               " is given twice");
    seen[k] = 1, made.nodes[k] = entry.p;
  }
  return made;
}

}  // namespace

Grid read_nodes(std::string_view text, const std::string& name) {
  require_text(text, name);
  text = without_byte_order_mark(text);
  const std::size_t n = words_on_line(text, name);
  constexpr std::size_t plain = 5;
  if (n != plain && n != plain + 1)
    throw FileError({.file = name, .line = 1},
                    n == 0 ? "the file is empty" : "lines of nodes are 'i j x y z' or 'block i j x y z'");
  Words words(text, name, '#');
  Grid made{.blocks = {}, .source = name};
  for (const auto& [block, entries] : read_entries(words, n != plain))
    made.blocks.push_back(block_of(entries, words, "block " + std::to_string(block)));
  return made;
}

}  // namespace carreau
