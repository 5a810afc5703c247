/* SPDX-License-Identifier: BSD-3-Clause */
/* carreau_cad.h: STEP, IGES and BREP files as the geometry of a session. C99, and C++ as well. Library libcarreau_cad.
 *
 *   carreau_session_create(&session);
 *   if (carreau_cad_open(session, "part.step", NULL, NULL) != CARREAU_OK) puts(carreau_last_error(session));
 *   carreau_mesh_generate(session);
 *
 * The rules of carreau.h hold for every function. Faces, edges and vertices have the numbers that OpenCASCADE's maps of
 * the shape give them, from 1. These numbers are the references of faces, curves and points of the geometry
 * (carreau_geometry.h describes how they are moved behind others). Faces that bend inside are cut into parts there, and
 * are one face in meshes. The u and v of a face that is turned round are exchanged, so that triangles look outwards of a
 * solid. Lengths are in millimetres, whatever the unit of a STEP or IGES file, unless options name a unit or a scale; a
 * BREP file has none. OpenCASCADE keeps settings for the process; files are read one after another.
 */
#ifndef CARREAU_CAD_H
#define CARREAU_CAD_H

#include "carreau_geometry.h"

#if defined(_WIN32)
#if defined(CARREAU_BUILDING_CAD)
#define CARREAU_CAD_API __declspec(dllexport)
#else
#define CARREAU_CAD_API __declspec(dllimport)
#endif
#else
#define CARREAU_CAD_API CARREAU_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Files ---- */

/* Holds a file that was read. Sessions that it was added to do not need it. */
typedef struct carreau_cad_file carreau_cad_file;

/* Gets the share that is read, 0 to 1. Returns 0, or any other value to stop. */
typedef int32_t (*carreau_cad_progress_fn)(double fraction, void* user);

/* Options of reading a file. */
typedef struct carreau_cad_options {
  size_t struct_size;
  int32_t trap_faults; /* 1: SIGSEGV, SIGBUS, SIGFPE and SIGILL that OpenCASCADE raises in a call of this library are the
                          error of a face or of the file, as long as the file, or a geometry of it, exists; for
                          programs that own their process. 0: signals are left alone, and a fault ends the program */
  int32_t loose_edges; /* 1: edges of no face are meshed as edges. 0: only in files without a face */
  carreau_cad_progress_fn progress; /* NULL: no calls */
  void* user;                       /* handed to progress */
  int32_t imprint; /* 1: parts that touch share faces and edges (OpenCASCADE's general fuse); a face between two solids
                      is one face with one mesh. When the fuse fails the parts stay as they are, and a loss
                      (carreau_cad_loss) names the reason. 0: parts do not share faces */
  int32_t reserved;
  double imprint_tolerance; /* distance up to which parts touch, in lengths of the result; 0: the tolerances of the file */
  const char* unit; /* of the coordinates: nm, um, mm, cm, dm, m, km, mil, in, ft or yd. NULL or "": millimetres, or
                       unchanged for a BREP file, which has no unit and rejects others */
  double scale;     /* multiplies all coordinates, after the unit; 0: 1. Other than 1: the result has no unit */
  double min_feature; /* removes features of solids below this length, before an imprint, where OpenCASCADE can
                         (carreau_cad_small_feature_at); 0: removes none */
} carreau_cad_options;

/* Reads a file and adds all of its faces to a session. *out_file gets the file; out_file may be NULL.
 * `options` may be NULL, which means all zero. The parameter eps_match becomes carreau_cad_content.match_tolerance when
 * it is 0. Faces that cannot be meshed are left out with a reason
 * (carreau_model_leave_out_face). On an error the session is as before, and carreau_last_error has the sentence.
 * Errors: ARGUMENT, FILE, CANCELLED, MEMORY, SEQUENCE (as carreau_geometry_begin), MODEL (the references are too
 * large). */
CARREAU_CAD_API carreau_status carreau_cad_open(carreau_session* session, const char* path,
                                                const carreau_cad_options* options, carreau_cad_file** out_file);

