// Solution files of Medit: values at the vertices of a mesh in another file.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "metric/metric2.h"
#include "metric/metric3.h"

namespace carreau {

/// One scalar, or one symmetric tensor, at each vertex.
struct Solution {
  int dimension = 3;  ///< 2 or 3: of the space of the mesh
  bool tensor = false;
  /// Vertex by vertex. A tensor has the entries (xx, xy, yy) or (xx, xy, yy, xz, yz, zz): the lower triangle row by
  /// row, which is the order of the files.
  std::vector<double> values;

  [[nodiscard]] std::size_t components() const noexcept { return !tensor ? 1u : dimension == 2 ? 3u : 6u; }
  [[nodiscard]] std::size_t count() const noexcept { return values.size() / components(); }
  friend bool operator==(const Solution&, const Solution&) = default;
};

/// What values are read for.
enum class SolutionUse {
  field,         ///< any finite numbers
  prescription,  ///< positive sizes or positive definite metrics
};

/// Reads SolAtVertices of a `.sol` (ASCII, versions 0 to 4) or `.solb` (GMF binary, versions 1 to 4, either byte
/// order), told apart by the content; other sections are skipped. Throws FileError, with file and line or byte, for
/// anything but one finite scalar or symmetric tensor a vertex, and for values that the use does not allow.
Solution read_solution(const std::string& path, SolutionUse use = SolutionUse::field);
Solution read_solution_text(std::string_view text, const std::string& name, SolutionUse use = SolutionUse::field);
Solution read_solution_binary(std::string_view bytes, const std::string& name, SolutionUse use = SolutionUse::field);

/// The tensor of a vertex (from 0) of a solution of dimension 2 or 3.
Metric2 plane_tensor(const Solution& solution, std::size_t vertex) noexcept;
Metric3 space_tensor(const Solution& solution, std::size_t vertex) noexcept;

/// ASCII of version 2, every number as it is. Throws InvalidArgument when the number of values is no multiple of
/// components() or one is not finite.
std::string solution_text(const Solution& solution);
/// GMF version 2.
std::string solution_bytes(const Solution& solution);
/// By suffix: `.sol` or `.solb`. Throws what solution_text throws, InvalidArgument for another suffix, FileError.
void write_solution(const Solution& solution, const std::string& path);

}  // namespace carreau
