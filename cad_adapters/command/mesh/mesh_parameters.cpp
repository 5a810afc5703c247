// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/mesh_parameters.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <optional>
#include <set>
#include <thread>

#include "base/lengths.h"
#include "base/parameters.h"
#include "base/suggestions.h"
#include "base/text_file.h"
#include "files/session_handle.h"
#include "mesh/curve_edges.h"
#include "mesh/near.h"
#include "mesh/periodic_faces.h"
#include "mesh/selection.h"
#include "mesh/sizes_file.h"

namespace command {
namespace {

void set(carreau_session* session, const char* name, double value) {
  require(session, carreau_set_real(session, name, value));
}
void set(carreau_session* session, const char* name, std::int32_t value) {
  require(session, carreau_set_integer(session, name, value));
}

double real(carreau_session* session, const char* name) {
  double value = 0;
  require(session, carreau_get_real(session, name, &value));
  return value;
}

/// Faces narrower than this share of the size are left to flat triangles: no edge is cut for them.
constexpr double narrower_than_cuts = 4e-4;

/// Default gradation of sizes by direction (the papers' value).
constexpr double usual_gradation = 1.3;

/// Sizes of a CAD file when none is given: 12 edges on a circle, flat faces of 20 edges across, fillets down to a thousandth of the part.
constexpr double usual_angle = 15, usual_largest = 0.05, usual_smallest = 1.0 / 2000;

/// Lengths of the command line in model units.
struct Lengths {
  std::optional<double> size, minimum, maximum, chord;
};

Lengths lengths_of(const MeshOptions& options, double diagonal) {
  const auto length = [&](const std::string& text, const char* name) -> std::optional<double> {
    if (text.empty()) return std::nullopt;
    return parse_length(text, name).of(diagonal);
  };
  Lengths lengths{length(options.size, "--size"), length(options.minimum, "--min"), length(options.maximum, "--max"),
                  length(options.chord, "--chord")};
  return lengths;
}

void refuse_contradictions(const MeshOptions& options, const Lengths& lengths) {
  if (lengths.minimum && lengths.maximum && *lengths.minimum > *lengths.maximum)
    throw Failure("--min " + options.minimum + " is above --max " + options.maximum + ".");
}

/// A length parameter that is neither set nor known before the first mesh has no value yet.
bool is_set(carreau_session* session, const char* name) {
  double value = 0;
  return carreau_get_real(session, name, &value) == CARREAU_OK;
}

/// The size where no option gives one: attractors go beside sizes by curvature.
double usual_size(carreau_session* session, const MeshOptions& options, double diagonal) {
  std::int32_t by_curvature = 0;
  require(session, carreau_get_integer(session, "hgeo_flag", &by_curvature));
  return options.near.empty() || by_curvature == 0 ? 0.02 * diagonal : real(session, "hgeomax");
}

void set_physical_sizes(carreau_session* session, const MeshOptions& options, const Lengths& lengths,
                        const CadInput& input) {
  const double diagonal = input.diagonal();
  const bool rules = !options.face_sizes.empty() || !options.sizes_on.empty();
  const bool by_face = (rules && input.answers_face_sizes()) || input.has_sizes();
  set(session, "hphy_flag", by_face ? 2 : 1);
  if (lengths.size || !is_set(session, "hphydef")) set(session, "hphydef", lengths.size.value_or(usual_size(session, options, diagonal)));
  double size = 0;
  require(session, carreau_get_real(session, "hphydef", &size));
  // The bounds of the library are for sizes that a formula gives, not for typed sizes.
  if (!is_set(session, "hphymin")) set(session, "hphymin", std::min(size, diagonal) * 1e-6);
  // Beside a map, a size that was typed is an upper bound.
  const bool by_fields = !options.adapt.mesh.empty();
  const bool bounds_map = lengths.size && (!options.size_map.empty() || input.has_sizes() || by_fields);
  if (bounds_map && (!lengths.maximum || *lengths.maximum > size))
    set(session, "hphymax", size);
  else if (!is_set(session, "hphymax"))
    set(session, "hphymax", std::max(size, diagonal));
}

void set_geometric_sizes(carreau_session* session, const MeshOptions& options, const Lengths& lengths,
                         const CadInput& input) {
  const double diagonal = input.diagonal();
  // An atlas answers with radii of its surface alone: bends of its borders inside the surface need no short edges.
  set(session, "hgeo_flag", input.has_arbitrary_borders() ? 2 : 1);
  if (options.angle > 0) set(session, "angle_mesh", options.angle);
  if (lengths.chord) {
    set(session, "eps_chord", *lengths.chord);
    set(session, "geo_guarantee", 1);  // a distance that was typed is a bound, not an aim
    require(session, carreau_set_text(session, "geo_rule", options.angle > 0 ? "both" : "chord"));
  }
  if (!is_set(session, "hgeomin")) set(session, "hgeomin", diagonal / 500);
  if (!is_set(session, "hgeomax")) set(session, "hgeomax", diagonal / 5);
}

bool asks_for(const MeshOptions& options, const std::string& name) {
  return std::any_of(options.settings.begin(), options.settings.end(),
                     [&](const std::string& each) { return parse_assignment(each, "--set").first == name; });
}

/// No option, parameter or file prescribes a size, and the input is a CAD file.
bool has_usual_sizes(const MeshOptions& options) {
  constexpr std::array suffixes = {".step", ".stp", ".iges", ".igs", ".brep", ".brp"};
  constexpr std::array prescribing = {"hphydef", "hphy_flag", "hgeo_flag", "angle_mesh", "eps_chord", "background_mesh"};
  const std::string suffix = suffix_of(options.input);
  return std::find(suffixes.begin(), suffixes.end(), suffix) != suffixes.end() && options.size.empty() && options.size_map.empty() &&
         options.angle == 0 && options.chord.empty() && options.face_sizes.empty() && options.sizes_on.empty() && options.env.empty() && !options.adapt.is_adapt && !options.parts &&
         std::none_of(prescribing.begin(), prescribing.end(), [&](const char* name) { return asks_for(options, name); });
}

void set_usual_sizes(carreau_session* session, const MeshOptions& options, const Lengths& lengths, double diagonal) {
  set(session, "hphy_flag", 0);
  set(session, "hgeo_flag", 1);
  set(session, "angle_mesh", usual_angle);
  set(session, "hgeomin", lengths.minimum.value_or(std::min(diagonal * usual_smallest, lengths.maximum.value_or(diagonal))));
  set(session, "hgeomax", lengths.maximum.value_or(std::max(diagonal * usual_largest, lengths.minimum.value_or(0))));
  if (!options.gradation) set(session, "gradation", usual_gradation);
}

void set_sizes(carreau_session* session, const MeshOptions& options, const Lengths& lengths, const CadInput& input) {
  for (const auto& [bound, names] : {std::pair{lengths.minimum, std::array{"hphymin", "hgeomin"}},
                                     std::pair{lengths.maximum, std::array{"hphymax", "hgeomax"}}})
    for (const char* name : names)
      if (bound) set(session, name, *bound);
  const bool usual = has_usual_sizes(options) && !input.has_sizes();
  if (usual) set_usual_sizes(session, options, lengths, input.diagonal());
  const bool by_curvature = options.angle > 0 || lengths.chord;
  if (by_curvature) set_geometric_sizes(session, options, lengths, input);
  const bool sizes_typed = lengths.size || !options.face_sizes.empty() || !options.sizes_on.empty() || !options.size_map.empty() || input.has_sizes() ||
                           options.adapt.is_adapt || !options.near.empty();
  if (sizes_typed || (options.env.empty() && !by_curvature && !usual))
    set_physical_sizes(session, options, lengths, input);
  else if (options.env.empty() && !usual)
    set(session, "hphy_flag", 0);  // the curvature alone governs
  if (options.anisotropy > 0) {
    std::int32_t by_geometry = 0;
    require(session, carreau_get_integer(session, "hgeo_flag", &by_geometry));
    if (by_geometry == 0)
      throw Failure("--anisotropic stretches sizes that follow the curvature: it goes with --angle or --chord.");
    set(session, "geo_metric", 1);
    set(session, "anisotropy_max", options.anisotropy);
    // If sizes jump from face to face, stretched triangles leave half of all lengths out of range.
    if (real(session, "gradation") == 0) set(session, "gradation", usual_gradation);
  }
  if (options.gradation) set(session, "gradation", *options.gradation);
}

/// "1%" of a parameter that is a model length.
bool is_share(const std::string& name, const std::string& value) {
  if (value.empty() || value.back() != '%') return false;
  const std::vector<carreau_parameter>& known = known_parameters();
  return std::any_of(known.begin(), known.end(), [&](const carreau_parameter& p) {
    return name == p.name && (p.diag_relative != 0 || std::strstr(p.help, "model length") != nullptr);
  });
}

void set_by_name(carreau_session* session, const std::string& setting, double diagonal) {
  const auto [name, value] = parse_assignment(setting, "--set");
  if (is_share(name, value))
    set(session, name.c_str(), parse_length(value, "--set " + name).of(diagonal));
  else
    require(session, carreau_set_word(session, name.c_str(), value.c_str()));
}

/// Synonyms that an env file has set return to the values of the level.
void set_effort(carreau_session* session, int level) {
  for (const carreau_parameter& parameter : known_parameters())
    if (is_synonym(parameter)) require(session, carreau_reset_parameter(session, parameter.name));
  set(session, "effort", level);
}

int threads_of(const MeshOptions& options) {
  return options.threads > 0 ? options.threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

/// Names and numbers of the faces of a file, each once.
std::vector<std::string> words_for_faces(const CadInput& input) {
  std::set<std::string> words;
  for (const std::int32_t face : input.face_numbers()) {
    words.insert(std::to_string(face));
    if (const std::string name = input.face_name(face); !name.empty()) words.insert(name);
  }
  return {words.begin(), words.end()};
}

/// The faces that a rule of --face-size names. A name may hold a star: itself first.
std::vector<std::int32_t> faces_of_rule(const CadInput& input, const std::string& face) {
  std::vector<std::int32_t> named, fitting;
  for (const std::int32_t number : input.face_numbers()) {
    const std::string name = input.face_name(number);
    if (std::to_string(number) == face || name == face) named.push_back(number);
    if (face.find_first_of("*?") != std::string::npos && fits(name, face)) fitting.push_back(number);
  }
  return named.empty() ? fitting : named;
}

void set_face_sizes(const MeshOptions& options, CadInput& input) {
  for (std::size_t i = 0; i < options.face_sizes.size(); ++i) {
    const std::string option = name_of_rule(options.sizes, "--face-size", i < options.sizes.faces);
    const auto [face, text] = parse_assignment(options.face_sizes[i], option);
    const double size = parse_length(text, option).of(input.diagonal());
    if (input.set_face_size(face, size)) continue;
    bool any = false;
    for (const std::int32_t number : faces_of_rule(input, face))
      any = input.set_face_size(std::to_string(number), size) || any;
    if (!any)
      throw Failure(option + ": there is no face '" + face + "'" + did_you_mean(face, words_for_faces(input)) +
                    " Faces are listed by: carreau info --faces");
  }
}

void set_sizes_on(const MeshOptions& options, CadInput& input) {
  for (std::size_t i = 0; i < options.sizes_on.size(); ++i) {
    const std::string& each = options.sizes_on[i];
    const std::string option = name_of_rule(options.sizes, "--size-on", i < options.sizes.entities);
    const auto [entities, text] = parse_assignment(each, option);
    const double size = parse_length(text, option).of(input.diagonal());
    const Selection selection = select(input, entities, option);
    for (const std::int32_t ref : selection.refs)
      if (!input.set_size(selection.dimension, ref, size))
        throw Failure(option + " '" + each + "': number " + std::to_string(ref) + " does not exist, or this input takes sizes on faces alone.");
  }
}

/// Throws Failure for a parameter that is unknown, or a value that it cannot have.
void check_setting(carreau_session* session, const std::string& setting, const std::string& option) {
  const auto [name, value] = parse_assignment(setting, option);
  const std::vector<std::string> known = parameter_names();
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw Failure(option + " '" + setting + "': there is no parameter '" + name + "'" + did_you_mean(name, known) +
                  " `carreau params` lists them all.");
  set_by_name(session, setting, 1);
}

/// Sets the options of `carreau adapt` that are parameters; bounds of sizes are also bounds of the estimator.
void set_estimator(carreau_session* session, const MeshOptions& options, double diagonal) {
  if (!options.adapt.is_adapt) return;
  const Lengths lengths = lengths_of(options, diagonal);
  if (lengths.minimum) set(session, "adapt_hmin", *lengths.minimum);
  if (lengths.maximum) set(session, "adapt_hmax", *lengths.maximum);
  for (const std::string& setting : options.adapt.names) set_by_name(session, setting, diagonal);
}

}  // namespace

void check_words(const MeshOptions& options) {
  const Lengths lengths = lengths_of(options, 1);
  // A share and a length compare when the diagonal is known.
  if (options.minimum.ends_with('%') == options.maximum.ends_with('%')) refuse_contradictions(options, lengths);
  for (const std::string& each : options.face_sizes)
    parse_length(parse_assignment(each, "--face-size").second, "--face-size");
  for (const std::string& each : options.sizes_on) parse_length(parse_assignment(each, "--size-on").second, "--size-on");
  for (const std::string& each : options.near) (void)parse_near(each, "--near");
  check_curve_edges(options);
  check_layers(options);
  check_periodic(options);
  if (options.settings.empty()) return;
  const SessionHandle session = make_session();
  for (const std::string& each : options.settings) check_setting(session.get(), each, "--set");
}

std::string chosen_sizes(const MeshOptions& options, const CadInput& input) {
  if (!has_usual_sizes(options) || input.has_sizes()) return "";
  return "sizes by curvature (default): angle 15 degrees, at most " + (options.maximum.empty() ? "5%" : options.maximum) +
         (options.gradation ? "" : ", gradation 1.3") + "; --size gives a uniform size";
}

std::vector<std::string> sizes_beyond_bounds(const MeshOptions& options, double diagonal) {
  const Lengths lengths = lengths_of(options, diagonal);
  std::vector<std::string> sentences;
  const auto compare = [&](const std::string& option, double size) {
    if (lengths.minimum && size < *lengths.minimum)
      sentences.push_back(option + " is below --min " + options.minimum + ", which counts.");
    if (lengths.maximum && size > *lengths.maximum)
      sentences.push_back(option + " is above --max " + options.maximum + ", which counts.");
  };
  if (lengths.size) compare("--size " + options.size, *lengths.size);
  for (const std::string& each : options.face_sizes)
    compare("--face-size " + each,
            parse_length(parse_assignment(each, "--face-size").second, "--face-size").of(diagonal));
  for (const std::string& each : options.sizes_on)
    compare("--size-on " + each, parse_length(parse_assignment(each, "--size-on").second, "--size-on").of(diagonal));
  for (const std::string& each : options.near) compare("--near " + each, parse_length(parse_near(each, "--near").size, "--near").of(diagonal));
  return sentences;
}

std::vector<std::string> contradicting_face_sizes(const MeshOptions& options, const CadInput& input) {
  std::map<std::int32_t, std::pair<std::string, double>> latest;  // by face: rule and size
  std::map<std::pair<std::string, std::string>, std::vector<std::int32_t>> both;
  std::vector<std::pair<std::string, std::string>> order;
  for (const std::string& rule : options.face_sizes) {
    const auto [face, text] = parse_assignment(rule, "--face-size");
    const double size = parse_length(text, "--face-size").of(input.diagonal());
    for (const std::int32_t number : faces_of_rule(input, face)) {
      const auto [known, is_new] = latest.try_emplace(number, rule, size);
      if (!is_new && known->second.second != size) {
        const std::pair pair{known->second.first, rule};
        if (both[pair].empty()) order.push_back(pair);
        both[pair].push_back(number);
      }
      known->second = {rule, size};
    }
  }
  std::vector<std::string> sentences;
  for (const auto& pair : order) {
    const std::vector<std::int32_t>& faces = both[pair];
    sentences.push_back("--face-size " + pair.first + " and --face-size " + pair.second + " both name face " +
                        std::to_string(faces.front()) +
                        (faces.size() > 1 ? " and " + std::to_string(faces.size() - 1) + " more" : "") +
                        ": the last one holds");
  }
  return sentences;
}

namespace {

/// The program blsurf and this command make one mesh of one blsurf.env.
bool has_defaults_of_blsurf(const MeshOptions& options) { return !options.env.empty() && suffix_of(options.input) == ".pardom"; }

void set_own_choices(carreau_session* session, const CadInput& input) {
  // Zones narrower than 6 % of their edges would have triangles of no shape (Q2 below .1). More cuts add bad triangles
  // to coarse meshes without removing any.
  set(session, "CheckCloseEdges", 20);
  set(session, "CoefRectangle", 0.06);
  // A jump of the edges along a border leaves a fan of flat triangles beside it (HDR sec. 3.3.3).
  set(session, "CheckAdjacentEdges", input.has_arbitrary_borders() ? 0 : 20);
  // Triangles grow from short edges of a border to the size inside.
  set(session, "edge_gradation", 1.5);
  // Vertices that face each other leave triangles with right angles only.
  set(session, "stagger_strips", 1);
  // Users look for the worst triangles, and for triangles of close walls that cross.
  set(session, "effort", 1);
  // Faces too narrow for the cuts above (slivers below the tolerance of a file, fillets of a micrometre) hold flat
  // triangles only.
  require(session, carreau_set_text(session, "narrow_faces", "collapse"));
  set(session, "narrow_ratio", narrower_than_cuts);
}

}  // namespace

void set_parameters(carreau_session* session, const MeshOptions& options, CadInput& input, SizeMap& map) {
  const double diagonal = input.diagonal();
  refuse_contradictions(options, lengths_of(options, diagonal));
  set_face_sizes(options, input);
  set_sizes_on(options, input);
  const bool sizes_by_face = (!options.face_sizes.empty() || !options.sizes_on.empty()) && !input.answers_face_sizes();
  set(session, "threads", threads_of(options));
  const double usual_ratio = real(session, "narrow_ratio");
  const bool as_blsurf = has_defaults_of_blsurf(options);
  if (as_blsurf)
    set(session, "eps_match", diagonal);  // references of the file hold whatever the gap, with a warning
  else
    set_own_choices(session, input);
  set(session, "flag", 1);
  if (options.association) set(session, "association", 1);
  // One bad face in a thousand is no reason to have no mesh.
  require(session, carreau_set_text(session, "failing_faces", "leave_out"));
  // Glues faces that the file does not connect; the others stay as the file connects them.
  if (const double tolerance = input.glue_tolerance(); tolerance > 0) {
    set(session, "glue_open", 1);
    set(session, "eps_glue", tolerance);
    set(session, "eps_glue_open", input.open_tolerance());
  }
  if (const double ends = input.ends_tolerance(); ends > 0) set(session, "eps_ends", ends);
  // A curve has the smallest size of the faces beside it.
  if (sizes_by_face || map.is_formula()) set(session, "hmean_flag", -1);
  if (!options.env.empty()) require(session, carreau_read_env(session, options.env.c_str()));
  if (as_blsurf && is_set(session, "eps_glue") && real(session, "eps_match") == diagonal) set(session, "eps_match", 0.);
  // A request for narrow faces uses the library's ratio, unless another is given.
  const char* narrow_faces = nullptr;
  require(session, carreau_get_text(session, "narrow_faces", &narrow_faces));
  const bool asked = asks_for(options, "narrow_faces") || std::strcmp(narrow_faces, "collapse") != 0;
  if (asked && real(session, "narrow_ratio") == narrower_than_cuts) set(session, "narrow_ratio", usual_ratio);
  if (options.threads > 0) set(session, "threads", options.threads);
  if (options.effort) set_effort(session, *options.effort);
  if (options.verbose && !options.quiet) set(session, "verb", static_cast<std::int32_t>(CARREAU_LEVEL_DETAIL));
  if (options.independent) require(session, carreau_set_text(session, "patches", "independent"));
  if (options.sharp_angle) set(session, "sharp_angle", *options.sharp_angle);
  set_sizes(session, options, lengths_of(options, diagonal), input);
  add_attractors(session, options, input);
  set_estimator(session, options, diagonal);
  if (!options.element.empty()) require(session, carreau_set_text(session, "element", options.element.c_str()));
  for (const std::string& setting : options.settings) set_by_name(session, setting, diagonal);
  if (sizes_by_face || !map.is_empty()) map.give_to(session, input);
}

}  // namespace command
