// Bezier patches as a host of the C interface.
#include "bezier_file.h"
#include "failure.h"
#include "model_input.h"
#include "text_file.h"

namespace command {
namespace {

/// Bernstein polynomials of a degree at t, [0], and their first and second derivatives.
using Basis = std::array<std::array<double, largest_bezier_degree + 1>, 3>;

/// B_i^k = (1 - t) B_i^(k-1) + t B_(i-1)^(k-1); derivatives are differences of those of lower degrees.
void bernstein(int degree, double t, int order, Basis& basis) {
  std::array<double, largest_bezier_degree + 1> b{1};
  for (int k = 0; k <= degree; ++k) {
    if (k == degree - 1 && order >= 1)
      for (int i = 0; i <= degree; ++i) basis[1][i] = degree * ((i > 0 ? b[i - 1] : 0) - (i < degree ? b[i] : 0));
    if (k == degree - 2 && order >= 2)
      for (int i = 0; i <= degree; ++i)
        basis[2][i] = degree * (degree - 1) *
                      ((i > 1 ? b[i - 2] : 0) - (i > 0 && i < degree ? 2 * b[i - 1] : 0) + (i < degree - 1 ? b[i] : 0));
    if (k == degree) break;
    for (int i = k + 1; i > 0; --i) b[i] = (i <= k ? (1 - t) * b[i] : 0) + t * b[i - 1];
    b[0] *= 1 - t;
  }
  basis[0] = b;
  if (degree < 2) basis[2].fill(0);
}

void sum(const BezierPatch& patch, const Basis& u, int du, const Basis& v, int dv, double* result) {
  result[0] = result[1] = result[2] = 0;
  const std::array<double, 3>* point = patch.control.data();
  for (int i = 0; i <= patch.m; ++i)
    for (int j = 0; j <= patch.n; ++j, ++point) {
      const double weight = u[du][i] * v[dv][j];
      for (int x = 0; x < 3; ++x) result[x] += weight * (*point)[x];
    }
}

/// u1 v1 of the four corners, counterclockwise, and the first one again.
constexpr double corners[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};

class BezierInput final : public ModelInput {
 public:
  BezierInput(std::vector<BezierPatch> patches, const std::string& path)
      : ModelInput(model_of(patches.size())), patches_(std::move(patches)) {
    measure(path);
  }

  [[nodiscard]] bool locate(std::int32_t face, double u, double v, Place& place) const noexcept override {
    double S[3];
    evaluate(patch(face), u, v, 0, S, nullptr, nullptr, nullptr, nullptr, nullptr);
    place = {S[0], S[1], S[2], u, v};
    return true;
  }

  [[nodiscard]] bool on_curve(std::int32_t face, std::int32_t ic, double share, double& u,
                              double& v) const noexcept override {
    double C[2], Ct[2], Ctt[2];
    side(face, ic, share, 0, C, Ct, Ctt, nullptr);
    u = C[0], v = C[1];
    return true;
  }

 private:
  static FaceModel model_of(std::size_t count) {
    FaceModel model;
    for (std::size_t k = 1; k <= count; ++k) {
      FaceModel::Face face{.ref = static_cast<std::int32_t>(k), .curves = {}, .points = {}};
      face.curves.resize(4);  // references 0: sides that meet are found
      model.faces.push_back(std::move(face));
    }
    return model;
  }

  [[nodiscard]] const BezierPatch& patch(std::int32_t face) const {
    return patches_[static_cast<std::size_t>(face - 1)];
  }

  static void evaluate(const BezierPatch& p, double u, double v, int order, double* S, double* Su, double* Sv,
                       double* Suu, double* Suv, double* Svv) {
    Basis bu, bv;
    bernstein(p.m, u, order, bu);
    bernstein(p.n, v, order, bv);
    sum(p, bu, 0, bv, 0, S);
    if (order >= 1) sum(p, bu, 1, bv, 0, Su), sum(p, bu, 0, bv, 1, Sv);
    if (order >= 2) sum(p, bu, 2, bv, 0, Suu), sum(p, bu, 1, bv, 1, Suv), sum(p, bu, 0, bv, 2, Svv);
  }

  static std::int32_t surface(std::int32_t face, std::int64_t n, const double* uv, std::int32_t order, double* S,
                              double* Su, double* Sv, double* Suu, double* Suv, double* Svv, void* user) {
    const BezierPatch& p = static_cast<const BezierInput*>(user)->patch(face);
    const auto row = [](double* array, std::int64_t i) { return array == nullptr ? nullptr : array + 3 * i; };
    for (std::int64_t i = 0; i < n; ++i)
      evaluate(p, uv[2 * i], uv[2 * i + 1], order, row(S, i), row(Su, i), row(Sv, i), row(Suu, i), row(Suv, i),
               row(Svv, i));
    return 0;
  }

  static std::int32_t interval(std::int32_t, std::int32_t, double* a, double* b, void*) {
    *a = 0, *b = 1;
    return 0;
  }

  static std::int32_t side(std::int32_t, std::int32_t ic, double t, std::int32_t, double* C, double* Ct, double* Ctt,
                           void*) {
    const double *from = corners[ic - 1], *to = corners[ic];
    for (int i = 0; i < 2; ++i) {
      C[i] = (1 - t) * from[i] + t * to[i];
      Ct[i] = to[i] - from[i];
      Ctt[i] = 0;
    }
    return 0;
  }

  [[nodiscard]] std::string kind(std::int32_t face) const override {
    return "Bezier " + std::to_string(patch(face).m) + " x " + std::to_string(patch(face).n);
  }

  carreau_status give_geometry(carreau_session* session) override {
    carreau_cad cad{};
    cad.struct_size = sizeof cad;
    cad.user = this;
    cad.surface_order = cad.curve_order = 2;
    cad.reentrant = 1;
    cad.surface_batch = surface;
    cad.curve_interval = interval;
    cad.curve = side;
    return carreau_set_cad(session, &cad);
  }

  std::vector<BezierPatch> patches_;
};

}  // namespace

std::unique_ptr<CadInput> open_bezier(const std::string& path) {
  return std::make_unique<BezierInput>(parse_bezier(read_text(path), path), path);
}

}  // namespace command
