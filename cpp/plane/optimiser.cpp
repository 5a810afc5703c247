#include "plane/optimiser.h"

namespace carreau::plane {

Optimiser::Optimiser(Triangulation& mesh, int fixed, const Field& field, Monitor& monitor)
    : mesh_(mesh), shapes_(mesh, field), fixed_(fixed), field_(field), monitor_(monitor) {}

void Optimiser::run() {
  swap_to_delaunay();
  swap_to_degree_six();
  sweep_all();
  swap_to_delaunay();
  rescue_worst();
}

}  // namespace carreau::plane
