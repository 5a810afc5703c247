// carreau: meshes of CAD files, pictures and checks of meshes, fields that govern them, and the list of parameters.
// Exit codes: 0 done, 1 the mesh has defects or lacks faces, 2 the command line or a file cannot be used.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <string>

#include "cad_input.h"
#include "commands.h"

namespace {

void parse_size(const std::string& text, int& width, int& height) {
  int end = 0;
  if (std::sscanf(text.c_str(), "%dx%d%n", &width, &height, &end) != 2 || end != static_cast<int>(text.size()) ||
      width < 16 || height < 16 || width > 20000 || height > 20000)
    throw command::Failure("The size '" + text + "' is not WIDTHxHEIGHT with numbers from 16 to 20000.");
}

/// "800x600", or the longer side alone.
void parse_field_size(const std::string& text, command::FieldsOptions& options) {
  int end = 0;
  if (std::sscanf(text.c_str(), "%dx%d%n", &options.width, &options.height, &end) == 2 &&
      end == static_cast<int>(text.size()) && options.width > 0 && options.height > 0)
    return;
  options.width = options.height = 0;
  if (std::sscanf(text.c_str(), "%d%n", &options.longest, &end) != 1 || end != static_cast<int>(text.size()) ||
      options.longest < 1)
    throw command::Failure("The size '" + text + "' is neither a number of pixels nor WIDTHxHEIGHT.");
}

CLI::App* add_fields(CLI::App& app, command::FieldsOptions& options, std::string& size) {
  CLI::App* fields = app.add_subcommand("fields", "Mesh, and write what governed the mesh as OpenEXR images");
  fields->add_option("INPUT", options.input, "CAD file, .pardom, or .env whose actions are run")->required();
  fields->add_option("--host", options.host,
                     "Geometry of a .pardom or .env: a shared library with the routines of cad_m");
  fields->add_option("-o,--output", options.out, "File .exr; a file a face: NAME.face.REF.exr")->required();
  fields->add_option("--size", size, "Pixels of the longer side, or WIDTHxHEIGHT")->capture_default_str();
  fields->add_option("--face", options.face, "Only this face, into the file as it is named")
      ->check(CLI::PositiveNumber);
  fields->add_flag("--multi-part", options.multi_part, "All faces into one file, a part each");
  fields->add_option("--channels", options.channels, "Groups of channels, separated by commas; all by default")
      ->delimiter(',')
      ->check(CLI::IsMember(command::field_groups()))
      ->allow_extra_args(false);
  fields->add_flag("--piz", options.piz, "PIZ in place of ZIP; both are lossless");
  fields->add_flag("--raw", options.raw, "What the geometry answers, without a mesh");
  fields->add_option("--set", options.settings, "NAME=VALUE of a parameter; may be repeated")->allow_extra_args(false);
  fields->add_option("--threads", options.threads, "0: one for each processor")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  return fields;
}

CLI::App* add_mesh(CLI::App& app, command::MeshOptions& options) {
  CLI::App* mesh = app.add_subcommand("mesh", "Mesh the faces of a CAD file, Bezier patches, or a .pardom");
  mesh->add_option("INPUT", options.input,
                   "File .step, .stp, .iges, .igs, .brep, .brp, .bpt (Bezier patches) or .pardom (with --host)")
      ->required();
  mesh->add_option("--host", options.host, "Geometry of a .pardom: a shared library with the routines of cad_m");
  mesh->add_option("-o,--output", options.outputs,
                   "File to write: .mesh, .meshb, .vtu, .stl, .msh (Gmsh 4.1), .msh2 (2.2) or .exr (fields); may be "
                   "repeated")
      ->required()
      ->allow_extra_args(false);
  mesh->add_option("--size", options.size,
                   "Length of edges, or a share of the model's diagonal such as 1%; 2% when "
                   "neither a size nor an angle is given");
  mesh->add_option("--angle", options.angle, "Degrees between the mesh and its surfaces: sizes follow the curvature")
      ->check(CLI::Range(0.01, 89.0));
  mesh->add_option("--chord", options.chord,
                   "Distance between the mesh and its surfaces, a length or a share: sizes follow the curvature");
  mesh->add_flag("--anisotropic{1000}", options.anisotropy,
                 "Sizes that follow the curvature differ by direction, by at most =RATIO (1000)")
      ->check(CLI::Range(1.0, 1e9));
  mesh->add_option("--gradation", options.gradation, "Sizes grow by at most this ratio from one edge to the next")
      ->check(CLI::Range(1.0001, 1e9));
  mesh->add_option("--size-map", options.size_map,
                   "Sizes by a formula in x, y, z, u, v, or by a background mesh: file .mesh(b) with a .sol(b) beside");
  mesh->add_option("--env", options.env, "Parameters from a blsurf.env, up to its first action; options win");
  mesh->add_option("--min", options.minimum, "Smallest size, a length or a share");
  mesh->add_option("--max", options.maximum, "Largest size, a length or a share");
  mesh->add_option("--face-size", options.face_sizes, "FACE=LENGTH, the size on a face given by number or name")
      ->allow_extra_args(false);
  mesh->add_option("--set", options.settings, "NAME=VALUE, any parameter that `carreau params` lists")
      ->allow_extra_args(false);
  mesh->add_option("--threads", options.threads, "Threads to use, 0: all cores; the mesh does not depend on it")
      ->check(CLI::Range(0, 1024));
  mesh->add_flag("-q,--quiet", options.quiet, "Tell errors only");
  mesh->add_flag("--json", options.json, "Print a summary as JSON on the standard output");
  return mesh;
}

int run(int argc, char** argv) {
  CLI::App app{"Meshes of surfaces made of parametric patches.", "carreau"};
  app.set_version_flag("--version", std::string("carreau ") + carreau_version());
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 1 the mesh has defects or lacks faces, 2 wrong command line or file. Manual: man carreau");

  command::PictureOptions options;
  std::string size = "1200x900";
  CLI::App* picture = app.add_subcommand("picture", "Draw a mesh into a PNG file");
  picture->add_option("MESH", options.mesh, "File .mesh or .meshb")->required();
  picture->add_option("-o,--output", options.out, "File to write")->required();
  picture->add_option("--size", size, "WIDTHxHEIGHT in pixels")->capture_default_str();
  picture
      ->add_option("--view", options.views,
                   "iso, front, back, left, right, top, bottom, or a direction x,y,z from the mesh to the eye; may be "
                   "repeated")
      ->allow_extra_args(false);
  std::string paint = "face";
  picture->add_option("--color", paint, "face: a colour a reference; quality: red 0 to green 1; none: grey")
      ->check(CLI::IsMember({"face", "quality", "none"}))
      ->capture_default_str();
  picture->add_flag("--edges,!--no-edges", options.scene.edges,
                    "Draw the sides of triangles or not; they are by default");
  picture->add_option("--samples", options.samples, "Points a pixel in each direction")
      ->check(CLI::Range(1, 8))
      ->capture_default_str();

  std::string mesh;
  bool closed = false;
  int limit = 20;
  CLI::App* check = app.add_subcommand("check", "Print counts, quality and defects of a mesh");
  check->add_option("MESH", mesh, "File .mesh or .meshb")->required();
  check->add_flag("--closed", closed, "An edge with one triangle is a defect too");
  check->add_option("--limit", limit, "Defects to look for")->check(CLI::PositiveNumber)->capture_default_str();

  command::FieldsOptions field_options;
  std::string field_size = "1024";
  CLI::App* fields = add_fields(app, field_options, field_size);
  std::string part;
  int each = 10;
  CLI::App* info = app.add_subcommand("info", "Print what a CAD file holds and what of it is hard to mesh");
  info->add_option("INPUT", part, "File .step, .stp, .iges, .igs, .brep or .brp")->required();
  info->add_option("--limit", each, "Sentences of each kind")->check(CLI::PositiveNumber)->capture_default_str();

  command::MeshOptions mesh_options;
  CLI::App* mesh_command = add_mesh(app, mesh_options);

  std::string name;
  CLI::App* params =
      app.add_subcommand("params", "List the parameters with types, defaults, ranges and a line of help");
  params->add_option("NAME", name, "One parameter only");

  const std::string first = argc > 1 ? argv[1] : "-";
  const std::string known[] = {"mesh", "info", "picture", "check", "fields", "params"};
  if (first[0] != '-' && std::find(std::begin(known), std::end(known), first) == std::end(known))
    throw command::Failure("There is no command '" + first +
                           "'; there are mesh, info, picture, check, fields and params.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (*info) return command::print_cad_info(part, each);
  if (*mesh_command) return command::mesh(mesh_options);
  if (*picture) {
    parse_size(size, options.width, options.height);
    using command::Paint;
    options.scene.paint = paint == "face" ? Paint::face : paint == "quality" ? Paint::quality : Paint::none;
    return command::picture(options);
  }
  if (*fields) {
    parse_field_size(field_size, field_options);
    return command::fields(field_options);
  }
  if (*check) return command::check(mesh, closed, limit);
  return command::params(name);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "carreau: %s\n", error.what());
    return 2;
  }
}
