// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/near.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <utility>
#include <vector>

#include "base/failure.h"
#include "base/lengths.h"
#include "files/mesh_file.h"
#include "files/session_handle.h"
#include "inputs/base/face_model.h"
#include "mesh/selection.h"
#include "mesh/sizes_file.h"

namespace command {
namespace {

/// Relative error of sizes that the shape of an entity may cause.
constexpr double size_error = 0.05;
/// Shares of the diagonal between which shapes of entities are approximated.
constexpr double finest = 1e-5, coarsest = 1e-3;
/// Pieces of a curve before it is divided where it is curved, and the deepest division.
constexpr int curve_pieces = 16, deepest_division = 7;

using Row = std::array<std::int32_t, 3>;

/// Points, edges and triangles in space.
struct Elements {
  std::vector<double> xyz;
  std::vector<Row> rows;

  std::int32_t add(const Point& p) {
    xyz.insert(xyz.end(), p.begin(), p.end());
    return static_cast<std::int32_t>(xyz.size() / 3 - 1);
  }
};

double distance_from_chord(const Point& p, const Point& a, const Point& b) {
  double along = 0, length = 0, away = 0;
  for (std::size_t c = 0; c < 3; ++c) along += (p[c] - a[c]) * (b[c] - a[c]), length += (b[c] - a[c]) * (b[c] - a[c]);
  const double share = length > 0 ? std::clamp(along / length, 0.0, 1.0) : 0;
  for (std::size_t c = 0; c < 3; ++c) away += std::pow(p[c] - std::lerp(a[c], b[c], share), 2);
  return std::sqrt(away);
}

/// The entities of one rule as elements.
class Shapes {
 public:
  Shapes(const MeshOptions& options, CadInput& input, const std::string& label)
      : options_(options), input_(input), label_(label), session_(make_session()) {
    require(session_.get(), carreau_set_message_callback(session_.get(), nullptr, nullptr));  // faces are left out on purpose
    require(session_.get(), input.give_to(session_.get()));
    model_ = model_of(session_.get());
  }

  Elements of(const Selection& selection, double chord) {
    const std::set<std::int32_t> refs(selection.refs.begin(), selection.refs.end());
    if (selection.dimension == 0) add_vertices(refs);
    if (selection.dimension == 1) add_edges(refs, chord);
    if (selection.dimension == 2) add_faces(refs, chord);
    if (selection.dimension == 3) add_faces(faces_of_solids(refs), chord);
    return std::move(elements_);
  }

 private:
  [[noreturn]] void fail(const std::string& why) const { throw Failure(label_ + ": " + why); }

  Point on_curve(const FaceModel::Face& face, std::size_t c, double share) const {
    double u = 0, v = 0;
    Place p;
    if (!input_.on_curve(face.ref, static_cast<std::int32_t>(c + 1), share, u, v) || !input_.locate(face.ref, u, v, p))
      fail("the geometry fails on a curve of face " + std::to_string(input_.whole_face(face.ref)) + ".");
    return {p.x, p.y, p.z};
  }

  void add_vertices(const std::set<std::int32_t>& refs) {
    std::set<std::int32_t> found;
    const auto add = [&](std::int32_t ref, const std::function<Point()>& place) {
      if (!refs.contains(ref) || !found.insert(ref).second) return;
      const std::int32_t k = elements_.add(place());
      elements_.rows.push_back({k, k, k});
    };
    for (const FaceModel::Face& face : model_.faces) {
      for (std::size_t c = 0; c < face.curves.size(); ++c) {
        add(face.curves[c].end1, [&] { return on_curve(face, c, 0); });
        add(face.curves[c].end2, [&] { return on_curve(face, c, 1); });
      }
      for (const FaceModel::Point& point : face.points)
        add(point.ref, [&] {
          Place p;
          if (!input_.locate(face.ref, point.u, point.v, p)) fail("the geometry fails at vertex " + std::to_string(point.ref) + ".");
          return Point{p.x, p.y, p.z};
        });
    }
    check_all("vertex", refs, found);
  }

  void add_edges(const std::set<std::int32_t>& refs, double chord) {
    std::set<std::int32_t> found, sampled;
    for (const FaceModel::Face& face : model_.faces)
      for (std::size_t c = 0; c < face.curves.size(); ++c) {
        const std::int32_t ref = face.curves[c].ref, whole = input_.whole_curve(ref);
        if (!refs.contains(whole)) continue;
        found.insert(whole);
        if (sampled.insert(ref).second) add_curve(face, c, chord);
      }
    check_all("edge", refs, found);
  }

