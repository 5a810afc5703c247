// SPDX-License-Identifier: BSD-3-Clause
#include "session/session.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "cad/checked_cad.h"
#include "fields/field_files.h"
#include "geometry/discrete/discrete_cad.h"
#include "io/delivered_json.h"
#include "io/files.h"
#include "io/mesh_files.h"
#include "io/pardom.h"
#include "measure/beside_patches.h"
#include "measure/composite_evaluation.h"
#include "measure/discrete_evaluation.h"
#include "mesh/quality.h"
#include "model/geometries.h"
#include "model/places.h"
#include "session/derivatives.h"
#include "session/export.h"
#include "session/field_attributes.h"
#include "session/file_adaptation.h"
#include "session/gluing.h"
#include "session/left_out.h"
#include "session/messages.h"
#include "session/options.h"
#include "support/format.h"
#include "support/infinity.h"
#include "support/part_monitor.h"
#include "support/ranks/team.h"
#include "surface/discrete/beside_patches.h"
#include "surface/discrete/discrete_run.h"
#include "surface/independent/charts.h"
#include "surface/team/same_hosts.h"

namespace carreau {

namespace {

/// What a mesh was made of: what measures it asks the same again.
struct Meshed {
  std::shared_ptr<Cad> cad;
  std::shared_ptr<const discrete::DiscreteCad> triangles;
  std::shared_ptr<PrescriptionSource> metric_callbacks, prescription_source;  // of `options`, as is the next
  std::shared_ptr<BackgroundField> background;
  Model model;
  ModelSupports supports;
  Topology topology;
  CompositeOptions options;
  bool bounds_to_input = false;  // measures tell them
};

// x.pardom.new (RT-0232 sec. 3.2).
void write_glued(const Model& model, std::vector<std::string>& remarks) {
  const bool whole =
      std::all_of(model.faces.begin(), model.faces.end(), [](const Face& face) { return face.left_out.empty(); });
  if (whole)
    write_file(model.source + ".new", pardom_text(model));
  else
    remarks.push_back(model.source + ".new is not written: a face was left out");
}

}  // namespace

struct Session::State {
  explicit State(Monitor& m) : monitor(m) {}

  Monitor& monitor;
  std::shared_ptr<Cad> cad;
  std::shared_ptr<const discrete::DiscreteCad> triangles;
  std::shared_ptr<PrescriptionSource> metric_callbacks, prescription_source;
  std::shared_ptr<BackgroundField> background;
  std::shared_ptr<TeamLink> team_link;
  std::unique_ptr<Team> team;  // of team_link; null: this process is alone
  BackgroundReport background_report;
  SurfaceMesh previous;
  bool has_previous = false;
  Model model;
  GlueReport glued;  // in `model`
  bool model_from_file = false;
  bool model_from_env = false;  // read by `call inimesh`: the next one reads its own
  Parameters parameters;
  CompositeResult result;
  std::shared_ptr<const PartResults> parts;  // of `result`; null: it is of one kind
  Meshed meshed;
  bool has_mesh = false;
  Parameters meshed_parameters, tried_parameters;  // of `result`, and of the last make_mesh()
  bool last_failed = false;                        // the last make_mesh() has thrown
  std::optional<MeshEvaluation> delivered;         // of `result`
  std::vector<Interface> interfaces;               // of `result`
  std::vector<WholeFace> whole_faces;              // of `result`
  std::optional<QualitySummary> shapes, quality;   // of `result`, once somebody has asked: without edges, and all

  /// The host first.
  [[nodiscard]] std::vector<PrescriptionSource*> sources(BackgroundField* of_this_run) const {
    std::vector<PrescriptionSource*> all;
    for (PrescriptionSource* source :
         {metric_callbacks.get(), prescription_source.get(), static_cast<PrescriptionSource*>(of_this_run)})
      if (source != nullptr) all.push_back(source);
    if (!all.empty() && parameters.integer("hphy_flag") == 0)
      monitor.message(Level::warning, "hphy_flag = 0: the prescribed sizes and metrics are ignored");
    return all;
  }

