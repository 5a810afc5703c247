// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/json_output.h"
#include "base/output_files.h"
#include "base/signals.h"
#include "commands/commands.h"
#include "draw/labels.h"
#include "draw/png_file.h"
#include "inputs/built/triangles_input.h"

namespace command {

namespace {

constexpr const char* own_metrics = "mesh";  // in the place of a file

void print_as_json(const PictureOptions& options, const std::vector<std::string>& views,
                   const std::vector<Label>& labels) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Label& label : labels)
    list.push_back(
        {{"face", label.face}, {"view", views[static_cast<std::size_t>(label.cell)]}, {"x", label.x}, {"y", label.y}});
  nlohmann::ordered_json value = {
      {"mesh", options.mesh}, {"output", options.out}, {"size", {options.width, options.height}}, {"views", views}};
  if (options.labels) value["labels"] = list;
  print_json("picture", value);
}

}  // namespace

int picture(const PictureOptions& options) {
  catch_signals();
  OutputFiles output({options.out}, {".png"});
  const MeshHandle handle = options.triangles.sharp > 0 ? refined_triangles(options.mesh, options.triangles, 0, 0, true)
                                                       : read_mesh(options.mesh);
  const MeshArrays mesh = arrays_of(handle.get());
  if (mesh.triangles.empty() && mesh.edges.empty())
    throw Failure("The mesh '" + options.mesh + "' has neither triangles nor edges to draw.");
  std::vector<std::string> views = options.views;
  if (views.empty()) views.emplace_back(mesh.dimension == 2 ? "top" : "iso");

  SceneOptions scene = options.scene;
  if (scene.around && views.size() > 1) throw Failure("--around shows one view: --view comes once with it.");
  if (options.metrics == own_metrics) {
    if (mesh.triangles.empty()) throw Failure("--metric mesh wants triangles; the mesh '" + options.mesh + "' has none.");
    scene.metrics = metrics_of_triangles(mesh);
  } else if (!options.metrics.empty()) {
    scene.metrics = read_metrics(handle.get(), mesh.vertices.size(), options.metrics);
  }

  // A grid of views, as square as the picture is.
  const int count = static_cast<int>(views.size());
  int columns = 1;
  while (columns * columns < count) ++columns;
  const int rows = (count + columns - 1) / columns;
  const double width = static_cast<double>(options.width) / columns,
               height = static_cast<double>(options.height) / rows;
  std::vector<ScreenTriangle> triangles;
  for (int k = 0; k < count; ++k) {
    const auto part =
        project(mesh, view_from(views[k]), scene, k % columns * width, k / columns * height, width, height);
    triangles.insert(triangles.end(), part.begin(), part.end());
  }
  std::vector<std::int32_t> seen;
  Image image = draw(triangles, options.width, options.height, options.samples, options.labels ? &seen : nullptr);
  draw_legend(options.scene.paint, SizeScale(mesh), image);
  std::vector<Label> labels;
  if (options.labels) labels = place_labels(seen, options.width, options.height, {columns, rows});
  draw_labels(labels, image);
  output.write([&](const std::vector<std::string>& hidden) { write_png(image, hidden.front()); });
  if (options.json) print_as_json(options, views, labels);
  return 0;
}

}  // namespace command
