// SPDX-License-Identifier: BSD-3-Clause
#include "model/model.h"

#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <unordered_set>

#include "arguments.h"
#include "curve/prescribed_edges.h"
#include "guard.h"
#include "io/files.h"
#include "io/model/pardom.h"
#include "support/vec.h"

using carreau::Face;
using carreau::InvalidArgument;
using carreau::Model;
using namespace carreau::abi;

namespace {

/// The face of a reference; the last ones first, since a model is usually built face by face.
Face& face_of(Model& model, std::int32_t ref) {
  for (auto face = model.faces.rbegin(); face != model.faces.rend(); ++face)
    if (face->ref == ref) return *face;
  throw InvalidArgument("the model has no face of reference " + std::to_string(ref) +
                        ": call carreau_model_add_face first");
}

template <typename Member>
std::size_t total(const Model& model, Member member) {
  std::size_t n = 0;
  for (const Face& face : model.faces) n += (face.*member).size();
  return n;
}

// On a curve that gluing has cut since, on all of its parts.
void prescribe(Face& face, std::int32_t ic, const std::shared_ptr<const carreau::PrescribedEdges>& edges) {
  bool any = false;
  for (std::size_t c = 0; c < face.curves.size(); ++c)
    if (carreau::host_rank(face, c) == ic) face.curves[c].edges = edges, any = true;
  if (!any) throw InvalidArgument(carreau::Where{.face = face.ref, .curve_index = ic}, "the face has no such curve");
}

void put(std::int32_t* array, std::size_t index, std::int32_t value) {
  if (array != nullptr) array[index] = value;
}

/// All references of a dimension.
std::unordered_set<int> references_of(const Model& model, std::int32_t dimension) {
  std::unordered_set<int> known;
  for (const auto& [face, solids] : model.names.face_solids)
    if (dimension == 3) known.insert(solids.begin(), solids.end());
  for (const Face& face : model.faces) {
    if (dimension == 2) known.insert(face.ref);
    if (dimension < 2)
      for (const carreau::FaceCurve& curve : face.curves) {
        known.insert(dimension == 1 ? curve.ref : curve.end1);
        known.insert(dimension == 1 ? curve.shown_as : curve.end2);
      }
    if (dimension == 0)
      for (const carreau::FacePoint& point : face.points) known.insert(point.ref);
  }
  known.erase(0);
  return known;
}

}  // namespace

carreau_status carreau_model_clear(carreau_session* session) {
  return guarded(session, [&] {
    if (session->begun) {
      session->draft = {};
      return;
    }
    session->draft = {}, session->draft_changed = false;
    session->session.clear_model();
    session->drop_geometries();
  });
}

carreau_status carreau_model_add_face(carreau_session* session, int32_t ref, int32_t orientation) {
  return guarded(session, [&] {
    Face face;
    face.ref = ref;
    face.orientation = orientation;
    session->edited_model().faces.push_back(std::move(face));
  });
}

carreau_status carreau_model_add_curve(carreau_session* session, int32_t face_ref, int32_t type, int32_t ref,
                                       int32_t end1, int32_t end2) {
  return guarded(session, [&] {
    if (type != CARREAU_BOUNDARY && type != CARREAU_INTERNAL)
      throw InvalidArgument(carreau::Where{.face = face_ref},
                            "the type of a curve is " + std::to_string(type) +
                                "; it must be 1 (CARREAU_BOUNDARY) or 2 (CARREAU_INTERNAL)");
    for (const AddedGeometry& geometry : session->added)
      if (!session->begun && !session->host && geometry.kind != CARREAU_GEOMETRY_CALLBACKS && face_ref >= geometry.range.first_face &&
          face_ref <= geometry.range.last_face)
        throw InvalidArgument(carreau::Where{.face = face_ref},
                              "its geometry evaluates no other curve: register callbacks that do, by carreau_set_cad, or embed a polyline by "
                              "carreau_model_embed_polyline");
    face_of(session->edited_model(), face_ref)
        .curves.push_back({.type = carreau::CurveType(type), .ref = ref, .end1 = end1, .end2 = end2});
  });
}

