// SPDX-License-Identifier: BSD-3-Clause
// Which entities of a STEP or IGES file do not become part of the shape: OpenCASCADE passes over them without a word.
#pragma once

#include <Interface_InterfaceModel.hxx>
#include <TopoDS_Shape.hxx>
#include <XSControl_WorkSession.hxx>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "entity_kinds.h"

namespace carreau_occ {

/// Finds entities of a file, once it is read, that make their translation fail, crash or never end.
class EntityCheck {
 public:
  /// Takes the session of a reader that has read a file and translated nothing yet; the kinds live longer. Removes
  /// faces of STEP shells with numbers that are missing, not finite or without sense (knots that descend, weights that
  /// are not positive), so that OpenCASCADE never sees them.
  EntityCheck(const Handle(XSControl_WorkSession) & session, const EntityKinds& kinds);

  /// After the translation: a sentence "#123 ADVANCED_FACE: ..." for each face of the file that gave no shape, and for
  /// each placement that scales. Also for each entity that carries faces and has an error that no such face explains.
  [[nodiscard]] std::vector<std::string> losses() const;

  /// After the translation: one sentence about all entities with an error that carry no face (annotations, texts); "":
  /// all are sound.
  [[nodiscard]] std::string passed_over() const;

  /// After the translation: faces that were made although an entity below them has an error, with the sentence of it.
  [[nodiscard]] std::vector<std::pair<TopoDS_Shape, std::string>> doubtful() const;

 private:
  [[nodiscard]] std::string label(const Entity& entity) const;
  void find_errors();
  [[nodiscard]] std::map<int, std::string> errors_beside_faces(std::map<int, std::string>& faces) const;
  [[nodiscard]] bool carries_faces(int number) const;
  void blame(int number, const std::string& why, std::map<int, std::string>& faces,
             std::map<int, std::string>& rest) const;

  Handle(XSControl_WorkSession) session_;
  Handle(Interface_InterfaceModel) model_;
  const EntityKinds& kinds_;
  std::map<int, std::string> faces_;  // numbers of faces with an error below, and the sentence
  std::map<int, std::string> rest_;   // entities with an error and no face above
};

}  // namespace carreau_occ
