// SPDX-License-Identifier: BSD-3-Clause
// Options that describe the geometry, besides the name of its file.
#pragma once

#include <string>
#include <vector>

namespace command {

/// Which surface of a molecule.
struct MoleculeChoice {
  std::string surface = "vws";  ///< one of molecule_surfaces
  double probe = 1.4;
  bool drop_cavities = false;
  std::string radii = {};  ///< file of radii; empty: none
};

/// How a grid is read and made a surface.
struct GridChoice {
  std::string format;        ///< one of grid_formats; empty: by suffix
  std::string smoothing;     ///< "rounds", "rounds,w1,w2" of Taubin's filter, and ",distance" behind; empty: none
  bool lengths = false;      ///< parameters are cumulated lengths of edges
  double join_angle = 0;     ///< degrees; 0: borders of blocks keep their angles
  double tolerance = 0;      ///< below which nodes of borders are one; 0: a millionth of the diagonal
  bool fill = false;         ///< holes inside
  int continuity = 1;        ///< between cells, 1 or 2
  double step = 0;           ///< of heights and scans whose file has no step; 0: 1
};

/// The clusters of an atlas and the borders of its charts.
struct AtlasChoice {
  int reach = 0;       ///< of clusters, edges; 0: not given
  std::string border;  ///< "spline" or "cubic"; empty: not given
};

/// Defines which edges of a surface given as triangles are lines.
struct TrianglesChoice {
  double sharp = 0;          ///< degrees; 0: not given
  double corner = 0;         ///< degrees; 0: not given
  bool given_edges = false;  ///< lines are the edges of the file
  bool ignore_references = false;
};

/// How the file of a plane domain is read.
struct PlaneChoice {
  bool is_plane = false;    ///< the input is a plane domain
  std::string sizes;        ///< file of sizes or metrics at its vertices; empty: none
  int field = 0;            ///< of a file of sizes with several fields, from 1; 0: the only one
  double corner_angle = 0;  ///< degrees; polygons are smoothed between corners; 0: they are not
};

/// How a CAD file is read.
struct CadChoice {
  bool loose_edges = false;      ///< edges of no face are meshed, too
  bool imprint = false;          ///< parts that touch share faces and edges
  double imprint_tolerance = 0;  ///< up to which distance; 0: the tolerances of the file
  double min_feature = 0;        ///< length below which features are removed; 0: none
  std::string unit = {};         ///< of the mesh; empty: millimetres
  double scale = 1;              ///< of all coordinates
  std::vector<std::string> mirror = {};  ///< planes about which the body is or becomes symmetric: see mirror_planes()
};

struct InputChoice {
  std::string host;           ///< shared library, of a .pardom
  MoleculeChoice molecule;    ///< of a molecule; its surface also of an atlas
  AtlasChoice atlas;          ///< with --surface atlas
  GridChoice grid;            ///< of a structured grid
  TrianglesChoice triangles;  ///< of a surface given as triangles
  CadChoice cad;
  std::string domain;         ///< of a surface by formulas; empty: usual_domain
};

}  // namespace command
