// SPDX-License-Identifier: BSD-3-Clause
/// Sessions: see carreau.hpp.
#ifndef CARREAU_SESSION_HPP
#define CARREAU_SESSION_HPP

#include "callbacks.hpp"
#include "mesh.hpp"

#include <concepts>
#include <limits>

namespace carreau {

/// A curve of a face as Session::add_curve takes it.
struct Curve {
  int type = CARREAU_BOUNDARY; ///< or CARREAU_INTERNAL
  int ref = 0;                 ///< equal for curves that are one in space; 0 for all: found by comparing positions
  std::array<int, 2> ends{};   ///< references of the points at t = a and t = b
};

/// The model of a session, as it is known: with the references that gluing found once a mesh has been made.
struct Model {
  /// As Session::add_face takes it.
  struct FaceRow {
    int ref, orientation;
  };
  /// The reference of its face, and as Session::add_curve takes it.
  struct CurveRow {
    int face, type, ref;
    std::array<int, 2> ends;
  };
  /// As Session::add_point takes it.
  struct PointRow {
    int face, ref;
    Point2 uv;
  };
  std::vector<FaceRow> faces;
  std::vector<CurveRow> curves; ///< face by face
  std::vector<PointRow> points; ///< face by face
};

/// A background mesh of the caller: carreau_background. One of sizes and metrics is given.
struct Background {
  int dimension = 3;                ///< 3: a surface in space; 2: in parameter planes
  std::span<const double> vertices{}; ///< n x dimension
  std::span<const Triangle> triangles{};
  std::span<const std::int32_t> faces{}; ///< of each triangle, dimension 2; empty: any face
  std::span<const double> sizes{};       ///< n
  std::span<const double> metrics{};     ///< n x 6, or n x 3 in dimension 2
};

namespace detail {

/// The data that callbacks reach: its address stays when a session is moved.
struct SessionState {
  carreau_session* session = nullptr;
  std::shared_ptr<Faults> faults = std::make_shared<Faults>(); ///< of geometry, sizes, metrics and fields
  Faults talk;                                                 ///< of messages and progress
  std::vector<std::unique_ptr<HeldMetrics>> metrics; ///< earlier ones, too: the callbacks of a mesh measure it
  std::function<void(int level, std::string_view text)> message;
  std::function<bool(int phase, int entity, double fraction)> progress;

  SessionState() = default;
  SessionState(const SessionState&) = delete;
  SessionState& operator=(const SessionState&) = delete;
  ~SessionState() { carreau_session_free(session); }

  static void on_message(std::int32_t level, const char* text, void* user) {
    auto& state = *static_cast<SessionState*>(user);
    if (state.talk.guarded([&] { state.message(level, text); }) != 0) carreau_stop(state.session);
  }
  static std::int32_t on_progress(std::int32_t phase, std::int32_t entity, double fraction, void* user) {
    auto& state = *static_cast<SessionState*>(user);
    return state.talk.guarded([&]() -> std::int32_t { return state.progress(phase, entity, fraction) ? 0 : 1; });
  }
};

} // namespace detail

/// Geometry, model, parameters, and the mesh made of them. It may be moved, not copied; used by one thread at a time, but for stop.
class Session {
 public:
  Session() {
    if (const carreau_status status = carreau_session_create(&state_->session); status != CARREAU_OK) detail::fail(status, "");
  }
  /// The handle of the C interface; it stays this object's.
  [[nodiscard]] carreau_session* get() const { return state_->session; }
  /// The sentence of the last call, "" after success. For a partial mesh it names the missing faces.
  [[nodiscard]] std::string last_error() const { return carreau_last_error(get()); }
  /// For libraries that work on a session of their caller: makes the last call one that has failed.
  void set_error(Status status, const std::string& sentence) {
    carreau_set_error(get(), static_cast<carreau_status>(status), sentence.c_str());
  }

  // ---- Geometry ----

  void set_geometry(Geometry geometry) { give(std::move(geometry), carreau_set_cad); }
  /// The routines of RT-0232 sec. 3.1, as C functions. They must not throw.
  void set_cad_m(carreau_cad_m routines) {
    routines.struct_size = sizeof routines;
    done(carreau_set_cad_m(get(), &routines));
  }
  /// No callback: there are none any more.
  void set_metrics(Metrics metrics) {
    auto held = std::make_unique<detail::HeldMetrics>(detail::HeldMetrics{std::move(metrics), state_->faults});
    const carreau_metric_callbacks table = detail::table_of(*held);
    done(carreau_set_metric_callbacks(get(), &table));
    state_->metrics.push_back(std::move(held));
  }

  // ---- Model ----

