// SPDX-License-Identifier: BSD-3-Clause
#include "cli/command_line.h"

#include <carreau.h>

#include <algorithm>
#include <cstdio>
#include <limits>

#include "base/failure.h"
#include "base/json_output.h"
#include "base/lengths.h"
#include "base/text_file.h"
#include "cli/completion.h"
#include "cli/option_groups.h"
#include "cli/option_scope.h"
#include "cli/parse_errors.h"
#include "inputs/built/plane_input.h"

namespace command {
namespace {

constexpr const char* mesh_files = "File .mesh, .meshb, .vtu, .stl, .msh, .msh2, .bl2d, .inp, .bdf, .unv, .su2, .off, .obj, .ply, .vtk, .tri or .med";
constexpr const char* several_files =
    "; several files of triangles, patches (.bpt), grids and molecules are meshed together";
constexpr const char* geometry_files =
    "File .step, .stp, .iges, .igs, .brep, .brp, .bpt (Bezier patches), .pardom, or a molecule: "
    ".xyzr, .xyz, .pdb, .ent, .cif, .mmcif, or a grid: .fmt, .p3d, .x, .grd, .asc, .dem, .txt, .cyl, .ijk, or triangles: "
    ".stl, .off, .obj, .ply, .mesh, .meshb, .vtu, .vtk, .msh, .inp, .bdf, .unv, .su2, .tri, .med, or a surface: "
    "'z = ...' in x and y, or 'x = ...; y = ...; z = ...' in u and v";
constexpr const char* molecule_files = "File .xyzr, .xyz, .pdb, .ent, .cif or .mmcif";
constexpr int most_listed = 1'000'000;
constexpr int unusable = 2;  // exit code

void parse_picture_size(const std::string& text, PictureOptions& options) {
  const auto size = parse_pixels(text);
  if (!size || std::min(size->first, size->second) < 16 || std::max(size->first, size->second) > 20000)
    throw Failure("The size '" + text + "' is not WIDTHxHEIGHT with numbers from 16 to 20000.");
  options.width = size->first, options.height = size->second;
}

/// "800x600", or the longer side alone.
void parse_field_size(const std::string& text, FieldsOptions& options) {
  if (const auto size = parse_pixels(text)) {
    options.width = size->first, options.height = size->second;
    return;
  }
  const auto longest = parse_count(text);
  if (!longest) throw Failure("The size '" + text + "' is neither a number of pixels nor WIDTHxHEIGHT.");
  options.longest = *longest;
}

const CLI::App* find_command(const std::string& name, const CLI::App& app) {
  for (const CLI::App* sub : app.get_subcommands({}))
    if (sub->get_name() == name) return sub;
  return nullptr;
}

}  // namespace

CommandLine::CommandLine() : app_("Meshes of surfaces made of parametric patches.", "carreau") {
  app_.set_version_flag("--version", std::string("carreau ") + carreau_version());
  app_.require_subcommand(1);
  app_.footer(
      "Exit codes: 0 done, 1 the mesh has defects or lacks faces, 2 wrong command line or file, or no mesh. Help on a "
      "command: carreau help COMMAND. Manual: man carreau");
  add_mesh();
  add_plane();
  add_adapt();
  add_refine();
  add_info();
  add_areas();
  add_check();
  add_picture();
  add_report();
  add_fields();
  add_params();
  add_completion();
}

CLI::App* CommandLine::add(const char* name, const char* description) {
  CLI::App* sub = app_.add_subcommand(name, description);
  sub->footer("Manual: man carreau-" + std::string(name));
  return sub;
}

void CommandLine::add_mesh() {
  CLI::App* mesh = add("mesh", "Mesh the faces of a CAD file, Bezier patches, a .pardom, a grid, or the surface of a molecule");
  mesh->add_option("INPUT", inputs_, std::string(geometry_files) + several_files)->required()->type_name(kind::file);
  mesh->add_option("--host", mesh_.host, "Geometry of a .pardom: a shared library with the routines of cad_m")
      ->type_name(kind::file);
  repeated(mesh->add_option("-o,--output", mesh_.outputs,
                            "File to write: .mesh, .meshb, .vtu, .stl, .msh (Gmsh 4.1), .msh2 (2.2), .inp, .bdf, .unv, .su2, "
                            ".off, .obj, .ply, .exr (fields) or .html (a report); may be repeated"))
      ->required()
      ->type_name(kind::file);
  add_molecule_options(mesh, mesh_.molecule);
  add_grid_options(mesh, mesh_.grid);
  add_triangles_options(mesh, mesh_.triangles);
  add_cad_options(mesh, mesh_);
  add_domain_option(mesh, mesh_.domain);
  add_mesh_options(mesh, mesh_);
  mesh->add_option("--dump-failed", mesh_.dump_failed,
                   "Folder for each face that fails: its parameter domain (.mesh of dimension 2), its fields (.exr)")
      ->type_name(kind::file);
  add_parts_option(mesh, mesh_);
  mesh->add_flag("--json", mesh_.json, "Print a summary as JSON on the standard output");
  mesh->add_flag("-q,--quiet", mesh_.quiet, "Tell errors only");
}

void CommandLine::add_plane() {
  plane_.plane.is_plane = true;
  CLI::App* plane = add("plane", "Mesh a domain of the plane: Triangle's .poly, a plane mesh's edges, BL2D's files");
  plane->add_option("DOMAIN", plane_.input, "File .poly, .mesh, .meshb or .bl2d of dimension 2, .data or .g")
      ->required()
      ->type_name(kind::file);
  repeated(plane->add_option("-o,--output", plane_.outputs,
                             "File to write: .mesh or .meshb (dimension 2), .bl2d, .vtu, .stl, .msh (Gmsh 4.1), .msh2 "
                             "(2.2), .exr (fields) or .html (a report); may be repeated"))
      ->required()
      ->type_name(kind::file);
  plane
      ->add_flag("--smooth{50}", plane_.plane.corner_angle,
                 "Polygons become splines that end where they turn by more than 50 degrees; --smooth=DEGREES: by more "
                 "than these")
      ->check(CLI::Range(0.1, 180.0));
  plane
      ->add_option("--sol", plane_.plane.sizes,
                   "Sizes or metrics at the vertices of the file: .sol, .solb, or BL2D's .hg or .h")
      ->check(not_empty)
      ->type_name(kind::file);
  add_mesh_options(plane, plane_);
  add_parts_option(plane, plane_);
  plane->add_flag("--json", plane_.json, "Print a summary as JSON on the standard output");
  plane->add_flag("-q,--quiet", plane_.quiet, "Tell errors only");
}

void CommandLine::add_adapt() {
  adapt_.adapt.is_adapt = true;
  CLI::App* adapt = add("adapt", "Make the next mesh of a geometry from values, sizes or metrics on the last one");
  adapt
      ->add_option("INPUT", adapt_.input,
                   "The geometry: a file that `carreau mesh` or `carreau plane` reads; .mesh is a plane domain")
      ->required()
      ->type_name(kind::file);
  adapt->add_option("--host", adapt_.host, "Geometry of a .pardom: a shared library with the routines of cad_m")
      ->type_name(kind::file);
  adapt->add_option("--mesh", adapt_.adapt.mesh, "The last mesh: .mesh, .meshb, .bl2d, .vtu, ...")
      ->type_name(kind::file);
  adapt->add_option("--sol", adapt_.adapt.sol, "What is known at its vertices: .sol or .solb; sizes also BL2D's .h")
      ->type_name(kind::file);
  adapt
      ->add_option("--use", adapt_.adapt.use,
                   "What --sol has: values of fields, which are estimated; or sizes, or metrics, which are taken")
      ->check(CLI::IsMember({"values", "sizes", "metrics"}))
      ->capture_default_str();
  adapt
      ->add_option("--transfer", adapt_.adapt.transfer,
                   "Fields at the vertices of --mesh that the .sol of the next mesh gets; by default those of --sol")
      ->type_name(kind::file);
  adapt->add_option("--formula", adapt_.adapt.formula, "A field in x, y, z in place of --mesh and --sol: a whole loop")
      ->check(not_empty)
      ->type_name("FORMULA");
  adapt->add_option("--iterations", adapt_.adapt.iterations, "Meshes that --formula makes")
      ->check(CLI::Range(1, 1000))
      ->type_name(kind::number)
      ->capture_default_str();
  adapt->add_flag("--differences", adapt_.adapt.differences,
                  "Of --formula: derivatives by differences of the formula itself, in the plane");
  adapt->add_option("--convergence", adapt_.adapt.convergence,
                    "Of --formula: end when the number of triangles changes by a smaller share; 0: all iterations")
      ->check(CLI::Range(0.0, 1.0))
      ->type_name("SHARE");
  repeated(adapt->add_option("-o,--output", adapt_.outputs,
                             "File to write: the mesh as .mesh, .meshb, .bl2d, .vtu, .stl, .msh, .msh2, .exr or .html, the "
                             "fields on it as .sol or .solb (beside the mesh when not named); may be repeated"))
      ->required()
      ->type_name(kind::file);
  add_estimator_options(adapt, adapt_.adapt.names);
  adapt->add_flag("--smooth{50}", adapt_.plane.corner_angle, "Of a plane domain: see carreau plane")
      ->check(CLI::Range(0.1, 180.0));
  add_molecule_options(adapt, adapt_.molecule);
  add_triangles_options(adapt, adapt_.triangles);
  add_cad_options(adapt, adapt_);
  add_domain_option(adapt, adapt_.domain);
  add_mesh_options(adapt, adapt_);
  adapt->add_flag("--json", adapt_.json, "Print a summary as JSON on the standard output");
  adapt->add_flag("-q,--quiet", adapt_.quiet, "Tell errors only");
}

void CommandLine::add_info() {
  CLI::App* info = add("info", "Print what a file of geometry holds and what of it is hard to mesh");
  info->add_option("INPUT", info_.input, geometry_files)->required()->type_name(kind::file);
  info->add_option("--host", info_.host, "Geometry of a .pardom: a shared library with the routines of cad_m")
      ->type_name(kind::file);
  info->add_option("--limit", info_.limit, "Sentences of each kind")
      ->check(CLI::Range(1, most_listed))
      ->type_name(kind::number)
      ->capture_default_str();
  info->add_flag("--faces", info_.faces, "Print a line for each face: number, kind, area, narrowness, box, name");
  add_grid_options(info, info_.grid);
  add_triangles_options(info, info_.triangles);
  add_domain_option(info, info_.domain);
  info->add_flag("--json", info_.json, "Print JSON");
}

void CommandLine::add_refine() {
  CLI::App* app = add("refine", "Cut triangles finer where the smooth surface over them is curved");
  app->add_option("TRIANGLES", refine_.input, "File .stl, .off, .obj, .ply, .mesh, .meshb, .vtu or .msh")
      ->required()
      ->type_name(kind::file);
  repeated(app->add_option("-o,--output", refine_.outputs,
                           "File to write: .mesh, .meshb, .vtu, .stl, .msh (Gmsh 4.1) or .msh2 (2.2), with the edges of "
                           "sharp lines; may be repeated"))
      ->required()
      ->type_name(kind::file);
  app->add_option("--angle", refine_.angle,
                  "Degrees between triangles and the surface beyond which they are cut into four; none are when not given")
      ->check(CLI::Range(0.01, 89.0))
      ->type_name(kind::number);
  app->add_option("--depth", refine_.depth, "Times that a triangle is cut at most")
      ->check(CLI::Range(1, 20))
      ->type_name(kind::number)
      ->capture_default_str();
  add_triangles_options(app, refine_.triangles);
  app->add_flag("--json", refine_.json, "Print counts as JSON");
  app->add_flag("-q,--quiet", refine_.quiet, "Tell errors only");
}

void CommandLine::add_areas() {
  CLI::App* areas = add("areas", "Print areas and volumes of a molecule's surfaces, in closed form");
  areas->add_option("INPUT", areas_.input, molecule_files)->required()->type_name(kind::file);
  areas->add_option("--probe", areas_.probe, "Radius of the probe that stands for the solvent")
      ->check(CLI::Range(0.0, 1e9))
      ->type_name(kind::length)
      ->capture_default_str();
  radii(areas, areas_.radii);
  areas->add_flag("--atoms", areas_.atoms, "Print a line for each atom");
  threads(areas, areas_.threads);
  areas->add_flag("--json", areas_.json, "Print JSON");
}

void CommandLine::add_check() {
  CLI::App* check = add("check", "Print counts, quality and defects of a mesh");
  check->add_option("MESH", check_.mesh, mesh_files)->required()->type_name(kind::file);
  check->add_flag("--closed", check_.closed, "An edge with one triangle is a defect too");
  check->add_flag("--allow-crossings", check_.allow_crossings, "Triangles that cross are no defect");
  check->add_flag_callback("--no-crossings", [] {}, "The default")->group("");  // earlier scripts have it
  check->add_option("--limit", check_.limit, "Defects to look for")
      ->check(CLI::Range(1, most_listed))
      ->type_name(kind::number)
      ->capture_default_str();
  check->add_option("--worst", check_.worst, "Worst triangles to list")
      ->check(CLI::Range(0, most_listed))
      ->type_name(kind::number)
      ->capture_default_str();
  check->add_flag("--faces", check_.faces, "Print a line for each face");
  check->add_flag("--json", check_.json, "Print JSON");
}

void CommandLine::add_picture() {
  CLI::App* picture = add("picture", "Draw a mesh into a PNG file");
  picture->add_option("MESH", picture_.mesh, mesh_files)->required()->type_name(kind::file);
  picture->add_option("-o,--output", picture_.out, "File to write")->required()->type_name(kind::file);
  picture->add_option("--size", picture_size_, "Pixels")->type_name("WIDTHxHEIGHT")->capture_default_str();
  repeated(picture->add_option("--view", picture_.views,
                               "iso, front, back, left, right, top, bottom, or a direction x,y,z from the mesh to the "
                               "eye; may be repeated"))
      ->type_name(kind::view);
  picture
      ->add_option(
          "--color", paint_,
          "face: their own colours when the file has some, else as reference; reference: a colour a reference, "
          "another one than its neighbours; quality: violet 0 to yellow 1; size: violet the smallest triangles, "
          "yellow the largest; none: grey")
      ->check(CLI::IsMember({"face", "reference", "quality", "size", "none"}))
      ->capture_default_str();
  picture->add_flag("--edges,!--no-edges", picture_.scene.edges,
                    "Draw the sides of triangles or not; they are by default");
  picture
      ->add_option("--metric", picture_.metrics,
                   "Sizes or metrics at the vertices, .sol, .solb or BL2D's .h, whose ellipses are drawn; mesh: those "
                   "in which the triangles around each vertex are equilateral")
      ->check(not_empty)
      ->type_name(kind::file);
  picture
      ->add_option("--ellipses", picture_.scene.ellipse_scale,
                   "Scale of the ellipses of --metric: 1, the ends of unit edges lie on them; .5, neighbours touch")
      ->check(CLI::Range(1e-3, 10.0))
      ->type_name("SCALE")
      ->capture_default_str();
  picture
      ->add_option("--around", around_,
                   "Place x, y, z and the radius around it that fill the picture; what is beside the eye is left out")
      ->delimiter(',')
      ->expected(4)
      ->type_name("X,Y,Z,RADIUS");
  picture->add_option("--label", label_, "faces: their numbers are drawn where they are seen")
      ->check(CLI::IsMember({"faces"}))
      ->type_name("WHAT");
  picture->add_option("--sharp", picture_.triangles.sharp,
                      "Draw the sharp lines of triangles that differ by more than these degrees, as carreau info finds them")
      ->check(CLI::Range(0.1, 180.0))
      ->type_name(kind::number);
  picture->add_flag("--json", picture_.json, "Print what was drawn as JSON");
  picture->add_option("--samples", picture_.samples, "Points a pixel in each direction")
      ->check(CLI::Range(1, 8))
      ->type_name(kind::number)
      ->capture_default_str();
}

void CommandLine::add_report() {
  CLI::App* app = add("report", "Write a mesh as a page of HTML: a view in space, histograms, faces, defects");
  app->add_option("MESH", report_.mesh, mesh_files)->required()->type_name(kind::file);
  app->add_option("-o,--output", report_.out, "File .html to write; by default that of the mesh with this suffix")
      ->type_name(kind::file);
  app->add_flag("--json", report_.json, "Print what carreau check prints as JSON, and the size of the page");
}

void CommandLine::add_fields() {
  CLI::App* fields = add("fields", "Mesh, and write what governed the mesh as OpenEXR images or pictures");
  fields->add_option("INPUT", fields_.mesh.input, "CAD file, .bpt, .pardom, or .env whose actions are run")
      ->required()
      ->type_name(kind::file);
  fields
      ->add_option("--host", fields_.mesh.host,
                   "Geometry of a .pardom or .env: a shared library with the routines of cad_m")
      ->type_name(kind::file);
  repeated(fields->add_option("-o,--output", fields_.mesh.outputs,
                              "File .exr, or .png with the sizes in colours; a file a face: NAME.face.REF.exr; may be "
                              "repeated"))
      ->required()
      ->type_name(kind::file);
  fields->add_option("--pixels", field_size_, "Pixels of the longer side, or WIDTHxHEIGHT")
      ->type_name("PIXELS")
      ->capture_default_str();
  fields->add_option("--face", fields_.face, "Only this face, into the file as it is named")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()))
      ->type_name("REF");
  fields->add_flag("--multi-part", fields_.multi_part, "All faces into one file .exr, a part each");
  repeated(fields->add_option("--channels", fields_.channels, "Groups of channels, separated by commas; all by default")
               ->delimiter(',')
               ->check(CLI::IsMember(field_groups())));
  fields->add_flag("--piz", fields_.piz, "PIZ in place of ZIP; both are lossless");
  fields->add_flag("--raw", fields_.raw, "What the geometry answers, without a mesh");
  add_molecule_options(fields, fields_.mesh.molecule);
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

