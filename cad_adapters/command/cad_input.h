// A file of geometry as a host of the C interface, whatever its format.
#pragma once

#include <carreau.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lengths.h"

namespace command {

/// Geometry and model of a file. Sessions that were given it must not outlive it.
class CadInput {
 public:
  virtual ~CadInput() = default;
  /// Hands geometry, model and names of faces to a session. A status of carreau.h; the sentence is in the session.
  virtual carreau_status give_to(carreau_session* session) = 0;
  /// Diagonal of the box of the geometry.
  [[nodiscard]] virtual double diagonal() const = 0;
  /// Whether every edge has a face on both sides.
  [[nodiscard]] virtual bool is_closed() const = 0;
  /// "375 faces, 958 edges, 632 vertices, lengths in mm".
  [[nodiscard]] virtual std::string summary() const = 0;
  /// A size of its own for the face of this number, or for all faces of this name; before give_to. False: no such face.
  virtual bool set_face_size(const std::string& face, double size) = 0;
  /// Leaves a face out of what give_to hands over. False: it is not there, or left out already.
  virtual bool exclude(int face, const std::string& why) = 0;
  /// Faces that are left out, with the reason.
  [[nodiscard]] virtual std::vector<std::pair<int, std::string>> excluded() const = 0;
  /// What went wrong in a callback on this face; "" when nothing did.
  [[nodiscard]] virtual std::string failure(int face) const = 0;
};

/// Prints what a CAD file holds and what of it is hard to mesh, at most `limit` sentences a kind. Returns the exit
/// code; throws Failure.
int print_cad_info(const std::string& path, int limit);

/// Opens STEP, IGES and BREP files. Throws Failure with a sentence.
std::unique_ptr<CadInput> open_cad(const std::string& path);

}  // namespace command
