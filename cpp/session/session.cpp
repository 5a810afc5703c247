#include "session/session.h"

#include <algorithm>

#include "cad/checked_cad.h"
#include "io/files.h"
#include "io/mesh_files.h"
#include "io/pardom.h"
#include "session/derivatives.h"
#include "session/export.h"
#include "support/format.h"

namespace carreau {

struct Session::State {
  explicit State(Monitor& m) : monitor(m) {}

  Monitor& monitor;
  std::shared_ptr<Cad> cad;
  Model model;
  bool model_from_file = false;
  Parameters parameters;
  CompositeResult result;
  Model meshed_model;  // what `result` is a mesh of
  ModelSupports supports;
  bool has_mesh = false;

  void check_model(const Model& candidate) const {
    const std::vector<std::string> defects = find_model_defects(candidate);
    if (defects.empty()) return;
    std::string text = defects.front();
    if (defects.size() > 1) text += " (and " + std::to_string(defects.size() - 1) + " more)";
    for (std::size_t i = 1; i < defects.size(); ++i) monitor.message(Level::error, defects[i]);
    throw InvalidModel(text);
  }
};

namespace {

CompositeOptions composite_options(const Parameters& parameters, double diag) {
  CompositeOptions options;
  SizeParameters& size = options.size;
  size.hphy_flag = parameters.integer("hphy_flag");
  size.hgeo_flag = parameters.integer("hgeo_flag");
  size.hphydef = parameters.real("hphydef", diag);
  size.hphymin = parameters.real("hphymin", diag);
  size.hphymax = parameters.real("hphymax", diag);
  size.hgeomin = parameters.real("hgeomin", diag);
  size.hgeomax = parameters.real("hgeomax", diag);
  size.hmean_flag = parameters.integer("hmean_flag");
  size.hinterpol_flag = parameters.integer("hinterpol_flag");
  size.angle_mesh = parameters.real("angle_mesh");
  options.angle_smo = std::min(parameters.real("angle_smo"), size.angle_mesh);  // RT-0232 sec. 3.3
  options.lss = parameters.real("LSS");
  options.eps_ends = parameters.real("eps_ends", diag);
  options.check_close_edges = parameters.integer("CheckCloseEdges");
  options.check_adjacent_edges = parameters.integer("CheckAdjacentEdges");
  options.check_well_defined = parameters.integer("CheckWellDefined");
  options.coef_rectangle = parameters.real("CoefRectangle");
  options.frontal = parameters.integer("frontal") != 0;
  options.max_triangles = parameters.integer("max_triangles");
  return options;
}

// A message for each curve whose ends are nearer than eps_ends, which is sometimes an error (RT-0232 sec. 3.3).
void report_short_curves(const Model& model, const ModelSupports& supports, double eps_ends, Monitor& monitor) {
  for (std::size_t f = 0; f < model.faces.size(); ++f)
    for (std::size_t c = 0; c < model.faces[f].curves.size(); ++c) {
      const CurveSupport& support = supports.of_face[f][c];
      const double gap = norm(support.xyz.back() - support.xyz.front());
      if (gap >= eps_ends) continue;
      const Where where{
          .face = model.faces[f].ref, .curve_index = static_cast<int>(c) + 1, .curve = model.faces[f].curves[c].ref};
      monitor.message(Level::warning, where.prefix() + "its ends are " + format_number(gap) +
                                          " apart, less than eps_ends = " + format_number(eps_ends) +
                                          (support.length() < eps_ends ? "; the whole curve is that small"
                                                                       : "; the curve is closed or nearly so"));
    }
}

}  // namespace

Session::Session(Monitor& monitor) : state_(std::make_unique<State>(monitor)) {}
Session::~Session() = default;

void Session::set_cad(std::shared_ptr<Cad> cad) { state_->cad = std::move(cad); }

bool Session::has_model_from_host() const noexcept { return !state_->model.faces.empty() && !state_->model_from_file; }

void Session::set_model(Model model) {
  if (!needs_gluing(model)) state_->check_model(model);
  state_->model = std::move(model);
  state_->model_from_file = false;
}

void Session::load_pardom(const std::string& path) {
  Model model = read_pardom(path);
  set_model(std::move(model));
  state_->model_from_file = true;
}

const Model& Session::model() const noexcept { return state_->model; }
Parameters& Session::parameters() noexcept { return state_->parameters; }
bool Session::has_mesh() const noexcept { return state_->has_mesh; }

const SurfaceMesh& Session::mesh() const {
  if (!state_->has_mesh) throw InvalidArgument("there is no mesh yet: make one first");
  return state_->result.mesh;
}
const std::vector<double>& Session::vertex_sizes() const { return (void)mesh(), state_->result.vertex_size; }
const CompositeReport& Session::report() const { return (void)mesh(), state_->result.report; }
const ModelSupports& Session::supports() const { return (void)mesh(), state_->supports; }

void Session::make_mesh() {
  State& s = *state_;
  if (!s.cad) throw InvalidArgument("no geometry is registered: register the callbacks first");
  if (s.model.faces.empty()) throw InvalidModel("the model has no face");
  CheckedCad cad(*s.cad);
  s.monitor.progress(Phase::model, 0, 0);
  const double angle_smo = std::min(s.parameters.real("angle_smo"), s.parameters.real("angle_mesh"));
  ModelSupports supports = build_supports(s.model, cad, angle_smo, s.monitor);
  if (!(supports.diag > 0))
    throw InvalidModel("the curves of the model have no extent in space: diag is " + format_number(supports.diag));
  const CurveTraces traces = traces_of(supports);
  Model model = s.model;
  std::vector<std::string> remarks;
  if (needs_gluing(model)) {
    const double eps_glue = s.parameters.real("eps_glue", supports.diag);
    model = glue(model, traces, eps_glue, &remarks);
    s.check_model(model);
    if (s.model_from_file) write_file(model.source + ".new", pardom_text(model));
    s.model = model;
  }
  if (const double eps = s.parameters.real("eps_collapse"); eps > 0)
    model = collapse_tiny_curves(model, traces, eps, &remarks);
  for (const std::string& remark : remarks) s.monitor.message(Level::warning, remark);
  const CompositeOptions options = composite_options(s.parameters, supports.diag);
  report_short_curves(model, supports, options.eps_ends, s.monitor);
  check_derivatives(model, supports, cad, options, s.monitor);
  const Topology topology = build_topology(model, traces, supports.diag / 100);

  CompositeResult result = mesh_composite(model, topology, supports, cad, options, s.monitor);
  if (result.mesh.triangle_count() == 0) {
    const auto failed = std::find_if(result.mesh.faces.begin(), result.mesh.faces.end(),
                                     [](const FaceMesh& face) { return !face.why.empty(); });
    throw DomainError("no face could be meshed: " +
                      (failed != result.mesh.faces.end() ? failed->why : std::string("no reason is known")));
  }
  s.result = std::move(result);
  s.supports = std::move(supports);
  s.meshed_model = std::move(model);
  s.has_mesh = true;
  s.monitor.progress(Phase::idle, 0, 1);
}

FlatMesh Session::exported() const {
  const ExportSource source{mesh(), state_->result.vertex_size, state_->meshed_model, state_->supports};
  const Parameters& p = state_->parameters;
  return export_mesh(source, p.text("option"), p.integer("refs"), p.integer("flag") == 1);
}

void Session::write(const std::string& path) const {
  const MeshFormat format = mesh_format_of(path);
  state_->monitor.progress(Phase::writing, 0, 1);
  write_mesh(exported(), path, format);
}

}  // namespace carreau
