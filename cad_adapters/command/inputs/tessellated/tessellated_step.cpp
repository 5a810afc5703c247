// SPDX-License-Identifier: BSD-3-Clause
#include "inputs/tessellated/tessellated_step.h"

#include <cstdint>
#include <fstream>
#include <map>
#include <string_view>

#include "base/text_file.h"
#include "inputs/tessellated/step_records.h"
#include "inputs/tessellated/tessellated_assembly.h"

namespace command {
namespace {

constexpr double millimetres_of_metre = 1000, millimetres_of_inch = 25.4;

bool is_face(std::string_view type) { return type == "TRIANGULATED_FACE" || type == "COMPLEX_TRIANGULATED_FACE"; }
bool is_body(std::string_view type) { return type == "TESSELLATED_SHELL" || type == "TESSELLATED_SOLID"; }

/// Millimetres of the file's unit of length.
double unit_of(const StepRecords& records) {
  double unit = 1;
  for (const auto& entry : records.all()) {
    const auto& record = entry.second;
    if (!record.type.empty() || record.arguments.find("LENGTH_UNIT") == std::string_view::npos) continue;
    if (record.arguments.find("CONVERSION_BASED_UNIT") != std::string_view::npos)
      return record.arguments.find("'INCH") != std::string_view::npos ? millimetres_of_inch : unit;
    if (record.arguments.find(".METRE.") == std::string_view::npos) continue;
    const auto has = [&](const char* prefix) { return record.arguments.find(prefix) != std::string_view::npos; };
    unit = has(".MILLI.") ? 1 : has(".CENTI.") ? 10 : has(".MICRO.") ? 1e-3 : millimetres_of_metre;
  }
  return unit;
}

class TessellationReader {
 public:
  explicit TessellationReader(const StepRecords& records) : records_(records), unit_(unit_of(records)) {}

  Tessellation run() {
    if (const std::vector<PlacedItem> items = placed_items(records_); !items.empty()) {
      add_placed(items);
      return std::move(made_);
    }
    std::vector<int> faces;
    for (const auto& [number, record] : records_.all())
      if (is_body(record.type)) add_faces_of(number, record, faces);
    if (faces.empty())
      for (const auto& [number, record] : records_.all())
        if (is_face(record.type)) faces.push_back(number);
    for (const int face : faces) add_face(face, records_.at(face, face));
    return std::move(made_);
  }

 private:
  void add_faces_of(int body, const StepRecords::Record& record, std::vector<int>& faces) const {
    for (const int face : StepRecords::references(records_.argument(body, record, 1)))
      if (is_face(records_.at(face, body).type)) faces.push_back(face);
  }

  void add_placed(const std::vector<PlacedItem>& items) {
    for (const PlacedItem& placed : items) {
      const auto found = records_.all().find(placed.item);
      if (found == records_.all().end()) continue;
      const StepRecords::Record& record = found->second;
      std::vector<int> faces;
      if (is_face(record.type)) faces.push_back(placed.item);
      if (is_body(record.type) || record.type == "TESSELLATED_GEOMETRIC_SET")
        add_faces_of(placed.item, record, faces);
      placement_ = placed.placement;
      first_of_list_.clear();  // points have another place
      for (const int face : faces) add_face(face, records_.at(face, face));
    }
  }

  /// First vertex of each list of points.
  std::int64_t points(int list, int from, std::int64_t& count) {
    const StepRecords::Record& record = records_.at(list, from);
    if (record.type != "COORDINATES_LIST") records_.fail(from, "its coordinates are not a COORDINATES_LIST");
    const auto [known, fresh] = first_of_list_.try_emplace(list, std::pair(0, 0));
    if (fresh) {
      const std::vector<double> values = records_.numbers(records_.argument(list, record, 2), list);
      if (values.empty() || values.size() % 3 != 0) records_.fail(list, "its points have no three coordinates");
      known->second = {static_cast<std::int64_t>(made_.vertices.size() / 3),
                       static_cast<std::int64_t>(values.size() / 3)};
      if (made_.vertices.size() / 3 + values.size() / 3 > static_cast<std::size_t>(INT32_MAX))
        records_.fail(list, "the file has too many points");
      for (std::size_t i = 0; i + 2 < values.size(); i += 3)
        for (const double x : placement_({values[i], values[i + 1], values[i + 2]}))
          made_.vertices.push_back(unit_ * x);
    }
    count = known->second.second;
    return known->second.first;
  }

