// What the sub-commands do. Each returns the exit code, and throws Failure when it cannot be done.
#pragma once

#include <string>
#include <vector>

#include "scene.h"

namespace command {

struct PictureOptions {
  std::string mesh, out;
  int width = 1200, height = 900, samples = 3;
  std::vector<std::string> views;  ///< side by side; none: iso, or top for a plane mesh
  SceneOptions scene;
};

int picture(const PictureOptions& options);

/// Prints counts, quality and defects. 1 when there are defects.
int check(const std::string& path, bool closed, int limit);

/// Prints the parameters, all or one of them.
int params(const std::string& name);

}  // namespace command
