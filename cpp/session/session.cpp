// SPDX-License-Identifier: BSD-3-Clause
#include "session/session.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "cad/checked_cad.h"
#include "cad/part_cad.h"
#include "fields/part_monitor.h"
#include "geometry/discrete/discrete_cad.h"
#include "io/model/pardom.h"
#include "model/geometries.h"
#include "pipeline/faces/same_hosts.h"
#include "pipeline/parts/part_mesh.h"
#include "pipeline/parts/split_mesh.h"
#include "session/derivatives.h"
#include "session/file_adaptation.h"
#include "session/left_out.h"
#include "session/messages.h"
#include "session/options.h"
#include "session/state.h"
#include "support/format.h"
#include "support/infinity.h"
#include "surface/discrete/beside_patches.h"
#include "surface/discrete/discrete_run.h"

namespace carreau {

Session::Session(Monitor& monitor) : state_(std::make_unique<State>(monitor)) {}
Session::~Session() = default;

void Session::set_cad(std::shared_ptr<Cad> cad) {
  if (auto alone = std::dynamic_pointer_cast<const discrete::DiscreteCad>(cad)) state_->triangles = std::move(alone);
  state_->host = std::move(cad);
  state_->update_cad();
  state_->forget_trees();
}

void Session::set_triangles(std::shared_ptr<const discrete::DiscreteCad> triangles) {
  state_->triangles = std::move(triangles);
  state_->forget_trees();
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
void Session::add_attractor(const Attractor& attractor) {
  auto all = state_->attractors ? std::make_shared<Attractors>(*state_->attractors) : std::make_shared<Attractors>();
  all->add(attractor);
  state_->attractors = std::move(all);
}
void Session::clear_attractors() noexcept { state_->attractors = nullptr; }
void Session::add_layers(CurveLayers layers) {
  if (layers.curves.empty()) throw InvalidArgument("layers require a curve");
  if (!(layers.first > 0) || !std::isfinite(layers.first))
    throw InvalidArgument("the first height of layers must be positive and finite; it is " + format_number(layers.first));
  if (!(layers.ratio >= 1 && layers.ratio <= 10))
    throw InvalidArgument("the ratio of layers must be between 1 and 10; it is " + format_number(layers.ratio));
  if (layers.count < 1 || layers.count > 1000)
    throw InvalidArgument("the number of layers must be between 1 and 1000; it is " + std::to_string(layers.count));
  state_->layers.push_back(std::move(layers));
}
void Session::clear_layers() noexcept { state_->layers.clear(); }
const std::vector<LayerFigures>& Session::layer_figures() const noexcept { return state_->layer_figures; }
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
  state_->forget_trees();
  state_->glued = {};
  state_->model_from_file = state_->model_from_env = false;
}

void Session::load_pardom(const std::string& path) {
  int line_of_rest = 0;
  Model model = read_pardom(path, &line_of_rest);
  if (line_of_rest != 0)
    state_->monitor.message(Level::warning, path + ", line " + std::to_string(line_of_rest) +
                                                ": the text after the last surface is ignored (ns is " +
                                                std::to_string(model.faces.size()) + ")");
  state_->embedded.clear(), state_->update_cad();
  set_model(std::move(model));
  state_->model_from_file = true;
}

void Session::load_pardom_of_env(const std::string& path) {
  load_pardom(path);
  state_->model_from_env = true;
}

void Session::clear_model() noexcept {
  state_->model = {};
  state_->embedded.clear(), state_->cad = state_->host;
  state_->forget_trees();
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

void Session::together(const std::function<void(const Executor&)>& body) const {
  State& s = *state_;
  const Executor executor{s.team.get(), threads_of(s.parameters)};
  if (executor.team == nullptr || s.is_together) return body(executor);
  s.is_together = true;
  try {
    executor.team->run([&] { body(executor); });
  } catch (...) {
    s.is_together = false;
    throw;
  }
  s.is_together = false;
}

void Session::make_mesh(double from, double to) {
  together([&](const Executor&) { make_mesh_alone(from, to, nullptr); });
}

PartMesh Session::make_part() {
  if (!state_->team) throw InvalidArgument("meshes in parts require a team of processes: the session has no team");
  PartMesh part;
  together([&](const Executor&) { make_mesh_alone(0, 1, &part); });
  return part;
}

// `part`: receives the part of this process; null: makes the mesh of the session.
void Session::make_mesh_alone(double from, double to, PartMesh* part) {
  State& s = *state_;
  s.forget_trees();  // the model may be glued, and the host's data may have changed
  if (part == nullptr) s.tried_parameters = s.parameters, s.last_failed = true;
  if (!s.cad) throw InvalidArgument("no geometry is registered: register the callbacks first");
  if (s.model.faces.empty()) throw InvalidModel("the model has no face");
  Model known = s.model;
  for (;;) {
    PartMonitor run(s.monitor, from, to);
    try {
      make_mesh_of(known, run, part);
      return;
    } catch (const Error& error) {
      if (!leaves_out(s.parameters) || !leave_out(known, error)) throw;
      s.monitor.message(Level::warning, "meshing again without face " + std::to_string(error.where().face));
      // Glued curves stay glued.
      for (std::size_t f = 0; f < known.faces.size(); ++f) known.faces[f].curves = s.model.faces[f].curves;
      from = run.reached();
    }
  }
}

GluedModel Session::glue(Model& known, Cad& whole_cad) {
  State& s = *state_;
  leave_out_triangles(known);
  const double angle_smo = std::min(s.parameters.real("angle_smo"), s.parameters.real("angle_mesh"));
  auto [model, supports] = supports_of(known, whole_cad, angle_smo, s.parameters, s.monitor);
  if (!(supports.diag > 0))
    throw InvalidModel("the curves of the model have no extent in space: diag is " + format_number(supports.diag));
  if (has_discrete(known)) supports.diag = diagonal_with(supports, *s.triangles);
  set_parameter_domains(model, supports, whole_cad);
  std::vector<std::string> remarks;
  s.glue_model(model, supports, whole_cad, remarks);
  return {std::move(model), std::move(supports), std::move(remarks)};
}

void Session::find_model_references() {
  State& s = *state_;
  CheckedCad whole_cad(*s.cad);
  Model known = s.model;
  const GluedModel glued = glue(known, whole_cad);
  for (const std::string& remark : glued.remarks) s.monitor.message(Level::warning, remark);
  s.forget_trees();
}

PreparedModel Session::prepare(Model& known, Cad& whole_cad) {
  State& s = *state_;
  auto [model, supports, remarks] = glue(known, whole_cad);
  PartCad cad(whole_cad, parts_of(model));
  const CurveTraces traces = traces_of(supports);
  if (const double eps = s.parameters.real("eps_collapse"); eps > 0)
    model = collapse_tiny_curves(model, traces, eps, &remarks);
  for (const std::string& remark : remarks) s.monitor.message(Level::warning, remark);
  CompositeOptions options = composite_options(s.parameters, supports.diag);
  const std::shared_ptr<BackgroundField> background = background_of_run(s.parameters, known.plane, s.background);
  options.executor.team = s.team.get();
  options.size.sources = s.sources(background.get());
  for (PrescriptionSource* source : options.size.sources) source->begin_run(options.size.law);
  report_short_curves(model, supports, options.eps_ends, s.monitor);
  check_derivatives(model, supports, cad, options, leaves_out(s.parameters) ? &known : nullptr, s.monitor);
  std::vector<std::string> wide_gaps;
  // RT-0232 sec. 3.2 has no limit for the references of a file; a tolerance that is set is one.
  const bool limited = !s.model_from_file || s.parameters.is_set("eps_match") || s.parameters.is_set("eps_glue");
  Topology topology =
      build_topology(model, traces, std::max(supports.diag / 100, s.parameters.real("eps_glue", supports.diag)),
                     limited ? s.parameters.real("eps_match") : infinity, &wide_gaps);
  for (const std::string& gap : wide_gaps) s.monitor.message(Level::warning, gap);
  return {std::move(model), std::move(supports), std::move(topology), std::move(options), background};
}

// If required, leaves out faces of `known` whose curves cannot be made.
void Session::make_mesh_of(Model& known, Monitor& run, PartMesh* part) {
  State& s = *state_;
  CheckedCad whole_cad(*s.cad);
  run.progress(Phase::model, 0, 0);
  const bool measured = s.parameters.integer("measure") != 0;
  constexpr double share_of_mesh = 0.75;  // measuring evaluates the geometry about as often as meshing
  PartMonitor making(run, 0, measured ? share_of_mesh : 1), measuring(run, share_of_mesh, 1);
  if (has_discrete(known) && !s.triangles)
    throw InvalidModel("the model has faces given by triangles, and no triangles");
  if (has_discrete(known) && !is_discrete(known) && !known.periodicities.empty())
    throw InvalidModel("faces given by triangles cannot be periodic beside faces with curves");
  if (is_discrete(known)) {
    make_discrete_mesh(known, whole_cad, making, measuring, run);
    if (part != nullptr) *part = part_of_mesh();
    return;
  }
  PreparedModel prepared = prepare(known, whole_cad);
  auto& [model, supports, topology, options, background] = prepared;
  PartCad cad(whole_cad, parts_of(model));
  options.parts = part != nullptr && !has_discrete(known) && !measured;
  PartMonitor patches(making, 0, has_discrete(known) ? share_of_patches : 1), triangles(making, share_of_patches, 1);
  MeshLayers layers{s.layers};
  CompositeResult result = mesh_composite(model, topology, supports, cad, options, patches, &layers);
  std::vector<LayerFigures> figures = measure_layers(result.mesh, layers.cells, layers.given.size());
  const std::vector<BareEdges> edges = find_bare_edges(result.mesh, layers.cells, layers.given);
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (edges[i].bare > 0) figures[i].fewest_rows = 0;
  std::shared_ptr<const PartResults> parts;
  if (has_discrete(known)) {
    CompositeOptions options_here = options;
    options_here.measure_bounds = s.parameters.integer("measure_bounds") > 0;
    parts = mesh_beside(std::move(result), known, *s.triangles, whole_cad, std::move(options_here), triangles);
    result = beside_each_other(parts->patches, parts->triangles, largest_references(model));
  }
  const bool any_triangle = result.shares ? result.shares->triangles > 0 : result.mesh.triangle_count() > 0;
  if (!any_triangle && result.mesh.loose_edge_count() == 0) {
    const auto failed = std::find_if(result.mesh.faces.begin(), result.mesh.faces.end(),
                                     [](const FaceMesh& face) { return !face.why.empty(); });
    throw DomainError("no face could be meshed: " + (failed != result.mesh.faces.end() ? reason_of(failed->ref, failed->why)
                                                                                       : std::string("no reason is known")));
  }
  if (result.shares) {
    *part = part_of(model, std::move(result));
  } else {
    if (part != nullptr) s.tried_parameters = s.parameters;
    keep_result(std::move(model), std::move(supports), std::move(topology), std::move(options), std::move(result),
                std::move(parts), background, measuring);
    s.layer_figures = std::move(figures);
    describe_layers(s.layer_figures, s.layers, s.monitor);
    describe_bare_edges(edges, s.monitor);
    if (part != nullptr) *part = part_of_mesh();
  }
  run.progress(Phase::idle, 0, 1);
}

PartMesh Session::part_of(const Model& model, CompositeResult result) {
  State& s = *state_;
  const CompositeReport report = result.report;
  PartMesh part = carreau::make_part(*s.team, std::move(result), s.parameters.integer("flag") == 1, threads_of(s.parameters));
  if (model.plane) part.mesh.dimension = 2;
  show_points(model, part.mesh.vertex_refs);
  describe_part(part, report, s.monitor);
  return part;
}

// An option needed the whole mesh: each process has it, and takes its share.
PartMesh Session::part_of_mesh() {
  State& s = *state_;
  const int rank = s.team->rank(), processes = s.team->size();
  const auto flat = [&](bool with_edges) {
    FlatMesh mesh = flatten(s.result.mesh, with_edges);
    if (s.meshed.model.plane) mesh.dimension = 2;
    show_points(s.meshed.model, mesh.vertex_refs);
    return mesh;
  };
  FlatMesh whole = flat(true);
  PartMesh part = split_mesh(whole, rank, processes);
  part.loose_edges = static_cast<std::int64_t>(s.result.mesh.loose_edge_count());
  part.faces = s.whole_faces;
  part.quality = quality();
  part.crossings = s.result.report.crossings;
  if (s.parameters.integer("flag") != 1) whole = flat(false);
  if (whole.cells.empty()) {
    part.file_edges = std::ssize(whole.edges);
    if (rank == 0) part.file_edge_vertices = std::move(whole.edges), part.file_edge_refs = std::move(whole.edge_refs);
  } else {
    const std::string bytes = mesh_bytes(whole, MeshFormat::meshb);
    const auto before = [&](int r) { return bytes.size() * static_cast<std::size_t>(r) / static_cast<std::size_t>(processes); };
    part.begin_in_file = before(rank);
    part.bytes_of_file = bytes.substr(before(rank), before(rank + 1) - before(rank));
  }
  return part;
}

// A surface given as triangles has no curves to be found, glued or cut first.
void Session::make_discrete_mesh(const Model& model, Cad& cad, Monitor& making, Monitor& measuring, Monitor& run) {
  State& s = *state_;
  const discrete::DiscreteCad& surface = *s.triangles;
  CompositeOptions options = composite_options(s.parameters, surface.discrete().mesh().diagonal());
  options.measure_bounds = s.parameters.integer("measure_bounds") > 0;
  const std::shared_ptr<BackgroundField> background = background_of_run(s.parameters, model.plane, s.background);
  options.executor.team = s.team.get();
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
  report_flat_triangles(result.mesh, options.executor.threads, s.monitor);
  if (s.team) require_same_mesh(*s.team, result.mesh);
  options.executor.team = nullptr;  // the mesh outlives it
  std::vector<Interface> interfaces = list_interfaces(model, topology, result.gaps, s.glued);
  for (const PrescriptionSource* source : options.size.sources)
    for (const std::string& remark : source->remarks()) s.monitor.message(Level::warning, remark);
  const BackgroundReport background_report = background ? background->report() : BackgroundReport{};
  Meshed meshed{s.cad,
                s.triangles,
                s.metric_callbacks,
                s.prescription_source,
                s.uniform_parameters,
                background,
                std::move(model),
                std::move(supports),
                std::move(topology),
                std::move(options),
                s.parameters.integer("measure_distances") != 0};
  std::optional<MeshEvaluation> delivered;
  if (measured) delivered = evaluate_meshed(meshed, result, parts.get(), measuring);
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
  s.shapes.reset(), s.quality.reset(), s.raised.reset();
  s.layer_figures.clear();
  if (s.monitor.hears(Level::summary)) describe_result(s.result, shapes(), s.monitor);
  tell_interfaces(s.interfaces, s.monitor);
  if (s.delivered) describe_evaluation(s.result.mesh, *s.delivered, s.monitor);
}

std::shared_ptr<const KeptMesh> Session::kept_mesh() const {
  const State& s = *state_;
  (void)mesh();
  return std::make_shared<const KeptMesh>(KeptMesh{s.result, s.parts, s.meshed, s.previous, s.has_previous, s.meshed_parameters,
                                                   s.background_report, s.layer_figures, s.delivered, s.interfaces, s.whole_faces});
}

void Session::restore(const KeptMesh& kept) {
  State& s = *state_;
  s.result = kept.result, s.parts = kept.parts, s.meshed = kept.meshed;
  s.previous = kept.previous, s.has_previous = kept.has_previous, s.has_mesh = true;
  s.meshed_parameters = s.tried_parameters = kept.parameters;
  s.last_failed = false;
  s.background_report = kept.background_report, s.layer_figures = kept.layer_figures, s.delivered = kept.delivered;
  s.interfaces = kept.interfaces, s.whole_faces = kept.whole_faces;
  s.shapes.reset(), s.quality.reset(), s.raised.reset();
  s.forget_trees();
}

const MeshEvaluation& Session::delivered() {
  State& s = *state_;
  (void)mesh();
  if (!s.delivered) {
    s.delivered = evaluate_meshed(s.meshed, s.result, s.parts.get(), s.monitor);
    describe_evaluation(s.result.mesh, *s.delivered, s.monitor);
    s.monitor.progress(Phase::idle, 0, 1);
  }
  return *s.delivered;
}

}  // namespace carreau
