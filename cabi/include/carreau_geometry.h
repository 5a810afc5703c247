/* carreau_geometry.h: geometries that the library evaluates itself, without callbacks. C99, and C++ as well.
 *
 *   carreau_session_create(&session);
 *   carreau_molecule_options options = {sizeof options, CARREAU_SAS, 0, 1.4};
 *   carreau_load_molecule(session, &options, "1bna.pdb");       // instead of carreau_set_cad and carreau_model_...
 *   carreau_mesh_generate(session);
 *
 * The rules of carreau.h hold for every function.
 */
#ifndef CARREAU_GEOMETRY_H
#define CARREAU_GEOMETRY_H

#include "carreau.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Molecules ---- */

/* Which surface of a molecule (HDR sec. 4.6.2). */
enum {
  CARREAU_VWS = 1, /* van der Waals: the boundary of the union of the atoms' balls */
  CARREAU_SAS = 2  /* solvent accessible: the same with the radius of a probe added to all radii */
};

typedef struct carreau_molecule_options {
  size_t struct_size;
  int32_t surface;       /* CARREAU_VWS or CARREAU_SAS */
  int32_t drop_cavities; /* 1: inner shells are left out of the model; areas and volumes have them */
  double probe;          /* radius of the probe; CARREAU_VWS does not use it */
} carreau_molecule_options;

/* Makes the surface of n balls the geometry and the model of a session that has no model: see carreau_model_clear. A
 * face is a part of one ball that no other ball covers. Its reference is the rank of the ball, from 1; other parts of
 * the same ball are parts of that face (see carreau_model_part_of_face). Of balls that are equal, concentric or one
 * inside the other, those inside have no face; spheres that only touch do not meet. Where rounding hides how spheres
 * meet (four of them in one point), radii are moved by some 1e-9 of themselves, and a message tells it.
 * Errors: ARGUMENT (a radius that is not positive, n below 1, the session has faces). */
CARREAU_API carreau_status carreau_add_molecule(carreau_session* session, const carreau_molecule_options* options,
                                                int64_t n, const double centers[], const double radii[]);

/* The same for the atoms of a file .xyzr (x, y, z, radius), .xyz, .pdb, .ent, .cif or .mmcif. Radii are those of Bondi;
 * waters and all but the first of alternate locations are left out, and messages tell it. References of faces are the
 * serial numbers of .pdb and .cif where these are positive and different, and names of faces are residues.
 * Errors: those above, FILE. */
CARREAU_API carreau_status carreau_load_molecule(carreau_session* session, const carreau_molecule_options* options,
                                                 const char* path);

/* Of the surface, exactly: no mesh is needed. */
typedef struct carreau_molecule_measures {
  size_t struct_size;
  double area;
  double volume; /* inside the surface, without cavities */
  int64_t atoms;
  int64_t exposed_atoms; /* with an area */
  int64_t shells;        /* connected parts of the surface */
  int64_t cavities;      /* those of them that bound a hole */
  int64_t euler_number;  /* of the surface: of a closed mesh, vertices - triangles / 2 */
  int64_t moved_radii;   /* see carreau_add_molecule */
} carreau_molecule_measures;

/* Measures the molecule that the session was given last. Errors: SEQUENCE (none was). */
CARREAU_API carreau_status carreau_molecule_measure(carreau_session* session, carreau_molecule_measures* out_measures);

/* Tells reference and area of each atom of that molecule; an array may be NULL. Errors: SEQUENCE, ARGUMENT (capacity).
 */
CARREAU_API carreau_status carreau_molecule_atoms(carreau_session* session, int64_t capacity, int32_t out_refs[],
                                                  double out_areas[]);

/* Tells the residue of an atom, from 0; "" when it has none. The text lives until the next call on the session. NULL:
 * no such atom. */
CARREAU_API const char* carreau_molecule_atom_name(carreau_session* session, int64_t atom);

/* ---- Points of built-in geometries ---- */

/* Evaluates a face at n places (u, v). Errors: SEQUENCE (the geometry of the session is not built in), ARGUMENT. */
CARREAU_API carreau_status carreau_geometry_points(carreau_session* session, int32_t face_ref, int64_t n,
                                                   const double uv[], double out_xyz[]);

/* Evaluates curve `ic` of a face at a share of its interval, from 0 to 1: (u, v). Errors: as above. */
CARREAU_API carreau_status carreau_geometry_curve(carreau_session* session, int32_t face_ref, int32_t ic, double share,
                                                  double out_uv[2]);

#ifdef __cplusplus
}
#endif

#endif
