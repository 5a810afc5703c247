// SPDX-License-Identifier: BSD-3-Clause
// The prescriptions and results of the mesh of a face, sampled on a grid of its parameter box and written as images
// (EXR).
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "cad/cad.h"
#include "control_space/control_space.h"
#include "fields/field_shape.h"
#include "fields/size_origins.h"
#include "io/exr.h"
#include "mesh/surface_mesh.h"
#include "support/monitor.h"
#include "surface/sample/face_metric.h"

namespace carreau {

/// Groups of channels; bits. Values are part of the C ABI.
enum FieldGroup : unsigned {
  field_size = 1,        ///< size.h, size.h1 size.h2 size.angle: prescribed sizes; model length, degrees
  field_induced = 2,     ///< induced.e .f .g: first fundamental form
  field_target = 4,      ///< target.m11 .m12 .m22: metric of the parameter plane that the mesher used
  field_curvature = 8,   ///< curvature.k1 .k2: principal ones, k1 >= k2; 1 / model length
  field_position = 16,   ///< position.x .y .z
  field_normal = 32,     ///< normal.x .y .z: unit length
  field_deviation = 64,  ///< deviation.a0 .a1: of the pixel's triangle; model length, degrees
  field_triangle = 128,  ///< triangle: number of the pixel's triangle in the mesh
  field_mask = 256,      ///< mask: 1 in the domain, 0 outside
  field_preview = 512,   ///< R G B A
  /// physical.h .h1 .h2 .angle, geometric.h .h1 .h2 .angle: each alone, clamped; model length, degrees; governs: a
  /// SizeOrigin
  field_governs = 1024,
  all_fields = 2047,
};

/// In the channel `triangle` a pixel without triangle, in `governs` an unknown origin.
constexpr std::uint32_t no_triangle = 0xFFFFFFFF;

struct FieldOptions {
  /// Pixels of the longer side of each image; the shorter one follows the lengths of the patch in space.
  int longest = 1024;
  int width = 0, height = 0;  ///< both > 0: of every image, in place of `longest`
  unsigned groups = all_fields;
  int face = 0;                      ///< reference of the only face to be written; 0: all
  bool multi_part = false;           ///< one file of a part a face ("face.<ref>"), instead of a file a face
  bool raw = false;                  ///< the model as it is now, without its mesh
  ExrOptions file = {.threads = 0};  ///< threads 0: parameter threads
};

/// Data of a face. Pointers may be null: the channels that need them have no value then.
struct FieldSource {
  int ref = 0;
  FieldShape shape;
  const FaceMesh* mesh = nullptr;
  std::uint32_t first_triangle = 0;      ///< number of its first triangle in the whole mesh
  std::span<const double> vertex_size;   ///< of the whole mesh
  FaceMetric* prescribed = nullptr;      ///< used by the caller's thread only
  SizeOrigins* origins = nullptr;        ///< likewise; requires `prescribed`
  const ControlSpace* space = nullptr;   ///< the mesher's space
  std::vector<ExrAttribute> attributes;  ///< besides the attributes of the image
};

/// A0 and A1 of each triangle of the whole mesh; both empty: not known.
struct FieldDeviations {
  std::span<const double> a0, a1;
};

/// One face as an image.
class FieldImage {
 public:
  /// Asks the geometry at about a thousand points. `deviations` is called when the first row is made, and only when its
  /// channels are requested. Keeps references to its arguments. Throws InvalidArgument for sizes that cannot be.
  FieldImage(const FieldSource& source, const FieldOptions& options, std::function<FieldDeviations()> deviations,
             Cad& cad, Monitor& monitor);
  ~FieldImage();
  FieldImage(const FieldImage&) = delete;
  FieldImage& operator=(const FieldImage&) = delete;

  [[nodiscard]] ExrPart part() const;
  [[nodiscard]] const PixelGrid& grid() const noexcept;
  /// Makes the pixels; the calling thread evaluates the geometry, for pixels of the domain only. Pixels at which the
  /// host fails are NaN; only Cancelled is thrown.
  [[nodiscard]] ExrPrepare pixels();
  /// The preview over white as a PNG file: options.groups must be field_preview. Throws as pixels() does.
  [[nodiscard]] std::string png();
  /// Pixels at which the host failed until now, and its first sentence.
  [[nodiscard]] std::int64_t failures() const noexcept;
  [[nodiscard]] const std::string& first_failure() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Name of the file of one face: "a/x.exr" becomes "a/x.face.7.exr". Throws InvalidArgument unless it ends in ".exr"
/// or ".png".
std::string field_file_of_face(const std::string& path, int ref);

/// Throws InvalidArgument that describes the conflict.
void check_field_options(const FieldOptions& options);

}  // namespace carreau
