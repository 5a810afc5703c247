# SPDX-License-Identifier: BSD-3-Clause
"""The C interface as ctypes sees it.

Written by cabi/python/generate.py: not to be edited."""

from ctypes import (CFUNCTYPE, POINTER, Structure, c_char_p, c_double, c_int32, c_int64, c_size_t,
                    c_void_p)

from ._arrays import Doubles, Int32s, Int64s

OK = 0
ERR_ARGUMENT = 1
ERR_MODEL = 2
ERR_FILE = 3
ERR_CALLBACK = 4
ERR_DOMAIN = 5
ERR_LIMIT = 6
ERR_CANCELLED = 7
ERR_MEMORY = 8
ERR_SEQUENCE = 9
ERR_PARTIAL = 10
ERR_BUSY = 11
ERR_INTERNAL = 99
METRIC_NONE = 0
METRIC_SIZE = 1
METRIC_SPACE = 2
METRIC_TANGENT = 3
BOUNDARY = 1
INTERNAL = 2
EQUAL = 0
ARITHMETIC = 1
GEOMETRIC = 2
INTEGER = 1
REAL = 2
TEXT = 3
LEVEL_ERROR = 0
LEVEL_WARNING = 1
LEVEL_SUMMARY = 10
LEVEL_DETAIL = 50
LEVEL_DEBUG = 100
PHASE_IDLE = 0
PHASE_MODEL = 1
PHASE_CURVES = 2
PHASE_PATCHES = 3
PHASE_ASSEMBLY = 4
PHASE_WRITING = 5
PHASE_MEASURE = 6
PHASE_GRADATION = 7
HESSIAN = 0
CURVATURE = 1
DEFORMATION = 2
ISOTROPIC = 0
GRAPH = 1
ANISOTROPIC = 2
FIT = 0
PROJECTION = 1
QUADRIC = 2
CELL_TRIANGLE3 = 1
CELL_TRIANGLE6 = 2
CELL_QUAD4 = 3
CELL_QUAD8 = 4
FACE_NOT_MESHED = 0
FACE_MESHED = 1
FACE_MENDED = 2
FACE_FAILED = 3
FACE_COLLAPSED = 4
EXR_SIZE = 1
EXR_INDUCED = 2
EXR_TARGET = 4
EXR_CURVATURE = 8
EXR_POSITION = 16
EXR_NORMAL = 32
EXR_DEVIATION = 64
EXR_TRIANGLE = 128
EXR_MASK = 256
EXR_PREVIEW = 512
EXR_GOVERNS = 1024
GOVERNS_PHYSICAL = 0
GOVERNS_GEOMETRIC = 1
GOVERNS_BOUNDS = 2
GOVERNS_GRADATION = 3
EXR_ZIP = 0
EXR_PIZ = 1
INTERSECT_IN_TURN = 0
INTERSECT_LARGEST = 1
MEASURE_LENGTH = 1
MEASURE_EDGE_ANGLE = 2
MEASURE_GRADATION = 3
MEASURE_LENGTH_RATIO = 4
MEASURE_Q1 = 5
MEASURE_Q2 = 6
MEASURE_METRIC_QUALITY = 7
MEASURE_A0 = 8
MEASURE_A1 = 9
MEASURE_CURVE_A0 = 10
MEASURE_CURVE_A1 = 11
MEASURE_VERTEX_ANGLE = 12
MEASURE_A0_BOUND = 13
MEASURE_A1_BOUND = 14
MEASURE_BOUND_SHARE = 15
MEASURE_INPUT_BOUND = 16
OF_EDGES = 1
OF_VERTICES = 2
OF_TRIANGLES = 3
HVIDE = -1e+38
NO_ANSWER = -1
LOOP_EVEN = 0
LOOP_SMOOTH = 1
BORDER_SPLINE = 0
BORDER_CUBIC = 1
BORDER_POLYGON = 2
BORDER_OUTER_SPLINE = 3
BORDER_OUTER_CUBIC = 4
ZONE_OUTSIDE = 0
ZONE_ANNULUS = 1
ZONE_INSIDE = 2
GEOMETRY_CALLBACKS = 1
GEOMETRY_BEZIER = 2
GEOMETRY_MOLECULE = 3
GEOMETRY_PLANE = 4
GEOMETRY_GRID = 5
GEOMETRY_TRIANGLES = 6
GEOMETRY_ATLAS = 7
BEZIER_DEGREE = 15
VWS = 1
SAS = 2
SES = 3
REST_PARITY = 0
REST_INSIDE = 1
REST_OUTSIDE = 2
SEGMENTS = 0
SPLINE = 1
ARCS = 2
MEASURED_POINTS = 0
MEASURED_HEIGHTS = 1
MEASURED_RADII = 2
GRID_BY_SUFFIX = 0
GRID_PLOT3D = 1
GRID_HEIGHTS = 2
GRID_SCAN = 3
GRID_NODES = 4
MATCH_ANY = 0
MATCH_REFERENCE = 1
MATCH_NAME = 2
MATCH_SHAPE = 3
MARK_EDGES = 1
MARK_ELEMENTS = 2
EQUIDISTANT = 0
GAUSS_LOBATTO = 1
NODE_INSIDE = 0
NODE_FREE = 1
NODE_IMPOSED = 2
NODE_BOUND = 3
ELEMENT_MEAN = 0
ELEMENT_CONSERVED = 1
SPLINE_TANGENT = 0
SPLINE_NATURAL = 1
POLYGON = 2
ERROR_NONE = 0
ERROR_HESSIAN = 1
ERROR_CURVATURE = 2
ERROR_DEFORMATION = 3
BOUNDARY_SMOOTH = 0
BOUNDARY_PARTLY = 1
BOUNDARY_KEPT = 2
BOUNDARY_AS_GIVEN = 3
carreau_surface_fn = CFUNCTYPE(c_int32, c_int32, c_double, c_double, c_int32, c_void_p, c_void_p, c_void_p, c_void_p, c_void_p, c_void_p, c_void_p)
carreau_surface_batch_fn = CFUNCTYPE(c_int32, c_int32, c_int64, c_void_p, c_int32, c_void_p, c_void_p, c_void_p, c_void_p, c_void_p, c_void_p, c_void_p)
carreau_interval_fn = CFUNCTYPE(c_int32, c_int32, c_int32, c_void_p, c_void_p, c_void_p)
carreau_curve_fn = CFUNCTYPE(c_int32, c_int32, c_int32, c_double, c_int32, c_void_p, c_void_p, c_void_p, c_void_p)
carreau_surface_value_fn = CFUNCTYPE(c_int32, c_int32, c_double, c_double, c_void_p, c_void_p)
carreau_curve_value_fn = CFUNCTYPE(c_int32, c_int32, c_int32, c_double, c_void_p, c_void_p)
carreau_point_value_fn = CFUNCTYPE(c_int32, c_int32, c_void_p, c_void_p)
carreau_failure_fn = CFUNCTYPE(c_void_p, c_int32, c_void_p)
carreau_surface_metric_fn = CFUNCTYPE(c_int32, c_int32, c_double, c_double, c_void_p, c_void_p, c_void_p)
carreau_curve_metric_fn = CFUNCTYPE(c_int32, c_int32, c_int32, c_double, c_void_p, c_void_p, c_void_p)
carreau_point_metric_fn = CFUNCTYPE(c_int32, c_int32, c_void_p, c_void_p, c_void_p)
carreau_surface_metric_batch_fn = CFUNCTYPE(c_int32, c_int32, c_int64, c_void_p, c_void_p, c_void_p, c_void_p, c_void_p)
carreau_message_fn = CFUNCTYPE(None, c_int32, c_char_p, c_void_p)
carreau_progress_fn = CFUNCTYPE(c_int32, c_int32, c_int32, c_double, c_void_p)
carreau_team_take_fn = CFUNCTYPE(c_int32, c_int64, c_void_p, c_void_p)
carreau_team_exchange_fn = CFUNCTYPE(c_int32, c_int64, c_void_p, c_void_p, c_void_p, c_void_p)
carreau_field_fn = CFUNCTYPE(c_int32, c_int64, c_void_p, c_void_p, c_void_p)
carreau_bytes_fn = CFUNCTYPE(c_int32, c_int64, c_int64, c_void_p, c_void_p)
carreau_cad_progress_fn = CFUNCTYPE(c_int32, c_double, c_void_p)


