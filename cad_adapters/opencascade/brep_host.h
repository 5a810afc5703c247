// SPDX-License-Identifier: BSD-3-Clause
// A boundary representation of OpenCASCADE as a host of the C interface.
#pragma once

#include <carreau_geometry.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "shape_file.h"

namespace carreau_occ {

/// Faces, edges and vertices of a shape, numbered from 1 as OpenCASCADE's maps of the shape number them. These numbers
/// are the references of faces, curves and points.
/// Faces that bend inside (kinks.h) are cut there into parts, which have no bend. The first part keeps the number;
/// other parts, new edges and new vertices have numbers behind all others. In meshes all parts are the face, or edge,
/// of the shape.
/// A face that is reversed gets u and v exchanged, so that triangles, which are counterclockwise in (u, v), look
/// outwards of a solid. Edges of no face are wires of one curve each, with references of faces behind all others.
/// Callbacks may come from several threads at a time.
class BrepHost {
 public:
  /// The shape and the names of its faces are kept. Without `loose_edges` the edges of no face of a shape with faces are
  /// left out, and a note counts them. Throws std::runtime_error when it has neither a face nor an edge.
  explicit BrepHost(const ShapeFile& file, bool loose_edges = true);
  ~BrepHost();
  BrepHost(const BrepHost&) = delete;
  BrepHost& operator=(const BrepHost&) = delete;

  /// Adds geometry and model to a session (carreau_geometry_begin), which may outlive this object. A status of
  /// carreau.h; after an error the session is as before, and has the sentence. If a callback fails later, it names the
  /// face and the error of OpenCASCADE.
  carreau_status add_to(carreau_session* session);
  /// Replaces the geometry and model of a session.
  carreau_status give_to(carreau_session* session);
  /// Keeps an object as long as this object or a session that calls its callbacks.
  void keep(std::shared_ptr<void> companion);

  /// Sets the size on the face of this number, or on all faces of this name, when hphy_flag = 2; an edge has the
  /// smallest size of its faces. Before give_to. False: there is no such face.
  bool set_face_size(const std::string& face, double size);
  /// Sets the size on a vertex (dimension 0), an edge (1), a face (2) or all faces of a solid (3), by number.
  bool set_size(int dimension, int number, double size);

  /// Faces that give_to leaves out of meshes: OpenCASCADE fails on them, or their data has an error or reaches too far.
  /// Ascending, with the reason.
  [[nodiscard]] std::vector<std::pair<int, std::string>> excluded() const;

  /// Own name of a face, or the name of the smallest part that holds it; "": none. Numbers from 1.
  [[nodiscard]] const std::string& face_name(int number) const;
  /// 0xRRGGBB, -1: none. Numbers from 1.
  [[nodiscard]] int face_colour(int number) const;
  /// Layer of a face, or of the smallest part that holds it; "": none.
  [[nodiscard]] const std::string& face_layer(int number) const;
  /// Names of vertices (dimension 0) and edges (1) that have one, by number.
  [[nodiscard]] const std::map<int, std::string>& names(int dimension) const;
  [[nodiscard]] int face_count() const noexcept;
  /// Edges of no face that sessions get.
  [[nodiscard]] int wire_count() const noexcept;
  /// Faces and parts of faces: references are from 1 to this.
  [[nodiscard]] int reference_count() const noexcept;
  /// The name of a face or of a part.
  [[nodiscard]] int curve_count(int reference) const noexcept;
  /// The face of the shape that a reference of the model is, or is a part of; other numbers stay.
  [[nodiscard]] int whole_face(int reference) const noexcept;
  /// References of the parts of a face of the shape, or its own; ascending.
  [[nodiscard]] std::vector<int> parts(int face) const;
  /// The edge of the shape that a reference of the model is a piece of; other numbers stay.
  [[nodiscard]] int whole_edge(int reference) const noexcept;
  /// Faces that bend inside and could not be cut there, ascending.
  [[nodiscard]] const std::vector<int>& bent_faces() const noexcept;
  /// Repairs that let faces be meshed: a sentence each.
  [[nodiscard]] const std::vector<std::string>& notes() const noexcept;
  [[nodiscard]] int edge_count() const noexcept;
  [[nodiscard]] int vertex_count() const noexcept;
  /// Diagonal of the box of the faces that are not left out.
  [[nodiscard]] double diagonal() const;
  /// Bounds of the distance between edges in space that are one although each belongs to one face: the tolerances of
  /// the file's own edges and vertices. 0: no such edge, or only one.
  struct GlueTolerances {
    double of_all = 0;   ///< no more than a tenth of the shortest such edge (parameters glue_open and eps_glue)
    double of_each = 0;  ///< whatever the lengths (eps_glue_open, which checks the lengths of each pair)
  };
  [[nodiscard]] GlueTolerances glue_tolerances() const;
  /// Largest distance between faces and the edges and vertices that they share (parameter eps_match).
  [[nodiscard]] double match_tolerance() const;
  /// No edge has one face alone (a seam has its face twice).
  [[nodiscard]] bool is_closed() const noexcept;
  /// The point of a face at (u, v) as callbacks get them (xyz[3]), and the parameters of its surface in the file
  /// (uv[2]; exchanged when the face is reversed). False: OpenCASCADE fails.
  bool locate(int face, double u, double v, double* xyz, double* uv) const noexcept;
  /// Edges of the curves of a face, as far as they are known. on_curve(): (u, v) (uv[2]) as callbacks get them at a
  /// share of curve number ic, from 1. False: OpenCASCADE fails.
  [[nodiscard]] std::vector<std::int32_t> curves(int face) const;
  bool on_curve(int face, int ic, double share, double* uv) const noexcept;
  /// The message of OpenCASCADE for a callback that failed on this face; "": none.
  [[nodiscard]] std::string failure(int face) const;

 private:
  /// Returns the number of a face, from 1.
  [[nodiscard]] int seed_curve(int number) const;
  carreau_status add_face(carreau_session* session, std::size_t index) const;
  carreau_status add_wire(carreau_session* session, std::size_t index) const;
  carreau_status add_faces(carreau_session* session) const;
  carreau_status name_edges_and_vertices(carreau_session* session) const;
  carreau_status move_reasons(carreau_session* session) const;

  struct State;
  std::shared_ptr<State> state_;  // of the callbacks, too
};

}  // namespace carreau_occ
