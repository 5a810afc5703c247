// SPDX-License-Identifier: BSD-3-Clause
// The beginning and the end of a program that loads this library.
#include <array>
#include <chrono>
#include <thread>

#include "calls.h"

using namespace carreau_mpi;

carreau_status carreau_mpi_start(int32_t* out_comm, int32_t* out_rank, int32_t* out_size) {
  if (out_comm == nullptr || out_rank == nullptr || out_size == nullptr) return CARREAU_ERR_ARGUMENT;
  int initialised = 0, provided = 0;
  MPI_Initialized(&initialised);
  if (initialised == 0 && MPI_Init_thread(nullptr, nullptr, MPI_THREAD_MULTIPLE, &provided) != MPI_SUCCESS)
    return CARREAU_ERR_CALLBACK;
  MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
  MPI_Comm_rank(MPI_COMM_WORLD, out_rank);
  MPI_Comm_size(MPI_COMM_WORLD, out_size);
  *out_comm = MPI_Comm_c2f(MPI_COMM_WORLD);
  return CARREAU_OK;
}

carreau_status carreau_mpi_leave(int32_t code, double seconds, int32_t* out_code, int32_t* out_speaker,
                                 int32_t* out_alone) {
  if (out_code == nullptr || out_speaker == nullptr || out_alone == nullptr) return CARREAU_ERR_ARGUMENT;
  int rank = 0, size = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  *out_code = code, *out_speaker = rank, *out_alone = 0;
  // MPI_MAXLOC: the greatest code, and the least rank that has it.
  const std::array<int, 2> mine{code, rank};
  std::array<int, 2> worst{};
  MPI_Request request = MPI_REQUEST_NULL;
  if (MPI_Iallreduce(mine.data(), worst.data(), 1, MPI_2INT, MPI_MAXLOC, MPI_COMM_WORLD, &request) != MPI_SUCCESS)
    return CARREAU_ERR_CALLBACK;
  const auto start = std::chrono::steady_clock::now();
  for (int done = 0; done == 0;) {
    if (MPI_Test(&request, &done, MPI_STATUS_IGNORE) != MPI_SUCCESS) return CARREAU_ERR_CALLBACK;
    if (done != 0) break;
    if (code > 1 && std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() > seconds) {
      *out_alone = 1;
      return CARREAU_OK;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  *out_code = worst[0], *out_speaker = worst[1];
  return CARREAU_OK;
}

carreau_status carreau_mpi_finish(void) {
  const bool met = MPI_Barrier(MPI_COMM_WORLD) == MPI_SUCCESS;
  return met && MPI_Finalize() == MPI_SUCCESS ? CARREAU_OK : CARREAU_ERR_CALLBACK;
}

void carreau_mpi_abort(int32_t code) { MPI_Abort(MPI_COMM_WORLD, code); }
