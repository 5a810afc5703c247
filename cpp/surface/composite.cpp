#include "surface/composite.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <utility>

#include "support/format.h"
#include "surface/assembly/assembly.h"
#include "surface/assembly/narrow_collapse.h"
#include "surface/assembly/shared_chords.h"
#include "surface/face_job.h"
#include "surface/grade/size_grading.h"
#include "surface/improve/adjacent_lengths.h"
#include "surface/improve/adjacent_sizes.h"
#include "surface/lift/verification.h"
#include "surface/narrow/narrow_faces.h"
#include "surface/narrow/thin_bodies.h"
#include "surface/refine/boundary_refinement.h"

#if defined(__unix__)
#include <unistd.h>
#endif

namespace carreau {

namespace {

// What a triangle may cost while a patch is meshed, the mesh itself and copies included.
constexpr double bytes_per_triangle = 300;
// Curves that are cut between two reports of progress where several threads cut them.
constexpr std::size_t curves_at_once = 64;
// Shares of the progress fraction.
constexpr double curves_share = 0.1, patches_share = 0.85;
// Share of the whole that the gradation takes before these, when there is one.
constexpr double gradation_share = 0.3;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::int64_t triangles_by_memory() {
#if defined(__unix__)
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  if (pages > 0 && page > 0)
    return static_cast<std::int64_t>(0.8 * static_cast<double>(pages) * static_cast<double>(page) / bytes_per_triangle);
#endif
  return INT64_C(50'000'000);
}

// Edges that are shorter than this share of the size prescribed at both ends let sizes grow from them. Those of a curve
// that is one edge or several are at least 0.7 and 0.8 of it.
constexpr double short_share = 0.7;

std::vector<EdgeSizes::Source> short_edges(const FaceDomain& domain, const std::vector<Vec3>& xyz) {
  std::vector<EdgeSizes::Source> edges;
  for (const PlaneEdge& e : domain.plane.edges) {
    if (e.kind == PlaneEdgeKind::degenerate || static_cast<std::size_t>(std::max(e.a, e.b)) >= xyz.size()) continue;
    const double length = norm(xyz[e.b] - xyz[e.a]);
    if (length > 0 && length < short_share * std::min(domain.size[e.a], domain.size[e.b]))
      edges.push_back({xyz[e.a], xyz[e.b], length});
  }
  return edges;
}

class Pipeline {
 public:
  Pipeline(const Model& model, const Topology& topology, const ModelSupports& supports, Cad& cad,
           const CompositeOptions& options, Monitor& monitor)
      : model_(model),
        topology_(topology),
        supports_(supports),
        cad_(cad),
        options_(options),
        monitor_(monitor),
        rules_(model, topology, cad, options.size),
        curve_model_{model, topology, supports.of_face, cad} {
    if (options_.max_triangles <= 0)
      options_.max_triangles = std::min<std::int64_t>(triangles_by_memory(), INT32_MAX / 4);
    left_ = options_.max_triangles;
  }

  CompositeResult run() {
    const auto start = std::chrono::steady_clock::now();
    result_.report.diag = supports_.diag;
    grade();
    discretise();
    if (!narrow_.vanishing.curve.empty()) {
      const std::vector<DiscreteCurve> before = curves_;
      refine();
      mesh_and_assemble();
      if (!collapse_narrow_faces()) {
        // Some face cannot vanish: all are meshed, tips and all, and as many vanish as can.
        begin_ += (1 - begin_) * (curves_share + patches_share);
        narrow_.vanishing = {};
        curves_ = before;
        refine();
        mesh_and_assemble();
        collapse_some_narrow_faces();
      }
    } else {
      refine();
      mesh_and_assemble();
    }
    if (slope() > 0 && rules_.uses_metrics())
      even_out_sizes(tolerated_gradation * options_.gradation,
                     options_.size.geo_guarantee ? geometric_limits(options_.size) : GeometricLimits{}, rules_, cad_,
                     result_, monitor_);
    else if (slope() > 0)
      even_out_lengths(adjacent_lengths * options_.gradation, rules_, cad_, result_, monitor_);
    result_.report.calls = cad_.counts();
    result_.report.seconds_total = seconds_since(start);
    return std::move(result_);
  }

