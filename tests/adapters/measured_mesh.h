// SPDX-License-Identifier: BSD-3-Clause
// A shape meshed through the C interface, and measures of the result.
#pragma once

#include <brep_host.h>
#include <carreau.h>

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "flat_triangles.h"

namespace adapters {

struct MeasuredMesh {
  carreau_status status = CARREAU_OK;
  std::string error;                ///< of the run
  std::vector<std::string> failed;  ///< sentence of each face that has no mesh
  std::vector<std::string> defects;
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int32_t> refs;                  ///< of triangles
  std::vector<std::array<std::int32_t, 2>> edges;  ///< of curves
  std::vector<std::int32_t> edge_refs;
  std::int64_t faces = 0;
  std::int64_t open_edges = 0;     ///< with one triangle
  std::int64_t crowded_edges = 0;  ///< with more than two
  std::int64_t turned_edges = 0;   ///< of two triangles that run along it the same way
  carreau_quality quality{};
  std::vector<FlatTriangle> flat;  ///< of Q2 below 0.1, with the feature of the input that forces them
  /// Worst Q2 of the triangles that nothing in the input forces; 0.1 when all that are below are forced.
  double free_q2_min = 1;
  double volume = 0;  ///< enclosed, by the divergence theorem
  std::vector<carreau_interface> interfaces;
  carreau_report report{};
  double seconds = 0;
  std::int64_t surface_calls = 0;

  /// "" for a mesh of all faces without a defect; else a short description of the fault. `closed`: open edges are
  /// wrong.
  [[nodiscard]] std::string trouble(bool closed) const;
};

/// `prepare` may set more parameters.
MeasuredMesh mesh_and_measure(carreau_occ::BrepHost& host, double size,
                              const std::function<void(carreau_session*)>& prepare = {});

/// The parameters with which the command meshes CAD files.
void use_command_parameters(carreau_session* session, double size, double diagonal);

}  // namespace adapters
