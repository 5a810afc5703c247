// SPDX-License-Identifier: BSD-3-Clause
/// carreau_cad.hpp: carreau_cad.h for C++20, header only, in the manner of carreau.hpp. Link libcarreau_cad.
///
///     carreau::Session session;
///     carreau::CadFile file("part.step");
///     file.add_to(session);
///     session.set("hphydef", 2.0);
///     session.generate();
#ifndef CARREAU_CAD_HPP
#define CARREAU_CAD_HPP

#include "carreau_cad.h"

#include <carreau.hpp>

#include <array>
#include <cstddef>
#include <span>

namespace carreau {

/// A face of a CAD file: carreau_cad_face with its own texts.
struct CadFace {
  int number = 0; ///< from 1
  std::string name, why;
  int rgb = -1;
  int solid = 0, other_solid = 0; ///< from 1; triangles look out of `solid`, into `other_solid`; 0: none
  std::string solid_name, other_solid_name, layer;
};
/// A row of the tree of a file: carreau_cad_tree_row.
struct CadTreeRow {
  std::string kind, name, layer;
  int depth = 0, number = 0, rgb = -1, faces = 0;
};
/// The figures of a face: carreau_cad_figures.
struct CadFigures {
  std::string kind;
  double area = 0, perimeter = 0;
  Point3 low{}, high{};
};
/// A potential meshing problem: carreau_cad_danger.
struct CadDanger {
  std::string kind, sentence;
  int face = 0, edge = 0;
  double value = 0;
  bool cut = false;
};
/// A feature below the option min_feature: carreau_cad_small_feature.
struct CadSmallFeature {
  std::string kind, faces;
  double size = 0;
  Point3 place{};
  bool removed = false;
};
/// A point of a face, and the parameters that its surface has there in the file.
struct CadPlace {
  Point3 xyz{};
  Point2 uv{};
};

/// A STEP, IGES or BREP file. Sessions that it was added to do not need it.
class CadFile {
 public:
  using Progress = std::function<bool(double fraction)>; ///< returns true to go on, false to stop

  /// Reads a file: see read.
  explicit CadFile(const std::string& path, const Progress& progress = {}, bool trap_faults = false) { read(path, progress, trap_faults); }
  /// Takes over a handle of the C interface.
  explicit CadFile(carreau_cad_file* made) : handle_(made) {}
  /// The handle of the C interface; it stays this object's.
  [[nodiscard]] carreau_cad_file* get() const { return handle_.get(); }

  /// Replaces the content. trap_faults: signals of OpenCASCADE become errors, for programs that own their process.
  void read(const std::string& path, const Progress& progress = {}, bool trap_faults = false) {
    auto options = detail::sized<carreau_cad_options>();
    options.trap_faults = trap_faults ? 1 : 0;
    read(path, options, progress);
  }
  /// Does this with all options but progress and user, which this object sets.
  void read(const std::string& path, const carreau_cad_options& options, const Progress& progress = {}) {
    listen(progress, options, [&](const carreau_cad_options& all) { return carreau_cad_read(get(), path.c_str(), &all); });
  }
  /// Replaces the content by the bytes of a file; format: "step", "iges", "brep", or "" (found from the bytes).
  void read(std::span<const std::byte> bytes, const std::string& format = "",
            const carreau_cad_options& options = detail::sized<carreau_cad_options>(), const Progress& progress = {}) {
    listen(progress, options, [&](const carreau_cad_options& all) {
      return carreau_cad_read_bytes(get(), bytes.data(), static_cast<std::int64_t>(bytes.size()), format.c_str(), &all);
    });
  }
  /// Makes parts that touch share faces and edges; tolerance: the largest distance between them, 0: as the file has it.
  void imprint(double tolerance = 0, const Progress& progress = {}) {
    listen(progress, detail::sized<carreau_cad_options>(), [&](const carreau_cad_options& all) {
      return carreau_cad_imprint(get(), tolerance, all.progress, all.user);
    });
  }
  /// Cuts faces across the plane, or adds the other half of a body on one side of it.
  void mirror(const std::array<double, 3>& point, const std::array<double, 3>& normal) {
    done(carreau_cad_mirror(get(), point.data(), normal.data()));
  }
  /// Names all solids; colours: none, or 0xRRGGBB of each, -1: none.
  void name_solids(const std::vector<std::string>& names, const std::vector<std::int32_t>& colours = {}) {
    std::vector<const char*> texts;
    for (const std::string& name : names) texts.push_back(name.c_str());
    if (!colours.empty() && colours.size() != names.size()) detail::fail(CARREAU_ERR_ARGUMENT, "one colour a name");
    done(carreau_cad_name_solids(get(), static_cast<std::int64_t>(texts.size()), texts.data(), colours.empty() ? nullptr : colours.data()));
  }
  /// Adds all faces to a session.
  void add_to(Session& session) const { session.done(carreau_cad_add(get(), session.get())); }
  /// Sets a size on a face by its number, or on all faces of a name; with hphy_flag = 2.
  void set_face_size(const std::string& face, double size) { done(carreau_cad_set_face_size(get(), face.c_str(), size)); }

