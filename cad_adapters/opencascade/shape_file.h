// CAD files through OpenCASCADE.
#pragma once

#include <TopoDS_Shape.hxx>
#include <string>
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
};

/// Reads STEP (.step, .stp), IGES (.iges, .igs) or BREP (.brep) as the suffix, or else the first bytes, say. Lengths
/// are in millimetres, whatever the unit of a STEP or IGES file; a BREP file has none. Throws std::runtime_error with a
/// sentence that names the file.
ShapeFile read_shape(const std::string& path);

}  // namespace carreau_occ