class carreau_error_place(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("face", c_int32),
        ("ic", c_int32),
        ("curve", c_int32),
        ("point", c_int32),
        ("line", c_int32),
        ("reserved", c_int32),
        ("uv", c_double * 2),
        ("t", c_double),
    ]


class carreau_cad_m(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("cad_init", CFUNCTYPE(None)),
        ("surf0", CFUNCTYPE(None, c_void_p, c_void_p, c_void_p)),
        ("surf1", CFUNCTYPE(None, c_void_p, c_void_p, c_void_p, c_void_p)),
        ("surf2", CFUNCTYPE(None, c_void_p, c_void_p, c_void_p, c_void_p, c_void_p)),
        ("curv_int", CFUNCTYPE(None, c_void_p, c_void_p, c_void_p, c_void_p)),
        ("curv0", CFUNCTYPE(None, c_void_p, c_void_p, c_void_p, c_void_p)),
        ("curv1", CFUNCTYPE(None, c_void_p, c_void_p, c_void_p, c_void_p)),
        ("curv2", CFUNCTYPE(None, c_void_p, c_void_p, c_void_p, c_void_p)),
        ("cad_hphys", CFUNCTYPE(None, c_void_p, c_void_p, c_void_p)),
        ("cad_hphyc", CFUNCTYPE(None, c_void_p, c_void_p, c_void_p, c_void_p)),
        ("cad_hphyp", CFUNCTYPE(None, c_void_p, c_void_p)),
        ("cad_rads", CFUNCTYPE(None, c_void_p, c_void_p, c_void_p)),
        ("cad_radc", CFUNCTYPE(None, c_void_p, c_void_p, c_void_p, c_void_p)),
    ]


class carreau_cad(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("user", c_void_p),
        ("surface_order", c_int32),
        ("curve_order", c_int32),
        ("reentrant", c_int32),
        ("reserved", c_int32),
        ("surface", carreau_surface_fn),
        ("surface_batch", carreau_surface_batch_fn),
        ("curve_interval", carreau_interval_fn),
        ("curve", carreau_curve_fn),
        ("surface_size", carreau_surface_value_fn),
        ("curve_size", carreau_curve_value_fn),
        ("point_size", carreau_point_value_fn),
        ("surface_radius", carreau_surface_value_fn),
        ("curve_radius", carreau_curve_value_fn),
        ("failure", carreau_failure_fn),
        ("release", CFUNCTYPE(None, c_void_p)),
    ]


class carreau_metric_callbacks(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("user", c_void_p),
        ("surface_metric", carreau_surface_metric_fn),
        ("curve_metric", carreau_curve_metric_fn),
        ("point_metric", carreau_point_metric_fn),
        ("surface_metric_batch", carreau_surface_metric_batch_fn),
    ]


class carreau_parameter(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("help", c_char_p),
        ("default_text", c_char_p),
        ("choices", c_char_p),
        ("minimum", c_double),
        ("maximum", c_double),
        ("default_number", c_double),
        ("type", c_int32),
        ("diag_relative", c_int32),
        ("set_by", c_char_p),
    ]


class carreau_team(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("user", c_void_p),
        ("rank", c_int32),
        ("size", c_int32),
        ("any_thread", c_int32),
        ("reserved", c_int32),
        ("take", carreau_team_take_fn),
        ("exchange", carreau_team_exchange_fn),
        ("release", CFUNCTYPE(None, c_void_p)),
    ]


class carreau_report(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("diag", c_double),
        ("surf0_calls", c_int64),
        ("surf1_calls", c_int64),
        ("surf2_calls", c_int64),
        ("curv0_calls", c_int64),
        ("curv1_calls", c_int64),
        ("curv2_calls", c_int64),
        ("size_calls", c_int64),
        ("seconds_curves", c_double),
        ("seconds_sampling", c_double),
        ("seconds_plane", c_double),
        ("seconds_lift", c_double),
        ("seconds_total", c_double),
    ]


class carreau_interface(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("curve", c_int32),
        ("uses", c_int32),
        ("face", c_int32),
        ("ic", c_int32),
        ("other_face", c_int32),
        ("other_ic", c_int32),
        ("boundary", c_int32),
        ("glued", c_int32),
        ("degenerate", c_int32),
        ("loose", c_int32),
        ("gap", c_double),
    ]


class carreau_background(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("dimension", c_int32),
        ("reserved", c_int32),
        ("vertex_count", c_int64),
        ("triangle_count", c_int64),
        ("vertices", c_void_p),
        ("triangles", c_void_p),
        ("faces", c_void_p),
        ("sizes", c_void_p),
        ("metrics", c_void_p),
        ("tetrahedron_count", c_int64),
        ("edge_count", c_int64),
        ("tetrahedra", c_void_p),
        ("edges", c_void_p),
    ]


class carreau_background_report(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("asked", c_int64),
        ("outside", c_int64),
        ("farthest", c_double),
        ("estimated_error", c_double),
        ("tolerance", c_double),
    ]


