// SPDX-License-Identifier: BSD-3-Clause
// deal_ii_pairs FILE.msh MASTER SLAVE DIRECTION: prints the number of cells and of the pairs of their sides that deal.II matches
// between two boundaries of a plane mesh of quadrilaterals. The sides differ in their coordinate DIRECTION (0 or 1) alone.
#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <vector>

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  try {
    dealii::Triangulation<2> mesh;
    dealii::GridIn<2> reader(mesh);
    std::ifstream file(argv[1]);
    reader.read_msh(file);
    const auto id = [&](int i) { return static_cast<dealii::types::boundary_id>(std::atoi(argv[i])); };
    std::vector<dealii::GridTools::PeriodicFacePair<dealii::Triangulation<2>::cell_iterator>> pairs;
    dealii::GridTools::collect_periodic_faces(mesh, id(2), id(3), std::atoi(argv[4]), pairs);
    mesh.add_periodicity(pairs);
    std::cout << mesh.n_active_cells() << " " << pairs.size() << " " << mesh.get_periodic_face_map().size() << "\n";
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
