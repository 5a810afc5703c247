#include <brep_host.h>
#include <face_figures.h>
#include <faults.h>
#include <shape_file.h>
#include <shape_report.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "cad_input.h"
#include "commands.h"
#include "failure.h"
#include "json_output.h"

namespace command {
namespace {

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

std::string sentence(const carreau_occ::Danger& danger, const carreau_occ::BrepHost& host) {
  std::string text;
  if (danger.edge > 0) text += "edge " + std::to_string(danger.edge);
  if (danger.face > 0) {
    text += (text.empty() ? "face " : ", face ") + std::to_string(danger.face);
    const std::string& name = host.face_name(danger.face);
    if (!name.empty()) text += " (" + name + ")";
  }
  text += ": " + (danger.value > 0 ? number(danger.value) + " " : "") + danger.text;
  if (danger.kind != "kink") return text;
  const std::vector<int>& bent = host.bent_faces();
  const bool cut = std::find(bent.begin(), bent.end(), danger.face) == bent.end();
  return text + (cut ? ", where it is cut: edges of meshes follow it"
                     : "; it cannot be cut there, and sizes by an angle or a chord do not see it");
}

std::vector<FaceLook> faces_of_shape(const carreau_occ::ShapeFile& file, const carreau_occ::BrepHost& host) {
  std::vector<FaceLook> list;
  for (const carreau_occ::FaceFigures& face : carreau_occ::list_faces(file))
    list.push_back({.number = face.number,
                    .name = host.face_name(face.number),
                    .kind = face.kind,
                    .area = face.area,
                    .perimeter = face.perimeter,
                    .low = face.low,
                    .high = face.high});
  return list;
}

class OpenCascadeInput final : public CadInput {
 public:
  OpenCascadeInput(const std::string& path, const ReadingProgress& progress)
      : file_(carreau_occ::read_shape(path,
                                      [&](double fraction) {
                                        if (progress) progress(fraction);
                                        return true;
                                      })),
        host_(file_) {}

  carreau_status give_to(carreau_session* session) override { return host_.give_to(session); }
  // Without a usable face there is none: any length will do for a run that tells why of each.
  [[nodiscard]] double diagonal() const override {
    const double diagonal = host_.diagonal();
    return diagonal > 0 ? diagonal : 1;
  }
  [[nodiscard]] double glue_tolerance() const override { return host_.glue_tolerances().of_all; }
  [[nodiscard]] double open_tolerance() const override { return host_.glue_tolerances().of_each; }
  [[nodiscard]] bool answers_face_sizes() const override { return true; }
  [[nodiscard]] double face_size(std::int32_t) const override { return 0; }
  bool set_face_size(const std::string& face, double size) override { return host_.set_face_size(face, size); }

  [[nodiscard]] bool locate(std::int32_t face, double u, double v, Place& place) const noexcept override {
    double xyz[3], uv[2];
    if (!host_.locate(face, u, v, xyz, uv)) return false;
    place = {xyz[0], xyz[1], xyz[2], uv[0], uv[1]};
    return true;
  }

  [[nodiscard]] std::vector<FaceLook> faces() const override { return faces_of_shape(file_, host_); }
  [[nodiscard]] std::vector<std::int32_t> face_numbers() const override {
    std::vector<std::int32_t> numbers(static_cast<std::size_t>(host_.face_count()));
    std::iota(numbers.begin(), numbers.end(), 1);
    return numbers;
  }

  [[nodiscard]] std::string face_name(std::int32_t face) const override {
    return face >= 1 && face <= host_.face_count() ? host_.face_name(face) : "";
  }
  [[nodiscard]] std::int32_t whole_face(std::int32_t face) const override { return host_.whole_face(face); }
  [[nodiscard]] std::int32_t whole_curve(std::int32_t curve) const override { return host_.whole_edge(curve); }
  [[nodiscard]] std::vector<std::int32_t> parts(std::int32_t face) const override { return host_.parts(face); }
  [[nodiscard]] std::vector<std::int32_t> curves(std::int32_t face) const override { return host_.curves(face); }
  [[nodiscard]] bool on_curve(std::int32_t face, std::int32_t ic, double share, double& u,
                              double& v) const noexcept override {
    double uv[2];
    if (!host_.on_curve(face, ic, share, uv)) return false;
    u = uv[0], v = uv[1];
    return true;
  }
  [[nodiscard]] std::vector<std::string> losses() const override { return file_.losses; }

  [[nodiscard]] std::vector<std::string> kinks() const override {
    std::vector<std::string> sentences;
    const std::vector<int>& bent = host_.bent_faces();
    if (bent.empty()) return sentences;
    for (const carreau_occ::Danger& kink : carreau_occ::find_kinks(file_))
      if (std::find(bent.begin(), bent.end(), kink.face) != bent.end()) sentences.push_back(sentence(kink, host_));
    return sentences;
  }

  [[nodiscard]] bool closed() const override { return host_.is_closed(); }

  [[nodiscard]] std::string gaps() const override {
    const carreau_occ::Gaps gaps = carreau_occ::measure_gaps(file_);
    if (!(gaps.largest > 0)) return "none";
    char text[160];
    std::snprintf(text, sizeof text, "largest %.3g (edge %d on face %d); %d above twice the tolerance of their edges",
                  gaps.largest, gaps.edge, gaps.face, gaps.beyond);
    return text;
  }

