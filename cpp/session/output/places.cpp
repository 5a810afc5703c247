// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "embedding/embedder.h"
#include "projection/projector.h"
#include "session/options.h"
#include "session/state.h"
#include "support/error.h"

namespace carreau {

namespace {

void check_places(const Cad* cad, const Model& model) {
  if (cad == nullptr) throw InvalidArgument("no geometry is registered: register the callbacks first");
  if (model.faces.empty()) throw InvalidArgument("the model has no face");
}

bool lacks_references(const Model& model) {
  return std::any_of(model.faces.begin(), model.faces.end(), [](const Face& face) {
    return std::any_of(face.curves.begin(), face.curves.end(), [](const FaceCurve& curve) { return curve.ref <= 0; });
  });
}

}  // namespace

Projector& Session::projector(int dimension) {
  State& s = *state_;
  check_places(s.cad.get(), s.model);
  if (dimension < 2 && lacks_references(s.model)) throw InvalidArgument("curves and points of the model have no references yet: a mesh gives them");
  if (!s.projector) s.projector = std::make_unique<Projector>(s.cad, s.triangles, s.model);
  return *s.projector;
}

Embedder& Session::embedder() {
  State& s = *state_;
  check_places(s.host.get(), s.model);
  if (lacks_references(s.model)) find_model_references();
  if (!s.embedder) s.embedder = std::make_unique<Embedder>(s.host, s.triangles, s.model, s.embedded, threads_of(s.parameters), s.monitor);
  return *s.embedder;
}

int Session::embed_point(const Vec3& x, const std::string& name) {
  Embedder& all = embedder();
  const int ref = all.embed_point(x, state_->parameters.real("embed_tolerance", all.diagonal()));
  return keep_embedded(0, ref, name);
}

int Session::embed_polyline(std::span<const Vec3> points, const std::string& name) {
  Embedder& all = embedder();
  const int ref = all.embed_polyline(points, state_->parameters.real("embed_tolerance", all.diagonal()));
  return keep_embedded(1, ref, name);
}

int Session::embed_wires() {
  Embedder& all = embedder();
  std::vector<std::string> remarks;
  const int wires = all.embed_wires(state_->parameters.real("embed_tolerance", all.diagonal()), remarks);
  for (const std::string& remark : remarks) state_->monitor.message(Level::warning, remark);
  keep_embedded(1, 0, "");
  return wires;
}

int Session::keep_embedded(int dimension, int ref, const std::string& name) {
  State& s = *state_;
  if (!name.empty()) s.embedder->set_name(dimension, ref, name);
  s.model = s.embedder->model();
  s.embedded = s.embedder->curves();
  s.update_cad();
  s.projector.reset();
  return ref;
}

void Session::evaluate_places(int dimension, int ref, unsigned want, std::span<const Vec2> parameters, std::span<SurfaceJet> out) {
  projector(dimension).evaluate(dimension, ref, want, parameters, out, threads_of(state_->parameters), state_->monitor);
}

std::map<int, std::string> Session::project(int dimension, int ref, std::span<const Vec3> x, std::span<ProjectedPoint> out) {
  return projector(dimension).project(dimension, ref, x, out, threads_of(state_->parameters), state_->monitor);
}

std::vector<MeshEntity> Session::node_entities() const {
  return entities_of_nodes(mesh(), [this](std::size_t face, std::int32_t node) { return uv_face(face, node); }, state_->result.curve_parameters);
}

std::vector<CurveParameters> Session::curve_parameters() const {
  std::vector<CurveParameters> all = state_->result.curve_parameters;
  all.resize(mesh().curves.size());
  for (CurveParameters& on : all)
    for (const Face& face : state_->meshed.model.faces)
      if (face.ref == on.face && on.ic > 0 && static_cast<std::size_t>(on.ic) <= face.curves.size()) on.ic = host_rank(face, static_cast<std::size_t>(on.ic) - 1);
  return all;
}

}  // namespace carreau