  void clear_model() { done(carreau_model_clear(get())); }
  void add_face(int ref, int orientation = 1) { done(carreau_model_add_face(get(), ref, orientation)); }
  /// "" takes the face in again.
  void leave_out_face(int face, const std::string& why) { done(carreau_model_leave_out_face(get(), face, why.c_str())); }
  void add_curve(int face, const Curve& curve) {
    done(carreau_model_add_curve(get(), face, curve.type, curve.ref, curve.ends[0], curve.ends[1]));
  }
  /// progression: CARREAU_EQUAL, CARREAU_ARITHMETIC or CARREAU_GEOMETRIC; no edges: prescriptions are taken away.
  void divide_curve(int face, int ic, int edges, int progression = CARREAU_EQUAL, double ratio = 1) {
    done(carreau_model_divide_curve(get(), face, ic, edges, progression, ratio));
  }
  void divide_curve_at(int face, int ic, std::span<const double> t) {
    done(carreau_model_divide_curve_at(get(), face, ic, detail::count_of(t.size()), detail::data_or_null(t)));
  }
  void add_point(int face, int ref, const Point2& uv) { done(carreau_model_add_point(get(), face, ref, uv[0], uv[1])); }
  void name_face(int face, const std::string& name) { done(carreau_model_name_face(get(), face, name.c_str())); }
  /// Names points (dimension 0), curves (1), faces (2) or solids (3): entities of one name form a group in files.
  void name_entities(int dimension, const std::vector<std::int32_t>& refs, const std::string& name) {
    done(carreau_model_name_entities(get(), dimension, detail::count_of(refs.size()), refs.data(), name.c_str()));
  }
  /// Solids on both sides of a face, from 1: the solid that its triangles look out of, and the other solid; 0: none.
  void set_face_sides(int face, int solid, int other_solid) { done(carreau_model_set_face_sides(get(), face, solid, other_solid)); }
  void color_face(int face, int rgb) { done(carreau_model_color_face(get(), face, rgb)); }
  void part_of_face(int face, int whole) { done(carreau_model_part_of_face(get(), face, whole)); }
  void part_of_curve(int curve, int whole) { done(carreau_model_part_of_curve(get(), curve, whole)); }
  /// Makes slaves[i] the image of masters[i], faces by reference; `transform` is empty (found) or R | d row by row (3 x 4). Without faces all
  /// pairs are found that it maps.
  void add_periodicity(std::span<const std::int32_t> slaves, std::span<const std::int32_t> masters, std::span<const double> transform = {}) {
    if (slaves.size() != masters.size()) throw std::invalid_argument("slaves and masters must be as many");
    if (!transform.empty() && transform.size() != 12) throw std::invalid_argument("a transform has 12 numbers");
    done(carreau_model_add_periodicity(get(), detail::data_or_null(slaves), detail::data_or_null(masters), detail::count_of(slaves.size()),
                                       detail::data_or_null(transform)));
  }
  /// Pairs by the translation along a direction by the extent of the model.
  void add_period(const Point3& direction) { done(carreau_model_add_period(get(), direction.data())); }
  void read_pardom(const std::string& path) { done(carreau_model_read_pardom(get(), path.c_str())); }
  void write_pardom(const std::string& path) { done(carreau_model_write_pardom(get(), path.c_str())); }
  void check_model() { done(carreau_model_check(get())); }
  [[nodiscard]] Model model() {
    std::int64_t faces = 0, curves = 0, points = 0;
    done(carreau_model_count(get(), &faces, &curves, &points));
    Model out;
    read_faces(out, faces);
    read_curves(out, curves);
    read_points(out, points);
    return out;
  }

  // ---- Parameters ----

  /// Sets a parameter to an integer, a real number or a text.
  template <typename Value>
  void set(const std::string& name, const Value& value) {
    if constexpr (std::integral<Value>) {
      if (!std::in_range<std::int32_t>(value)) detail::fail(CARREAU_ERR_ARGUMENT, (name + " has no place for so large a number.").c_str());
      done(carreau_set_integer(get(), name.c_str(), static_cast<std::int32_t>(value)));
    } else if constexpr (std::floating_point<Value>) {
      done(carreau_set_real(get(), name.c_str(), value));
    } else {
      done(carreau_set_text(get(), name.c_str(), std::string(value).c_str()));
    }
  }
  void set_word(const std::string& name, const std::string& word) { done(carreau_set_word(get(), name.c_str(), word.c_str())); }
  void read_env(const std::string& path) { done(carreau_read_env(get(), path.c_str())); }
  [[nodiscard]] int get_integer(const std::string& name) {
    std::int32_t out = 0;
    done(carreau_get_integer(get(), name.c_str(), &out));
    return out;
  }
  [[nodiscard]] double get_real(const std::string& name) {
    double out = 0;
    done(carreau_get_real(get(), name.c_str(), &out));
    return out;
  }
  [[nodiscard]] std::string get_text(const std::string& name) {
    const char* out = "";
    done(carreau_get_text(get(), name.c_str(), &out));
    return out;
  }
  void reset(const std::string& name) { done(carreau_reset_parameter(get(), name.c_str())); }
  void reset() { done(carreau_reset_parameters(get())); }

