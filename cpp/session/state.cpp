// SPDX-License-Identifier: BSD-3-Clause
#include "session/state.h"

#include <algorithm>

#include "io/files.h"
#include "io/model/pardom.h"
#include "model/geometries.h"
#include "model/places.h"
#include "session/file_adaptation.h"
#include "session/left_out.h"
#include "size/uniform_parameters.h"

namespace carreau {

namespace {

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

void Session::State::update_cad() {
  cad = host;
  if (host && !embedded.empty()) cad = std::make_shared<EmbeddedCad>(host, embedded);
}

std::vector<PrescriptionSource*> Session::State::sources(BackgroundField* of_this_run) {
  const double parameter_size = parameters.real("parameter_size");
  uniform_parameters = parameter_size > 0 ? std::make_shared<UniformParameters>(parameter_size) : nullptr;
  std::vector<PrescriptionSource*> all;
  for (PrescriptionSource* source :
       {metric_callbacks.get(), prescription_source.get(), static_cast<PrescriptionSource*>(of_this_run),
        static_cast<PrescriptionSource*>(attractors.get()), uniform_parameters.get()})
    if (source != nullptr) all.push_back(source);
  if (!all.empty() && parameters.integer("hphy_flag") == 0)
    monitor.message(Level::warning, "hphy_flag = 0: the prescribed sizes and metrics are ignored");
  return all;
}

void Session::State::glue_model(Model& known, ModelSupports& supports, Cad& whole_cad,
                                std::vector<std::string>& remarks) {
  const Gluing options{.eps = parameters.real("eps_glue", supports.diag),
                       // Farther apart, curves of one reference are an error of the model (build_topology).
                       .eps_open = std::min(parameters.real("eps_glue_open"), supports.diag / 100),
                       .eps_face = parameters.real("eps_glue_face"),
                       .angle_smo = std::min(parameters.real("angle_smo"), parameters.real("angle_mesh"))};
  const std::vector<PointOnCurve> on_curves = put_points_on_curves(known, supports, whole_cad, options, monitor);
  GlueReport found;
  bool any = is_mixed(known) && !geometries_to_glue(known).empty();
  if (any) find_references_of_geometries(known, supports, whole_cad, options, remarks, found, monitor);
  if (const std::size_t forgotten = references_to_forget(known); forgotten > 0)
    monitor.message(Level::warning, "the first curve of the model has the reference 0" +
                                        of_line(first_curve(known)->line) +
                                        ": all references are found, and the references of " + std::to_string(forgotten) +
                                        (forgotten == 1 ? " other curve" : " other curves") + " are ignored");
  if (const bool all = needs_gluing(known); all || parameters.integer("glue_open") != 0) {
    GlueReport among_all;
    known = find_references(known, supports, whole_cad, options, remarks, among_all, monitor);
    found.pairs.insert(found.pairs.end(), among_all.pairs.begin(), among_all.pairs.end());
    found.open = among_all.open;
    any = true;
    name_points_on_curves(known, on_curves);
    if (all && model_from_file) check_model(known), write_glued(known, remarks);
  }
  if (!any) return;
  check_model(known);
  keep_glued(known, found);
}

void Session::State::keep_glued(const Model& part, const GlueReport& found) {
  Model whole = part;
  give_back(model, whole);
  for (std::size_t f = 0; f < whole.faces.size(); ++f) whole.faces[f].left_out = model.faces[f].left_out;
  model = std::move(whole);
  glued.pairs.insert(glued.pairs.end(), found.pairs.begin(), found.pairs.end());
  glued.open = found.open;
}

void Session::State::check_model(const Model& candidate) const {
  const std::vector<ModelDefect> defects = list_model_defects(candidate);
  if (defects.empty()) return;
  std::string sentence = defects.front().sentence;
  if (defects.size() > 1) sentence += " (and " + std::to_string(defects.size() - 1) + " more)";
  for (std::size_t i = 1; i < defects.size(); ++i) monitor.message(Level::error, defects[i].text());
  throw InvalidModel(defects.front().where, sentence);
}

std::shared_ptr<BackgroundField> background_of_run(const Parameters& parameters, bool one_plane,
                                                   const std::shared_ptr<BackgroundField>& set) {
  const std::string mesh = parameters.text("background_mesh"), sol = parameters.text("background_sol");
  if (mesh.empty() != sol.empty())
    throw InvalidArgument(std::string("background_mesh and background_sol name two files of one field, but only ") +
                          (mesh.empty() ? "background_sol" : "background_mesh") + " is set");
  return mesh.empty() ? set : read_background(mesh, sol, one_plane, parameters.integer("sol_field"));
}

}  // namespace carreau
