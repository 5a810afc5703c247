// SPDX-License-Identifier: BSD-3-Clause
// A file of geometry as a host of the C interface, whatever its format.
#pragma once

#include <carreau.h>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "inputs/base/face_list.h"
#include "inputs/base/input_choice.h"

namespace command {

/// A point of a face: in space, and the parameters that the file gives it.
struct Place {
  double x = 0, y = 0, z = 0, u = 0, v = 0;
};

/// Geometry and model of a file. Sessions that were given it must not outlive it.
class CadInput {
 public:
  virtual ~CadInput() = default;
  /// Hands geometry, model and names of faces to a session, and why faces are left out. A status of carreau.h; the
  /// sentence is in the session.
  virtual carreau_status give_to(carreau_session* session) = 0;
  /// Diagonal of the box of the geometry.
  [[nodiscard]] virtual double diagonal() const = 0;
  /// Distance below which open curves are one, by the file's own tolerances; 0: do not glue.
  [[nodiscard]] virtual double glue_tolerance() const { return 0; }
  /// Distance for curves that are still open, whatever the shortest curve of the file; 0: as above.
  [[nodiscard]] virtual double open_tolerance() const { return 0; }
  /// Distance below which the ends of a short curve are worth a warning; 0: the library's own.
  [[nodiscard]] virtual double ends_tolerance() const { return 0; }
  /// True if faces are divided by arbitrary, perhaps crooked curves: edges on them are not cut for the sake of the
  /// shapes beside them.
  [[nodiscard]] virtual bool has_arbitrary_borders() const { return false; }
  /// "375 faces, 958 edges, 632 vertices, lengths in mm".
  [[nodiscard]] virtual std::string summary() const = 0;
  /// Sets the size of the face of this number, or of all faces of this name; before give_to. False: no such face.
  virtual bool set_face_size(const std::string& face, double size) = 0;
  /// Sets the size of a vertex (dimension 0), an edge (1), a face (2) or all faces of a solid (3) by its number.
  virtual bool set_size(int dimension, std::int32_t number, double size) {
    return dimension == 2 && set_face_size(std::to_string(number), size);
  }
  /// True if the geometry itself answers with the sizes of set_face_size(), when hphy_flag = 2.
  [[nodiscard]] virtual bool answers_face_sizes() const = 0;
  /// The size of set_face_size() if the geometry does not answer with it; 0: none.
  [[nodiscard]] virtual double face_size(std::int32_t face) const = 0;
  /// The point at (u, v), as callbacks of the session get them. May be called from several threads when the geometry
  /// may. False: the geometry fails there.
  [[nodiscard]] virtual bool locate(std::int32_t face, double u, double v, Place& place) const noexcept = 0;
  /// The faces of the file. Samples the geometry.
  [[nodiscard]] virtual std::vector<FaceLook> faces() const = 0;
  /// Numbers of the faces of the file.
  [[nodiscard]] virtual std::vector<std::int32_t> face_numbers() const = 0;
  /// "" when it has none.
  [[nodiscard]] virtual std::string face_name(std::int32_t) const { return ""; }
  /// The part that a face of the file is of: a solid, or a file of several. Number 0: no part.
  struct Part {
    std::int32_t number = 0;
    std::string name;  ///< "" when it has none
  };
  [[nodiscard]] virtual Part part_of_face(std::int32_t) const { return {}; }
  /// The parts on both sides of a face: first the part that its triangles look out of.
  [[nodiscard]] virtual std::array<Part, 2> parts_beside(std::int32_t face) const { return {part_of_face(face), Part{}}; }
  /// 0xRRGGBB; -1: none.
  [[nodiscard]] virtual std::int32_t face_colour(std::int32_t) const { return -1; }
  /// "": none.
  [[nodiscard]] virtual std::string face_layer(std::int32_t) const { return ""; }
  /// Vertices (dimension 0) or edges (1) that have a name.
  struct Named {
    std::int32_t number = 0;
    std::string name;
  };
  [[nodiscard]] virtual std::vector<Named> named(int /*dimension*/) const { return {}; }
  /// Two parts whose faces lie on each other.
  struct Contact {
    std::array<Part, 2> parts;
    double area = 0;   ///< that they have in common
    int faces = 0;     ///< pairs of faces
  };
  [[nodiscard]] virtual std::vector<Contact> contacts() const { return {}; }
  /// "solid", "file": the kind of those parts.
  [[nodiscard]] virtual const char* part_word() const { return "solid"; }
  /// References of the curves of a face, as far as they are known.
  [[nodiscard]] virtual std::vector<std::int32_t> curves(std::int32_t face) const = 0;
  /// (u, v), as callbacks of the session get them, at a share of curve number ic, from 1. False: the geometry fails.
  [[nodiscard]] virtual bool on_curve(std::int32_t face, std::int32_t ic, double share, double& u,
                                      double& v) const noexcept = 0;
  /// Entities of the file that could not be read: a sentence each.
  [[nodiscard]] virtual std::vector<std::string> losses() const { return {}; }
  /// Ignored or repaired entities, without the loss of a face: a sentence each.
  [[nodiscard]] virtual std::vector<std::string> notes() const { return {}; }
  /// A table of the small features that were found and removed, or stay: a line each.
  [[nodiscard]] virtual std::vector<std::string> small_features() const { return {}; }
  /// The face of the file that contains a face of the session; likewise for curves. parts(): the faces of the session
  /// in a face of the file. A geometry that does not cut faces returns its argument.
  [[nodiscard]] virtual std::int32_t whole_face(std::int32_t face) const { return face; }
  [[nodiscard]] virtual std::int32_t whole_curve(std::int32_t curve) const { return curve; }
  [[nodiscard]] virtual std::vector<std::int32_t> parts(std::int32_t face) const { return {face}; }
  /// Faces that bend inside and could not be cut there, which curvatures do not show: a sentence each.
  [[nodiscard]] virtual std::vector<std::string> kinks() const { return {}; }
  /// True if the geometry, or a file beside it, prescribes sizes, when hphy_flag = 2.
  [[nodiscard]] virtual bool has_sizes() const { return false; }
  /// True if the file has edges and no face: its mesh has edges alone.
  [[nodiscard]] virtual bool is_wires() const { return false; }
  /// False if an edge of the file has one face alone.
  [[nodiscard]] virtual bool closed() const { return false; }
  /// A sentence of the geometry about the mesh of a session; "": none. Throws Failure.
  [[nodiscard]] virtual std::string of_mesh(carreau_session*) const { return ""; }
  /// Gaps of the interfaces as a sentence; "" when the file has no curves in space.
  [[nodiscard]] virtual std::string gaps() const { return ""; }
};

/// Receives the share of a file that is read.
using ReadingProgress = std::function<void(double fraction)>;

/// A sentence of the library with faces as the file numbers them.
std::string in_terms_of_file(const CadInput& input, const std::string& sentence);

}  // namespace command
