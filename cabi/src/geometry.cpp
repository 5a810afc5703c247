#include <algorithm>

#include "arguments.h"
#include "carreau_geometry.h"
#include "guard.h"
#include "io/molecule/molecule_files.h"

using carreau::InvalidArgument;
using carreau::Level;
using carreau::Vec2;
using carreau::Vec3;
using namespace carreau::abi;
using namespace carreau::molecule;

namespace {

SurfaceOptions options_of(const carreau_molecule_options* given, carreau_session& session) {
  const carreau_molecule_options known = read_struct(given, "carreau_molecule_options");
  if (known.surface != CARREAU_VWS && known.surface != CARREAU_SAS && known.surface != CARREAU_SES)
    throw InvalidArgument("the surface of a molecule is " + std::to_string(known.surface) +
                          "; it must be 1 (CARREAU_VWS), 2 (CARREAU_SAS) or 3 (CARREAU_SES)");
  return {.kind = known.surface == CARREAU_VWS   ? SurfaceKind::vws
                  : known.surface == CARREAU_SAS ? SurfaceKind::sas
                                                 : SurfaceKind::ses,
          .probe = known.probe,
          .cavities = known.drop_cavities == 0,
          .threads = std::max(1, session.parameters->integer("threads"))};
}

void check_empty(const carreau_session& session) {
  if (!session.model().faces.empty())
    throw InvalidArgument("the session has faces already: call carreau_model_clear first");
}

void add(carreau_session& session, const Molecule& molecule, const SurfaceOptions& options) {
  check_empty(session);
  session.monitor.begin_run();
  MoleculeSummary summary;
  carreau::BuiltGeometry built = build_surface(molecule, options, session.monitor, &summary);
  if (summary.moved > 0)
    session.monitor.message(Level::warning, "spheres meet so nearly in one point that the radii of " +
                                                std::to_string(summary.moved) +
                                                " atoms were moved by some 1e-9 of themselves");
  session.session.set_model(std::move(built.model));
  session.session.set_cad(built.cad);
  session.has_cad = true;
  session.built = std::move(built.cad);
  session.molecule = std::move(summary);
}

const MoleculeSummary& molecule_of(const carreau_session& session) {
  if (!session.molecule)
    throw StatusError(CARREAU_ERR_SEQUENCE,
                      "there is no molecule: call carreau_add_molecule or carreau_load_molecule first");
  return *session.molecule;
}

carreau::Cad& geometry_of(const carreau_session& session) {
  if (!session.built) throw StatusError(CARREAU_ERR_SEQUENCE, "the geometry of the session is not built in");
  return *session.built;
}

}  // namespace

carreau_status carreau_add_molecule(carreau_session* session, const carreau_molecule_options* options, int64_t n,
                                    const double centers[], const double radii[]) {
  return guarded(session, [&] {
    const SurfaceOptions known = options_of(options, *session);
    if (n < 1) throw InvalidArgument("there is no atom: n is " + std::to_string(n));
    required(centers, "centers"), required(radii, "radii");
    Molecule molecule;
    for (std::int64_t i = 0; i < n; ++i)
      molecule.balls.push_back({{centers[3 * i], centers[3 * i + 1], centers[3 * i + 2]}, radii[i]});
    add(*session, molecule, known);
  });
}

carreau_status carreau_load_molecule(carreau_session* session, const carreau_molecule_options* options,
                                     const char* path) {
  return guarded(session, [&] {
    const SurfaceOptions known = options_of(options, *session);
    check_empty(*session);
    const carreau::MoleculeFile file = carreau::read_molecule(required(path, "path"));
    for (const std::string& remark : file.remarks)
      session->monitor.message(Level::warning, std::string(path) + ": " + remark);
    add(*session, file.molecule, known);
  });
}

carreau_status carreau_molecule_measure(carreau_session* session, carreau_molecule_measures* out_measures) {
  return guarded(session, [&] {
    const MoleculeSummary& molecule = molecule_of(*session);
    const UnionMeasures& m = molecule.measures;
    carreau_molecule_measures known{};
    known.area = m.area, known.volume = m.volume;
    known.atoms = std::int64_t(m.ball_area.size());
    known.exposed_atoms = std::count_if(m.ball_area.begin(), m.ball_area.end(), [](double area) { return area > 0; });
    known.shells = std::int64_t(m.shell_volume.size());
    known.cavities = std::count_if(m.shell_volume.begin(), m.shell_volume.end(), [](double v) { return v < 0; });
    known.euler_number = molecule.euler_number;
    known.moved_radii = std::int64_t(molecule.moved);
    known.torus_area = molecule.torus, known.concave_area = molecule.concave;
    known.convex_area = m.area - molecule.torus - molecule.concave;
    write_struct(known, out_measures, "carreau_molecule_measures");
  });
}

carreau_status carreau_molecule_atoms(carreau_session* session, int64_t capacity, int32_t out_refs[],
                                      double out_areas[]) {
  return guarded(session, [&] {
    const MoleculeSummary& molecule = molecule_of(*session);
    check_capacity(capacity, molecule.numbers.size(), "atoms");
    if (out_refs != nullptr) std::copy(molecule.numbers.begin(), molecule.numbers.end(), out_refs);
    const std::vector<double>& areas = molecule.measures.ball_area;
    if (out_areas != nullptr) std::copy(areas.begin(), areas.end(), out_areas);
  });
}

const char* carreau_molecule_atom_name(carreau_session* session, int64_t atom) {
  const char* name = nullptr;
  guarded(session, [&] {
    const MoleculeSummary& molecule = molecule_of(*session);
    if (atom < 0 || std::uint64_t(atom) >= molecule.numbers.size())
      throw InvalidArgument("there is no atom " + std::to_string(atom));
    session->text = molecule.names.empty() ? "" : molecule.names[std::size_t(atom)];
    name = session->text.c_str();
  });
  return name;
}

carreau_status carreau_geometry_points(carreau_session* session, int32_t face_ref, int64_t n, const double uv[],
                                       double out_xyz[]) {
  return guarded(session, [&] {
    carreau::Cad& cad = geometry_of(*session);
    if (n < 0) throw InvalidArgument("the number of places is " + std::to_string(n));
    if (n > 0) required(uv, "uv"), required(out_xyz, "out_xyz");
    for (std::int64_t i = 0; i < n; ++i) {
      const Vec3 s = surface_at(cad, face_ref, carreau::want_position, Vec2{uv[2 * i], uv[2 * i + 1]}).s;
      std::copy(s.data(), s.data() + 3, out_xyz + 3 * i);
    }
  });
}

carreau_status carreau_geometry_curve(carreau_session* session, int32_t face_ref, int32_t ic, double share,
                                      double out_uv[2]) {
  return guarded(session, [&] {
    carreau::Cad& cad = geometry_of(*session);
    required(out_uv, "out_uv");
    const auto [a, b] = cad.curve_interval(face_ref, ic);
    const Vec2 c = cad.curve(face_ref, ic, carreau::want_position, share < 1 ? a + share * (b - a) : b).c;
    out_uv[0] = c.x(), out_uv[1] = c.y();
  });
}