  // ---- Many processes ----

  /// Ranks that make meshes together from now on; nullptr: this process is alone.
  void set_team(const carreau_team* team) { done(carreau_set_team(get(), team)); }

  // ---- Messages, progress, stop ----

  /// Level CARREAU_LEVEL_... and a sentence. An empty function: none. An exception of it stops the run.
  void on_message(std::function<void(int level, std::string_view text)> callback) {
    done(carreau_set_message_callback(get(), callback ? detail::SessionState::on_message : nullptr, state_.get()));
    state_->message = std::move(callback);
  }
  /// Phase CARREAU_PHASE_..., reference of the face or curve, share of the run. It returns true to go on, false to stop.
  void on_progress(std::function<bool(int phase, int entity, double fraction)> callback) {
    done(carreau_set_progress_callback(get(), callback ? detail::SessionState::on_progress : nullptr, state_.get()));
    state_->progress = std::move(callback);
  }
  /// From any thread, callback or signal handler.
  void stop() const noexcept { carreau_stop(get()); }

  // ---- Runs and results ----

  Outcome generate() { return outcome(carreau_mesh_generate(get())); }
  /// The part of this process of a mesh that all processes of the team make.
  Outcome generate_part(Mesh& part) { return outcome(carreau_mesh_generate_part(get(), part.get())); }
  Outcome run_env(const std::string& path) { return outcome(carreau_run_env(get(), path.c_str())); }
  /// The latest mesh, always: later runs show in it, too.
  [[nodiscard]] Mesh mesh() {
    carreau_mesh* out = nullptr;
    done(carreau_session_mesh(get(), &out));
    return {out, state_};
  }
  [[nodiscard]] carreau_report report() { return filled(carreau_session_report); }
  [[nodiscard]] std::vector<carreau_interface> interfaces() {
    std::int64_t n = 0;
    done(carreau_session_interface_count(get(), &n));
    std::vector<carreau_interface> out(static_cast<std::size_t>(n), detail::sized<carreau_interface>());
    for (std::int64_t i = 0; i < n; ++i) done(carreau_session_interface(get(), i, &out[static_cast<std::size_t>(i)]));
    return out;
  }
  /// Fields as .exr or .png; struct_size of the options need not be set.
  void write_exr(const std::string& path, const carreau_exr_options& options = {}) {
    const carreau_exr_options in = detail::sized(options);
    done(carreau_write_exr(get(), path.c_str(), &in));
  }

  // ---- Background meshes ----

  void set_background_mesh(const std::string& mesh_path, const std::string& sol_path) {
    done(carreau_set_background_mesh(get(), mesh_path.c_str(), sol_path.c_str()));
  }
  void set_background(const Background& background) {
    const std::size_t n = background.vertices.size() / static_cast<std::size_t>(std::max(background.dimension, 1));
    const std::size_t tensor = background.dimension == 2 ? 3 : 6;
    const auto fits = [](std::size_t size, std::size_t wanted) { return size == 0 || size == wanted; };
    if (!fits(background.faces.size(), background.triangles.size()) || !fits(background.sizes.size(), n) ||
        !fits(background.metrics.size(), n * tensor))
      detail::fail(CARREAU_ERR_ARGUMENT, "The arrays of a background mesh have numbers of rows that do not agree.");
    auto in = detail::sized<carreau_background>();
    in.dimension = background.dimension;
    in.vertex_count = detail::count_of(n);
    in.triangle_count = detail::count_of(background.triangles.size());
    in.vertices = detail::data_or_null(background.vertices);
    in.triangles = detail::flat(background.triangles);
    in.faces = detail::data_or_null(background.faces);
    in.sizes = detail::data_or_null(background.sizes);
    in.metrics = detail::data_or_null(background.metrics);
    done(carreau_set_background(get(), &in));
  }
  void set_vertex_sizes(std::span<const double> sizes) {
    done(carreau_set_vertex_sizes(get(), detail::count_of(sizes.size()), detail::data_or_null(sizes)));
  }
  void set_vertex_metrics(std::span<const Tensor3> metrics) {
    done(carreau_set_vertex_metrics(get(), detail::count_of(metrics.size()), detail::flat(metrics)));
  }
  /// Sizes near points (a, a, a), edges (a, b, b) and triangles: carreau_add_attractor. vertices: 3 n numbers.
  void add_attractor(std::span<const double> vertices, std::span<const Triangle> elements, double size, double surrounding, double reach) {
    done(carreau_add_attractor(get(), detail::count_of(vertices.size() / 3), detail::data_or_null(vertices),
                               detail::count_of(elements.size()), detail::flat(elements), size, surrounding, reach));
  }
  void clear_attractors() { done(carreau_clear_attractors(get())); }
  /// Rows of cells along curves, by their references: carreau_add_layers.
  void add_layers(std::span<const std::int32_t> curves, double first, double ratio, std::int32_t count) {
    done(carreau_add_layers(get(), detail::count_of(curves.size()), detail::data_or_null(curves), first, ratio, count));
  }
  void clear_layers() { done(carreau_clear_layers(get())); }
  /// Measures a set of layers of the last mesh, from 0 in the order of add_layers().
  [[nodiscard]] carreau_layers_report layers_report(std::int64_t index = 0) {
    carreau_layers_report report{};
    report.struct_size = sizeof report;
    done(carreau_session_layers(get(), index, &report));
    return report;
  }
  void clear_background() { done(carreau_clear_background(get())); }
  [[nodiscard]] carreau_background_report background_report() { return filled(carreau_session_background); }