  [[nodiscard]] std::string summary() const override {
    const auto count = [](int n, const char* one, const char* many) {
      return std::to_string(n) + " " + (n == 1 ? one : many);
    };
    return count(host_.face_count(), "face", "faces") + ", " + count(host_.edge_count(), "edge", "edges") + ", " +
           count(host_.vertex_count(), "vertex", "vertices") + (host_.is_closed() ? ", closed" : ", open") +
           (file_.unit.empty() ? "" : ", lengths in " + file_.unit);
  }

 private:
  carreau_occ::FaultTrap trap_;  // before the file is read
  carreau_occ::ShapeFile file_;
  carreau_occ::BrepHost host_;
};

void print_report(const carreau_occ::ShapeReport& r, const carreau_occ::ShapeFile& file,
                  const carreau_occ::BrepHost& host, int limit) {
  std::printf("solids      %d\nshells      %d\nfaces       %d\nedges       %d\nvertices    %d\n", r.solids, r.shells,
              r.faces, r.edges, r.vertices);
  std::printf("unit        %s\n", file.unit.empty() ? "not said" : file.unit.c_str());
  std::printf("diagonal    %s\narea        %s\nvolume      %s\n", number(r.diagonal).c_str(), number(r.area).c_str(),
              number(r.volume).c_str());
  std::string kinds;
  for (const auto& [name, n] : r.surfaces) kinds += (kinds.empty() ? "" : ", ") + std::to_string(n) + " " + name;
  std::printf("surfaces    %s\n", kinds.c_str());
  std::printf("seams       %d\npoles       %d\nclosed edges %d\ninner wires %d\ninternal    %d\n", r.seams, r.poles,
              r.closed_edges, r.inner_wires, r.internal_edges);
  std::printf("shortest edge %s\nlargest tolerance %s\nlargest gap %s\n", number(r.shortest_edge).c_str(),
              number(r.largest_tolerance).c_str(), number(r.largest_gap).c_str());
  std::map<std::string, int> count;
  for (const carreau_occ::Danger& danger : r.dangers) ++count[danger.kind];
  if (!file.losses.empty()) std::printf("not read: %d\n", static_cast<int>(file.losses.size()));
  for (std::size_t i = 0; i < file.losses.size() && i <= static_cast<std::size_t>(limit); ++i)
    std::printf("  %s\n", i == static_cast<std::size_t>(limit) ? "..." : file.losses[i].c_str());
  if (count.empty() && file.losses.empty()) std::puts("nothing looks dangerous");
  std::map<std::string, int> told;
  for (const carreau_occ::Danger& danger : r.dangers) {
    int& n = told[danger.kind];
    if (n == 0) std::printf("%s: %d\n", danger.kind.c_str(), count[danger.kind]);
    if (++n <= limit) std::printf("  %s\n", sentence(danger, host).c_str());
    if (n == limit + 1) std::puts("  ...");
  }
}

nlohmann::ordered_json json_of(const carreau_occ::ShapeReport& r, const carreau_occ::ShapeFile& file,
                               const carreau_occ::BrepHost& host, const InfoOptions& options) {
  nlohmann::ordered_json surfaces = nlohmann::ordered_json::object(), dangers = nlohmann::ordered_json::array();
  for (const auto& [name, n] : r.surfaces) surfaces[name] = n;
  for (const carreau_occ::Danger& d : r.dangers)
    dangers.push_back({{"kind", d.kind},
                       {"face", d.face},
                       {"edge", d.edge},
                       {"name", d.face > 0 ? host.face_name(d.face) : ""},
                       {"value", d.value},
                       {"text", sentence(d, host)}});
  return {{"input", options.input},
          {"solids", r.solids},
          {"shells", r.shells},
          {"faces", r.faces},
          {"edges", r.edges},
          {"vertices", r.vertices},
          {"unit", file.unit},
          {"diagonal", r.diagonal},
          {"area", r.area},
          {"volume", r.volume},
          {"surfaces", surfaces},
          {"seams", r.seams},
          {"poles", r.poles},
          {"closed_edges", r.closed_edges},
          {"inner_wires", r.inner_wires},
          {"internal_edges", r.internal_edges},
          {"shortest_edge", r.shortest_edge},
          {"largest_tolerance", r.largest_tolerance},
          {"largest_gap", r.largest_gap},
          {"not_read", file.losses},
          {"dangers", dangers}};
}

}  // namespace

int print_cad_info(const InfoOptions& options) try {
  const carreau_occ::FaultTrap trap;
  const carreau_occ::ShapeFile file = carreau_occ::read_shape(options.input);
  const carreau_occ::BrepHost host(file);
  const carreau_occ::ShapeReport report = carreau_occ::inspect(file);
  if (options.json) {
    nlohmann::ordered_json value = json_of(report, file, host, options);
    if (options.faces) value["face_list"] = faces_json(faces_of_shape(file, host));
    print_json("info", value);
    return 0;
  }
  print_report(report, file, host, options.limit);
  if (options.faces) print_faces(faces_of_shape(file, host));
  return 0;
} catch (const Failure&) {
  throw;
} catch (const std::bad_alloc&) {
  throw;
} catch (const std::exception& error) {
  throw Failure(error.what());
}

std::unique_ptr<CadInput> open_cad(const std::string& path, const ReadingProgress& progress) {
  try {
    return std::make_unique<OpenCascadeInput>(path, progress);
  } catch (const std::bad_alloc&) {
    throw Failure("'" + path + "': out of memory.");
  } catch (const std::exception& error) {
    throw Failure(error.what());
  }
}

}  // namespace command