 private:
  void mesh_and_assemble() {
    result_.mesh = {};
    result_.mesh.faces.resize(model_.faces.size());
    result_.spaces.assign(model_.faces.size(), std::nullopt);
    result_.vertex_size.clear();
    result_.curve_size.clear();
    for (std::size_t f = 0; f < model_.faces.size(); ++f) {
      result_.mesh.faces[f].ref = model_.faces[f].ref;
      result_.mesh.faces[f].part_of = model_.faces[f].part_of;
      result_.mesh.faces[f].name = model_.faces[f].name;
      result_.mesh.faces[f].rgb = model_.faces[f].rgb;
    }
    left_ = options_.max_triangles;
    mesh_faces();
    tell(Phase::assembly, 0, curves_share + patches_share);
    separate_chords(model_, topology_, domains_, curves_, cad_, patches_, options_.threads, monitor_);
    refuse_degenerate();
    assemble(model_, topology_, domains_, curves_, patches_, result_);
    keep_prescriptions();
    say_what_is_narrow();
    say_what_is_remarkable();
  }

  void tell(Phase phase, int entity, double share) { monitor_.progress(phase, entity, begin_ + (1 - begin_) * share); }

  // One size everywhere obeys any gradation.
  void grade() {
    if (options_.gradation == 0 || (rules_.constant() && options_.proximity == 0)) return;
    const auto start = std::chrono::steady_clock::now();
    monitor_.progress(Phase::gradation, 0, 0);
    graded_ = grade_model(curve_model_, rules_, options_, supports_.diag, monitor_);
    begin_ = gradation_share;
    result_.graded = graded_.field;
    result_.report.gradation_rounds = graded_.rounds;
    result_.report.gradation_triangles = graded_.triangles;
    result_.report.seconds_gradation = seconds_since(start);
  }
  [[nodiscard]] double slope() const noexcept { return graded_.field ? graded_.field->slope() : 0; }
  [[nodiscard]] SizeLimits limits() const noexcept { return {.field = graded_.field.get()}; }

  void discretise() {
    const auto start = std::chrono::steady_clock::now();
    const std::size_t n = topology_.curves.size();
    curves_.resize(n);
    const auto cut = [this](std::size_t c) {
      const SizeSamples* known = graded_.curves.empty() ? nullptr : &graded_.curves[c];
      curves_[c] = discretise_curve(curve_model_, static_cast<int>(c), rules_, {.lss = options_.lss, .known = known});
    };
    // Rules remember what they were told at points, unless there is nothing to ask.
    const bool alone = !rules_.constant() || !asks_from_threads(options_, cad_);
    const std::size_t at_once = alone ? 1 : curves_at_once;
    std::int64_t edges = 0;
    for (std::size_t begin = 0; begin < n; begin += at_once) {
      const std::size_t end = std::min(begin + at_once, n);
      monitor_.checkpoint();
      tell(Phase::curves, topology_.curves[begin].ref,
           curves_share * static_cast<double>(begin) / static_cast<double>(n));
      run_each(
          end - begin, alone, options_.threads, [&](std::size_t i, Monitor&) { cut(begin + i); }, monitor_);
      for (std::size_t c = begin; c < end; ++c) {
        edges += curves_[c].segments();
        if (edges > options_.max_triangles)
          refuse_triangles(Where{.curve = topology_.curves[c].ref}, static_cast<double>(edges), options_.max_triangles);
      }
    }
    separate_coincident_curves(curve_model_, curves_);
    find_narrow();
    result_.report.seconds_curves = seconds_since(start);
  }

  void find_narrow() {
    narrow_.folded = find_folded_faces(curve_model_, curves_);
    if (options_.narrow_faces == NarrowFaces::keep) return;
    const bool collapse = options_.narrow_faces == NarrowFaces::collapse;
    for (NarrowFace& face : find_narrow_faces(curve_model_, curves_, options_.narrow_ratio))
      if (!face.point || collapse) (face.point ? narrow_.points : narrow_.strips).push_back(std::move(face));
    if (collapse) keep_thin_bodies(curve_model_, curves_, narrow_);
    if (narrow_.empty()) return;
    if (collapse) let_tips_vanish(curve_model_, narrow_);
    match_sides(curve_model_, narrow_.strips, curves_);
  }

  // A narrow face that is to stay and cannot be meshed between its sides is one like others, and all is refined again.
  void refine() {
    const auto start = std::chrono::steady_clock::now();
    for (;;) {
      domains_ = refine_domains(curve_model_, rules_, options_, limits(), narrow_, curves_, monitor_);
      between_.clear();
      for (const NarrowFace& face : narrow_.strips) between_.push_back(mesh_between_sides(curve_model_, face, curves_));
      std::vector<NarrowFace> sound;
      for (std::size_t i = 0; i < between_.size(); ++i)
        if (between_[i].sound) sound.push_back(narrow_.strips[i]);
      if (sound.size() == between_.size() || !narrow_.vanishing.curve.empty()) break;
      narrow_.strips.swap(sound);
    }
    result_.report.seconds_curves += seconds_since(start);
  }