  void add_curve(const FaceModel::Face& face, std::size_t c, double chord) {
    Point last = on_curve(face, c, 0);
    std::int32_t at = elements_.add(last);
    const std::function<void(double, double, const Point&, int)> add = [&](double begin, double end, const Point& to, int depth) {
      const double middle = (begin + end) / 2;
      const Point between = on_curve(face, c, middle);
      if (depth < deepest_division && distance_from_chord(between, last, to) > chord) {
        add(begin, middle, between, depth + 1);
        add(middle, end, to, depth + 1);
        return;
      }
      const std::int32_t next = elements_.add(to);
      elements_.rows.push_back({at, next, next});
      last = to, at = next;
    };
    for (int i = 0; i < curve_pieces; ++i) {
      const double end = (i + 1.0) / curve_pieces;
      add(static_cast<double>(i) / curve_pieces, end, on_curve(face, c, end), 0);
    }
  }

  std::set<std::int32_t> faces_of_solids(const std::set<std::int32_t>& solids) const {
    std::set<std::int32_t> faces;
    for (const std::int32_t face : input_.face_numbers())
      for (const CadInput::Part& part : input_.parts_beside(face))
        if (solids.contains(part.number)) faces.insert(face);
    return faces;
  }

  void add_faces(const std::set<std::int32_t>& refs, double chord) {
    carreau_session* session = session_.get();
    for (const FaceModel::Face& face : model_.faces)
      if (!refs.contains(input_.whole_face(face.ref)))
        require(session, carreau_model_leave_out_face(session, face.ref, "no attractor"));
    const double diagonal = input_.diagonal();
    for (const auto& [name, value] : {std::pair{"hphy_flag", 0}, {"hgeo_flag", 1}, {"threads", options_.threads > 0 ? options_.threads : 1}})
      require(session, carreau_set_integer(session, name, value));
    for (const auto& [name, value] : {std::pair{"eps_chord", chord}, {"hgeomin", chord}, {"hgeomax", diagonal}})
      require(session, carreau_set_real(session, name, value));
    for (const auto& [name, value] : {std::pair{"geo_rule", "chord"}, {"failing_faces", "leave_out"}, {"narrow_faces", "collapse"}})
      require(session, carreau_set_text(session, name, value));
    const carreau_status status = carreau_mesh_generate(session);
    if (status != CARREAU_OK && status != CARREAU_ERR_PARTIAL) fail(carreau_last_error(session));
    carreau_mesh* mesh = nullptr;
    require(session, carreau_session_mesh(session, &mesh));
    const MeshArrays arrays = arrays_of(mesh);
    for (const Point& p : arrays.vertices) elements_.add(p);
    elements_.rows = arrays.triangles;
    if (elements_.rows.empty()) fail("its faces cannot be meshed.");
  }

  void check_all(const char* kind, const std::set<std::int32_t>& refs, const std::set<std::int32_t>& found) const {
    for (const std::int32_t ref : refs)
      if (!found.contains(ref)) fail(std::string("there is no ") + kind + " " + std::to_string(ref) + " on a face.");
  }

  const MeshOptions& options_;
  CadInput& input_;
  const std::string& label_;
  SessionHandle session_;
  FaceModel model_;
  Elements elements_;
};

}  // namespace

NearRule parse_near(const std::string& rule, const std::string& option) {
  const auto [entities, lengths] = parse_assignment(rule, option);
  const std::size_t colon = lengths.find(':');
  if (colon == std::string::npos)
    throw Failure(option + " '" + rule + "': a size and a reach are written as in " + entities + "=0.1:2.");
  NearRule parsed{entities, lengths.substr(0, colon), lengths.substr(colon + 1)};
  for (const std::string& length : {parsed.size, parsed.reach}) (void)parse_length(length, option + " '" + rule + "'");
  return parsed;
}

void add_attractors(carreau_session* session, const MeshOptions& options, CadInput& input) {
  require(session, carreau_clear_attractors(session));
  if (options.near.empty()) return;
  const double diagonal = input.diagonal();
  double surrounding = 0;
  require(session, carreau_get_real(session, "hphydef", &surrounding));
  for (std::size_t i = 0; i < options.near.size(); ++i) {
    const std::string option = name_of_rule(options.sizes, "--near", i < options.sizes.near), label = option + " '" + options.near[i] + "'";
    const NearRule rule = parse_near(options.near[i], option);
    const double size = parse_length(rule.size, option).of(diagonal), reach = parse_length(rule.reach, option).of(diagonal);
    if (size > surrounding)
      throw Failure(label + ": the size " + number_text(size) + " is above the size " + number_text(surrounding) + " of the surroundings.");
    const Selection selection = select(input, rule.entities, option);
    // An error of the distance is this times as large as the error of the size.
    const double slope = (surrounding - size) / reach;
    const double chord = std::clamp(size_error * size / std::max(slope, size_error), finest * diagonal, coarsest * diagonal);
    const Elements elements = Shapes(options, input, label).of(selection, chord);
    require(session, carreau_add_attractor(session, static_cast<std::int64_t>(elements.xyz.size() / 3), elements.xyz.data(),
                                           static_cast<std::int64_t>(elements.rows.size()), elements.rows.front().data(), size, surrounding, reach));
  }
}

}  // namespace command