/* Does the same with the `size` bytes of a file in memory, which the call does not keep. format: "step", "iges" or
 * "brep" (text or binary); NULL or "": found from the bytes. Files beside it that a STEP file refers to are losses.
 * Errors: as carreau_cad_open. */
CARREAU_CAD_API carreau_status carreau_cad_open_bytes(carreau_session* session, const void* bytes, int64_t size,
                                                      const char* format, const carreau_cad_options* options,
                                                      carreau_cad_file** out_file);

/* Creates an empty file: see carreau_cad_read. Free it by carreau_cad_close. Errors: ARGUMENT, MEMORY.
 */
CARREAU_CAD_API carreau_status carreau_cad_create(carreau_cad_file** out_file);

/* Frees a file, at any time: geometries of it stay in their sessions. NULL is allowed. */
CARREAU_CAD_API void carreau_cad_close(carreau_cad_file* file);

/* Returns the sentence of the last call on the file, "" after success. It lives until the next call on the file. */
CARREAU_CAD_API const char* carreau_cad_last_error(const carreau_cad_file* file);

/* Reads STEP (.step, .stp), IGES (.iges, .igs) or BREP (.brep), by the suffix or else by the first bytes. On an error
 * the old content stays. Errors: FILE, CANCELLED, MEMORY, ARGUMENT. */
CARREAU_CAD_API carreau_status carreau_cad_read(carreau_cad_file* file, const char* path,
                                                const carreau_cad_options* options);

/* Reads the `size` bytes of a file in memory: see carreau_cad_open_bytes. On an error the old content stays. Errors:
 * FILE, CANCELLED, MEMORY, ARGUMENT. */
CARREAU_CAD_API carreau_status carreau_cad_read_bytes(carreau_cad_file* file, const void* bytes, int64_t size,
                                                      const char* format, const carreau_cad_options* options);

/* Makes parts that touch share faces and edges: see carreau_cad_options.imprint. Numbers of faces, edges and vertices
 * change, and sizes that were set are gone; names and colours follow. A fuse that fails is a loss (carreau_cad_loss), and
 * the parts stay as they are. Sessions that the file was added to before do not change. tolerance: distance up to which
 * parts touch; 0: the tolerances of the file. progress may be NULL. Errors: CANCELLED, MEMORY, ARGUMENT. */
CARREAU_CAD_API carreau_status carreau_cad_imprint(carreau_cad_file* file, double tolerance,
                                                   carreau_cad_progress_fn progress, void* user);

/* Makes the body symmetric about the plane of a point and a normal (3 numbers each, any length but 0). If it has faces on both
 * sides, its faces that lie across the plane are cut by it. Otherwise faces in the plane go, and the mirror images of all
 * others come: in each solid, or shell of no solid, after its faces and in their order. Both halves share their edges in
 * the plane. carreau_model_add_periodicity with the reflection makes meshes symmetric. Numbers change, and sizes that were set are
 * gone; names and colours follow. Errors: ARGUMENT, MEMORY, FILE (no face off the plane; OpenCASCADE cannot cut a face: which one). */
CARREAU_CAD_API carreau_status carreau_cad_mirror(carreau_cad_file* file, const double point[], const double normal[]);

/* Names the solids, and unnamed faces, of a file whose format has no names (BREP). n: the number of
 * solids (carreau_cad_content.solids). names: n texts; NULL and "" name nothing. colours: n colours, 0xRRGGBB in sRGB,
 * -1: none; NULL: all none. Sizes that were set are gone. Errors: ARGUMENT, MEMORY. */
CARREAU_CAD_API carreau_status carreau_cad_name_solids(carreau_cad_file* file, int64_t n, const char* const names[],
                                                       const int32_t colours[]);

/* Adds all faces to a session; a file may be added to several, and several times. Errors: as carreau_cad_open, with the
 * sentence in the session; ARGUMENT (the file is empty). */
CARREAU_CAD_API carreau_status carreau_cad_add(carreau_cad_file* file, carreau_session* session);

/* Sets a size on the face of this number, or on all faces of this name, when hphy_flag = 2. An edge has the smallest
 * size of its faces. Holds in all geometries of the file. Errors: ARGUMENT (no such face, a size that is not positive). */
