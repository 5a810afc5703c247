// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/scalar_field.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "support/error.h"
#include "support/format.h"

namespace carreau {

void check_value(double value, const std::string& where) {
  constexpr double largest = 1e100;
  if (std::isfinite(value) && std::abs(value) <= largest) return;
  throw InvalidArgument("the value of a field " + where + " is " + format_number(value) +
                        (std::isfinite(value) ? "; values up to " + format_number(largest) + " can be used" : ""));
}

void check_field(const ScalarField& field) {
  if (field.triangles.empty()) throw InvalidArgument("a field needs a mesh with one triangle at least");
  if (field.values.size() != field.vertices.size())
    throw InvalidArgument("a field needs a value at each vertex; there are " + std::to_string(field.values.size()) +
                          " values and " + std::to_string(field.vertices.size()) + " vertices");
  for (std::size_t v = 0; v < field.values.size(); ++v) {
    if (!is_finite(field.vertices[v]))
      throw InvalidArgument("vertex " + std::to_string(v) + " of a field's mesh is not finite");
    check_value(field.values[v], "at vertex " + std::to_string(v));
  }
  for (std::size_t t = 0; t < field.triangles.size(); ++t)
    for (const std::int32_t v : field.triangles[t])
      if (v < 0 || static_cast<std::size_t>(v) >= field.vertices.size())
        throw InvalidArgument("triangle " + std::to_string(t) + " of a field's mesh has the vertex " +
                              std::to_string(v) + "; there are " + std::to_string(field.vertices.size()));
}

double largest_value(std::span<const double> values) noexcept {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

Neighbours neighbours_of(std::size_t vertices, std::span<const std::array<std::int32_t, 3>> triangles) {
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  pairs.reserve(6 * triangles.size());
  for (const auto& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      pairs.emplace_back(t[i], t[(i + 1) % 3]);
      pairs.emplace_back(t[(i + 1) % 3], t[i]);
    }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  Neighbours result;
  result.start.assign(vertices + 1, 0);
  result.neighbour.reserve(pairs.size());
  for (const auto& [v, w] : pairs) {
    ++result.start[static_cast<std::size_t>(v) + 1];
    result.neighbour.push_back(w);
  }
  for (std::size_t v = 0; v < vertices; ++v) result.start[v + 1] += result.start[v];
  return result;
}

}  // namespace carreau