  /// Finds references that are missing, and looks for curves that are one where that is wanted.
  void glue_model(Model& known, ModelSupports& supports, Cad& whole_cad, std::vector<std::string>& remarks) {
    const Gluing options{.eps = parameters.real("eps_glue", supports.diag),
                         // Farther apart, curves of one reference are an error of the model (build_topology).
                         .eps_open = std::min(parameters.real("eps_glue_open"), supports.diag / 100),
                         .eps_face = parameters.real("eps_glue_face"),
                         .angle_smo = std::min(parameters.real("angle_smo"), parameters.real("angle_mesh"))};
    GlueReport found;
    bool any = is_mixed(known) && !geometries_to_glue(known).empty();
    if (any) find_references_of_geometries(known, supports, whole_cad, options, remarks, found, monitor);
    if (const std::size_t forgotten = references_to_forget(known); forgotten > 0)
      monitor.message(Level::warning,
                      "the first curve of the model has the reference 0" + of_line(first_curve(known)->line) +
                          ": all references are found, and those that " + std::to_string(forgotten) +
                          (forgotten == 1 ? " other curve has" : " other curves have") + " mean nothing");
    if (const bool all = needs_gluing(known); all || parameters.integer("glue_open") != 0) {
      GlueReport among_all;
      known = find_references(known, supports, whole_cad, options, remarks, among_all, monitor);
      found.pairs.insert(found.pairs.end(), among_all.pairs.begin(), among_all.pairs.end());
      found.open = among_all.open;
      any = true;
      if (all && model_from_file) check_model(known), write_glued(known, remarks);
    }
    if (!any) return;
    check_model(known);
    keep_glued(known, found);
  }

  /// Faces that were left out of gluing stay as they are, and only the host's own reasons to leave them out are kept.
  void keep_glued(const Model& part, const GlueReport& found) {
    Model whole = part;
    give_back(model, whole);
    for (std::size_t f = 0; f < whole.faces.size(); ++f) whole.faces[f].left_out = model.faces[f].left_out;
    model = std::move(whole);
    glued.pairs.insert(glued.pairs.end(), found.pairs.begin(), found.pairs.end());
    glued.open = found.open;
  }

