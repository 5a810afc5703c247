// SPDX-License-Identifier: BSD-3-Clause
// The options of `carreau mesh`, as the command line has them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "inputs/base/embedded_places.h"
#include "inputs/base/input_choice.h"
#include "mesh/adaptation.h"

namespace command {

/// A file of --sizes, and the number of the first rules of each list that it holds.
struct SizesFile {
  std::string path;  ///< empty: none
  std::size_t faces = 0, entities = 0, near = 0;
};

/// The engine that fills solids, of `carreau volume`.
struct VolumeChoice {
  bool is_volume = false;
  std::string engine;                  ///< empty: the first one on the machine
  double seconds = 3600, gigabytes = 0;  ///< its limits; 0: none
};

struct MeshOptions : InputChoice {
  std::string input;
  std::vector<std::string> more_inputs;  ///< of `carreau mesh`: files beside it
  std::string repeat;       ///< shell_line() of all of this, for reports
  PlaneChoice plane;        ///< of a plane domain
  AdaptChoice adapt;        ///< of `carreau adapt`
  VolumeChoice volume;      ///< of `carreau volume`
  std::vector<std::string> outputs;
  std::string env;                            ///< blsurf.env; empty: none
  std::string size, minimum, maximum, chord;  ///< lengths as typed; empty: not given
  std::string size_map;                       ///< formula or file; empty: none
  double angle = 0;                           ///< degrees; 0: not given
  std::optional<double> gradation;            ///< 0: none
  std::string element;                        ///< p1, p2, q1.0, ...; "": as in the env file, else p1
  int order = 0;                              ///< of elements over `element`: 3, 4, 2 with centre_nodes; 0: none
  std::string nodes = "equidistant";          ///< places of their nodes, or "gauss-lobatto"
  bool centre_nodes = false;                  ///< elements of order 2 have all nodes of their order
  bool association = false;                   ///< files have the places of nodes on the geometry
  bool independent = false;                   ///< ignores borders of patches that are not sharp
  std::optional<double> sharp_angle;          ///< degrees
  double anisotropy = 0;                      ///< largest ratio of two sizes; 0: isotropic
  std::optional<int> effort;                  ///< level of the parameter of that name
  std::vector<std::string> face_sizes;        ///< "face=length", the face by number or name
  std::vector<std::string> sizes_on;          ///< "entities=length", the entities by selection.h
  std::vector<std::string> near;              ///< "entities=size:reach", the entities by selection.h
  std::vector<std::string> layers;            ///< "entities=first:length,ratio:number,count:number"
  SizesFile sizes;
  std::vector<std::string> groups;            ///< "name=selector" (selection.h)
  std::string group_by;                       ///< part, face or color; empty: faces keep their names
  std::vector<std::string> curve_edges;       ///< "curve=edges" or "curve=edges,progression:ratio"
  std::vector<std::string> curve_vertices;    ///< "curve=t,t,..."
  std::vector<std::string> periodic;          ///< "x", "1,0,0", "rotate:...", "slave=master"
  std::string carry_from;                     ///< geometry before a change, whose mesh is carried; empty: none
  std::string match = "any";                  ///< of its faces: any, reference, name or shape
  int halvings = 0;                           ///< of all edges, after meshing
  EmbedChoice embed;
  std::vector<std::string> settings;          ///< "parameter=value"
  std::string dump_failed;                    ///< folder for what there is of faces that failed; empty: none
  int threads = 0;                            ///< 0: all cores
  bool quiet = false;
  bool verbose = false;  ///< details of the run, too
  bool json = false;  ///< a summary on the standard output
  bool parts = false;  ///< each process keeps its part of the mesh
};

}  // namespace command
