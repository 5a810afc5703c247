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
  return app->add_option("--threads", value, "Number of threads; 0 (default): all cores. The mesh does not depend on it")
      ->check(CLI::Range(0, 1024))
      ->type_name(kind::number)
      ->capture_default_str();
}

void add_parts_option(CLI::App* app, MeshOptions& options) {
  app->add_flag("--parts", options.parts,
                "Under mpirun: each process keeps its part; writes .meshb or .pvtu");
}

void add_mesh_options(CLI::App* app, MeshOptions& options) {
  app->add_option("--size", options.size,
                  "Uniform length of edges, or a share of the diagonal; by default 2%, CAD: by curvature")
      ->check(not_empty)
      ->type_name(kind::length);
  app->add_option("--size-map", options.size_map,
                  "Sizes by a formula in x, y, z, u, v, or by a mesh with a .sol beside it")
      ->check(not_empty)
      ->type_name(kind::file);
  app->add_option("--sol-field", options.plane.field,
                  "Number of the field in a .sol, from 1; 0 (default): the only field")
      ->check(CLI::Range(0, 64))
      ->type_name(kind::number);
  app->add_option("--angle", options.angle, "Follow the curvature: angle between edges and surface, degrees; off by default")
      ->check(CLI::Range(0.01, 89.0))
      ->type_name(kind::number);
  app->add_option_function<int>(
         "--segments-per-circle", [&options](int n) { options.angle = 180.0 / n; },
         "Follow the curvature: number of edges of a full circle; as --angle 180/N")
      ->check(CLI::Range(3, 10000))
      ->type_name(kind::number)
      ->excludes("--angle");
  app->add_option("--chord", options.chord, "Follow the curvature: distance between mesh and surface, length or share")
      ->check(not_empty)
      ->type_name(kind::length);
  app->add_option("--gradation", options.gradation,
                  "Largest growth from edge to edge; 0 (default): any; 1.3 with --anisotropic")
      ->check(is_gradation)
      ->type_name("RATIO");
  app->add_flag("--anisotropic{1000}", options.anisotropy,
                "Stretch triangles along flat directions; --anisotropic=RATIO, 1000 by default")
      ->check(CLI::Range(1.0, 1e9));
  app->add_option("--element", options.element,
                  "p1 (default), p2 to p4 (curved), q1.0, q1.1 (quads; .1: no triangle) to q4, q4.1")
      ->check(CLI::IsMember({"p1", "p2", "p3", "p4", "q1.0", "q1.1", "q2.0", "q2.1", "q3", "q3.1", "q4", "q4.1"}))
      ->type_name("ELEMENT");
  CLI::Option* independent = app->add_flag("--cross-patch,--independent", options.independent,
                                           "Let triangles cross borders between faces that meet smoothly");
  app->add_option("--sharp-angle", options.sharp_angle,
                  "Angle between faces above which their border is sharp, degrees; 1 by default")
      ->check(CLI::Range(0.0, 180.0))
      ->needs(independent)
      ->type_name("DEGREES");
  app->add_option("--min", options.minimum, "Smallest size, length or share; no bound by default")->check(not_empty)->type_name(kind::length);
  app->add_option("--max", options.maximum, "Largest size, length or share; no bound by default")->check(not_empty)->type_name(kind::length);
  repeated(app->add_option("--face-size", options.face_sizes,
                           "Size on a face by number or name (wildcards * and ?); repeatable"))
      ->type_name("FACE=LENGTH");
  repeated(app->add_option("--size-on", options.sizes_on,
                           "Size on edges, vertices, faces, solids: edge:3-5=.2, vertex:7=.05, bore*=.3; repeatable"))
      ->type_name("ENTITIES=LENGTH");
  repeated(app->add_option("--near", options.near,
                           "Size near entities, growing linearly to the size around: face:3=.1:2 (size:reach); repeatable"))
      ->type_name("ENTITIES=LENGTH:LENGTH");
  repeated(app->add_option("--layers", options.layers,
                           "Rows along edges: edge:le*=first:.001,ratio:1.2,count:20 or yplus:1,u_tau/nu:5e4; repeatable"))
      ->type_name("ENTITIES=LAYERS");
  app->add_option("--sizes", options.sizes.path, "File .json of sizes: size, angle, size-on, near, ... (carreau-mesh(1)); options override it")
      ->check(not_empty)
      ->type_name(kind::file);
  repeated(app->add_option("--group", options.groups,
                           "Name a group: in=face:3,5-7, rim=edge:4, bolts=bolt*, red=color:#ff0000; repeatable"))
      ->type_name("NAME=ENTITIES");
  app->add_option("--group-by", options.group_by, "Group faces by part, face, color, layer or name (of the face, else of its part; the default)")
      ->check(CLI::IsMember({"part", "face", "color", "layer", "name"}));
  repeated(app->add_option("--curve-edges", options.curve_edges,
                           "Number of edges of a curve: 8, 8,arithmetic:3 or 8,geometric:1.2; repeatable"))
      ->type_name("CURVE=EDGES");
  repeated(app->add_option("--curve-vertices", options.curve_vertices,
                           "All vertices inside a curve, by their parameters; repeatable"))
      ->type_name("CURVE=T,...");
  repeated(app->add_option("--periodic", options.periodic,
                           "Equal faces: x, y, z, A,B,C, rotate:POINT:AXIS:DEGREES, mirror:POINT:NORMAL, 7=3; repeatable"))
      ->type_name("MAP");
  repeated(app->add_option("--mirror", options.cad.mirror,
                           "Symmetric mesh about x, y, z, NORMAL or POINT:NORMAL; half a body becomes whole; repeatable"))
      ->type_name("PLANE");
  repeated(app->add_option("--embed-point", options.embed.points, "Place of a vertex on the surface, within the parameter embed_tolerance; repeatable"))
      ->type_name("X,Y,Z");
  repeated(app->add_option("--embed-curve", options.embed.curves, "File of points of a polyline on the surface, which becomes edges; repeatable"))
      ->type_name(kind::file);
  app->add_option("--ridges", options.embed.ridges, "Edges along lines of a grid where its curvature is extremal, its radius below this length")
      ->check(CLI::Range(0.0, 1e9))
      ->type_name(kind::length);
  app->add_flag("--embed-wires", options.embed.wires, "Edges of no face that lie on faces become edges of their meshes");
  app->add_option("--env", options.env, "Parameters of a blsurf.env up to its first action; options take precedence")
      ->check(not_empty)
      ->type_name(kind::file);
  app->add_option("--effort", options.effort,
                  "Work beyond the first mesh: 0 none; 1 (default) at most as much; 2 at most twice as much")
      ->check(CLI::Range(0, 2))
      ->type_name(kind::number);
  repeated(app->add_option("--set", options.settings, "Set a parameter that `carreau params` lists; repeatable"))
      ->type_name(kind::setting);
  threads(app, options.threads);
}

