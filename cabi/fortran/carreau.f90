! SPDX-License-Identifier: BSD-3-Clause
! wrappers.py writes this file from carreau.f90.in: do not edit it.
!> Fortran 2003 interface of cabi/include/carreau.h: the same names, the same order of arguments, the status last. That
!> header documents the meaning, units and errors of each routine. Different here:
!>   - vertices, triangles, edges, faces and parameters count from 1;
!>   - arrays of results are allocated by the call, column by column: xyz(3, n), triangles(3, m), uv(2, 3, m); after an
!>     error they are not allocated;
!>   - texts are allocated by the call, and trailing blanks of texts that are given do not count;
!>   - callbacks are separate arguments, so that the compiler checks them; optional callbacks may be left out.
!> Callbacks are bind(c) procedures of a module, with the interfaces below. They must return: no `stop`.
module carreau
  use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_double, c_f_pointer, c_funloc, c_funptr, c_int32_t, &
    c_int64_t, c_loc, c_null_char, c_null_funptr, c_null_ptr, c_ptr, c_size_t
  use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
  use carreau_c
  implicit none
  private

  public :: carreau_session, carreau_mesh, carreau_error_place, carreau_parameter, carreau_report, carreau_face
  public :: carreau_interface, carreau_session_interface_count, carreau_session_interface
  public :: carreau_quality, carreau_delivered, carreau_measure
  public :: carreau_init_fn, carreau_surf0_fn, carreau_surf1_fn, carreau_surf2_fn, carreau_curv_int_fn, carreau_curv_fn
  public :: carreau_hphys_fn, carreau_hphyc_fn, carreau_hphyp_fn
  public :: carreau_surface_fn, carreau_surface_batch_fn, carreau_interval_fn, carreau_curve_fn
  public :: carreau_surface_value_fn, carreau_curve_value_fn, carreau_point_value_fn, carreau_failure_fn
  public :: carreau_release_fn
  public :: carreau_surface_metric_fn, carreau_surface_metric_batch_fn, carreau_curve_metric_fn, carreau_point_metric_fn
  public :: carreau_message_fn, carreau_progress_fn
  public :: carreau_team_take_fn, carreau_team_exchange_fn, carreau_bytes_fn
  public :: carreau_status_name, carreau_status_meaning, carreau_version, carreau_version_number
  public :: carreau_session_create, carreau_session_free, carreau_last_error, carreau_last_error_place
  public :: carreau_set_error
  public :: carreau_set_cad_m, carreau_set_cad, carreau_set_metric_callbacks
  public :: carreau_model_clear, carreau_model_add_face, carreau_model_add_curve, carreau_model_add_point
  public :: carreau_model_divide_curve, carreau_model_divide_curve_at
  public :: carreau_model_name_face, carreau_model_color_face, carreau_model_leave_out_face
  public :: carreau_model_add_periodicity, carreau_model_add_period, carreau_mesh_periodic_count, carreau_mesh_periodic
  public :: carreau_model_name_entities, carreau_model_set_face_sides, carreau_mesh_face_sides, carreau_mesh_entity_name
  public :: carreau_model_part_of_face, carreau_model_part_of_curve
  public :: carreau_model_read_pardom, carreau_model_write_pardom, carreau_model_check, carreau_model_count
  public :: carreau_model_faces, carreau_model_curves, carreau_model_points
  public :: carreau_parameter_count, carreau_parameter_info
  public :: carreau_set_integer, carreau_set_real, carreau_set_text, carreau_set_word, carreau_read_env
  public :: carreau_get_integer, carreau_get_real, carreau_get_text, carreau_reset_parameter, carreau_reset_parameters
  public :: carreau_set_message_callback, carreau_set_progress_callback, carreau_stop
  public :: carreau_set_team, carreau_mesh_encode
  public :: carreau_mesh_generate_part, carreau_mesh_part_count, carreau_mesh_part_quality, carreau_mesh_part_vertices
  public :: carreau_mesh_part_triangles, carreau_part_counts
  public :: carreau_mesh_generate, carreau_run_env, carreau_session_report
  public :: carreau_session_mesh, carreau_mesh_create, carreau_mesh_free, carreau_mesh_last_error
  public :: carreau_mesh_from_arrays
  public :: carreau_mesh_read, carreau_mesh_write, carreau_mesh_count, carreau_mesh_dimension, carreau_mesh_order
  public :: carreau_mesh_vertices, carreau_mesh_vertex_refs, carreau_mesh_vertex_sizes
  public :: carreau_mesh_triangles, carreau_mesh_triangle_refs, carreau_mesh_corner_uv, carreau_mesh_corner_faces
  public :: carreau_mesh_edges, carreau_mesh_edge_refs, carreau_mesh_face, carreau_mesh_quality, carreau_mesh_defects
  public :: carreau_mesh_intersections, carreau_mesh_regions, carreau_mesh_triangle_sides
  public :: carreau_mesh_cell_count, carreau_mesh_cells, carreau_mesh_cell_uv, carreau_mesh_cell_faces
  public :: carreau_mesh_edge_mids
  public :: carreau_mesh_cell_quality, carreau_cell_quality
  public :: carreau_exr_options, carreau_write_exr
  public :: carreau_session_delivered, carreau_delivered_measure, carreau_delivered_histogram
  public :: carreau_delivered_values, carreau_delivered_edges, carreau_delivered_triangle_edges, carreau_delivered_write
  public :: carreau_curve_split
  public :: carreau_metric_sizes, carreau_metric_of_sizes, carreau_metric_interpolate, carreau_metric_intersect
  public :: carreau_metric_reduce, carreau_metric_lengths
  public :: carreau_background_report, carreau_estimator, carreau_adaptation_report, carreau_field_fn
  public :: carreau_set_background_mesh, carreau_set_background, carreau_set_vertex_sizes, carreau_set_vertex_metrics
  public :: carreau_clear_background, carreau_session_background, carreau_add_attractor, carreau_clear_attractors
  public :: carreau_layers_report, carreau_add_layers, carreau_clear_layers, carreau_session_layers
  public :: carreau_estimate, carreau_transfer, carreau_adapt
  public :: carreau_mesh_read_metrics, carreau_set_background_fields, carreau_transfer_files
  public :: carreau_string

  integer(c_int32_t), parameter, public :: CARREAU_OK = 0, CARREAU_ERR_ARGUMENT = 1, CARREAU_ERR_MODEL = 2, &
    CARREAU_ERR_FILE = 3, CARREAU_ERR_CALLBACK = 4, CARREAU_ERR_DOMAIN = 5, CARREAU_ERR_LIMIT = 6, &
    CARREAU_ERR_CANCELLED = 7, CARREAU_ERR_MEMORY = 8, CARREAU_ERR_SEQUENCE = 9, CARREAU_ERR_PARTIAL = 10, &
    CARREAU_ERR_BUSY = 11, CARREAU_ERR_INTERNAL = 99
  integer(c_int32_t), parameter, public :: CARREAU_NO_ANSWER = -1
  real(c_double), parameter, public :: CARREAU_HVIDE = -1.e38_c_double
  integer(c_int32_t), parameter, public :: CARREAU_METRIC_NONE = 0, CARREAU_METRIC_SIZE = 1, &
    CARREAU_METRIC_SPACE = 2, CARREAU_METRIC_TANGENT = 3
  integer(c_int32_t), parameter, public :: CARREAU_BOUNDARY = 1, CARREAU_INTERNAL = 2
  integer(c_int32_t), parameter, public :: CARREAU_EQUAL = 0, CARREAU_ARITHMETIC = 1, CARREAU_GEOMETRIC = 2
  integer(c_int32_t), parameter, public :: CARREAU_INTEGER = 1, CARREAU_REAL = 2, CARREAU_TEXT = 3
  integer(c_int32_t), parameter, public :: CARREAU_LEVEL_ERROR = 0, CARREAU_LEVEL_WARNING = 1, &
    CARREAU_LEVEL_SUMMARY = 10, CARREAU_LEVEL_DETAIL = 50, CARREAU_LEVEL_DEBUG = 100
  integer(c_int32_t), parameter, public :: CARREAU_PHASE_IDLE = 0, CARREAU_PHASE_MODEL = 1, CARREAU_PHASE_CURVES = 2, &
    CARREAU_PHASE_PATCHES = 3, CARREAU_PHASE_ASSEMBLY = 4, CARREAU_PHASE_WRITING = 5, &
    CARREAU_PHASE_MEASURE = 6, CARREAU_PHASE_GRADATION = 7
  integer(c_int32_t), parameter, public :: CARREAU_MEASURE_LENGTH = 1, CARREAU_MEASURE_EDGE_ANGLE = 2, &
    CARREAU_MEASURE_GRADATION = 3, CARREAU_MEASURE_LENGTH_RATIO = 4, CARREAU_MEASURE_Q1 = 5, CARREAU_MEASURE_Q2 = 6, &
    CARREAU_MEASURE_METRIC_QUALITY = 7, CARREAU_MEASURE_A0 = 8, CARREAU_MEASURE_A1 = 9, &
    CARREAU_MEASURE_CURVE_A0 = 10, CARREAU_MEASURE_CURVE_A1 = 11, CARREAU_MEASURE_VERTEX_ANGLE = 12, &
    CARREAU_MEASURE_A0_BOUND = 13, CARREAU_MEASURE_A1_BOUND = 14, CARREAU_MEASURE_BOUND_SHARE = 15, &
    CARREAU_MEASURE_INPUT_BOUND = 16
  integer(c_int32_t), parameter, public :: CARREAU_INTERSECT_IN_TURN = 0, CARREAU_INTERSECT_LARGEST = 1
  integer(c_int32_t), parameter, public :: CARREAU_OF_EDGES = 1, CARREAU_OF_VERTICES = 2, CARREAU_OF_TRIANGLES = 3
  integer(c_int32_t), parameter, public :: CARREAU_CELL_TRIANGLE3 = 1, CARREAU_CELL_TRIANGLE6 = 2, &
    CARREAU_CELL_QUAD4 = 3, CARREAU_CELL_QUAD8 = 4
  integer(c_int32_t), parameter, public :: CARREAU_FACE_NOT_MESHED = 0, CARREAU_FACE_MESHED = 1, &
    CARREAU_FACE_MENDED = 2, CARREAU_FACE_FAILED = 3, CARREAU_FACE_COLLAPSED = 4
  integer(c_int32_t), parameter, public :: CARREAU_EXR_SIZE = 1, CARREAU_EXR_INDUCED = 2, CARREAU_EXR_TARGET = 4, &
    CARREAU_EXR_CURVATURE = 8, CARREAU_EXR_POSITION = 16, CARREAU_EXR_NORMAL = 32, CARREAU_EXR_DEVIATION = 64, &
    CARREAU_EXR_TRIANGLE = 128, CARREAU_EXR_MASK = 256, CARREAU_EXR_PREVIEW = 512, CARREAU_EXR_GOVERNS = 1024
  integer(c_int32_t), parameter, public :: CARREAU_GOVERNS_PHYSICAL = 0, CARREAU_GOVERNS_GEOMETRIC = 1, &
    CARREAU_GOVERNS_BOUNDS = 2, CARREAU_GOVERNS_GRADATION = 3
  integer(c_int32_t), parameter, public :: CARREAU_EXR_ZIP = 0, CARREAU_EXR_PIZ = 1

  integer(c_int32_t), parameter, public :: CARREAU_HESSIAN = 0, CARREAU_CURVATURE = 1, CARREAU_DEFORMATION = 2
  integer(c_int32_t), parameter, public :: CARREAU_ISOTROPIC = 0, CARREAU_GRAPH = 1, CARREAU_ANISOTROPIC = 2
  integer(c_int32_t), parameter, public :: CARREAU_FIT = 0, CARREAU_PROJECTION = 1, CARREAU_QUADRIC = 2

  !> Geometry, model, parameters and the mesh made of them.
  !! The handle is for the modules of this library.
  type :: carreau_session
    type(c_ptr) :: handle = c_null_ptr
  end type carreau_session

  !> A mesh: of a session, or read from a file.
  type :: carreau_mesh
    type(c_ptr) :: handle = c_null_ptr
  end type carreau_mesh

  type :: carreau_error_place
    integer(c_int32_t) :: face = 0, ic = 0, curve = 0, point = 0, line = 0
    real(c_double) :: uv(2) = 0, t = 0
  end type carreau_error_place

  ! The order of members is older than the order in C.
  type :: carreau_parameter
    character(len=:), allocatable :: name, help, default_text, choices, set_by
    integer(c_int32_t) :: type = 0
    real(c_double) :: minimum = 0, maximum = 0, default_number = 0
    logical :: diag_relative = .false.
  end type carreau_parameter

  type :: carreau_report
    real(c_double) :: diag = 0
    integer(c_int64_t) :: surf0_calls = 0, surf1_calls = 0, surf2_calls = 0, curv0_calls = 0, curv1_calls = 0, &
      curv2_calls = 0, size_calls = 0
    real(c_double) :: seconds_curves = 0, seconds_sampling = 0, seconds_plane = 0, seconds_lift = 0, seconds_total = 0
  end type carreau_report

  ! The order of members is older than the order in C.
  type :: carreau_interface
    integer(c_int32_t) :: curve = 0, uses = 0, face = 0, ic = 0, other_face = 0, other_ic = 0
    logical :: boundary = .false., glued = .false., degenerate = .false.
    real(c_double) :: gap = 0
    logical :: loose = .false.
  end type carreau_interface

  type :: carreau_background_report
    integer(c_int64_t) :: asked = 0, outside = 0
    real(c_double) :: farthest = 0, estimated_error = 0, tolerance = 0
  end type carreau_background_report

  type :: carreau_layers_report
    integer(c_int64_t) :: cells = 0
    integer(c_int32_t) :: rows = 0, fewest_rows = 0
    real(c_double) :: first_min = 0, first_mean = 0, first_max = 0, growth_min = 0, growth_mean = 0, growth_max = 0
  end type carreau_layers_report

  !> Zeros stand for the defaults in carreau.h.
  ! The order of members is older than the order in C.
  type :: carreau_estimator
    integer(c_int32_t) :: source = CARREAU_HESSIAN, shape = CARREAU_ISOTROPIC
    logical :: relative = .false.
    real(c_double) :: tolerance = 0, relative_floor = 0, hmin = 0, hmax = 0, ratio = 0
    integer(c_int32_t) :: recovery = CARREAU_FIT
  end type carreau_estimator

  type :: carreau_adaptation_report
    integer(c_int32_t) :: iterations = 0
    logical :: converged = .false.
    integer(c_int64_t) :: vertices = 0, triangles = 0, triangles_before = 0
    real(c_double) :: error_max = 0, error_rms = 0, error_max_before = 0, error_rms_before = 0, size_min = 0, &
      stretch_max = 0
    integer(c_int64_t) :: outside = 0
    integer(c_int32_t) :: best = 0
    logical :: within = .false.
    real(c_double) :: tolerance = 0, estimated_error = 0
  end type carreau_adaptation_report

  type :: carreau_exr_options
    integer(c_int32_t) :: longest = 0, width = 0, height = 0, channels = 0, face = 0
    logical :: multi_part = .false., raw = .false.
    integer(c_int32_t) :: compression = CARREAU_EXR_ZIP, threads = 0
  end type carreau_exr_options

  !> text: all lines, with line feeds (achar(10)) between.
  type :: carreau_delivered
    integer(c_int64_t) :: vertices = 0, edges = 0, triangles = 0, short_edges = 0, long_edges = 0, &
      folded_triangles = 0
    real(c_double) :: in_range = 0
    integer(c_int64_t) :: not_met = 0
    character(len=:), allocatable :: text
    integer(c_int64_t) :: surf0_calls = 0, surf1_calls = 0, surf2_calls = 0, size_calls = 0
    real(c_double) :: seconds = 0, input_distance = 0, input_bound = 0, input_back_distance = 0, input_back_bound = 0
  end type carreau_delivered

  type :: carreau_measure
    character(len=:), allocatable :: name, title
    integer(c_int32_t) :: entity = 0, classes = 0
    integer(c_int64_t) :: values = 0, count = 0
    real(c_double) :: mean = 0, min = 0, p1 = 0, p99 = 0, max = 0, limit = 0
    integer(c_int64_t) :: beyond = 0, forced = 0
  end type carreau_measure

  type :: carreau_face
    integer(c_int32_t) :: ref = 0, status = 0
    integer(c_int64_t) :: triangles = 0
    character(len=:), allocatable :: why, name
    integer(c_int32_t) :: rgb = -1
  end type carreau_face

  type :: carreau_quality
    integer(c_int64_t) :: vertices = 0, triangles = 0, edges = 0, open_edges = 0
    real(c_double) :: q1_mean = 0, q1_min = 0, q1_p1 = 0, q1_max = 0, q2_mean = 0, q2_min = 0, q2_p1 = 0, q2_max = 0, &
      angle_min = 0, angle_max = 0, area = 0, edge_min = 0, edge_mean = 0, edge_max = 0, degree6 = 0
  end type carreau_quality

  !> Counts of a mesh in parts.
  type :: carreau_part_counts
    integer(c_int32_t) :: rank = 0, size = 0
    integer(c_int64_t) :: own_vertices = 0, own_triangles = 0, all_vertices = 0, all_triangles = 0, all_edges = 0, &
      crossings = 0
  end type carreau_part_counts

  type :: carreau_cell_quality
    integer(c_int64_t) :: triangles3 = 0, triangles6 = 0, quads4 = 0, quads8 = 0, invalid = 0
    real(c_double) :: shape_mean = 0, shape_min = 0, scaled_jacobian_mean = 0, scaled_jacobian_min = 0, &
      least_jacobian_mean = 0, least_jacobian_min = 0, angle_min = 0, angle_max = 0, area = 0, triangle_share = 0
  end type carreau_cell_quality

  ! The routines of cad_m, by reference (RT-0232 sec. 3.1).
  abstract interface
    !> cad_init: called once.
    subroutine carreau_init_fn() bind(c)
      implicit none
    end subroutine carreau_init_fn

    !> surf0: the point S(u, v).
    subroutine carreau_surf0_fn(refs, uv, S) bind(c)
      import :: c_double, c_int32_t
      implicit none
      integer(c_int32_t), intent(in) :: refs
      real(c_double), intent(in) :: uv(2)
      real(c_double), intent(out) :: S(3)
    end subroutine carreau_surf0_fn

    !> surf1: its first derivatives.
    subroutine carreau_surf1_fn(refs, uv, Su, Sv) bind(c)
      import :: c_double, c_int32_t
      implicit none
      integer(c_int32_t), intent(in) :: refs
      real(c_double), intent(in) :: uv(2)
      real(c_double), intent(out) :: Su(3), Sv(3)
    end subroutine carreau_surf1_fn

    !> surf2: its second derivatives.
    subroutine carreau_surf2_fn(refs, uv, Suu, Suv, Svv) bind(c)
      import :: c_double, c_int32_t
      implicit none
      integer(c_int32_t), intent(in) :: refs
      real(c_double), intent(in) :: uv(2)
      real(c_double), intent(out) :: Suu(3), Suv(3), Svv(3)
    end subroutine carreau_surf2_fn

    !> curv_int: the interval [a, b] of curve ic, a < b.
    subroutine carreau_curv_int_fn(refs, ic, a, b) bind(c)
      import :: c_double, c_int32_t
      implicit none
      integer(c_int32_t), intent(in) :: refs, ic
      real(c_double), intent(out) :: a, b
    end subroutine carreau_curv_int_fn

    !> curv0, curv1 and curv2: C(t) or a derivative of it.
    subroutine carreau_curv_fn(refs, ic, t, C) bind(c)
      import :: c_double, c_int32_t
      implicit none
      integer(c_int32_t), intent(in) :: refs, ic
      real(c_double), intent(in) :: t
      real(c_double), intent(out) :: C(2)
    end subroutine carreau_curv_fn

    !> cad_hphys and cad_rads: h keeps its value when there is no answer.
    subroutine carreau_hphys_fn(refs, uv, h) bind(c)
      import :: c_double, c_int32_t
      implicit none
      integer(c_int32_t), intent(in) :: refs
      real(c_double), intent(in) :: uv(2)
      real(c_double), intent(inout) :: h
    end subroutine carreau_hphys_fn

    !> cad_hphyc and cad_radc.
    subroutine carreau_hphyc_fn(refs, ic, t, h) bind(c)
      import :: c_double, c_int32_t
      implicit none
      integer(c_int32_t), intent(in) :: refs, ic
      real(c_double), intent(in) :: t
      real(c_double), intent(inout) :: h
    end subroutine carreau_hphyc_fn

    !> cad_hphyp: of a point.
    subroutine carreau_hphyp_fn(refp, h) bind(c)
      import :: c_double, c_int32_t
      implicit none
      integer(c_int32_t), intent(in) :: refp
      real(c_double), intent(inout) :: h
    end subroutine carreau_hphyp_fn
  end interface

  ! The callbacks of carreau_set_cad: values by value, a status returned.
  abstract interface
    function carreau_surface_fn(face, u, v, order, S, Su, Sv, Suu, Suv, Svv, user) result(status) bind(c)
      import :: c_double, c_int32_t, c_ptr
      implicit none
      integer(c_int32_t), value :: face, order
      real(c_double), value :: u, v
      real(c_double), intent(inout) :: S(3), Su(3), Sv(3), Suu(3), Suv(3), Svv(3)
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function carreau_surface_fn

    !> Arrays above `order` must not be touched: they are not there.
    function carreau_surface_batch_fn(face, n, uv, order, S, Su, Sv, Suu, Suv, Svv, user) result(status) bind(c)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      integer(c_int32_t), value :: face, order
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: uv(2, n)
      real(c_double), intent(inout) :: S(3, n), Su(3, n), Sv(3, n), Suu(3, n), Suv(3, n), Svv(3, n)
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function carreau_surface_batch_fn

    function carreau_interval_fn(face, ic, a, b, user) result(status) bind(c)
      import :: c_double, c_int32_t, c_ptr
      implicit none
      integer(c_int32_t), value :: face, ic
      real(c_double), intent(inout) :: a, b
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function carreau_interval_fn

    function carreau_curve_fn(face, ic, t, order, C, Ct, Ctt, user) result(status) bind(c)
      import :: c_double, c_int32_t, c_ptr
      implicit none
      integer(c_int32_t), value :: face, ic, order
      real(c_double), value :: t
      real(c_double), intent(inout) :: C(2), Ct(2), Ctt(2)
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function carreau_curve_fn

    function carreau_surface_value_fn(face, u, v, value, user) result(status) bind(c)
      import :: c_double, c_int32_t, c_ptr
      implicit none
      integer(c_int32_t), value :: face
      real(c_double), value :: u, v
      real(c_double), intent(inout) :: value
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function carreau_surface_value_fn

    function carreau_curve_value_fn(face, ic, t, value, user) result(status) bind(c)
      import :: c_double, c_int32_t, c_ptr
      implicit none
      integer(c_int32_t), value :: face, ic
      real(c_double), value :: t
      real(c_double), intent(inout) :: value
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function carreau_curve_value_fn

    function carreau_point_value_fn(point, value, user) result(status) bind(c)
      import :: c_double, c_int32_t, c_ptr
      implicit none
      integer(c_int32_t), value :: point
      real(c_double), intent(inout) :: value
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function carreau_point_value_fn

    !> text: c_loc of characters that end with a c_null_char and outlive the call, or c_null_ptr.
    function carreau_failure_fn(face, user) result(text) bind(c)
      import :: c_int32_t, c_ptr
      implicit none
      integer(c_int32_t), value :: face
      type(c_ptr), value :: user
      type(c_ptr) :: text
    end function carreau_failure_fn

    function carreau_surface_metric_fn(face, u, v, kind, value, user) result(status) bind(c)
      import :: c_double, c_int32_t, c_ptr
      implicit none
      integer(c_int32_t), value :: face
      real(c_double), value :: u, v
      integer(c_int32_t), intent(inout) :: kind
      real(c_double), intent(inout) :: value(6)
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function carreau_surface_metric_fn

    !> Metrics at n points; xyz are the points in space.
    function carreau_surface_metric_batch_fn(face, n, uv, xyz, kind, value, user) result(status) bind(c)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      integer(c_int32_t), value :: face
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: uv(2, n), xyz(3, n)
      integer(c_int32_t), intent(inout) :: kind(n)
      real(c_double), intent(inout) :: value(6, n)
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function carreau_surface_metric_batch_fn

    function carreau_curve_metric_fn(face, ic, t, kind, value, user) result(status) bind(c)
      import :: c_double, c_int32_t, c_ptr
      implicit none
      integer(c_int32_t), value :: face, ic
      real(c_double), value :: t
      integer(c_int32_t), intent(inout) :: kind
      real(c_double), intent(inout) :: value(6)
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function carreau_curve_metric_fn

    function carreau_point_metric_fn(point, kind, value, user) result(status) bind(c)
      import :: c_double, c_int32_t, c_ptr
      implicit none
      integer(c_int32_t), value :: point
      integer(c_int32_t), intent(inout) :: kind
      real(c_double), intent(inout) :: value(6)
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function carreau_point_metric_fn

    !> The field at n points of space.
    function carreau_field_fn(n, xyz, values, user) result(status) bind(c)
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: xyz(3, n)
      real(c_double), intent(out) :: values(n)
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function carreau_field_fn

    !> Nothing calls the callbacks any more.
    subroutine carreau_release_fn(user) bind(c)
      import :: c_ptr
      implicit none
      type(c_ptr), value :: user
    end subroutine carreau_release_fn

    !> Adds count to the number that all ranks share.
    function carreau_team_take_fn(count, before, user) result(status) bind(c)
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      integer(c_int64_t), value :: count
      integer(c_int64_t), intent(out) :: before
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function carreau_team_take_fn

    !> bytes: the address of n bytes; sizes: as many as there are ranks; all_bytes: the address of the bytes of all
    !> ranks.
    function carreau_team_exchange_fn(n, bytes, sizes, all_bytes, user) result(status) bind(c)
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      integer(c_int64_t), value :: n
      type(c_ptr), value :: bytes
      integer(c_int64_t), intent(out) :: sizes(*)
      type(c_ptr), intent(out) :: all_bytes
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function carreau_team_exchange_fn

    !> bytes: the address of n bytes of a file from `position` on, which counts from 0.
    function carreau_bytes_fn(position, n, bytes, user) result(status) bind(c)
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      integer(c_int64_t), value :: position, n
      type(c_ptr), value :: bytes, user
      integer(c_int32_t) :: status
    end function carreau_bytes_fn

    !> carreau_string(text) is the sentence.
    subroutine carreau_message_fn(level, text, user) bind(c)
      import :: c_int32_t, c_ptr
      implicit none
      integer(c_int32_t), value :: level
      type(c_ptr), value :: text, user
    end subroutine carreau_message_fn

    !> A status other than 0 stops the run.
    function carreau_progress_fn(phase, entity, fraction, user) result(status) bind(c)
      import :: c_double, c_int32_t, c_ptr
      implicit none
      integer(c_int32_t), value :: phase, entity
      real(c_double), value :: fraction
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function carreau_progress_fn
  end interface

