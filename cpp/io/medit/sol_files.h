// SPDX-License-Identifier: BSD-3-Clause
// Solution files of Medit: values at the vertices of a mesh in another file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "metric/metric2.h"
#include "metric/metric3.h"

namespace carreau {

/// Types of values, numbered as in the files.
enum class ValueType : std::int32_t { scalar = 1, vector = 2, symmetric = 3, full = 4 };

/// Numbers that a value of this type has in space of dimension 2 or 3.
constexpr std::size_t components_of(ValueType type, int dimension) noexcept {
  const auto d = static_cast<std::size_t>(dimension);
  switch (type) {
    case ValueType::vector:
      return d;
    case ValueType::symmetric:
      return d * (d + 1) / 2;
    case ValueType::full:
      return d * d;
    default:
      return 1;
  }
}

/// One scalar, or one symmetric tensor, at each vertex; or several fields.
struct Solution {
  int dimension = 3;  ///< 2 or 3: of the space of the mesh
  bool tensor = false;
  /// Vertex by vertex. A tensor has the entries (xx, xy, yy) or (xx, xy, yy, xz, yz, zz): the lower triangle row by
  /// row, which is the order of the files.
  std::vector<double> values;
  /// For SolutionUse::fields: the type of each field, in place of `tensor`; otherwise empty.
  std::vector<ValueType> fields = {};

  [[nodiscard]] std::size_t components() const noexcept {
    if (fields.empty()) return !tensor ? 1u : dimension == 2 ? 3u : 6u;
    std::size_t sum = 0;
    for (const ValueType type : fields) sum += components_of(type, dimension);
    return sum;
  }
  [[nodiscard]] std::size_t count() const noexcept { return values.size() / components(); }
  friend bool operator==(const Solution&, const Solution&) = default;
};

/// The use of the values.
enum class SolutionUse {
  field,         ///< any finite numbers
  prescription,  ///< positive sizes or positive definite metrics
  fields,        ///< any number of fields of finite numbers, of any types
};

/// A use, and the field of a file with several.
struct SolutionChoice {
  SolutionUse use = SolutionUse::field;
  std::int32_t field = 0;  ///< from 1; 0: all of SolutionUse::fields, otherwise the only one

  SolutionChoice(SolutionUse what = SolutionUse::field, std::int32_t which = 0) : use(what), field(which) {}
};

/// Reads SolAtVertices of a `.sol` (ASCII, versions 0 to 4) or `.solb` (GMF binary, versions 1 to 4, either byte order), recognised by the
/// content; other sections are skipped. Throws FileError, with file and line or byte, unless each vertex has one finite scalar or symmetric
/// tensor (SolutionUse::fields: up to 64 fields). Throws it, too, for values that the use does not allow. A wrong choice lists the fields.
Solution read_solution(const std::string& path, const SolutionChoice& choice = {});
Solution read_solution_text(std::string_view text, const std::string& name, const SolutionChoice& choice = {});
Solution read_solution_binary(std::string_view bytes, const std::string& name, const SolutionChoice& choice = {});

/// The tensor of a vertex (from 0) of a solution of dimension 2 or 3.
Metric2 plane_tensor(const Solution& solution, std::size_t vertex) noexcept;
Metric3 space_tensor(const Solution& solution, std::size_t vertex) noexcept;

/// ASCII of version 2, every number as it is. Throws InvalidArgument when the number of values is no multiple of
/// components() or one is not finite.
std::string solution_text(const Solution& solution);
/// GMF version 2.
std::string solution_bytes(const Solution& solution);
/// By suffix: `.sol` or `.solb`. Throws the exceptions of solution_text, InvalidArgument for another suffix, FileError.
void write_solution(const Solution& solution, const std::string& path);

}  // namespace carreau
