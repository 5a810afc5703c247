// SPDX-License-Identifier: BSD-3-Clause
#include "report/viewer_data.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "draw/colour_scale.h"
#include "draw/face_colours.h"
#include "draw/view.h"
#include "report/curved_pieces.h"
#include "report/packing.h"

namespace command {
namespace {

using Json = nlohmann::ordered_json;

constexpr double value_codes = 65534;  // and 0 for none

/// The head of the data, and the arrays behind it.
class Blocks {
 public:
  void add(const std::string& name, const PackedNumbers& numbers) {
    head_[name] = {{"count", numbers.count},
                   {"bytes", numbers.bytes},
                   {"stride", numbers.stride},
                   {"delta", numbers.coding == Coding::delta}};
    text_ += "<script type=\"text/plain\" id=\"data-" + name + "\">" + numbers.base64 + "</script>\n";
  }
  [[nodiscard]] const Json& head() const { return head_; }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  Json head_ = Json::object();
  std::string text_;
};

struct Box {
  Point low{}, quantum{};
  int bytes = 2;  ///< of a number
};

double shortest_side(const MeshArrays& mesh) {
  double shortest = HUGE_VAL;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const Point &a = mesh.vertices[t[k]], &b = mesh.vertices[t[(k + 1) % 3]];
      const double length = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
      if (length > 0) shortest = std::min(shortest, length);
    }
  return shortest;
}

/// 16 bits; 24 where the shortest side would be less than 16 quanta.
Box box_of(const MeshArrays& mesh, const std::vector<Point>& more) {
  Point high{};
  Box box;
  box.low.fill(HUGE_VAL), high.fill(-HUGE_VAL);
  const auto hold = [&](const Point& p) {
    for (std::size_t x = 0; x < 3; ++x) box.low[x] = std::min(box.low[x], p[x]), high[x] = std::max(high[x], p[x]);
  };
  for (const auto& t : mesh.triangles)
    for (const std::int32_t v : t) hold(mesh.vertices[v]);
  for (const Point& p : more) hold(p);
  double widest = 0;
  for (std::size_t x = 0; x < 3; ++x) widest = std::max(widest, high[x] - box.low[x]);
  constexpr double quanta_of_a_side = 16;
  box.bytes = shortest_side(mesh) < quanta_of_a_side * widest / 0xffff ? 3 : 2;
  for (std::size_t x = 0; x < 3; ++x) box.quantum[x] = (high[x] - box.low[x]) / (box.bytes == 2 ? 0xffff : 0xffffff);
  return box;
}

/// Vertices that no triangle has may lie outside of the box: they are moved onto it.
std::vector<std::uint32_t> positions(const MeshArrays& mesh, const std::vector<Point>& more, const Box& box) {
  const double most = box.bytes == 2 ? 0xffff : 0xffffff;
  std::vector<std::uint32_t> numbers;
  for (const std::vector<Point>* points : {&mesh.vertices, &more})
    for (const Point& p : *points)
      for (std::size_t x = 0; x < 3; ++x) {
        const double q = box.quantum[x] > 0 ? (p[x] - box.low[x]) / box.quantum[x] : 0;
        numbers.push_back(static_cast<std::uint32_t>(std::lround(std::clamp(q, 0.0, most))));
      }
  return numbers;
}

std::vector<std::uint32_t> corners(const std::vector<std::array<std::int32_t, 3>>& triangles) {
  std::vector<std::uint32_t> numbers;
  for (const auto& t : triangles)
    for (const std::int32_t v : t) numbers.push_back(static_cast<std::uint32_t>(v));
  return numbers;
}

std::vector<std::uint32_t> sides(const ViewerMesh& viewer) {
  const MeshArrays& mesh = viewer.mesh;
  const auto curves = sides_on_curves(mesh);
  std::vector<std::uint32_t> numbers;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::uint32_t bits = viewer.halves[t] == 1 ? 4u << 3 : viewer.halves[t] == 2 ? 1u << 3 : 0;
    for (std::size_t k = 0; k < 3; ++k)
      if (curves.contains(side_key(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]))) bits |= 1u << k;
    numbers.push_back(bits);
  }
  return numbers;
}

/// Ends of the values, for the codes; the ends of the colours may be narrower.
std::pair<double, double> ends_of(const TriangleValues& values) {
  constexpr double smallest_share = 1e-9;  // of a logarithmic scale, as for rounding errors
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const double x : values.values)
    if (std::isfinite(x)) low = std::min(low, x), high = std::max(high, x);
  if (low > high) low = values.low, high = values.high;
  if (values.scale == Scale::linear) return {std::min(low, values.low), std::max(high, values.high)};
  high = std::max(high, values.high);
  return {std::max(low, smallest_share * high), high};
}