  void check_model(const Model& candidate) const {
    const std::vector<ModelDefect> defects = list_model_defects(candidate);
    if (defects.empty()) return;
    std::string sentence = defects.front().sentence;
    if (defects.size() > 1) sentence += " (and " + std::to_string(defects.size() - 1) + " more)";
    for (std::size_t i = 1; i < defects.size(); ++i) monitor.message(Level::error, defects[i].text());
    throw InvalidModel(defects.front().where, sentence);
  }
};

namespace {

// Finite differences of a host without derivatives stay inside the box of each domain.
void set_parameter_boxes(const Model& model, const ModelSupports& supports, Cad& cad) {
  for (std::size_t f = 0; f < model.faces.size(); ++f) {
    Vec2 low{infinity, infinity}, high{-infinity, -infinity};
    for (const CurveSupport& support : supports.of_face[f])
      for (const Vec2& p : support.uv) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
    if (low.x() < high.x() && low.y() < high.y()) cad.set_parameter_box(model.faces[f].ref, low, high);
  }
}

// Files named by parameters come before what the host has set.
std::shared_ptr<BackgroundField> background_of_run(const Parameters& parameters, bool one_plane,
                                                   const std::shared_ptr<BackgroundField>& set) {
  const std::string mesh = parameters.text("background_mesh"), sol = parameters.text("background_sol");
  if (mesh.empty() != sol.empty())
    throw InvalidArgument(std::string("background_mesh and background_sol name two files of one field, but only ") +
                          (mesh.empty() ? "background_sol" : "background_mesh") + " is set");
  return mesh.empty() ? set : read_background(mesh, sol, one_plane);
}

MeshEvaluation measure_patches(const Meshed& meshed, const CompositeResult& result, Cad& whole_cad, Monitor& monitor) {
  PartCad cad(whole_cad, parts_of(meshed.model));
  set_parameter_boxes(meshed.model, meshed.supports, cad);
  return evaluate_composite(meshed.model, meshed.topology, cad, meshed.options, result, monitor);
}

MeshEvaluation measure_triangles(const Meshed& meshed, const CompositeOptions& options, const CompositeResult& result,
                                 Cad& cad, Monitor& monitor) {
  MeshEvaluation delivered = evaluate_discrete(*meshed.triangles, cad, options, result, monitor);
  if (meshed.bounds_to_input)
    bound_input_distances(meshed.triangles->discrete(), result.mesh, options.threads, monitor, delivered);
  return delivered;
}

MeshEvaluation measure(const Meshed& meshed, const CompositeResult& result, const PartResults* parts,
                       Monitor& monitor) {
  CheckedCad cad(*meshed.cad);
  if (is_discrete(meshed.model)) return measure_triangles(meshed, meshed.options, result, cad, monitor);
  if (parts == nullptr) return measure_patches(meshed, result, cad, monitor);
  PartMonitor first(monitor, 0, share_of_patches), second(monitor, share_of_patches, 1);
  const MeshEvaluation patches = measure_patches(meshed, parts->patches, cad, first);
  const MeshEvaluation triangles =
      measure_triangles(meshed, parts->triangle_options, parts->triangles, cad, second);
  return beside_each_other(result.mesh, patches, triangles, [&](std::size_t face) { return parts->is_of_triangles(face); });
}

void refuse_fields(const Model& model) {
  if (has_discrete(model)) throw InvalidArgument("a surface given as triangles has no fields over parameter domains");
}

}  // namespace

Session::Session(Monitor& monitor) : state_(std::make_unique<State>(monitor)) {}
Session::~Session() = default;

void Session::set_cad(std::shared_ptr<Cad> cad) {
  if (auto alone = std::dynamic_pointer_cast<const discrete::DiscreteCad>(cad)) state_->triangles = std::move(alone);
  state_->cad = std::move(cad);
}

void Session::set_triangles(std::shared_ptr<const discrete::DiscreteCad> triangles) {
  state_->triangles = std::move(triangles);
}

void Session::set_metric_callbacks(std::shared_ptr<PrescriptionSource> source) {
  state_->metric_callbacks = std::move(source);
}
void Session::set_prescription_source(std::shared_ptr<PrescriptionSource> source) {
  state_->prescription_source = std::move(source);
}

void Session::set_background(std::shared_ptr<BackgroundField> background) {
  state_->background = std::move(background);
}
const BackgroundReport& Session::background_report() const noexcept { return state_->background_report; }

bool Session::has_model_from_host() const noexcept { return !state_->model.faces.empty() && !state_->model_from_env; }

void Session::set_team(std::shared_ptr<TeamLink> link) {
  state_->team = link ? std::make_unique<Team>(*link) : nullptr;
  state_->team_link = std::move(link);
}

void Session::set_model(Model model) {
  if (leaves_out(state_->parameters)) leave_out_defects(model);
  state_->check_model(model);
  state_->model = std::move(model);
  state_->glued = {};
  state_->model_from_file = state_->model_from_env = false;
}

void Session::load_pardom(const std::string& path) {
  Model model = read_pardom(path);
  set_model(std::move(model));
  state_->model_from_file = true;
}

void Session::load_pardom_of_env(const std::string& path) {
  load_pardom(path);
  state_->model_from_env = true;
}

void Session::clear_model() noexcept {
  state_->model = {};
  state_->glued = {};
}

const Model& Session::model() const noexcept { return state_->model; }
Parameters& Session::parameters() noexcept { return state_->parameters; }
Monitor& Session::monitor() noexcept { return state_->monitor; }
bool Session::has_mesh() const noexcept { return state_->has_mesh; }

const SurfaceMesh& Session::mesh() const {
  if (!state_->has_mesh) throw InvalidArgument("there is no mesh yet: make one first");
  return state_->result.mesh;
}
bool Session::has_previous_mesh() const noexcept { return state_->has_previous; }
const SurfaceMesh& Session::previous_mesh() const {
  if (!state_->has_previous) throw InvalidArgument("there is no mesh before this one: make a second one first");
  return state_->previous;
}
std::size_t Session::uv_face(std::size_t face, std::int32_t node) const {
  const FaceMesh& of = mesh().faces[face];
  const auto k = static_cast<std::size_t>(node);
  if (k < of.uv.size()) return of.uv_face.empty() ? face : static_cast<std::size_t>(of.uv_face[k]);
  const CompositeResult& result = state_->parts ? state_->parts->of(face) : state_->result;
  if (!result.atlas || face >= result.mid_feet.size() || result.mid_feet[face].empty()) return face;
  return static_cast<std::size_t>(result.atlas->face({result.mid_feet[face][k - of.uv.size()], {}}));
}
const std::vector<double>& Session::vertex_sizes() const { return (void)mesh(), state_->result.vertex_size; }
const CompositeReport& Session::report() const { return (void)mesh(), state_->result.report; }
const std::vector<Interface>& Session::interfaces() const { return (void)mesh(), state_->interfaces; }
const std::vector<WholeFace>& Session::whole_faces() const { return (void)mesh(), state_->whole_faces; }
const ModelSupports& Session::supports() const { return (void)mesh(), state_->meshed.supports; }

const std::vector<TriangleIntersection>& Session::crossings() const { return (void)mesh(), state_->result.crossings; }

bool Session::knows_crossings(std::size_t limit) const {
  const std::size_t known = crossings().size();
  const std::int64_t all = report().crossings;
  return all >= 0 && (known >= limit || known == static_cast<std::size_t>(all));
}

const QualitySummary& Session::shapes() const {
  State& s = *state_;
  if (!s.shapes) s.shapes = summarise_shapes(TriangleLists(mesh()), threads_of(s.parameters));
  return *s.shapes;
}

const QualitySummary& Session::quality() const {
  State& s = *state_;
  (void)mesh();
  if (!s.quality) {
    QualitySummary all = shapes();
    summarise_edges(TriangleLists(s.result.mesh), threads_of(s.parameters), all);
    s.quality = all;
  }
  return *s.quality;
}

void Session::make_mesh(double from, double to) {
  if (Team* const team = state_->team.get(); team != nullptr)
    team->run([&] { make_mesh_alone(from, to); });
  else
    make_mesh_alone(from, to);
}

void Session::make_mesh_alone(double from, double to) {
  State& s = *state_;
  s.tried_parameters = s.parameters;
  s.last_failed = true;
  if (!s.cad) throw InvalidArgument("no geometry is registered: register the callbacks first");
  if (s.model.faces.empty()) throw InvalidModel("the model has no face");
  Model known = s.model;
  for (;;) {
    PartMonitor run(s.monitor, from, to);
    try {
      make_mesh_of(known, run);
      return;
    } catch (const Error& error) {
      if (!leaves_out(s.parameters) || !leave_out(known, error)) throw;
      s.monitor.message(Level::warning, "meshing again without face " + std::to_string(error.where().face));
      // What was glued stays so.
      for (std::size_t f = 0; f < known.faces.size(); ++f) known.faces[f].curves = s.model.faces[f].curves;
      from = run.reached();
    }
  }
}

// Leaves out faces of `known` whose curves cannot be had, when that is wanted.
void Session::make_mesh_of(Model& known, Monitor& run) {
  State& s = *state_;
  CheckedCad whole_cad(*s.cad);
  run.progress(Phase::model, 0, 0);
  const bool measured = s.parameters.integer("measure") != 0;
  constexpr double share_of_mesh = 0.75;  // measuring asks the geometry about as often as meshing
  PartMonitor making(run, 0, measured ? share_of_mesh : 1), measuring(run, share_of_mesh, 1);
  if (has_discrete(known) && !s.triangles) throw InvalidModel("the model has faces given by triangles, and no triangles");
  if (is_discrete(known)) return make_discrete_mesh(known, whole_cad, making, measuring, run);
  leave_out_triangles(known);
  const double angle_smo = std::min(s.parameters.real("angle_smo"), s.parameters.real("angle_mesh"));
  auto [model, supports] = supports_of(known, whole_cad, angle_smo, s.parameters, s.monitor);
  if (!(supports.diag > 0))
    throw InvalidModel("the curves of the model have no extent in space: diag is " + format_number(supports.diag));
  if (has_discrete(known)) supports.diag = diagonal_with(supports, *s.triangles);
  set_parameter_boxes(model, supports, whole_cad);
  std::vector<std::string> remarks;
  s.glue_model(model, supports, whole_cad, remarks);
  PartCad cad(whole_cad, parts_of(model));
  const CurveTraces traces = traces_of(supports);
  if (const double eps = s.parameters.real("eps_collapse"); eps > 0)
    model = collapse_tiny_curves(model, traces, eps, &remarks);
  for (const std::string& remark : remarks) s.monitor.message(Level::warning, remark);
  CompositeOptions options = composite_options(s.parameters, supports.diag);
  const std::shared_ptr<BackgroundField> background = background_of_run(s.parameters, known.plane, s.background);
  options.team = s.team.get();
  options.size.sources = s.sources(background.get());
  for (PrescriptionSource* source : options.size.sources) source->begin_run(options.size.law);
  report_short_curves(model, supports, options.eps_ends, s.monitor);
  check_derivatives(model, supports, cad, options, leaves_out(s.parameters) ? &known : nullptr, s.monitor);
  Topology topology =
      build_topology(model, traces, std::max(supports.diag / 100, s.parameters.real("eps_glue", supports.diag)));

  PartMonitor patches(making, 0, has_discrete(known) ? share_of_patches : 1), triangles(making, share_of_patches, 1);
  CompositeResult result = mesh_composite(model, topology, supports, cad, options, patches);
  std::shared_ptr<const PartResults> parts;
  if (has_discrete(known)) {
    CompositeOptions options_here = options;
    options_here.measure_bounds = s.parameters.integer("measure_bounds") > 0;
    parts = mesh_beside(std::move(result), known, *s.triangles, whole_cad, std::move(options_here), triangles);
    result = beside_each_other(parts->patches, parts->triangles, largest_references(model));
  }
  if (result.mesh.triangle_count() == 0 && result.mesh.loose_edge_count() == 0) {
    const auto failed = std::find_if(result.mesh.faces.begin(), result.mesh.faces.end(),
                                     [](const FaceMesh& face) { return !face.why.empty(); });
    throw DomainError("no face could be meshed: " +
                      (failed != result.mesh.faces.end() ? failed->why : std::string("no reason is known")));
  }
  keep_result(std::move(model), std::move(supports), std::move(topology), std::move(options), std::move(result),
              std::move(parts), background, measuring);
  run.progress(Phase::idle, 0, 1);
}

// A surface given as triangles has no curves to be found, glued or cut first.
void Session::make_discrete_mesh(const Model& model, Cad& cad, Monitor& making, Monitor& measuring, Monitor& run) {
  State& s = *state_;
  const discrete::DiscreteCad& surface = *s.triangles;
  CompositeOptions options = composite_options(s.parameters, surface.discrete().mesh().diagonal());
  options.measure_bounds = s.parameters.integer("measure_bounds") > 0;
  const std::shared_ptr<BackgroundField> background = background_of_run(s.parameters, model.plane, s.background);
  options.team = s.team.get();
  options.size.sources = s.sources(background.get());
  for (PrescriptionSource* source : options.size.sources) source->begin_run(options.size.law);
  CompositeResult result = mesh_discrete(model, surface, cad, options, making);
  Topology topology;
  topology.curve_of.resize(model.faces.size());
  ModelSupports supports;
  supports.of_face.resize(model.faces.size());
  supports.diag = result.report.diag;
  keep_result(model, std::move(supports), std::move(topology), std::move(options), std::move(result), nullptr,
              background, measuring);
  run.progress(Phase::idle, 0, 1);
}

void Session::keep_result(Model model, ModelSupports supports, Topology topology, CompositeOptions options,
                          CompositeResult result, std::shared_ptr<const PartResults> parts,
                          const std::shared_ptr<BackgroundField>& background, Monitor& measuring) {
  State& s = *state_;
  const bool measured = s.parameters.integer("measure") != 0;
  if (s.team) require_same_mesh(*s.team, result.mesh);
  options.team = nullptr;  // the mesh outlives it
  std::vector<Interface> interfaces = list_interfaces(model, topology, result.gaps, s.glued);
  for (const PrescriptionSource* source : options.size.sources)
    for (const std::string& remark : source->remarks()) s.monitor.message(Level::warning, remark);
  const BackgroundReport background_report = background ? background->report() : BackgroundReport{};
  Meshed meshed{s.cad,
                s.triangles,
                s.metric_callbacks,
                s.prescription_source,
                background,
                std::move(model),
                std::move(supports),
                std::move(topology),
                std::move(options),
                s.parameters.integer("measure_distances") != 0};
  std::optional<MeshEvaluation> delivered;
  if (measured) delivered = measure(meshed, result, parts.get(), measuring);
  s.background_report = background_report;
  s.has_previous = s.has_mesh;
  s.previous = std::move(s.result.mesh);
  s.result = std::move(result);
  s.parts = std::move(parts);
  s.meshed = std::move(meshed);
  s.interfaces = std::move(interfaces);
  s.whole_faces = carreau::whole_faces(s.result.mesh);
  s.delivered = std::move(delivered);
  s.meshed_parameters = s.tried_parameters;
  s.has_mesh = true;
  s.last_failed = false;
  s.shapes.reset(), s.quality.reset();
  if (s.monitor.hears(Level::summary)) describe_result(s.result, shapes(), s.monitor);
  tell_interfaces(s.interfaces, s.monitor);
  if (s.delivered) describe_evaluation(s.result.mesh, *s.delivered, s.monitor);
}

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
  set_parameter_boxes(meshed.model, meshed.supports, cad);
  // Silently: who asks for pictures has not asked for a report.
  std::optional<MeshEvaluation> measured;
  const auto evaluation_here = [&]() -> const MeshEvaluation& {
    if (s.delivered) return *s.delivered;
    if (!measured) measured = measure(meshed, s.result, nullptr, s.monitor);
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
  // What stops a run only leaves something out here.
  std::optional<ModelSupports> supports;
  std::shared_ptr<BackgroundField> background;
  try {
    background = background_of_run(parameters, s.model.plane, s.background);
    supports = build_supports(s.model, cad, parameters.real("angle_smo"), threads_of(s.parameters), s.monitor);
    set_parameter_boxes(s.model, *supports, cad);
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

const MeshEvaluation& Session::delivered() {
  State& s = *state_;
  (void)mesh();
  if (!s.delivered) {
    s.delivered = measure(s.meshed, s.result, s.parts.get(), s.monitor);
    describe_evaluation(s.result.mesh, *s.delivered, s.monitor);
    s.monitor.progress(Phase::idle, 0, 1);
  }
  return *s.delivered;
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
  const std::map<int, int>& shown = shown_points();
  for (std::int32_t& ref : flat.vertex_refs)
    if (const auto found = shown.find(ref); found != shown.end()) ref = found->second;
  return flat;
}

const std::map<int, int>& Session::shown_points() const { return (void)mesh(), state_->meshed.model.shown_points; }

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
  write_mesh(exported_as(format), path, format, file_options());
}

std::string Session::encoded(MeshFormat format) { return mesh_bytes(exported_as(format), format, file_options()); }

FlatMesh Session::exported_as(MeshFormat format) {
  const MeshEvaluation* measures = nullptr;  // other formats have no place for them
  if (format == MeshFormat::vtu && (state_->delivered || state_->parameters.integer("measure") != 0))
    measures = &delivered();
  state_->monitor.progress(Phase::writing, 0, 1);
  return exported(measures, format == MeshFormat::vtu);
}

MeshFileOptions Session::file_options() const {
  return {.ascii_stl = true, .curve_groups = state_->parameters.integer("curve_groups") == 1};
}

}  // namespace carreau
