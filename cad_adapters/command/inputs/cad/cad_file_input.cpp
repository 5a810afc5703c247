// SPDX-License-Identifier: BSD-3-Clause
// STEP, IGES and BREP files as input.
#include <algorithm>
#include <cstdio>
#include <numeric>
#include <sstream>

#include "base/failure.h"
#include "files/session_handle.h"
#include "inputs/base/mirror_plane.h"
#include "inputs/built/known_suffixes.h"
#include "inputs/cad/cad_file.h"
#include "inputs/cad/cad_library.h"
#include "inputs/cad/open_cad.h"

namespace command {

void require(carreau_cad_file* file, carreau_status status) {
  if (status != CARREAU_OK) throw Failure(cad_library().last_error(file));
}

CadFileHandle read_cad(const std::string& path, const CadChoice& choice, const ReadingProgress& progress) {
  carreau_cad_file* created = nullptr;
  if (cad_library().create(&created) != CARREAU_OK) throw Failure("'" + path + "': out of memory.");
  CadFileHandle file(created);
  carreau_cad_options options{};
  options.struct_size = sizeof options;
  options.trap_faults = 1;
  options.loose_edges = choice.loose_edges ? 1 : 0;
  options.imprint = choice.imprint ? 1 : 0;
  options.imprint_tolerance = choice.imprint_tolerance;
  options.unit = choice.unit.c_str();
  options.scale = choice.scale;
  options.min_feature = choice.min_feature;
  options.user = const_cast<ReadingProgress*>(&progress);
  options.progress = [](double fraction, void* user) {
    const auto& tell = *static_cast<const ReadingProgress*>(user);
    if (tell) tell(fraction);
    return std::int32_t{0};
  };
  const carreau_status status = cad_library().read(file.get(), path.c_str(), &options);
  if (status == CARREAU_ERR_MEMORY) throw Failure("'" + path + "': out of memory.");
  // Files of CAD are known by suffix or content.
  if (status != CARREAU_OK && std::string(cad_library().last_error(file.get())).find("is not a STEP, IGES or BREP") != std::string::npos)
    throw Failure(unknown_geometry(path));
  require(file.get(), status);
  for (const MirrorPlane& plane : mirror_planes(choice.mirror))
    require(file.get(), cad_library().mirror(file.get(), plane.point.data(), plane.normal.data()));
  return file;
}

carreau_cad_content content_of(carreau_cad_file* file) {
  carreau_cad_content content{};
  content.struct_size = sizeof content;
  require(file, cad_library().info(file, &content));
  return content;
}

std::vector<FaceLook> faces_of(carreau_cad_file* file) {
  std::vector<FaceLook> list;
  const std::int32_t count = content_of(file).faces;
  for (std::int32_t number = 1; number <= count; ++number) {
    carreau_cad_face face{};
    face.struct_size = sizeof face;
    require(file, cad_library().file_face(file, number, &face));
    carreau_cad_figures figures{};
    figures.struct_size = sizeof figures;
    require(file, cad_library().measure_face(file, number, &figures));
    FaceLook look{.number = number, .name = face.name, .kind = figures.kind, .area = figures.area,
                  .perimeter = figures.perimeter};
    std::copy(std::begin(figures.low), std::end(figures.low), look.low.begin());
    std::copy(std::begin(figures.high), std::end(figures.high), look.high.begin());
    list.push_back(std::move(look));
  }
  return list;
}

std::vector<std::string> notes_of(carreau_cad_file* file) {
  std::istringstream lines(content_of(file).notes);
  std::vector<std::string> sentences;
  for (std::string line; std::getline(lines, line);) sentences.push_back(line);
  return sentences;
}

std::vector<std::string> losses_of(carreau_cad_file* file) {
  std::vector<std::string> sentences;
  for (std::int64_t i = 0; const char* loss = cad_library().loss(file, i); ++i) sentences.emplace_back(loss);
  return sentences;
}

std::vector<std::string> small_features_of(carreau_cad_file* file) {
  std::vector<std::string> lines;
  for (std::int64_t i = 0; i < content_of(file).small_features; ++i) {
    carreau_cad_small_feature feature{};
    feature.struct_size = sizeof feature;
    require(file, cad_library().small_feature_at(file, i, &feature));
    char text[160];
    std::snprintf(text, sizeof text, "%-8s %-10s of %.4g at (%.6g, %.6g, %.6g), ", feature.removed != 0 ? "removed" : "kept", feature.kind,
                  feature.size, feature.place[0], feature.place[1], feature.place[2]);
    const std::string faces = feature.faces;
    lines.push_back(text + std::string(faces.find(',') == std::string::npos ? "face " : "faces ") + faces);
  }
  return lines;
}

std::vector<carreau_cad_contact> contacts_of(carreau_cad_file* file) {
  std::int64_t count = 0;
  require(file, cad_library().count_contacts(file, &count));
  std::vector<carreau_cad_contact> contacts(static_cast<std::size_t>(count));
  for (std::int64_t k = 0; k < count; ++k) {
    carreau_cad_contact& contact = contacts[static_cast<std::size_t>(k)];
    contact.struct_size = sizeof contact;
    require(file, cad_library().contact_at(file, k, &contact));
  }
  return contacts;
}

std::vector<carreau_cad_tree_row> tree_of(carreau_cad_file* file) {
  std::vector<carreau_cad_tree_row> rows(static_cast<std::size_t>(content_of(file).tree_rows));
  for (std::size_t k = 0; k < rows.size(); ++k) {
    rows[k].struct_size = sizeof rows[k];
    require(file, cad_library().tree_at(file, static_cast<std::int64_t>(k), &rows[k]));
  }
  return rows;
}

carreau_cad_report inspect(carreau_cad_file* file) {
  carreau_cad_report report{};
  report.struct_size = sizeof report;
  require(file, cad_library().inspect(file, 0, &report));
  return report;
}

std::vector<carreau_cad_danger> dangers_of(carreau_cad_file* file, const carreau_cad_report& report) {
  std::vector<carreau_cad_danger> dangers(static_cast<std::size_t>(report.dangers));
  for (std::int32_t i = 0; i < report.dangers; ++i) {
    carreau_cad_danger& danger = dangers[static_cast<std::size_t>(i)];
    danger.struct_size = sizeof danger;
    require(file, cad_library().danger_at(file, i, &danger));
  }
  return dangers;
}

namespace {

class CadFileInput final : public CadInput {
 public:
  explicit CadFileInput(CadFileHandle file) : file_(std::move(file)), content_(content_of(file_.get())) {}