std::vector<std::uint32_t> codes_of(const TriangleValues& values, double low, double high) {
  const bool logarithmic = values.scale == Scale::logarithmic;
  const double width = logarithmic ? std::log(high / low) : high - low;
  std::vector<std::uint32_t> codes;
  for (const double x : values.values) {
    const double share = !(width > 0) ? 0 : logarithmic ? std::log(std::max(x, low) / low) / width : (x - low) / width;
    codes.push_back(std::isfinite(x) ? 1 + static_cast<std::uint32_t>(std::lround(std::clamp(share, 0.0, 1.0) * value_codes)) : 0);
  }
  return codes;
}

/// Faces that triangles or the mesh know of, by reference.
std::map<std::int32_t, const FaceResult*> all_faces(const MeshArrays& mesh) {
  std::map<std::int32_t, const FaceResult*> faces;
  for (const std::int32_t ref : mesh.triangle_refs) faces.emplace(ref, nullptr);
  for (const FaceResult& face : mesh.faces) faces[face.ref] = &face;
  return faces;
}

int rgb_of(const Colour& colour) {
  return to_srgb(colour[0]) << 16 | to_srgb(colour[1]) << 8 | to_srgb(colour[2]);
}

Json faces_json(const MeshArrays& mesh, const std::map<std::int32_t, const FaceResult*>& faces) {
  const auto colours = colours_of_faces(mesh);
  Json list = Json::array();
  for (const auto& [ref, face] : faces) {
    const auto colour = colours.find(ref);
    list.push_back({{"reference", ref},
                    {"name", face == nullptr ? "" : face->name},
                    {"colour", hex_text(colour == colours.end() ? grey : rgb_of(colour->second))}});
  }
  return list;
}

std::vector<std::uint32_t> face_indices(const MeshArrays& mesh, const std::map<std::int32_t, const FaceResult*>& faces) {
  std::map<std::int32_t, std::uint32_t> rank;
  for (const auto& each : faces) rank.emplace(each.first, static_cast<std::uint32_t>(rank.size()));
  std::vector<std::uint32_t> numbers;
  for (const std::int32_t ref : mesh.triangle_refs) numbers.push_back(rank.at(ref));
  return numbers;
}

Json values_json(const std::vector<TriangleValues>& all, Blocks& blocks) {
  Json list = Json::array();
  for (const TriangleValues& values : all) {
    const auto [low, high] = ends_of(values);
    blocks.add(values.key, packed(codes_of(values, low, high), 2, Coding::plain));
    list.push_back({{"key", values.key},
                    {"title", values.title},
                    {"unit", values.unit},
                    {"logarithmic", values.scale == Scale::logarithmic},
                    {"low", low},
                    {"high", high},
                    {"shown", {values.low, values.high}}});
  }
  return list;
}

/// In a script element nothing may look like its end.
std::string json_in_html(const Json& value) {
  std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
  return text;
}

}  // namespace

std::string viewer_data(const ViewerMesh& viewer) {
  const MeshArrays& mesh = viewer.mesh;
  const CurvedPieces pieces = curved_pieces(mesh, viewer.halves);
  const Box box = box_of(mesh, pieces.points);
  const auto faces = all_faces(mesh);
  Blocks blocks;
  blocks.add("positions", packed(positions(mesh, pieces.points, box), box.bytes, Coding::delta, 3));
  blocks.add("corners", packed(corners(mesh.triangles), 4, Coding::delta, 3));
  blocks.add("faces", packed(face_indices(mesh, faces), 4, Coding::delta));
  blocks.add("sides", packed(sides(viewer), 1, Coding::plain));
  if (!pieces.corners.empty()) {
    blocks.add("piece-corners", packed(corners(pieces.corners), 4, Coding::delta, 3));
    blocks.add("piece-triangle", packed(pieces.triangle, 4, Coding::delta));
    blocks.add("piece-sides", packed(pieces.sides, 1, Coding::plain));
  }
  Json colours = Json::array();
  for (const int stop : scale_stops) colours.push_back(hex_text(stop));
  Json head = {{"vertices", mesh.vertices.size()},
               {"triangles", mesh.triangles.size()},
               {"dimension", mesh.dimension},
               {"box", {{"low", box.low}, {"quantum", box.quantum}}},
               {"colours", colours},
               {"faces", faces_json(mesh, faces)},
               {"values", values_json(viewer.values, blocks)}};
  head["blocks"] = blocks.head();
  return "<script type=\"application/json\" id=\"viewer-data\">" + json_in_html(head) + "</script>\n" + blocks.text();
}

}  // namespace command
