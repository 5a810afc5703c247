// SPDX-License-Identifier: BSD-3-Clause
// The transaction of edits of a mesh: accepted, or undone.
#pragma once

namespace carreau {

/// Undoes all edits since its construction, or since the last accept(). Trials nest, and an inner trial ends before the outer one. Mesh
/// has state(), undo(state), begin_trial() and end_trial().
template <typename Mesh>
class Trial {
 public:
  explicit Trial(Mesh& mesh) : mesh_(mesh), start_(mesh.state()) { mesh.begin_trial(); }
  ~Trial() {
    (void)undo();
    mesh_.end_trial();
  }
  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;

  void accept() { start_ = mesh_.state(); }
  /// Returns false if nothing had changed.
  bool undo() { return mesh_.undo(start_); }

 private:
  Mesh& mesh_;
  typename Mesh::State start_;
};

}  // namespace carreau
