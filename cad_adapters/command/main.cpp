// carreau: pictures and checks of meshes, and the list of parameters. Exit codes: 0 done, 1 the mesh has defects,
// 2 the command line or a file cannot be used.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>

#include "commands.h"

namespace {

void parse_size(const std::string& text, int& width, int& height) {
  int end = 0;
  if (std::sscanf(text.c_str(), "%dx%d%n", &width, &height, &end) != 2 || end != static_cast<int>(text.size()) ||
      width < 16 || height < 16 || width > 20000 || height > 20000)
    throw command::Failure("The size '" + text + "' is not WIDTHxHEIGHT with numbers from 16 to 20000.");
}

int run(int argc, char** argv) {
  CLI::App app{"Meshes of surfaces made of parametric patches: pictures, checks, parameters.", "carreau"};
  app.set_version_flag("--version", std::string("carreau ") + carreau_version());
  app.require_subcommand(1);
  app.footer("Exit codes: 0 done, 1 the mesh has defects, 2 wrong command line or file. Manual: man carreau");

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

  std::string name;
  CLI::App* params =
      app.add_subcommand("params", "List the parameters with types, defaults, ranges and a line of help");
  params->add_option("NAME", name, "One parameter only");

  const std::string first = argc > 1 ? argv[1] : "-";
  if (first[0] != '-' && first != "picture" && first != "check" && first != "params")
    throw command::Failure("There is no command '" + first + "'; there are picture, check and params.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (*picture) {
    parse_size(size, options.width, options.height);
    using command::Paint;
    options.scene.paint = paint == "face" ? Paint::face : paint == "quality" ? Paint::quality : Paint::none;
    return command::picture(options);
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
