// SPDX-License-Identifier: BSD-3-Clause
// The team of a session: ranks of a communicator, a counter in the memory of rank 0, and exchanges.
#include <algorithm>
#include <memory>
#include <new>
#include <vector>

#include "calls.h"
#include "part.h"
#include "slices.h"

using namespace carreau_mpi;

namespace {

/// The data that the callbacks of carreau_team reach. Lives until the session releases it.
class MpiTeam {
 public:
  explicit MpiTeam(std::int32_t handle) : comm_(handle) {
    const MPI_Aint bytes = comm_.rank() == 0 ? sizeof(std::int64_t) : 0;
    check(MPI_Win_allocate(bytes, sizeof(std::int64_t), MPI_INFO_NULL, comm_, &counter_, &window_),
          "make a window for the numbers of jobs");
    MPI_Win_set_errhandler(window_, MPI_ERRORS_RETURN);
    check(MPI_Win_lock_all(0, window_), "open the window of the numbers of jobs");
    reset();
    check(MPI_Barrier(comm_), "wait for all ranks");
  }
  // Sessions are freed when each rank likes, and windows by all ranks together: without free_together() the window and
  // its communicator stay until MPI_Finalize.
  ~MpiTeam() {
    if (window_ != MPI_WIN_NULL) comm_.keep();
  }
  /// Collective.
  void free_together() {
    MPI_Win_unlock_all(window_);
    MPI_Win_free(&window_);
  }
  MpiTeam(const MpiTeam&) = delete;
  MpiTeam& operator=(const MpiTeam&) = delete;

  [[nodiscard]] const Communicator& comm() const noexcept { return comm_; }

  std::int64_t take(std::int64_t count) {
    std::int64_t before = 0;
    check(MPI_Fetch_and_op(&count, &before, MPI_INT64_T, 0, 0, MPI_SUM, window_), "take a job");
    check(MPI_Win_flush(0, window_), "take a job");
    return before;
  }

  /// Sizes of the bytes of all ranks; `all_` holds the bytes.
  void exchange(const void* bytes, std::int64_t n, std::int64_t* sizes) {
    check(MPI_Allgather(&n, 1, MPI_INT64_T, sizes, 1, MPI_INT64_T, comm_), "exchange sizes");
    reset();  // all ranks are here: none takes a job
    std::size_t total = 0;
    for (int r = 0; r < comm_.size(); ++r) total += static_cast<std::size_t>(sizes[r]);
    make_room(total);
    std::size_t at = 0;
    for (int r = 0; r < comm_.size(); at += static_cast<std::size_t>(sizes[r++])) {
      const auto n_of_rank = static_cast<std::size_t>(sizes[r]);
      if (r == comm_.rank()) std::copy_n(static_cast<const char*>(bytes), n_of_rank, all_.data() + at);
      check(broadcast(comm_, r, all_.data() + at, n_of_rank), "exchange results");
    }
    check(MPI_Barrier(comm_), "wait for all ranks");
  }
  [[nodiscard]] const void* all() const noexcept { return all_.data(); }

 private:
  void reset() {
    if (comm_.rank() != 0) return;
    const std::int64_t zero = 0;
    std::int64_t before = 0;
    check(MPI_Fetch_and_op(&zero, &before, MPI_INT64_T, 0, 0, MPI_REPLACE, window_), "begin the numbers of jobs again");
    check(MPI_Win_flush(0, window_), "begin the numbers of jobs again");
  }

  // A rank without memory must not leave the others waiting for it.
  void make_room(std::size_t total) {
    int enough = 1, all_enough = 0;
    try {
      std::vector<char>().swap(all_);
      all_.resize(total);
    } catch (const std::bad_alloc&) {
      enough = 0;
    }
    check(MPI_Allreduce(&enough, &all_enough, 1, MPI_INT, MPI_MIN, comm_), "agree about memory");
    if (all_enough == 0) throw std::bad_alloc();
  }

