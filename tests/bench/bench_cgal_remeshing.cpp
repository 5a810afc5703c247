// SPDX-License-Identifier: BSD-3-Clause
// CGAL's isotropic remeshing of a surface of triangles: bench_cgal_remeshing IN OUT.off SIZE SHARP_ANGLE.
// Prints the seconds of the remeshing, without reading and writing.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "io/mesh_files.h"

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

int main(int argc, char** argv) {
  if (argc != 5) return std::puts("bench_cgal_remeshing IN OUT.off SIZE SHARP_ANGLE"), 2;
  const carreau::FlatMesh flat = carreau::read_mesh(argv[1]);
  Mesh mesh;
  std::vector<Mesh::Vertex_index> v;
  for (const carreau::Vec3& p : flat.vertices) v.push_back(mesh.add_vertex({p.x(), p.y(), p.z()}));
  for (const auto& t : flat.triangles)
    mesh.add_face(v[static_cast<std::size_t>(t[0])], v[static_cast<std::size_t>(t[1])],
                  v[static_cast<std::size_t>(t[2])]);
  const double size = std::atof(argv[3]);
  const auto start = std::chrono::steady_clock::now();
  auto sharp = mesh.add_property_map<Mesh::Edge_index, bool>("e:sharp", false).first;
  pmp::detect_sharp_edges(mesh, std::atof(argv[4]), sharp);
  pmp::isotropic_remeshing(
      mesh.faces(), size, mesh,
      pmp::parameters::edge_is_constrained_map(sharp).number_of_iterations(5).number_of_relaxation_steps(3));
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  mesh.collect_garbage();
  std::ofstream out(argv[2]);
  out.precision(17);
  out << mesh;
  std::printf("%.4f\n", seconds);
}
