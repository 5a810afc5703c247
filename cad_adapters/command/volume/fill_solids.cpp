// SPDX-License-Identifier: BSD-3-Clause
#include "volume/fill_solids.h"

#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "base/failure.h"
#include "volume/engines.h"
#include "volume/volume_check.h"

namespace command {
namespace {

std::map<std::int32_t, std::size_t> counts_of(const VolumeMesh& volume) {
  std::map<std::int32_t, std::size_t> counts;
  for (const std::int32_t solid : volume.solids) ++counts[solid];
  return counts;
}

}  // namespace

VolumeMesh fill_solids(carreau_mesh* mesh, const MeshOptions& options, const std::string& engine, const InnerBounds& bounds, const std::string& kept,
                       Progress& progress) {
  const SolidSurface surface = solid_surface_of(mesh, options.threads);
  progress.line(engine + " fills " + std::to_string(surface.volumes.size()) + (surface.volumes.size() == 1 ? " solid" : " solids") + " inside " +
                std::to_string(surface.triangles.size()) + " triangles");
  constexpr double lines_every = 10;  // seconds
  double told = 0;
  const auto each_second = [&](double seconds) {
    if (seconds >= told + lines_every) progress.line(engine + " has run for " + std::to_string(static_cast<long>(told = seconds)) + " s");
  };
  try {
    VolumeMesh volume = fill(mesh, surface, engine, bounds, {options.volume.seconds, options.volume.gigabytes}, each_second);
    verify(volume);
    if (volume.has_coarse_sizes) progress.warning("sizes vary more inside than the engine's size map resolves: tetrahedra may be too large or too small there");
    if (surface.is_quadratic()) make_quadratic(volume);
    if (volume.straightened > 0)
      progress.warning(std::to_string(volume.straightened) + " curved edges became straight, since elements of order 2 beside them would be turned over");
    return volume;
  } catch (const Failure& failure) {
    if (carreau_mesh_write(mesh, kept.c_str()) != CARREAU_OK) throw;
    throw Failure(std::string(failure.what()) + "\nThe surface is in '" + kept + "'.");
  }
}

std::vector<std::string> volume_lines(const VolumeMesh& volume) {
  char text[300];
  std::snprintf(text, sizeof text, "volume     %s: %zu tetrahedra, %zu vertices, worst shape %.3f, %.1f s", volume.engine.c_str(), volume.tetrahedra.size(),
                volume.vertices.size(), volume.smallest_shape, volume.seconds);
  std::vector<std::string> lines{text};
  const auto counts = counts_of(volume);
  for (const auto& [solid, size] : volume.surface.volumes) {
    const std::string& name = volume.surface.solids.at(solid);
    std::snprintf(text, sizeof text, "solid      %d: %zu tetrahedra, volume %.9g", solid, counts.contains(solid) ? counts.at(solid) : 0, size);
    lines.push_back(text + (name.empty() ? "" : ", " + name));
  }
  return lines;
}

nlohmann::ordered_json volume_json(const VolumeMesh& volume) {
  nlohmann::ordered_json json{{"engine", volume.engine},
                              {"tetrahedra", volume.tetrahedra.size()},
                              {"vertices", volume.vertices.size()},
                              {"worst_shape", volume.smallest_shape},
                              {"straightened_edges", volume.straightened},
                              {"seconds", volume.seconds},
                              {"solids", nlohmann::ordered_json::array()}};
  const auto counts = counts_of(volume);
  for (const auto& [solid, size] : volume.surface.volumes)
    json["solids"].push_back({{"number", solid}, {"name", volume.surface.solids.at(solid)}, {"tetrahedra", counts.contains(solid) ? counts.at(solid) : 0}, {"volume", size}});
  return json;
}

}  // namespace command
