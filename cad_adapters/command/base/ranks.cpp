// SPDX-License-Identifier: BSD-3-Clause
#include "base/ranks.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "base/failure.h"
#include "base/terminal.h"
#include "base/text_file.h"

namespace command {
namespace {

constexpr int unusable = 2;
// A rank that fails waits so long for the others to fail alike: they do so within the time of a checkpoint.
constexpr double patience_seconds = 5;

#if defined(__APPLE__)
constexpr const char* library_name = "libcarreau_mpi.0.dylib";
#else
constexpr const char* library_name = "libcarreau_mpi.so.0";
#endif

/// A number that the program's starter has set; 0: it has not.
int number_of(const char* variable) {
  const char* const text = std::getenv(variable);
  return text != nullptr ? std::atoi(text) : 0;
}

int first_number(std::initializer_list<const char*> variables) {
  for (const char* variable : variables)
    if (const int n = number_of(variable); n > 0) return n;
  return 0;
}

/// Reads variables of Open MPI, or of MPICH, Intel MPI and other implementations with PMI.
int processes() { return first_number({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}); }
int processes_here() { return first_number({"OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS"}); }

bool is_parallel(const std::string& path) { return suffix_of(path) == ".pvtu"; }

template <typename Function>
Function* function(void* library, const char* name) {
  return reinterpret_cast<Function*>(dlsym(library, name));
}

#define CARREAU_MPI_FUNCTION(name) (*function<decltype(name)>(library_, #name))

}  // namespace

std::unique_ptr<Ranks> Ranks::join(const std::vector<std::string>& outputs, bool parts) {
  const auto parallel = std::find_if(outputs.begin(), outputs.end(), is_parallel);
  if (processes() <= 1 && parallel == outputs.end() && !parts) return nullptr;
  // MPI's own plugins look for its symbols in the whole program.
  void* const library = dlopen(library_name, RTLD_NOW | RTLD_GLOBAL);
  if (library == nullptr) {
    const std::string who = parallel != outputs.end()
                                ? "'" + *parallel + "' is written by many processes"
                            : processes() <= 1
                                ? std::string("--parts is for many processes")
                                : "This is one of " + std::to_string(processes()) + " processes that make one mesh";
    throw Failure(who + ", but libcarreau_mpi is not here: build Carreau with MPI (libopenmpi-dev, CARREAU_MPI).");
  }
  std::unique_ptr<Ranks> ranks(new Ranks);
  ranks->library_ = library;
  if (function<decltype(carreau_mpi_start)>(library, "carreau_mpi_start")(&ranks->comm_, &ranks->rank_, &ranks->size_) != CARREAU_OK)
    throw Failure("MPI cannot be started.");
  if (ranks->speaks()) return ranks;
  ranks->error_output_ = dup(STDERR_FILENO);
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDOUT_FILENO), dup2(nowhere, STDERR_FILENO);
  close(nowhere);
  return ranks;
}

Ranks::Ranks() = default;

int Ranks::threads() const noexcept {
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return std::max(1, cores / std::max(1, processes_here()));
}

void Ranks::attach(carreau_session* session) const {
  if (CARREAU_MPI_FUNCTION(carreau_mpi_attach)(session, comm_) != CARREAU_OK) throw Failure(carreau_last_error(session));
}

carreau_status Ranks::generate_parts(carreau_session* session, Part& part) const {
  carreau_part* made = nullptr;
  const carreau_status status = CARREAU_MPI_FUNCTION(carreau_mesh_generate_parts)(session, comm_, &made);
  part = Part(made, &CARREAU_MPI_FUNCTION(carreau_part_free));
  return status;
}

carreau_mesh* Ranks::mesh_of(const Part& part) const {
  carreau_mesh* mesh = nullptr;
  if (CARREAU_MPI_FUNCTION(carreau_part_mesh)(part.get(), &mesh) != CARREAU_OK) throw Failure("This process has no part of the mesh.");
  return mesh;
}

void Ranks::write(carreau_session* session, const Part& part, const std::string& path) const {
  if (CARREAU_MPI_FUNCTION(carreau_part_write)(session, part.get(), comm_, path.c_str()) != CARREAU_OK)
    throw Failure(carreau_last_error(session));
}

void Ranks::write(carreau_session* session, const std::string& path) const {
  if (CARREAU_MPI_FUNCTION(carreau_mpi_write)(session, comm_, path.c_str()) != CARREAU_OK)
    throw Failure(carreau_last_error(session));
}

std::vector<std::string> Ranks::all_files(const std::vector<std::string>& outputs) const {
  std::vector<std::string> all = outputs;
  for (const std::string& path : outputs)
    for (int r = 0; is_parallel(path) && r < size_; ++r)
      all.push_back(path.substr(0, path.find_last_of('.')) + "_" + std::to_string(r) + ".vtu");
  return all;
}

// mpirun ends all ranks when one has ended with another code than 0: all output must be flushed before.
int Ranks::leave(int code) const {
  std::fflush(stdout);
  std::int32_t greatest = code, speaker = rank_, alone = 0;
  CARREAU_MPI_FUNCTION(carreau_mpi_leave)(code, patience_seconds, &greatest, &speaker, &alone);
  CARREAU_MPI_FUNCTION(carreau_mpi_finish)();
  return greatest;
}

int Ranks::leave_failed(const std::string& why) const {
  std::fflush(stdout);
  std::int32_t greatest = unusable, speaker = rank_, alone = 0;
  CARREAU_MPI_FUNCTION(carreau_mpi_leave)(unusable, patience_seconds, &greatest, &speaker, &alone);
  if (speaker == rank_) {
    dup2(error_output_, STDERR_FILENO);
    print_marked("carreau", colour::red, (speaks() ? why : "rank " + std::to_string(rank_) + ": " + why).c_str());
  }
  if (alone != 0)
    CARREAU_MPI_FUNCTION(carreau_mpi_abort)(unusable);
  else
    CARREAU_MPI_FUNCTION(carreau_mpi_finish)();
  return unusable;
}

}  // namespace command