  carreau_status give_to(carreau_session* session) override {
    const carreau_status status = carreau_model_clear(session);
    return status == CARREAU_OK ? cad_library().add(file_.get(), session) : status;
  }
  // Without a usable face any length will do: the run reports the error of each face.
  [[nodiscard]] double diagonal() const override { return content_.diagonal > 0 ? content_.diagonal : 1; }
  [[nodiscard]] double glue_tolerance() const override { return content_.glue_tolerance; }
  [[nodiscard]] double open_tolerance() const override { return content_.open_tolerance; }
  [[nodiscard]] bool answers_face_sizes() const override { return true; }
  [[nodiscard]] double face_size(std::int32_t) const override { return 0; }
  bool set_face_size(const std::string& face, double size) override {
    return cad_library().set_face_size(file_.get(), face.c_str(), size) == CARREAU_OK;
  }
  bool set_size(int dimension, std::int32_t number, double size) override {
    return cad_library().set_size(file_.get(), dimension, number, size) == CARREAU_OK;
  }

  [[nodiscard]] bool locate(std::int32_t face, double u, double v, Place& place) const noexcept override {
    double xyz[3], uv[2];
    if (cad_library().point(file_.get(), face, u, v, xyz, uv) != CARREAU_OK) return false;
    place = {xyz[0], xyz[1], xyz[2], uv[0], uv[1]};
    return true;
  }

  [[nodiscard]] std::vector<FaceLook> faces() const override { return faces_of(file_.get()); }
  [[nodiscard]] std::vector<std::int32_t> face_numbers() const override {
    std::vector<std::int32_t> numbers(static_cast<std::size_t>(content_.faces));
    std::iota(numbers.begin(), numbers.end(), 1);
    return numbers;
  }

