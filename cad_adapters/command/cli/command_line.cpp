// SPDX-License-Identifier: BSD-3-Clause
#include "cli/command_line.h"

#include <carreau.h>

#include <algorithm>
#include <cstdio>
#include <limits>

#include "base/failure.h"
#include "cli/help.h"
#include "cli/option_groups.h"
#include "volume/engines.h"

namespace command {
namespace {

constexpr const char* mesh_files = "File .mesh, .meshb, .vtu, .stl, .msh, .msh2, .bl2d, .inp, .bdf, .unv, .su2, .off, .obj, .ply, .vtk, .tri or .med";
constexpr const char* several_files =
    ". Several files of triangles, patches, grids and molecules make one mesh";
constexpr const char* geometry_files =
    "CAD file (.step, .iges, .brep), patches (.bpt), .pardom, molecule (.xyzr, .xyz, .pdb, .cif), grid (.fmt, .asc, .cyl, ...), "
    "triangles (.stl, .off, .obj, .ply, .mesh, .vtu, .msh, ...), or a formula: 'z = ...' in x, y; 'x = ...; y = ...; z = ...' in u, v";
constexpr const char* molecule_files = "File .xyzr, .xyz, .pdb, .ent, .cif or .mmcif";
constexpr int max_listed = 1'000'000;

}  // namespace

CommandLine::CommandLine(std::string_view first) : app_("Meshes of surfaces made of parametric patches.", "carreau") {
  set_help(app_);
  app_.set_version_flag("--version", std::string("carreau ") + carreau_version());
  app_.require_subcommand(1);
  app_.footer(
      "Exit status: 0 success, 1 the mesh has defects or lacks faces, 2 wrong command line or file, or no mesh. Help on a "
      "command: carreau help COMMAND. Manual: man carreau");
  struct Command {
    std::string_view name;
    void (CommandLine::*add)();
  };
  static constexpr Command commands[] = {
      {"mesh", &CommandLine::add_mesh}, {"volume", &CommandLine::add_volume}, {"plane", &CommandLine::add_plane},
      {"adapt", &CommandLine::add_adapt}, {"refine", &CommandLine::add_refine}, {"info", &CommandLine::add_info},
      {"areas", &CommandLine::add_areas}, {"curve", &CommandLine::add_curve}, {"project", &CommandLine::add_project},
      {"check", &CommandLine::add_check}, {"picture", &CommandLine::add_picture}, {"report", &CommandLine::add_report},
      {"fields", &CommandLine::add_fields}, {"params", &CommandLine::add_params}, {"completion", &CommandLine::add_completion},
  };
  const auto* const only = std::find_if(std::begin(commands), std::end(commands), [&](const Command& each) { return each.name == first && first != "completion"; });
  for (const Command& each : commands)
    if (only == std::end(commands) || &each == only) (this->*each.add)();
  arrange_options(app_);
}

CLI::App* CommandLine::add(const char* name, const char* description) {
  CLI::App* sub = app_.add_subcommand(name, description);
  sub->footer("Manual: man carreau-" + std::string(name));
  return sub;
}

void CommandLine::add_mesh() {
  CLI::App* mesh = add("mesh", "Mesh a CAD file, triangles, a molecule, a grid, a formula, or patches of a host");
  mesh->add_option("INPUT", inputs_, std::string(geometry_files) + several_files)->required()->type_name(kind::file);
  mesh->add_option("--host", mesh_.host, "Shared library with the routines of cad_m, the geometry of a .pardom")
      ->type_name(kind::file);
  repeated(mesh->add_option("-o,--output", mesh_.outputs,
                            "File to write, format by suffix: .vtu, .msh, .mesh, .stl, .inp, .html, ...; repeatable"))
      ->required()
      ->type_name(kind::file);
  add_molecule_options(mesh, mesh_.molecule);
  add_atlas_options(mesh, mesh_.atlas);
  add_grid_options(mesh, mesh_.grid);
  add_triangles_options(mesh, mesh_.triangles);
  add_cad_options(mesh, mesh_.cad);
  add_domain_option(mesh, mesh_.domain);
  add_mesh_options(mesh, mesh_);
  mesh->add_option("--dump-failed", mesh_.dump_failed,
                   "Folder for the domains (.mesh) and fields (.exr) of failed faces")
      ->type_name(kind::file);
  mesh->add_option("--carry-from", mesh_.carry_from, "Geometry before a change: carries its mesh here, with its triangles")
      ->check(not_empty)
      ->type_name(kind::file);
  mesh->add_option("--match", mesh_.match, "Of --carry-from, faces by: reference, name, shape, or any (default)")
      ->check(CLI::IsMember({"any", "reference", "name", "shape"}))
      ->needs("--carry-from");
  mesh->add_option("--halvings", mesh_.halvings, "Times that all edges of the mesh are halved on the surface")
      ->check(CLI::Range(0, 12))
      ->type_name(kind::number);
  mesh->add_option("--nodes", mesh_.nodes, "Places of nodes of orders 3 and 4: equidistant (default) or gauss-lobatto")
      ->check(CLI::IsMember({"equidistant", "gauss-lobatto"}));
  mesh->add_flag("--centre-nodes", mesh_.centre_nodes, "Quads of order 2 have 9 nodes, all on the surface: Gmsh's type 10, for dolfinx");
  mesh->add_flag("--association", mesh_.association, "Write entities and parameters of nodes (.msh, .msh2, .mesh, .meshb, .vtu)");
  add_parts_option(mesh, mesh_);
  mesh->add_flag("--json", mesh_.json, "Print a summary as JSON");
  mesh->add_flag("-q,--quiet", mesh_.quiet, "Print errors only");
  mesh->add_flag("--verbose", mesh_.verbose, "Print evaluations, times of phases, gluing and other details");
}

void CommandLine::add_volume() {
  volume_.volume.is_volume = true;
  CLI::App* volume = add("volume", "Mesh the surface, and let TetGen, Gmsh or Netgen fill its solids with tetrahedra");
  volume->add_option("INPUT", solids_, std::string(geometry_files) + several_files)->required()->type_name(kind::file);
  volume->add_option("--host", volume_.host, "Shared library with the routines of cad_m, the geometry of a .pardom")
      ->type_name(kind::file);
  repeated(volume->add_option("-o,--output", volume_.outputs,
                              "File to write, format by suffix: .msh, .msh2, .inp, .su2, .vtu, .mesh; repeatable"))
      ->required()
      ->type_name(kind::file);
  volume->add_option("--engine", volume_.volume.engine, "Program that fills solids: gmsh, tetgen or netgen; the first one found by default")
      ->check(CLI::IsMember(engine_names()));
  volume->add_option("--engine-seconds", volume_.volume.seconds, "End the engine after this time; 3600 s by default, 0 never")
      ->check(CLI::Range(0.0, 1e9))
      ->type_name(kind::number)
      ->capture_default_str();
  volume->add_option("--engine-memory", volume_.volume.gigabytes, "Memory of the engine, GB; no limit by default")
      ->check(CLI::Range(0.0, 1e6))
      ->type_name(kind::number);
  add_molecule_options(volume, volume_.molecule);
  add_atlas_options(volume, volume_.atlas);
  add_grid_options(volume, volume_.grid);
  add_triangles_options(volume, volume_.triangles);
  add_cad_options(volume, volume_.cad);
  add_domain_option(volume, volume_.domain);
  add_mesh_options(volume, volume_);
  volume->add_flag("--json", volume_.json, "Print a summary as JSON");
  volume->add_flag("-q,--quiet", volume_.quiet, "Print errors only");
  volume->add_flag("--verbose", volume_.verbose, "Print evaluations, times of phases, gluing and other details");
}

void CommandLine::add_plane() {
  plane_.plane.is_plane = true;
  CLI::App* plane = add("plane", "Mesh a plane domain: Triangle's .poly, edges of a plane mesh, BL2D's files");
  plane->add_option("DOMAIN", plane_.input, "File .poly, .mesh, .meshb or .bl2d of dimension 2, .data or .g")
      ->required()
      ->type_name(kind::file);
  repeated(plane->add_option("-o,--output", plane_.outputs,
                             "File to write, format by suffix: .mesh, .bl2d, .vtu, .msh, .html, ...; repeatable"))
      ->required()
      ->type_name(kind::file);
  plane
      ->add_flag("--smooth{50}", plane_.plane.corner_angle,
                 "Replace polygons by splines; --smooth=DEGREES is the angle of corners, 50 by default")
      ->check(CLI::Range(0.1, 180.0));
  plane
      ->add_option("--sol", plane_.plane.sizes,
                   "Sizes or metrics at the vertices of the file: .sol, .solb, BL2D's .hg, .h")
      ->check(not_empty)
      ->type_name(kind::file);
  add_mesh_options(plane, plane_);
  add_parts_option(plane, plane_);
  plane->add_flag("--json", plane_.json, "Print a summary as JSON");
  plane->add_flag("-q,--quiet", plane_.quiet, "Print errors only");
  plane->add_flag("--verbose", plane_.verbose, "Print evaluations, times of phases, gluing and other details");
}

void CommandLine::add_adapt() {
  adapt_.adapt.is_adapt = true;
  CLI::App* adapt = add("adapt", "Make the next mesh of a geometry from values, sizes or metrics on the last mesh");
  adapt
      ->add_option("INPUT", adapt_.input,
                   "Geometry: a file of `carreau mesh` or `carreau plane`; .mesh is a plane domain")
      ->required()
      ->type_name(kind::file);
  adapt->add_option("--host", adapt_.host, "Shared library with the routines of cad_m, the geometry of a .pardom")
      ->type_name(kind::file);
  adapt->add_option("--mesh", adapt_.adapt.mesh, "Last mesh: .mesh, .meshb, .bl2d, .vtu or another format")
      ->type_name(kind::file);
  adapt->add_option("--sol", adapt_.adapt.sol, "Values, sizes or metrics at its vertices: .sol, .solb, BL2D's .h")
      ->type_name(kind::file);
  adapt
      ->add_option("--use", adapt_.adapt.use,
                   "Content of --sol: values (estimated), sizes or metrics; values by default")
      ->check(CLI::IsMember({"values", "sizes", "metrics"}))
      ->capture_default_str();
  adapt
      ->add_option("--transfer", adapt_.adapt.transfer,
                   "Fields of --mesh for the .sol of the next mesh; --sol by default")
      ->type_name(kind::file);
  adapt->add_option("--formula", adapt_.adapt.formula, "Field in x, y, z in place of --mesh and --sol; runs a whole loop")
      ->check(not_empty)
      ->type_name("FORMULA");
  adapt->add_option("--iterations", adapt_.adapt.iterations, "Number of meshes of --formula; 5 by default")
      ->check(CLI::Range(1, 1000))
      ->type_name(kind::number)
      ->capture_default_str();
  adapt->add_flag("--differences", adapt_.adapt.differences,
                  "Derivatives by differences of the formula, in the plane");
  adapt->add_option("--convergence", adapt_.adapt.convergence,
                    "End if the number of triangles changes by less; 0 (default): all iterations")
      ->check(CLI::Range(0.0, 1.0))
      ->type_name("SHARE");
  repeated(adapt->add_option("-o,--output", adapt_.outputs,
                             "Mesh to write, format by suffix, and its fields (.sol, .solb); repeatable"))
      ->required()
      ->type_name(kind::file);
  add_estimator_options(adapt, adapt_.adapt.names);
  adapt->add_flag("--smooth{50}", adapt_.plane.corner_angle, "Replace polygons by splines (plane domain); corner angle 50 degrees")
      ->check(CLI::Range(0.1, 180.0));
  add_molecule_options(adapt, adapt_.molecule);
  add_atlas_options(adapt, adapt_.atlas);
  add_triangles_options(adapt, adapt_.triangles);
  add_cad_options(adapt, adapt_.cad);
  add_domain_option(adapt, adapt_.domain);
  add_mesh_options(adapt, adapt_);
  adapt->add_flag("--json", adapt_.json, "Print a summary as JSON");
  adapt->add_flag("-q,--quiet", adapt_.quiet, "Print errors only");
  adapt->add_flag("--verbose", adapt_.verbose, "Print evaluations, times of phases, gluing and other details");
}

void CommandLine::add_info() {
  CLI::App* info = add("info", "Print the content of a geometry and potential meshing problems");
  info->add_option("INPUT", info_.input, geometry_files)->required()->type_name(kind::file);
  info->add_option("--host", info_.host, "Shared library with the routines of cad_m, the geometry of a .pardom")
      ->type_name(kind::file);
  info->add_option("--limit", info_.limit, "Most sentences of each kind; 10 by default")
      ->check(CLI::Range(1, max_listed))
      ->type_name(kind::number)
      ->capture_default_str();
  info->add_flag("--faces", info_.faces, "Print a line for each face: number, kind, area, narrowness, box, name");
  add_grid_options(info, info_.grid);
  add_triangles_options(info, info_.triangles);
  add_domain_option(info, info_.domain);
  add_cad_options(info, info_.cad);
  info->add_flag("--json", info_.json, "Print JSON");
}

void CommandLine::add_refine() {
  CLI::App* app = add("refine", "Divide triangles where the smooth surface over them is curved");
  app->add_option("TRIANGLES", refine_.input, "File .stl, .off, .obj, .ply, .mesh, .meshb, .vtu or .msh")
      ->required()
      ->type_name(kind::file);
  repeated(app->add_option("-o,--output", refine_.outputs,
                           "File to write, with the edges of sharp lines: .mesh, .vtu, .stl, .msh, ...; repeatable"))
      ->required()
      ->type_name(kind::file);
  app->add_option("--angle", refine_.angle,
                  "Divide triangles farther from the surface than this angle, degrees; none by default")
      ->check(CLI::Range(0.01, 89.0))
      ->type_name(kind::number);
  app->add_option("--depth", refine_.depth, "Most divisions of a triangle; 6 by default")
      ->check(CLI::Range(1, 20))
      ->type_name(kind::number)
      ->capture_default_str();
  add_triangles_options(app, refine_.triangles);
  app->add_flag("--json", refine_.json, "Print counts as JSON");
  app->add_flag("-q,--quiet", refine_.quiet, "Print errors only");
}

void CommandLine::add_areas() {
  CLI::App* areas = add("areas", "Print areas and volumes of the surfaces of a molecule, in closed form");
  areas->add_option("INPUT", areas_.input, molecule_files)->required()->type_name(kind::file);
  areas->add_option("--probe", areas_.probe, "Radius of the probe, unit of the file; 1.4 by default (water)")
      ->check(CLI::Range(0.0, 1e9))
      ->type_name(kind::length)
      ->capture_default_str();
  radii(areas, areas_.radii);
  areas->add_flag("--atoms", areas_.atoms, "Print a line for each atom");
  threads(areas, areas_.threads);
  areas->add_flag("--json", areas_.json, "Print JSON");
}

void CommandLine::add_curve() {
  CLI::App* curve = add("curve", "Join points by splines, cut curves into edges of a size or metric, draw them");
  curve->add_option("INPUT", curve_.input, "Text of points, or a mesh with edges (BL2D's .smo, .mc, .ms; .mesh, .vtu, ...)")
      ->required()
      ->type_name(kind::file);
  curve->add_option("-o,--output", curve_.outputs, "Files .mesh, .mc (BL2D's C), .svg (drawing); repeat for several")->type_name(kind::file);
  curve->add_option("--size", curve_.size, "Length of edges; 2% of the diagonal by default")->type_name(kind::length);
  curve->add_option("--sizes", curve_.sizes, "File of sizes or metrics at the points, a line each, or BL2D's .h, .hc, .hg")
      ->type_name(kind::file)
      ->excludes("--size");
  curve->add_option("--law", curve_.law, "Sizes between points: linear, geometric or sinusoidal; linear by default")
      ->check(CLI::IsMember({"linear", "geometric", "sinusoidal"}))
      ->capture_default_str();
  curve->add_option("--through", curve_.join, "Curves through the points: spline (default for a text) or straight (for a mesh)")
      ->check(CLI::IsMember({"spline", "straight"}));
  curve->add_option("--deviation", curve_.tolerance, "Distance of the polyline of a spline, as a share of its edges; 0.01 by default")
      ->check(CLI::Range(1e-6, 1.0))
      ->type_name(kind::number)
      ->capture_default_str();
  curve->add_flag("--json", curve_.json, "Print JSON");
}

void CommandLine::add_project() {
  CLI::App* project = add("project", "Print the closest point of a geometry to each point of a file");
  project->add_option("INPUT", project_.input, geometry_files)->required()->type_name(kind::file);
  project->add_option("--points", project_.points, "Text file of points, x y z in each line")->required()->check(not_empty)->type_name(kind::file);
  project->add_option("--on", project_.on, "Entities: faces (default), edges or vertices")->check(CLI::IsMember({"faces", "edges", "vertices"}));
  project->add_option("--only", project_.number, "Number of the only entity")->check(CLI::Range(1, std::numeric_limits<int>::max()))->type_name(kind::number);
  project->add_option("--host", project_.host, "Shared library with the routines of cad_m, the geometry of a .pardom")->type_name(kind::file);
  add_grid_options(project, project_.grid);
  add_triangles_options(project, project_.triangles);
  add_domain_option(project, project_.domain);
  add_cad_options(project, project_.cad);
  threads(project, project_.threads);
  project->add_flag("--json", project_.json, "Print JSON");
}

void CommandLine::add_check() {
  CLI::App* check = add("check", "Print counts, quality and defects of a mesh");
  check->add_option("MESH", check_.mesh, mesh_files)->required()->type_name(kind::file);
  check->add_flag("--closed", check_.closed, "Count borders as defects");
  check->add_flag("--allow-crossings", check_.allow_crossings, "Do not count crossing triangles as defects");
  check->add_flag_callback("--no-crossings", [] {}, "The default")->group("");  // earlier scripts have it
  check->add_option("--limit", check_.limit, "Most defects to list; 20 by default")
      ->check(CLI::Range(1, max_listed))
      ->type_name(kind::number)
      ->capture_default_str();
  check->add_option("--worst", check_.worst, "Number of worst triangles to list; 3 by default")
      ->check(CLI::Range(0, max_listed))
      ->type_name(kind::number)
      ->capture_default_str();
  check->add_flag("--faces", check_.faces, "Print a line for each face");
  check->add_flag("--json", check_.json, "Print JSON");
}

void CommandLine::add_picture() {
  CLI::App* picture = add("picture", "Draw a mesh into a PNG file");
  picture->add_option("MESH", picture_.mesh, mesh_files)->required()->type_name(kind::file);
  picture->add_option("-o,--output", picture_.out, "File to write")->required()->type_name(kind::file);
  picture->add_option("--size", picture_size_, "Pixels; 1200x900 by default")->type_name("WIDTHxHEIGHT")->capture_default_str();
  repeated(picture->add_option("--view", picture_.views,
                               "iso, front, back, left, right, top, bottom, or x,y,z towards the eye; repeatable"))
      ->type_name(kind::view);
  picture
      ->add_option(
          "--color", paint_,
          "face (default: colours of the file), reference, quality, size or none")
      ->check(CLI::IsMember({"face", "reference", "quality", "size", "none"}))
      ->capture_default_str();
  picture->add_flag("--edges,!--no-edges", picture_.scene.edges,
                    "Draw the edges of triangles, or do not; drawn by default");
  picture
      ->add_option("--metric", picture_.metrics,
                   "Draw ellipses of sizes or metrics at vertices (.sol, .solb, .h), or of the mesh itself (mesh)")
      ->check(not_empty)
      ->type_name(kind::file);
  picture
      ->add_option("--ellipses", picture_.scene.ellipse_scale,
                   "Scale of the ellipses: 1 (default), unit edges end on them; .5, neighbours touch")
      ->check(CLI::Range(1e-3, 10.0))
      ->type_name("SCALE")
      ->capture_default_str();
  picture
      ->add_option("--around", around_,
                   "Show the neighbourhood of a place: x, y, z and a radius")
      ->delimiter(',')
      ->expected(4)
      ->type_name("X,Y,Z,RADIUS");
  picture->add_option("--label", label_, "faces: print the numbers of faces")
      ->check(CLI::IsMember({"faces"}))
      ->type_name("WHAT");
  picture->add_option("--sharp", picture_.triangles.sharp,
                      "Draw sharp lines of triangles, as carreau info finds them; degrees")
      ->check(CLI::Range(0.1, 180.0))
      ->type_name(kind::number);
  picture->add_flag("--json", picture_.json, "Print the view as JSON");
  picture->add_option("--samples", picture_.samples, "Points of a pixel in each direction; 3 by default")
      ->check(CLI::Range(1, 8))
      ->type_name(kind::number)
      ->capture_default_str();
}

void CommandLine::add_report() {
  CLI::App* app = add("report", "Write a mesh as a page of HTML: a view in space, histograms, faces, defects");
  app->add_option("MESH", report_.mesh, mesh_files)->required()->type_name(kind::file);
  app->add_option("-o,--output", report_.out, "File .html to write; the name of the mesh by default")
      ->type_name(kind::file);
  app->add_flag("--json", report_.json, "Print the figures of carreau check as JSON, and the size of the page");
}

void CommandLine::add_fields() {
  CLI::App* fields = add("fields", "Mesh, and write the fields that govern the mesh as OpenEXR images or pictures");
  fields->add_option("INPUT", fields_.mesh.input, "Geometry of carreau mesh, or an .env whose actions are run")
      ->required()
      ->type_name(kind::file);
  fields
      ->add_option("--host", fields_.mesh.host,
                   "Shared library with the routines of cad_m, the geometry of a .pardom or .env")
      ->type_name(kind::file);
  repeated(fields->add_option("-o,--output", fields_.mesh.outputs,
                              "File .exr, or .png with colours of sizes; a file for each face, NAME.face.REF.exr; repeatable"))
      ->required()
      ->type_name(kind::file);
  fields->add_option("--pixels", field_size_, "Pixels of the longer side, or WIDTHxHEIGHT; 1024 by default")
      ->type_name("PIXELS")
      ->capture_default_str();
  fields->add_option("--face", fields_.face, "Only this face, into the file without a suffix of its number")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()))
      ->type_name("REF");
  fields->add_flag("--multi-part", fields_.multi_part, "All faces in one .exr, a part for each face");
  repeated(fields->add_option("--channels", fields_.channels, "Groups of channels, separated by commas; all by default")
               ->delimiter(',')
               ->check(CLI::IsMember(field_groups())));
  fields->add_flag("--piz", fields_.piz, "Compress by PIZ instead of ZIP; both are lossless");
  fields->add_flag("--raw", fields_.raw, "Evaluate the geometry only, without a mesh");
  add_molecule_options(fields, fields_.mesh.molecule);
  add_atlas_options(fields, fields_.mesh.atlas);
  add_grid_options(fields, fields_.mesh.grid);
  add_domain_option(fields, fields_.mesh.domain);
  add_mesh_options(fields, fields_.mesh);
  fields->add_flag("--json", fields_.mesh.json, "Print the files as JSON");
}

void CommandLine::add_params() {
  CLI::App* params = add("params", "List the parameters with types, defaults, ranges and a line of help");
  params->add_option("NAME", params_.name, "One parameter only")->type_name(kind::parameter);
  params->add_flag("--json", params_.json, "Print JSON");
}

void CommandLine::add_completion() {
  CLI::App* completion = add("completion", "Print a script with which a shell completes this command");
  completion->add_option("SHELL", shell_, "The shell")->required()->check(CLI::IsMember({"bash", "zsh", "fish"}));
}

}  // namespace command