CARREAU_CAD_API carreau_status carreau_cad_set_face_size(carreau_cad_file* file, const char* face, double size);

/* Errors of the functions below: ARGUMENT (the file is empty, no such face, index or curve, a capacity that is too
 * small). Texts that they give live until the file is read again or closed. */

/* Sets a size on a vertex (dimension 0), an edge (1), a face (2) or all faces of a solid (3) by its number. Otherwise
 * as carreau_cad_set_face_size. The smallest size of an edge and its faces counts. Errors: ARGUMENT. */
CARREAU_CAD_API carreau_status carreau_cad_set_size(carreau_cad_file* file, int32_t dimension, int32_t number,
                                                    double size);

/* ---- Content of a file ---- */

/* The content of a file, counted. */
typedef struct carreau_cad_content {
  size_t struct_size;
  int32_t faces, edges, vertices;
  int32_t closed;   /* 1: no edge has one face alone */
  const char* unit; /* of coordinates: "mm", carreau_cad_options.unit, or "" without a unit */
  double diagonal;  /* of the box of the faces that are not left out; 0: no such face */
  double glue_tolerance; /* bound of the distance between two edges of one face each that are one (eps_glue), by the
                            tolerances of the file's own edges and its shortest edge; 0: fewer than two such edges */
  double open_tolerance; /* this bound whatever the lengths (eps_glue_open) */
  int32_t losses;        /* entities with faces that could not be read: see carreau_cad_loss */
  int32_t bent_faces;    /* faces that bend inside and could not be cut there */
  int32_t left_out;      /* faces that cannot be meshed */
  int32_t references;    /* largest reference of a face, parts of cut faces included */
  double match_tolerance; /* largest distance between faces and the edges and vertices that they share (eps_match): six
                             hundredths of the diagonal */
  const char* notes;     /* ignored or repaired entities, without the loss of a face: sentences, one a line */
  const char* file_unit; /* of the lengths in the file ("in", "mm", ...), "" when it has none */
  int32_t solids;
  int32_t shared_faces; /* between two solids */
  int32_t small_features; /* that carreau_cad_options.min_feature found */
  int32_t tree_rows;      /* see carreau_cad_tree_at */
} carreau_cad_content;

/* Counts the content of a file. */
CARREAU_CAD_API carreau_status carreau_cad_info(carreau_cad_file* file, carreau_cad_content* out_content);

/* A feature below carreau_cad_options.min_feature. */
typedef struct carreau_cad_small_feature {
  size_t struct_size;
  const char* kind; /* "hole", "boss", "fillet", "chamfer", "step", "small face" */
  double size;      /* a diameter of holes and bosses, a radius of fillets, a width of the others */
  double place[3];  /* a point of it */
  int32_t removed;  /* 0: OpenCASCADE cannot extend the faces around it, and it stays */
  int32_t reserved;
  const char* faces; /* their numbers in the file as it was: "12, 13"; lives until the next call on the file */
} carreau_cad_small_feature;

/* Gets a feature, by kind and then by its first face. index: from 0. Errors: ARGUMENT. */
CARREAU_CAD_API carreau_status carreau_cad_small_feature_at(carreau_cad_file* file, int64_t index,
                                                            carreau_cad_small_feature* out_feature);

/* Returns a sentence about an entity that could not be read. index: from 0. NULL: no such index. */
CARREAU_CAD_API const char* carreau_cad_loss(carreau_cad_file* file, int64_t index);

/* The data of a face in the file. */
typedef struct carreau_cad_face {
  size_t struct_size;
  int32_t number;   /* from 1 */
  int32_t rgb;      /* colour, 0xRRGGBB in sRGB; -1: none */
  const char* name; /* its own, or the name of the smallest part that holds it; "": none */
  const char* why;  /* reason why it cannot be meshed; "": it can */
  int32_t solid;    /* number of its solid, from 1; 0: none. Triangles look out of it */
  int32_t reserved;
  const char* solid_name; /* "": none */
  int32_t other_solid;    /* the solid on the other side, into which triangles look; 0: none */
  int32_t reserved2;
  const char* other_solid_name; /* "": none */
  const char* layer;            /* its own, or the layer of the smallest part that holds it; "": none */
} carreau_cad_face;