  [[nodiscard]] std::string face_name(std::int32_t number) const override {
    carreau_cad_face face{};
    face.struct_size = sizeof face;
    return cad_library().file_face(file_.get(), number, &face) == CARREAU_OK ? face.name : "";
  }
  [[nodiscard]] Part part_of_face(std::int32_t number) const override { return parts_beside(number)[0]; }
  [[nodiscard]] std::array<Part, 2> parts_beside(std::int32_t number) const override {
    carreau_cad_face face{};
    face.struct_size = sizeof face;
    if (cad_library().file_face(file_.get(), number, &face) != CARREAU_OK) return {};
    return {Part{face.solid, face.solid_name}, Part{face.other_solid, face.other_solid_name}};
  }
  [[nodiscard]] std::int32_t face_colour(std::int32_t number) const override {
    carreau_cad_face face{};
    face.struct_size = sizeof face;
    return cad_library().file_face(file_.get(), number, &face) == CARREAU_OK ? face.rgb : -1;
  }
  [[nodiscard]] std::string face_layer(std::int32_t number) const override {
    carreau_cad_face face{};
    face.struct_size = sizeof face;
    return cad_library().file_face(file_.get(), number, &face) == CARREAU_OK ? face.layer : "";
  }
  [[nodiscard]] std::vector<Named> named(int dimension) const override {
    std::vector<Named> all;
    const std::int32_t count = dimension == 0 ? content_.vertices : content_.edges;
    for (std::int32_t number = 1; number <= count; ++number)
      if (std::string name = cad_library().entity_name(file_.get(), dimension, number); !name.empty()) all.push_back({number, std::move(name)});
    return all;
  }
  [[nodiscard]] std::vector<Contact> contacts() const override {
    std::vector<Contact> all;
    for (const carreau_cad_contact& each : contacts_of(file_.get())) {
      Contact& contact = all.emplace_back(Contact{.parts = {}, .area = each.area, .faces = each.pairs});
      for (std::size_t k = 0; k < 2; ++k)
        contact.parts[k] = {each.solids[k], cad_library().entity_name(file_.get(), 3, each.solids[k])};
    }
    return all;
  }
  [[nodiscard]] std::int32_t whole_face(std::int32_t face) const override {
    return cad_library().whole_face(file_.get(), face);
  }
  [[nodiscard]] std::int32_t whole_curve(std::int32_t curve) const override {
    return cad_library().whole_edge(file_.get(), curve);
  }
  [[nodiscard]] std::vector<std::int32_t> parts(std::int32_t face) const override {
    return list_of(face, cad_library().parts);
  }
  [[nodiscard]] std::vector<std::int32_t> curves(std::int32_t face) const override {
    return list_of(face, cad_library().curves);
  }
  [[nodiscard]] bool on_curve(std::int32_t face, std::int32_t ic, double share, double& u,
                              double& v) const noexcept override {
    double uv[2];
    if (cad_library().curve_point(file_.get(), face, ic, share, uv) != CARREAU_OK) return false;
    u = uv[0], v = uv[1];
    return true;
  }
  [[nodiscard]] std::vector<std::string> losses() const override { return losses_of(file_.get()); }

  [[nodiscard]] std::vector<std::string> small_features() const override { return small_features_of(file_.get()); }
  [[nodiscard]] std::vector<std::string> notes() const override { return notes_of(file_.get()); }

  [[nodiscard]] std::vector<std::string> kinks() const override {
    std::vector<std::string> sentences;
    if (content_.bent_faces == 0) return sentences;
    for (const carreau_cad_danger& danger : dangers_of(file_.get(), inspect(file_.get())))
      if (std::string("kink") == danger.kind && danger.cut == 0) sentences.emplace_back(danger.sentence);
    return sentences;
  }

  [[nodiscard]] bool is_wires() const override { return content_.faces == 0; }
  [[nodiscard]] bool closed() const override { return content_.closed != 0; }

  [[nodiscard]] std::string gaps() const override {
    carreau_cad_gaps gaps{};
    gaps.struct_size = sizeof gaps;
    require(file_.get(), cad_library().measure_gaps(file_.get(), &gaps));
    if (!(gaps.largest > 0)) return "none";
    char text[160];
    std::snprintf(text, sizeof text, "largest %.3g (edge %d on face %d); %d above twice the tolerance of their edges",
                  gaps.largest, static_cast<int>(gaps.edge), static_cast<int>(gaps.face),
                  static_cast<int>(gaps.beyond));
    return text;
  }

  [[nodiscard]] std::string summary() const override {
    const auto count = [](int n, const char* one, const char* many) {
      return std::to_string(n) + " " + (n == 1 ? one : many);
    };
    const std::string unit = content_.unit;
    return count(content_.faces, "face", "faces") + ", " + count(content_.edges, "edge", "edges") + ", " +
           count(content_.vertices, "vertex", "vertices") + (closed() ? ", closed" : ", open") +
           (content_.shared_faces > 0 ? ", " + count(content_.shared_faces, "face", "faces") + " between two solids" : "") +
           (unit.empty() ? "" : ", lengths in " + unit);
  }

 private:
  template <typename List>
  [[nodiscard]] std::vector<std::int32_t> list_of(std::int32_t face, List&& list) const {
    std::int64_t count = 0;
    if (list(file_.get(), face, 0, nullptr, &count) != CARREAU_OK) return {};
    std::vector<std::int32_t> values(static_cast<std::size_t>(count));
    if (count > 0) require(file_.get(), list(file_.get(), face, count, values.data(), nullptr));
    return values;
  }

  CadFileHandle file_;
  carreau_cad_content content_;
};

}  // namespace

std::unique_ptr<CadInput> open_cad(const std::string& path, const CadChoice& choice, const ReadingProgress& progress) {
  return std::make_unique<CadFileInput>(read_cad(path, choice, progress));
}

}  // namespace command
