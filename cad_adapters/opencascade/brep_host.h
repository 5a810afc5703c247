// A boundary representation of OpenCASCADE as a host of the C interface.
#pragma once

#include <carreau.h>

#include <TopoDS_Shape.hxx>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace carreau_occ {

/// Faces, edges and vertices of a shape, numbered from 1 as OpenCASCADE's maps of the shape number them: those numbers
/// are the references of faces, curves and points. A face that is reversed gets u and v exchanged, so that triangles,
/// which are counterclockwise in (u, v), look outwards of a solid.
class BrepHost {
 public:
  /// `shape` is kept. Throws std::runtime_error when it has no face.
  explicit BrepHost(const TopoDS_Shape& shape);
  ~BrepHost();
  BrepHost(const BrepHost&) = delete;
  BrepHost& operator=(const BrepHost&) = delete;

  /// Gives geometry and model to a session, which must not outlive this object. A status of carreau.h; the sentence is
  /// in the session.
  carreau_status give_to(carreau_session* session);

  [[nodiscard]] int face_count() const noexcept;
  [[nodiscard]] int edge_count() const noexcept;
  [[nodiscard]] int vertex_count() const noexcept;
  /// Diagonal of the box of all edges.
  [[nodiscard]] double diagonal() const;
  /// Every edge belongs to two faces, or twice to one.
  [[nodiscard]] bool is_closed() const noexcept;
  /// What failed in a callback, with the face; "" when nothing did.
  [[nodiscard]] const std::string& failure() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace carreau_occ