  /// The same on a vertex (dimension 0), an edge (1), a face (2) or all faces of a solid (3), by number.
  void set_size(int dimension, int number, double size) { done(carreau_cad_set_size(get(), dimension, number, size)); }

  [[nodiscard]] carreau_cad_content info() const { return filled(carreau_cad_info); }
  /// Entities that could not be read: a sentence each.
  [[nodiscard]] std::vector<std::string> losses() const {
    std::vector<std::string> out;
    for (std::int64_t i = 0; const char* loss = carreau_cad_loss(get(), i); ++i) out.emplace_back(loss);
    return out;
  }
  /// The features that the option min_feature found, and whether each is gone.
  [[nodiscard]] std::vector<CadSmallFeature> small_features() const {
    std::vector<CadSmallFeature> out;
    for (std::int64_t i = 0; i < info().small_features; ++i) {
      auto feature = detail::sized<carreau_cad_small_feature>();
      done(carreau_cad_small_feature_at(get(), i, &feature));
      out.push_back({feature.kind, feature.faces, feature.size, {feature.place[0], feature.place[1], feature.place[2]}, feature.removed != 0});
    }
    return out;
  }
  [[nodiscard]] CadFace face(int number) const {
    auto face = detail::sized<carreau_cad_face>();
    done(carreau_cad_file_face(get(), number, &face));
    return {face.number, face.name, face.why, face.rgb, face.solid, face.other_solid, face.solid_name, face.other_solid_name, face.layer};
  }
  /// The name of a vertex (dimension 0), an edge (1), a face (2) or a solid (3); "": none.
  [[nodiscard]] std::string entity_name(int dimension, int number) const { return carreau_cad_entity_name(get(), dimension, number); }
  /// Assemblies, parts, solids, and entities with a name, a colour or a layer of their own.
  [[nodiscard]] std::vector<CadTreeRow> tree() const {
    std::vector<CadTreeRow> out;
    for (std::int64_t i = 0; i < info().tree_rows; ++i) {
      auto row = detail::sized<carreau_cad_tree_row>();
      done(carreau_cad_tree_at(get(), i, &row));
      out.push_back({row.kind, row.name, row.layer, row.depth, row.number, row.rgb, row.faces});
    }
    return out;
  }
  /// Solids whose faces lie on each other, and the common area.
  [[nodiscard]] std::vector<carreau_cad_contact> contacts() const {
    std::int64_t n = 0;
    done(carreau_cad_count_contacts(get(), &n));
    std::vector<carreau_cad_contact> out;
    for (std::int64_t i = 0; i < n; ++i) {
      out.push_back(detail::sized<carreau_cad_contact>());
      done(carreau_cad_contact_at(get(), i, &out.back()));
    }
    return out;
  }
  [[nodiscard]] CadFigures measure_face(int number) const {
    auto found = detail::sized<carreau_cad_figures>();
    done(carreau_cad_measure_face(get(), number, &found));
    return {found.kind, found.area, found.perimeter, {found.low[0], found.low[1], found.low[2]}, {found.high[0], found.high[1], found.high[2]}};
  }
  /// tiny: a share of the diagonal; 0: 1e-3
  carreau_cad_report inspect(double tiny = 0) {
    auto out = detail::sized<carreau_cad_report>();
    done(carreau_cad_inspect(get(), tiny, &out));
    return out;
  }
  /// Kinds of surfaces and the number of their faces; after inspect.
  [[nodiscard]] std::vector<std::pair<std::string, int>> surfaces(const carreau_cad_report& report) const {
    std::vector<std::pair<std::string, int>> out;
    for (std::int64_t i = 0; i < report.kinds; ++i) {
      const char* kind = "";
      std::int32_t count = 0;
      done(carreau_cad_surfaces(get(), i, &kind, &count));
      out.emplace_back(kind, count);
    }
    return out;
  }
  /// The problems that inspect has found, worst first of each kind.
  [[nodiscard]] std::vector<CadDanger> dangers(const carreau_cad_report& report) const {
    std::vector<CadDanger> out;
    for (std::int64_t i = 0; i < report.dangers; ++i) {
      auto danger = detail::sized<carreau_cad_danger>();
      done(carreau_cad_danger_at(get(), i, &danger));
      out.push_back({danger.kind, danger.sentence, danger.face, danger.edge, danger.value, danger.cut != 0});
    }
    return out;
  }
  [[nodiscard]] carreau_cad_gaps measure_gaps() const { return filled(carreau_cad_measure_gaps); }

