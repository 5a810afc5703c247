// SPDX-License-Identifier: BSD-3-Clause
// `carreau areas`: areas and volumes of molecules in closed form.
#include <carreau_geometry.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/json_output.h"
#include "commands/commands.h"
#include "files/session_handle.h"
#include "inputs/built/molecule_input.h"

namespace command {
namespace {

using Json = nlohmann::ordered_json;

struct Measured {
  std::string surface;
  carreau_molecule_measures measures{};
  std::vector<std::int32_t> refs;
  std::vector<double> areas;
  std::vector<std::string> names;
};

Measured measure(carreau_session* session, const AreasOptions& options, const std::string& surface) {
  Measured m{.surface = surface, .refs = {}, .areas = {}, .names = {}};
  require(session, carreau_model_clear(session));
  load_molecule(session, options.input, {.surface = surface, .probe = options.probe, .radii = options.radii});
  m.measures.struct_size = sizeof m.measures;
  require(session, carreau_molecule_measure(session, &m.measures));
  if (!options.atoms) return m;
  m.refs.resize(static_cast<std::size_t>(m.measures.atoms));
  m.areas.resize(m.refs.size());
  require(session, carreau_molecule_atoms(session, m.measures.atoms, m.refs.data(), m.areas.data()));
  for (std::int64_t i = 0; i < m.measures.atoms; ++i) m.names.emplace_back(carreau_molecule_atom_name(session, i));
  return m;
}

Json json_of(const Measured& m) {
  Json value = {{"surface", m.surface},
                {"area", m.measures.area},
                {"volume", m.measures.volume},
                {"exposed_atoms", m.measures.exposed_atoms},
                {"shells", m.measures.shells},
                {"cavities", m.measures.cavities},
                {"euler_number", m.measures.euler_number},
                {"moved_radii", m.measures.moved_radii},
                {"convex_area", m.measures.convex_area},
                {"torus_area", m.measures.torus_area},
                {"concave_area", m.measures.concave_area}};
  if (m.refs.empty()) return value;
  Json atoms = Json::array();
  for (std::size_t i = 0; i < m.refs.size(); ++i)
    atoms.push_back({{"atom", m.refs[i]}, {"residue", m.names[i]}, {"area", m.areas[i]}});
  value["atom_list"] = atoms;
  return value;
}

void print(const std::vector<Measured>& all) {
  std::printf("atoms       %lld\n", static_cast<long long>(all.front().measures.atoms));
  std::puts("surface         area        volume   exposed atoms   shells   cavities");
  for (const Measured& m : all)
    std::printf("%-7s %12.4f  %12.4f  %14lld %8lld %10lld\n", m.surface.c_str(), m.measures.area, m.measures.volume,
                static_cast<long long>(m.measures.exposed_atoms), static_cast<long long>(m.measures.shells),
                static_cast<long long>(m.measures.cavities));
  if (all.front().refs.empty()) return;
  std::printf("%8s", "atom");
  for (const Measured& m : all) std::printf(" %12s", m.surface.c_str());
  std::puts("  residue");
  for (std::size_t i = 0; i < all.front().refs.size(); ++i) {
    std::printf("%8d", static_cast<int>(all.front().refs[i]));
    for (const Measured& m : all) std::printf(" %12.6f", m.areas[i]);
    std::printf("  %s\n", all.front().names[i].c_str());
  }
}

}  // namespace

int areas(const AreasOptions& options) {
  const SessionHandle session = make_session();
  require(session.get(), carreau_set_integer(session.get(), "threads", options.threads));
  std::vector<Measured> all;
  for (const char* surface : molecule_surfaces) {
    all.push_back(measure(session.get(), options, surface));
    require(session.get(), carreau_set_integer(session.get(), "verb", 0));  // entries left out of the surface are reported once
  }
  if (!options.json) return print(all), 0;
  Json surfaces = Json::array();
  for (const Measured& m : all) surfaces.push_back(json_of(m));
  print_json("areas", {{"input", options.input},
                       {"probe", options.probe},
                       {"atoms", all.front().measures.atoms},
                       {"surfaces", surfaces}});
  return 0;
}

}  // namespace command