int CommandLine::help(const std::string& command) {
  if (command.empty()) return std::fputs(app_.help().c_str(), stdout), 0;
  if (const CLI::App* const sub = find_command(command, app_))
    return std::fputs(sub->help("carreau").c_str(), stdout), 0;
  throw Failure(unknown_command(command, app_));
}

int CommandLine::run(int argc, char** argv) {
  const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  const std::string first = words.empty() ? "" : words.front();
  const bool json = std::find(words.begin(), words.end(), "--json") != words.end();
  try {
    if (first.empty())
      throw Failure("A command is wanted: " + command_names(app_) + ". More: carreau help, man carreau.");
    if (first == "help") return help(words.size() > 1 ? words[1] : "");
    const CLI::App* const sub = find_command(first, app_);
    if (sub == nullptr && !first.starts_with('-')) throw Failure(unknown_command(first, app_));
    try {
      app_.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      if (error.get_exit_code() == 0) return app_.exit(error), 0;
      throw Failure(sub == nullptr ? std::string(error.what()) : sentence_of(error, *sub, words));
    }
    for (std::string* repeat : {&mesh_.repeat, &plane_.repeat, &adapt_.repeat, &report_.repeat})
      *repeat = shell_line("carreau", words);
    return run_command();
  } catch (const std::bad_alloc&) {
    if (json) print_json_error(first, "there is not enough memory", unusable);
    throw;
  } catch (const std::exception& error) {
    if (json) print_json_error(first, error.what(), unusable);
    throw;
  }
}

