// SPDX-License-Identifier: BSD-3-Clause
// Files: read, added to sessions, closed.
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <new>
#include <string_view>

#include "changes/mirror.h"
#include "handle.h"

namespace carreau_occ::abi {

carreau_status status_of_exception(std::string* kept) noexcept {
  const auto fail = [kept](carreau_status status, const char* sentence) noexcept {
    try {
      if (kept != nullptr) *kept = sentence;
    } catch (...) {  // no memory for the sentence: the status alone must do
    }
    return status;
  };
  try {
    throw;
  } catch (const Failure& failure) {
    return fail(failure.status, failure.what());
  } catch (const std::bad_alloc&) {
    return fail(CARREAU_ERR_MEMORY, "out of memory");
  } catch (const Standard_Failure& failure) {
    return fail(CARREAU_ERR_FILE, failure.GetMessageString());
  } catch (const std::exception& error) {
    return fail(CARREAU_ERR_FILE, error.what());
  } catch (...) {
    return fail(CARREAU_ERR_INTERNAL, "unknown exception");
  }
}

}  // namespace carreau_occ::abi

using namespace carreau_occ;
using namespace carreau_occ::abi;

namespace {

/// OpenCASCADE's readers have settings of the process.
std::mutex reading;

bool is_length(double x) { return x >= 0 && std::isfinite(x); }

Lengths lengths_of(const carreau_cad_options& options) {
  if (!is_length(options.scale)) throw Failure(CARREAU_ERR_ARGUMENT, "options->scale must be positive");
  return {.unit = options.unit != nullptr ? options.unit : "", .scale = options.scale > 0 ? options.scale : 1};
}

/// A file by its path or its bytes.
struct Source {
  const char* path = nullptr;
  std::string_view bytes{};  // when there is no path
  std::string format{};
};

ShapeFile read_from(const Source& source, const ReadingProgress& progress, const Lengths& lengths) {
  return source.path != nullptr ? read_shape(source.path, progress, lengths)
                                : read_shape(source.bytes, source.format, "the file in memory", progress, lengths);
}

void check_tolerance(double tolerance) {
  if (!is_length(tolerance)) throw Failure(CARREAU_ERR_ARGUMENT, "the tolerance of an imprint must be 0 or a length");
}

/// Makes the host of the shape, and all that is derived from both.
void take_shape(carreau_cad_file& file) {
  file.host = std::make_unique<BrepHost>(file.shape, file.loose_edges);
  file.host->keep(file.trap);
  file.left_out = file.host->excluded();
  std::vector<std::string> notes = file.shape.notes;
  notes.insert(notes.end(), file.host->notes().begin(), file.host->notes().end());
  file.notes.clear();
  for (const std::string& note : notes) file.notes += (file.notes.empty() ? "" : "\n") + note;
  file.figures.reset(), file.report.reset(), file.solids.reset(), file.tree.reset(), file.contacts.reset();
  file.sentences.clear();
}

/// On an error the old content stays.
void replace_shape(carreau_cad_file& file, ShapeFile shape) {
  carreau_cad_file fresh;
  fresh.trap = file.trap, fresh.loose_edges = file.loose_edges, fresh.features = file.features;
  fresh.shape = std::move(shape);
  take_shape(fresh);
  file = std::move(fresh);
}

/// Hands the share of a step on, and remembers whether the caller stopped.
class Listener {
 public:
  Listener(carreau_cad_progress_fn progress, void* user) : progress_(progress), user_(user) {}
  /// A progress for the part of the work from `begin` to `end`.
  [[nodiscard]] ReadingProgress part(double begin, double end) {
    return [this, begin, end](double fraction) {
      if (progress_ != nullptr && progress_(begin + (end - begin) * fraction, user_) != 0) stopped_ = true;
      return !stopped_;
    };
  }
  /// Calls body(); its error is CANCELLED once the caller stopped.
  template <typename Body>
  void run(Body&& body) const {
    try {
      body();
    } catch (const std::runtime_error& error) {
      if (!stopped_) throw;
      throw Failure(CARREAU_ERR_CANCELLED, error.what());
    }
  }