  [[nodiscard]] CadPlace point(int face, const Point2& uv) const {
    CadPlace out;
    place_found(carreau_cad_point(get(), face, uv[0], uv[1], out.xyz.data(), out.uv.data()));
    return out;
  }
  /// (u, v) at a share, 0 to 1, of curve ic of a face.
  [[nodiscard]] Point2 curve_point(int face, int ic, double share) const {
    Point2 out{};
    place_found(carreau_cad_curve_point(get(), face, ic, share, out.data()));
    return out;
  }
  /// Edges of the curves of a face, in their order.
  [[nodiscard]] std::vector<std::int32_t> curves(int face) const { return counted(face, carreau_cad_curves); }
  /// References of the parts of a face, ascending.
  [[nodiscard]] std::vector<std::int32_t> parts(int face) const { return counted(face, carreau_cad_parts); }
  [[nodiscard]] int whole_face(int ref) const { return carreau_cad_whole_face(get(), ref); }
  [[nodiscard]] int whole_edge(int ref) const { return carreau_cad_whole_edge(get(), ref); }

 private:
  struct Closed {
    void operator()(carreau_cad_file* file) const { carreau_cad_close(file); }
  };

  /// Calls call(options) with a progress that calls `progress`, whose exceptions come back.
  template <typename Call>
  void listen(const Progress& progress, carreau_cad_options options, Call&& call) {
    struct Held {
      const Progress& progress;
      detail::Faults faults;
    } held{progress, {}};
    options.user = &held;
    options.progress = nullptr;
    if (progress)
      options.progress = [](double fraction, void* user) -> std::int32_t {
        auto& state = *static_cast<Held*>(user);
        return state.faults.guarded([&]() -> std::int32_t { return state.progress(fraction) ? 0 : 1; });
      };
    const carreau_status status = call(options);
    if (status != CARREAU_OK) detail::fail(status, carreau_cad_last_error(get()), {}, held.faults.take());
  }

  static carreau_cad_file* created() {
    carreau_cad_file* out = nullptr;
    if (const carreau_status status = carreau_cad_create(&out); status != CARREAU_OK) detail::fail(status, "");
    return out;
  }
  void done(carreau_status status) const {
    if (status != CARREAU_OK) detail::fail(status, carreau_cad_last_error(get()));
  }
  /// These keep no sentence.
  static void place_found(carreau_status status) {
    if (status != CARREAU_OK) detail::fail(status, "");
  }
  template <typename Struct>
  [[nodiscard]] Struct filled(carreau_status (*fill)(carreau_cad_file*, Struct*)) const {
    auto out = detail::sized<Struct>();
    done(fill(get(), &out));
    return out;
  }
  template <typename Copy>
  [[nodiscard]] std::vector<std::int32_t> counted(int face, Copy&& copy) const {
    std::int64_t n = 0;
    done(copy(get(), face, 0, nullptr, &n));
    std::vector<std::int32_t> out(static_cast<std::size_t>(n));
    if (n > 0) done(copy(get(), face, n, out.data(), &n));
    return out;
  }

  std::unique_ptr<carreau_cad_file, Closed> handle_{created()};
};

/// Reads the bytes of a file and adds all of its faces to a session; format: "step", "iges", "brep", or "" (found from
/// the bytes).
inline CadFile cad_open(Session& session, std::span<const std::byte> bytes, const std::string& format = "") {
  carreau_cad_file* made = nullptr;
  session.done(carreau_cad_open_bytes(session.get(), bytes.data(), static_cast<std::int64_t>(bytes.size()), format.c_str(), nullptr, &made));
  return CadFile(made);
}
/// Reads a file and adds all of its faces to a session.
inline CadFile cad_open(Session& session, const std::string& path) {
  carreau_cad_file* made = nullptr;
  session.done(carreau_cad_open(session.get(), path.c_str(), nullptr, &made));
  return CadFile(made);
}

} // namespace carreau

#endif
