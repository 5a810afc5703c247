// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "base/json_output.h"
#include "base/output_files.h"
#include "base/signals.h"
#include "base/text_file.h"
#include "commands/commands.h"
#include "files/session_handle.h"
#include "inputs/base/cad_input.h"
#include "inputs/host/shared_host.h"
#include "inputs/open_input.h"
#include "mesh/curve_edges.h"
#include "mesh/periodic_faces.h"
#include "mesh/mesh_parameters.h"

namespace command {

namespace {

struct Group {
  const char* name;
  std::int32_t bit;
};
constexpr std::array groups{Group{"size", CARREAU_EXR_SIZE},           Group{"induced", CARREAU_EXR_INDUCED},
                            Group{"target", CARREAU_EXR_TARGET},       Group{"curvature", CARREAU_EXR_CURVATURE},
                            Group{"position", CARREAU_EXR_POSITION},   Group{"normal", CARREAU_EXR_NORMAL},
                            Group{"deviation", CARREAU_EXR_DEVIATION}, Group{"triangle", CARREAU_EXR_TRIANGLE},
                            Group{"mask", CARREAU_EXR_MASK},           Group{"preview", CARREAU_EXR_PREVIEW},
                            Group{"governs", CARREAU_EXR_GOVERNS}};

bool is_env(const FieldsOptions& options) { return suffix_of(options.mesh.input) == ".env"; }
bool is_picture(const std::string& path) { return suffix_of(path) == ".png"; }

/// An option of meshes that was given, "" without any.
std::string mesh_option_of(const MeshOptions& m) {
  const std::pair<const char*, bool> given[] = {{"--size", !m.size.empty()},
                                                {"--size-map", !m.size_map.empty()},
                                                {"--sol-field", m.plane.field > 0},
                                                {"--angle", m.angle > 0},
                                                {"--chord", !m.chord.empty()},
                                                {"--gradation", m.gradation.has_value()},
                                                {"--anisotropic", m.anisotropy > 0},
                                                {"--min", !m.minimum.empty()},
                                                {"--max", !m.maximum.empty()},
                                                {"--face-size", !m.face_sizes.empty()},
                                                {"--curve-edges", !m.curve_edges.empty()},
                                                {"--curve-vertices", !m.curve_vertices.empty()},
                                                {"--env", !m.env.empty()},
                                                {"--effort", m.effort.has_value()},
                                                {"--set", !m.settings.empty()}};
  for (const auto& [name, is_given] : given)
    if (is_given) return name;
  return "";
}

void check(const FieldsOptions& options) {
  const MeshOptions& m = options.mesh;
  for (const std::string& out : m.outputs) {
    if (suffix_of(out) != ".exr" && !is_picture(out))
      throw Failure("The output '" + out + "' ends neither in .exr nor in .png.");
    if (is_picture(out) && options.multi_part)
      throw Failure("--multi-part: a .png file holds one face, not all as '" + out + "' should.");
  }
  const bool has_geometry = !is_env(options) && !needs_host(m.input);
  if (!has_geometry && m.host.empty())
    throw Failure("'" + m.input + "' has no geometry: --host names the shared library that has.");
  if (has_geometry && !m.host.empty())
    throw Failure("--host goes with a .pardom or .env file, not with '" + m.input + "'.");
  if (is_env(options) && options.raw) throw Failure("A .env file meshes: --raw does not go with it.");
  if (const std::string option = mesh_option_of(m); is_env(options) && !option.empty())
    throw Failure("A .env file sets its parameters itself: " + option + " does not go with it.");
  if (!is_env(options)) check_words(m);
}

carreau_exr_options exr_options(const FieldsOptions& options) {
  carreau_exr_options exr{};
  exr.struct_size = sizeof exr;
  exr.longest = options.longest;
  exr.width = options.width;
  exr.height = options.height;
  for (const std::string& name : options.channels) {
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& g) { return name == g.name; });
    exr.channels |= group->bit;  // main.cpp lets no other name through
  }
  exr.face = options.face;
  exr.multi_part = options.multi_part ? 1 : 0;
  exr.raw = options.raw ? 1 : 0;
  exr.compression = options.piz ? CARREAU_EXR_PIZ : CARREAU_EXR_ZIP;
  exr.threads = options.mesh.threads > 0 ? options.mesh.threads
                                         : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return exr;
}

