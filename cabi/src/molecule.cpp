// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "arguments.h"
#include "carreau_geometry.h"
#include "guard.h"
#include "io/files.h"
#include "io/molecule/molecule_files.h"

using carreau::InvalidArgument;
using carreau::Level;
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

void add(carreau_session& session, const Molecule& molecule, const SurfaceOptions& options) {
  session.refuse_begun();
  session.monitor.begin_run();
  MoleculeSummary summary;
  carreau::BuiltGeometry built = build_surface(molecule, options, session.monitor, &summary);
  if (summary.moved > 0)
    session.monitor.message(Level::warning, "spheres meet so nearly in one point that the radii of " +
                                                std::to_string(summary.moved) +
                                                " atoms were moved by some 1e-9 of themselves");
  session.add_geometry(CARREAU_GEOMETRY_MOLECULE, std::move(built.cad), std::move(built.model));
  session.molecule = std::move(summary);
}

const MoleculeSummary& molecule_of(const carreau_session& session) {
  if (!session.molecule)
    throw StatusError(CARREAU_ERR_SEQUENCE,
                      "there is no molecule: call carreau_add_molecule or carreau_load_molecule first");
  return *session.molecule;
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
    session->refuse_begun();
    const char* const radii_path = read_struct(options, "carreau_molecule_options").radii;
    const carreau::Radii radii =
        radii_path == nullptr ? carreau::Radii{} : carreau::read_radii(carreau::read_file(radii_path), radii_path);
    const carreau::MoleculeFile file = carreau::read_molecule(required(path, "path"), radii);
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

carreau_status carreau_molecule_atom_areas(carreau_session* session, int64_t capacity, double out_convex[],
                                           double out_torus[], double out_concave[]) {
  return guarded(session, [&] {
    const MoleculeSummary& molecule = molecule_of(*session);
    check_capacity(capacity, molecule.numbers.size(), "atoms");
    const auto give = [](const std::vector<double>& areas, double* out) {
      if (out != nullptr) std::copy(areas.begin(), areas.end(), out);
    };
    give(molecule.measures.ball_area, out_convex);
    give(molecule.ball_torus, out_torus), give(molecule.ball_concave, out_concave);
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
