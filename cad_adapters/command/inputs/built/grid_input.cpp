// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/built/grid_input.h"

#include <carreau_geometry.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fstream>
#include <sstream>

#include "base/failure.h"
#include "base/text_file.h"
#include "inputs/base/built_input.h"

namespace command {
namespace {

/// "rounds" or "rounds,w1,w2"; ",distance" may follow.
bool read_smoothing(const std::string& text, carreau_grid_options& options) {
  const std::string by_distance = ",distance";
  const bool weighted = text.size() > by_distance.size() && text.compare(text.size() - by_distance.size(), by_distance.size(), by_distance) == 0;
  options.smoothing_by_distance = weighted ? 1 : 0;
  const char *p = text.data(), *const end = p + text.size() - (weighted ? by_distance.size() : 0);
  auto result = std::from_chars(p, end, options.smoothing_rounds);
  if (result.ec != std::errc() || options.smoothing_rounds < 0) return false;
  if (result.ptr == end) return true;
  for (double* weight : {&options.smoothing_inward, &options.smoothing_outward}) {
    if (result.ptr == end || *result.ptr != ',') return false;
    result = std::from_chars(result.ptr + 1, end, *weight);
    if (result.ec != std::errc() || !(*weight > 0 && *weight < 1)) return false;
  }
  return result.ptr == end;
}

carreau_grid_options options_of(const GridChoice& choice) {
  carreau_grid_options options{};
  options.struct_size = sizeof options;
  if (!choice.smoothing.empty()) read_smoothing(choice.smoothing, options);
  options.lengths = choice.lengths ? 1 : 0;
  options.orient = 1;
  options.fill = choice.fill ? 1 : 0;
  options.join_angle = choice.join_angle;
  options.tolerance = choice.tolerance;
  options.step = choice.step;
  options.continuity = choice.continuity;
  return options;
}

/// Counts the integers of a line that holds integers alone.
int integers_in(const std::string& line) {
  std::istringstream words(line);
  int count = 0;
  for (std::string word; words >> word; ++count)
    if (word.find_first_not_of("0123456789") != std::string::npos) return 0;
  return count;
}

/// Files .xyz are molecules or grids of PLOT3D. Grids are binary, or begin with counts of nodes: two numbers or three,
/// which may stand below the number of blocks. A molecule begins with the number of its atoms and a title.
bool is_plot3d(const std::string& path) {
  if (suffix_of(path) != ".xyz") return false;
  std::ifstream file(path, std::ios::binary);
  std::string begin(256, '\0');
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(file.gcount()));
  if (begin.find('\0') != std::string::npos) return true;
  std::istringstream lines(begin);
  std::string first, second, third;
  std::getline(lines, first), std::getline(lines, second), std::getline(lines, third);
  if (integers_in(first) != 1) return integers_in(first) > 1;
  const std::size_t word = third.find_first_not_of(" \t");
  const bool symbol = word != std::string::npos && std::isalpha(static_cast<unsigned char>(third[word])) != 0;
  return integers_in(second) > 1 && !symbol;
}

carreau_status load(carreau_session* session, const std::string& path, const GridChoice& choice) {
  const auto* const format = std::find(std::begin(grid_formats), std::end(grid_formats), choice.format);
  const auto rank = static_cast<std::int32_t>(format - std::begin(grid_formats));
  const carreau_grid_options options = options_of(choice);
  return carreau_load_grid(session, &options, path.c_str(),
                           !choice.format.empty() ? CARREAU_GRID_PLOT3D + rank
                           : is_plot3d(path)      ? CARREAU_GRID_PLOT3D
                                                  : CARREAU_GRID_BY_SUFFIX);
}

class GridInput final : public BuiltInput {
 public:
  GridInput(SessionHandle session, const std::string& path, const GridChoice& choice)
      : BuiltInput(std::move(session), path), path_(path), choice_(choice) {}

  carreau_status give_to(carreau_session* session) override { return load(session, path_, choice_); }

  /// Nodes that are one have one reference: short curves are no mistake.
  [[nodiscard]] double ends_tolerance() const override { return 1e-9 * diagonal(); }

 private:
  [[nodiscard]] std::string kind(std::int32_t) const override { return "grid"; }

  std::string path_;
  GridChoice choice_;
};

}  // namespace

bool is_grid(const std::string& path, const GridChoice& choice) {
  const std::string suffix = suffix_of(path);
  return !choice.format.empty() || is_plot3d(path) || std::any_of(std::begin(grid_suffixes), std::end(grid_suffixes),
                                               [&](const char* known) { return suffix == known; });
}

std::string smoothing_defect(const std::string& text) {
  carreau_grid_options options{};
  return read_smoothing(text, options) ? "" : "'" + text + "' is not a number of rounds, alone or with two weights: 2000,0.06,0.061, and ',distance' behind";
}

std::unique_ptr<CadInput> open_grid(const std::string& path, const GridChoice& choice) {
  SessionHandle session = make_silent_session();
  require(session.get(), load(session.get(), path, choice));
  return std::make_unique<GridInput>(std::move(session), path, choice);
}

}  // namespace command