/// As `carreau mesh` does it.
carreau_status make_mesh(carreau_session* session, const FieldsOptions& options, CadInput& input, SizeMap& map) {
  set_parameters(session, options.mesh, input, map);
  require(session, input.give_to(session));
  prescribe_curve_edges(session, options.mesh, input);
  add_layers(session, options.mesh, input);
  set_periodic(session, options.mesh, input);
  embed(session, options.mesh.embed);
  if (options.raw) return CARREAU_OK;
  const carreau_status status = carreau_mesh_generate(session);
  if (!map.failure().empty()) throw Failure(map.failure());
  return status;
}

/// The files that the library makes of a name.
std::vector<std::string> names_of_files(carreau_session* session, const FieldsOptions& options,
                                        const std::string& out) {
  if (options.face != 0 || options.multi_part) return {out};
  std::int64_t count = 0;
  require(session, carreau_model_count(session, &count, nullptr, nullptr));
  std::vector<std::int32_t> refs(static_cast<std::size_t>(count));
  require(session, carreau_model_faces(session, count, refs.data(), nullptr));
  const std::string stem = out.substr(0, out.size() - 4);
  std::vector<std::string> names;
  for (const std::int32_t ref : refs)
    names.push_back(stem + ".face." + std::to_string(ref) + out.substr(out.size() - 4));
  return names;
}

std::vector<std::string> write_files(carreau_session* session, const FieldsOptions& options, const std::string& out) {
  const carreau_exr_options exr = exr_options(options);
  const std::vector<std::string> names = names_of_files(session, options, out);
  if (names.empty()) throw Failure("'" + options.mesh.input + "' has no face.");
  const std::string name = out.substr(out.find_last_of('/') + 1);
  OutputFiles(names, {".exr", ".png"}).write([&](const std::vector<std::string>& hidden) {
    const std::string folder = hidden.front().substr(0, hidden.front().find_last_of('/') + 1);
    require(session, carreau_write_exr(session, (folder + name).c_str(), &exr));
  });
  if (!options.mesh.quiet && !options.mesh.json)
    for (const std::string& each : names) std::printf("%s\n", each.c_str());
  return names;
}

/// The sentence of a mesh that is not whole. Throws Failure when there is no model to show either.
std::string sentence_of_failure(carreau_session* session) {
  std::int64_t faces = 0;
  const std::string sentence = carreau_last_error(session);
  if (carreau_model_count(session, &faces, nullptr, nullptr) != CARREAU_OK || faces == 0) throw Failure(sentence);
  std::fprintf(stderr, "carreau: %s\n", sentence.c_str());
  return sentence;
}

}  // namespace

std::vector<std::string> field_groups() {
  std::vector<std::string> names;
  for (const Group& group : groups) names.emplace_back(group.name);
  return names;
}

int fields(const FieldsOptions& options) {
  catch_signals();
  check(options);
  SizeMap map(options.mesh.size_map);
  std::unique_ptr<CadInput> shape;  // outlives the session
  const SessionHandle handle = make_session();
  carreau_session* session = handle.get();
  if (options.mesh.plane.field > 0) require(session, carreau_set_integer(session, "sol_field", options.mesh.plane.field));
  carreau_status status = CARREAU_OK;
  if (is_env(options)) {
    const SharedHost host(options.mesh.host);
    require(session, carreau_set_cad_m(session, &host.routines()));
    status = carreau_run_env(session, options.mesh.input.c_str());
  } else {
    shape = open_input(options.mesh.input, options.mesh);
    status = make_mesh(session, options, *shape, map);
  }
  const std::string why = status == CARREAU_OK ? "" : sentence_of_failure(session);
  std::vector<std::string> files;
  for (const std::string& out : options.mesh.outputs)
    for (std::string& each : write_files(session, options, out)) files.push_back(std::move(each));
  if (options.mesh.json)
    print_json("fields", {{"input", options.mesh.input}, {"files", files}, {"complete", why.empty()}, {"why", why}});
  return why.empty() ? 0 : 1;
}

}  // namespace command
