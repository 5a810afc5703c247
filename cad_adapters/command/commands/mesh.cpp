// SPDX-License-Identifier: BSD-3-Clause
// `carreau mesh`: from geometry to mesh files.
#include <carreau_geometry.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "base/json_output.h"
#include "base/output_files.h"
#include "base/ranks.h"
#include "base/signals.h"
#include "base/text_file.h"
#include "check/part_crossings.h"
#include "commands/commands.h"
#include "files/session_handle.h"
#include "inputs/base/cad_input.h"
#include "inputs/built/plane_input.h"
#include "inputs/open_input.h"
#include "inputs/several_input.h"
#include "mesh/curve_edges.h"
#include "mesh/periodic_faces.h"
#include "mesh/failed_faces.h"
#include "mesh/groups.h"
#include "mesh/mesh_parameters.h"
#include "mesh/mesh_summary.h"
#include "mesh/progress.h"
#include "report/report_content.h"
#include "volume/engines.h"
#include "volume/fill_solids.h"
#include "volume/volume_files.h"

namespace command {
namespace {

constexpr int all_faces = 0, some_faces = 1;

// Shares of progress where a CAD file is read, and all is meshed.
constexpr double read_at = 0.1, meshed_at = 0.97;

class Stopwatch {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

bool is_report(const std::string& path) { return suffix_of(path) == ".html"; }

bool has_report(const MeshOptions& options) {
  return std::any_of(options.outputs.begin(), options.outputs.end(), is_report);
}

/// The face that an error is about, 0: none.
std::int32_t face_of_error(carreau_session* session) {
  carreau_error_place place{};
  place.struct_size = sizeof place;
  return carreau_last_error_place(session, &place) == CARREAU_OK ? place.face : 0;
}

/// References of the faces that the session has.
std::vector<std::int32_t> faces_of_model(carreau_session* session) {
  std::int64_t n = 0;
  require(session, carreau_model_count(session, &n, nullptr, nullptr));
  std::vector<std::int32_t> refs(static_cast<std::size_t>(n));
  require(session, carreau_model_faces(session, n, refs.data(), nullptr));
  return refs;
}

bool is_one_of(const std::string& suffix, std::initializer_list<const char*> list) {
  return std::find(list.begin(), list.end(), suffix) != list.end();
}

/// Rejects a format that has no such elements before anything is meshed. In .stl they are straight triangles.
void refuse_elements(carreau_session* session, const MeshOptions& options) {
  const std::vector<std::string>& outputs = options.outputs;
  for (const std::string& path : outputs)
    if (options.order > 0 && !is_one_of(suffix_of(path), {".msh", ".msh2", ".vtu", ".mesh", ".html"}))
      throw Failure("'" + path + "' cannot hold elements of order " + std::to_string(options.order) + ": .msh, .msh2, .vtu and .mesh (of MFEM) can.");
  if (options.association && std::none_of(outputs.begin(), outputs.end(), [](const std::string& path) {
        return is_one_of(suffix_of(path), {".msh", ".msh2", ".mesh", ".meshb", ".vtu"});
      }))
    throw Failure("--association requires an output .msh, .msh2, .mesh, .meshb or .vtu.");
  const char* element = nullptr;
  require(session, carreau_get_text(session, "element", &element));
  const std::string asked = element;
  for (const std::string& path : outputs) {
    if (asked != "p1" && suffix_of(path) == ".bl2d")
      throw Failure("'" + path + "' cannot hold elements " + asked + ": .bl2d holds straight triangles (p1) only.");
    if ((asked.starts_with("p2") || asked.starts_with("q2")) && is_one_of(suffix_of(path), {".su2", ".off", ".obj", ".ply", ".tri"}))
      throw Failure("'" + path + "' cannot hold elements " + asked + ": " + suffix_of(path) + " holds elements of order 1 only.");
  }
}

/// `make` makes the mesh. Throws Failure when it does not.
void generate(carreau_session* session, const MeshOptions& options, CadInput& input, const SizeMap& map,
              Adaptation& adaptation, const std::function<carreau_status()>& make, FailedFaces& failed, Progress& progress) {
  require(session, input.give_to(session));
  for (const std::string& sentence : set_groups(session, input, options.group_by, options.groups)) progress.warning(sentence);
  prescribe_curve_edges(session, options, input);
  add_layers(session, options, input);
  set_periodic(session, options, input);
  embed(session, options.embed);
  const carreau_status status = make();
  const std::string sentence = in_terms_of_file(input, carreau_last_error(session));
  for (const std::string& failure : {map.failure(), adaptation.failure()})
    if (!failure.empty()) throw Failure(failure);
  if (status == CARREAU_OK || status == CARREAU_ERR_PARTIAL) return;
  const std::int32_t face = face_of_error(session);
  if (status == CARREAU_ERR_DOMAIN)  // no face could be meshed
    for (const std::int32_t each : faces_of_model(session)) {
      if (input.whole_face(each) == each) failed.dump_without_mesh(session, input, each, progress);
    }
  else if (face != 0)
    failed.dump_without_mesh(session, input, input.whole_face(face), progress);
  throw Failure(sentence);
}

/// Meshes the geometry before a change, and carries its mesh to the geometry of the session.
carreau_status carry(const MeshOptions& options, carreau_session* session, SizeMap& map, Progress& progress) {
  const std::vector<std::string> words{"any", "reference", "name", "shape"};
  const auto match = std::find(words.begin(), words.end(), options.match) - words.begin();
  progress.line("reading " + options.carry_from);
  const std::unique_ptr<CadInput> before = open_input(options.carry_from, options, [](double) {});
  const SessionHandle other = make_session();
  set_parameters(other.get(), options, *before, map);
  require(other.get(), before->give_to(other.get()));
  prescribe_curve_edges(other.get(), options, *before);
  require(other.get(), carreau_mesh_generate(other.get()));
  carreau_mesh* mesh = nullptr;
  require(other.get(), carreau_session_mesh(other.get(), &mesh));
  return carreau_mesh_carry(session, mesh, static_cast<std::int32_t>(match));
}

/// The mesh of the session, or the part of this process.
void take_mesh(MeshRun& run, const Ranks* ranks, const Ranks::Part& part) {
  run.quality.struct_size = sizeof run.quality;
  if (part != nullptr) {
    run.mesh = ranks->mesh_of(part);
    require(run.mesh, carreau_mesh_part_quality(run.mesh, &run.quality));
  } else {
    require(run.session, carreau_session_mesh(run.session, &run.mesh));
    require(run.mesh, carreau_mesh_quality(run.mesh, &run.quality));
  }
  run.faces = faces_of(run.mesh);
  for (FaceResult& face : run.faces) face.why = in_terms_of_file(run.input, face.why);
  if (part == nullptr) require_mirrored(run.mesh, run.options, run.input, run.faces);
}

/// Warns of problems of a mesh in parts.
void warn_of_parts(const MeshRun& run, Progress& progress) {
  if (const std::string open = free_edges_of_parts(run); !open.empty()) progress.warning(open);
  if (const std::string cross = crossings_of_parts(run); !cross.empty()) progress.warning(cross);
}

void mesh_all(const MeshOptions& options, MeshRun& run, CadInput& input, SizeMap& map, Adaptation& adaptation,
              const Ranks* ranks, Ranks::Part& part, FailedFaces& failed, Progress& progress) {
  progress.listen_to(run.session, input);
  set_parameters(run.session, options, input, map);
  if (const std::string sizes = chosen_sizes(options, input); !sizes.empty()) progress.line(sizes);
  refuse_elements(run.session, options);
  for (const std::string& sentence : sizes_beyond_bounds(options, input.diagonal())) progress.warning(sentence);
  for (const std::string& sentence : contradicting_face_sizes(options, input)) progress.warning(sentence);
  constexpr std::size_t told = 20;
  const std::vector<std::string> losses = input.losses();
  for (std::size_t i = 0; i < losses.size() && i < told; ++i) progress.error(losses[i]);
  for (const std::string& note : input.notes()) progress.warning(note);
  std::int32_t by_curvature = 0;
  require(run.session, carreau_get_integer(run.session, "hgeo_flag", &by_curvature));
  if (by_curvature != 0)
    for (const std::string& kink : input.kinks()) progress.warning(kink);
  const std::clock_t start = std::clock();
  const auto make = [&] {
    if (options.parts) return ranks->generate_parts(run.session, part);
    const carreau_status status =
        options.carry_from.empty() ? adaptation.run(run.session, input.diagonal()) : carry(options, run.session, map, progress);
    if (status != CARREAU_OK && status != CARREAU_ERR_PARTIAL) return status;
    carreau_status after = options.halvings > 0 ? carreau_mesh_halve(run.session, options.halvings) : CARREAU_OK;
    if (options.order > 0 && after == CARREAU_OK)
      after = carreau_raise_order(run.session, options.order, options.nodes == "equidistant" ? CARREAU_EQUIDISTANT : CARREAU_GAUSS_LOBATTO, nullptr);
    return after == CARREAU_OK ? status : after;
  };
  generate(run.session, options, input, map, adaptation, make, failed, progress);
  run.seconds_processor = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  take_mesh(run, ranks, part);
  if (options.parts) return warn_of_parts(run, progress);
  if (const std::string open = unexpectedly_open(run); !open.empty()) progress.warning(open);
  if (!options.quiet || options.json || has_report(options)) {
    constexpr std::size_t faces_told = 10;
    run.crossings = crossings_of(run.mesh, options.threads);
    for (const std::string& sentence : sentences_of(run.crossings, faces_told)) progress.warning(sentence);
    if (run.crossings.pairs > 0)
      progress.warning("smaller triangles cross there, too: faces cross in the geometry itself, or lie at one place");
  }
  failed.dump_of_mesh(run.session, run.mesh, input, run.faces, progress);
}

/// Before anything is written: files of one run hold the same whatever their order.
void measure(carreau_session* session) {
  carreau_delivered delivered{};
  delivered.struct_size = sizeof delivered;
  require(session, carreau_session_delivered(session, &delivered));
}

/// The page about a run that was measured.
std::string page_of(const MeshRun& run) {
  ReportContent content = content_of(run.mesh, &run.crossings);
  content.file = run.options.input;
  content.repeat = run.options.repeat;
  content.mesh.faces = run.faces;
  content.asked = asked_of(run.session);
  content.run = summary_json(run, true);
  for (TriangleValues& values : surface_values(run.session, content.mesh.triangles.size()))
    content.values.push_back(std::move(values));
  return report_page(content);
}

/// Pieces that come with a file are behind the outputs in `paths`: with it they are written.
void write_all(const MeshRun& run, const Adaptation& adaptation, const std::vector<std::string>& paths,
               const Ranks* ranks, const Ranks::Part& part, Progress& progress) {
  carreau_exr_options fields{};
  fields.struct_size = sizeof fields;
  fields.longest = 256;  // a face has 26 channels: hundreds of faces must fit a disk
  fields.multi_part = 1;
  const std::size_t outputs = run.options.outputs.size();
  const double each = (1 - meshed_at) / static_cast<double>(outputs);
  double done = meshed_at;
  for (std::size_t i = 0; i < outputs; ++i) {
    const std::string& path = paths[i];
    progress.part(done, done + each);
    done += each;
    const bool alone = run.options.order > 0 || suffix_of(path) == ".exr" || suffix_of(path) == ".med" || suffix_of(path) == group_table_suffix || suffix_of(path) == ".txt" || is_solution(path) || is_report(path);
    if (part != nullptr)
      ranks->write(run.session, part, path);
    else if (ranks != nullptr && !alone)
      ranks->write(run.session, path);
    else if (is_solution(path))
      adaptation.write_fields(run.session, path, progress);  // ranks share the work, and the first one writes
    else if (ranks != nullptr && !ranks->speaks())
      continue;
    else if (suffix_of(path) == ".exr")
      require(run.session, carreau_write_exr(run.session, path.c_str(), &fields));
    else if (is_report(path))
      write_text(path, page_of(run));
    else if (suffix_of(path) == group_table_suffix)
      write_text(path, group_table(run.mesh));
    else if (run.volume_text)
      write_text(path, run.volume_text(suffix_of(path)));
    else if (suffix_of(path) == ".txt")
      write_text(path, pairs_text(run.mesh));
    else if (run.options.order > 0)
      require(run.session, carreau_raised_write(run.session, path.c_str()));
    else
      write_mesh(run.mesh, path);
  }
}

/// Only the first rank prints and gives files their names.
MeshOptions options_of_rank(const MeshOptions& given, const Ranks* ranks) {
  MeshOptions options = given;
  if (ranks == nullptr) return options;
  if (options.threads == 0) options.threads = ranks->threads();
  if (ranks->speaks()) return options;
  options.quiet = true, options.json = false;
  options.dump_failed.clear();
  return options;
}

std::unique_ptr<CadInput> opened(const MeshOptions& options, Progress& progress) {
  if (options.plane.is_plane) return open_plane(options.input, options.plane);
  if (options.embed.wires && !options.cad.loose_edges) {
    MeshOptions with_wires = options;
    with_wires.cad.loose_edges = true;
    return opened(with_wires, progress);
  }
  if (options.more_inputs.empty())
    return open_input(options.input, options, [&](double fraction) { progress.reading(fraction); });
  std::vector<std::string> all{options.input};
  all.insert(all.end(), options.more_inputs.begin(), options.more_inputs.end());
  return open_several(all, options);
}

/// Medit's files have no names of groups: a table beside each has them, when groups are asked for.
std::vector<std::string> with_group_tables(const MeshOptions& options, std::vector<std::string> outputs) {
  if ((options.groups.empty() && options.group_by.empty()) || options.parts) return outputs;
  for (const std::string& path : std::vector<std::string>(outputs))
    if (is_one_of(suffix_of(path), {".mesh", ".meshb"})) {
      const std::string table = path.substr(0, path.size() - suffix_of(path).size()) + group_table_suffix;
      if (std::find(outputs.begin(), outputs.end(), table) == outputs.end()) outputs.push_back(table);
    }
  return outputs;
}

/// Files of failed faces need the whole mesh.
void refuse_with_parts(const MeshOptions& options) {
  for (const auto& [given, name] : {std::pair{!options.dump_failed.empty(), "--dump-failed"}, {!options.carry_from.empty(), "--carry-from"},
                                    {options.halvings > 0, "--halvings"}, {options.order > 0, "--element of order 3 and 4"}, {options.association, "--association"}})
    if (given) throw Failure(std::string("--parts and ") + name + " exclude each other: no process has the whole mesh.");
  for (const std::string& path : options.outputs)
    if (!is_one_of(suffix_of(path), {".meshb", ".pvtu"}))
      throw Failure("'" + path + "' is made of the whole mesh: --parts writes .meshb and .pvtu.");
}

/// Bounds of the sizes inside solids. They grow from the surface as sizes on it do, up to the largest size there.
InnerBounds inner_bounds(carreau_session* session, const MeshOptions& options, const SizeMap& map, Progress& progress) {
  const auto real = [&](const char* name) {
    double value = 0;
    require(session, carreau_get_real(session, name, &value));
    return value;
  };
  std::int32_t physical = 0, geometric = 0;
  require(session, carreau_get_integer(session, "hphy_flag", &physical));
  require(session, carreau_get_integer(session, "hgeo_flag", &geometric));
  InnerBounds bounds;
  const auto lower = [&](double size) { bounds.largest = bounds.largest > 0 && size > 0 ? std::min(bounds.largest, size) : std::max(bounds.largest, size); };
  if (physical != 0) lower(real(map.is_empty() && options.adapt.mesh.empty() && (physical == 1 || !options.size.empty()) ? "hphydef" : "hphymax"));
  if (geometric != 0) lower(real("hgeomax"));
  constexpr double usual_growth = .3;  // of lengths by 1.3 from edge to edge
  const double gradation = real("gradation");
  bounds.growth = gradation > 1 ? gradation - 1 : usual_growth;
  if (map.is_formula()) {
    bounds.map = map.in_space();
    if (!bounds.map) progress.line("sizes      the size map uses u or v: sizes inside grow from the surface");
  }
  return bounds;
}

/// The file of the surface that no engine could fill: "part.surface.msh" beside "part.inp".
std::string kept_surface(const MeshOptions& options) {
  const std::string& path = options.outputs.front();
  return path.substr(0, path.size() - suffix_of(path).size()) + ".surface.msh";
}

/// Elements of order 3 and 4, and all nodes of order 2, are made over elements of order 2.
void choose_order(MeshOptions& options) {
  const std::string asked = options.element;
  if (options.centre_nodes) {
    if (!asked.starts_with("p2") && !asked.starts_with("q2")) throw Failure("--centre-nodes requires --element p2, q2.0 or q2.1.");
    options.order = 2;
    return;
  }
  if (asked.size() < 2 || (asked[1] != '3' && asked[1] != '4')) {
    if (options.nodes != "equidistant") throw Failure("--nodes " + options.nodes + " requires --element p3, p4, q3, q3.1, q4 or q4.1.");
    return;
  }
  if (options.volume.is_volume || options.adapt.is_adapt || options.parts)
    throw Failure("Elements " + asked + " are made by `carreau mesh` and `carreau plane` without --parts.");
  options.order = asked[1] - '0';
  options.element = asked[0] == 'p' ? "p2" : asked.ends_with(".1") ? "q2.1" : "q2.0";
}

int mesh_in(const MeshOptions& given, const Ranks* ranks) {
  Adaptation adaptation(given.adapt);
  MeshOptions options = options_of_rank(given, ranks);
  choose_order(options);
  options.outputs = with_group_tables(given, adaptation.with_fields(given.outputs));
  check_words(options);  // reports meaningless words before a long reading
  SizeMap map(options.size_map);
  if (options.plane.field > 0 && map.mesh_file().empty() && options.adapt.sol.empty() && options.plane.sizes.empty())
    throw Failure("--sol-field chooses a field of a file .sol, and no option names one.");
  if (!map.mesh_file().empty() && !options.adapt.mesh.empty())
    throw Failure("--size-map names a background mesh, and --mesh is one: only one of them can hold.");
  const std::string engine = options.volume.is_volume ? found_engine(options.volume.engine) : "";
  if (!engine.empty() && ranks != nullptr) throw Failure("carreau volume runs in one process.");
  std::vector<std::string> suffixes = engine.empty() ? mesh_suffixes : volume_suffixes;
  if (engine.empty()) suffixes.insert(suffixes.end(), {".exr", ".html"});
  suffixes.emplace_back(group_table_suffix);
  if (!options.periodic.empty() || !options.cad.mirror.empty()) suffixes.emplace_back(".txt");  // pairs
  std::vector<std::string> read = adaptation.inputs();
  if (options.adapt.is_adapt) suffixes.insert(suffixes.end(), {".sol", ".solb"});
  read.insert(read.end(), {options.input, map.mesh_file(), options.plane.sizes, options.carry_from});
  read.insert(read.end(), options.more_inputs.begin(), options.more_inputs.end());
  if (given.parts) refuse_with_parts(given);  // on all ranks
  if (ranks != nullptr) suffixes.emplace_back(".pvtu");
  const std::vector<std::string> files = ranks != nullptr ? ranks->all_files(options.outputs) : options.outputs;
  OutputFiles outputs(files, suffixes, read);
  require_writers(files);
  FailedFaces dumped(options.dump_failed);
  Progress progress(options.quiet);
  std::string names = options.input;
  for (const std::string& more : options.more_inputs) names += ", " + more;
  progress.line("reading " + names);
  progress.part(0, read_at);
  const Stopwatch reading;
  const std::unique_ptr<CadInput> input = opened(options, progress);
  const SessionHandle session = make_session();
  if (options.plane.field > 0) require(session.get(), carreau_set_integer(session.get(), "sol_field", options.plane.field));
  if (ranks != nullptr && !options.parts) ranks->attach(session.get());
  Ranks::Part part;
  MeshRun run{.options = options, .input = *input, .session = session.get(), .faces = {}, .dumped = {}};
  run.adaptation = &adaptation;
  run.seconds_reading = reading.seconds();
  progress.part(progress.reached() > 0 ? read_at : 0, meshed_at);
  progress.line(input->summary());
  for (const std::string& line : input->small_features()) progress.line(line);
  try {
    mesh_all(options, run, *input, map, adaptation, ranks, part, dumped, progress);
  } catch (const Failure&) {
    for (const std::string& path : dumped.files()) progress.line("dumped     " + path);
    throw;
  }
  run.dumped = dumped.files();
  const std::string failed = failed_faces(run.faces), lost = lost_entities(*input);
  const bool any =
      std::any_of(run.faces.begin(), run.faces.end(), [](const FaceResult& face) { return face.triangles > 0; });
  if (!any && (!failed.empty() || !input->is_wires())) throw Failure(failed.empty() ? "There is no triangle." : failed);
  if (part == nullptr && (!options.quiet || options.json || has_report(options))) run.short_edges = find_short_edges(run.session, run.mesh, run.quality);
  std::optional<VolumeMesh> volume;
  if (!engine.empty()) {
    if (!failed.empty()) throw Failure("No engine can fill the mesh: " + failed);
    volume = fill_solids(run.mesh, options, engine, inner_bounds(run.session, options, map, progress), kept_surface(options), progress);
    run.volume_text = [&](const std::string& suffix) { return volume_text(*volume, suffix); };
  }
  run.warnings = progress.warnings();
  if (has_report(options)) measure(run.session);
  const Stopwatch writing;
  const auto write = [&](const std::vector<std::string>& paths) { write_all(run, adaptation, paths, ranks, part, progress); };
  if (ranks == nullptr || ranks->speaks())
    outputs.write(write);
  else
    write(files);
  run.seconds_writing = writing.seconds();
  if (!given.quiet) {  // silent ranks share the work
    const std::string line = part != nullptr ? "" : input->of_mesh(run.session);
    for (const std::string& before : part != nullptr ? part_lines(run, ranks->size()) : summary_lines(run)) progress.line(before);
    if (!line.empty()) progress.line(line);
    progress.attention("crossing", part != nullptr ? crossing_lines_of_parts(run) : crossing_lines(run.crossings, *input));  // shown last
  }
  if (volume)
    for (const std::string& line : volume_lines(*volume)) progress.line(line);
  run.warnings = progress.warnings();
  if (options.json && volume) {
    nlohmann::ordered_json json = summary_json(run, false);
    json["volume"] = volume_json(*volume);
    print_json("volume", json);
  } else if (options.json && part != nullptr) {
    print_json("mesh", part_json(run, ranks->size()));
  } else if (options.json) {
    print_json(run);
  }
  const std::string bare = part == nullptr ? missing_rows(run.session, options) : "";
  if (failed.empty() && lost.empty() && bare.empty()) return all_faces;
  for (const std::string& sentence : {lost, bare, failed})
    if (!sentence.empty()) progress.error(sentence);
  return some_faces;
}

}  // namespace

int mesh(const MeshOptions& options) {
  catch_signals();
  const std::unique_ptr<Ranks> ranks = Ranks::join(options.outputs, options.parts);
  if (!ranks) return mesh_in(options, nullptr);
  std::string why;
  try {
    return ranks->leave(mesh_in(options, ranks.get()));
  } catch (const std::bad_alloc&) {
    why = "there is not enough memory";
  } catch (const std::exception& error) {
    why = error.what();
  }
  return ranks->leave_failed(why);
}

}  // namespace command
