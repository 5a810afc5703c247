// `carreau mesh`: from a CAD file to mesh files.
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>
#include <optional>

#include "cad_input.h"
#include "commands.h"
#include "output_files.h"
#include "progress.h"
#include "session_handle.h"

namespace command {
namespace {

constexpr int all_faces = 0, some_faces = 1, interrupted = 130;

// The session that a signal stops. Without one the program ends at once.
std::atomic<carreau_session*> running{nullptr};
static_assert(std::atomic<carreau_session*>::is_always_lock_free);

extern "C" void on_signal(int) {
  if (carreau_session* session = running.load()) {
    carreau_stop(session);
    return;
  }
  OutputFiles::remove_in_handler();
  _exit(interrupted);
}

void catch_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction old {};
    // Who started the program in the background wants it to go on.
    if (sigaction(signal, nullptr, &old) == 0 && old.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
}

void set(carreau_session* session, const char* name, double value) {
  require(session, carreau_set_real(session, name, value));
}

struct Sizes {
  std::optional<double> size, minimum, maximum;
};

/// Sizes of the command line in model units.
Sizes sizes_of(const MeshOptions& options, double diagonal) {
  const auto length = [&](const std::string& text, const char* name) -> std::optional<double> {
    if (text.empty()) return std::nullopt;
    return parse_length(text, name).of(diagonal);
  };
  Sizes sizes{length(options.size, "--size"), length(options.minimum, "--min"), length(options.maximum, "--max")};
  if (sizes.minimum && sizes.maximum && *sizes.minimum > *sizes.maximum)
    throw Failure("--min " + options.minimum + " is above --max " + options.maximum + ".");
  return sizes;
}

void set_sizes(carreau_session* session, const MeshOptions& options, const Sizes& sizes, double diagonal) {
  // Curvature alone governs when an angle is given without a size.
  const bool by_angle = options.angle > 0, by_size = sizes.size || !by_angle || !options.face_sizes.empty();
  const double size = sizes.size.value_or(0.02 * diagonal);
  require(session, carreau_set_integer(session, "hphy_flag", !by_size ? 0 : options.face_sizes.empty() ? 1 : 2));
  if (by_size) {
    set(session, "hphydef", size);
    // The bounds of the library are for sizes that a formula gives, not for what a person has typed.
    set(session, "hphymin", sizes.minimum.value_or(std::min(size, diagonal) * 1e-6));
    set(session, "hphymax", sizes.maximum.value_or(std::max(size, diagonal)));
  }
  if (by_angle) {
    require(session, carreau_set_integer(session, "hgeo_flag", 1));
    set(session, "angle_mesh", options.angle);
    set(session, "hgeomin", sizes.minimum.value_or(diagonal / 500));
    set(session, "hgeomax", sizes.maximum.value_or(diagonal / 5));
  }
}

void set_parameters(carreau_session* session, const MeshOptions& options, const Sizes& sizes, double diagonal) {
  set_sizes(session, options, sizes, diagonal);
  require(session, carreau_set_integer(session, "threads", options.threads));
  // Zones narrower than a twentieth of their edges would have triangles of no shape.
  require(session, carreau_set_integer(session, "CheckCloseEdges", 20));
  set(session, "CoefRectangle", 0.05);
  require(session, carreau_set_integer(session, "flag", 1));
  require(session, carreau_set_integer(session, "verb", 10));
  for (const std::string& setting : options.settings) {
    const auto [name, value] = parse_assignment(setting, "--set");
    require(session, carreau_set_word(session, name.c_str(), value.c_str()));
  }
}

/// The face that an error is about, 0: none.
std::int32_t face_of_error(carreau_session* session) {
  carreau_error_place place{};
  place.struct_size = sizeof place;
  return carreau_last_error_place(session, &place) == CARREAU_OK ? place.face : 0;
}

/// CARREAU_OK, CARREAU_ERR_PARTIAL or CARREAU_ERR_CANCELLED; throws Failure otherwise. A face whose geometry fails is
/// left out, and the others are meshed.
carreau_status generate(carreau_session* session, CadInput& input, Progress& progress) {
  for (;;) {
    require(session, input.give_to(session));
    running = session;
    const carreau_status status = carreau_mesh_generate(session);
    running = nullptr;
    if (status == CARREAU_OK || status == CARREAU_ERR_PARTIAL || status == CARREAU_ERR_CANCELLED) return status;
    std::string sentence = carreau_last_error(session);
    const bool of_a_face = status == CARREAU_ERR_CALLBACK || status == CARREAU_ERR_MODEL;
    const std::int32_t face = of_a_face ? face_of_error(session) : 0;
    const std::string why = status == CARREAU_ERR_CALLBACK ? input.failure(face) : "";
    if (!why.empty()) sentence += " (" + why + ")";
    if (!input.exclude(face, sentence)) throw Failure(sentence);
    progress.error("error: " + sentence);
    progress.line("meshing again without face " + std::to_string(face));
  }
}

/// One line: how many faces have no mesh, and which.
std::string failed_faces(carreau_mesh* mesh, const CadInput& input) {
  std::int64_t count = 0;
  require(mesh, carreau_mesh_count(mesh, nullptr, nullptr, nullptr, &count));
  std::vector<std::int32_t> failed;
  for (const auto& [number, why] : input.excluded()) failed.push_back(number);
  count += static_cast<std::int64_t>(failed.size());
  for (std::int64_t i = 0; i + static_cast<std::int64_t>(input.excluded().size()) < count; ++i) {
    carreau_face face{};
    face.struct_size = sizeof face;
    require(mesh, carreau_mesh_face(mesh, i, &face));
    if (face.status == CARREAU_FACE_FAILED) failed.push_back(face.ref);
  }
  if (failed.empty()) return "";
  std::sort(failed.begin(), failed.end());
  std::string list;
  for (std::size_t i = 0; i < failed.size() && i < 20; ++i) list += (i == 0 ? "" : ", ") + std::to_string(failed[i]);
  return std::to_string(failed.size()) + " of " + std::to_string(count) + " faces have no mesh: " + list +
         (failed.size() > 20 ? ", ..." : "");
}

const char* status_word(std::int32_t status) {
  return status == CARREAU_FACE_MESHED ? "meshed" : status == CARREAU_FACE_MENDED ? "mended" : "failed";
}

nlohmann::json quality_json(carreau_mesh* mesh) {
  carreau_quality q{};
  q.struct_size = sizeof q;
  require(mesh, carreau_mesh_quality(mesh, &q));
  return {{"vertices", q.vertices},     {"triangles", q.triangles}, {"edges", q.edges},
          {"open_edges", q.open_edges}, {"area", q.area},           {"q1_mean", q.q1_mean},
          {"q1_p1", q.q1_p1},           {"q1_min", q.q1_min},       {"q2_mean", q.q2_mean},
          {"q2_p1", q.q2_p1},           {"q2_min", q.q2_min},       {"angle_min", q.angle_min},
          {"angle_max", q.angle_max},   {"edge_min", q.edge_min},   {"edge_mean", q.edge_mean},
          {"edge_max", q.edge_max},     {"degree6", q.degree6}};
}

nlohmann::json faces_json(carreau_mesh* mesh, const CadInput& input) {
  nlohmann::json faces = nlohmann::json::array();
  std::int64_t count = 0;
  require(mesh, carreau_mesh_count(mesh, nullptr, nullptr, nullptr, &count));
  for (std::int64_t i = 0; i < count; ++i) {
    carreau_face face{};
    face.struct_size = sizeof face;
    require(mesh, carreau_mesh_face(mesh, i, &face));
    faces.push_back({{"reference", face.ref},
                     {"name", face.name},
                     {"status", status_word(face.status)},
                     {"triangles", face.triangles},
                     {"why", face.why}});
  }
  for (const auto& [number, why] : input.excluded())
    faces.push_back({{"reference", number}, {"name", ""}, {"status", "failed"}, {"triangles", 0}, {"why", why}});
  return faces;
}

/// Everything about a run that a program may want.
void print_json(carreau_session* session, carreau_mesh* mesh, const MeshOptions& options, const CadInput& input,
                double processor) {
  carreau_report r{};
  r.struct_size = sizeof r;
  require(session, carreau_session_report(session, &r));
  const nlohmann::json summary = {{"input", options.input},
                                  {"outputs", options.outputs},
                                  {"diagonal", input.diagonal()},
                                  {"closed", input.is_closed()},
                                  {"mesh", quality_json(mesh)},
                                  {"faces", faces_json(mesh, input)},
                                  {"calls",
                                   {{"surf0", r.surf0_calls},
                                    {"surf1", r.surf1_calls},
                                    {"surf2", r.surf2_calls},
                                    {"curv0", r.curv0_calls},
                                    {"curv1", r.curv1_calls},
                                    {"curv2", r.curv2_calls},
                                    {"sizes", r.size_calls}}},
                                  {"seconds",
                                   {{"curves", r.seconds_curves},
                                    {"sampling", r.seconds_sampling},
                                    {"plane", r.seconds_plane},
                                    {"lift", r.seconds_lift},
                                    {"total", r.seconds_total},
                                    {"processor", processor}}}};
  // Names may be in any encoding: what is not UTF-8 is replaced.
  std::puts(summary.dump(1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
}

}  // namespace

int mesh(const MeshOptions& options) {
  catch_signals();
  for (const std::string& each : options.face_sizes) parse_assignment(each, "--face-size");
  sizes_of(options, 1);  // words that mean nothing are told before a long reading
  OutputFiles outputs(options.outputs);
  Progress progress(options.quiet);
  progress.line("reading " + options.input);
  const std::unique_ptr<CadInput> input = open_cad(options.input);
  progress.line(input->summary());
  const double diagonal = input->diagonal();
  for (const std::string& each : options.face_sizes) {
    const auto [face, size] = parse_assignment(each, "--face-size");
    if (!input->set_face_size(face, parse_length(size, "--face-size").of(diagonal)))
      throw Failure("--face-size: there is no face '" + face + "'.");
  }
  const SessionHandle session = make_session();
  progress.listen_to(session.get());
  set_parameters(session.get(), options, sizes_of(options, diagonal), diagonal);
  for (const auto& [face, why] : input->excluded()) progress.error("error: face " + std::to_string(face) + ": " + why);
  const std::clock_t start = std::clock();
  const carreau_status status = generate(session.get(), *input, progress);
  const double processor = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  if (status == CARREAU_ERR_CANCELLED) {
    progress.error("stopped; nothing was written");
    return interrupted;
  }
  carreau_mesh* made = nullptr;
  require(session.get(), carreau_session_mesh(session.get(), &made));
  outputs.write(made);
  for (const std::string& path : options.outputs) progress.line("written " + path);
  if (options.json) print_json(session.get(), made, options, *input, processor);
  const std::string failed = failed_faces(made, *input);
  if (failed.empty()) return all_faces;
  progress.error("error: " + failed);
  return some_faces;
}

}  // namespace command