carreau_status carreau_model_divide_curve(carreau_session* session, int32_t face_ref, int32_t ic, int32_t edges,
                                          int32_t progression, double ratio) {
  return guarded(session, [&] {
    if (progression < CARREAU_EQUAL || progression > CARREAU_GEOMETRIC)
      throw InvalidArgument("the progression of edges is " + std::to_string(progression) +
                            "; it must be 0 (CARREAU_EQUAL), 1 (CARREAU_ARITHMETIC) or 2 (CARREAU_GEOMETRIC)");
    carreau::PrescribedEdges told;
    told.progression = carreau::Progression(progression);
    told.edges = edges;
    if (told.progression != carreau::Progression::equal) told.ratio = ratio;
    if (edges != 0) (void)carreau::progression_shares(told);
    prescribe(face_of(session->edited_model(), face_ref), ic,
              edges == 0 ? nullptr : std::make_shared<const carreau::PrescribedEdges>(std::move(told)));
  });
}

carreau_status carreau_model_divide_curve_at(carreau_session* session, int32_t face_ref, int32_t ic, int64_t n,
                                             const double t[]) {
  return guarded(session, [&] {
    if (n < 0 || (n > 0 && t == nullptr))
      throw InvalidArgument("the vertices of a curve are n >= 0 parameters; n is " + std::to_string(n) +
                            (t == nullptr ? " and t is NULL" : ""));
    carreau::PrescribedEdges told;
    told.progression = carreau::Progression::given;
    told.edges = 0;
    told.t.assign(t, t + n);
    for (std::size_t k = 0; k < told.t.size(); ++k)
      if (!std::isfinite(told.t[k]) || (k > 0 && !(told.t[k - 1] < told.t[k])))
        throw InvalidArgument(carreau::Where{.face = face_ref, .curve_index = ic, .t = told.t[k]},
                              "the parameters of the vertices must be finite and strictly increasing");
    prescribe(face_of(session->edited_model(), face_ref), ic,
              std::make_shared<const carreau::PrescribedEdges>(std::move(told)));
  });
}

carreau_status carreau_model_add_point(carreau_session* session, int32_t face_ref, int32_t ref, double u, double v) {
  return guarded(session, [&] {
    const carreau::Vec2 uv{u, v};
    if (!carreau::is_finite(uv))
      throw InvalidArgument(carreau::Where{.face = face_ref, .point = ref, .uv = uv},
                            "the parameters of an imposed point are not finite");
    face_of(session->edited_model(), face_ref).points.push_back({.ref = ref, .uv = uv});
  });
}

carreau_status carreau_model_name_face(carreau_session* session, int32_t face_ref, const char* name) {
  return guarded(session, [&] { face_of(session->edited_model(), face_ref).name = required(name, "name"); });
}

carreau_status carreau_model_name_entities(carreau_session* session, int32_t dimension, int64_t n, const int32_t refs[],
                                           const char* name) {
  return guarded(session, [&] {
    constexpr std::array<const char*, 4> kinds{"point", "curve", "face", "solid"};
    Model& model = session->edited_model();
    const std::string given = required(name, "name");
    if (dimension < 0 || dimension > 3) throw InvalidArgument("the dimension is " + std::to_string(dimension) + ", not 0 to 3");
    if (n < 0) throw InvalidArgument("n is " + std::to_string(n));
    if (n == 0) return;
    const std::unordered_set<int> wanted(required(refs, "refs"), refs + n), known = references_of(model, dimension);
    for (const int ref : std::span(refs, std::size_t(n)))
      if (!known.contains(ref))
        throw InvalidArgument(std::string("the model has no ") + kinds[std::size_t(dimension)] + " of reference " + std::to_string(ref));
    for (Face& face : model.faces)
      if (dimension == 2 && wanted.contains(face.ref)) face.name = given;
    carreau::EntityNames& names = model.names;
    for (const int ref : wanted)
      if (dimension != 2) (dimension == 0 ? names.points : dimension == 1 ? names.curves : names.solids)[ref] = given;
  });
}

carreau_status carreau_model_set_face_sides(carreau_session* session, int32_t face_ref, int32_t solid, int32_t other_solid) {
  return guarded(session, [&] {
    Model& model = session->edited_model();
    (void)face_of(model, face_ref);
    if (solid < 0 || other_solid < 0)
      throw InvalidArgument(carreau::Where{.face = face_ref}, "the reference of a solid is below 0");
    model.names.face_solids[face_ref] = {solid, other_solid};
  });
}

carreau_status carreau_model_color_face(carreau_session* session, int32_t face_ref, int32_t rgb) {
  return guarded(session, [&] {
    constexpr std::int32_t none = -1, white = 0xFFFFFF;
    if (rgb < none || rgb > white)
      throw InvalidArgument(carreau::Where{.face = face_ref},
                            "the colour " + std::to_string(rgb) + " is neither 0xRRGGBB nor -1");
    face_of(session->edited_model(), face_ref).rgb = rgb;
  });
}

