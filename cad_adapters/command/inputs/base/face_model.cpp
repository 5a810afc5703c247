// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/base/face_model.h"

#include <algorithm>

#include "files/session_handle.h"

namespace command {

const FaceModel::Face* FaceModel::find(std::int32_t ref) const {
  const auto at = std::find_if(faces.begin(), faces.end(), [&](const Face& face) { return face.ref == ref; });
  return at == faces.end() ? nullptr : &*at;
}

FaceModel::Face* FaceModel::find(std::int32_t ref) {
  return const_cast<Face*>(static_cast<const FaceModel&>(*this).find(ref));
}

FaceModel read_pardom(const std::string& path) {
  const SessionHandle session = make_session();
  require(session.get(), carreau_model_read_pardom(session.get(), path.c_str()));
  return model_of(session.get());
}

FaceModel model_of(carreau_session* session) {
  std::int64_t f = 0, c = 0, p = 0;
  require(session, carreau_model_count(session, &f, &c, &p));
  const auto faces = static_cast<std::size_t>(f), curves = static_cast<std::size_t>(c),
             points = static_cast<std::size_t>(p);
  std::vector<std::int32_t> refs(faces), orientations(faces), of_curve(curves), types(curves), curve_refs(curves),
      ends(2 * curves), of_point(points), point_refs(points);
  std::vector<double> uv(2 * points);
  require(session, carreau_model_faces(session, f, refs.data(), orientations.data()));
  require(session, carreau_model_curves(session, c, of_curve.data(), types.data(), curve_refs.data(), ends.data()));
  require(session, carreau_model_points(session, p, of_point.data(), point_refs.data(), uv.data()));
  FaceModel model;
  std::size_t curve = 0, point = 0;
  for (std::size_t i = 0; i < faces; ++i) {
    FaceModel::Face face{.ref = refs[i], .orientation = orientations[i], .curves = {}, .points = {}};
    for (; curve < curves && of_curve[curve] == face.ref; ++curve)
      face.curves.push_back({types[curve], curve_refs[curve], ends[2 * curve], ends[2 * curve + 1]});
    for (; point < points && of_point[point] == face.ref; ++point)
      face.points.push_back({point_refs[point], uv[2 * point], uv[2 * point + 1]});
    model.faces.push_back(std::move(face));
  }
  return model;
}

carreau_status give_model(const FaceModel& model, carreau_session* session) {
  carreau_status status = carreau_model_clear(session);
  for (const FaceModel::Face& face : model.faces) {
    if (status == CARREAU_OK) status = carreau_model_add_face(session, face.ref, face.orientation);
    for (const FaceModel::Curve& c : face.curves)
      if (status == CARREAU_OK) status = carreau_model_add_curve(session, face.ref, c.type, c.ref, c.end1, c.end2);
    for (const FaceModel::Point& p : face.points)
      if (status == CARREAU_OK) status = carreau_model_add_point(session, face.ref, p.ref, p.u, p.v);
  }
  return status;
}

}  // namespace command
