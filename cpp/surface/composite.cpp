#include "surface/composite.h"

#include <chrono>
#include <limits>
#include <utility>

#include "surface/assembly.h"
#include "surface/boundary_refinement.h"
#include "surface/face_mesher.h"
#include "surface/size_grading.h"
#include "surface/verification.h"

#if defined(__unix__)
#include <unistd.h>
#endif

namespace carreau {

namespace {

// What a triangle may cost while a patch is meshed, the mesh itself and copies included.
constexpr double bytes_per_triangle = 300;
// Shares of the progress fraction.
constexpr double curves_share = 0.1, patches_share = 0.85;
// Share of the whole that the gradation takes before these, when there is one.
constexpr double gradation_share = 0.3;
// Times that a patch is meshed again because the lift disagrees.
constexpr int most_corrections = 3;

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
    result_.mesh.faces.resize(model_.faces.size());
    for (std::size_t f = 0; f < model_.faces.size(); ++f) result_.mesh.faces[f].ref = model_.faces[f].ref;
    grade();
    discretise();
    mesh_faces();
    tell(Phase::assembly, 0, curves_share + patches_share);
    assemble(model_, topology_, domains_, curves_, patches_, result_);
    keep_interfaces();
    result_.report.calls = cad_.counts();
    result_.report.seconds_total = seconds_since(start);
    return std::move(result_);
  }

 private:
  void tell(Phase phase, int entity, double share) { monitor_.progress(phase, entity, begin_ + (1 - begin_) * share); }

  // One size everywhere obeys any gradation.
  void grade() {
    if (options_.gradation == 0 || rules_.constant() || rules_.uses_metrics()) return;
    const auto start = std::chrono::steady_clock::now();
    monitor_.progress(Phase::gradation, 0, 0);
    graded_ = grade_model(curve_model_, rules_, options_, supports_.diag, monitor_);
    begin_ = gradation_share;
    result_.graded = graded_.field;
    result_.report.gradation_rounds = graded_.rounds;
    result_.report.gradation_triangles = graded_.triangles;
    result_.report.seconds_gradation = seconds_since(start);
  }
  [[nodiscard]] SizeLimits limits() const noexcept { return {.field = graded_.field.get()}; }

  void discretise() {
    const auto start = std::chrono::steady_clock::now();
    std::int64_t edges = 0;
    for (std::size_t c = 0; c < topology_.curves.size(); ++c) {
      monitor_.checkpoint();
      tell(Phase::curves, topology_.curves[c].ref,
           curves_share * static_cast<double>(c) / static_cast<double>(topology_.curves.size()));
      const SizeSamples* known = graded_.curves.empty() ? nullptr : &graded_.curves[c];
      curves_.push_back(
          discretise_curve(curve_model_, static_cast<int>(c), rules_, {.lss = options_.lss, .known = known}));
      edges += curves_.back().segments();
      if (edges > options_.max_triangles) refuse(Where{.curve = topology_.curves[c].ref}, static_cast<double>(edges));
    }
    separate_coincident_curves(curve_model_, curves_);
    domains_ = refine_domains(curve_model_, rules_, options_, limits(), curves_, monitor_);
    result_.report.seconds_curves = seconds_since(start);
  }

  [[noreturn]] void refuse(const Where& where, double expected) const {
    throw LimitError(
        where, "the mesh would have about " + format_count(expected) + " triangles or more, beyond the limit of " +
                   format_count(static_cast<double>(options_.max_triangles)) + " (parameter max_triangles)");
  }
  static std::string format_count(double n) { return std::to_string(static_cast<std::int64_t>(n < 9e18 ? n : 9e18)); }

  void mesh_faces() {
    patches_.resize(model_.faces.size());
    for (std::size_t f = 0; f < model_.faces.size(); ++f) {
      const int ref = model_.faces[f].ref;
      monitor_.checkpoint();
      tell(Phase::patches, ref,
           curves_share + patches_share * static_cast<double>(f) / static_cast<double>(model_.faces.size()));
      if (!domains_.domain[f]) {
        fail(f, domains_.failure[f]);
        continue;
      }
      try {
        mesh_face(f);
      } catch (const DomainError& error) {
        const std::string prefix = Where{.face = ref}.prefix();
        const std::string what = error.what();
        fail(f, what.starts_with("face ") ? what : prefix + what);
      }
    }
  }

  void mesh_face(std::size_t f) {
    auto start = std::chrono::steady_clock::now();
    const FaceDomain& domain = *domains_.domain[f];
    const PatchInput input{.face = static_cast<int>(f),
                           .ref = model_.faces[f].ref,
                           .domain = &domain,
                           .curve_xyz = positions_on_curves(domain, curves_, topology_),
                           .constant_size = rules_.constant(),
                           .isotropic = !rules_.uses_metrics(),
                           .limits = limits()};
    ControlSpace space = sample_face(input, cad_, rules_, {}, monitor_);
    result_.report.seconds_sampling += seconds_since(start);
    // Twice the expectation: an estimate must not refuse a mesh that would have fitted.
    if (space.measure() > 2 * static_cast<double>(left_)) refuse(Where{.face = input.ref}, space.measure());
    CompositeOptions options = options_;
    options.max_triangles = left_;
    std::vector<Vec2> suspects;
    for (int round = 0;; ++round) {
      patches_[f] = mesh_patch(input, space, cad_, options, result_.report, monitor_);
      start = std::chrono::steady_clock::now();
      const std::vector<Vec2> places = verify_lift(input, space, cad_, rules_, *patches_[f], monitor_);
      result_.report.seconds_lift += seconds_since(start);
      if (places.empty() || round == most_corrections) break;
      // What the vertices have found is sampled, and the patch meshed again if that was news.
      suspects.insert(suspects.end(), places.begin(), places.end());
      start = std::chrono::steady_clock::now();
      ControlSpace finer = sample_face(input, cad_, rules_, suspects, monitor_);
      result_.report.seconds_sampling += seconds_since(start);
      if (!differ_at(places, space, finer)) break;
      if (finer.measure() > 2 * static_cast<double>(left_)) refuse(Where{.face = input.ref}, finer.measure());
      space = std::move(finer);
      ++result_.report.corrections;
    }
    left_ -= static_cast<std::int64_t>(patches_[f]->plane.triangles.size());
  }

  void keep_interfaces() {
    result_.interfaces.resize(model_.faces.size());
    for (std::size_t f = 0; f < result_.interfaces.size(); ++f)
      if (domains_.domain[f])
        result_.interfaces[f] = {std::move(domains_.domain[f]->plane), std::move(domains_.domain[f]->physical)};
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
  RefinedDomains domains_;
  std::vector<std::optional<PatchMesh>> patches_;
  CompositeResult result_;
};

}  // namespace

CompositeResult mesh_composite(const Model& model, const Topology& topology, const ModelSupports& supports, Cad& cad,
                               const CompositeOptions& options, Monitor& monitor) {
  return Pipeline(model, topology, supports, cad, options, monitor).run();
}

}  // namespace carreau