/* Gets the data of face `number`, from 1. */
CARREAU_CAD_API carreau_status carreau_cad_file_face(carreau_cad_file* file, int32_t number,
                                                     carreau_cad_face* out_face);

/* Returns the name of a vertex (dimension 0), an edge (1), a face (2) or a solid (3) by its number; "": it has none, or
 * there is no such entity. STEP and IGES files have names of edges and vertices. The text lives until the file is read
 * again or closed. */
CARREAU_CAD_API const char* carreau_cad_entity_name(carreau_cad_file* file, int32_t dimension, int32_t number);

/* A row of the tree of a file. */
typedef struct carreau_cad_tree_row {
  size_t struct_size;
  const char* kind; /* "assembly", "part", "solid", "face", "edge", "vertex" */
  int32_t depth;    /* 0: outermost; the rows below a row follow it and are deeper */
  int32_t number;   /* of a solid, face, edge or vertex, from 1; 0: of others */
  int32_t rgb;      /* its own colour, 0xRRGGBB in sRGB; -1: none */
  int32_t faces;    /* number of faces of an assembly, part or solid */
  const char* name;  /* its own; solids have distinct names; "": none */
  const char* layer; /* its own; "": none */
} carreau_cad_tree_row;

/* Gets a row of the tree: assemblies, parts, solids, and faces, edges and vertices with a name, a colour or a layer of
 * their own. index: from 0 to carreau_cad_content.tree_rows - 1. Errors: ARGUMENT. */
CARREAU_CAD_API carreau_status carreau_cad_tree_at(carreau_cad_file* file, int64_t index, carreau_cad_tree_row* out_row);

/* Two solids with faces that lie on each other. */
typedef struct carreau_cad_contact {
  size_t struct_size;
  int32_t solids[2]; /* from 1, ascending */
  int32_t faces[2];  /* the pair of faces with the largest common area, from 1, in the order of the solids */
  int32_t pairs;     /* of faces */
  int32_t reserved;
  double area;       /* that all pairs have in common */
  double place[3];   /* a point of the pair in faces */
} carreau_cad_contact;

/* Finds solids that touch, by faces of both that lie on each other; faces between two solids are no contact. Areas are
 * exact on planes with straight borders, and where one face covers the other; otherwise their error is about a
 * hundredth. The first call compares all faces whose boxes meet. */
CARREAU_CAD_API carreau_status carreau_cad_count_contacts(carreau_cad_file* file, int64_t* out_count);

/* Gets a contact, by solids. index: from 0. Errors: ARGUMENT. */
CARREAU_CAD_API carreau_status carreau_cad_contact_at(carreau_cad_file* file, int64_t index,
                                                      carreau_cad_contact* out_contact);

/* Measures of a face. */
typedef struct carreau_cad_figures {
  size_t struct_size;
  const char* kind; /* "plane", "cylinder", ..., "broken" */
  double area, perimeter; /* model length^2, model length; 0 where OpenCASCADE fails */
  double low[3], high[3]; /* its box */
} carreau_cad_figures;

/* Measures face `number`. The first call measures all faces. */
CARREAU_CAD_API carreau_status carreau_cad_measure_face(carreau_cad_file* file, int32_t number,
                                                        carreau_cad_figures* out_figures);

/* ---- Potential meshing problems ---- */

/* The content of a file, and the number of potential meshing problems. */
typedef struct carreau_cad_report {
  size_t struct_size;
  int32_t solids, shells, faces, edges, vertices;
  int32_t seams, poles, closed_edges, inner_wires, internal_edges;
  double diagonal, area, volume; /* volume of the solids */
  double shortest_edge, largest_tolerance, largest_gap;
  int32_t kinds;   /* of surfaces: see carreau_cad_surfaces */
  int32_t dangers; /* see carreau_cad_danger_at */
} carreau_cad_report;

