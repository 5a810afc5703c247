// SPDX-License-Identifier: BSD-3-Clause
#include "volume/engines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>

#include "base/failure.h"
#include "volume/engine_files.h"

namespace command {
namespace {

struct Engine {
  const char *name, *program, *install;
  /// Factor of sizes for this engine. Engines take a size as an upper bound or a circumradius; with the factor, edges inside have it as their
  /// mean length (tests/bench/inner_sizes.py).
  double scale;
};
constexpr Engine engines[] = {{"gmsh", "gmsh", "gmsh", .77},
                              {"tetgen", "tetgen", "tetgen", .83},
                              {"netgen", "carreau_netgen", "Carreau with libnglib-dev (cad_adapters/netgen)", .85}};

std::string exact(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

/// Runs an engine. Throws Failure unless it succeeds.
double run(const std::string& name, std::vector<std::string> words, const TemporaryFolder& folder, const ProgramLimits& limits,
           const std::function<void(double)>& each_second) {
  words.front() = find_program(words.front());
  const ProgramResult result = run_program(words, folder.path(), limits, each_second);
  if (result.succeeded) return result.seconds;
  std::string sentence = name + " failed: " + result.why + ".";
  if (!result.last_lines.empty()) sentence += " Its last lines:";
  for (const std::string& line : result.last_lines) sentence += "\n  " + line;
  throw Failure(sentence);
}

void append(std::string& text, const Point& p, const char* separator) {
  for (std::size_t k = 0; k < 3; ++k) text += (k > 0 ? separator : "") + exact(p[k]);
}

void by_tetgen(carreau_mesh* input, const InnerSizes& inner, const TemporaryFolder& folder, const ProgramLimits& limits,
               const std::function<void(double)>& each_second, VolumeMesh& volume) {
  const std::string path = folder.path() + "/part";
  require(input, carreau_mesh_write(input, (path + ".smesh").c_str()));
  std::string nodes = std::to_string(inner.nodes.size()) + " 3 0 0\n", sizes = std::to_string(inner.nodes.size()) + " 1\n";
  for (std::size_t n = 0; n < inner.nodes.size(); ++n) {
    nodes += std::to_string(n + 1) + ' ';
    append(nodes, inner.nodes[n], " ");
    nodes += '\n';
    sizes += exact(inner.sizes[n]) + '\n';
  }
  std::string elements = std::to_string(inner.tetrahedra.size()) + " 4 0\n";
  for (std::size_t t = 0; t < inner.tetrahedra.size(); ++t) {
    elements += std::to_string(t + 1);
    for (const std::int32_t n : inner.tetrahedra[t]) elements += ' ' + std::to_string(n + 1);
    elements += '\n';
  }
  write_engine_file(path + ".b.node", nodes);
  write_engine_file(path + ".b.ele", elements);
  write_engine_file(path + ".b.mtr", sizes);
  volume.seconds = run("TetGen", {"tetgen", "-pYq1.4Am", "part.smesh"}, folder, limits, each_second);
  read_tetgen(path + ".1", volume);
}

/// A view of Gmsh: sizes on tetrahedra.
void write_view(const std::string& path, const InnerSizes& inner) {
  std::string view = "View \"sizes\" {\n";
  for (const auto& t : inner.tetrahedra) {
    view += "SS(";
    for (std::size_t k = 0; k < 4; ++k) {
      if (k > 0) view += ',';
      append(view, inner.nodes[static_cast<std::size_t>(t[k])], ",");
    }
    view += "){";
    for (std::size_t k = 0; k < 4; ++k) view += (k > 0 ? "," : "") + exact(inner.sizes[static_cast<std::size_t>(t[k])]);
    view += "};\n";
  }
  write_engine_file(path, view + "};\n");
}

void by_gmsh(const SolidSurface& surface, const InnerSizes& inner, const TemporaryFolder& folder, const ProgramLimits& limits,
             const std::function<void(double)>& each_second, VolumeMesh& volume) {
  std::string mesh = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + std::to_string(surface.vertices.size()) + "\n";
  for (std::size_t v = 0; v < surface.vertices.size(); ++v)
    mesh += std::to_string(v + 1) + ' ' + exact(surface.vertices[v][0]) + ' ' + exact(surface.vertices[v][1]) + ' ' + exact(surface.vertices[v][2]) + '\n';
  // Faces get numbers from 1: references may be negative.
  std::map<std::int32_t, int> faces;
  for (const std::int32_t ref : surface.refs) faces.emplace(ref, 0);
  int last = 0;
  for (auto& [ref, number] : faces) number = ++last;
  mesh += "$EndNodes\n$Elements\n" + std::to_string(surface.triangles.size()) + '\n';
  std::map<std::int32_t, std::map<int, bool>> bounds;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const std::string face = std::to_string(faces.at(surface.refs[t]));
    mesh += std::to_string(t + 1) + " 2 2 " + face + ' ' + face;
    for (const std::int32_t v : surface.triangles[t]) mesh += ' ' + std::to_string(v + 1);
    mesh += '\n';
    const auto [out_of, into] = surface.sides[t];
    for (const std::int32_t solid : {out_of, into})
      if (solid > 0 && out_of != into) bounds[solid][faces.at(surface.refs[t])] = true;
  }
  write_engine_file(folder.path() + "/surface.msh", mesh + "$EndElements\n");
  std::string script = "Merge \"surface.msh\";\nMesh.SaveAll = 1;\nMesh.Algorithm3D = 1;\nMesh.Optimize = 1;\n"
                       "Mesh.CharacteristicLengthExtendFromBoundary = 0;\nMerge \"sizes.pos\";\nField[1] = PostView;\nBackground Field = 1;\n";
  write_view(folder.path() + "/sizes.pos", inner);
  for (const auto& [solid, own] : bounds) {
    const std::string number = std::to_string(solid);
    script += "Surface Loop(" + number + ") = {";
    for (const auto& [face, has] : own) script += (face == own.begin()->first ? "" : ", ") + std::to_string(face);
    script += "};\nVolume(" + number + ") = {" + number + "};\n";
  }
  write_engine_file(folder.path() + "/fill.geo", script);
  volume.seconds = run("Gmsh", {"gmsh", "-3", "fill.geo", "-format", "msh2", "-o", "filled.msh"}, folder, limits, each_second);
  read_gmsh(folder.path() + "/filled.msh", volume);
}

void by_netgen(carreau_mesh* input, const SolidSurface& surface, const InnerSizes& inner, double growth, const TemporaryFolder& folder,
               const ProgramLimits& limits, const std::function<void(double)>& each_second, VolumeMesh& volume) {
  require(input, carreau_mesh_write(input, (folder.path() + "/surface.vol").c_str()));
  std::string sizes;
  for (std::size_t n = 0; n < inner.nodes.size(); ++n) {
    append(sizes, inner.nodes[n], " ");
    sizes += ' ' + exact(inner.sizes[n]) + '\n';
  }
  write_engine_file(folder.path() + "/sizes.txt", sizes);
  const double largest = *std::max_element(inner.sizes.begin(), inner.sizes.end());
  volume.seconds = run("Netgen", {"carreau_netgen", "surface.vol", "filled.vol", exact(largest), exact(growth), "sizes.txt"}, folder, limits, each_second);
  std::vector<std::int32_t> numbers;  // of the domains
  for (const auto& [solid, each] : surface.volumes) numbers.push_back(solid);
  read_netgen(folder.path() + "/filled.vol", numbers, volume);
}

}  // namespace

std::vector<std::string> engine_names() {
  std::vector<std::string> names;
  for (const Engine& engine : engines) names.emplace_back(engine.name);
  return names;
}

std::string found_engine(const std::string& name) {
  for (const Engine& engine : engines) {
    if (!name.empty() && name != engine.name) continue;
    if (!find_program(engine.program).empty()) return engine.name;
    if (!name.empty()) throw Failure("The engine " + name + " is not on this machine: install " + engine.install + ".");
  }
  throw Failure("No engine is on this machine: install gmsh or tetgen, for example by `apt install gmsh`.");
}

VolumeMesh fill(carreau_mesh* input, const SolidSurface& surface, const std::string& engine, const InnerBounds& bounds, const ProgramLimits& limits,
                const std::function<void(double)>& each_second) {
  VolumeMesh volume;
  volume.surface = surface;
  volume.engine = engine;
  const TemporaryFolder folder;
  InnerSizes inner = inner_sizes_of(surface, bounds);
  const auto* const of = std::find_if(std::begin(engines), std::end(engines), [&](const Engine& each) { return engine == each.name; });
  for (double& size : inner.sizes) size *= of->scale;
  volume.has_coarse_sizes = inner.is_coarse;
  if (engine == "tetgen") by_tetgen(input, inner, folder, limits, each_second, volume);
  if (engine == "gmsh") by_gmsh(surface, inner, folder, limits, each_second, volume);
  if (engine == "netgen") by_netgen(input, surface, inner, bounds.growth, folder, limits, each_second, volume);
  volume.corners = volume.vertices.size();
  return volume;
}

}  // namespace command
