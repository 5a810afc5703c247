// SPDX-License-Identifier: BSD-3-Clause
#include "session/options.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <thread>

#include "support/error.h"

namespace carreau {

namespace {

// The integer codes of RT-0232 sec. 3.3; the table of parameters has rejected others.
PhysicalSizes physical_sizes_of(int hphy_flag) {
  return hphy_flag == 0 ? PhysicalSizes::ignored : hphy_flag == 1 ? PhysicalSizes::uniform : PhysicalSizes::asked;
}
GeometricSizes geometric_sizes_of(int hgeo_flag) {
  return hgeo_flag == 0 ? GeometricSizes::ignored : hgeo_flag == 1 ? GeometricSizes::curvature : GeometricSizes::radii;
}
SizeMean mean_of(int hmean_flag) {
  return hmean_flag == -1 ? SizeMean::minimum : hmean_flag == 1 ? SizeMean::geometric : SizeMean::arithmetic;
}
SizeLaw law_of(int hinterpol_flag) {
  return hinterpol_flag == 0 ? SizeLaw::linear : hinterpol_flag == 1 ? SizeLaw::geometric : SizeLaw::sinusoidal;
}

GeometricCriterion criterion_of(const std::string& rule) {
  if (rule == "chord") return GeometricCriterion::chord;
  if (rule == "both") return GeometricCriterion::both;
  return rule == "radii" ? GeometricCriterion::radii : GeometricCriterion::angle;
}

NarrowFaces narrow_faces_of(const std::string& word) {
  return word == "collapse" ? NarrowFaces::collapse : word == "one_layer" ? NarrowFaces::one_layer : NarrowFaces::keep;
}

Element element_of(const std::string& word) {
  constexpr std::array<std::string_view, 6> words{"p1", "p2", "q1.0", "q1.1", "q2.0", "q2.1"};
  return static_cast<Element>(std::find(words.begin(), words.end(), word) - words.begin());
}

}  // namespace

bool leaves_out(const Parameters& parameters) { return parameters.text("failing_faces") == "leave_out"; }

int threads_of(const Parameters& parameters) {
  const int threads = parameters.integer("threads");
  return threads != 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

CompositeOptions composite_options(const Parameters& parameters, double diag) {
  CompositeOptions options;
  options.element = element_of(parameters.text("element"));
  SizeParameters& size = options.size;
  size.physical = physical_sizes_of(parameters.integer("hphy_flag"));
  size.geometric = geometric_sizes_of(parameters.integer("hgeo_flag"));
  size.hphydef = parameters.real("hphydef", diag);
  size.hphymin = parameters.real("hphymin", diag);
  size.hphymax = parameters.real("hphymax", diag);
  size.hgeomin = parameters.real("hgeomin", diag);
  size.hgeomax = parameters.real("hgeomax", diag);
  size.mean = mean_of(parameters.integer("hmean_flag"));
  size.law = law_of(parameters.integer("hinterpol_flag"));
  size.angle_mesh = parameters.real("angle_mesh");
  size.geo_rule = criterion_of(parameters.text("geo_rule"));
  size.eps_chord = parameters.real("eps_chord", diag);
  size.geo_guarantee = parameters.integer("geo_guarantee") != 0;
  size.guarantee_triangles = parameters.integer("geo_guarantee") == 2;
  size.geo_anisotropic = parameters.integer("geo_metric") != 0;
  size.anisotropy_max = parameters.real("anisotropy_max");
  size.metric_combination =
      parameters.integer("metric_combination") == 0 ? MetricCombination::scale : MetricCombination::intersection;
  options.angle_smo = std::min(parameters.real("angle_smo"), size.angle_mesh);  // RT-0232 sec. 3.3
  options.lss = parameters.real("LSS");
  options.gradation = parameters.real("gradation");
  options.edge_gradation = parameters.real("edge_gradation");
  options.cracks = parameters.integer("cracks") != 0;
  options.stagger_strips = parameters.integer("stagger_strips") != 0;
  options.shape_trials = parameters.integer("shape_trials") != 0;
  options.proximity = parameters.integer("proximity");
  if (options.proximity > 0 && options.gradation == 0)
    throw InvalidArgument(
        "parameter proximity needs a gradation greater than 1 (such as 1.3): sizes of narrow zones must "
        "grow into those around");
  options.eps_ends = parameters.real("eps_ends", diag);
  options.check_close_edges = parameters.integer("CheckCloseEdges");
  options.check_adjacent_edges = parameters.integer("CheckAdjacentEdges");
  options.adjacent_ratio = parameters.real("adjacent_ratio");
  options.check_well_defined = parameters.integer("CheckWellDefined");
  options.coef_rectangle = parameters.real("CoefRectangle");
  options.narrow_faces = narrow_faces_of(parameters.text("narrow_faces"));
  options.narrow_ratio = parameters.real("narrow_ratio");
  options.failing_faces_alone = leaves_out(parameters);
  options.crossing_rounds = parameters.integer("crossing_rounds");
  const int effort = parameters.integer("effort");
  if (effort == more_effort) options.rounds_over_first_mesh = 2;
  options.refines_invalid_elements = effort != no_effort;
  options.frontal = parameters.integer("frontal") != 0;
  options.independent = parameters.text("patches") == "independent";
  options.measure_bounds = parameters.integer("measure_bounds") > (options.independent ? 0 : 1);
  options.certified = static_cast<Certified>(parameters.integer("certify"));
  options.sharp_angle = parameters.real("sharp_angle");
  options.max_triangles = parameters.integer("max_triangles");
  options.executor.threads = threads_of(parameters);
  return options;
}

}  // namespace carreau
