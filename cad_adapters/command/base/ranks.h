// SPDX-License-Identifier: BSD-3-Clause
// The processes that mpirun has started: they mesh together, and the first one prints.
#pragma once

#include <carreau_mpi.h>

#include <memory>
#include <string>
#include <vector>

namespace command {

class Ranks {
 public:
  /// A part of a mesh (carreau_mpi.h).
  using Part = std::shared_ptr<carreau_part>;

  /// The processes of this run; null where this one is alone and neither an output (.pvtu) nor `parts` needs others. Throws Failure where
  /// there are others and libcarreau_mpi is not there.
  static std::unique_ptr<Ranks> join(const std::vector<std::string>& outputs, bool parts);
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  [[nodiscard]] int size() const noexcept { return size_; }
  /// True for the first rank: it prints, and gives files their names. Output of the others is not shown.
  [[nodiscard]] bool speaks() const noexcept { return rank_ == 0; }
  /// Threads for each rank of this machine, when all its cores are shared evenly.
  [[nodiscard]] int threads() const noexcept;

  /// All meshes of the session are made by all ranks. Throws Failure.
  void attach(carreau_session* session) const;
  /// The mesh of a session that is not attached, of which each rank keeps its part; carreau_mesh_generate_parts.
  carreau_status generate_parts(carreau_session* session, Part& part) const;
  [[nodiscard]] carreau_mesh* mesh_of(const Part& part) const;
  /// Writes it by all ranks, to the path of the first one. Throws Failure.
  void write(carreau_session* session, const Part& part, const std::string& path) const;
  /// Writes the mesh by all ranks, to the path of the first one. Throws Failure.
  void write(carreau_session* session, const std::string& path) const;
  /// `outputs`, then the additional files: pieces of .pvtu, in the order of the ranks.
  [[nodiscard]] std::vector<std::string> all_files(const std::vector<std::string>& outputs) const;

  /// The end of the program, after all that it prints: the greatest exit code of all ranks.
  int leave(int code) const;
  /// Ends the program after a failure; returns the exit code. The first failed rank reports the reason, and ends the
  /// other ranks if they have not failed.
  int leave_failed(const std::string& why) const;

 private:
  Ranks();

  void* library_ = nullptr;
  int comm_ = 0, rank_ = 0, size_ = 1;
  int error_output_ = 2;  // where this rank can print
};

}  // namespace command