void radii(CLI::App* app, std::string& path) {
  app->add_option("--radii", path, "Radii of elements, lines \"symbol radius\" in angstrom; Bondi's by default")
      ->check(CLI::ExistingFile)
      ->type_name(kind::file);
}

void add_molecule_options(CLI::App* app, MoleculeChoice& choice) {
  app->add_option("--surface", choice.surface,
                  "vws (default), sas or ses (default with --probe); of triangles: atlas (C1)")
      ->check(CLI::IsMember(surface_names()))
      ->capture_default_str();
  app->add_option("--probe", choice.probe, "Radius of the probe, unit of the file; 1.4 by default (water)")
      ->check(CLI::Range(0.0, 1e9))
      ->type_name(kind::length)
      ->capture_default_str();
  radii(app, choice.radii);
  app->add_flag("--drop-cavities", choice.drop_cavities, "Leave out inner shells");
}

void add_atlas_options(CLI::App* app, AtlasChoice& choice) {
  app->add_option("--reach", choice.reach, "Edges of an atlas' clusters from their middles: 1 (default), 2 or 3")
      ->check(CLI::Range(1, 3))
      ->type_name(kind::number);
  app->add_option("--border", choice.border, "Borders of an atlas' charts: spline (default), cubic, outer-spline, outer-cubic")
      ->check(CLI::IsMember({"spline", "cubic", "outer-spline", "outer-cubic"}));
}

void add_grid_options(CLI::App* app, GridChoice& choice) {
  app->add_option("--grid", choice.format, "Format of a grid: plot3d, heights, scan or nodes; by the suffix by default")
      ->check(CLI::IsMember(std::vector<std::string>(std::begin(grid_formats), std::end(grid_formats))));
  app->add_option("--smooth", choice.smoothing,
                  "Rounds of Taubin's filter: N or N,w1,w2 (.06, .061); ',distance' behind weighs by distance")
      ->check(smoothing_defect)
      ->type_name(kind::rounds);
  app->add_flag("--lengths", choice.lengths, "Parameters by lengths of edges, for grids with abrupt steps");
  app->add_option("--join", choice.join_angle,
                  "Join tangent planes of blocks whose normals differ by less, degrees; off by default")
      ->check(CLI::Range(0.0, 180.0))
      ->type_name(kind::number);
  app->add_flag("--fill", choice.fill, "Fill holes inside");
  app->add_option("--continuity", choice.continuity, "Between cells of a grid: 1 (default) or 2, curvature continuous, by cubic splines")
      ->check(CLI::Range(1, 2))
      ->type_name(kind::number);
  app->add_option("--step", choice.step, "Step of heights and scans if the file has none, length; 1 by default")
      ->check(CLI::Range(0.0, 1e9))
      ->type_name(kind::length);
  app->add_option("--join-nodes", choice.tolerance, "Distance below which border nodes are one, length; 1e-6 of the diagonal by default")
      ->check(CLI::Range(0.0, 1e9))
      ->type_name(kind::length);
}