class carreau_layers_report(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("cells", c_int64),
        ("rows", c_int32),
        ("fewest_rows", c_int32),
        ("first_min", c_double),
        ("first_mean", c_double),
        ("first_max", c_double),
        ("growth_min", c_double),
        ("growth_mean", c_double),
        ("growth_max", c_double),
    ]


class carreau_estimator(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("source", c_int32),
        ("shape", c_int32),
        ("relative", c_int32),
        ("recovery", c_int32),
        ("tolerance", c_double),
        ("relative_floor", c_double),
        ("hmin", c_double),
        ("hmax", c_double),
        ("ratio", c_double),
    ]


class carreau_adaptation(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("estimator", c_void_p),
        ("field", carreau_field_fn),
        ("user", c_void_p),
        ("iterations", c_int32),
        ("differences", c_int32),
        ("convergence", c_double),
    ]


class carreau_adaptation_report(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("iterations", c_int32),
        ("converged", c_int32),
        ("vertices", c_int64),
        ("triangles", c_int64),
        ("triangles_before", c_int64),
        ("error_max", c_double),
        ("error_rms", c_double),
        ("error_max_before", c_double),
        ("error_rms_before", c_double),
        ("size_min", c_double),
        ("stretch_max", c_double),
        ("outside", c_int64),
        ("best", c_int32),
        ("within", c_int32),
        ("tolerance", c_double),
        ("estimated_error", c_double),
    ]


class carreau_mesh_arrays(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("dimension", c_int32),
        ("reserved", c_int32),
        ("vertex_count", c_int64),
        ("triangle_count", c_int64),
        ("edge_count", c_int64),
        ("vertices", c_void_p),
        ("triangles", c_void_p),
        ("edges", c_void_p),
        ("vertex_refs", c_void_p),
        ("triangle_refs", c_void_p),
        ("edge_refs", c_void_p),
        ("corner_uv", c_void_p),
    ]


class carreau_part_counts(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("rank", c_int32),
        ("size", c_int32),
        ("own_vertices", c_int64),
        ("own_triangles", c_int64),
        ("all_vertices", c_int64),
        ("all_triangles", c_int64),
        ("all_edges", c_int64),
        ("crossings", c_int64),
    ]


class carreau_cell_quality(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("triangles3", c_int64),
        ("triangles6", c_int64),
        ("quads4", c_int64),
        ("quads8", c_int64),
        ("invalid", c_int64),
        ("shape_mean", c_double),
        ("shape_min", c_double),
        ("scaled_jacobian_mean", c_double),
        ("scaled_jacobian_min", c_double),
        ("least_jacobian_mean", c_double),
        ("least_jacobian_min", c_double),
        ("angle_min", c_double),
        ("angle_max", c_double),
        ("area", c_double),
        ("triangle_share", c_double),
    ]


class carreau_face(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("ref", c_int32),
        ("status", c_int32),
        ("triangles", c_int64),
        ("why", c_char_p),
        ("name", c_char_p),
        ("rgb", c_int32),
    ]


class carreau_quality(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("vertices", c_int64),
        ("triangles", c_int64),
        ("edges", c_int64),
        ("open_edges", c_int64),
        ("q1_mean", c_double),
        ("q1_min", c_double),
        ("q1_p1", c_double),
        ("q1_max", c_double),
        ("q2_mean", c_double),
        ("q2_min", c_double),
        ("q2_p1", c_double),
        ("q2_max", c_double),
        ("angle_min", c_double),
        ("angle_max", c_double),
        ("area", c_double),
        ("edge_min", c_double),
        ("edge_mean", c_double),
        ("edge_max", c_double),
        ("degree6", c_double),
    ]


class carreau_exr_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("longest", c_int32),
        ("width", c_int32),
        ("height", c_int32),
        ("channels", c_int32),
        ("face", c_int32),
        ("multi_part", c_int32),
        ("raw", c_int32),
        ("compression", c_int32),
        ("threads", c_int32),
        ("reserved", c_int32),
    ]


class carreau_curve(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("dimension", c_int32),
        ("law", c_int32),
        ("point_count", c_int64),
        ("metric_count", c_int64),
        ("points", c_void_p),
        ("abscissae", c_void_p),
        ("metrics", c_void_p),
        ("lss", c_double),
    ]


class carreau_delivered(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("vertices", c_int64),
        ("edges", c_int64),
        ("triangles", c_int64),
        ("short_edges", c_int64),
        ("long_edges", c_int64),
        ("folded_triangles", c_int64),
        ("in_range", c_double),
        ("not_met", c_int64),
        ("text", c_char_p),
        ("surf0_calls", c_int64),
        ("surf1_calls", c_int64),
        ("surf2_calls", c_int64),
        ("size_calls", c_int64),
        ("seconds", c_double),
        ("input_distance", c_double),
        ("input_bound", c_double),
        ("input_back_distance", c_double),
        ("input_back_bound", c_double),
    ]


class carreau_measure(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("name", c_char_p),
        ("title", c_char_p),
        ("entity", c_int32),
        ("classes", c_int32),
        ("values", c_int64),
        ("count", c_int64),
        ("mean", c_double),
        ("min", c_double),
        ("p1", c_double),
        ("p99", c_double),
        ("max", c_double),
        ("limit", c_double),
        ("beyond", c_int64),
        ("forced", c_int64),
    ]


class carreau_atlas_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("border", c_int32),
        ("reach", c_int32),
    ]


class carreau_atlas_counts(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("vertices", c_int64),
        ("triangles", c_int64),
        ("charts", c_int64),
        ("triples", c_int64),
        ("mended", c_int64),
    ]


class carreau_atlas_chart(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("origin", c_double * 3),
        ("u", c_double * 3),
        ("v", c_double * 3),
        ("normal", c_double * 3),
        ("period", c_double),
        ("vertices", c_int64),
    ]


class carreau_geometry(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("kind", c_int32),
        ("faces", c_int32),
        ("first_face", c_int32),
        ("last_face", c_int32),
        ("first_curve", c_int32),
        ("last_curve", c_int32),
        ("first_point", c_int32),
        ("last_point", c_int32),
    ]


class carreau_bezier(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("patch_count", c_int64),
        ("degrees", c_void_p),
        ("controls", c_void_p),
        ("side_refs", c_void_p),
    ]


class carreau_molecule_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("surface", c_int32),
        ("drop_cavities", c_int32),
        ("probe", c_double),
        ("radii", c_char_p),
    ]


class carreau_molecule_measures(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("area", c_double),
        ("volume", c_double),
        ("atoms", c_int64),
        ("exposed_atoms", c_int64),
        ("shells", c_int64),
        ("cavities", c_int64),
        ("euler_number", c_int64),
        ("moved_radii", c_int64),
        ("convex_area", c_double),
        ("torus_area", c_double),
        ("concave_area", c_double),
    ]


