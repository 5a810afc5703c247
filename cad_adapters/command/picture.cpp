#include <cmath>
#include <cstdio>

#include "commands.h"
#include "output_files.h"
#include "png_file.h"
#include "signals.h"

namespace command {

int picture(const PictureOptions& options) {
  catch_signals();
  OutputFiles output({options.out}, {".png"});
  const MeshHandle handle = read_mesh(options.mesh);
  const MeshArrays mesh = arrays_of(handle.get());
  if (mesh.triangles.empty() && mesh.edges.empty())
    throw Failure("The mesh '" + options.mesh + "' has neither triangles nor edges to draw.");
  std::vector<std::string> views = options.views;
  if (views.empty()) views.emplace_back(mesh.dimension == 2 ? "top" : "iso");

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
        project(mesh, view_from(views[k]), options.scene, k % columns * width, k / columns * height, width, height);
    triangles.insert(triangles.end(), part.begin(), part.end());
  }
  const Image image = draw(triangles, options.width, options.height, options.samples);
  output.write([&](const std::vector<std::string>& hidden) { write_png(image, hidden.front()); });
  return 0;
}

}  // namespace command
