// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstring>
#include <limits>

#include "io/files.h"
#include "io/medit/gmf.h"
#include "io/medit/sol_files.h"
#include "support/error.h"
#include "support/format.h"

namespace carreau {

namespace {

void check(const Solution& solution) {
  if (solution.dimension != 2 && solution.dimension != 3)
    throw InvalidArgument("a solution cannot be written: its dimension is " + std::to_string(solution.dimension));
  if (solution.values.size() % solution.components() != 0)
    throw InvalidArgument("a solution cannot be written: " + std::to_string(solution.values.size()) +
                          " values are not a multiple of " + std::to_string(solution.components()));
  if (solution.count() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw InvalidArgument("a solution cannot be written: it has too many vertices");
  for (std::size_t i = 0; i < solution.values.size(); ++i)
    if (!std::isfinite(solution.values[i]))
      throw InvalidArgument("a solution cannot be written: the value at vertex " +
                            std::to_string(i / solution.components()) + " (from 0) is not finite");
}

std::vector<ValueType> types_of(const Solution& solution) {
  if (!solution.fields.empty()) return solution.fields;
  return {solution.tensor ? ValueType::symmetric : ValueType::scalar};
}

std::string types_text(const Solution& solution) {
  const std::vector<ValueType> types = types_of(solution);
  std::string text = std::to_string(types.size());
  for (const ValueType type : types) text += " " + std::to_string(static_cast<std::int32_t>(type));
  return text;
}

template <typename T>
void append_raw(std::string& bytes, T value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

}  // namespace

std::string solution_text(const Solution& solution) {
  check(solution);
  const std::size_t each = solution.components();
  std::string text = "MeshVersionFormatted 2\n\nDimension\n" + std::to_string(solution.dimension) +
                     "\n\nSolAtVertices\n" + std::to_string(solution.count()) + "\n" + types_text(solution) +
                     "\n";
  text.reserve(text.size() + 22 * solution.values.size() + 10);
  for (std::size_t i = 0; i < solution.values.size(); ++i) {
    append_number(text, solution.values[i]);
    text += (i + 1) % each == 0 ? '\n' : ' ';
  }
  text += "\nEnd\n";
  return text;
}

std::string solution_bytes(const Solution& solution) {
  check(solution);
  // Positions of 64 bits (version 3) when they need be.
  const std::vector<ValueType> types = types_of(solution);
  const std::size_t content = 8 + 4 * types.size() + 8 * solution.values.size();
  const int version = content + 100 > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()) ? 3 : 2;
  std::string bytes;
  bytes.reserve(content + 100);
  const auto section = [&](GmfCode code, std::size_t size) {
    append_raw(bytes, static_cast<std::int32_t>(code));
    const std::size_t next = code == GmfCode::end ? 0 : bytes.size() + gmf_sizes(version).position + size;
    if (version == 3)
      append_raw(bytes, static_cast<std::int64_t>(next));
    else
      append_raw(bytes, static_cast<std::int32_t>(next));
  };
  append_raw(bytes, std::int32_t{1});
  append_raw(bytes, std::int32_t{version});
  section(GmfCode::dimension, 4);
  append_raw(bytes, std::int32_t{solution.dimension});
  section(GmfCode::sol_at_vertices, content);
  append_raw(bytes, static_cast<std::int32_t>(solution.count()));
  append_raw(bytes, static_cast<std::int32_t>(types.size()));
  for (const ValueType type : types) append_raw(bytes, static_cast<std::int32_t>(type));
  for (const double value : solution.values) append_raw(bytes, value);
  section(GmfCode::end, 0);
  return bytes;
}

void write_solution(const Solution& solution, const std::string& path) {
  const std::string suffix = suffix_of(path);
  if (suffix == ".solb") return write_file(path, solution_bytes(solution));
  if (suffix == ".sol") return write_file(path, solution_text(solution));
  throw InvalidArgument("'" + path + "' does not have a suffix of solution files: .sol, .solb");
}

}  // namespace carreau
