// SPDX-License-Identifier: BSD-3-Clause
#include "fields/fields.h"

#include "arguments.h"
#include "guard.h"

using namespace carreau::abi;

static_assert(int(carreau::field_size) == int(CARREAU_EXR_SIZE) &&
              int(carreau::field_induced) == int(CARREAU_EXR_INDUCED));
static_assert(int(carreau::field_target) == int(CARREAU_EXR_TARGET) &&
              int(carreau::field_curvature) == int(CARREAU_EXR_CURVATURE));
static_assert(int(carreau::field_position) == int(CARREAU_EXR_POSITION) &&
              int(carreau::field_normal) == int(CARREAU_EXR_NORMAL));
static_assert(int(carreau::field_deviation) == int(CARREAU_EXR_DEVIATION) &&
              int(carreau::field_triangle) == int(CARREAU_EXR_TRIANGLE));
static_assert(int(carreau::field_mask) == int(CARREAU_EXR_MASK) &&
              int(carreau::field_preview) == int(CARREAU_EXR_PREVIEW));
static_assert(int(carreau::field_governs) == int(CARREAU_EXR_GOVERNS));
static_assert(int(carreau::SizeOrigin::physical) == int(CARREAU_GOVERNS_PHYSICAL) &&
              int(carreau::SizeOrigin::geometric) == int(CARREAU_GOVERNS_GEOMETRIC));
static_assert(int(carreau::SizeOrigin::bounds) == int(CARREAU_GOVERNS_BOUNDS) &&
              int(carreau::SizeOrigin::gradation) == int(CARREAU_GOVERNS_GRADATION));

namespace {

bool read_flag(std::int32_t value, const char* name) {
  if (value != 0 && value != 1)
    throw carreau::InvalidArgument(std::string("options->") + name + " is " + std::to_string(value) + ", not 0 or 1");
  return value == 1;
}

carreau::FieldOptions field_options(const carreau_exr_options& given) {
  if (given.reserved != 0) throw carreau::InvalidArgument("options->reserved is not 0");
  carreau::FieldOptions options;
  if (given.longest != 0) options.longest = given.longest;
  options.width = given.width, options.height = given.height;
  if (given.channels != 0) options.groups = static_cast<unsigned>(given.channels);
  options.face = given.face;
  options.multi_part = read_flag(given.multi_part, "multi_part");
  options.raw = read_flag(given.raw, "raw");
  options.file.compression =
      read_flag(given.compression, "compression") ? carreau::ExrCompression::piz : carreau::ExrCompression::zip;
  options.file.threads = given.threads;
  return options;
}

}  // namespace

carreau_status carreau_write_exr(carreau_session* session, const char* path, const carreau_exr_options* options) {
  return guarded(session, [&] {
    required(path, "path");
    session->monitor.begin_run();
    const carreau::FieldOptions fields =
        field_options(options != nullptr ? read_struct(options, "options") : carreau_exr_options{});
    if (!session->has_cad)
      throw StatusError(CARREAU_ERR_SEQUENCE,
                        "no geometry is registered: call carreau_set_cad or carreau_set_cad_m first");
    if (fields.raw || !session->session.has_mesh()) {
      if (session->model().faces.empty()) throw StatusError(CARREAU_ERR_SEQUENCE, "the model has no face yet");
      session->commit_model();
    }
    session->session.write_fields(path, fields);
  });
}
