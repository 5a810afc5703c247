// SPDX-License-Identifier: BSD-3-Clause
// Options that several commands have.
#include "cli/option_groups.h"

#include <iterator>

#include "inputs/built/atlas_input.h"
#include "inputs/built/formula_input.h"
#include "inputs/built/grid_input.h"
#include "inputs/built/molecule_input.h"

namespace command {

namespace {

std::string is_gradation(const std::string& value) {
  double ratio = -1;
  const bool known = CLI::detail::lexical_cast(value, ratio) && (ratio == 0 || (ratio >= 1.0001 && ratio <= 1e9));
  return known ? "" : "'" + value + "' is neither a ratio from 1.0001 to 1e9 nor 0";
}
std::vector<std::string> surface_names() {
  std::vector<std::string> names(std::begin(molecule_surfaces), std::end(molecule_surfaces));
  names.emplace_back(atlas_surface);
  return names;
}

}  // namespace

std::string not_empty(const std::string& value) { return value.empty() ? "nothing is given" : ""; }

CLI::Option* repeated(CLI::Option* option) { return option->allow_extra_args(false); }

CLI::Option* threads(CLI::App* app, int& value) {
  return app->add_option("--threads", value, "Threads at work, 0: all cores; results do not depend on it")
      ->check(CLI::Range(0, 1024))
      ->type_name(kind::number)
      ->capture_default_str();
}

void add_parts_option(CLI::App* app, MeshOptions& options) {
  app->add_flag("--parts", options.parts,
                "Under mpirun: each process keeps its part, and none holds the whole mesh; writes .meshb and .pvtu");
}

void add_mesh_options(CLI::App* app, MeshOptions& options) {
  app->add_option("--size", options.size,
                  "Length of edges, or a share of the model's diagonal such as 1%; 2% when nothing else says a size")
      ->check(not_empty)
      ->type_name(kind::length);
  app->add_option("--size-map", options.size_map,
                  "Sizes by a formula in x, y, z, u, v, or by a background mesh: file .mesh(b) with a .sol(b) beside")
      ->check(not_empty)
      ->type_name(kind::file);
  app->add_option("--sol-field", options.plane.field,
                  "Field of a .sol(b) with several, from 1; 0: all that adapt estimates, else the only one")
      ->check(CLI::Range(0, 64))
      ->type_name(kind::number);
  app->add_option("--angle", options.angle, "Degrees between the mesh and its surfaces: sizes follow the curvature")
      ->check(CLI::Range(0.01, 89.0))
      ->type_name(kind::number);
  app->add_option("--chord", options.chord, "Distance between the mesh and its surfaces: sizes follow the curvature")
      ->check(not_empty)
      ->type_name(kind::length);
  app->add_option("--gradation", options.gradation,
                  "Sizes grow by at most this ratio from one edge to the next; 0: by any. 1.3 with --anisotropic")
      ->check(is_gradation)
      ->type_name("RATIO");
  app->add_flag("--anisotropic{1000}", options.anisotropy,
                "Sizes that follow the curvature differ by direction; --anisotropic=RATIO bounds them; implies "
                "--gradation 1.3")
      ->check(CLI::Range(1.0, 1e9));
  app->add_option("--element", options.element,
                  "Elements: p1, p2 (curved), q1.0, q1.1 (quadrilaterals, .1 without triangles), q2.0, q2.1 (curved)")
      ->check(CLI::IsMember({"p1", "p2", "q1.0", "q1.1", "q2.0", "q2.1"}))
      ->type_name("ELEMENT");
  CLI::Option* independent = app->add_flag("--independent", options.independent,
                                           "Borders between faces that are not sharp mean nothing: triangles cross them");
  app->add_option("--sharp-angle", options.sharp_angle,
                  "With --independent: degrees between faces beyond which their border is sharp; 1 when not given")
      ->check(CLI::Range(0.0, 180.0))
      ->needs(independent)
      ->type_name("DEGREES");
  app->add_option("--min", options.minimum, "Smallest size")->check(not_empty)->type_name(kind::length);
  app->add_option("--max", options.maximum, "Largest size")->check(not_empty)->type_name(kind::length);
  repeated(app->add_option("--face-size", options.face_sizes,
                           "Size on a face given by number, or on all faces of a name; may be repeated"))
      ->type_name("FACE=LENGTH");
  repeated(app->add_option("--curve-edges", options.curve_edges,
                           "Number of edges of a curve, equally long or in a progression of their lengths (8, "
                           "8,arithmetic:3 or 8,geometric:1.2); may be repeated"))
      ->type_name("CURVE=EDGES");
  repeated(app->add_option("--curve-vertices", options.curve_vertices,
                           "All vertices inside a curve, by their parameters; may be repeated"))
      ->type_name("CURVE=T,...");
  app->add_option("--env", options.env, "Parameters from a blsurf.env, up to its first action; options win")
      ->check(not_empty)
      ->type_name(kind::file);
  repeated(app->add_option("--set", options.settings, "Any parameter that `carreau params` lists; may be repeated"))
      ->type_name(kind::setting);
  threads(app, options.threads);
}

void radii(CLI::App* app, std::string& path) {
  app->add_option("--radii", path, "Take radii of elements from lines \"symbol radius\" of this file")
      ->check(CLI::ExistingFile)
      ->type_name(kind::file);
}

void add_molecule_options(CLI::App* app, MoleculeChoice& choice) {
  app->add_option("--surface", choice.surface,
                  "Of a molecule: vws, the van der Waals surface; sas, the surface accessible to a solvent; ses, excluding it. Of "
                  "closed triangles: atlas, a smooth surface over them")
      ->check(CLI::IsMember(surface_names()))
      ->capture_default_str();
  app->add_option("--probe", choice.probe, "Radius of the probe that stands for the solvent")
      ->check(CLI::Range(0.0, 1e9))
      ->type_name(kind::length)
      ->capture_default_str();
  radii(app, choice.radii);
  app->add_flag("--drop-cavities", choice.drop_cavities, "Leave out inner shells of a molecule");
}

void add_grid_options(CLI::App* app, GridChoice& choice) {
  app->add_option("--grid", choice.format, "Read a structured grid in this format, whatever the suffix")
      ->check(CLI::IsMember(std::vector<std::string>(std::begin(grid_formats), std::end(grid_formats))));
  app->add_option("--smooth", choice.smoothing,
                  "Smooth a grid without shrinking: rounds, or rounds,w1,w2 (Taubin's weights, .06 and .061)")
      ->check(smoothing_defect)
      ->type_name(kind::rounds);
  app->add_flag("--lengths", choice.lengths, "Make lengths of edges the parameters of a grid: for abrupt steps");
  app->add_option("--join", choice.join_angle,
                  "Give blocks of a grid one tangent plane where their normals differ by less than this")
      ->check(CLI::Range(0.0, 180.0))
      ->type_name(kind::number);
  app->add_flag("--fill", choice.fill, "Fill holes of a grid that none of its sides touches");
  app->add_option("--step", choice.step, "Step of heights and scans whose file does not tell it")
      ->check(CLI::Range(0.0, 1e9))
      ->type_name(kind::length);
  app->add_option("--join-nodes", choice.tolerance, "Nodes on borders of grids are one when they are nearer than this")
      ->check(CLI::Range(0.0, 1e9))
      ->type_name(kind::length);
}

void add_domain_option(CLI::App* app, std::string& domain) {
  app->add_option("--domain", domain,
                  "Of a surface by formulas: box:x0,y0,x1,y1, disc:x,y,radius or ring:x,y,inner,outer; box:-1,-1,1,1 when "
                  "not given")
      ->check(domain_defect)
      ->type_name("DOMAIN");
}

void add_cad_options(CLI::App* app, InputChoice& choice) {
  app->add_flag("--loose-edges", choice.loose_edges, "Of CAD files: edges of no face are meshed, too");
}

void add_triangles_options(CLI::App* app, TrianglesChoice& choice) {
  app->add_option("--sharp", choice.sharp,
                  "Of triangles: degrees between two of them beyond which their edge is one of a sharp line; found when not given")
      ->check(CLI::Range(0.1, 180.0))
      ->type_name(kind::number);
  app->add_option("--corner", choice.corner,
                  "Of triangles: degrees by which a sharp line turns at a vertex that is a corner; 45")
      ->check(CLI::Range(0.1, 180.0))
      ->type_name(kind::number);
  app->add_flag("--given-edges", choice.given_edges,
                "Of triangles: sharp lines are the edges of the file, and no others are sought");
  app->add_flag("--ignore-references", choice.ignore_references,
                "Of triangles: borders between different references are no lines");
}

void add_estimator_options(CLI::App* app, std::vector<std::string>& settings) {
  const auto parameter = [&](const char* option, const char* name, const char* help) {
    return app->add_option_function<std::string>(
        option, [&settings, name](const std::string& value) { settings.push_back(std::string(name) + "=" + value); },
        help);
  };
  parameter("--tolerance", "adapt_tolerance", "Error of a field on the next mesh, in its unit; degrees with curvature")
      ->check(CLI::PositiveNumber)
      ->type_name("ERROR");
  parameter("--source", "adapt_source", "What the error is estimated from")
      ->check(CLI::IsMember({"hessian", "curvature", "deformation"}));
  parameter("--shape", "adapt_shape", "Sizes, circles in the tangent planes of the graph, or metrics")
      ->check(CLI::IsMember({"isotropic", "graph", "anisotropic"}));
  parameter("--recovery", "adapt_recovery", "How derivatives are found from values")
      ->check(CLI::IsMember({"fit", "projection"}));
  app->add_flag_callback("--relative", [&settings] { settings.emplace_back("adapt_relative=1"); },
                         "The tolerance is a share of the field's absolute value");
  parameter("--floor", "adapt_floor", "With --relative: a field counts as this share of its largest value at least")
      ->check(CLI::PositiveNumber)
      ->type_name("SHARE");
  parameter("--ratio", "adapt_ratio", "Largest ratio of the two sizes of a metric")
      ->check(CLI::Range(1.0, 1e9))
      ->type_name("RATIO");
}

}  // namespace command