  // ---- For the other headers of this interface, and for calls of the C interface beside it ----

  /// @cond INTERNAL
  /// Throws the error of a status of a call on this session, with the exception of a callback nested in it. An exception of
  /// messages or progress that came too late to stop the call is rethrown unchanged.
  void done(carreau_status status) const {
    const std::exception_ptr talk = state_->talk.take(), other = state_->faults->take();
    if (status == CARREAU_OK) {
      if (talk) std::rethrow_exception(talk);
      return;
    }
    auto place = detail::sized<carreau_error_place>();
    carreau_last_error_place(get(), &place);
    detail::fail(status, carreau_last_error(get()), place, talk ? talk : other);
  }
  /// The same, but for a mesh that lacks faces, whose status is an outcome; last_error stays.
  [[nodiscard]] Outcome outcome(carreau_status status) const {
    done(status == CARREAU_ERR_PARTIAL ? CARREAU_OK : status);
    return status == CARREAU_OK ? Outcome::complete : Outcome::partial;
  }
  /// A struct that a function of the C interface fills.
  template <typename Struct>
  [[nodiscard]] Struct filled(carreau_status (*fill)(carreau_session*, Struct*)) const {
    auto out = detail::sized<Struct>();
    done(fill(get(), &out));
    return out;
  }
  /// Hands callbacks to a function of the C interface that keeps them until it releases them.
  void give(Geometry geometry, carreau_status (*take)(carreau_session*, const carreau_cad*)) {
    const auto held = std::make_shared<detail::HeldGeometry>(detail::HeldGeometry{std::move(geometry), state_->faults, nullptr});
    held->self = held;
    const carreau_cad cad = detail::table_of(*held);
    const carreau_status status = take(get(), &cad);
    if (status != CARREAU_OK) held->self.reset(); // the library does not release callbacks that it has not taken
    done(status);
  }
  /// The store of exceptions of callbacks that run in calls of this session.
  [[nodiscard]] detail::Faults& faults() const { return *state_->faults; }
  /// @endcond

 private:
  void read_faces(Model& out, std::int64_t n) {
    std::vector<std::int32_t> refs(static_cast<std::size_t>(n)), orientations(refs.size());
    done(carreau_model_faces(get(), n, refs.data(), orientations.data()));
    for (std::size_t i = 0; i < refs.size(); ++i) out.faces.push_back({refs[i], orientations[i]});
  }
  void read_curves(Model& out, std::int64_t n) {
    std::vector<std::int32_t> faces(static_cast<std::size_t>(n)), types(faces.size()), refs(faces.size()), ends(2 * faces.size());
    done(carreau_model_curves(get(), n, faces.data(), types.data(), refs.data(), ends.data()));
    for (std::size_t i = 0; i < refs.size(); ++i) out.curves.push_back({faces[i], types[i], refs[i], {ends[2 * i], ends[2 * i + 1]}});
  }
  void read_points(Model& out, std::int64_t n) {
    std::vector<std::int32_t> faces(static_cast<std::size_t>(n)), refs(faces.size());
    std::vector<Point2> uv(faces.size());
    done(carreau_model_points(get(), n, faces.data(), refs.data(), detail::flat(uv)));
    for (std::size_t i = 0; i < refs.size(); ++i) out.points.push_back({faces[i], refs[i], uv[i]});
  }

  std::shared_ptr<detail::SessionState> state_ = std::make_shared<detail::SessionState>();
};

/// All parameters, in alphabetical order; their texts are static.
inline std::vector<carreau_parameter> parameters() {
  std::vector<carreau_parameter> out(static_cast<std::size_t>(carreau_parameter_count()), detail::sized<carreau_parameter>());
  for (std::size_t i = 0; i < out.size(); ++i) carreau_parameter_info(static_cast<std::int32_t>(i), &out[i]);
  return out;
}

} // namespace carreau

#endif
