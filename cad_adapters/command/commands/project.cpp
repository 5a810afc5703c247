// SPDX-License-Identifier: BSD-3-Clause
// `carreau project`: closest points of a geometry.
#include <carreau_geometry.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/json_output.h"
#include "commands/commands.h"
#include "files/points_file.h"
#include "files/session_handle.h"
#include "inputs/base/cad_input.h"
#include "inputs/open_input.h"

namespace command {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* entity_names[] = {"vertex", "edge", "face"};

struct Closest {
  std::vector<std::int32_t> refs;
  std::vector<double> parameters, xyz, distances;
};

/// In the numbers of the file.
std::int32_t number_of(const CadInput& input, int dimension, std::int32_t ref) {
  return dimension == 2 ? input.whole_face(ref) : dimension == 1 ? input.whole_curve(ref) : ref;
}

Json json_of(const CadInput& input, int dimension, const Closest& closest, std::size_t i) {
  const auto columns = static_cast<std::size_t>(dimension);
  Json row = {{entity_names[columns], number_of(input, dimension, closest.refs[i])}, {"distance", closest.distances[i]}};
  row["xyz"] = {closest.xyz[3 * i], closest.xyz[3 * i + 1], closest.xyz[3 * i + 2]};
  if (dimension == 2) row["uv"] = {closest.parameters[2 * i], closest.parameters[2 * i + 1]};
  if (dimension == 1) row["t"] = closest.parameters[i];
  return row;
}

void print(const CadInput& input, int dimension, const Closest& closest) {
  const auto columns = static_cast<std::size_t>(dimension);
  std::printf("# %s%s distance x y z\n", entity_names[columns], dimension == 2 ? " u v" : dimension == 1 ? " t" : "");
  for (std::size_t i = 0; i < closest.refs.size(); ++i) {
    std::printf("%d", static_cast<int>(number_of(input, dimension, closest.refs[i])));
    for (std::size_t k = 0; k < columns; ++k) std::printf(" %.15g", closest.parameters[columns * i + k]);
    std::printf(" %.15g %.15g %.15g %.15g\n", closest.distances[i], closest.xyz[3 * i], closest.xyz[3 * i + 1], closest.xyz[3 * i + 2]);
  }
}

}  // namespace

int project(const ProjectOptions& options) {
  check_geometry_name(options.input);
  const std::vector<XYZ> points = read_points(options.points);
  const auto input = open_input(options.input, options);
  const SessionHandle session = make_session();
  require(session.get(), carreau_set_integer(session.get(), "threads", options.threads));
  require(session.get(), input->give_to(session.get()));
  const int dimension = options.on == "faces" ? 2 : options.on == "edges" ? 1 : 0;
  const std::size_t n = points.size();
  Closest closest{std::vector<std::int32_t>(n), std::vector<double>(n * static_cast<std::size_t>(dimension)), std::vector<double>(3 * n), std::vector<double>(n)};
  require(session.get(), carreau_project(session.get(), dimension, options.number, static_cast<std::int64_t>(n), points.front().data(), closest.refs.data(),
                                         closest.parameters.data(), closest.xyz.data(), closest.distances.data()));
  if (!options.json) return print(*input, dimension, closest), 0;
  Json rows = Json::array();
  for (std::size_t i = 0; i < n; ++i) rows.push_back(json_of(*input, dimension, closest, i));
  print_json("project", {{"input", options.input}, {"points", rows}});
  return 0;
}

}  // namespace command
