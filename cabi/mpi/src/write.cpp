// SPDX-License-Identifier: BSD-3-Clause
// Files that all ranks write together.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <functional>

#include "calls.h"
#include "slices.h"
#include "vtu_pieces.h"

using namespace carreau_mpi;

namespace {

std::string suffix_of(const std::string& path) {
  const std::size_t dot = path.find_last_of('.'), slash = path.find_last_of('/');
  std::string suffix = dot == std::string::npos || (slash != std::string::npos && dot < slash) ? "" : path.substr(dot);
  for (char& c : suffix)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return suffix;
}

/// The name that carreau_mesh_write gives to an incomplete file.
std::string temporary_of(const std::string& path) { return path + ".0.tmp"; }

/// The text of rank 0 on all ranks.
std::string of_first_rank(const Communicator& comm, std::string text) {
  std::int64_t n = static_cast<std::int64_t>(text.size());
  check(MPI_Bcast(&n, 1, MPI_INT64_T, 0, comm), "send a name");
  text.resize(static_cast<std::size_t>(n));
  check(MPI_Bcast(text.data(), static_cast<int>(n), MPI_CHAR, 0, comm), "send a name");
  return text;
}

/// Runs body() on every rank, and throws the failure of the least rank that has one on all of them.
template <typename Body>
void together(const Communicator& comm, Body&& body) {
  int status = CARREAU_OK;
  std::string sentence;
  try {
    body();
  } catch (const Failure& failure) {
    status = failure.status, sentence = failure.what();
  } catch (const std::bad_alloc&) {
    status = CARREAU_ERR_MEMORY, sentence = "rank " + std::to_string(comm.rank()) + " has not enough memory to write its part";
  } catch (const std::exception& error) {
    status = CARREAU_ERR_INTERNAL, sentence = error.what();
  }
  int first = status == CARREAU_OK ? comm.size() : comm.rank();
  check(MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, comm), "agree about errors");
  if (first == comm.size()) return;
  check(MPI_Bcast(&status, 1, MPI_INT, first, comm), "send an error");
  std::int64_t n = static_cast<std::int64_t>(sentence.size());
  check(MPI_Bcast(&n, 1, MPI_INT64_T, first, comm), "send an error");
  sentence.resize(static_cast<std::size_t>(n));
  check(MPI_Bcast(sentence.data(), static_cast<int>(n), MPI_CHAR, first, comm), "send an error");
  throw Failure(status, sentence);
}

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw Failure(CARREAU_ERR_FILE, "cannot write '" + path + "': " + why);
}

void write_alone(const std::string& temporary, const std::string& path, const std::vector<std::string>& strings) {
  errno = 0;
  std::FILE* const file = std::fopen(temporary.c_str(), "wb");
  if (file == nullptr) refuse(path, std::strerror(errno));
  const bool written = std::all_of(strings.begin(), strings.end(), [&](const std::string& bytes) {
    return std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  });
  const int why = errno;
  const bool closed = std::fclose(file) == 0;  // a full disk is often reported only here
  if (!written || !closed) refuse(path, std::strerror(written ? errno : why));
}

void give_name(const std::string& path) {
  if (std::rename(temporary_of(path).c_str(), path.c_str()) != 0) refuse(path, std::strerror(errno));
}

ListedPart part_of_mesh(const Communicator& comm, carreau_mesh* mesh) {
  const WholeMesh whole = whole_mesh(mesh);
  constexpr int layers = 1;
  ListedPart all{part_of(whole, comm.rank(), comm.size(), layers), {}, {}};
  for (const std::int64_t v : all.part.vertex)
    for (const double x : whole.vertices[static_cast<std::size_t>(v)]) all.xyz.push_back(x);
  std::vector<std::int32_t> refs(whole.triangles.size());
  require(mesh, carreau_mesh_triangle_refs(mesh, static_cast<std::int64_t>(refs.size()), refs.data()));
  for (const std::int64_t t : all.part.triangle) all.refs.push_back(refs[static_cast<std::size_t>(t)]);
  return all;
}

/// `file_of_piece`: the file of this rank's piece.
void write_pvtu(const Communicator& comm, const std::string& path, const std::function<std::vector<std::string>()>& file_of_piece) {
  const std::string piece = name_of_piece(path, comm.rank());
  try {
    together(comm, [&] {
      write_alone(temporary_of(piece), piece, file_of_piece());
      if (comm.rank() == 0) write_alone(temporary_of(path), path, {pvtu_text(path, comm.size())});
    });
  } catch (...) {
    std::remove(temporary_of(piece).c_str());
    if (comm.rank() == 0) std::remove(temporary_of(path).c_str());
    throw;
  }
  together(comm, [&] { give_name(piece); });
  together(comm, [&] {  // the file that names the pieces appears when they are all there
    if (comm.rank() == 0) give_name(path);
  });
}

/// The bytes of a file that belong to one rank: all ranks encode equal bytes.
struct Slice {
  std::int64_t begin = 0, end = 0;
  std::int64_t total = 0;
  std::string bytes;
};

struct SliceRequest {
  int rank, size;
  Slice slice;
};

std::int32_t keep_slice(std::int64_t, std::int64_t n, const void* bytes, void* user) {
  try {
    auto& request = *static_cast<SliceRequest*>(user);
    Slice& slice = request.slice;
    slice.total = n;
    const SliceRange own = slice_of(n, request.rank, request.size);
    slice.begin = own.begin, slice.end = own.end;
    slice.bytes.assign(static_cast<const char*>(bytes) + slice.begin, static_cast<std::size_t>(slice.end - slice.begin));
    return 0;
  } catch (...) {
    return CARREAU_ERR_MEMORY;
  }
}

