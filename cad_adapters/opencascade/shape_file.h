// SPDX-License-Identifier: BSD-3-Clause
// CAD files through OpenCASCADE.
#pragma once

#include <TopoDS_Shape.hxx>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace carreau_occ {

/// A shape, and what its file says about its parts.
struct ShapeFile {
  TopoDS_Shape shape;
  /// Name and colour of a part (a solid, a shell or a face), where the file has some.
  struct Label {
    TopoDS_Shape part;
    std::string name;
    bool has_colour = false;
    double red = 0, green = 0, blue = 0;  ///< 0 to 1, sRGB
  };
  std::vector<Label> labels;
  std::string unit;  ///< of its coordinates, "" when the file does not say
  /// Entities of the file that the shape lacks or has in another form: a sentence each, which names the entity.
  std::vector<std::string> losses{};
  /// Ignored or repaired entities, without the loss of a face: a sentence each.
  std::vector<std::string> notes{};
  /// Faces of the shape that stand on data with an error, and why.
  std::vector<std::pair<TopoDS_Shape, std::string>> doubtful{};
};

/// Told while a file is translated, with the share that is done. False stops.
using ReadingProgress = std::function<bool(double fraction)>;

/// Reads STEP (.step, .stp), IGES (.iges, .igs) or BREP (.brep) as the suffix, or else the first bytes, say. Lengths
/// are in millimetres, whatever the unit of a STEP or IGES file; a BREP file has none. Throws std::runtime_error with a
/// sentence that names the file.
ShapeFile read_shape(const std::string& path, const ReadingProgress& progress = {});

}  // namespace carreau_occ