void add_domain_option(CLI::App* app, std::string& domain) {
  app->add_option("--domain", domain,
                  "box:x0,y0,x1,y1, disc:x,y,radius or ring:x,y,inner,outer; box:-1,-1,1,1 by default")
      ->check(domain_defect)
      ->type_name("DOMAIN");
}

void add_cad_options(CLI::App* app, CadChoice& choice) {
  app->add_flag("--imprint", choice.imprint, "Parts that touch share faces and edges, with one mesh there");
  app->add_option("--imprint-tolerance", choice.imprint_tolerance, "Distance up to which parts touch; tolerances of the file by default")
      ->check(CLI::Range(0.0, 1e9))
      ->type_name(kind::length);
  app->add_option("--min-feature", choice.min_feature, "Remove holes, bosses, fillets, chamfers and steps below this length; off by default")
      ->check(CLI::Range(0.0, 1e9))
      ->type_name(kind::length);
  app->add_option("--unit", choice.unit, "Unit of the mesh; mm by default")
      ->check(CLI::IsMember({"nm", "um", "mm", "cm", "dm", "m", "km", "mil", "in", "ft", "yd"}));
  app->add_option("--scale", choice.scale, "Factor of all coordinates; 1 by default")
      ->check(CLI::PositiveNumber)
      ->type_name(kind::number);
  app->add_flag("--loose-edges", choice.loose_edges, "Mesh edges that belong to no face, too");
}

void add_triangles_options(CLI::App* app, TrianglesChoice& choice) {
  app->add_option("--sharp", choice.sharp,
                  "Angle of sharp edges, degrees; found between 20 and 45 by default")
      ->check(CLI::Range(0.1, 180.0))
      ->type_name(kind::number);
  app->add_option("--corner", choice.corner,
                  "Angle of corners of sharp lines, degrees; 45 by default")
      ->check(CLI::Range(0.1, 180.0))
      ->type_name(kind::number);
  app->add_flag("--given-edges", choice.given_edges,
                "Take the edges of the file as sharp lines");
  app->add_flag("--ignore-references", choice.ignore_references,
                "Do not make lines between different references");
}

void add_estimator_options(CLI::App* app, std::vector<std::string>& settings) {
  const auto parameter = [&](const char* option, const char* name, const char* help) {
    return app->add_option_function<std::string>(
        option, [&settings, name](const std::string& value) { settings.push_back(std::string(name) + "=" + value); },
        help);
  };
  parameter("--tolerance", "adapt_tolerance", "Interpolation error, unit of the field; degrees with --source curvature; .01 by default")
      ->check(CLI::PositiveNumber)
      ->type_name("ERROR");
  parameter("--source", "adapt_source", "Estimate: hessian (default), curvature or deformation")
      ->check(CLI::IsMember({"hessian", "curvature", "deformation"}));
  parameter("--shape", "adapt_shape", "isotropic (default), graph (circles in tangent planes of the graph) or anisotropic")
      ->check(CLI::IsMember({"isotropic", "graph", "anisotropic"}));
  parameter("--recovery", "adapt_recovery", "Derivatives from values: fit (default), projection, or quadric (HDR 3.4.3 a.2)")
      ->check(CLI::IsMember({"fit", "projection", "quadric"}));
  app->add_flag_callback("--relative", [&settings] { settings.emplace_back("adapt_relative=1"); },
                         "Tolerance is a share of the absolute value of the field");
  parameter("--floor", "adapt_floor", "With --relative: smallest value, as a share of the largest; .1 by default")
      ->check(CLI::PositiveNumber)
      ->type_name("SHARE");
  parameter("--ratio", "adapt_ratio", "Largest ratio of the two sizes of a metric; 1000 by default")
      ->check(CLI::Range(1.0, 1e9))
      ->type_name("RATIO");
}

}  // namespace command