  void place_narrow_patches() {
    for (std::size_t i = 0; i < between_.size(); ++i) {
      const int f = narrow_.strips[i].face;
      domains_.domain[f] = std::move(between_[i].domain);
      patches_[f] = std::move(between_[i].mesh);
    }
  }

  void say_what_is_narrow() {
    for (const int f : narrow_.folded) {
      FaceMesh& mesh = result_.mesh.faces[f];
      mesh.status = FaceStatus::collapsed;
      mesh.why = Where{.face = mesh.ref}.prefix() + "the face has no width: its sides are the same curves";
    }
    for (const NarrowFace& face : narrow_.strips) {
      FaceMesh& mesh = result_.mesh.faces[face.face];
      mesh.status = FaceStatus::mended;
      mesh.why = Where{.face = mesh.ref}.prefix() + "the face is narrow (" + format_number(face.width) +
                 " where the size is " + format_number(face.size) + "): one layer of triangles";
    }
  }

  std::vector<FaceCollapse> collapses() {
    std::vector<FaceCollapse> all;
    for (std::size_t i = 0; i < between_.size(); ++i) {
      const NarrowFace& face = narrow_.strips[i];
      all.push_back({face.face, face.width, face.size, std::move(between_[i].one), {}});
    }
    for (const NarrowFace& face : narrow_.points)
      all.push_back({face.face, face.width, face.size, {}, topology_.curve_of[face.face]});
    return all;
  }
  [[nodiscard]] bool collapse_narrow_faces() {
    const std::vector<char>& gone = narrow_.vanishing.curve;
    for (std::size_t c = 0; c < gone.size(); ++c)
      if (gone[c] != 0)
        for (const CurveUse& use : topology_.curves[c].uses)
          if (result_.mesh.faces[use.face].status == FaceStatus::failed) return false;
    return collapse_together(collapses(), result_);
  }
  void collapse_some_narrow_faces() {
    std::vector<FaceCollapse> all = collapses();
    for (FaceCollapse& face : all) {  // those near a point have been meshed
      const FaceMesh& mesh = result_.mesh.faces[face.face];
      if (!face.one.empty() || mesh.triangles.empty()) continue;
      face.one.emplace_back(mesh.vertex.size());
      std::iota(face.one.front().begin(), face.one.front().end(), 0);
    }
    collapse_one_by_one(all, result_, monitor_);
  }

  /// Jobs of the faces whose domains could be made.
  void make_jobs() {
    const bool reentrant = asks_from_threads(options_, cad_);
    face_of_job_.clear();
    short_edges_.assign(model_.faces.size(), {});
    for (std::size_t f = 0; f < model_.faces.size(); ++f) {
      if (!domains_.domain[f] || patches_[f]) continue;
      const FaceDomain& domain = *domains_.domain[f];
      std::vector<Vec3> on_curves = positions_on_curves(domain, curves_, topology_);
      SizeLimits bound = limits();
      if (options_.edge_gradation > 0 && !rules_.uses_metrics()) {
        short_edges_[f] = {short_edges(domain, on_curves), slope_of_gradation(options_.edge_gradation)};
        if (!short_edges_[f].empty()) bound.edges = &short_edges_[f];
      }
      jobs_.push_back(
          std::make_unique<FaceJob>(PatchInput{.face = static_cast<int>(f),
                                               .ref = model_.faces[f].ref,
                                               .domain = &domain,
                                               .curve_xyz = std::move(on_curves),
                                               .constant_size = bound.want_places() ? std::nullopt : rules_.constant(),
                                               .isotropic = !rules_.uses_metrics(),
                                               .limits = bound,
                                               .slope = slope()},
                                    cad_, rules_, options_, reentrant));
      job(jobs_.size() - 1).limit_triangles(options_.max_triangles);
      face_of_job_.push_back(f);
    }
  }
  FaceJob& job(std::size_t i) { return static_cast<FaceJob&>(*jobs_[i]); }

  /// Longest first, judged by boundaries: the triangles of a square are as the square of its edges.
  std::vector<std::size_t> order_of_jobs() const {
    std::vector<std::size_t> order(jobs_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) {
      return domains_.domain[face_of_job_[a]]->plane.edges.size() >
             domains_.domain[face_of_job_[b]]->plane.edges.size();
    });
    return order;
  }

  void mesh_faces() {
    remarks_.clear();
    patches_.assign(model_.faces.size(), std::nullopt);
    place_narrow_patches();
    for (std::size_t f = 0; f < model_.faces.size(); ++f)
      if (!domains_.domain[f] && !domains_.failure[f].empty()) fail(f, domains_.failure[f]);
    make_jobs();
    tell_progress(0);
    run_stepped(
        jobs_,
        {.threads = options_.threads, .order = order_of_jobs(), .on_finished = [this](std::size_t i) { accept(i); }},
        monitor_);
    jobs_.clear();
  }