void write_slice(MPI_File file, const std::string& path, const Slice& slice) {
  if (!write_at(file, slice.begin, slice.bytes.data(), slice.bytes.size()))
    refuse(path, errno != 0 ? std::strerror(errno) : "MPI could not write all bytes; the disk may be full");
}

/// `write_own`: writes the bytes of this rank, and gives where the last of them ends.
void write_file(const Communicator& comm, const std::string& path, const std::function<std::int64_t(MPI_File)>& write_own) {
  const std::string temporary = temporary_of(path);
  MPI_File file = MPI_FILE_NULL;
  std::int64_t end = 0;
  try {
    together(comm, [&] {
      if (comm.rank() == 0) write_alone(temporary, path, {});  // an older one ends here, and why it cannot be written
    });
    const int opened = MPI_File_open(comm, temporary.c_str(), MPI_MODE_WRONLY, MPI_INFO_NULL, &file);
    together(comm, [&] {
      if (opened != MPI_SUCCESS) refuse(path, "MPI could not open it on rank " + std::to_string(comm.rank()));
    });
    together(comm, [&] {
      errno = 0;
      end = write_own(file);
    });
    const int closed = MPI_File_close(&file);
    check(MPI_Allreduce(MPI_IN_PLACE, &end, 1, MPI_INT64_T, MPI_MAX, comm), "agree about the size of a file");
    together(comm, [&] {
      struct stat status {};
      if (closed != MPI_SUCCESS) refuse(path, "MPI could not close it");
      if (comm.rank() == 0 && (stat(temporary.c_str(), &status) != 0 || status.st_size != end))
        refuse(path, "its size differs from its number of bytes; the disk may be full");
    });
    together(comm, [&] {
      if (comm.rank() == 0) give_name(path);
    });
  } catch (...) {
    if (file != MPI_FILE_NULL) MPI_File_close(&file);
    if (comm.rank() == 0) std::remove(temporary.c_str());
    throw;
  }
}

void write_bytes(const Communicator& comm, carreau_mesh* mesh, const std::string& path) {
  SliceRequest request{comm.rank(), comm.size(), {}};
  together(comm, [&] { require(mesh, carreau_mesh_encode(mesh, suffix_of(path).c_str(), keep_slice, &request)); });
  write_file(comm, path, [&](MPI_File file) {
    write_slice(file, path, request.slice);
    return request.slice.total;
  });
}

/// The bytes of a part in a file, which are written as they come.
struct PartRequest {
  MPI_File file;
  std::int64_t end = 0;
  bool failed = false;
};

std::int32_t write_some(std::int64_t position, std::int64_t n, const void* bytes, void* user) {
  auto& request = *static_cast<PartRequest*>(user);
  request.failed = !write_at(request.file, position, static_cast<const char*>(bytes), static_cast<std::size_t>(n));
  request.end = std::max(request.end, position + n);
  return request.failed ? CARREAU_ERR_FILE : 0;
}

void write_part_bytes(const Communicator& comm, carreau_mesh* part, const std::string& path) {
  write_file(comm, path, [&](MPI_File file) {
    PartRequest request{file};
    const carreau_status status = carreau_mesh_encode(part, suffix_of(path).c_str(), write_some, &request);
    if (request.failed) refuse(path, errno != 0 ? std::strerror(errno) : "MPI could not write all bytes; the disk may be full");
    require(part, status);
    return request.end;
  });
}

void write_part(const carreau_part* part, std::int32_t handle, const char* given) {
  const Communicator comm(handle);
  together(comm, [&] {
    if (given == nullptr) throw Failure(CARREAU_ERR_ARGUMENT, "the argument path is NULL");
    if (part == nullptr) throw Failure(CARREAU_ERR_ARGUMENT, "the argument part is NULL");
    if (!part->mesh) throw Failure(CARREAU_ERR_SEQUENCE, "each rank has the whole mesh of this part: use carreau_mpi_write");
  });
  const std::string path = of_first_rank(comm, given);
  if (suffix_of(path) == ".pvtu")
    write_pvtu(comm, path, [&] { return vtu_of_part(listed(*part), comm.rank()); });
  else
    write_part_bytes(comm, part->mesh.get(), path);
}

void write(carreau_session* session, std::int32_t handle, const char* given) {
  const Communicator comm(handle);
  carreau_mesh* mesh = nullptr;
  together(comm, [&] {
    if (given == nullptr) throw Failure(CARREAU_ERR_ARGUMENT, "the argument path is NULL");
    if (const carreau_status status = carreau_session_mesh(session, &mesh); status != CARREAU_OK)
      throw Failure(status, carreau_last_error(session));
  });
  const std::string path = of_first_rank(comm, given);
  if (suffix_of(path) == ".pvtu")
    write_pvtu(comm, path, [&] { return vtu_of_part(part_of_mesh(comm, mesh), comm.rank()); });
  else
    write_bytes(comm, mesh, path);
}

}  // namespace

carreau_status carreau_mpi_write(carreau_session* session, int32_t comm, const char* path) {
  return guarded(session, [&] { write(session, comm, path); });
}

carreau_status carreau_part_write(carreau_session* session, const carreau_part* part, int32_t comm, const char* path) {
  return guarded(session, [&] { write_part(part, comm, path); });
}