class carreau_plane_domain(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("rest", c_int32),
        ("reserved", c_int32),
        ("point_count", c_int64),
        ("curve_count", c_int64),
        ("side_count", c_int64),
        ("seed_count", c_int64),
        ("points", c_void_p),
        ("point_refs", c_void_p),
        ("imposed", c_void_p),
        ("sizes", c_void_p),
        ("metrics", c_void_p),
        ("curve_starts", c_void_p),
        ("curve_points", c_void_p),
        ("smooth", c_void_p),
        ("controls", c_void_p),
        ("tangents", c_void_p),
        ("curve_refs", c_void_p),
        ("sides", c_void_p),
        ("seeds", c_void_p),
        ("seed_refs", c_void_p),
    ]


class carreau_grid_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("measured", c_int32),
        ("smoothing_rounds", c_int32),
        ("smoothing_inward", c_double),
        ("smoothing_outward", c_double),
        ("lengths", c_int32),
        ("orient", c_int32),
        ("join_angle", c_double),
        ("tolerance", c_double),
        ("step", c_double),
        ("fill", c_int32),
        ("continuity", c_int32),
        ("smoothing_by_distance", c_int32),
        ("reserved", c_int32),
    ]


class carreau_triangles_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("sharp_angle", c_double),
        ("corner_angle", c_double),
        ("given_edges_only", c_int32),
        ("ignore_references", c_int32),
        ("keep_double_vertices", c_int32),
        ("reserved", c_int32),
    ]


class carreau_triangles(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("vertex_count", c_int64),
        ("triangle_count", c_int64),
        ("edge_count", c_int64),
        ("vertices", c_void_p),
        ("triangles", c_void_p),
        ("triangle_refs", c_void_p),
        ("edges", c_void_p),
    ]


class carreau_triangles_report(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("vertices", c_int64),
        ("triangles", c_int64),
        ("edges", c_int64),
        ("shells", c_int64),
        ("euler_number", c_int64),
        ("border_edges", c_int64),
        ("manifold_breaks", c_int64),
        ("one_sided_edges", c_int64),
        ("pinched_vertices", c_int64),
        ("turned_triangles", c_int64),
        ("repeated_triangles", c_int64),
        ("flat_triangles", c_int64),
        ("sharp_edges", c_int64),
        ("lines", c_int64),
        ("corners", c_int64),
        ("regions", c_int64),
        ("dropped_edges", c_int64),
        ("prolonged_edges", c_int64),
        ("faded_ends", c_int64),
        ("unfolded", c_int64),
        ("folded", c_int64),
        ("diagonal", c_double),
        ("deviation", c_double),
        ("sharp_angle", c_double),
    ]


class carreau_remesh_input(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("vertex_count", c_int64),
        ("triangle_count", c_int64),
        ("vertices", c_void_p),
        ("triangles", c_void_p),
        ("displacements", c_void_p),
        ("damage", c_void_p),
        ("tool_count", c_int64),
        ("tool_starts", c_void_p),
        ("tool_points", c_void_p),
        ("tool_radii", c_void_p),
        ("tool_closed", c_void_p),
        ("nodal_components", c_int32),
        ("element_components", c_int32),
        ("nodal_values", c_void_p),
        ("element_values", c_void_p),
        ("element_kinds", c_void_p),
        ("h_min", c_double),
        ("h_max", c_double),
        ("step", c_double),
        ("damage_limit", c_double),
        ("gradation", c_double),
        ("corner_angle", c_double),
        ("curvature_angle", c_double),
        ("curves", c_int32),
        ("imposed_smoothing", c_int32),
        ("keep_all_parts", c_int32),
        ("no_damage_sizes", c_int32),
        ("error_source", c_int32),
        ("error_component", c_int32),
        ("error_tolerance", c_double),
        ("max_triangles", c_int64),
        ("remove_overlaps", c_int32),
        ("has_reach", c_int32),
        ("reach", c_double),
        ("vertex_kinds", c_void_p),
    ]


class carreau_remesh_summary(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("vertices", c_int64),
        ("triangles", c_int64),
        ("boundary_edges", c_int64),
        ("bound_vertices", c_int64),
        ("free_vertices", c_int64),
        ("imposed_vertices", c_int64),
        ("removed_damaged", c_int64),
        ("removed_multiple", c_int64),
        ("removed_dangling", c_int64),
        ("removed_parts", c_int64),
        ("removed_overlapping", c_int64),
        ("parts_found", c_int32),
        ("parts_kept", c_int32),
        ("boundary", c_int32),
        ("reserved", c_int32),
        ("area_given", c_double),
        ("area_removed", c_double),
        ("area_bound", c_double),
        ("area_geometry", c_double),
        ("area", c_double),
    ]


class carreau_cad_options(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("trap_faults", c_int32),
        ("loose_edges", c_int32),
        ("progress", carreau_cad_progress_fn),
        ("user", c_void_p),
        ("imprint", c_int32),
        ("reserved", c_int32),
        ("imprint_tolerance", c_double),
        ("unit", c_char_p),
        ("scale", c_double),
        ("min_feature", c_double),
    ]


class carreau_cad_content(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("faces", c_int32),
        ("edges", c_int32),
        ("vertices", c_int32),
        ("closed", c_int32),
        ("unit", c_char_p),
        ("diagonal", c_double),
        ("glue_tolerance", c_double),
        ("open_tolerance", c_double),
        ("losses", c_int32),
        ("bent_faces", c_int32),
        ("left_out", c_int32),
        ("references", c_int32),
        ("match_tolerance", c_double),
        ("notes", c_char_p),
        ("file_unit", c_char_p),
        ("solids", c_int32),
        ("shared_faces", c_int32),
        ("small_features", c_int32),
        ("tree_rows", c_int32),
    ]


class carreau_cad_small_feature(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("kind", c_char_p),
        ("size", c_double),
        ("place", c_double * 3),
        ("removed", c_int32),
        ("reserved", c_int32),
        ("faces", c_char_p),
    ]


class carreau_cad_face(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("number", c_int32),
        ("rgb", c_int32),
        ("name", c_char_p),
        ("why", c_char_p),
        ("solid", c_int32),
        ("reserved", c_int32),
        ("solid_name", c_char_p),
        ("other_solid", c_int32),
        ("reserved2", c_int32),
        ("other_solid_name", c_char_p),
        ("layer", c_char_p),
    ]


class carreau_cad_tree_row(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("kind", c_char_p),
        ("depth", c_int32),
        ("number", c_int32),
        ("rgb", c_int32),
        ("faces", c_int32),
        ("name", c_char_p),
        ("layer", c_char_p),
    ]


class carreau_cad_contact(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("solids", c_int32 * 2),
        ("faces", c_int32 * 2),
        ("pairs", c_int32),
        ("reserved", c_int32),
        ("area", c_double),
        ("place", c_double * 3),
    ]