/* Looks for potential meshing problems. Edges shorter than `tiny` times the diagonal (0: 1e-3), and narrower faces, are
 * dangers. So are gaps above it between the curve of an edge and its images on the faces beside, and tolerances above it.
 * Further dangers are free edges, bends inside faces, solids that touch or overlap without a common face, and entities
 * that OpenCASCADE fails on. Costs some ten evaluations an edge, and up to 10 000 points that are classified against solids. */
CARREAU_CAD_API carreau_status carreau_cad_inspect(carreau_cad_file* file, double tiny,
                                                   carreau_cad_report* out_report);

/* Gets a kind of surfaces and the number of its faces, as found by carreau_cad_inspect; by name. */
CARREAU_CAD_API carreau_status carreau_cad_surfaces(carreau_cad_file* file, int64_t index, const char** out_kind,
                                                    int32_t* out_count);

/* A potential meshing problem. */
typedef struct carreau_cad_danger {
  size_t struct_size;
  const char* kind; /* "tiny edge", "sliver face", "gap", "free edge", "kink", ... */
  int32_t face, edge; /* 0: not concerned */
  double value;       /* a length, a number of faces, an angle in degrees, or the common area of solids */
  int32_t cut;        /* 1: a kink along which the face is cut, so that edges of meshes follow it */
  int32_t reserved;
  const char* sentence;
  int32_t solids[2]; /* two that touch or overlap, kinds "touching solids" and "overlapping solids"; 0: not concerned */
} carreau_cad_danger;

/* Gets a danger that carreau_cad_inspect has found; by kind, worst first. */
CARREAU_CAD_API carreau_status carreau_cad_danger_at(carreau_cad_file* file, int64_t index,
                                                     carreau_cad_danger* out_danger);

/* Gaps between the curves of edges and their images on the faces beside, at ten places each. */
typedef struct carreau_cad_gaps {
  size_t struct_size;
  double largest;
  int32_t edge, face; /* the place; 0: no gap */
  int32_t beyond;     /* edges with more than twice their own tolerance */
  int32_t reserved;
} carreau_cad_gaps;

/* Measures the gaps of all edges. */
CARREAU_CAD_API carreau_status carreau_cad_measure_gaps(carreau_cad_file* file, carreau_cad_gaps* out_gaps);

/* ---- Places, references ---- */

/* Finds the point of a face, or of a part of a face, at (u, v) as callbacks get them. out_uv gets the parameters that
 * its surface has there in the file; it may be NULL. May be called from several threads at a time; keeps no sentence.
 * Errors: CALLBACK (OpenCASCADE fails). */
CARREAU_CAD_API carreau_status carreau_cad_point(const carreau_cad_file* file, int32_t face, double u, double v,
                                                 double out_xyz[3], double out_uv[2]);
/* Finds (u, v), as callbacks get them, at a share from 0 to 1 of curve ic of a face; as carreau_cad_point. */
CARREAU_CAD_API carreau_status carreau_cad_curve_point(const carreau_cad_file* file, int32_t face, int32_t ic,
                                                       double share, double out_uv[2]);

/* Counts the curves of a face and gives their edges, in order; with capacity 0 it counts only. */
CARREAU_CAD_API carreau_status carreau_cad_curves(carreau_cad_file* file, int32_t face, int64_t capacity,
                                                  int32_t out_edges[], int64_t* out_count);
/* Counts the parts of a face of the file and gives their references, ascending; with capacity 0 it counts only. A face
 * that is not cut is its only part. */
CARREAU_CAD_API carreau_status carreau_cad_parts(carreau_cad_file* file, int32_t face, int64_t capacity,
                                                 int32_t out_refs[], int64_t* out_count);
/* Return the face (edge) of the file that a reference is, or is a part of; other numbers come back. */
CARREAU_CAD_API int32_t carreau_cad_whole_face(const carreau_cad_file* file, int32_t ref);
CARREAU_CAD_API int32_t carreau_cad_whole_edge(const carreau_cad_file* file, int32_t ref);

#ifdef __cplusplus
}
#endif

#endif
