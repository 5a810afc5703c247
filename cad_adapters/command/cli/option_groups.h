// SPDX-License-Identifier: BSD-3-Clause
// Options that several commands have. Each function adds a group to a command; its results must live as long.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "commands/commands.h"

namespace command {

/// Kinds of values, as help shows them; completion of shells knows the first four.
namespace kind {
inline constexpr const char* file = "FILE";
inline constexpr const char* parameter = "NAME";
inline constexpr const char* setting = "NAME=VALUE";
inline constexpr const char* view = "VIEW";
inline constexpr const char* length = "LENGTH";
inline constexpr const char* number = "N";
inline constexpr const char* rounds = "ROUNDS";
}  // namespace kind

/// A check: "" or why not.
std::string not_empty(const std::string& value);
/// `--set`, and options like it, take one value each time they are given.
CLI::Option* repeated(CLI::Option* option);
/// Adds --parts to commands that mesh once.
void add_parts_option(CLI::App* app, MeshOptions& options);
CLI::Option* threads(CLI::App* app, int& value);
void radii(CLI::App* app, std::string& path);

/// Adds the options of sizes, curvature, elements and parameters.
void add_mesh_options(CLI::App* app, MeshOptions& options);
void add_molecule_options(CLI::App* app, MoleculeChoice& choice);
void add_atlas_options(CLI::App* app, AtlasChoice& choice);
void add_grid_options(CLI::App* app, GridChoice& choice);
void add_cad_options(CLI::App* app, CadChoice& choice);
/// Adds the options of triangles.
void add_triangles_options(CLI::App* app, TrianglesChoice& choice);
/// Adds --domain for surfaces by formulas.
void add_domain_option(CLI::App* app, std::string& domain);
/// How fields become sizes: `settings` gets the parameters adapt_*, "NAME=VALUE".
void add_estimator_options(CLI::App* app, std::vector<std::string>& settings);

}  // namespace command
