#include "session/options.h"

#include <algorithm>
#include <string>
#include <thread>

#include "support/error.h"

namespace carreau {

namespace {

GeometricCriterion criterion_of(const std::string& rule) {
  if (rule == "chord") return GeometricCriterion::chord;
  if (rule == "both") return GeometricCriterion::both;
  return rule == "radii" ? GeometricCriterion::radii : GeometricCriterion::angle;
}

NarrowFaces narrow_faces_of(const std::string& word) {
  return word == "collapse" ? NarrowFaces::collapse : word == "one_layer" ? NarrowFaces::one_layer : NarrowFaces::keep;
}

}  // namespace

bool leaves_out(const Parameters& parameters) { return parameters.text("failing_faces") == "leave_out"; }

int threads_of(const Parameters& parameters) {
  const int threads = parameters.integer("threads");
  return threads != 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

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
  size.geo_rule = criterion_of(parameters.text("geo_rule"));
  size.eps_chord = parameters.real("eps_chord", diag);
  size.geo_guarantee = parameters.integer("geo_guarantee") != 0;
  size.geo_anisotropic = parameters.integer("geo_metric") != 0;
  size.anisotropy_max = parameters.real("anisotropy_max");
  size.metric_combination = static_cast<MetricCombination>(parameters.integer("metric_combination"));
  options.angle_smo = std::min(parameters.real("angle_smo"), size.angle_mesh);  // RT-0232 sec. 3.3
  options.lss = parameters.real("LSS");
  options.gradation = parameters.real("gradation");
  options.edge_gradation = parameters.real("edge_gradation");
  options.stagger_strips = parameters.integer("stagger_strips") != 0;
  options.shape_trials = parameters.integer("shape_trials") != 0;
  options.proximity = parameters.integer("proximity");
  if (options.proximity > 0 && options.gradation == 0)
    throw InvalidArgument(
        "parameter proximity needs a gradation greater than 1 (1.3, say): sizes of narrow zones must "
        "grow into those around");
  options.eps_ends = parameters.real("eps_ends", diag);
  options.check_close_edges = parameters.integer("CheckCloseEdges");
  options.check_adjacent_edges = parameters.integer("CheckAdjacentEdges");
  options.check_well_defined = parameters.integer("CheckWellDefined");
  options.coef_rectangle = parameters.real("CoefRectangle");
  options.narrow_faces = narrow_faces_of(parameters.text("narrow_faces"));
  options.narrow_ratio = parameters.real("narrow_ratio");
  options.failing_faces_alone = leaves_out(parameters);
  options.frontal = parameters.integer("frontal") != 0;
  options.max_triangles = parameters.integer("max_triangles");
  options.threads = threads_of(parameters);
  return options;
}

}  // namespace carreau
