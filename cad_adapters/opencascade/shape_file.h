// SPDX-License-Identifier: BSD-3-Clause
// CAD files through OpenCASCADE.
#pragma once

#include <TopoDS_Shape.hxx>
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace carreau_occ {

struct MirrorPlane;
struct SmallFeature;

/// A shape, and the data of its file about its parts.
struct ShapeFile {
  TopoDS_Shape shape;
  /// Name, layer and colour of an assembly, a part, or a solid, shell, face, edge or vertex of a part; assemblies and
  /// parts have a label without these, too.
  struct Label {
    TopoDS_Shape part;
    std::string name;
    bool has_colour = false;
    double red = 0, green = 0, blue = 0;  ///< 0 to 1, sRGB
    std::string layer{};
    /// A use places the next assembly or part of the list.
    enum class Kind { inside, use, part, assembly } kind = Kind::inside;
    int depth = 0;  ///< of assemblies that hold it

    /// 0xRRGGBB, -1: none.
    [[nodiscard]] int rgb() const {
      const auto byte = [](double share) { return static_cast<int>(std::lround(255 * std::clamp(share, 0.0, 1.0))); };
      return has_colour ? byte(red) << 16 | byte(green) << 8 | byte(blue) : -1;
    }
  };
  std::vector<Label> labels;
  std::string unit;  ///< of its coordinates, "" when it has none
  /// Entities of the file that the shape lacks or has in another form: a sentence each, which names the entity.
  std::vector<std::string> losses{};
  /// Ignored or repaired entities, without the loss of a face: a sentence each.
  std::vector<std::string> notes{};
  /// Faces of the shape that stand on data with an error, and why.
  std::vector<std::pair<TopoDS_Shape, std::string>> doubtful{};
  std::string file_unit{};  ///< of the lengths in the file, "" when it has none
};

/// Receives the share of a translation that is done. False stops.
using ReadingProgress = std::function<bool(double fraction)>;

/// The lengths that a shape gets after it was read.
struct Lengths {
  std::string unit;  ///< of coordinates; "": millimetres, or as they are in a BREP file
  double scale = 1;  ///< factor of all coordinates, after the unit
};

/// Reads STEP (.step, .stp), IGES (.iges, .igs) or BREP (.brep; text or binary), by the suffix or else by the first
/// bytes. Lengths are in millimetres, whatever the unit of a STEP or IGES file; a BREP file has none. Throws
/// std::runtime_error with a sentence that names the file.
ShapeFile read_shape(const std::string& path, const ReadingProgress& progress = {}, const Lengths& lengths = {});

/// Reads from memory. `format` is "step", "iges" or "brep"; "": by the bytes. Sentences call the file `name`.
ShapeFile read_shape(std::string_view bytes, const std::string& format, const std::string& name,
                     const ReadingProgress& progress = {}, const Lengths& lengths = {});

/// Removes features below a length from the solids: see changes/small_features.h. When OpenCASCADE fails the shape stays
/// as it is, and a loss reports the reason. Throws std::runtime_error when it is stopped.
std::vector<SmallFeature> remove_features(ShapeFile& file, double size, const ReadingProgress& progress = {});

/// Parts that touch share faces and edges from now on: see changes/imprint.h. Throws std::runtime_error with a sentence when it is
/// stopped; when OpenCASCADE fails the shape stays as it is, and a loss reports the reason.
void imprint_parts(ShapeFile& file, double tolerance, const ReadingProgress& progress = {});

/// Cuts or completes the file at the plane: see changes/mirror.h. Throws std::runtime_error with a sentence.
void mirror_shape(ShapeFile& file, const MirrorPlane& plane);

}  // namespace carreau_occ