class carreau_cad_figures(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("kind", c_char_p),
        ("area", c_double),
        ("perimeter", c_double),
        ("low", c_double * 3),
        ("high", c_double * 3),
    ]


class carreau_cad_report(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("solids", c_int32),
        ("shells", c_int32),
        ("faces", c_int32),
        ("edges", c_int32),
        ("vertices", c_int32),
        ("seams", c_int32),
        ("poles", c_int32),
        ("closed_edges", c_int32),
        ("inner_wires", c_int32),
        ("internal_edges", c_int32),
        ("diagonal", c_double),
        ("area", c_double),
        ("volume", c_double),
        ("shortest_edge", c_double),
        ("largest_tolerance", c_double),
        ("largest_gap", c_double),
        ("kinds", c_int32),
        ("dangers", c_int32),
    ]


class carreau_cad_danger(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("kind", c_char_p),
        ("face", c_int32),
        ("edge", c_int32),
        ("value", c_double),
        ("cut", c_int32),
        ("reserved", c_int32),
        ("sentence", c_char_p),
        ("solids", c_int32 * 2),
    ]


class carreau_cad_gaps(Structure):
    _fields_ = [
        ("struct_size", c_size_t),
        ("largest", c_double),
        ("edge", c_int32),
        ("face", c_int32),
        ("beyond", c_int32),
        ("reserved", c_int32),
    ]


