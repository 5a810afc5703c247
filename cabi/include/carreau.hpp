// SPDX-License-Identifier: BSD-3-Clause
/// carreau.hpp: carreau.h for C++20, header only. Handles free themselves, arrays come in as spans and go out as vectors, callbacks
/// are std::function, and a status that is not CARREAU_OK becomes a carreau::Error.
///
///     carreau::Session session;
///     session.set_geometry({.surface = my_surface, .curve_interval = my_interval, .curve = my_curve});
///     session.add_face(1);
///     session.add_curve(1, {.ref = 1, .ends = {1, 2}}); ...
///     session.set("hphydef", 0.1);
///     session.generate();
///     session.mesh().write("part.vtu");
///
/// A function has the name of its C function without prefix, and its rules: arguments, units, errors and lifetimes are in carreau.h.
/// Comments here describe differences. Results use the structs of the C interface; their struct_size is set already.
#ifndef CARREAU_HPP
#define CARREAU_HPP

#include "carreau/adaptation.hpp"
#include "carreau/atlas.hpp"
#include "carreau/callbacks.hpp"
#include "carreau/delivered.hpp"
#include "carreau/error.hpp"
#include "carreau/geometry.hpp"
#include "carreau/mesh.hpp"
#include "carreau/metric.hpp"
#include "carreau/remesh.hpp"
#include "carreau/session.hpp"

#endif