  Communicator comm_;
  MPI_Win window_ = MPI_WIN_NULL;
  std::int64_t* counter_ = nullptr;
  std::vector<char> all_;
};

constexpr std::int32_t failed = 1;

std::int32_t take(std::int64_t count, std::int64_t* out_before, void* user) {
  try {
    *out_before = static_cast<MpiTeam*>(user)->take(count);
    return 0;
  } catch (...) {
    return failed;
  }
}

std::int32_t exchange(std::int64_t n, const void* bytes, std::int64_t* out_sizes, const void** out_bytes, void* user) {
  try {
    auto& team = *static_cast<MpiTeam*>(user);
    team.exchange(bytes, n, out_sizes);
    *out_bytes = team.all();
    return 0;
  } catch (const std::bad_alloc&) {
    return CARREAU_ERR_MEMORY;
  } catch (...) {
    return failed;
  }
}

void release(void* user) { delete static_cast<MpiTeam*>(user); }

MpiTeam* attach(carreau_session* session, std::int32_t comm) {
  auto made = std::make_unique<MpiTeam>(comm);
  int provided = MPI_THREAD_SINGLE;
  MPI_Query_thread(&provided);
  carreau_team team{};
  team.struct_size = sizeof team;
  team.user = made.get();
  team.rank = made->comm().rank();
  team.size = made->comm().size();
  team.any_thread = provided == MPI_THREAD_MULTIPLE ? 1 : 0;
  team.take = take;
  team.exchange = exchange;
  team.release = release;
  if (const carreau_status status = carreau_set_team(session, &team); status != CARREAU_OK)
    throw Failure(status, carreau_last_error(session));
  return made.release();  // the session's
}

}  // namespace

carreau_status carreau_mpi_attach(carreau_session* session, int32_t comm) {
  return guarded(session, [&] { attach(session, comm); });
}

namespace {

/// generate() by all ranks of a communicator, which are the team of the session for that long.
template <typename Generate>
carreau_status generate_together(carreau_session* session, std::int32_t comm, const Generate& generate) {
  MpiTeam* team = nullptr;
  if (const carreau_status status = guarded(session, [&] { team = attach(session, comm); }); status != CARREAU_OK) return status;
  const carreau_status status = generate();
  const std::string sentence = carreau_last_error(session);
  team->free_together();  // a run ends on all ranks, whatever its end
  carreau_set_team(session, nullptr);
  // The sentence of the run stays.
  return status == CARREAU_OK ? status : carreau_set_error(session, status, sentence.c_str());
}

}  // namespace

carreau_status carreau_mesh_generate_mpi(carreau_session* session, int32_t comm) {
  return generate_together(session, comm, [&] { return carreau_mesh_generate(session); });
}

carreau_status carreau_mesh_generate_parts(carreau_session* session, int32_t comm, carreau_part** out_part) {
  std::unique_ptr<carreau_part> part;
  const carreau_status made = guarded(session, [&] {
    if (out_part == nullptr) throw Failure(CARREAU_ERR_ARGUMENT, "the argument out_part is NULL");
    part = std::make_unique<carreau_part>();
    carreau_mesh* mesh = nullptr;
    if (const carreau_status status = carreau_mesh_create(&mesh); status != CARREAU_OK) throw Failure(status, "a mesh cannot be made");
    part->mesh.reset(mesh);
  });
  if (made != CARREAU_OK) return made;
  const carreau_status status = generate_together(session, comm, [&] { return carreau_mesh_generate_part(session, part->mesh.get()); });
  if (status != CARREAU_OK && status != CARREAU_ERR_PARTIAL) return status;
  carreau_part_counts counts{};
  counts.struct_size = sizeof counts;
  if (const carreau_status known = carreau_mesh_part_count(part->mesh.get(), &counts); known != CARREAU_OK) return known;
  part->own_vertices = counts.own_vertices, part->own_triangles = counts.own_triangles;
  *out_part = part.release();
  return status;
}