  void add_face(int number, const StepRecords::Record& record) {
    ++ref_;
    std::int64_t count = 0;
    const std::int64_t first = points(StepRecords::reference(records_.argument(number, record, 1)), number, count);
    const std::vector<double> index = records_.numbers(records_.argument(number, record, 5), number);
    const auto vertex = [&](double local) {
      double rank = local;
      if (!index.empty()) {
        if (!(local >= 1 && local <= static_cast<double>(index.size())))
          records_.fail(number, "an index is out of range");
        rank = index[static_cast<std::size_t>(local) - 1];
      }
      if (!(rank >= 1 && rank <= static_cast<double>(count))) records_.fail(number, "an index is out of range");
      return static_cast<std::int32_t>(first + static_cast<std::int64_t>(rank) - 1);
    };
    const auto add = [&](double a, double b, double c) {
      const std::int32_t corners[] = {vertex(a), vertex(b), vertex(c)};
      if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0])
        return;  // a turn of a strip
      made_.triangles.insert(made_.triangles.end(), std::begin(corners), std::end(corners));
      made_.refs.push_back(ref_);
    };
    if (record.type == "TRIANGULATED_FACE") {
      const std::vector<double> corners = records_.numbers(records_.argument(number, record, 6), number);
      if (corners.size() % 3 != 0) records_.fail(number, "a triangle has no three corners");
      for (std::size_t i = 0; i + 2 < corners.size(); i += 3) add(corners[i], corners[i + 1], corners[i + 2]);
      return;
    }
    for (const std::string_view strip : StepRecords::split(StepRecords::inside(records_.argument(number, record, 6)))) {
      const std::vector<double> p = records_.numbers(strip, number);
      for (std::size_t i = 2; i < p.size(); ++i)
        i % 2 == 0 ? add(p[i - 2], p[i - 1], p[i]) : add(p[i - 1], p[i - 2], p[i]);
    }
    for (const std::string_view fan : StepRecords::split(StepRecords::inside(records_.argument(number, record, 7)))) {
      const std::vector<double> p = records_.numbers(fan, number);
      for (std::size_t i = 2; i < p.size(); ++i) add(p[0], p[i - 1], p[i]);
    }
  }

  const StepRecords& records_;
  double unit_;
  Placement placement_;  // of the points that are read
  Tessellation made_;
  std::int32_t ref_ = 0;
  std::map<int, std::pair<std::int64_t, std::int64_t>> first_of_list_;
};

}  // namespace

bool is_tessellated_step(const std::string& path) {
  constexpr std::size_t head = 1 << 16;
  const std::string suffix = suffix_of(path);
  if (suffix != ".stp" && suffix != ".step") return false;
  std::ifstream stream(path, std::ios::binary);
  std::string start(head, '\0');
  stream.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(stream.gcount()));
  if (start.find("AP242") == std::string::npos) return false;  // of the schema: no other one has tessellated shapes
  const std::string text = bytes_of_step(path);
  const auto has = [&](const char* type) { return text.find(type) != std::string::npos; };
  return has("TRIANGULATED_FACE") && !has("ADVANCED_FACE") && !has("FACE_SURFACE");
}

Tessellation read_tessellation(const std::string& path) {
  const StepRecords records(path, bytes_of_step(path));
  return TessellationReader(records).run();
}

}  // namespace command
