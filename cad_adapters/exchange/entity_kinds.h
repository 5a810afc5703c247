// SPDX-License-Identifier: BSD-3-Clause
// The properties of a format for the check of entities.
#pragma once

#include <Interface_EntityIterator.hxx>
#include <Interface_Graph.hxx>
#include <Interface_InterfaceModel.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <gp_Pnt.hxx>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace carreau_occ {

using Entity = Handle(Standard_Transient);

/// The numbers of a spline, where there are some.
struct Spline {
  std::vector<std::vector<double>> knots;
  std::vector<double> weights, coordinates;

  void add_knots(const Handle(TColStd_HArray1OfReal) & array) {
    if (!array.IsNull()) knots.emplace_back(array->begin(), array->end());
  }
  void add(const gp_Pnt& p, double weight) {
    coordinates.insert(coordinates.end(), {p.X(), p.Y(), p.Z()});
    weights.push_back(weight);
  }
};

class EntityKinds {
 public:
  virtual ~EntityKinds() = default;
  [[nodiscard]] virtual bool is_face(const Entity& entity) const = 0;
  /// Entities of which a shape is made. Other entities (styles, notes, persons) may be wrong.
  [[nodiscard]] virtual bool is_geometry(const Entity& entity) const = 0;
  /// True if faces may be missing or misplaced when this entity cannot be read; false for annotations, texts and
  /// curves.
  [[nodiscard]] virtual bool carries_faces(const Entity& entity, const Interface_Graph& graph) const = 0;
  [[nodiscard]] virtual Spline spline(const Entity& entity) const = 0;
  /// Numbers that could not be read hold anything, and OpenCASCADE searches without end where coordinates are not
  /// finite.
  virtual bool mend_numbers(const Entity&) const { return false; }
  /// The scale of a placement that OpenCASCADE 7.6 drops; "" for all other entities.
  [[nodiscard]] virtual std::string lost_scale(const Entity& entity) const = 0;
  /// Entities of which a faulty one is a part.
  [[nodiscard]] virtual std::vector<Entity> wholes_of(const Entity& entity, const Interface_Graph& graph) const {
    std::vector<Entity> wholes;
    for (Interface_EntityIterator up = graph.Sharings(entity); up.More(); up.Next()) wholes.push_back(up.Value());
    return wholes;
  }
  /// Faces that are not to be translated.
  virtual void take_out(const Handle(Interface_InterfaceModel) &, const std::set<Entity>&) const {}
};

template <typename Type>
bool is(const Entity& entity) {
  return entity->IsKind(STANDARD_TYPE(Type));
}

/// The entity as a type, or null: a dynamic cast, which takes four times as long, is left out for other entities.
template <typename Type>
Handle(Type) as(const Entity& entity) {
  return is<Type>(entity) ? Handle(Type)::DownCast(entity) : Handle(Type)();
}

inline std::string printed(double x) {
  std::ostringstream text;
  text << x;
  return text.str();
}

}  // namespace carreau_occ
