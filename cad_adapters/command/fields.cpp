#include <algorithm>
#include <array>
#include <cstdio>
#include <thread>

#include "cad_input.h"
#include "commands.h"
#include "lengths.h"
#include "output_files.h"
#include "session_handle.h"
#include "shared_host.h"
#include "signals.h"
#include "text_file.h"

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
                            Group{"mask", CARREAU_EXR_MASK},           Group{"preview", CARREAU_EXR_PREVIEW}};

bool is_env(const FieldsOptions& options) { return suffix_of(options.input) == ".env"; }
bool is_pardom(const FieldsOptions& options) { return suffix_of(options.input) == ".pardom"; }

void check(const FieldsOptions& options) {
  if (suffix_of(options.out) != ".exr") throw Failure("The output '" + options.out + "' does not end in .exr.");
  const bool needs_host = is_env(options) || is_pardom(options);
  if (needs_host && options.host.empty())
    throw Failure("'" + options.input + "' has no geometry: --host names the shared library that has.");
  if (!needs_host && !options.host.empty())
    throw Failure("--host goes with a .pardom or .env file, not with '" + options.input + "'.");
  if (is_env(options) && options.raw) throw Failure("A .env file meshes: --raw does not go with it.");
  if (is_env(options) && !options.settings.empty())
    throw Failure("A .env file sets its parameters itself: --set does not go with it.");
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
  exr.threads =
      options.threads > 0 ? options.threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return exr;
}

void set(carreau_session* session, const std::string& setting) {
  const auto [name, value] = parse_assignment(setting, "--set");
  require(session, carreau_set_word(session, name.c_str(), value.c_str()));
}

carreau_status make_mesh(carreau_session* session, const FieldsOptions& options) {
  if (is_env(options)) return carreau_run_env(session, options.input.c_str());
  require(session, carreau_set_integer(session, "threads", options.threads));
  for (const std::string& setting : options.settings) set(session, setting);
  if (is_pardom(options)) require(session, carreau_model_read_pardom(session, options.input.c_str()));
  return options.raw ? CARREAU_OK : carreau_mesh_generate(session);
}

/// The files that the library makes of options.out.
std::vector<std::string> names_of_files(carreau_session* session, const FieldsOptions& options) {
  if (options.face != 0 || options.multi_part) return {options.out};
  std::int64_t count = 0;
  require(session, carreau_model_count(session, &count, nullptr, nullptr));
  std::vector<std::int32_t> refs(static_cast<std::size_t>(count));
  require(session, carreau_model_faces(session, count, refs.data(), nullptr));
  const std::string stem = options.out.substr(0, options.out.size() - 4);
  std::vector<std::string> names;
  for (const std::int32_t ref : refs) names.push_back(stem + ".face." + std::to_string(ref) + ".exr");
  return names;
}

void write_files(carreau_session* session, const FieldsOptions& options) {
  const carreau_exr_options exr = exr_options(options);
  const std::vector<std::string> names = names_of_files(session, options);
  if (names.empty()) throw Failure("'" + options.input + "' has no face.");
  const std::string name = options.out.substr(options.out.find_last_of('/') + 1);
  OutputFiles(names, {".exr"}).write([&](const std::vector<std::string>& hidden) {
    const std::string folder = hidden.front().substr(0, hidden.front().find_last_of('/') + 1);
    require(session, carreau_write_exr(session, (folder + name).c_str(), &exr));
  });
  for (const std::string& each : names) std::printf("%s\n", each.c_str());
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
  std::unique_ptr<CadInput> shape;  // outlives the session
  const SessionHandle handle = make_session();
  carreau_session* session = handle.get();
  if (options.host.empty()) {
    shape = open_input(options.input, "");
    require(session, shape->give_to(session));
  } else {
    const SharedHost host(options.host);
    require(session, carreau_set_cad_m(session, &host.routines()));
  }
  const carreau_status status = make_mesh(session, options);
  if (status != CARREAU_OK) {
    std::int64_t faces = 0;
    const std::string sentence = carreau_last_error(session);
    if (carreau_model_count(session, &faces, nullptr, nullptr) != CARREAU_OK || faces == 0) throw Failure(sentence);
    std::fprintf(stderr, "carreau: %s\n", sentence.c_str());
  }
  write_files(session, options);
  return status == CARREAU_OK ? 0 : 1;
}

}  // namespace command