contains

  ! ---- Texts ----

  !> Copy of a text of C; "" for a null pointer.
  function carreau_string(text) result(copy)
    type(c_ptr), intent(in) :: text
    character(len=:), allocatable :: copy
    character(kind=c_char), pointer :: letters(:)
    integer :: i, n
    n = 0
    if (c_associated(text)) n = int(c_strlen(text))
    allocate (character(len=n) :: copy)
    if (n == 0) return
    call c_f_pointer(text, letters, [n])
    do i = 1, n
      copy(i:i) = letters(i)
    end do
  end function carreau_string

  pure function c_text(text) result(terminated)
    character(len=*), intent(in) :: text
    character(len=len_trim(text) + 1) :: terminated
    terminated = trim(text)//c_null_char
  end function c_text

  ! ---- Versions and status ----

  function carreau_status_name(status) result(name)
    integer(c_int32_t), intent(in) :: status
    character(len=:), allocatable :: name
    name = carreau_string(c_status_name(status))
  end function carreau_status_name

  function carreau_status_meaning(status) result(meaning)
    integer(c_int32_t), intent(in) :: status
    character(len=:), allocatable :: meaning
    meaning = carreau_string(c_status_meaning(status))
  end function carreau_status_meaning

  function carreau_version() result(version)
    character(len=:), allocatable :: version
    version = carreau_string(c_version())
  end function carreau_version

  function carreau_version_number() result(number)
    integer(c_int32_t) :: number
    number = c_version_number()
  end function carreau_version_number

  ! ---- Sessions ----

  subroutine carreau_session_create(session, status)
    type(carreau_session), intent(out) :: session
    integer(c_int32_t), intent(out) :: status
    status = c_session_create(session%handle)
  end subroutine carreau_session_create

  subroutine carreau_session_free(session)
    type(carreau_session), intent(inout) :: session
    call c_session_free(session%handle)
    session%handle = c_null_ptr
  end subroutine carreau_session_free

  function carreau_last_error(session) result(error)
    type(carreau_session), intent(in) :: session
    character(len=:), allocatable :: error
    error = carreau_string(c_last_error(session%handle))
  end function carreau_last_error

  subroutine carreau_last_error_place(session, place, status)
    type(carreau_session), intent(in) :: session
    type(carreau_error_place), intent(out) :: place
    integer(c_int32_t), intent(out) :: status
    type(c_error_place) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    status = c_last_error_place(session%handle, c)
    if (status /= CARREAU_OK) return
    place%face = c%face
    place%ic = c%ic
    place%curve = c%curve
    place%point = c%point
    place%line = c%line
    place%uv = c%uv
    place%t = c%t
  end subroutine carreau_last_error_place

  ! ---- Geometry ----

  subroutine carreau_set_cad_m(session, surf0, curv_int, curv0, status, cad_init, surf1, surf2, curv1, curv2, &
      cad_hphys, cad_hphyc, cad_hphyp, cad_rads, cad_radc)
    type(carreau_session), intent(in) :: session
    procedure(carreau_surf0_fn) :: surf0
    procedure(carreau_curv_int_fn) :: curv_int
    procedure(carreau_curv_fn) :: curv0
    integer(c_int32_t), intent(out) :: status
    procedure(carreau_init_fn), optional :: cad_init
    procedure(carreau_surf1_fn), optional :: surf1
    procedure(carreau_surf2_fn), optional :: surf2
    procedure(carreau_curv_fn), optional :: curv1, curv2
    procedure(carreau_hphys_fn), optional :: cad_hphys, cad_rads
    procedure(carreau_hphyc_fn), optional :: cad_hphyc, cad_radc
    procedure(carreau_hphyp_fn), optional :: cad_hphyp
    type(c_cad_m) :: routines
    routines%struct_size = size(transfer(routines, [c_null_char]))
    routines%surf0 = c_funloc(surf0)
    routines%curv_int = c_funloc(curv_int)
    routines%curv0 = c_funloc(curv0)
    if (present(cad_init)) routines%cad_init = c_funloc(cad_init)
    if (present(surf1)) routines%surf1 = c_funloc(surf1)
    if (present(surf2)) routines%surf2 = c_funloc(surf2)
    if (present(curv1)) routines%curv1 = c_funloc(curv1)
    if (present(curv2)) routines%curv2 = c_funloc(curv2)
    if (present(cad_hphys)) routines%cad_hphys = c_funloc(cad_hphys)
    if (present(cad_hphyc)) routines%cad_hphyc = c_funloc(cad_hphyc)
    if (present(cad_hphyp)) routines%cad_hphyp = c_funloc(cad_hphyp)
    if (present(cad_rads)) routines%cad_rads = c_funloc(cad_rads)
    if (present(cad_radc)) routines%cad_radc = c_funloc(cad_radc)
    status = c_set_cad_m(session%handle, routines)
  end subroutine carreau_set_cad_m

  !> surface_order and curve_order: the derivatives that `surface` and `curve` give, 2 when they are left out (carreau.h: 0);
  !> finite differences replace the others. user: c_loc of a target, c_null_ptr when left out.
  subroutine carreau_set_cad(session, surface, curve_interval, curve, status, user, surface_order, curve_order, &
      reentrant, surface_batch, surface_size, curve_size, point_size, surface_radius, curve_radius, &
      failure, release)
    type(carreau_session), intent(in) :: session
    procedure(carreau_surface_fn) :: surface
    procedure(carreau_interval_fn) :: curve_interval
    procedure(carreau_curve_fn) :: curve
    integer(c_int32_t), intent(out) :: status
    type(c_ptr), intent(in), optional :: user
    integer(c_int32_t), intent(in), optional :: surface_order, curve_order
    logical, intent(in), optional :: reentrant
    procedure(carreau_surface_batch_fn), optional :: surface_batch
    procedure(carreau_surface_value_fn), optional :: surface_size, surface_radius
    procedure(carreau_curve_value_fn), optional :: curve_size, curve_radius
    procedure(carreau_point_value_fn), optional :: point_size
    procedure(carreau_failure_fn), optional :: failure
    procedure(carreau_release_fn), optional :: release
    type(c_cad) :: callbacks
    callbacks%struct_size = size(transfer(callbacks, [c_null_char]))
    callbacks%surface_order = 2
    callbacks%curve_order = 2
    callbacks%surface = c_funloc(surface)
    callbacks%curve_interval = c_funloc(curve_interval)
    callbacks%curve = c_funloc(curve)
    if (present(user)) callbacks%user = user
    if (present(surface_order)) callbacks%surface_order = surface_order
    if (present(curve_order)) callbacks%curve_order = curve_order
    if (present(reentrant)) callbacks%reentrant = merge(1_c_int32_t, 0_c_int32_t, reentrant)
    if (present(surface_batch)) callbacks%surface_batch = c_funloc(surface_batch)
    if (present(surface_size)) callbacks%surface_size = c_funloc(surface_size)
    if (present(curve_size)) callbacks%curve_size = c_funloc(curve_size)
    if (present(point_size)) callbacks%point_size = c_funloc(point_size)
    if (present(surface_radius)) callbacks%surface_radius = c_funloc(surface_radius)
    if (present(curve_radius)) callbacks%curve_radius = c_funloc(curve_radius)
    if (present(failure)) callbacks%failure = c_funloc(failure)
    if (present(release)) callbacks%release = c_funloc(release)
    status = c_set_cad(session%handle, callbacks)
  end subroutine carreau_set_cad

  !> rank: from 0. any_thread: .false. when it is left out.
  subroutine carreau_set_team(session, rank, size, take, exchange, status, user, any_thread, release)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: rank, size
    procedure(carreau_team_take_fn) :: take
    procedure(carreau_team_exchange_fn) :: exchange
    integer(c_int32_t), intent(out) :: status
    type(c_ptr), intent(in), optional :: user
    logical, intent(in), optional :: any_thread
    procedure(carreau_release_fn), optional :: release
    type(c_team) :: team
    team%struct_size = bytes_of_team()
    team%rank = rank
    team%size = size
    team%take = c_funloc(take)
    team%exchange = c_funloc(exchange)
    if (present(user)) team%user = user
    if (present(any_thread)) team%any_thread = merge(1_c_int32_t, 0_c_int32_t, any_thread)
    if (present(release)) team%release = c_funloc(release)
    status = c_set_team(session%handle, team)
  end subroutine carreau_set_team

  !> A procedure with an argument `size` cannot call the intrinsic function of this name.
  pure function bytes_of_team() result(bytes)
    integer(c_size_t) :: bytes
    type(c_team) :: team
    bytes = size(transfer(team, [c_null_char]))
  end function bytes_of_team

  !> status: `error`, or CARREAU_ERR_ARGUMENT
  subroutine carreau_set_error(session, error, sentence, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: error
    character(len=*), intent(in) :: sentence
    integer(c_int32_t), intent(out) :: status
    status = c_set_error(session%handle, error, c_text(sentence))
  end subroutine carreau_set_error

  !> Callbacks that are left out do not answer. They work beside either kind of geometry.
  subroutine carreau_set_metric_callbacks(session, status, user, surface_metric, curve_metric, point_metric, &
      surface_metric_batch)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(out) :: status
    type(c_ptr), intent(in), optional :: user
    procedure(carreau_surface_metric_fn), optional :: surface_metric
    procedure(carreau_curve_metric_fn), optional :: curve_metric
    procedure(carreau_point_metric_fn), optional :: point_metric
    procedure(carreau_surface_metric_batch_fn), optional :: surface_metric_batch
    type(c_metric_callbacks) :: callbacks
    callbacks%struct_size = size(transfer(callbacks, [c_null_char]))
    if (present(user)) callbacks%user = user
    if (present(surface_metric)) callbacks%surface_metric = c_funloc(surface_metric)
    if (present(curve_metric)) callbacks%curve_metric = c_funloc(curve_metric)
    if (present(point_metric)) callbacks%point_metric = c_funloc(point_metric)
    if (present(surface_metric_batch)) callbacks%surface_metric_batch = c_funloc(surface_metric_batch)
    status = c_set_metric_callbacks(session%handle, callbacks)
  end subroutine carreau_set_metric_callbacks

  ! ---- Model ----

  subroutine carreau_model_clear(session, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(out) :: status
    status = c_model_clear(session%handle)
  end subroutine carreau_model_clear

  subroutine carreau_model_add_face(session, ref, orientation, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: ref, orientation
    integer(c_int32_t), intent(out) :: status
    status = c_model_add_face(session%handle, ref, orientation)
  end subroutine carreau_model_add_face

  subroutine carreau_model_add_curve(session, face_ref, type, ref, end1, end2, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: face_ref, type, ref, end1, end2
    integer(c_int32_t), intent(out) :: status
    status = c_model_add_curve(session%handle, face_ref, type, ref, end1, end2)
  end subroutine carreau_model_add_curve

  !> edges of curve ic, in a progression of their lengths along t; 0: by sizes again.
  subroutine carreau_model_divide_curve(session, face_ref, ic, edges, progression, ratio, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: face_ref, ic, edges, progression
    real(c_double), intent(in) :: ratio
    integer(c_int32_t), intent(out) :: status
    status = c_model_divide_curve(session%handle, face_ref, ic, edges, progression, ratio)
  end subroutine carreau_model_divide_curve

  !> t: the parameters of all vertices inside curve ic, increasing.
  subroutine carreau_model_divide_curve_at(session, face_ref, ic, t, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: face_ref, ic
    real(c_double), intent(in) :: t(:)
    integer(c_int32_t), intent(out) :: status
    status = c_model_divide_curve_at(session%handle, face_ref, ic, size(t, kind=c_int64_t), t)
  end subroutine carreau_model_divide_curve_at

  subroutine carreau_model_add_point(session, face_ref, ref, u, v, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: face_ref, ref
    real(c_double), intent(in) :: u, v
    integer(c_int32_t), intent(out) :: status
    status = c_model_add_point(session%handle, face_ref, ref, u, v)
  end subroutine carreau_model_add_point

  subroutine carreau_model_name_face(session, face_ref, name, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: face_ref
    character(len=*), intent(in) :: name
    integer(c_int32_t), intent(out) :: status
    status = c_model_name_face(session%handle, face_ref, c_text(name))
  end subroutine carreau_model_name_face

  subroutine carreau_model_name_entities(session, dimension, refs, name, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: dimension, refs(:)
    character(len=*), intent(in) :: name
    integer(c_int32_t), intent(out) :: status
    status = c_model_name_entities(session%handle, dimension, size(refs, kind=c_int64_t), refs, c_text(name))
  end subroutine carreau_model_name_entities

  subroutine carreau_model_set_face_sides(session, face_ref, solid, other_solid, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: face_ref, solid, other_solid
    integer(c_int32_t), intent(out) :: status
    status = c_model_set_face_sides(session%handle, face_ref, solid, other_solid)
  end subroutine carreau_model_set_face_sides

  subroutine carreau_model_color_face(session, face_ref, rgb, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: face_ref, rgb
    integer(c_int32_t), intent(out) :: status
    status = c_model_color_face(session%handle, face_ref, rgb)
  end subroutine carreau_model_color_face

  !> whole_ref: the first part, which it follows.
  subroutine carreau_model_part_of_face(session, face_ref, whole_ref, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: face_ref, whole_ref
    integer(c_int32_t), intent(out) :: status
    status = c_model_part_of_face(session%handle, face_ref, whole_ref)
  end subroutine carreau_model_part_of_face

  subroutine carreau_model_part_of_curve(session, ref, whole_ref, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: ref, whole_ref
    integer(c_int32_t), intent(out) :: status
    status = c_model_part_of_curve(session%handle, ref, whole_ref)
  end subroutine carreau_model_part_of_curve

  !> "": it is meshed.
  subroutine carreau_model_leave_out_face(session, face_ref, why, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: face_ref
    character(len=*), intent(in) :: why
    integer(c_int32_t), intent(out) :: status
    status = c_model_leave_out_face(session%handle, face_ref, c_text(why))
  end subroutine carreau_model_leave_out_face

  !> slave_faces(i) is the image of master_faces(i); transform(4, 3): the rows of R | d, left out: found. Without faces all
  !> pairs that the map has.
  subroutine carreau_model_add_periodicity(session, slave_faces, master_faces, status, transform)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: slave_faces(:), master_faces(:)
    integer(c_int32_t), intent(out) :: status
    real(c_double), intent(in), optional :: transform(4, 3)
    real(c_double) :: map(4, 3)
    map = 0
    if (present(transform)) map = transform
    status = c_model_add_periodicity(session%handle, slave_faces, master_faces, &
                                     int(min(size(slave_faces), size(master_faces)), c_int64_t), map)
  end subroutine carreau_model_add_periodicity

  subroutine carreau_model_add_period(session, direction, status)
    type(carreau_session), intent(in) :: session
    real(c_double), intent(in) :: direction(:)
    integer(c_int32_t), intent(out) :: status
    status = c_model_add_period(session%handle, direction)
  end subroutine carreau_model_add_period

  subroutine carreau_model_read_pardom(session, path, status)
    type(carreau_session), intent(in) :: session
    character(len=*), intent(in) :: path
    integer(c_int32_t), intent(out) :: status
    status = c_model_read_pardom(session%handle, c_text(path))
  end subroutine carreau_model_read_pardom

  subroutine carreau_model_write_pardom(session, path, status)
    type(carreau_session), intent(in) :: session
    character(len=*), intent(in) :: path
    integer(c_int32_t), intent(out) :: status
    status = c_model_write_pardom(session%handle, c_text(path))
  end subroutine carreau_model_write_pardom

  subroutine carreau_model_check(session, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(out) :: status
    status = c_model_check(session%handle)
  end subroutine carreau_model_check

  subroutine carreau_model_count(session, faces, curves, points, status)
    type(carreau_session), intent(in) :: session
    integer(c_int64_t), intent(out) :: faces, curves, points
    integer(c_int32_t), intent(out) :: status
    faces = 0
    curves = 0
    points = 0
    status = c_model_count(session%handle, faces, curves, points)
  end subroutine carreau_model_count

  subroutine carreau_model_faces(session, refs, orientations, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), allocatable, intent(out) :: refs(:), orientations(:)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: faces, curves, points
    call carreau_model_count(session, faces, curves, points, status)
    if (status /= CARREAU_OK) return
    allocate (refs(faces), orientations(faces))
    status = c_model_faces(session%handle, faces, refs, orientations)
  end subroutine carreau_model_faces

  !> ends(2, n)
  subroutine carreau_model_curves(session, face_refs, types, refs, ends, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), allocatable, intent(out) :: face_refs(:), types(:), refs(:), ends(:, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: faces, curves, points
    call carreau_model_count(session, faces, curves, points, status)
    if (status /= CARREAU_OK) return
    allocate (face_refs(curves), types(curves), refs(curves), ends(2, curves))
    status = c_model_curves(session%handle, curves, face_refs, types, refs, ends)
  end subroutine carreau_model_curves

  !> uv(2, n)
  subroutine carreau_model_points(session, face_refs, refs, uv, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), allocatable, intent(out) :: face_refs(:), refs(:)
    real(c_double), allocatable, intent(out) :: uv(:, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: faces, curves, points
    call carreau_model_count(session, faces, curves, points, status)
    if (status /= CARREAU_OK) return
    allocate (face_refs(points), refs(points), uv(2, points))
    status = c_model_points(session%handle, points, face_refs, refs, uv)
  end subroutine carreau_model_points

  ! ---- Parameters ----

  function carreau_parameter_count() result(count)
    integer(c_int32_t) :: count
    count = c_parameter_count()
  end function carreau_parameter_count

  !> index: from 1.
  subroutine carreau_parameter_info(index, parameter, status)
    integer(c_int32_t), intent(in) :: index
    type(carreau_parameter), intent(out) :: parameter
    integer(c_int32_t), intent(out) :: status
    type(c_parameter) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    status = c_parameter_info(index - 1_c_int32_t, c)
    if (status /= CARREAU_OK) return
    parameter%name = carreau_string(c%name)
    parameter%help = carreau_string(c%help)
    parameter%default_text = carreau_string(c%default_text)
    parameter%choices = carreau_string(c%choices)
    parameter%minimum = c%minimum
    parameter%maximum = c%maximum
    parameter%default_number = c%default_number
    parameter%type = c%type
    parameter%diag_relative = c%diag_relative /= 0
    parameter%set_by = carreau_string(c%set_by)
  end subroutine carreau_parameter_info

  subroutine carreau_set_integer(session, name, value, status)
    type(carreau_session), intent(in) :: session
    character(len=*), intent(in) :: name
    integer(c_int32_t), intent(in) :: value
    integer(c_int32_t), intent(out) :: status
    status = c_set_integer(session%handle, c_text(name), value)
  end subroutine carreau_set_integer

  subroutine carreau_set_real(session, name, value, status)
    type(carreau_session), intent(in) :: session
    character(len=*), intent(in) :: name
    real(c_double), intent(in) :: value
    integer(c_int32_t), intent(out) :: status
    status = c_set_real(session%handle, c_text(name), value)
  end subroutine carreau_set_real

  subroutine carreau_set_text(session, name, value, status)
    type(carreau_session), intent(in) :: session
    character(len=*), intent(in) :: name, value
    integer(c_int32_t), intent(out) :: status
    status = c_set_text(session%handle, c_text(name), c_text(value))
  end subroutine carreau_set_text

  subroutine carreau_set_word(session, name, word, status)
    type(carreau_session), intent(in) :: session
    character(len=*), intent(in) :: name, word
    integer(c_int32_t), intent(out) :: status
    status = c_set_word(session%handle, c_text(name), c_text(word))
  end subroutine carreau_set_word

  subroutine carreau_get_integer(session, name, value, status)
    type(carreau_session), intent(in) :: session
    character(len=*), intent(in) :: name
    integer(c_int32_t), intent(out) :: value, status
    value = 0
    status = c_get_integer(session%handle, c_text(name), value)
  end subroutine carreau_get_integer

  subroutine carreau_get_real(session, name, value, status)
    type(carreau_session), intent(in) :: session
    character(len=*), intent(in) :: name
    real(c_double), intent(out) :: value
    integer(c_int32_t), intent(out) :: status
    value = 0
    status = c_get_real(session%handle, c_text(name), value)
  end subroutine carreau_get_real

  subroutine carreau_get_text(session, name, value, status)
    type(carreau_session), intent(in) :: session
    character(len=*), intent(in) :: name
    character(len=:), allocatable, intent(out) :: value
    integer(c_int32_t), intent(out) :: status
    type(c_ptr) :: text
    text = c_null_ptr
    status = c_get_text(session%handle, c_text(name), text)
    value = carreau_string(text)
  end subroutine carreau_get_text

  subroutine carreau_reset_parameter(session, name, status)
    type(carreau_session), intent(in) :: session
    character(len=*), intent(in) :: name
    integer(c_int32_t), intent(out) :: status
    status = c_reset_parameter(session%handle, c_text(name))
  end subroutine carreau_reset_parameter

  subroutine carreau_reset_parameters(session, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(out) :: status
    status = c_reset_parameters(session%handle)
  end subroutine carreau_reset_parameters

  ! ---- Messages, progress, stop ----

  !> Without a callback: none from now on.
  subroutine carreau_set_message_callback(session, status, callback, user)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(out) :: status
    procedure(carreau_message_fn), optional :: callback
    type(c_ptr), intent(in), optional :: user
    type(c_funptr) :: c_callback
    type(c_ptr) :: c_user
    c_callback = c_null_funptr
    c_user = c_null_ptr
    if (present(callback)) c_callback = c_funloc(callback)
    if (present(user)) c_user = user
    status = c_set_message_callback(session%handle, c_callback, c_user)
  end subroutine carreau_set_message_callback

  !> Without a callback: none from now on.
  subroutine carreau_set_progress_callback(session, status, callback, user)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(out) :: status
    procedure(carreau_progress_fn), optional :: callback
    type(c_ptr), intent(in), optional :: user
    type(c_funptr) :: c_callback
    type(c_ptr) :: c_user
    c_callback = c_null_funptr
    c_user = c_null_ptr
    if (present(callback)) c_callback = c_funloc(callback)
    if (present(user)) c_user = user
    status = c_set_progress_callback(session%handle, c_callback, c_user)
  end subroutine carreau_set_progress_callback

  subroutine carreau_stop(session)
    type(carreau_session), intent(in) :: session
    call c_stop(session%handle)
  end subroutine carreau_stop

  ! ---- Run ----

  subroutine carreau_mesh_generate(session, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(out) :: status
    status = c_mesh_generate(session%handle)
  end subroutine carreau_mesh_generate

  subroutine carreau_read_env(session, path, status)
    type(carreau_session), intent(in) :: session
    character(len=*), intent(in) :: path
    integer(c_int32_t), intent(out) :: status
    status = c_read_env(session%handle, c_text(path))
  end subroutine carreau_read_env

  subroutine carreau_run_env(session, path, status)
    type(carreau_session), intent(in) :: session
    character(len=*), intent(in) :: path
    integer(c_int32_t), intent(out) :: status
    status = c_run_env(session%handle, c_text(path))
  end subroutine carreau_run_env

  subroutine carreau_session_report(session, report, status)
    type(carreau_session), intent(in) :: session
    type(carreau_report), intent(out) :: report
    integer(c_int32_t), intent(out) :: status
    type(c_report) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    status = c_session_report(session%handle, c)
    if (status /= CARREAU_OK) return
    report%diag = c%diag
    report%surf0_calls = c%surf0_calls
    report%surf1_calls = c%surf1_calls
    report%surf2_calls = c%surf2_calls
    report%curv0_calls = c%curv0_calls
    report%curv1_calls = c%curv1_calls
    report%curv2_calls = c%curv2_calls
    report%size_calls = c%size_calls
    report%seconds_curves = c%seconds_curves
    report%seconds_sampling = c%seconds_sampling
    report%seconds_plane = c%seconds_plane
    report%seconds_lift = c%seconds_lift
    report%seconds_total = c%seconds_total
  end subroutine carreau_session_report

  ! ---- Interfaces ----

  subroutine carreau_session_interface_count(session, count, status)
    type(carreau_session), intent(in) :: session
    integer(c_int64_t), intent(out) :: count
    integer(c_int32_t), intent(out) :: status
    count = 0
    status = c_session_interface_count(session%handle, count)
  end subroutine carreau_session_interface_count

  !> index: from 1.
  subroutine carreau_session_interface(session, index, interface, status)
    type(carreau_session), intent(in) :: session
    integer(c_int64_t), intent(in) :: index
    type(carreau_interface), intent(out) :: interface
    integer(c_int32_t), intent(out) :: status
    type(c_interface) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    status = c_session_interface(session%handle, index - 1, c)
    if (status /= CARREAU_OK) return
    interface%curve = c%curve
    interface%uses = c%uses
    interface%face = c%face
    interface%ic = c%ic
    interface%other_face = c%other_face
    interface%other_ic = c%other_ic
    interface%boundary = c%boundary /= 0
    interface%glued = c%glued /= 0
    interface%degenerate = c%degenerate /= 0
    interface%loose = c%loose /= 0
    interface%gap = c%gap
  end subroutine carreau_session_interface

  ! ---- The delivered mesh ----

  subroutine carreau_session_delivered(session, delivered, status)
    type(carreau_session), intent(in) :: session
    type(carreau_delivered), intent(out) :: delivered
    integer(c_int32_t), intent(out) :: status
    type(c_delivered) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    status = c_session_delivered(session%handle, c)
    if (status /= CARREAU_OK) return
    delivered%vertices = c%vertices
    delivered%edges = c%edges
    delivered%triangles = c%triangles
    delivered%short_edges = c%short_edges
    delivered%long_edges = c%long_edges
    delivered%folded_triangles = c%folded_triangles
    delivered%in_range = c%in_range
    delivered%not_met = c%not_met
    delivered%text = carreau_string(c%text)
    delivered%surf0_calls = c%surf0_calls
    delivered%surf1_calls = c%surf1_calls
    delivered%surf2_calls = c%surf2_calls
    delivered%size_calls = c%size_calls
    delivered%seconds = c%seconds
    delivered%input_distance = c%input_distance
    delivered%input_bound = c%input_bound
    delivered%input_back_distance = c%input_back_distance
    delivered%input_back_bound = c%input_back_bound
  end subroutine carreau_session_delivered

  subroutine carreau_delivered_measure(session, kind, measure, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: kind
    type(carreau_measure), intent(out) :: measure
    integer(c_int32_t), intent(out) :: status
    type(c_measure) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    status = c_delivered_measure(session%handle, kind, c)
    if (status /= CARREAU_OK) return
    measure%name = carreau_string(c%name)
    measure%title = carreau_string(c%title)
    measure%entity = c%entity
    measure%classes = c%classes
    measure%values = c%values
    measure%count = c%count
    measure%mean = c%mean
    measure%min = c%min
    measure%p1 = c%p1
    measure%p99 = c%p99
    measure%max = c%max
    measure%limit = c%limit
    measure%beyond = c%beyond
    measure%forced = c%forced
  end subroutine carreau_delivered_measure

  !> counts(i): values from bounds(i) up to bounds(i + 1)
  subroutine carreau_delivered_histogram(session, kind, bounds, counts, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: kind
    real(c_double), allocatable, intent(out) :: bounds(:)
    integer(c_int64_t), allocatable, intent(out) :: counts(:)
    integer(c_int32_t), intent(out) :: status
    type(carreau_measure) :: measure
    call carreau_delivered_measure(session, kind, measure, status)
    if (status /= CARREAU_OK) return
    allocate (bounds(measure%classes), counts(measure%classes))
    status = c_delivered_histogram(session%handle, kind, int(measure%classes, c_int64_t), bounds, counts)
    if (status /= CARREAU_OK) deallocate (bounds, counts)
  end subroutine carreau_delivered_histogram

  subroutine carreau_delivered_values(session, kind, values, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: kind
    real(c_double), allocatable, intent(out) :: values(:)
    integer(c_int32_t), intent(out) :: status
    type(carreau_measure) :: measure
    call carreau_delivered_measure(session, kind, measure, status)
    if (status /= CARREAU_OK) return
    allocate (values(measure%values))
    status = c_delivered_values(session%handle, kind, measure%values, values)
    if (status /= CARREAU_OK) deallocate (values)
  end subroutine carreau_delivered_values

  !> vertices(2, k), from 1; curves(k): references, 0 inside faces
  subroutine carreau_delivered_edges(session, vertices, curves, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), allocatable, intent(out) :: vertices(:, :), curves(:)
    integer(c_int32_t), intent(out) :: status
    type(carreau_delivered) :: delivered
    call carreau_session_delivered(session, delivered, status)
    if (status /= CARREAU_OK) return
    allocate (vertices(2, delivered%edges), curves(delivered%edges))
    status = c_delivered_edges(session%handle, delivered%edges, vertices, curves)
    if (status == CARREAU_OK) then
      vertices = vertices + 1
    else
      deallocate (vertices, curves)
    end if
  end subroutine carreau_delivered_edges

  !> edges(3, m), from 1: the edge that leaves each corner
  subroutine carreau_delivered_triangle_edges(session, edges, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), allocatable, intent(out) :: edges(:, :)
    integer(c_int32_t), intent(out) :: status
    type(carreau_delivered) :: delivered
    call carreau_session_delivered(session, delivered, status)
    if (status /= CARREAU_OK) return
    allocate (edges(3, delivered%triangles))
    status = c_delivered_triangle_edges(session%handle, delivered%triangles, edges)
    if (status == CARREAU_OK) then
      edges = edges + 1
    else
      deallocate (edges)
    end if
  end subroutine carreau_delivered_triangle_edges

  subroutine carreau_delivered_write(session, path, status)
    type(carreau_session), intent(in) :: session
    character(len=*), intent(in) :: path
    integer(c_int32_t), intent(out) :: status
    status = c_delivered_write(session%handle, c_text(path))
  end subroutine carreau_delivered_write

  ! ---- Meshes ----

  subroutine carreau_session_mesh(session, mesh, status)
    type(carreau_session), intent(in) :: session
    type(carreau_mesh), intent(out) :: mesh
    integer(c_int32_t), intent(out) :: status
    status = c_session_mesh(session%handle, mesh%handle)
  end subroutine carreau_session_mesh

  subroutine carreau_mesh_create(mesh, status)
    type(carreau_mesh), intent(out) :: mesh
    integer(c_int32_t), intent(out) :: status
    status = c_mesh_create(mesh%handle)
  end subroutine carreau_mesh_create

  subroutine carreau_mesh_free(mesh)
    type(carreau_mesh), intent(inout) :: mesh
    call c_mesh_free(mesh%handle)
    mesh%handle = c_null_ptr
  end subroutine carreau_mesh_free

  function carreau_mesh_last_error(mesh) result(error)
    type(carreau_mesh), intent(in) :: mesh
    character(len=:), allocatable :: error
    error = carreau_string(c_mesh_last_error(mesh%handle))
  end function carreau_mesh_last_error

  subroutine carreau_mesh_read(mesh, path, status)
    type(carreau_mesh), intent(in) :: mesh
    character(len=*), intent(in) :: path
    integer(c_int32_t), intent(out) :: status
    status = c_mesh_read(mesh%handle, c_text(path))
  end subroutine carreau_mesh_read

  !> vertices(2 or 3, n); triangles(3, m) and edges(2, k) count vertices from 1; corner_uv(2, 3, m)
  subroutine carreau_mesh_from_arrays(mesh, vertices, triangles, status, edges, vertex_refs, triangle_refs, edge_refs, &
      corner_uv)
    type(carreau_mesh), intent(in) :: mesh
    real(c_double), intent(in) :: vertices(:, :)
    integer(c_int32_t), intent(in) :: triangles(:, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int32_t), intent(in), optional :: edges(:, :), vertex_refs(:), triangle_refs(:), edge_refs(:)
    real(c_double), intent(in), optional :: corner_uv(:, :, :)
    integer(c_int32_t), allocatable, target :: t(:), e(:), of_vertices(:), of_triangles(:), of_edges(:)
    real(c_double), allocatable, target :: p(:), uv(:)
    type(c_mesh_arrays) :: c
    integer :: n, m, k
    status = CARREAU_ERR_ARGUMENT
    n = size(vertices, 2)
    m = size(triangles, 2)
    k = 0
    if (size(triangles, 1) /= 3) return
    c%struct_size = size(transfer(c, [c_null_char]))
    c%dimension = int(size(vertices, 1), c_int32_t)
    allocate (p(size(vertices) + 1), t(3 * m + 1)) ! never empty: C needs an address
    p(:size(vertices)) = reshape(vertices, [size(vertices)])
    t(:3 * m) = reshape(triangles, [3 * m]) - 1
    c%vertices = c_loc(p(1))
    c%triangles = c_loc(t(1))
    if (present(edges)) then
      k = size(edges, 2)
      if (size(edges, 1) /= 2) return
      allocate (e(2 * k + 1))
      e(:2 * k) = reshape(edges, [2 * k]) - 1
      c%edges = c_loc(e(1))
    end if
    if (present(vertex_refs)) then
      if (size(vertex_refs) /= n) return
      allocate (of_vertices(n + 1))
      of_vertices(:n) = vertex_refs
      c%vertex_refs = c_loc(of_vertices(1))
    end if
    if (present(triangle_refs)) then
      if (size(triangle_refs) /= m) return
      allocate (of_triangles(m + 1))
      of_triangles(:m) = triangle_refs
      c%triangle_refs = c_loc(of_triangles(1))
    end if
    if (present(edge_refs)) then
      if (size(edge_refs) /= k) return
      allocate (of_edges(k + 1))
      of_edges(:k) = edge_refs
      c%edge_refs = c_loc(of_edges(1))
    end if
    if (present(corner_uv)) then
      if (size(corner_uv) /= 6 * m) return
      allocate (uv(6 * m + 1))
      uv(:6 * m) = reshape(corner_uv, [6 * m])
      c%corner_uv = c_loc(uv(1))
    end if
    c%vertex_count = n
    c%triangle_count = m
    c%edge_count = k
    status = c_mesh_from_arrays(mesh%handle, c)
  end subroutine carreau_mesh_from_arrays

  subroutine carreau_mesh_write(mesh, path, status)
    type(carreau_mesh), intent(in) :: mesh
    character(len=*), intent(in) :: path
    integer(c_int32_t), intent(out) :: status
    status = c_mesh_write(mesh%handle, c_text(path))
  end subroutine carreau_mesh_write

  subroutine carreau_mesh_encode(mesh, suffix, sink, status, user)
    type(carreau_mesh), intent(in) :: mesh
    character(len=*), intent(in) :: suffix
    procedure(carreau_bytes_fn) :: sink
    integer(c_int32_t), intent(out) :: status
    type(c_ptr), intent(in), optional :: user
    type(c_ptr) :: c_user
    c_user = c_null_ptr
    if (present(user)) c_user = user
    status = c_mesh_encode(mesh%handle, c_text(suffix), c_funloc(sink), c_user)
  end subroutine carreau_mesh_encode

  !> The part of this process of a mesh that all processes of the team make.
  subroutine carreau_mesh_generate_part(session, part, status)
    type(carreau_session), intent(in) :: session
    type(carreau_mesh), intent(in) :: part
    integer(c_int32_t), intent(out) :: status
    status = c_mesh_generate_part(session%handle, part%handle)
  end subroutine carreau_mesh_generate_part

  subroutine carreau_mesh_part_count(part, counts, status)
    type(carreau_mesh), intent(in) :: part
    type(carreau_part_counts), intent(out) :: counts
    integer(c_int32_t), intent(out) :: status
    type(c_part_counts) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    status = c_mesh_part_count(part%handle, c)
    if (status /= CARREAU_OK) return
    counts%rank = c%rank
    counts%size = c%size
    counts%own_vertices = c%own_vertices
    counts%own_triangles = c%own_triangles
    counts%all_vertices = c%all_vertices
    counts%all_triangles = c%all_triangles
    counts%all_edges = c%all_edges
    counts%crossings = c%crossings
  end subroutine carreau_mesh_part_count

  !> Quality of the whole mesh.
  subroutine carreau_mesh_part_quality(part, quality, status)
    type(carreau_mesh), intent(in) :: part
    type(carreau_quality), intent(out) :: quality
    integer(c_int32_t), intent(out) :: status
    type(c_quality) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    status = c_mesh_part_quality(part%handle, c)
    if (status /= CARREAU_OK) return
    quality%vertices = c%vertices
    quality%triangles = c%triangles
    quality%edges = c%edges
    quality%open_edges = c%open_edges
    quality%q1_mean = c%q1_mean
    quality%q1_min = c%q1_min
    quality%q1_p1 = c%q1_p1
    quality%q1_max = c%q1_max
    quality%q2_mean = c%q2_mean
    quality%q2_min = c%q2_min
    quality%q2_p1 = c%q2_p1
    quality%q2_max = c%q2_max
    quality%angle_min = c%angle_min
    quality%angle_max = c%angle_max
    quality%area = c%area
    quality%edge_min = c%edge_min
    quality%edge_mean = c%edge_mean
    quality%edge_max = c%edge_max
    quality%degree6 = c%degree6
  end subroutine carreau_mesh_part_quality

  !> numbers and rows count from 0
  subroutine carreau_mesh_part_vertices(part, numbers, owners, rows, status)
    type(carreau_mesh), intent(in) :: part
    integer(c_int64_t), allocatable, intent(out) :: numbers(:)
    integer(c_int32_t), allocatable, intent(out) :: owners(:)
    integer(c_int64_t), allocatable, intent(out) :: rows(:)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: vertices, triangles, edges, faces
    call carreau_mesh_count(part, vertices, triangles, edges, faces, status)
    if (status /= CARREAU_OK) return
    allocate (numbers(vertices), owners(vertices), rows(vertices))
    status = c_mesh_part_vertices(part%handle, vertices, numbers, owners, rows)
  end subroutine carreau_mesh_part_vertices

  !> numbers count from 0
  subroutine carreau_mesh_part_triangles(part, numbers, owners, status)
    type(carreau_mesh), intent(in) :: part
    integer(c_int64_t), allocatable, intent(out) :: numbers(:)
    integer(c_int32_t), allocatable, intent(out) :: owners(:)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: vertices, triangles, edges, faces
    call carreau_mesh_count(part, vertices, triangles, edges, faces, status)
    if (status /= CARREAU_OK) return
    allocate (numbers(triangles), owners(triangles))
    status = c_mesh_part_triangles(part%handle, triangles, numbers, owners)
  end subroutine carreau_mesh_part_triangles

  subroutine carreau_mesh_count(mesh, vertices, triangles, edges, faces, status)
    type(carreau_mesh), intent(in) :: mesh
    integer(c_int64_t), intent(out) :: vertices, triangles, edges, faces
    integer(c_int32_t), intent(out) :: status
    vertices = 0
    triangles = 0
    edges = 0
    faces = 0
    status = c_mesh_count(mesh%handle, vertices, triangles, edges, faces)
  end subroutine carreau_mesh_count

  subroutine carreau_mesh_dimension(mesh, dimension, status)
    type(carreau_mesh), intent(in) :: mesh
    integer(c_int32_t), intent(out) :: dimension, status
    dimension = 0
    status = c_mesh_dimension(mesh%handle, dimension)
  end subroutine carreau_mesh_dimension

  subroutine carreau_mesh_order(mesh, order, status)
    type(carreau_mesh), intent(in) :: mesh
    integer(c_int32_t), intent(out) :: order, status
    order = 0
    status = c_mesh_order(mesh%handle, order)
  end subroutine carreau_mesh_order

  !> xyz(3, n)
  subroutine carreau_mesh_vertices(mesh, xyz, status)
    type(carreau_mesh), intent(in) :: mesh
    real(c_double), allocatable, intent(out) :: xyz(:, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: vertices, triangles, edges, faces
    call carreau_mesh_count(mesh, vertices, triangles, edges, faces, status)
    if (status /= CARREAU_OK) return
    allocate (xyz(3, vertices))
    status = c_mesh_vertices(mesh%handle, vertices, xyz)
  end subroutine carreau_mesh_vertices

  subroutine carreau_mesh_vertex_refs(mesh, refs, status)
    type(carreau_mesh), intent(in) :: mesh
    integer(c_int32_t), allocatable, intent(out) :: refs(:)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: vertices, triangles, edges, faces
    call carreau_mesh_count(mesh, vertices, triangles, edges, faces, status)
    if (status /= CARREAU_OK) return
    allocate (refs(vertices))
    status = c_mesh_vertex_refs(mesh%handle, vertices, refs)
  end subroutine carreau_mesh_vertex_refs

  subroutine carreau_mesh_vertex_sizes(mesh, sizes, status)
    type(carreau_mesh), intent(in) :: mesh
    real(c_double), allocatable, intent(out) :: sizes(:)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: vertices, triangles, edges, faces
    call carreau_mesh_count(mesh, vertices, triangles, edges, faces, status)
    if (status /= CARREAU_OK) return
    allocate (sizes(vertices))
    status = c_mesh_vertex_sizes(mesh%handle, vertices, sizes)
    if (status /= CARREAU_OK) deallocate (sizes)
  end subroutine carreau_mesh_vertex_sizes

  !> vertices(3, m), from 1
  subroutine carreau_mesh_triangles(mesh, vertices, status)
    type(carreau_mesh), intent(in) :: mesh
    integer(c_int32_t), allocatable, intent(out) :: vertices(:, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: vertices_count, triangles, edges, faces
    call carreau_mesh_count(mesh, vertices_count, triangles, edges, faces, status)
    if (status /= CARREAU_OK) return
    allocate (vertices(3, triangles))
    status = c_mesh_triangles(mesh%handle, triangles, vertices)
    vertices = vertices + 1
  end subroutine carreau_mesh_triangles

  subroutine carreau_mesh_triangle_refs(mesh, refs, status)
    type(carreau_mesh), intent(in) :: mesh
    integer(c_int32_t), allocatable, intent(out) :: refs(:)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: vertices, triangles, edges, faces
    call carreau_mesh_count(mesh, vertices, triangles, edges, faces, status)
    if (status /= CARREAU_OK) return
    allocate (refs(triangles))
    status = c_mesh_triangle_refs(mesh%handle, triangles, refs)
  end subroutine carreau_mesh_triangle_refs

  !> uv(2, 3, m)
  subroutine carreau_mesh_corner_uv(mesh, uv, status)
    type(carreau_mesh), intent(in) :: mesh
    real(c_double), allocatable, intent(out) :: uv(:, :, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: vertices, triangles, edges, faces
    call carreau_mesh_count(mesh, vertices, triangles, edges, faces, status)
    if (status /= CARREAU_OK) return
    allocate (uv(2, 3, triangles))
    status = c_mesh_corner_uv(mesh%handle, triangles, uv)
    if (status /= CARREAU_OK) deallocate (uv)
  end subroutine carreau_mesh_corner_uv

  !> refs(3, m): of the faces that corner_uv is of
  subroutine carreau_mesh_corner_faces(mesh, refs, status)
    type(carreau_mesh), intent(in) :: mesh
    integer(c_int32_t), allocatable, intent(out) :: refs(:, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: vertices, triangles, edges, faces
    call carreau_mesh_count(mesh, vertices, triangles, edges, faces, status)
    if (status /= CARREAU_OK) return
    allocate (refs(3, triangles))
    status = c_mesh_corner_faces(mesh%handle, triangles, refs)
    if (status /= CARREAU_OK) deallocate (refs)
  end subroutine carreau_mesh_corner_faces

  !> vertices(2, k), from 1
  subroutine carreau_mesh_edges(mesh, vertices, status)
    type(carreau_mesh), intent(in) :: mesh
    integer(c_int32_t), allocatable, intent(out) :: vertices(:, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: vertices_count, triangles, edges, faces
    call carreau_mesh_count(mesh, vertices_count, triangles, edges, faces, status)
    if (status /= CARREAU_OK) return
    allocate (vertices(2, edges))
    status = c_mesh_edges(mesh%handle, edges, vertices)
    vertices = vertices + 1
  end subroutine carreau_mesh_edges

  subroutine carreau_mesh_edge_refs(mesh, refs, status)
    type(carreau_mesh), intent(in) :: mesh
    integer(c_int32_t), allocatable, intent(out) :: refs(:)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: vertices, triangles, edges, faces
    call carreau_mesh_count(mesh, vertices, triangles, edges, faces, status)
    if (status /= CARREAU_OK) return
    allocate (refs(edges))
    status = c_mesh_edge_refs(mesh%handle, edges, refs)
  end subroutine carreau_mesh_edge_refs

  !> Nodes between the ends of edges, from 1; 0: the edge is straight.
  subroutine carreau_mesh_edge_mids(mesh, vertices, status)
    type(carreau_mesh), intent(in) :: mesh
    integer(c_int32_t), allocatable, intent(out) :: vertices(:)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: vertices_count, triangles, edges, faces
    call carreau_mesh_count(mesh, vertices_count, triangles, edges, faces, status)
    if (status /= CARREAU_OK) return
    allocate (vertices(edges))
    status = c_mesh_edge_mids(mesh%handle, edges, vertices)
    vertices = vertices + 1
  end subroutine carreau_mesh_edge_mids

  subroutine carreau_mesh_cell_count(mesh, kind, count, status)
    type(carreau_mesh), intent(in) :: mesh
    integer(c_int32_t), intent(in) :: kind
    integer(c_int64_t), intent(out) :: count
    integer(c_int32_t), intent(out) :: status
    count = 0
    status = c_mesh_cell_count(mesh%handle, kind, count)
  end subroutine carreau_mesh_cell_count

  !> nodes(nodes of the kind, elements), from 1; refs: of their faces
  subroutine carreau_mesh_cells(mesh, kind, nodes, refs, status)
    type(carreau_mesh), intent(in) :: mesh
    integer(c_int32_t), intent(in) :: kind
    integer(c_int32_t), allocatable, intent(out) :: nodes(:, :), refs(:)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: count
    call carreau_mesh_cell_count(mesh, kind, count, status)
    if (status /= CARREAU_OK) return
    allocate (nodes(nodes_of_kind(kind), count), refs(count))
    status = c_mesh_cells(mesh%handle, kind, count, nodes, refs)
    nodes = nodes + 1
  end subroutine carreau_mesh_cells

  !> uv(2, nodes of the kind, elements)
  subroutine carreau_mesh_cell_uv(mesh, kind, uv, status)
    type(carreau_mesh), intent(in) :: mesh
    integer(c_int32_t), intent(in) :: kind
    real(c_double), allocatable, intent(out) :: uv(:, :, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: count
    call carreau_mesh_cell_count(mesh, kind, count, status)
    if (status /= CARREAU_OK) return
    allocate (uv(2, nodes_of_kind(kind), count))
    status = c_mesh_cell_uv(mesh%handle, kind, count, uv)
    if (status /= CARREAU_OK) deallocate (uv)
  end subroutine carreau_mesh_cell_uv

  !> refs(nodes of the kind, elements): of the faces that carreau_mesh_cell_uv is of
  subroutine carreau_mesh_cell_faces(mesh, kind, refs, status)
    type(carreau_mesh), intent(in) :: mesh
    integer(c_int32_t), intent(in) :: kind
    integer(c_int32_t), allocatable, intent(out) :: refs(:, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: count
    call carreau_mesh_cell_count(mesh, kind, count, status)
    if (status /= CARREAU_OK) return
    allocate (refs(nodes_of_kind(kind), count))
    status = c_mesh_cell_faces(mesh%handle, kind, count, refs)
    if (status /= CARREAU_OK) deallocate (refs)
  end subroutine carreau_mesh_cell_faces

  pure integer function nodes_of_kind(kind)
    integer(c_int32_t), intent(in) :: kind
    integer, parameter :: nodes(4) = [3, 6, 4, 8]
    nodes_of_kind = nodes(kind)
  end function nodes_of_kind

  subroutine carreau_mesh_cell_quality(mesh, quality, status)
    type(carreau_mesh), intent(in) :: mesh
    type(carreau_cell_quality), intent(out) :: quality
    integer(c_int32_t), intent(out) :: status
    type(c_cell_quality) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    status = c_mesh_cell_quality(mesh%handle, c)
    if (status /= CARREAU_OK) return
    quality%triangles3 = c%triangles3
    quality%triangles6 = c%triangles6
    quality%quads4 = c%quads4
    quality%quads8 = c%quads8
    quality%invalid = c%invalid
    quality%shape_mean = c%shape_mean
    quality%shape_min = c%shape_min
    quality%scaled_jacobian_mean = c%scaled_jacobian_mean
    quality%scaled_jacobian_min = c%scaled_jacobian_min
    quality%least_jacobian_mean = c%least_jacobian_mean
    quality%least_jacobian_min = c%least_jacobian_min
    quality%angle_min = c%angle_min
    quality%angle_max = c%angle_max
    quality%area = c%area
    quality%triangle_share = c%triangle_share
  end subroutine carreau_mesh_cell_quality

  !> index: from 1.
  subroutine carreau_mesh_face(mesh, index, face, status)
    type(carreau_mesh), intent(in) :: mesh
    integer(c_int64_t), intent(in) :: index
    type(carreau_face), intent(out) :: face
    integer(c_int32_t), intent(out) :: status
    type(c_face) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    status = c_mesh_face(mesh%handle, index - 1, c)
    if (status /= CARREAU_OK) return
    face%ref = c%ref
    face%status = c%status
    face%triangles = c%triangles
    face%why = carreau_string(c%why)
    face%name = carreau_string(c%name)
    face%rgb = c%rgb
  end subroutine carreau_mesh_face

  !> solids: the solid that the triangles of the face look out of, and the solid that they look into; 0: none.
  subroutine carreau_mesh_face_sides(mesh, face_ref, solids, status)
    type(carreau_mesh), intent(in) :: mesh
    integer(c_int32_t), intent(in) :: face_ref
    integer(c_int32_t), intent(out) :: solids(2), status
    solids = 0
    status = c_mesh_face_sides(mesh%handle, face_ref, solids)
  end subroutine carreau_mesh_face_sides

  subroutine carreau_mesh_periodic_count(mesh, pairs, nodes, status)
    type(carreau_mesh), intent(in) :: mesh
    integer(c_int64_t), intent(out) :: pairs, nodes
    integer(c_int32_t), intent(out) :: status
    pairs = 0
    nodes = 0
    status = c_mesh_periodic_count(mesh%handle, pairs, nodes)
  end subroutine carreau_mesh_periodic_count

  !> dimensions(pairs), refs(2, pairs): slave, master; transforms(4, 3, pairs); counts(pairs); nodes(2, all), from 1.
  subroutine carreau_mesh_periodic(mesh, dimensions, refs, transforms, counts, nodes, status)
    type(carreau_mesh), intent(in) :: mesh
    integer(c_int32_t), allocatable, intent(out) :: dimensions(:), refs(:, :), nodes(:, :)
    real(c_double), allocatable, intent(out) :: transforms(:, :, :)
    integer(c_int64_t), allocatable, intent(out) :: counts(:)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: pairs, all
    pairs = 0
    all = 0
    status = c_mesh_periodic_count(mesh%handle, pairs, all)
    allocate(dimensions(pairs), refs(2, pairs), transforms(4, 3, pairs), counts(pairs), nodes(2, all))
    if (status /= 0) return
    status = c_mesh_periodic(mesh%handle, pairs, all, dimensions, refs, transforms, counts, nodes)
    nodes = nodes + 1
  end subroutine carreau_mesh_periodic

  function carreau_mesh_entity_name(mesh, dimension, ref) result(name)
    type(carreau_mesh), intent(in) :: mesh
    integer(c_int32_t), intent(in) :: dimension, ref
    character(len=:), allocatable :: name
    name = carreau_string(c_mesh_entity_name(mesh%handle, dimension, ref))
  end function carreau_mesh_entity_name

  subroutine carreau_mesh_quality(mesh, quality, status)
    type(carreau_mesh), intent(in) :: mesh
    type(carreau_quality), intent(out) :: quality
    integer(c_int32_t), intent(out) :: status
    type(c_quality) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    status = c_mesh_quality(mesh%handle, c)
    if (status /= CARREAU_OK) return
    quality%vertices = c%vertices
    quality%triangles = c%triangles
    quality%edges = c%edges
    quality%open_edges = c%open_edges
    quality%q1_mean = c%q1_mean
    quality%q1_min = c%q1_min
    quality%q1_p1 = c%q1_p1
    quality%q1_max = c%q1_max
    quality%q2_mean = c%q2_mean
    quality%q2_min = c%q2_min
    quality%q2_p1 = c%q2_p1
    quality%q2_max = c%q2_max
    quality%angle_min = c%angle_min
    quality%angle_max = c%angle_max
    quality%area = c%area
    quality%edge_min = c%edge_min
    quality%edge_mean = c%edge_mean
    quality%edge_max = c%edge_max
    quality%degree6 = c%degree6
  end subroutine carreau_mesh_quality

  subroutine carreau_mesh_defects(mesh, closed, limit, count, text, status)
    type(carreau_mesh), intent(in) :: mesh
    logical, intent(in) :: closed
    integer(c_int64_t), intent(in) :: limit
    integer(c_int64_t), intent(out) :: count
    character(len=:), allocatable, intent(out) :: text
    integer(c_int32_t), intent(out) :: status
    type(c_ptr) :: c_sentences
    count = 0
    c_sentences = c_null_ptr
    status = c_mesh_defects(mesh%handle, merge(1_c_int32_t, 0_c_int32_t, closed), limit, count, c_sentences)
    text = carreau_string(c_sentences)
  end subroutine carreau_mesh_defects

  !> solids(n) and xyz(3, n) of all regions; solid 0 is a hole
  subroutine carreau_mesh_regions(mesh, solids, xyz, status)
    type(carreau_mesh), intent(in) :: mesh
    integer(c_int32_t), allocatable, intent(out) :: solids(:)
    real(c_double), allocatable, intent(out) :: xyz(:, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int32_t) :: no_solids(0)
    real(c_double) :: no_places(3, 0)
    integer(c_int64_t) :: n, count
    n = 0
    status = c_mesh_regions(mesh%handle, 0_c_int64_t, n, no_solids, no_places)
    allocate (solids(n), xyz(3, n))
    if (n > 0) status = c_mesh_regions(mesh%handle, n, count, solids, xyz)
  end subroutine carreau_mesh_regions

  subroutine carreau_mesh_triangle_sides(mesh, solids, status)
    type(carreau_mesh), intent(in) :: mesh
    integer(c_int32_t), allocatable, intent(out) :: solids(:, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: vertices, triangles, edges, faces
    call carreau_mesh_count(mesh, vertices, triangles, edges, faces, status)
    if (status /= CARREAU_OK) return
    allocate (solids(2, triangles))
    status = c_mesh_triangle_sides(mesh%handle, triangles, solids)
  end subroutine carreau_mesh_triangle_sides

  !> triangles(2, n) and xyz(3, n) of the first n pairs, n = min(most, count)
  subroutine carreau_mesh_intersections(mesh, threads, most, count, triangles, xyz, status)
    type(carreau_mesh), intent(in) :: mesh
    integer(c_int32_t), intent(in) :: threads
    integer(c_int64_t), intent(in) :: most
    integer(c_int64_t), intent(out) :: count
    integer(c_int32_t), allocatable, intent(out) :: triangles(:, :)
    real(c_double), allocatable, intent(out) :: xyz(:, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int32_t), allocatable :: room(:, :)
    real(c_double), allocatable :: places(:, :)
    integer(c_int64_t) :: n
    count = 0
    n = max(most, 0_c_int64_t)
    allocate (room(2, n), places(3, n))
    status = c_mesh_intersections(mesh%handle, threads, n, count, room, places)
    n = min(n, count)
    triangles = room(:, 1:n) + 1
    xyz = places(:, 1:n)
  end subroutine carreau_mesh_intersections

  ! ---- Fields as images ----

  !> Triangles in the files count from 0, as in C.
  subroutine carreau_write_exr(session, path, options, status)
    type(carreau_session), intent(in) :: session
    character(len=*), intent(in) :: path
    type(carreau_exr_options), intent(in) :: options
    integer(c_int32_t), intent(out) :: status
    type(c_exr_options) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    c%longest = options%longest
    c%width = options%width
    c%height = options%height
    c%channels = options%channels
    c%face = options%face
    c%multi_part = merge(1, 0, options%multi_part)
    c%raw = merge(1, 0, options%raw)
    c%compression = options%compression
    c%threads = options%threads
    status = c_write_exr(session%handle, c_text(path), c)
  end subroutine carreau_write_exr

  ! ---- Curves in metrics ----

  !> points(2 or 3, n) of a polyline; metrics(3 or 6, m), xx xy yy or xx xy xz yy yz zz, at abscissae(m); law 0, 1, 2;
  !> lss 0: 0.5. cuts(number of edges + 1): abscissae of edges of equal length in the metric; length: the length of the
  !! curve.
  subroutine carreau_curve_split(session, points, abscissae, metrics, law, lss, cuts, length, status)
    type(carreau_session), intent(in) :: session
    real(c_double), intent(in) :: points(:, :), abscissae(:), metrics(:, :)
    integer(c_int32_t), intent(in) :: law
    real(c_double), intent(in) :: lss
    real(c_double), allocatable, intent(out) :: cuts(:)
    real(c_double), intent(out) :: length
    integer(c_int32_t), intent(out) :: status
    real(c_double), allocatable, target :: p(:), s(:), m(:)
    real(c_double), allocatable :: found(:)
    real(c_double) :: none(1)
    integer(c_int64_t) :: edges
    type(c_curve) :: c
    length = 0
    none = 0
    edges = 0
    if (size(metrics, 2) /= size(abscissae) .or. size(metrics, 1) /= merge(3, 6, size(points, 1) == 2)) then
      status = CARREAU_ERR_ARGUMENT
      return
    end if
    allocate (p(size(points)), s(size(abscissae)), m(size(metrics)))
    p = reshape(points, [size(points)])
    s = abscissae
    m = reshape(metrics, [size(metrics)])
    c%struct_size = size(transfer(c, [c_null_char]))
    c%dimension = int(size(points, 1), c_int32_t)
    c%law = law
    c%point_count = size(points, 2)
    c%metric_count = size(abscissae)
    if (size(p) > 0) c%points = c_loc(p(1))
    if (size(s) > 0) c%abscissae = c_loc(s(1))
    if (size(m) > 0) c%metrics = c_loc(m(1))
    c%lss = lss
    status = c_curve_split(session%handle, c, 0_c_int64_t, none, edges, length)
    if (status /= CARREAU_OK) return
    allocate (found(edges + 1))
    status = c_curve_split(session%handle, c, edges + 1, found, edges, length)
    if (status == CARREAU_OK) cuts = found
  end subroutine carreau_curve_split

  ! ---- Algebra of metrics ----
  ! metrics(3, n), xx xy yy, of the plane, or (6, n), xx xy xz yy yz zz, of space. Arrays that do not fit are
  ! CARREAU_ERR_ARGUMENT.

  !> sizes(d, n) along the axes, the smallest first; axes(:, k, n) is unit axis k.
  subroutine carreau_metric_sizes(session, metrics, sizes, axes, status)
    type(carreau_session), intent(in) :: session
    real(c_double), intent(in) :: metrics(:, :)
    real(c_double), allocatable, intent(out) :: sizes(:, :), axes(:, :, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int32_t) :: d
    d = dimension_of(metrics)
    allocate (sizes(d, size(metrics, 2)), axes(d, d, size(metrics, 2)))
    status = c_metric_sizes(session%handle, d, size(metrics, 2, kind=c_int64_t), metrics, sizes, axes)
  end subroutine carreau_metric_sizes

  !> The reverse: axes need not be unit or orthogonal.
  subroutine carreau_metric_of_sizes(session, sizes, axes, metrics, status)
    type(carreau_session), intent(in) :: session
    real(c_double), intent(in) :: sizes(:, :), axes(:, :, :)
    real(c_double), allocatable, intent(out) :: metrics(:, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int32_t) :: d
    d = size(sizes, 1)
    status = CARREAU_ERR_ARGUMENT
    if (any(shape(axes) /= [size(sizes, 1), size(sizes, 1), size(sizes, 2)])) return
    allocate (metrics(merge(3, 6, d == 2), size(sizes, 2)))
    status = c_metric_of_sizes(session%handle, d, size(sizes, 2, kind=c_int64_t), sizes, axes, metrics)
  end subroutine carreau_metric_of_sizes

  !> metrics(:, i) at share(i) from p(:, i) to q(:, i); law 0 linear, 1 geometric, 2 sinusoidal.
  subroutine carreau_metric_interpolate(session, law, p, q, share, metrics, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: law
    real(c_double), intent(in) :: p(:, :), q(:, :), share(:)
    real(c_double), allocatable, intent(out) :: metrics(:, :)
    integer(c_int32_t), intent(out) :: status
    status = CARREAU_ERR_ARGUMENT
    if (any(shape(p) /= shape(q)) .or. size(share) /= size(p, 2)) return
    allocate (metrics(size(p, 1), size(p, 2)))
    status = c_metric_interpolate(session%handle, dimension_of(p), law, size(p, 2, kind=c_int64_t), p, q, share, metrics)
  end subroutine carreau_metric_interpolate

  !> found(:, i): the intersection of metrics(:, 1, i), metrics(:, 2, i), ...; how: CARREAU_INTERSECT_...
  subroutine carreau_metric_intersect(session, how, metrics, found, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: how
    real(c_double), intent(in) :: metrics(:, :, :)
    real(c_double), allocatable, intent(out) :: found(:, :)
    integer(c_int32_t), intent(out) :: status
    allocate (found(size(metrics, 1), size(metrics, 3)))
    status = CARREAU_OK
    if (size(metrics, 3) == 0) return
    status = c_metric_intersect(session%handle, dimension_of(metrics(:, :, 1)), how, size(metrics, 3, kind=c_int64_t), &
      size(metrics, 2, kind=c_int64_t), metrics, found)
  end subroutine carreau_metric_intersect

  !> directions(:, k, i), unit, are orthogonal in both metrics; p_sizes(k, i), q_sizes(k, i): sizes along them.
  subroutine carreau_metric_reduce(session, p, q, p_sizes, q_sizes, directions, status)
    type(carreau_session), intent(in) :: session
    real(c_double), intent(in) :: p(:, :), q(:, :)
    real(c_double), allocatable, intent(out) :: p_sizes(:, :), q_sizes(:, :), directions(:, :, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int32_t) :: d
    status = CARREAU_ERR_ARGUMENT
    if (any(shape(p) /= shape(q))) return
    d = dimension_of(p)
    allocate (p_sizes(d, size(p, 2)), q_sizes(d, size(p, 2)), directions(d, d, size(p, 2)))
    status = c_metric_reduce(session%handle, d, size(p, 2, kind=c_int64_t), p, q, p_sizes, q_sizes, directions)
  end subroutine carreau_metric_reduce

  !> edges(2 or 3, 2, n), metrics(3 or 6, 2, n) at their ends; lengths(n), with the law between them.
  subroutine carreau_metric_lengths(session, law, edges, metrics, lengths, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: law
    real(c_double), intent(in) :: edges(:, :, :), metrics(:, :, :)
    real(c_double), allocatable, intent(out) :: lengths(:)
    integer(c_int32_t), intent(out) :: status
    status = CARREAU_ERR_ARGUMENT
    if (any(shape(metrics) /= [merge(3, 6, size(edges, 1) == 2), 2, size(edges, 3)]) .or. size(edges, 2) /= 2) return
    allocate (lengths(size(edges, 3)))
    status = c_metric_lengths(session%handle, int(size(edges, 1), c_int32_t), law, size(edges, 3, kind=c_int64_t), edges, &
      metrics, lengths)
  end subroutine carreau_metric_lengths

  !> 2 or 3; 0: neither, which the library rejects.
  pure integer(c_int32_t) function dimension_of(metrics) result(d)
    real(c_double), intent(in) :: metrics(:, :)
    d = 0
    if (size(metrics, 1) == 3) d = 2
    if (size(metrics, 1) == 6) d = 3
  end function dimension_of

  ! ---- Background meshes ----

  subroutine carreau_set_background_mesh(session, mesh_path, sol_path, status)
    type(carreau_session), intent(in) :: session
    character(len=*), intent(in) :: mesh_path, sol_path
    integer(c_int32_t), intent(out) :: status
    status = c_set_background_mesh(session%handle, c_text(mesh_path), c_text(sol_path))
  end subroutine carreau_set_background_mesh

  !> Sets sizes by the fields of a file: see adapt_ parameters.
  subroutine carreau_set_background_fields(session, mesh_path, sol_path, status)
    type(carreau_session), intent(in) :: session
    character(len=*), intent(in) :: mesh_path, sol_path
    integer(c_int32_t), intent(out) :: status
    status = c_set_background_fields(session%handle, c_text(mesh_path), c_text(sol_path))
  end subroutine carreau_set_background_fields

  !> metrics(6, n) xx xy xz yy yz zz at the vertices of a mesh.
  subroutine carreau_mesh_read_metrics(mesh, sol_path, metrics, status)
    type(carreau_mesh), intent(in) :: mesh
    character(len=*), intent(in) :: sol_path
    real(c_double), allocatable, intent(out) :: metrics(:, :)
    integer(c_int32_t), intent(out) :: status
    real(c_double), allocatable :: found(:, :)
    integer(c_int64_t) :: vertices, triangles, edges, faces
    call carreau_mesh_count(mesh, vertices, triangles, edges, faces, status)
    if (status /= CARREAU_OK) return
    allocate (found(6, vertices))
    status = c_mesh_read_metrics(mesh%handle, c_text(sol_path), vertices, found)
    if (status == CARREAU_OK) metrics = found
  end subroutine carreau_mesh_read_metrics

  !> outside: vertices beside the old mesh.
  subroutine carreau_transfer_files(session, mesh_path, sol_path, out_path, outside, status)
    type(carreau_session), intent(in) :: session
    character(len=*), intent(in) :: mesh_path, sol_path, out_path
    integer(c_int64_t), intent(out) :: outside
    integer(c_int32_t), intent(out) :: status
    outside = 0
    status = c_transfer_files(session%handle, c_text(mesh_path), c_text(sol_path), c_text(out_path), outside)
  end subroutine carreau_transfer_files

  !> vertices(2 or 3, n), triangles(3, m); faces(m): references, in two dimensions only; either sizes(n) or metrics:
  !> (6, n) xx xy xz yy yz zz, or in two dimensions (3, n) uu uv vv. Beside the triangles, of which there may be none
  !> (3, 0), or in their place: tetrahedra(4, :) of space, edges(2, :) of curves.
  subroutine carreau_set_background(session, vertices, triangles, status, faces, sizes, metrics, tetrahedra, edges)
    type(carreau_session), intent(in) :: session
    real(c_double), intent(in) :: vertices(:, :)
    integer(c_int32_t), intent(in) :: triangles(:, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int32_t), intent(in), optional :: faces(:)
    real(c_double), intent(in), optional :: sizes(:), metrics(:, :)
    integer(c_int32_t), intent(in), optional :: tetrahedra(:, :), edges(:, :)
    real(c_double), allocatable, target :: p(:), h(:), m(:)
    integer(c_int32_t), allocatable, target :: t(:), f(:), solids(:), lines(:)
    type(c_background) :: c
    status = CARREAU_ERR_ARGUMENT
    if (size(triangles, 1) /= 3) return
    if (present(tetrahedra)) then
      if (size(tetrahedra, 1) /= 4) return
    end if
    if (present(edges)) then
      if (size(edges, 1) /= 2) return
    end if
    if (present(faces)) then
      if (size(faces) /= size(triangles, 2)) return
    end if
    if (present(sizes)) then
      if (size(sizes) /= size(vertices, 2)) return
    end if
    if (present(metrics)) then
      if (size(metrics, 2) /= size(vertices, 2) .or. size(metrics, 1) /= merge(3, 6, size(vertices, 1) == 2)) return
    end if
    c%struct_size = size(transfer(c, [c_null_char]))
    c%dimension = int(size(vertices, 1), c_int32_t)
    c%vertex_count = size(vertices, 2)
    c%triangle_count = size(triangles, 2)
    allocate (p(size(vertices) + 1), t(size(triangles) + 1)) ! never empty: C needs an address
    p(:size(vertices)) = reshape(vertices, [size(vertices)])
    t(:size(triangles)) = reshape(triangles, [size(triangles)]) - 1
    c%vertices = c_loc(p(1))
    c%triangles = c_loc(t(1))
    if (present(tetrahedra)) then
      c%tetrahedron_count = size(tetrahedra, 2)
      allocate (solids(size(tetrahedra) + 1))
      solids(:size(tetrahedra)) = reshape(tetrahedra, [size(tetrahedra)]) - 1
      c%tetrahedra = c_loc(solids(1))
    end if
    if (present(edges)) then
      c%edge_count = size(edges, 2)
      allocate (lines(size(edges) + 1))
      lines(:size(edges)) = reshape(edges, [size(edges)]) - 1
      c%edges = c_loc(lines(1))
    end if
    if (present(faces)) then
      allocate (f(size(faces) + 1))
      f(:size(faces)) = faces
      c%faces = c_loc(f(1))
    end if
    if (present(sizes)) then
      allocate (h(size(sizes) + 1))
      h(:size(sizes)) = sizes
      c%sizes = c_loc(h(1))
    end if
    if (present(metrics)) then
      allocate (m(size(metrics) + 1))
      m(:size(metrics)) = reshape(metrics, [size(metrics)])
      c%metrics = c_loc(m(1))
    end if
    status = c_set_background(session%handle, c)
  end subroutine carreau_set_background

  subroutine carreau_set_vertex_sizes(session, sizes, status)
    type(carreau_session), intent(in) :: session
    real(c_double), intent(in) :: sizes(:)
    integer(c_int32_t), intent(out) :: status
    status = c_set_vertex_sizes(session%handle, size(sizes, kind=c_int64_t), sizes)
  end subroutine carreau_set_vertex_sizes

  !> metrics(6, n): xx xy xz yy yz zz
  subroutine carreau_set_vertex_metrics(session, metrics, status)
    type(carreau_session), intent(in) :: session
    real(c_double), intent(in) :: metrics(:, :)
    integer(c_int32_t), intent(out) :: status
    status = CARREAU_ERR_ARGUMENT
    if (size(metrics, 1) /= 6) return
    status = c_set_vertex_metrics(session%handle, size(metrics, 2, c_int64_t), reshape(metrics, [size(metrics)]))
  end subroutine carreau_set_vertex_metrics

  subroutine carreau_clear_background(session, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(out) :: status
    status = c_clear_background(session%handle)
  end subroutine carreau_clear_background

  !> vertices(3, n); elements(3, m) of indices from 1: a triangle, an edge (a, b, b), a point (a, a, a).
  subroutine carreau_add_attractor(session, vertices, elements, size_on, surrounding, reach, status)
    type(carreau_session), intent(in) :: session
    real(c_double), intent(in) :: vertices(:, :), size_on, surrounding, reach
    integer(c_int32_t), intent(in) :: elements(:, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int32_t) :: from_zero(size(elements, 1), size(elements, 2))
    status = CARREAU_ERR_ARGUMENT
    if (size(vertices, 1) /= 3 .or. size(elements, 1) /= 3) return
    from_zero = elements - 1_c_int32_t
    status = c_add_attractor(session%handle, size(vertices, 2, kind=c_int64_t), vertices, size(elements, 2, kind=c_int64_t), &
      from_zero, size_on, surrounding, reach)
  end subroutine carreau_add_attractor

  subroutine carreau_clear_attractors(session, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(out) :: status
    status = c_clear_attractors(session%handle)
  end subroutine carreau_clear_attractors

  subroutine carreau_add_layers(session, curves, first, ratio, count, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: curves(:), count
    real(c_double), intent(in) :: first, ratio
    integer(c_int32_t), intent(out) :: status
    status = c_add_layers(session%handle, size(curves, kind=c_int64_t), curves, first, ratio, count)
  end subroutine carreau_add_layers

  subroutine carreau_clear_layers(session, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(out) :: status
    status = c_clear_layers(session%handle)
  end subroutine carreau_clear_layers

  subroutine carreau_session_layers(session, index, report, status)
    type(carreau_session), intent(in) :: session
    integer(c_int64_t), intent(in) :: index
    type(carreau_layers_report), intent(out) :: report
    integer(c_int32_t), intent(out) :: status
    type(c_layers_report) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    status = c_session_layers(session%handle, index - 1, c)
    if (status /= CARREAU_OK) return
    report%cells = c%cells
    report%rows = c%rows
    report%fewest_rows = c%fewest_rows
    report%first_min = c%first_min
    report%first_mean = c%first_mean
    report%first_max = c%first_max
    report%growth_min = c%growth_min
    report%growth_mean = c%growth_mean
    report%growth_max = c%growth_max
  end subroutine carreau_session_layers

  subroutine carreau_session_background(session, report, status)
    type(carreau_session), intent(in) :: session
    type(carreau_background_report), intent(out) :: report
    integer(c_int32_t), intent(out) :: status
    type(c_background_report) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    status = c_session_background(session%handle, c)
    if (status /= CARREAU_OK) return
    report%asked = c%asked
    report%outside = c%outside
    report%farthest = c%farthest
    report%estimated_error = c%estimated_error
    report%tolerance = c%tolerance
  end subroutine carreau_session_background

  ! ---- Adaptation ----

  pure function c_estimator_of(estimator) result(c)
    type(carreau_estimator), intent(in) :: estimator
    type(c_estimator) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    c%source = estimator%source
    c%shape = estimator%shape
    c%relative = merge(1_c_int32_t, 0_c_int32_t, estimator%relative)
    c%tolerance = estimator%tolerance
    c%relative_floor = estimator%relative_floor
    c%hmin = estimator%hmin
    c%hmax = estimator%hmax
    c%ratio = estimator%ratio
    c%recovery = estimator%recovery
  end function c_estimator_of

  !> values(n) at the vertices of the session's mesh; sizes(n) and metrics(6, n) xx xy xz yy yz zz.
  subroutine carreau_estimate(session, estimator, values, sizes, metrics, status)
    type(carreau_session), intent(in) :: session
    type(carreau_estimator), intent(in) :: estimator
    real(c_double), intent(in) :: values(:)
    real(c_double), allocatable, intent(out) :: sizes(:), metrics(:, :)
    integer(c_int32_t), intent(out) :: status
    real(c_double), allocatable :: h(:), m(:, :)
    allocate (h(size(values)), m(6, size(values)))
    status = c_estimate(session%handle, c_estimator_of(estimator), size(values, kind=c_int64_t), values, h, m)
    if (status /= CARREAU_OK) return
    sizes = h
    metrics = m
  end subroutine carreau_estimate

  !> values(components, n) at the vertices of the previous mesh, transferred(components, n) at the vertices of the
  !> current mesh.
  !> Elements of second order have them at all nodes, corners first; values at corners alone are carried to corners,
  !> and other nodes have NaN.
  subroutine carreau_transfer(session, values, transferred, outside, status)
    type(carreau_session), intent(in) :: session
    real(c_double), intent(in) :: values(:, :)
    real(c_double), allocatable, intent(out) :: transferred(:, :)
    integer(c_int64_t), intent(out) :: outside
    integer(c_int32_t), intent(out) :: status
    real(c_double), allocatable :: found(:, :)
    type(carreau_mesh) :: mesh
    integer(c_int64_t) :: vertices, triangles, edges, faces
    outside = 0
    call carreau_session_mesh(session, mesh, status)
    if (status /= CARREAU_OK) return
    call carreau_mesh_count(mesh, vertices, triangles, edges, faces, status)
    if (status /= CARREAU_OK) return
    allocate (found(size(values, 1), vertices))
    found = ieee_value(0.0_c_double, ieee_quiet_nan)
    status = c_transfer(session%handle, int(size(values, 1), c_int32_t), size(values, 2, c_int64_t), &
      reshape(values, [size(values)]), vertices, found, outside)
    if (status == CARREAU_OK) transferred = found
  end subroutine carreau_transfer

  !> differences: derivatives of the field itself; iterations: 5; convergence: 0, makes all of them.
  subroutine carreau_adapt(session, estimator, field, report, status, user, iterations, differences, convergence)
    type(carreau_session), intent(in) :: session
    type(carreau_estimator), intent(in) :: estimator
    procedure(carreau_field_fn) :: field
    type(carreau_adaptation_report), intent(out) :: report
    integer(c_int32_t), intent(out) :: status
    type(c_ptr), intent(in), optional :: user
    integer(c_int32_t), intent(in), optional :: iterations
    logical, intent(in), optional :: differences
    real(c_double), intent(in), optional :: convergence
    type(c_estimator), target :: e
    type(c_adaptation) :: a
    type(c_adaptation_report) :: c
    e = c_estimator_of(estimator)
    a%struct_size = size(transfer(a, [c_null_char]))
    a%estimator = c_loc(e)
    a%field = c_funloc(field)
    if (present(user)) a%user = user
    if (present(iterations)) a%iterations = iterations
    if (present(differences)) a%differences = merge(1_c_int32_t, 0_c_int32_t, differences)
    if (present(convergence)) a%convergence = convergence
    c%struct_size = size(transfer(c, [c_null_char]))
    status = c_adapt(session%handle, a, c)
    if (status /= CARREAU_OK .and. status /= CARREAU_ERR_PARTIAL) return
    report = carreau_adaptation_report(c%iterations, c%converged /= 0, c%vertices, c%triangles, c%triangles_before, &
      c%error_max, c%error_rms, c%error_max_before, c%error_rms_before, c%size_min, c%stretch_max, c%outside, &
      c%best, c%within /= 0, c%tolerance, c%estimated_error)
  end subroutine carreau_adapt
end module carreau