carreau_status carreau_model_part_of_face(carreau_session* session, int32_t face_ref, int32_t whole_ref) {
  return guarded(session, [&] {
    Model& model = session->edited_model();
    Face& face = face_of(model, face_ref);
    const auto rank = std::size_t(&face - model.faces.data());
    const Face* before = rank > 0 ? &model.faces[rank - 1] : nullptr;
    if (before == nullptr || (before->part_of != 0 ? before->part_of : before->ref) != whole_ref)
      throw InvalidArgument(carreau::Where{.face = face_ref},
                            "it cannot be a part of face " + std::to_string(whole_ref) +
                                ": parts are added right behind the first one, whose reference they all have");
    face.part_of = whole_ref;
  });
}

carreau_status carreau_model_part_of_curve(carreau_session* session, int32_t ref, int32_t whole_ref) {
  return guarded(session, [&] {
    bool found = false;
    for (Face& face : session->edited_model().faces)
      for (carreau::FaceCurve& curve : face.curves)
        if (curve.ref == ref) curve.shown_as = whole_ref != ref ? whole_ref : 0, found = true;
    if (!found) throw InvalidArgument("the model has no curve of reference " + std::to_string(ref));
  });
}

carreau_status carreau_model_leave_out_face(carreau_session* session, int32_t face_ref, const char* why) {
  return guarded(session, [&] { face_of(session->edited_model(), face_ref).left_out = why != nullptr ? why : ""; });
}

carreau_status carreau_model_read_pardom(carreau_session* session, const char* path) {
  return guarded(session, [&] {
    session->refuse_begun();
    session->session.load_pardom(required(path, "path"));
    session->draft = {};
    session->draft_changed = false;
    session->drop_geometries();
  });
}

carreau_status carreau_model_write_pardom(carreau_session* session, const char* path) {
  return guarded(session, [&] { carreau::write_file(required(path, "path"), carreau::pardom_text(session->model())); });
}

carreau_status carreau_model_check(carreau_session* session) {
  return guarded(session, [&] {
    if (session->model().faces.empty()) throw carreau::InvalidModel("the model has no face");
    session->commit_model();
  });
}

carreau_status carreau_model_count(carreau_session* session, int64_t* out_faces, int64_t* out_curves,
                                   int64_t* out_points) {
  return guarded(session, [&] {
    const Model& model = session->model();
    if (out_faces != nullptr) *out_faces = std::int64_t(model.faces.size());
    if (out_curves != nullptr) *out_curves = std::int64_t(total(model, &Face::curves));
    if (out_points != nullptr) *out_points = std::int64_t(total(model, &Face::points));
  });
}

carreau_status carreau_model_faces(carreau_session* session, int64_t capacity, int32_t* out_refs,
                                   int32_t* out_orientations) {
  return guarded(session, [&] {
    const Model& model = session->model();
    check_capacity(capacity, model.faces.size(), "faces");
    for (std::size_t i = 0; i < model.faces.size(); ++i) {
      put(out_refs, i, model.faces[i].ref);
      put(out_orientations, i, model.faces[i].orientation);
    }
  });
}

carreau_status carreau_model_curves(carreau_session* session, int64_t capacity, int32_t* out_face_refs,
                                    int32_t* out_types, int32_t* out_refs, int32_t* out_ends) {
  return guarded(session, [&] {
    const Model& model = session->model();
    check_capacity(capacity, total(model, &Face::curves), "curves");
    std::size_t i = 0;
    for (const Face& face : model.faces)
      for (const carreau::FaceCurve& curve : face.curves) {
        put(out_face_refs, i, face.ref);
        put(out_types, i, int(curve.type));
        put(out_refs, i, curve.ref);
        put(out_ends, 2 * i, curve.end1);
        put(out_ends, 2 * i + 1, curve.end2);
        ++i;
      }
  });
}

carreau_status carreau_model_points(carreau_session* session, int64_t capacity, int32_t* out_face_refs,
                                    int32_t* out_refs, double* out_uv) {
  return guarded(session, [&] {
    const Model& model = session->model();
    check_capacity(capacity, total(model, &Face::points), "imposed points");
    std::size_t i = 0;
    for (const Face& face : model.faces)
      for (const carreau::FacePoint& point : face.points) {
        put(out_face_refs, i, face.ref);
        put(out_refs, i, point.ref);
        if (out_uv != nullptr) out_uv[2 * i] = point.uv.x(), out_uv[2 * i + 1] = point.uv.y();
        ++i;
      }
  });
}