int CommandLine::run_command() {
  if (app_.got_subcommand("mesh")) {
    mesh_.input = inputs_.front(), mesh_.more_inputs.assign(inputs_.begin() + 1, inputs_.end());
    check_scope(*app_.get_subcommand("mesh"), inputs_, mesh_, false);
    return mesh(mesh_);
  }
  if (app_.got_subcommand("plane")) return mesh(plane_);
  if (app_.got_subcommand("adapt")) {
    adapt_.plane.is_plane = is_plane_file(adapt_.input);
    check_scope(*app_.get_subcommand("adapt"), {adapt_.input}, adapt_, adapt_.plane.is_plane);
    return mesh(adapt_);
  }
  if (app_.got_subcommand("refine")) return refine(refine_);
  if (app_.got_subcommand("info")) {
    check_scope(*app_.get_subcommand("info"), {info_.input}, info_, false);
    return info(info_);
  }
  if (app_.got_subcommand("areas")) return areas(areas_);
  if (app_.got_subcommand("check")) return check(check_);
  if (app_.got_subcommand("picture")) {
    parse_picture_size(picture_size_, picture_);
    picture_.scene.paint = paint_ == "face"        ? Paint::face
                           : paint_ == "reference" ? Paint::reference
                           : paint_ == "quality"   ? Paint::quality
                           : paint_ == "size"      ? Paint::size
                                                   : Paint::none;
    picture_.labels = !label_.empty();
    if (around_.size() == 4) picture_.scene.around = {around_[0], around_[1], around_[2], around_[3]};
    if (picture_.scene.around && !(around_[3] > 0)) throw Failure("--around wants a radius above 0 as its fourth number.");
    return picture(picture_);
  }
  if (app_.got_subcommand("report")) return report(report_);
  if (app_.got_subcommand("fields")) {
    parse_field_size(field_size_, fields_);
    if (suffix_of(fields_.mesh.input) != ".env")
      check_scope(*app_.get_subcommand("fields"), {fields_.mesh.input}, fields_.mesh, false);
    return fields(fields_);
  }
  if (app_.got_subcommand("completion")) return print_completion(app_, shell_);
  return params(params_);
}

}  // namespace command
