// SPDX-License-Identifier: BSD-3-Clause
// `carreau refine`: triangles cut finer on the smooth surface over them.
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/json_output.h"
#include "base/output_files.h"
#include "base/signals.h"
#include "commands/commands.h"
#include "inputs/built/known_suffixes.h"
#include "inputs/built/triangles_input.h"

namespace command {

int refine(const RefineOptions& options) {
  catch_signals();
  OutputFiles outputs(options.outputs, mesh_suffixes, {options.input});
  require_writers(options.outputs);
  if (!is_triangles(options.input)) throw Failure(unknown_triangles(options.input));
  const MeshHandle mesh =
      refined_triangles(options.input, options.triangles, options.angle, options.depth, options.quiet);
  std::int64_t vertices = 0, triangles = 0, edges = 0, faces = 0;
  require(mesh.get(), carreau_mesh_count(mesh.get(), &vertices, &triangles, &edges, &faces));
  outputs.write([&](const std::vector<std::string>& hidden) {
    for (const std::string& path : hidden) write_mesh(mesh.get(), path);
  });
  if (options.json)
    print_json("refine", {{"input", options.input},
                          {"vertices", vertices},
                          {"triangles", triangles},
                          {"sharp_edges", edges},
                          {"faces", faces}});
  else if (!options.quiet)
    std::printf("%lld vertices, %lld triangles, %lld edges of sharp lines, %lld faces\n",
                static_cast<long long>(vertices), static_cast<long long>(triangles), static_cast<long long>(edges),
                static_cast<long long>(faces));
  return 0;
}

}  // namespace command
