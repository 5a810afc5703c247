// SPDX-License-Identifier: BSD-3-Clause
// Surfaces of molecules (HDR sec. 4.6).
#pragma once

#include <string>
#include <vector>

#include "geometry/built_geometry.h"
#include "geometry/molecule/areas.h"
#include "geometry/molecule/arrangement.h"
#include "support/monitor.h"

namespace carreau::molecule {

/// Atoms with their van der Waals radii.
struct Molecule {
  std::vector<Ball> balls;
  /// [ball]: positive and different, the references of faces; empty: ranks from 1.
  std::vector<int> numbers = {};
  /// [ball]: names of faces, equal for atoms of a residue; empty: none.
  std::vector<std::string> names = {};
  std::vector<std::string> elements = {};  ///< [ball]: symbols; empty: not known
};

enum class SurfaceKind {
  vws,  ///< of the union of the balls
  sas,  ///< of the union of balls whose radii the probe's is added to
  ses   ///< of the region that no probe outside the balls reaches: convex parts of balls, tori, concave parts of probes
};

struct SurfaceOptions {
  SurfaceKind kind = SurfaceKind::vws;
  double probe = 1.4;    ///< radius; not used by vws
  bool cavities = true;  ///< keep inner shells
  int threads = 1;       ///< at most
};

/// The balls whose union the surface bounds, arranged. Throws InvalidArgument, naming the atom or the probe.
Arrangement arrange(const Molecule& molecule, const SurfaceOptions& options, Monitor& monitor);

/// Properties of a surface without a mesh.
struct MoleculeSummary {
  std::vector<int> numbers;        ///< [ball]
  std::vector<std::string> names;  ///< [ball]; empty: none
  UnionMeasures measures;          ///< for an ses: ball_area has convex parts only, shells are the shells of the sas
  int euler_number = 0;            ///< of the model
  std::size_t moved = 0;           ///< radii
  double torus = 0, concave = 0;   ///< areas of these parts of an ses
  std::vector<double> ball_torus, ball_concave;  ///< [ball]: shares of them; see ExcludedMeasures
};

/// Faces are the components, arcs their curves, vertices the points. A face has the number of its atom; of several
/// components of an atom the others have numbers behind all atoms' and are its parts (Face::part_of). A whole ball is
/// two faces, a whole circle two curves. Arcs shorter than a millionth of the smaller radius are one point.
/// Throws InvalidArgument when numbers are not positive or not different.
/// `summary` may be null.
BuiltGeometry build_surface(const Molecule& molecule, const SurfaceOptions& options, Monitor& monitor,
                            MoleculeSummary* summary = nullptr);

}  // namespace carreau::molecule
