// SPDX-License-Identifier: BSD-3-Clause
// The files of a session: its mesh, its fields, its measures.
#include <algorithm>
#include <array>

#include "cad/checked_cad.h"
#include "cad/part_cad.h"
#include "fields/field_files.h"
#include "io/delivered_json.h"
#include "io/files.h"
#include "io/high_order/curved_files.h"
#include "io/medit/surface_file.h"
#include "io/mesh_files.h"
#include "model/geometries.h"
#include "periodic/closest.h"
#include "projection/mesh_association.h"
#include "session/options.h"
#include "session/output/export.h"
#include "session/output/field_attributes.h"
#include "session/state.h"
#include "support/infinity.h"

namespace carreau {

namespace {

void refuse_fields(const Model& model) {
  if (has_discrete(model)) throw InvalidArgument("a surface given as triangles has no fields over parameter domains");
}

}  // namespace

std::vector<std::string> Session::write_fields(const std::string& path, const FieldOptions& options) {
  const bool of_mesh = state_->has_mesh && !state_->last_failed && !options.raw;
  return of_mesh ? write_fields_of_mesh(path, options) : write_fields_of_model(path, options);
}

std::vector<std::string> Session::write_fields_of_mesh(const std::string& path, FieldOptions options) {
  State& s = *state_;
  const Meshed& meshed = s.meshed;
  refuse_fields(meshed.model);
  CheckedCad whole_cad(*meshed.cad);
  PartCad cad(whole_cad, parts_of(meshed.model));
  const double diag = s.result.report.diag;
  set_parameter_domains(meshed.model, meshed.supports, cad);
  // Measures without messages: the user requested pictures, not a report.
  std::optional<MeshEvaluation> measured;
  const auto evaluation_here = [&]() -> const MeshEvaluation& {
    if (s.delivered) return *s.delivered;
    if (!measured) measured = evaluate_meshed(meshed, s.result, nullptr, s.monitor);
    return *measured;
  };
  const FieldRun run{.model = meshed.model,
                     .topology = meshed.topology,
                     .supports = &meshed.supports,
                     .result = &s.result,
                     .size = meshed.options.size,
                     .parameters = field_attributes(s.meshed_parameters, diag),
                     .diag = diag,
                     .delivered = evaluation_here};
  if (options.file.threads == 0) options.file.threads = threads_of(s.parameters);
  return carreau::write_fields(run, path, options, cad, s.monitor);
}

std::vector<std::string> Session::write_fields_of_model(const std::string& path, FieldOptions options) {
  State& s = *state_;
  if (!s.cad) throw InvalidArgument("no geometry is registered: register the callbacks first");
  if (s.model.faces.empty()) throw InvalidModel("the model has no face");
  refuse_fields(s.model);
  CheckedCad whole_cad(*s.cad);
  PartCad cad(whole_cad, parts_of(s.model));
  const Parameters& parameters = s.last_failed ? s.tried_parameters : s.parameters;
  // Errors that would stop a run only remove data here.
  std::optional<ModelSupports> supports;
  std::shared_ptr<BackgroundField> background;
  try {
    background = background_of_run(parameters, s.model.plane, s.background);
    supports = build_supports(s.model, cad, parameters.real("angle_smo"), threads_of(s.parameters), s.monitor);
    set_parameter_domains(s.model, *supports, cad);
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    s.monitor.message(Level::warning, error.what());
  }
  const Topology none;
  FieldRun run{.model = s.model,
               .topology = none,
               .supports = supports ? &*supports : nullptr,
               .result = nullptr,
               .size = {},
               .parameters = {}};
  run.diag = supports ? supports->diag : diag_of_curves(s.model, cad, s.monitor);
  run.parameters = field_attributes(parameters, run.diag);
  run.size = composite_options(parameters, run.diag).size;
  run.size.sources = s.sources(background.get());
  for (PrescriptionSource* source : run.size.sources) source->begin_run(run.size.law);
  if (options.file.threads == 0) options.file.threads = threads_of(s.parameters);
  return carreau::write_fields(run, path, options, cad, s.monitor);
}

void Session::write_delivered(const std::string& path) {
  const std::string text = delivered_json(mesh(), report(), delivered());
  state_->monitor.progress(Phase::writing, 0, 1);
  write_file(path, text);
}

FlatMesh Session::exported(const MeshEvaluation* delivered, bool with_fields) const {
  const ExportSource source{
      mesh(), state_->result.vertex_size, state_->meshed.model, state_->meshed.supports, delivered, with_fields};
  const Parameters& p = state_->parameters;
  FlatMesh flat = export_mesh(source, p.text("option"), p.integer("refs"), p.integer("flag") == 1);
  if (source.model.plane) flat.dimension = 2;
  flat.names = source.model.names;
  show_points(source.model, flat.vertex_refs);
  return flat;
}

const std::map<int, int>& Session::shown_points() const { return (void)mesh(), state_->meshed.model.shown_points; }

const EntityNames& Session::names() const { return (void)mesh(), state_->meshed.model.names; }

namespace {

// The flat mesh without places of vertices and without triangles.
FlatMesh frame_of(const SurfaceMesh& mesh, const Model& model, bool with_edges) {
  SurfaceMesh lines;
  lines.curves = mesh.curves;
  FlatMesh frame = flatten(lines, with_edges);
  frame.vertex_refs = mesh.vertex_ref;
  if (model.plane) frame.dimension = 2;
  show_points(model, frame.vertex_refs);
  return frame;
}

}  // namespace

void Session::write(const std::string& path) {
  if (suffix_of(path) == ".exr") {
    (void)mesh();
    FieldOptions options;
    options.multi_part = true;
    if (state_->parameters.text("option").starts_with("onesurf")) options.face = state_->parameters.integer("refs");
    write_fields_of_mesh(path, options);
    return;
  }
  const MeshFormat format = mesh_format_of(path);
  MeshAssociation association;
  const MeshFileOptions file = file_options(format, association);
  const std::string option = state_->parameters.text("option");
  if (format == MeshFormat::meshb && file.association == nullptr && (option.empty() || option == "allsurf3d") && !mesh().cells_are_not_triangles()) {
    state_->monitor.progress(Phase::writing, 0, 1);
    return write_surface(mesh(), frame_of(mesh(), state_->meshed.model, state_->parameters.integer("flag") == 1), path);
  }
  write_mesh(exported_as(format), path, format, file);
}

std::string Session::encoded(MeshFormat format) {
  MeshAssociation association;
  const MeshFileOptions file = file_options(format, association);
  return mesh_bytes(exported_as(format), format, file);
}

void Session::write_raised(const std::string& path) const {
  write_curved(raised(), path, state_->parameters.integer("association") == 1);
}

FlatMesh Session::exported_as(MeshFormat format) {
  const MeshEvaluation* measures = nullptr;  // other formats have no place for them
  if (format == MeshFormat::vtu && (state_->delivered || state_->parameters.integer("measure") != 0))
    measures = &delivered();
  state_->monitor.progress(Phase::writing, 0, 1);
  FlatMesh mesh = exported(measures, format == MeshFormat::vtu);
  if (format == MeshFormat::msh && state_->parameters.integer("solid_groups") == 0) mesh.names.face_solids.clear();
  return mesh;
}

MeshFileOptions Session::file_options(MeshFormat format, MeshAssociation& association) const {
  MeshFileOptions file{.ascii_stl = true, .curve_groups = state_->parameters.integer("curve_groups") == 1};
  constexpr std::array with_places{MeshFormat::msh, MeshFormat::msh2, MeshFormat::mesh, MeshFormat::meshb, MeshFormat::vtu};
  if (state_->parameters.integer("association") == 0 || std::find(with_places.begin(), with_places.end(), format) == with_places.end()) return file;
  const std::string option = state_->parameters.text("option");
  if (!option.empty() && option != "allsurf3d") throw InvalidArgument("association: the export \"" + option + "\" is not the whole mesh in space");
  association = associate_nodes();
  file.association = &association;
  return file;
}

MeshAssociation Session::associate_nodes() const {
  const State& s = *state_;
  const Meshed& meshed = s.meshed;
  const SurfaceMesh& mesh = this->mesh();
  const std::vector<CurveParameters>& known = s.result.curve_parameters;
  std::vector<std::vector<double>> mid_t(mesh.curves.size());
  CheckedCad whole_cad(*meshed.cad);
  PartCad cad(whole_cad, parts_of(meshed.model));
  const CurveModel model{meshed.model, meshed.topology, meshed.supports.of_face, cad};
  for (std::size_t c = 0; c < std::min(known.size(), meshed.topology.curves.size()); ++c) {
    const CurveMesh& curve = mesh.curves[c];
    const std::vector<CurveUse>& uses = meshed.topology.curves[c].uses;
    const auto use = std::find_if(uses.begin(), uses.end(),
                                  [&](const CurveUse& each) { return model.face_ref(each) == known[c].face && each.curve + 1 == known[c].ic; });
    if (use == uses.end() || known[c].t.size() != curve.vertices.size()) continue;
    for (std::size_t k = 0; k < curve.mid.size(); ++k) {
      const auto [low, high] = std::minmax(known[c].t[k], known[c].t[k + 1]);
      mid_t[c].push_back(curve.mid[k] >= 0 && low < high ? find_closest(model, *use, (low + high) / 2, low, high, mesh.mid_vertices[curve.mid[k]]).t
                                                         : nan);
    }
  }
  const auto shown = [&](std::int32_t ref) {
    const auto found = meshed.model.shown_points.find(ref);
    return found != meshed.model.shown_points.end() ? found->second : ref;
  };
  return associate(mesh, known, mid_t, shown, [this](std::size_t face, std::int32_t node) { return uv_face(face, node); });
}

}  // namespace carreau