 private:
  carreau_cad_progress_fn progress_;
  void* user_;
  bool stopped_ = false;
};

void read(carreau_cad_file& file, const Source& source, const carreau_cad_options* given) {
  const carreau_cad_options options = read_struct(given, "options");
  const Lengths lengths = lengths_of(options);
  check_tolerance(options.imprint_tolerance);
  if (!is_length(options.min_feature)) throw Failure(CARREAU_ERR_ARGUMENT, "options->min_feature must be 0 or a length");
  carreau_cad_file fresh;
  if (options.trap_faults != 0) fresh.trap = std::make_shared<FaultTrap>();
  fresh.loose_edges = options.loose_edges != 0;
  Listener listener(options.progress, options.user);
  listener.run([&] {
    const std::scoped_lock lock(reading);
    const int steps = 1 + (options.min_feature > 0 ? 1 : 0) + (options.imprint != 0 ? 1 : 0);
    int step = 0;
    const auto next = [&] { return ++step, listener.part((step - 1.0) / steps, static_cast<double>(step) / steps); };
    fresh.shape = read_from(source, next(), lengths);
    if (options.min_feature > 0) fresh.features = remove_features(fresh.shape, options.min_feature, next());
    if (options.imprint != 0) imprint_parts(fresh.shape, options.imprint_tolerance, next());
    take_shape(fresh);
  });
  file = std::move(fresh);
}

void imprint(carreau_cad_file& file, double tolerance, carreau_cad_progress_fn progress, void* user) {
  host_of(file);
  check_tolerance(tolerance);
  Listener listener(progress, user);
  listener.run([&] {
    const std::scoped_lock lock(reading);
    ShapeFile shape = file.shape;
    imprint_parts(shape, tolerance, listener.part(0, 1));
    replace_shape(file, std::move(shape));
  });
}

void mirror(carreau_cad_file& file, const double* point, const double* normal) {
  host_of(file);
  required(point, "point"), required(normal, "normal");
  MirrorPlane plane;
  std::copy(point, point + 3, plane.point.begin());
  std::copy(normal, normal + 3, plane.normal.begin());
  const auto finite = [](double x) { return std::isfinite(x); };
  if (!std::all_of(point, point + 3, finite) || !std::all_of(normal, normal + 3, finite) || !(std::hypot(normal[0], normal[1], normal[2]) > 0))
    throw Failure(CARREAU_ERR_ARGUMENT, "the normal of a mirror plane has no length, or a number is not finite");
  const std::scoped_lock lock(reading);
  ShapeFile shape = file.shape;
  mirror_shape(shape, plane);
  replace_shape(file, std::move(shape));
}

void name_solids(carreau_cad_file& file, std::int64_t n, const char* const* names, const std::int32_t* colours) {
  host_of(file);
  TopTools_IndexedMapOfShape solids;
  TopExp::MapShapes(file.shape.shape, TopAbs_SOLID, solids);
  if (n != solids.Extent())
    throw Failure(CARREAU_ERR_ARGUMENT, "there are " + std::to_string(n) + " names, and " + std::to_string(solids.Extent()) +
                                            " solids");
  required(names, "names");
  std::vector<ShapeFile::Label> labels;
  for (int s = 1; s <= solids.Extent(); ++s) {
    ShapeFile::Label label{.part = solids(s), .name = names[s - 1] != nullptr ? names[s - 1] : ""};
    if (const std::int32_t rgb = colours != nullptr ? colours[s - 1] : -1; rgb >= 0) {
      label.has_colour = true;
      label.red = (rgb >> 16 & 255) / 255.0, label.green = (rgb >> 8 & 255) / 255.0, label.blue = (rgb & 255) / 255.0;
    }
    if (!label.name.empty() || label.has_colour) labels.push_back(label);
  }
  const std::scoped_lock lock(reading);
  ShapeFile shape = file.shape;
  shape.labels.insert(shape.labels.end(), labels.begin(), labels.end());
  replace_shape(file, std::move(shape));
}

/// Sets eps_match unless it has a value already: of the caller, or of a file before.
carreau_status set_match(carreau_session* session, double match) {
  double given = 0;
  const carreau_status status = carreau_get_real(session, "eps_match", &given);
  return status != CARREAU_OK || given > 0 || !(match > 0) ? status : carreau_set_real(session, "eps_match", match);
}

/// The sentence is in the session already when `status` is an error of a call on it.
carreau_status add(carreau_cad_file& file, carreau_session* session) {
  const carreau_status status = host_of(file).add_to(session);
  return status == CARREAU_OK ? set_match(session, host_of(file).match_tolerance()) : status;
}

/// Creates a file, reads it by read_into(file) and adds it.
template <typename ReadInto>
carreau_status open(carreau_session* session, carreau_cad_file** out_file, ReadInto&& read_into) {
  if (session == nullptr) return CARREAU_ERR_ARGUMENT;
  carreau_cad_file* file = nullptr;
  carreau_status status = carreau_cad_create(&file);
  if (status == CARREAU_OK) status = read_into(file);
  if (status != CARREAU_OK)
    status = carreau_set_error(session, status, carreau_cad_last_error(file));
  else
    status = carreau_cad_add(file, session);
  if (status != CARREAU_OK || out_file == nullptr)
    carreau_cad_close(file);
  else
    *out_file = file;
  return status;
}

}  // namespace