  void refuse_degenerate() {
    for (std::size_t f = 0; f < patches_.size(); ++f) {
      if (!patches_[f]) continue;
      const std::string why = degenerate_inside(model_.faces[f].ref, *domains_.domain[f], *patches_[f]);
      if (why.empty()) continue;
      fail(f, why);
      patches_[f].reset();
    }
  }

  void tell_progress(std::size_t next_job) {
    if (next_job == jobs_.size()) return;
    tell(Phase::patches, model_.faces[face_of_job_[next_job]].ref,
         curves_share + patches_share * static_cast<double>(next_job) / static_cast<double>(jobs_.size()));
  }

  void accept(std::size_t i) {
    const std::size_t f = face_of_job_[i];
    const CompositeReport& did = job(i).report();
    result_.report.seconds_sampling += did.seconds_sampling;
    result_.report.seconds_plane += did.seconds_plane;
    result_.report.seconds_lift += did.seconds_lift;
    result_.report.corrections += did.corrections;
    result_.spaces[f] = job(i).take_space();
    if (job(i).failure().empty()) {
      patches_[f] = job(i).take();
      if (!job(i).remark().empty()) remarks_[f] = job(i).remark();
      left_ -= static_cast<std::int64_t>(patches_[f]->plane.triangles.size());
      if (left_ < 0)
        refuse_triangles(Where{.face = model_.faces[f].ref}, static_cast<double>(options_.max_triangles - left_),
                         options_.max_triangles);
    } else {
      fail(f, job(i).failure());
    }
    // One after the other, what is left is known before the next one starts.
    if (options_.threads == 1 && i + 1 < jobs_.size()) job(i + 1).limit_triangles(left_);
    jobs_[i].reset();
    tell_progress(i + 1);
  }

  // At its ends, too, what the curve was cut with: a corner's size is the mean of directions that differ.
  static std::vector<double> sizes_along(DiscreteCurve& curve) {
    std::vector<double> size = std::move(curve.size);
    size.front() = curve.sizes.size_at(0);
    size.back() = curve.sizes.size_at(1);
    return size;
  }

  void keep_prescriptions() {
    for (const DiscreteCurve& curve : curves_) result_.gaps.push_back({curve.gap, curve.gap_use});
    for (std::size_t c = 0; c < curves_.size(); ++c)
      result_.curve_size.push_back(result_.mesh.curves[c].vertices.size() > 1 ? sizes_along(curves_[c])
                                                                              : std::vector<double>{});
    result_.interfaces.resize(model_.faces.size());
    for (std::size_t f = 0; f < result_.interfaces.size(); ++f)
      if (domains_.domain[f])
        result_.interfaces[f] = {std::move(domains_.domain[f]->plane), std::move(domains_.domain[f]->physical)};
  }

  void say_what_is_remarkable() {
    for (const auto& [f, what] : remarks_) {
      FaceMesh& mesh = result_.mesh.faces[f];
      if (mesh.status != FaceStatus::meshed && mesh.status != FaceStatus::mended) continue;
      mesh.status = FaceStatus::mended;
      mesh.why += (mesh.why.empty() ? "" : "; ") + what;
      monitor_.message(Level::warning, what);
    }
  }

  void fail(std::size_t f, const std::string& why) {
    result_.mesh.faces[f].status = FaceStatus::failed;
    result_.mesh.faces[f].why = why;
    monitor_.message(Level::error, why);
  }

  const Model& model_;
  const Topology& topology_;
  const ModelSupports& supports_;
  Cad& cad_;
  CompositeOptions options_;
  Monitor& monitor_;
  SizeRules rules_;
  CurveModel curve_model_;
  std::int64_t left_ = 0;  // triangles still allowed
  GradedModel graded_;
  double begin_ = 0;  // share of the run that was over before the curves
  std::vector<DiscreteCurve> curves_;
  NarrowModel narrow_;
  std::vector<NarrowPatch> between_;  // of narrow_.strips
  RefinedDomains domains_;
  std::vector<std::unique_ptr<SteppedTask>> jobs_;
  std::vector<std::size_t> face_of_job_;
  std::vector<EdgeSizes> short_edges_;  // by face
  std::vector<std::optional<PatchMesh>> patches_;
  std::map<std::size_t, std::string> remarks_;  // of faces
  CompositeResult result_;
};

}  // namespace

CompositeResult mesh_composite(const Model& model, const Topology& topology, const ModelSupports& supports, Cad& cad,
                               const CompositeOptions& options, Monitor& monitor) {
  return Pipeline(model, topology, supports, cad, options, monitor).run();
}

}  // namespace carreau
