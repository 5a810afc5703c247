// SPDX-License-Identifier: BSD-3-Clause
// Files: read, added to sessions, closed.
#include <cmath>
#include <mutex>

#include "handle.h"

using namespace carreau_occ;
using namespace carreau_occ::abi;

namespace {

/// OpenCASCADE's readers have settings of the process.
std::mutex reading;

void read(carreau_cad_file& file, const char* path, const carreau_cad_options* given) {
  const carreau_cad_options options = read_struct(given, "options");
  carreau_cad_file fresh;
  if (options.trap_faults != 0) fresh.trap = std::make_shared<FaultTrap>();
  bool stopped = false;
  const ReadingProgress progress = [&](double fraction) {
    if (options.progress != nullptr && options.progress(fraction, options.user) != 0) stopped = true;
    return !stopped;
  };
  try {
    const std::scoped_lock lock(reading);
    fresh.shape = read_shape(required(path, "path"), progress);
    fresh.host = std::make_unique<BrepHost>(fresh.shape, options.loose_edges != 0);
  } catch (const std::runtime_error& error) {
    if (!stopped) throw;
    throw Failure(CARREAU_ERR_CANCELLED, error.what());
  }
  fresh.host->keep(fresh.trap);
  fresh.left_out = fresh.host->excluded();
  std::vector<std::string> notes = fresh.shape.notes;
  notes.insert(notes.end(), fresh.host->notes().begin(), fresh.host->notes().end());
  for (const std::string& note : notes) fresh.notes += (fresh.notes.empty() ? "" : "\n") + note;
  file = std::move(fresh);
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

}  // namespace

carreau_status carreau_cad_create(carreau_cad_file** out_file) {
  if (out_file == nullptr) return CARREAU_ERR_ARGUMENT;
  return status_of([&] { *out_file = new carreau_cad_file; }, [](const char*) {});
}

void carreau_cad_close(carreau_cad_file* file) { delete file; }

const char* carreau_cad_last_error(const carreau_cad_file* file) { return file != nullptr ? file->error.c_str() : ""; }

carreau_status carreau_cad_read(carreau_cad_file* file, const char* path, const carreau_cad_options* options) {
  return guarded_call(file, [&] { read(*file, path, options); });
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
  if (session == nullptr) return CARREAU_ERR_ARGUMENT;
  carreau_cad_file* file = nullptr;
  carreau_status status = carreau_cad_create(&file);
  if (status == CARREAU_OK) status = carreau_cad_read(file, path, options);
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

carreau_status carreau_cad_set_face_size(carreau_cad_file* file, const char* face, double size) {
  return guarded_call(file, [&] {
    if (!(size > 0) || !std::isfinite(size)) throw Failure(CARREAU_ERR_ARGUMENT, "a size must be positive");
    if (!host_of(*file).set_face_size(required(face, "face"), size))
      throw Failure(CARREAU_ERR_ARGUMENT, std::string("there is no face '") + face + "'");
  });
}