# name: (result, arguments), library by library.
CARREAU = {
    "carreau_status_name": (c_char_p, [c_int32]),
    "carreau_status_meaning": (c_char_p, [c_int32]),
    "carreau_version": (c_char_p, []),
    "carreau_version_number": (c_int32, []),
    "carreau_session_create": (c_int32, [POINTER(c_void_p)]),
    "carreau_session_free": (None, [c_void_p]),
    "carreau_last_error": (c_char_p, [c_void_p]),
    "carreau_last_error_place": (c_int32, [c_void_p, POINTER(carreau_error_place)]),
    "carreau_set_error": (c_int32, [c_void_p, c_int32, c_char_p]),
    "carreau_set_cad_m": (c_int32, [c_void_p, POINTER(carreau_cad_m)]),
    "carreau_set_cad": (c_int32, [c_void_p, POINTER(carreau_cad)]),
    "carreau_set_metric_callbacks": (c_int32, [c_void_p, POINTER(carreau_metric_callbacks)]),
    "carreau_model_clear": (c_int32, [c_void_p]),
    "carreau_model_add_face": (c_int32, [c_void_p, c_int32, c_int32]),
    "carreau_model_leave_out_face": (c_int32, [c_void_p, c_int32, c_char_p]),
    "carreau_model_add_curve": (c_int32, [c_void_p, c_int32, c_int32, c_int32, c_int32, c_int32]),
    "carreau_model_divide_curve": (c_int32, [c_void_p, c_int32, c_int32, c_int32, c_int32, c_double]),
    "carreau_model_divide_curve_at": (c_int32, [c_void_p, c_int32, c_int32, c_int64, Doubles]),
    "carreau_model_add_point": (c_int32, [c_void_p, c_int32, c_int32, c_double, c_double]),
    "carreau_model_name_face": (c_int32, [c_void_p, c_int32, c_char_p]),
    "carreau_model_name_entities": (c_int32, [c_void_p, c_int32, c_int64, Int32s, c_char_p]),
    "carreau_model_set_face_sides": (c_int32, [c_void_p, c_int32, c_int32, c_int32]),
    "carreau_model_color_face": (c_int32, [c_void_p, c_int32, c_int32]),
    "carreau_model_part_of_face": (c_int32, [c_void_p, c_int32, c_int32]),
    "carreau_model_part_of_curve": (c_int32, [c_void_p, c_int32, c_int32]),
    "carreau_model_add_periodicity": (c_int32, [c_void_p, Int32s, Int32s, c_int64, Doubles]),
    "carreau_model_add_period": (c_int32, [c_void_p, Doubles]),
    "carreau_model_read_pardom": (c_int32, [c_void_p, c_char_p]),
    "carreau_model_write_pardom": (c_int32, [c_void_p, c_char_p]),
    "carreau_model_check": (c_int32, [c_void_p]),
    "carreau_model_count": (c_int32, [c_void_p, POINTER(c_int64), POINTER(c_int64), POINTER(c_int64)]),
    "carreau_model_faces": (c_int32, [c_void_p, c_int64, Int32s, Int32s]),
    "carreau_model_curves": (c_int32, [c_void_p, c_int64, Int32s, Int32s, Int32s, Int32s]),
    "carreau_model_points": (c_int32, [c_void_p, c_int64, Int32s, Int32s, Doubles]),
    "carreau_parameter_count": (c_int32, []),
    "carreau_parameter_info": (c_int32, [c_int32, POINTER(carreau_parameter)]),
    "carreau_set_integer": (c_int32, [c_void_p, c_char_p, c_int32]),
    "carreau_set_real": (c_int32, [c_void_p, c_char_p, c_double]),
    "carreau_set_text": (c_int32, [c_void_p, c_char_p, c_char_p]),
    "carreau_set_word": (c_int32, [c_void_p, c_char_p, c_char_p]),
    "carreau_read_env": (c_int32, [c_void_p, c_char_p]),
    "carreau_get_integer": (c_int32, [c_void_p, c_char_p, POINTER(c_int32)]),
    "carreau_get_real": (c_int32, [c_void_p, c_char_p, POINTER(c_double)]),
    "carreau_get_text": (c_int32, [c_void_p, c_char_p, POINTER(c_char_p)]),
    "carreau_reset_parameter": (c_int32, [c_void_p, c_char_p]),
    "carreau_reset_parameters": (c_int32, [c_void_p]),
    "carreau_set_message_callback": (c_int32, [c_void_p, carreau_message_fn, c_void_p]),
    "carreau_set_progress_callback": (c_int32, [c_void_p, carreau_progress_fn, c_void_p]),
    "carreau_stop": (None, [c_void_p]),
    "carreau_set_team": (c_int32, [c_void_p, POINTER(carreau_team)]),
    "carreau_mesh_generate": (c_int32, [c_void_p]),
    "carreau_run_env": (c_int32, [c_void_p, c_char_p]),
    "carreau_session_report": (c_int32, [c_void_p, POINTER(carreau_report)]),
    "carreau_session_interface_count": (c_int32, [c_void_p, POINTER(c_int64)]),
    "carreau_session_interface": (c_int32, [c_void_p, c_int64, POINTER(carreau_interface)]),
    "carreau_set_background_mesh": (c_int32, [c_void_p, c_char_p, c_char_p]),
    "carreau_set_background": (c_int32, [c_void_p, POINTER(carreau_background)]),
    "carreau_set_vertex_sizes": (c_int32, [c_void_p, c_int64, Doubles]),
    "carreau_set_vertex_metrics": (c_int32, [c_void_p, c_int64, Doubles]),
    "carreau_clear_background": (c_int32, [c_void_p]),
    "carreau_mesh_read_metrics": (c_int32, [c_void_p, c_char_p, c_int64, Doubles]),
    "carreau_session_background": (c_int32, [c_void_p, POINTER(carreau_background_report)]),
    "carreau_add_attractor": (c_int32, [c_void_p, c_int64, Doubles, c_int64, Int32s, c_double, c_double, c_double]),
    "carreau_clear_attractors": (c_int32, [c_void_p]),
    "carreau_add_layers": (c_int32, [c_void_p, c_int64, Int32s, c_double, c_double, c_int32]),
    "carreau_clear_layers": (c_int32, [c_void_p]),
    "carreau_session_layers": (c_int32, [c_void_p, c_int64, POINTER(carreau_layers_report)]),
    "carreau_estimate": (c_int32, [c_void_p, POINTER(carreau_estimator), c_int64, Doubles, Doubles, Doubles]),
    "carreau_transfer": (c_int32, [c_void_p, c_int32, c_int64, Doubles, c_int64, Doubles, POINTER(c_int64)]),
    "carreau_set_background_fields": (c_int32, [c_void_p, c_char_p, c_char_p]),
    "carreau_transfer_files": (c_int32, [c_void_p, c_char_p, c_char_p, c_char_p, POINTER(c_int64)]),
    "carreau_adapt": (c_int32, [c_void_p, POINTER(carreau_adaptation), POINTER(carreau_adaptation_report)]),
    "carreau_session_mesh": (c_int32, [c_void_p, POINTER(c_void_p)]),
    "carreau_mesh_create": (c_int32, [POINTER(c_void_p)]),
    "carreau_mesh_free": (None, [c_void_p]),
    "carreau_mesh_last_error": (c_char_p, [c_void_p]),
    "carreau_mesh_read": (c_int32, [c_void_p, c_char_p]),
    "carreau_mesh_from_arrays": (c_int32, [c_void_p, POINTER(carreau_mesh_arrays)]),
    "carreau_mesh_write": (c_int32, [c_void_p, c_char_p]),
    "carreau_mesh_encode": (c_int32, [c_void_p, c_char_p, carreau_bytes_fn, c_void_p]),
    "carreau_mesh_generate_part": (c_int32, [c_void_p, c_void_p]),
    "carreau_mesh_part_count": (c_int32, [c_void_p, POINTER(carreau_part_counts)]),
    "carreau_mesh_part_vertices": (c_int32, [c_void_p, c_int64, Int64s, Int32s, Int64s]),
    "carreau_mesh_part_triangles": (c_int32, [c_void_p, c_int64, Int64s, Int32s]),
    "carreau_mesh_count": (c_int32, [c_void_p, POINTER(c_int64), POINTER(c_int64), POINTER(c_int64), POINTER(c_int64)]),
    "carreau_mesh_order": (c_int32, [c_void_p, POINTER(c_int32)]),
    "carreau_mesh_dimension": (c_int32, [c_void_p, POINTER(c_int32)]),
    "carreau_mesh_vertices": (c_int32, [c_void_p, c_int64, Doubles]),
    "carreau_mesh_vertex_refs": (c_int32, [c_void_p, c_int64, Int32s]),
    "carreau_mesh_vertex_sizes": (c_int32, [c_void_p, c_int64, Doubles]),
    "carreau_mesh_triangles": (c_int32, [c_void_p, c_int64, Int32s]),
    "carreau_mesh_triangle_refs": (c_int32, [c_void_p, c_int64, Int32s]),
    "carreau_mesh_corner_uv": (c_int32, [c_void_p, c_int64, Doubles]),
    "carreau_mesh_corner_faces": (c_int32, [c_void_p, c_int64, Int32s]),
    "carreau_mesh_edges": (c_int32, [c_void_p, c_int64, Int32s]),
    "carreau_mesh_edge_refs": (c_int32, [c_void_p, c_int64, Int32s]),
    "carreau_mesh_cell_count": (c_int32, [c_void_p, c_int32, POINTER(c_int64)]),
    "carreau_mesh_cells": (c_int32, [c_void_p, c_int32, c_int64, Int32s, Int32s]),
    "carreau_mesh_cell_uv": (c_int32, [c_void_p, c_int32, c_int64, Doubles]),
    "carreau_mesh_cell_faces": (c_int32, [c_void_p, c_int32, c_int64, Int32s]),
    "carreau_mesh_edge_mids": (c_int32, [c_void_p, c_int64, Int32s]),
    "carreau_mesh_cell_quality": (c_int32, [c_void_p, POINTER(carreau_cell_quality)]),
    "carreau_mesh_face": (c_int32, [c_void_p, c_int64, POINTER(carreau_face)]),
    "carreau_mesh_periodic_count": (c_int32, [c_void_p, POINTER(c_int64), POINTER(c_int64)]),
    "carreau_mesh_periodic": (c_int32, [c_void_p, c_int64, c_int64, Int32s, Int32s, Doubles, Int64s, Int32s]),
    "carreau_mesh_face_sides": (c_int32, [c_void_p, c_int32, Int32s]),
    "carreau_mesh_entity_name": (c_char_p, [c_void_p, c_int32, c_int32]),
    "carreau_mesh_quality": (c_int32, [c_void_p, POINTER(carreau_quality)]),
    "carreau_mesh_part_quality": (c_int32, [c_void_p, POINTER(carreau_quality)]),
    "carreau_mesh_defects": (c_int32, [c_void_p, c_int32, c_int64, POINTER(c_int64), POINTER(c_char_p)]),
    "carreau_mesh_intersections": (c_int32, [c_void_p, c_int32, c_int64, POINTER(c_int64), Int32s, Doubles]),
    "carreau_mesh_regions": (c_int32, [c_void_p, c_int64, POINTER(c_int64), Int32s, Doubles]),
    "carreau_mesh_triangle_sides": (c_int32, [c_void_p, c_int64, Int32s]),
    "carreau_write_exr": (c_int32, [c_void_p, c_char_p, POINTER(carreau_exr_options)]),
    "carreau_curve_split": (c_int32, [c_void_p, POINTER(carreau_curve), c_int64, Doubles, POINTER(c_int64), POINTER(c_double)]),
    "carreau_metric_sizes": (c_int32, [c_void_p, c_int32, c_int64, Doubles, Doubles, Doubles]),
    "carreau_metric_of_sizes": (c_int32, [c_void_p, c_int32, c_int64, Doubles, Doubles, Doubles]),
    "carreau_metric_interpolate": (c_int32, [c_void_p, c_int32, c_int32, c_int64, Doubles, Doubles, Doubles, Doubles]),
    "carreau_metric_intersect": (c_int32, [c_void_p, c_int32, c_int32, c_int64, c_int64, Doubles, Doubles]),
    "carreau_metric_reduce": (c_int32, [c_void_p, c_int32, c_int64, Doubles, Doubles, Doubles, Doubles, Doubles]),
    "carreau_metric_lengths": (c_int32, [c_void_p, c_int32, c_int32, c_int64, Doubles, Doubles, Doubles]),
    "carreau_session_delivered": (c_int32, [c_void_p, POINTER(carreau_delivered)]),
    "carreau_delivered_measure": (c_int32, [c_void_p, c_int32, POINTER(carreau_measure)]),
    "carreau_delivered_histogram": (c_int32, [c_void_p, c_int32, c_int64, Doubles, Int64s]),
    "carreau_delivered_values": (c_int32, [c_void_p, c_int32, c_int64, Doubles]),
    "carreau_delivered_edges": (c_int32, [c_void_p, c_int64, Int32s, Int32s]),
    "carreau_delivered_triangle_edges": (c_int32, [c_void_p, c_int64, Int32s]),
    "carreau_delivered_write": (c_int32, [c_void_p, c_char_p]),
    "carreau_loop_create": (c_int32, [POINTER(c_void_p)]),
    "carreau_loop_free": (None, [c_void_p]),
    "carreau_loop_last_error": (c_char_p, [c_void_p]),
    "carreau_loop_build": (c_int32, [c_void_p, c_int64, Doubles, c_int32]),
    "carreau_loop_points": (c_int32, [c_void_p, c_int64, Doubles, Doubles, Doubles]),
    "carreau_loop_invert": (c_int32, [c_void_p, c_int64, Doubles, c_double, Doubles]),
    "carreau_loop_pivots": (c_int32, [c_void_p, c_int64, Doubles, POINTER(c_int64)]),
    "carreau_annulus_create": (c_int32, [POINTER(c_void_p)]),
    "carreau_annulus_free": (None, [c_void_p]),
    "carreau_annulus_last_error": (c_char_p, [c_void_p]),
    "carreau_annulus_build": (c_int32, [c_void_p, c_int64, Doubles, c_int64, Doubles, c_int32, c_int32]),
    "carreau_annulus_points": (c_int32, [c_void_p, c_int64, Doubles, Doubles, Doubles]),
    "carreau_annulus_invert": (c_int32, [c_void_p, c_int64, Doubles, Doubles, Int32s]),
    "carreau_annulus_pivots": (c_int32, [c_void_p, c_int64, Doubles, POINTER(c_int64)]),
    "carreau_annulus_outer_border": (c_int32, [c_void_p, c_int64, Doubles, POINTER(c_int64)]),
    "carreau_annulus_skeleton": (c_int32, [c_void_p, c_int64, Doubles, POINTER(c_int64)]),
    "carreau_annulus_write_exr": (c_int32, [c_void_p, c_char_p, c_int32]),
    "carreau_atlas_create": (c_int32, [POINTER(c_void_p)]),
    "carreau_atlas_free": (None, [c_void_p]),
    "carreau_atlas_last_error": (c_char_p, [c_void_p]),
    "carreau_atlas_build": (c_int32, [c_void_p, POINTER(carreau_atlas_options), c_int64, Doubles, c_int64, Int32s, Int32s]),
    "carreau_atlas_count": (c_int32, [c_void_p, POINTER(carreau_atlas_counts)]),
    "carreau_atlas_chart_info": (c_int32, [c_void_p, c_int64, POINTER(carreau_atlas_chart)]),
    "carreau_atlas_annulus_points": (c_int32, [c_void_p, c_int64, c_int64, Doubles, Doubles]),
    "carreau_atlas_zones": (c_int32, [c_void_p, c_int64, c_int64, Doubles, Int32s, Doubles]),
    "carreau_atlas_transition": (c_int32, [c_void_p, c_int64, c_int64, c_int64, Doubles, Doubles, Int32s]),
    "carreau_atlas_points": (c_int32, [c_void_p, c_int64, c_int64, Doubles, Doubles, Doubles]),
    "carreau_add_atlas": (c_int32, [c_void_p, c_void_p]),
    "carreau_geometry_count": (c_int32, [c_void_p, POINTER(c_int64)]),
    "carreau_geometry_info": (c_int32, [c_void_p, c_int64, POINTER(carreau_geometry)]),
    "carreau_geometry_begin": (c_int32, [c_void_p, POINTER(carreau_cad)]),
    "carreau_geometry_end": (c_int32, [c_void_p]),
    "carreau_geometry_cancel": (c_int32, [c_void_p]),
    "carreau_add_bezier": (c_int32, [c_void_p, POINTER(carreau_bezier)]),
    "carreau_load_bezier": (c_int32, [c_void_p, c_char_p]),
    "carreau_bezier_degrees": (c_int32, [c_void_p, c_int32, Int32s]),
    "carreau_add_molecule": (c_int32, [c_void_p, POINTER(carreau_molecule_options), c_int64, Doubles, Doubles]),
    "carreau_load_molecule": (c_int32, [c_void_p, POINTER(carreau_molecule_options), c_char_p]),
    "carreau_molecule_measure": (c_int32, [c_void_p, POINTER(carreau_molecule_measures)]),
    "carreau_molecule_atoms": (c_int32, [c_void_p, c_int64, Int32s, Doubles]),
    "carreau_molecule_atom_areas": (c_int32, [c_void_p, c_int64, Doubles, Doubles, Doubles]),
    "carreau_molecule_atom_name": (c_char_p, [c_void_p, c_int64]),
    "carreau_add_plane_domain": (c_int32, [c_void_p, POINTER(carreau_plane_domain)]),
    "carreau_load_plane_domain": (c_int32, [c_void_p, c_char_p, c_char_p, c_double]),
    "carreau_plane_has_sizes": (c_int32, [c_void_p, POINTER(c_int32)]),
    "carreau_add_grid": (c_int32, [c_void_p, POINTER(carreau_grid_options), c_int64, Int32s, Doubles]),
    "carreau_load_grid": (c_int32, [c_void_p, POINTER(carreau_grid_options), c_char_p, c_int32]),
    "carreau_add_triangles": (c_int32, [c_void_p, POINTER(carreau_triangles_options), POINTER(carreau_triangles)]),
    "carreau_load_triangles": (c_int32, [c_void_p, POINTER(carreau_triangles_options), c_char_p]),
    "carreau_triangles_measure": (c_int32, [c_void_p, POINTER(carreau_triangles_report)]),
    "carreau_triangles_refine": (c_int32, [c_void_p, c_double, c_int32, c_void_p]),
    "carreau_triangles_distances": (c_int32, [c_void_p, Doubles]),
    "carreau_triangles_bounds": (c_int32, [c_void_p, c_double, Doubles]),
    "carreau_evaluate": (c_int32, [c_void_p, c_int32, c_int32, c_int64, Doubles, c_int32, Doubles, Doubles, Doubles]),
    "carreau_project": (c_int32, [c_void_p, c_int32, c_int32, c_int64, Doubles, Int32s, Doubles, Doubles, Doubles]),
    "carreau_model_embed_point": (c_int32, [c_void_p, Doubles, c_char_p, POINTER(c_int32)]),
    "carreau_model_embed_polyline": (c_int32, [c_void_p, c_int64, Doubles, c_char_p, POINTER(c_int32)]),
    "carreau_model_embed_wires": (c_int32, [c_void_p, POINTER(c_int64)]),
    "carreau_model_embed_ridges": (c_int32, [c_void_p, c_double, POINTER(c_int64)]),
    "carreau_mesh_vertex_entities": (c_int32, [c_void_p, c_int64, Int32s, Int32s]),
    "carreau_mesh_edge_parameters": (c_int32, [c_void_p, c_int64, Doubles, Int32s, Int32s]),
    "carreau_mesh_carry": (c_int32, [c_void_p, c_void_p, c_int32]),
    "carreau_mesh_halve": (c_int32, [c_void_p, c_int32]),
    "carreau_mesh_refine": (c_int32, [c_void_p, c_int32, c_int64, Int32s]),
    "carreau_mesh_refine_sizes": (c_int32, [c_void_p, c_int64, Doubles]),
    "carreau_raise_order": (c_int32, [c_void_p, c_int32, c_int32, POINTER(c_int64)]),
    "carreau_raised_count": (c_int32, [c_void_p, POINTER(c_int64), POINTER(c_int64), POINTER(c_int64), POINTER(c_int64)]),
    "carreau_raised_nodes": (c_int32, [c_void_p, c_int64, Doubles]),
    "carreau_raised_elements": (c_int32, [c_void_p, c_int32, c_int64, Int32s, Int32s]),
    "carreau_raised_write": (c_int32, [c_void_p, c_char_p]),
    "carreau_geometry_points": (c_int32, [c_void_p, c_int32, c_int64, Doubles, Doubles]),
    "carreau_geometry_curve": (c_int32, [c_void_p, c_int32, c_int32, c_double, Doubles]),
    "carreau_remesh": (c_int32, [c_void_p, POINTER(carreau_remesh_input), POINTER(carreau_remesh_summary)]),
    "carreau_remesh_nodal_values": (c_int32, [c_void_p, c_int64, Doubles]),
    "carreau_remesh_element_values": (c_int32, [c_void_p, c_int64, Doubles]),
    "carreau_remesh_damage": (c_int32, [c_void_p, c_int64, Doubles]),
    "carreau_mesh_add_field": (c_int32, [c_void_p, c_char_p, c_int32, c_int32, Doubles]),
}
CARREAU_CAD = {
    "carreau_cad_open": (c_int32, [c_void_p, c_char_p, POINTER(carreau_cad_options), POINTER(c_void_p)]),
    "carreau_cad_open_bytes": (c_int32, [c_void_p, c_void_p, c_int64, c_char_p, POINTER(carreau_cad_options), POINTER(c_void_p)]),
    "carreau_cad_create": (c_int32, [POINTER(c_void_p)]),
    "carreau_cad_close": (None, [c_void_p]),
    "carreau_cad_last_error": (c_char_p, [c_void_p]),
    "carreau_cad_read": (c_int32, [c_void_p, c_char_p, POINTER(carreau_cad_options)]),
    "carreau_cad_read_bytes": (c_int32, [c_void_p, c_void_p, c_int64, c_char_p, POINTER(carreau_cad_options)]),
    "carreau_cad_imprint": (c_int32, [c_void_p, c_double, carreau_cad_progress_fn, c_void_p]),
    "carreau_cad_mirror": (c_int32, [c_void_p, Doubles, Doubles]),
    "carreau_cad_name_solids": (c_int32, [c_void_p, c_int64, POINTER(c_char_p), Int32s]),
    "carreau_cad_add": (c_int32, [c_void_p, c_void_p]),
    "carreau_cad_set_face_size": (c_int32, [c_void_p, c_char_p, c_double]),
    "carreau_cad_set_size": (c_int32, [c_void_p, c_int32, c_int32, c_double]),
    "carreau_cad_info": (c_int32, [c_void_p, POINTER(carreau_cad_content)]),
    "carreau_cad_small_feature_at": (c_int32, [c_void_p, c_int64, POINTER(carreau_cad_small_feature)]),
    "carreau_cad_loss": (c_char_p, [c_void_p, c_int64]),
    "carreau_cad_file_face": (c_int32, [c_void_p, c_int32, POINTER(carreau_cad_face)]),
    "carreau_cad_entity_name": (c_char_p, [c_void_p, c_int32, c_int32]),
    "carreau_cad_tree_at": (c_int32, [c_void_p, c_int64, POINTER(carreau_cad_tree_row)]),
    "carreau_cad_count_contacts": (c_int32, [c_void_p, POINTER(c_int64)]),
    "carreau_cad_contact_at": (c_int32, [c_void_p, c_int64, POINTER(carreau_cad_contact)]),
    "carreau_cad_measure_face": (c_int32, [c_void_p, c_int32, POINTER(carreau_cad_figures)]),
    "carreau_cad_inspect": (c_int32, [c_void_p, c_double, POINTER(carreau_cad_report)]),
    "carreau_cad_surfaces": (c_int32, [c_void_p, c_int64, POINTER(c_char_p), POINTER(c_int32)]),
    "carreau_cad_danger_at": (c_int32, [c_void_p, c_int64, POINTER(carreau_cad_danger)]),
    "carreau_cad_measure_gaps": (c_int32, [c_void_p, POINTER(carreau_cad_gaps)]),
    "carreau_cad_point": (c_int32, [c_void_p, c_int32, c_double, c_double, Doubles, Doubles]),
    "carreau_cad_curve_point": (c_int32, [c_void_p, c_int32, c_int32, c_double, Doubles]),
    "carreau_cad_curves": (c_int32, [c_void_p, c_int32, c_int64, Int32s, POINTER(c_int64)]),
    "carreau_cad_parts": (c_int32, [c_void_p, c_int32, c_int64, Int32s, POINTER(c_int64)]),
    "carreau_cad_whole_face": (c_int32, [c_void_p, c_int32]),
    "carreau_cad_whole_edge": (c_int32, [c_void_p, c_int32]),
}