carreau_status carreau_cad_create(carreau_cad_file** out_file) {
  if (out_file == nullptr) return CARREAU_ERR_ARGUMENT;
  return status_of([&] { *out_file = new carreau_cad_file; });
}

void carreau_cad_close(carreau_cad_file* file) { delete file; }

const char* carreau_cad_last_error(const carreau_cad_file* file) { return file != nullptr ? file->error.c_str() : ""; }

carreau_status carreau_cad_read(carreau_cad_file* file, const char* path, const carreau_cad_options* options) {
  return guarded_call(file, [&] { read(*file, {.path = required(path, "path")}, options); });
}

carreau_status carreau_cad_read_bytes(carreau_cad_file* file, const void* bytes, int64_t size, const char* format,
                                      const carreau_cad_options* options) {
  return guarded_call(file, [&] {
    if (size < 0) throw Failure(CARREAU_ERR_ARGUMENT, "the size is " + std::to_string(size));
    const std::string_view all(static_cast<const char*>(required(bytes, "bytes")), static_cast<std::size_t>(size));
    read(*file, {.bytes = all, .format = format != nullptr ? format : ""}, options);
  });
}

carreau_status carreau_cad_imprint(carreau_cad_file* file, double tolerance, carreau_cad_progress_fn progress, void* user) {
  return guarded_call(file, [&] { imprint(*file, tolerance, progress, user); });
}

carreau_status carreau_cad_mirror(carreau_cad_file* file, const double point[], const double normal[]) {
  return guarded_call(file, [&] { mirror(*file, point, normal); });
}

carreau_status carreau_cad_name_solids(carreau_cad_file* file, int64_t n, const char* const names[],
                                       const int32_t colours[]) {
  return guarded_call(file, [&] { name_solids(*file, n, names, colours); });
}

carreau_status carreau_cad_add(carreau_cad_file* file, carreau_session* session) {
  if (file == nullptr || session == nullptr) return CARREAU_ERR_ARGUMENT;
  carreau_status added = CARREAU_OK;
  const carreau_status status = guarded_call(file, [&] { added = add(*file, session); });
  if (added != CARREAU_OK) return added;
  return status == CARREAU_OK ? status : carreau_set_error(session, status, file->error.c_str());
}

carreau_status carreau_cad_open(carreau_session* session, const char* path, const carreau_cad_options* options,
                                carreau_cad_file** out_file) {
  return open(session, out_file, [&](carreau_cad_file* file) { return carreau_cad_read(file, path, options); });
}

carreau_status carreau_cad_open_bytes(carreau_session* session, const void* bytes, int64_t size, const char* format,
                                      const carreau_cad_options* options, carreau_cad_file** out_file) {
  return open(session, out_file,
              [&](carreau_cad_file* file) { return carreau_cad_read_bytes(file, bytes, size, format, options); });
}

carreau_status carreau_cad_set_size(carreau_cad_file* file, int32_t dimension, int32_t number, double size) {
  return guarded_call(file, [&] {
    constexpr std::array<const char*, 4> kinds{"vertex", "edge", "face", "solid"};
    if (dimension < 0 || dimension > 3)
      throw Failure(CARREAU_ERR_ARGUMENT, "the dimension is " + std::to_string(dimension) + ", not 0 to 3");
    if (!(size > 0) || !std::isfinite(size)) throw Failure(CARREAU_ERR_ARGUMENT, "a size must be positive");
    if (!host_of(*file).set_size(dimension, number, size))
      throw Failure(CARREAU_ERR_ARGUMENT, std::string("there is no ") + kinds[static_cast<std::size_t>(dimension)] + " " + std::to_string(number));
  });
}

carreau_status carreau_cad_set_face_size(carreau_cad_file* file, const char* face, double size) {
  return guarded_call(file, [&] {
    if (!(size > 0) || !std::isfinite(size)) throw Failure(CARREAU_ERR_ARGUMENT, "a size must be positive");
    if (!host_of(*file).set_face_size(required(face, "face"), size))
      throw Failure(CARREAU_ERR_ARGUMENT, std::string("there is no face '") + face + "'");
  });
}
