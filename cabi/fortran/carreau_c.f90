! SPDX-License-Identifier: BSD-3-Clause
!> The functions and structs of carreau.h as Fortran sees them. Private to module carreau.
!! Written by generate.py from carreau.h: do not edit. After a change of the header:
!!   python3 cabi/fortran/generate.py cabi/include/carreau.h cabi/fortran/carreau_c.f90
module carreau_c
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int32_t, c_int64_t, c_null_funptr, c_null_ptr, &
    c_ptr, c_size_t
  implicit none
  public

  !> The place of the last error.
  type, bind(c) :: c_error_place
    integer(c_size_t) :: struct_size = 0
    integer(c_int32_t) :: face = 0, ic = 0, curve = 0, point = 0, line = 0, reserved = 0
    real(c_double) :: uv(2) = 0, t = 0
  end type c_error_place

  !> The routines of RT-0232 sec. 3.1, under their names and with their arguments, each by reference.
  type, bind(c) :: c_cad_m
    integer(c_size_t) :: struct_size = 0
    type(c_funptr) :: cad_init = c_null_funptr, surf0 = c_null_funptr, surf1 = c_null_funptr, surf2 = c_null_funptr, &
      curv_int = c_null_funptr, curv0 = c_null_funptr, curv1 = c_null_funptr, curv2 = c_null_funptr, &
      cad_hphys = c_null_funptr, cad_hphyc = c_null_funptr, cad_hphyp = c_null_funptr, cad_rads = c_null_funptr, &
      cad_radc = c_null_funptr
  end type c_cad_m

  !> The callbacks of a geometry.
  type, bind(c) :: c_cad
    integer(c_size_t) :: struct_size = 0
    type(c_ptr) :: user = c_null_ptr
    integer(c_int32_t) :: surface_order = 0, curve_order = 0, reentrant = 0, reserved = 0
    type(c_funptr) :: surface = c_null_funptr, surface_batch = c_null_funptr, curve_interval = c_null_funptr, &
      curve = c_null_funptr, surface_size = c_null_funptr, curve_size = c_null_funptr, point_size = c_null_funptr, &
      surface_radius = c_null_funptr, curve_radius = c_null_funptr, failure = c_null_funptr, release = c_null_funptr
  end type c_cad

  !> Callbacks that prescribe metrics, beside the callbacks of a geometry.
  type, bind(c) :: c_metric_callbacks
    integer(c_size_t) :: struct_size = 0
    type(c_ptr) :: user = c_null_ptr
    type(c_funptr) :: surface_metric = c_null_funptr, curve_metric = c_null_funptr, point_metric = c_null_funptr, &
      surface_metric_batch = c_null_funptr
  end type c_metric_callbacks

  !> The properties of a parameter that do not depend on its value.
  type, bind(c) :: c_parameter
    integer(c_size_t) :: struct_size = 0
    type(c_ptr) :: name = c_null_ptr, help = c_null_ptr, default_text = c_null_ptr, choices = c_null_ptr
    real(c_double) :: minimum = 0, maximum = 0, default_number = 0
    integer(c_int32_t) :: type = 0, diag_relative = 0
    type(c_ptr) :: set_by = c_null_ptr
  end type c_parameter

  !> The place of a rank among the others, and how it talks to them.
  type, bind(c) :: c_team
    integer(c_size_t) :: struct_size = 0
    type(c_ptr) :: user = c_null_ptr
    integer(c_int32_t) :: rank = 0, size = 0, any_thread = 0, reserved = 0
    type(c_funptr) :: take = c_null_funptr, exchange = c_null_funptr, release = c_null_funptr
  end type c_team

  !> Counts and times of the last successful run.
  type, bind(c) :: c_report
    integer(c_size_t) :: struct_size = 0
    real(c_double) :: diag = 0
    integer(c_int64_t) :: surf0_calls = 0, surf1_calls = 0, surf2_calls = 0, curv0_calls = 0, curv1_calls = 0, &
      curv2_calls = 0, size_calls = 0
    real(c_double) :: seconds_curves = 0, seconds_sampling = 0, seconds_plane = 0, seconds_lift = 0, seconds_total = 0
  end type c_report

  !> A curve of space and its places, the curves of faces that it is.
  type, bind(c) :: c_interface
    integer(c_size_t) :: struct_size = 0
    integer(c_int32_t) :: curve = 0, uses = 0, face = 0, ic = 0, other_face = 0, other_ic = 0, boundary = 0, &
      glued = 0, degenerate = 0, loose = 0
    real(c_double) :: gap = 0
  end type c_interface

  !> A background mesh in arrays of the caller.
  type, bind(c) :: c_background
    integer(c_size_t) :: struct_size = 0
    integer(c_int32_t) :: dimension = 0, reserved = 0
    integer(c_int64_t) :: vertex_count = 0, triangle_count = 0
    type(c_ptr) :: vertices = c_null_ptr, triangles = c_null_ptr, faces = c_null_ptr, sizes = c_null_ptr, &
      metrics = c_null_ptr
    integer(c_int64_t) :: tetrahedron_count = 0, edge_count = 0
    type(c_ptr) :: tetrahedra = c_null_ptr, edges = c_null_ptr
  end type c_background

  !> How the last mesh has used its background mesh.
  type, bind(c) :: c_background_report
    integer(c_size_t) :: struct_size = 0
    integer(c_int64_t) :: asked = 0, outside = 0
    real(c_double) :: farthest = 0, estimated_error = 0, tolerance = 0
  end type c_background_report

  !> One set of layers of the last mesh.
  type, bind(c) :: c_layers_report
    integer(c_size_t) :: struct_size = 0
    integer(c_int64_t) :: cells = 0
    integer(c_int32_t) :: rows = 0, fewest_rows = 0
    real(c_double) :: first_min = 0, first_mean = 0, first_max = 0, growth_min = 0, growth_mean = 0, growth_max = 0
  end type c_layers_report

  !> How sizes are found from a field.
  type, bind(c) :: c_estimator
    integer(c_size_t) :: struct_size = 0
    integer(c_int32_t) :: source = 0, shape = 0, relative = 0, recovery = 0
    real(c_double) :: tolerance = 0, relative_floor = 0, hmin = 0, hmax = 0, ratio = 0
  end type c_estimator

  !> A loop of adaptation.
  type, bind(c) :: c_adaptation
    integer(c_size_t) :: struct_size = 0
    type(c_ptr) :: estimator = c_null_ptr
    type(c_funptr) :: field = c_null_funptr
    type(c_ptr) :: user = c_null_ptr
    integer(c_int32_t) :: iterations = 0, differences = 0
    real(c_double) :: convergence = 0
  end type c_adaptation

  !> The outcome of a loop.
  type, bind(c) :: c_adaptation_report
    integer(c_size_t) :: struct_size = 0
    integer(c_int32_t) :: iterations = 0, converged = 0
    integer(c_int64_t) :: vertices = 0, triangles = 0, triangles_before = 0
    real(c_double) :: error_max = 0, error_rms = 0, error_max_before = 0, error_rms_before = 0, size_min = 0, &
      stretch_max = 0
    integer(c_int64_t) :: outside = 0
    integer(c_int32_t) :: best = 0, within = 0
    real(c_double) :: tolerance = 0, estimated_error = 0
  end type c_adaptation_report

  !> A mesh in arrays of the caller, to be checked, measured, written to any format. (To take sizes from it, give the
  !! arrays to carreau_set_background.) Arrays may be NULL where their comment allows it.
  type, bind(c) :: c_mesh_arrays
    integer(c_size_t) :: struct_size = 0
    integer(c_int32_t) :: dimension = 0, reserved = 0
    integer(c_int64_t) :: vertex_count = 0, triangle_count = 0, edge_count = 0
    type(c_ptr) :: vertices = c_null_ptr, triangles = c_null_ptr, edges = c_null_ptr, vertex_refs = c_null_ptr, &
      triangle_refs = c_null_ptr, edge_refs = c_null_ptr, corner_uv = c_null_ptr
  end type c_mesh_arrays

  !> Numbers of a mesh in parts.
  type, bind(c) :: c_part_counts
    integer(c_size_t) :: struct_size = 0
    integer(c_int32_t) :: rank = 0, size = 0
    integer(c_int64_t) :: own_vertices = 0, own_triangles = 0, all_vertices = 0, all_triangles = 0, all_edges = 0, &
      crossings = 0
  end type c_part_counts

  !> The quality of the elements. shape is sigma of the regular polygon over sigma = diameter / least inradius of two
  !! sides that meet (HDR sec. 1.1.1). scaled_jacobian is the least sine of an element's angles over the sine of the
  !! regular polygon's angle.
  type, bind(c) :: c_cell_quality
    integer(c_size_t) :: struct_size = 0
    integer(c_int64_t) :: triangles3 = 0, triangles6 = 0, quads4 = 0, quads8 = 0, invalid = 0
    real(c_double) :: shape_mean = 0, shape_min = 0, scaled_jacobian_mean = 0, scaled_jacobian_min = 0, &
      least_jacobian_mean = 0, least_jacobian_min = 0, angle_min = 0, angle_max = 0, area = 0, triangle_share = 0
  end type c_cell_quality

  !> The result of meshing a face.
  type, bind(c) :: c_face
    integer(c_size_t) :: struct_size = 0
    integer(c_int32_t) :: ref = 0, status = 0
    integer(c_int64_t) :: triangles = 0
    type(c_ptr) :: why = c_null_ptr, name = c_null_ptr
    integer(c_int32_t) :: rgb = 0
  end type c_face

  !> The shapes and sizes of the triangles.
  type, bind(c) :: c_quality
    integer(c_size_t) :: struct_size = 0
    integer(c_int64_t) :: vertices = 0, triangles = 0, edges = 0, open_edges = 0
    real(c_double) :: q1_mean = 0, q1_min = 0, q1_p1 = 0, q1_max = 0, q2_mean = 0, q2_min = 0, q2_p1 = 0, q2_max = 0, &
      angle_min = 0, angle_max = 0, area = 0, edge_min = 0, edge_mean = 0, edge_max = 0, degree6 = 0
  end type c_quality

  !> Which images are written, and how.
  type, bind(c) :: c_exr_options
    integer(c_size_t) :: struct_size = 0
    integer(c_int32_t) :: longest = 0, width = 0, height = 0, channels = 0, face = 0, multi_part = 0, raw = 0, &
      compression = 0, threads = 0, reserved = 0
  end type c_exr_options

  !> A polyline of the plane or of space, with metrics that are known at places of it.
  type, bind(c) :: c_curve
    integer(c_size_t) :: struct_size = 0
    integer(c_int32_t) :: dimension = 0, law = 0
    integer(c_int64_t) :: point_count = 0, metric_count = 0
    type(c_ptr) :: points = c_null_ptr, abscissae = c_null_ptr, metrics = c_null_ptr
    real(c_double) :: lss = 0
  end type c_curve

  !> Totals of a delivered mesh.
  type, bind(c) :: c_delivered
    integer(c_size_t) :: struct_size = 0
    integer(c_int64_t) :: vertices = 0, edges = 0, triangles = 0, short_edges = 0, long_edges = 0, &
      folded_triangles = 0
    real(c_double) :: in_range = 0
    integer(c_int64_t) :: not_met = 0
    type(c_ptr) :: text = c_null_ptr
    integer(c_int64_t) :: surf0_calls = 0, surf1_calls = 0, surf2_calls = 0, size_calls = 0
    real(c_double) :: seconds = 0, input_distance = 0, input_bound = 0, input_back_distance = 0, input_back_bound = 0
  end type c_delivered

  !> The spread of one measure.
  type, bind(c) :: c_measure
    integer(c_size_t) :: struct_size = 0
    type(c_ptr) :: name = c_null_ptr, title = c_null_ptr
    integer(c_int32_t) :: entity = 0, classes = 0
    integer(c_int64_t) :: values = 0, count = 0
    real(c_double) :: mean = 0, min = 0, p1 = 0, p99 = 0, max = 0, limit = 0
    integer(c_int64_t) :: beyond = 0, forced = 0
  end type c_measure

  interface
    !> Return "CARREAU_ERR_FILE" and the meaning above, or "CARREAU_UNKNOWN_STATUS" and "unknown status".
    function c_status_name(status) result(name) bind(c, name="carreau_status_name")
      import :: c_int32_t, c_ptr
      implicit none
      integer(c_int32_t), value :: status
      type(c_ptr) :: name
    end function c_status_name

    function c_status_meaning(status) result(meaning) bind(c, name="carreau_status_meaning")
      import :: c_int32_t, c_ptr
      implicit none
      integer(c_int32_t), value :: status
      type(c_ptr) :: meaning
    end function c_status_meaning

    !> Return the version of the library that runs: "0.1.0" (static), and major * 10000 + minor * 100 + patch.
    function c_version() result(version) bind(c, name="carreau_version")
      import :: c_ptr
      implicit none
      type(c_ptr) :: version
    end function c_version

    function c_version_number() result(number) bind(c, name="carreau_version_number")
      import :: c_int32_t
      implicit none
      integer(c_int32_t) :: number
    end function c_version_number

    !> Creates a session with default parameters, and without geometry or model.
    function c_session_create(session) result(status) bind(c, name="carreau_session_create")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), intent(inout) :: session
      integer(c_int32_t) :: status
    end function c_session_create

    !> Frees a session and its mesh.
    subroutine c_session_free(session) bind(c, name="carreau_session_free")
      import :: c_ptr
      implicit none
      type(c_ptr), value :: session
    end subroutine c_session_free

    !> Returns the sentence of the last call on the session: which routine, which face, curve, (u, v) or t, which file
    !! and line.
    function c_last_error(session) result(error) bind(c, name="carreau_last_error")
      import :: c_ptr
      implicit none
      type(c_ptr), value :: session
      type(c_ptr) :: error
    end function c_last_error

    !> Fills *out_place.
    function c_last_error_place(session, place) result(status) bind(c, name="carreau_last_error_place")
      import :: c_error_place, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      type(c_error_place), intent(inout) :: place
      integer(c_int32_t) :: status
    end function c_last_error_place

    !> For libraries that work on a session of their caller: marks the last call as failed with this status and
    !! sentence.
    function c_set_error(session, error, sentence) result(status) bind(c, name="carreau_set_error")
      import :: c_char, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: error
      character(kind=c_char), intent(in) :: sentence(*)
      integer(c_int32_t) :: status
    end function c_set_error

    !> Registers the routines in place of earlier ones of this call or of carreau_set_cad, and calls cad_init.
    function c_set_cad_m(session, routines) result(status) bind(c, name="carreau_set_cad_m")
      import :: c_cad_m, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      type(c_cad_m), intent(in) :: routines
      integer(c_int32_t) :: status
    end function c_set_cad_m

    !> Registers the callbacks in place of earlier ones of this call or of carreau_set_cad_m; geometries that were added
    !! (carreau_geometry.h) stay.
    function c_set_cad(session, callbacks) result(status) bind(c, name="carreau_set_cad")
      import :: c_cad, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      type(c_cad), intent(in) :: callbacks
      integer(c_int32_t) :: status
    end function c_set_cad

    !> Registers metric callbacks beside a geometry of either kind.
    function c_set_metric_callbacks(session, callbacks) result(status) bind(c, name="carreau_set_metric_callbacks")
      import :: c_int32_t, c_metric_callbacks, c_ptr
      implicit none
      type(c_ptr), value :: session
      type(c_metric_callbacks), intent(in) :: callbacks
      integer(c_int32_t) :: status
    end function c_set_metric_callbacks

    !> Drops all faces, and all geometries that were added (carreau_geometry.h).
    function c_model_clear(session) result(status) bind(c, name="carreau_model_clear")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t) :: status
    end function c_model_clear

    !> Appends a face.
    function c_model_add_face(session, ref, orientation) result(status) bind(c, name="carreau_model_add_face")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: ref, orientation
      integer(c_int32_t) :: status
    end function c_model_add_face

    !> Leaves a face out of the mesh, for the reason `why`; NULL or "" takes it in again.
    function c_model_leave_out_face(session, face_ref, why) result(status) bind(c, name="carreau_model_leave_out_face")
      import :: c_char, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: face_ref
      character(kind=c_char), intent(in) :: why(*)
      integer(c_int32_t) :: status
    end function c_model_leave_out_face

    !> Appends a curve to face `face_ref`, as number ic = 1, 2, ... of that face.
    function c_model_add_curve(session, face_ref, type, ref, end1, end2) result(status) &
        bind(c, name="carreau_model_add_curve")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: face_ref, type, ref, end1, end2
      integer(c_int32_t) :: status
    end function c_model_add_curve

    !> Prescribes the edges of curve number ic of a face, and so of all curves that are one with it in space, whatever
    !! the prescribed sizes: `edges` arcs, whose lengths along the curve in space follow one another in the direction of
    !! its parameter t.
    function c_model_divide_curve(session, face_ref, ic, edges, progression, ratio) result(status) &
        bind(c, name="carreau_model_divide_curve")
      import :: c_double, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: face_ref, ic, edges, progression
      real(c_double), value :: ratio
      integer(c_int32_t) :: status
    end function c_model_divide_curve

    !> Prescribes all vertices inside a curve by their parameters, strictly increasing, inside of its interval: n = 0
    !! makes it one edge.
    function c_model_divide_curve_at(session, face_ref, ic, n, t) result(status) &
        bind(c, name="carreau_model_divide_curve_at")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: face_ref, ic
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: t(*)
      integer(c_int32_t) :: status
    end function c_model_divide_curve_at

    !> Imposes a vertex with reference `ref` at (u, v) inside face `face_ref`.
    function c_model_add_point(session, face_ref, ref, u, v) result(status) bind(c, name="carreau_model_add_point")
      import :: c_double, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: face_ref, ref
      real(c_double), value :: u, v
      integer(c_int32_t) :: status
    end function c_model_add_point

    !> Names a face, for people and for files that hold names (.vtu, .msh, .stl).
    function c_model_name_face(session, face_ref, name) result(status) bind(c, name="carreau_model_name_face")
      import :: c_char, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: face_ref
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int32_t) :: status
    end function c_model_name_face

    !> Names n entities of one dimension by their references: points (dimension 0), curves (1), faces (2) or solids (3).
    function c_model_name_entities(session, dimension, n, refs, name) result(status) &
        bind(c, name="carreau_model_name_entities")
      import :: c_char, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: dimension
      integer(c_int64_t), value :: n
      integer(c_int32_t), intent(in) :: refs(*)
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int32_t) :: status
    end function c_model_name_entities

    !> Sets the solids on both sides of a face, by references of the host from 1: the solid that its triangles look out
    !! of, and the solid that they look into; 0: none.
    function c_model_set_face_sides(session, face_ref, solid, other_solid) result(status) &
        bind(c, name="carreau_model_set_face_sides")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: face_ref, solid, other_solid
      integer(c_int32_t) :: status
    end function c_model_set_face_sides

    !> Colours a face, for files that hold colours (.vtu). rgb is 0xRRGGBB in sRGB; -1, the default, takes the colour
    !! away.
    function c_model_color_face(session, face_ref, rgb) result(status) bind(c, name="carreau_model_color_face")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: face_ref, rgb
      integer(c_int32_t) :: status
    end function c_model_color_face

    !> Makes a face a part of another face.
    function c_model_part_of_face(session, face_ref, whole_ref) result(status) &
        bind(c, name="carreau_model_part_of_face")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: face_ref, whole_ref
      integer(c_int32_t) :: status
    end function c_model_part_of_face

    !> Makes the existing curves of a reference parts of another curve.
    function c_model_part_of_curve(session, ref, whole_ref) result(status) bind(c, name="carreau_model_part_of_curve")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: ref, whole_ref
      integer(c_int32_t) :: status
    end function c_model_part_of_curve

    !> Makes faces periodic: the mesh of slave_faces[i] is the image of the mesh of master_faces[i] (references, from 1)
    !! under the map x -> R x + d.
    function c_model_add_periodicity(session, slave_faces, master_faces, n, transform) result(status) &
        bind(c, name="carreau_model_add_periodicity")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), intent(in) :: slave_faces(*), master_faces(*)
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: transform(*)
      integer(c_int32_t) :: status
    end function c_model_add_periodicity

    !> Makes all faces periodic that the translation along `direction` (3 numbers, any length but 0) by the model's
    !! extent along it carries onto other faces.
    function c_model_add_period(session, direction) result(status) bind(c, name="carreau_model_add_period")
      import :: c_double, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      real(c_double), intent(in) :: direction(*)
      integer(c_int32_t) :: status
    end function c_model_add_period

    !> Replaces the model by the content of a file x.pardom.
    function c_model_read_pardom(session, path) result(status) bind(c, name="carreau_model_read_pardom")
      import :: c_char, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t) :: status
    end function c_model_read_pardom

    !> Writes the model in the layout of x.pardom.
    function c_model_write_pardom(session, path) result(status) bind(c, name="carreau_model_write_pardom")
      import :: c_char, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t) :: status
    end function c_model_write_pardom

    !> Checks the model against the rules that need no geometry, as carreau_mesh_generate does.
    function c_model_check(session) result(status) bind(c, name="carreau_model_check")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t) :: status
    end function c_model_check

    !> Counts faces, curves (of all faces together) and imposed points.
    function c_model_count(session, faces, curves, points) result(status) bind(c, name="carreau_model_count")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int64_t), intent(inout) :: faces, curves, points
      integer(c_int32_t) :: status
    end function c_model_count

    !> Read the model back.
    function c_model_faces(session, capacity, refs, orientations) result(status) bind(c, name="carreau_model_faces")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int64_t), value :: capacity
      integer(c_int32_t), intent(inout) :: refs(*), orientations(*)
      integer(c_int32_t) :: status
    end function c_model_faces

    !> out_ends is n x 2.
    function c_model_curves(session, capacity, face_refs, types, refs, ends) result(status) &
        bind(c, name="carreau_model_curves")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int64_t), value :: capacity
      integer(c_int32_t), intent(inout) :: face_refs(*), types(*), refs(*), ends(*)
      integer(c_int32_t) :: status
    end function c_model_curves

    !> out_uv is n x 2.
    function c_model_points(session, capacity, face_refs, refs, uv) result(status) bind(c, name="carreau_model_points")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int64_t), value :: capacity
      integer(c_int32_t), intent(inout) :: face_refs(*), refs(*)
      real(c_double), intent(inout) :: uv(*)
      integer(c_int32_t) :: status
    end function c_model_points

    !> Give the number of parameters, and parameter `index` (from 0) in alphabetical order.
    function c_parameter_count() result(count) bind(c, name="carreau_parameter_count")
      import :: c_int32_t
      implicit none
      integer(c_int32_t) :: count
    end function c_parameter_count

    function c_parameter_info(index, parameter) result(status) bind(c, name="carreau_parameter_info")
      import :: c_int32_t, c_parameter
      implicit none
      integer(c_int32_t), value :: index
      type(c_parameter), intent(inout) :: parameter
      integer(c_int32_t) :: status
    end function c_parameter_info

    !> Set a parameter for the runs to come.
    function c_set_integer(session, name, value) result(status) bind(c, name="carreau_set_integer")
      import :: c_char, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int32_t), value :: value
      integer(c_int32_t) :: status
    end function c_set_integer

    function c_set_real(session, name, value) result(status) bind(c, name="carreau_set_real")
      import :: c_char, c_double, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      character(kind=c_char), intent(in) :: name(*)
      real(c_double), value :: value
      integer(c_int32_t) :: status
    end function c_set_real

    function c_set_text(session, name, value) result(status) bind(c, name="carreau_set_text")
      import :: c_char, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      character(kind=c_char), intent(in) :: name(*), value(*)
      integer(c_int32_t) :: status
    end function c_set_text

    !> Sets a parameter from a word, as blsurf.env would ("hphydef", "1.5d-1").
    function c_set_word(session, name, word) result(status) bind(c, name="carreau_set_word")
      import :: c_char, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      character(kind=c_char), intent(in) :: name(*), word(*)
      integer(c_int32_t) :: status
    end function c_set_word

    !> Sets the parameters that a blsurf.env has before its first action.
    function c_read_env(session, path) result(status) bind(c, name="carreau_read_env")
      import :: c_char, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t) :: status
    end function c_read_env

    !> Get the value that is set, or the default.
    function c_get_integer(session, name, value) result(status) bind(c, name="carreau_get_integer")
      import :: c_char, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int32_t), intent(inout) :: value
      integer(c_int32_t) :: status
    end function c_get_integer

    function c_get_real(session, name, value) result(status) bind(c, name="carreau_get_real")
      import :: c_char, c_double, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      character(kind=c_char), intent(in) :: name(*)
      real(c_double), intent(inout) :: value
      integer(c_int32_t) :: status
    end function c_get_real

    !> Gets a text, which lives until the next call on the session.
    function c_get_text(session, name, value) result(status) bind(c, name="carreau_get_text")
      import :: c_char, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      character(kind=c_char), intent(in) :: name(*)
      type(c_ptr), intent(inout) :: value
      integer(c_int32_t) :: status
    end function c_get_text

    !> Set one parameter, or all, back to the default.
    function c_reset_parameter(session, name) result(status) bind(c, name="carreau_reset_parameter")
      import :: c_char, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int32_t) :: status
    end function c_reset_parameter

    function c_reset_parameters(session) result(status) bind(c, name="carreau_reset_parameters")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t) :: status
    end function c_reset_parameters

    !> Register a callback.
    function c_set_message_callback(session, callback, user) result(status) bind(c, name="carreau_set_message_callback")
      import :: c_funptr, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      type(c_funptr), value :: callback
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function c_set_message_callback

    function c_set_progress_callback(session, callback, user) result(status) &
        bind(c, name="carreau_set_progress_callback")
      import :: c_funptr, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      type(c_funptr), value :: callback
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function c_set_progress_callback

    !> Requests the run under way to stop.
    subroutine c_stop(session) bind(c, name="carreau_stop")
      import :: c_ptr
      implicit none
      type(c_ptr), value :: session
    end subroutine c_stop

    !> Makes the session part of a team, in place of an earlier one; NULL: it is alone, as at the start.
    function c_set_team(session, team) result(status) bind(c, name="carreau_set_team")
      import :: c_int32_t, c_ptr, c_team
      implicit none
      type(c_ptr), value :: session
      type(c_team), intent(in) :: team
      integer(c_int32_t) :: status
    end function c_set_team

    !> Makes the mesh of the model ("call inimesh").
    function c_mesh_generate(session) result(status) bind(c, name="carreau_mesh_generate")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t) :: status
    end function c_mesh_generate

    !> Runs all actions of a blsurf.env up to `call exit` (RT-0232 sec. 3.3). `call inimesh` reads <pref>.pardom beside
    !! the env file, unless the session has a model already, from carreau_model_add_face and its like or from
    !! carreau_model_read_pardom. `call export` writes beside it.
    function c_run_env(session, path) result(status) bind(c, name="carreau_run_env")
      import :: c_char, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t) :: status
    end function c_run_env

    !> Gives the report of that run.
    function c_session_report(session, report) result(status) bind(c, name="carreau_session_report")
      import :: c_int32_t, c_ptr, c_report
      implicit none
      type(c_ptr), value :: session
      type(c_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function c_session_report

    !> Give the number of interfaces, and interface `index`, from 0, by first appearance.
    function c_session_interface_count(session, count) result(status) bind(c, name="carreau_session_interface_count")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function c_session_interface_count

    function c_session_interface(session, index, interface) result(status) bind(c, name="carreau_session_interface")
      import :: c_int32_t, c_int64_t, c_interface, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int64_t), value :: index
      type(c_interface), intent(inout) :: interface
      integer(c_int32_t) :: status
    end function c_session_interface

    !> Reads files: .mesh or .meshb (.vtu and .msh, too), and .sol or .solb with a scalar (size) or a symmetric tensor
    !! (metric) at each vertex.
    function c_set_background_mesh(session, mesh_path, sol_path) result(status) &
        bind(c, name="carreau_set_background_mesh")
      import :: c_char, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      character(kind=c_char), intent(in) :: mesh_path(*), sol_path(*)
      integer(c_int32_t) :: status
    end function c_set_background_mesh

    !> Takes arrays in place of files.
    function c_set_background(session, background) result(status) bind(c, name="carreau_set_background")
      import :: c_background, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      type(c_background), intent(in) :: background
      integer(c_int32_t) :: status
    end function c_set_background

    !> Set n sizes, or n metrics (n x 6), at the n vertices of the session's own mesh; of elements of second order at
    !! all nodes, or at their corners, which come first.
    function c_set_vertex_sizes(session, n, sizes) result(status) bind(c, name="carreau_set_vertex_sizes")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: sizes(*)
      integer(c_int32_t) :: status
    end function c_set_vertex_sizes

    function c_set_vertex_metrics(session, n, metrics) result(status) bind(c, name="carreau_set_vertex_metrics")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: metrics(*)
      integer(c_int32_t) :: status
    end function c_set_vertex_metrics

    !> Removes the background mesh.
    function c_clear_background(session) result(status) bind(c, name="carreau_clear_background")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t) :: status
    end function c_clear_background

    !> Reads sizes or metrics at the n vertices of a mesh from a .sol, .solb or BL2D's .h as metrics of space (n x 6, xx
    !! xy xz yy yz zz; of dimension 2 with the smaller size across).
    function c_mesh_read_metrics(mesh, sol_path, capacity, metrics) result(status) &
        bind(c, name="carreau_mesh_read_metrics")
      import :: c_char, c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      character(kind=c_char), intent(in) :: sol_path(*)
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout) :: metrics(*)
      integer(c_int32_t) :: status
    end function c_mesh_read_metrics

    !> Gives the report on the background of the last mesh.
    function c_session_background(session, report) result(status) bind(c, name="carreau_session_background")
      import :: c_background_report, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      type(c_background_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function c_session_background

    !> Adds small sizes near things of space to the next meshes, unless hphy_flag = 0: `size` on the elements, and a
    !! size that grows linearly with the distance to `surrounding` at the distance `reach`.
    function c_add_attractor(session, vertex_count, vertices, element_count, elements, size, surrounding, &
      reach) result(status) bind(c, name="carreau_add_attractor")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int64_t), value :: vertex_count
      real(c_double), intent(in) :: vertices(*)
      integer(c_int64_t), value :: element_count
      integer(c_int32_t), intent(in) :: elements(*)
      real(c_double), value :: size, surrounding, reach
      integer(c_int32_t) :: status
    end function c_add_attractor

    !> Removes all attractors.
    function c_clear_attractors(session) result(status) bind(c, name="carreau_clear_attractors")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t) :: status
    end function c_clear_attractors

    !> Lets rows of cells grow from curves into their faces in the next meshes: the first row is `first` high (model
    !! length), each other row `ratio` (1 to 10) times as high as the row below.
    function c_add_layers(session, curve_count, curves, first, ratio, count) result(status) &
        bind(c, name="carreau_add_layers")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int64_t), value :: curve_count
      integer(c_int32_t), intent(in) :: curves(*)
      real(c_double), value :: first, ratio
      integer(c_int32_t), value :: count
      integer(c_int32_t) :: status
    end function c_add_layers

    !> Removes all layers.
    function c_clear_layers(session) result(status) bind(c, name="carreau_clear_layers")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t) :: status
    end function c_clear_layers

    !> Gives the report on the set `index`, from 0 in the order of carreau_add_layers.
    function c_session_layers(session, index, report) result(status) bind(c, name="carreau_session_layers")
      import :: c_int32_t, c_int64_t, c_layers_report, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int64_t), value :: index
      type(c_layers_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function c_session_layers

    !> Finds sizes or metrics at the n vertices of the session's mesh from the values of a field there.
    function c_estimate(session, estimator, n, values, sizes, metrics) result(status) bind(c, name="carreau_estimate")
      import :: c_double, c_estimator, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      type(c_estimator), intent(in) :: estimator
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: values(*)
      real(c_double), intent(inout) :: sizes(*), metrics(*)
      integer(c_int32_t) :: status
    end function c_estimate

    !> Interpolates a field from the n vertices of the session's previous mesh to the vertices of its current mesh.
    !! `values` has `components` values a vertex (n x components), and out_values has room for `capacity` such rows.
    function c_transfer(session, components, n, values, capacity, out_values, outside) result(status) &
        bind(c, name="carreau_transfer")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: components
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: values(*)
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout) :: out_values(*)
      integer(c_int64_t), intent(inout) :: outside
      integer(c_int32_t) :: status
    end function c_transfer

    !> The loop by files: fields at the vertices of the last mesh, the next mesh, the fields on it. `carreau adapt` is
    !! made of these two.
    function c_set_background_fields(session, mesh_path, sol_path) result(status) &
        bind(c, name="carreau_set_background_fields")
      import :: c_char, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      character(kind=c_char), intent(in) :: mesh_path(*), sol_path(*)
      integer(c_int32_t) :: status
    end function c_set_background_fields

    function c_transfer_files(session, mesh_path, sol_path, path, outside) result(status) &
        bind(c, name="carreau_transfer_files")
      import :: c_char, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      character(kind=c_char), intent(in) :: mesh_path(*), sol_path(*), path(*)
      integer(c_int64_t), intent(inout) :: outside
      integer(c_int32_t) :: status
    end function c_transfer_files

    !> Adapts the mesh in a loop: it estimates, sets new sizes on the mesh, and meshes again.
    function c_adapt(session, adaptation, report) result(status) bind(c, name="carreau_adapt")
      import :: c_adaptation, c_adaptation_report, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      type(c_adaptation), intent(in) :: adaptation
      type(c_adaptation_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function c_adapt

    !> Gives the mesh of a session.
    function c_session_mesh(session, mesh) result(status) bind(c, name="carreau_session_mesh")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      type(c_ptr), intent(inout) :: mesh
      integer(c_int32_t) :: status
    end function c_session_mesh

    !> Creates an empty mesh.
    function c_mesh_create(mesh) result(status) bind(c, name="carreau_mesh_create")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), intent(inout) :: mesh
      integer(c_int32_t) :: status
    end function c_mesh_create

    subroutine c_mesh_free(mesh) bind(c, name="carreau_mesh_free")
      import :: c_ptr
      implicit none
      type(c_ptr), value :: mesh
    end subroutine c_mesh_free

    !> Returns the sentence of the last call on the mesh, "" after success.
    function c_mesh_last_error(mesh) result(error) bind(c, name="carreau_mesh_last_error")
      import :: c_ptr
      implicit none
      type(c_ptr), value :: mesh
      type(c_ptr) :: error
    end function c_mesh_last_error

    !> Replaces the content by the content of a file.
    function c_mesh_read(mesh, path) result(status) bind(c, name="carreau_mesh_read")
      import :: c_char, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t) :: status
    end function c_mesh_read

    !> Replaces the content of a mesh that carreau_mesh_create has made by a copy of arrays.
    function c_mesh_from_arrays(mesh, arrays) result(status) bind(c, name="carreau_mesh_from_arrays")
      import :: c_int32_t, c_mesh_arrays, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      type(c_mesh_arrays), intent(in) :: arrays
      integer(c_int32_t) :: status
    end function c_mesh_from_arrays

    !> Writes the mesh to a file.
    function c_mesh_write(mesh, path) result(status) bind(c, name="carreau_mesh_write")
      import :: c_char, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t) :: status
    end function c_mesh_write

    !> Gives the bytes that carreau_mesh_write would write to a file with this suffix (".meshb"), in ascending
    !! positions, to `sink`: for files that the host writes itself.
    function c_mesh_encode(mesh, suffix, sink, user) result(status) bind(c, name="carreau_mesh_encode")
      import :: c_char, c_funptr, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      character(kind=c_char), intent(in) :: suffix(*)
      type(c_funptr), value :: sink
      type(c_ptr), value :: user
      integer(c_int32_t) :: status
    end function c_mesh_encode

    !> Runs carreau_mesh_generate by the processes of the session's team (carreau_set_team), each of which keeps its
    !! part.
    function c_mesh_generate_part(session, part) result(status) bind(c, name="carreau_mesh_generate_part")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session, part
      integer(c_int32_t) :: status
    end function c_mesh_generate_part

    !> Gives the counts of a part.
    function c_mesh_part_count(part, counts) result(status) bind(c, name="carreau_mesh_part_count")
      import :: c_int32_t, c_part_counts, c_ptr
      implicit none
      type(c_ptr), value :: part
      type(c_part_counts), intent(inout) :: counts
      integer(c_int32_t) :: status
    end function c_mesh_part_count

    !> Copy results into arrays with room for `capacity` rows, one for each vertex or triangle of the part
    !! (carreau_mesh_count).
    function c_mesh_part_vertices(part, capacity, numbers, owners, rows) result(status) &
        bind(c, name="carreau_mesh_part_vertices")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: part
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(inout) :: numbers(*)
      integer(c_int32_t), intent(inout) :: owners(*)
      integer(c_int64_t), intent(inout) :: rows(*)
      integer(c_int32_t) :: status
    end function c_mesh_part_vertices

    function c_mesh_part_triangles(part, capacity, numbers, owners) result(status) &
        bind(c, name="carreau_mesh_part_triangles")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: part
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(inout) :: numbers(*)
      integer(c_int32_t), intent(inout) :: owners(*)
      integer(c_int32_t) :: status
    end function c_mesh_part_triangles

    !> Counts vertices (n), triangles (m), edges of curves (k), and faces (f).
    function c_mesh_count(mesh, vertices, triangles, edges, faces) result(status) bind(c, name="carreau_mesh_count")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), intent(inout) :: vertices, triangles, edges, faces
      integer(c_int32_t) :: status
    end function c_mesh_count

    !> Gives the order of the elements: 1, 2, or, of a file, 3 or 4. carreau_mesh_write keeps orders 3 and 4 in the
    !! formats that have them; other formats are errors.
    function c_mesh_order(mesh, order) result(status) bind(c, name="carreau_mesh_order")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int32_t), intent(inout) :: order
      integer(c_int32_t) :: status
    end function c_mesh_order

    !> Gives the dimension: 3, or 2 when the mesh was read from a plane mesh.
    function c_mesh_dimension(mesh, dimension) result(status) bind(c, name="carreau_mesh_dimension")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int32_t), intent(inout) :: dimension
      integer(c_int32_t) :: status
    end function c_mesh_dimension

    !> Copy results into arrays of the caller, which have room for `capacity` rows (n, m or k).
    function c_mesh_vertices(mesh, capacity, xyz) result(status) bind(c, name="carreau_mesh_vertices")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout) :: xyz(*)
      integer(c_int32_t) :: status
    end function c_mesh_vertices

    function c_mesh_vertex_refs(mesh, capacity, refs) result(status) bind(c, name="carreau_mesh_vertex_refs")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: capacity
      integer(c_int32_t), intent(inout) :: refs(*)
      integer(c_int32_t) :: status
    end function c_mesh_vertex_refs

    function c_mesh_vertex_sizes(mesh, capacity, sizes) result(status) bind(c, name="carreau_mesh_vertex_sizes")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout) :: sizes(*)
      integer(c_int32_t) :: status
    end function c_mesh_vertex_sizes

    function c_mesh_triangles(mesh, capacity, vertices) result(status) bind(c, name="carreau_mesh_triangles")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: capacity
      integer(c_int32_t), intent(inout) :: vertices(*)
      integer(c_int32_t) :: status
    end function c_mesh_triangles

    function c_mesh_triangle_refs(mesh, capacity, refs) result(status) bind(c, name="carreau_mesh_triangle_refs")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: capacity
      integer(c_int32_t), intent(inout) :: refs(*)
      integer(c_int32_t) :: status
    end function c_mesh_triangle_refs

    function c_mesh_corner_uv(mesh, capacity, uv) result(status) bind(c, name="carreau_mesh_corner_uv")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout) :: uv(*)
      integer(c_int32_t) :: status
    end function c_mesh_corner_uv

    function c_mesh_corner_faces(mesh, capacity, refs) result(status) bind(c, name="carreau_mesh_corner_faces")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: capacity
      integer(c_int32_t), intent(inout) :: refs(*)
      integer(c_int32_t) :: status
    end function c_mesh_corner_faces

    function c_mesh_edges(mesh, capacity, vertices) result(status) bind(c, name="carreau_mesh_edges")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: capacity
      integer(c_int32_t), intent(inout) :: vertices(*)
      integer(c_int32_t) :: status
    end function c_mesh_edges

    function c_mesh_edge_refs(mesh, capacity, refs) result(status) bind(c, name="carreau_mesh_edge_refs")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: capacity
      integer(c_int32_t), intent(inout) :: refs(*)
      integer(c_int32_t) :: status
    end function c_mesh_edge_refs

    !> The number of elements of a kind; it may be 0.
    function c_mesh_cell_count(mesh, kind, count) result(status) bind(c, name="carreau_mesh_cell_count")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int32_t), value :: kind
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function c_mesh_cell_count

    !> The elements of a kind, face by face: rows of their nodes (vertices from 0), and, unless NULL, the references of
    !! their faces.
    function c_mesh_cells(mesh, kind, capacity, nodes, refs) result(status) bind(c, name="carreau_mesh_cells")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int32_t), value :: kind
      integer(c_int64_t), value :: capacity
      integer(c_int32_t), intent(inout) :: nodes(*), refs(*)
      integer(c_int32_t) :: status
    end function c_mesh_cells

    !> Gives u v of each node of each element of a kind in its face, in the order of the elements.
    function c_mesh_cell_uv(mesh, kind, capacity, uv) result(status) bind(c, name="carreau_mesh_cell_uv")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int32_t), value :: kind
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout) :: uv(*)
      integer(c_int32_t) :: status
    end function c_mesh_cell_uv

    !> For each node of each element of a kind the reference of the face that carreau_mesh_cell_uv is of, in the same
    !! order; mesh of a session only.
    function c_mesh_cell_faces(mesh, kind, capacity, refs) result(status) bind(c, name="carreau_mesh_cell_faces")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int32_t), value :: kind
      integer(c_int64_t), value :: capacity
      integer(c_int32_t), intent(inout) :: refs(*)
      integer(c_int32_t) :: status
    end function c_mesh_cell_faces

    !> For each edge of carreau_mesh_edges the node between its ends; -1: the edge is straight.
    function c_mesh_edge_mids(mesh, capacity, vertices) result(status) bind(c, name="carreau_mesh_edge_mids")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: capacity
      integer(c_int32_t), intent(inout) :: vertices(*)
      integer(c_int32_t) :: status
    end function c_mesh_edge_mids

    !> Measures the elements.
    function c_mesh_cell_quality(mesh, quality) result(status) bind(c, name="carreau_mesh_cell_quality")
      import :: c_cell_quality, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      type(c_cell_quality), intent(inout) :: quality
      integer(c_int32_t) :: status
    end function c_mesh_cell_quality

    !> Describes face `index`, from 0.
    function c_mesh_face(mesh, index, face) result(status) bind(c, name="carreau_mesh_face")
      import :: c_face, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: index
      type(c_face), intent(inout) :: face
      integer(c_int32_t) :: status
    end function c_mesh_face

    !> Counts the pairs of entities that periodicities carry onto each other, and their pairs of nodes.
    function c_mesh_periodic_count(mesh, pairs, nodes) result(status) bind(c, name="carreau_mesh_periodic_count")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), intent(inout) :: pairs, nodes
      integer(c_int32_t) :: status
    end function c_mesh_periodic_count

    !> Gets the pairs: corners first, then curves, then faces.
    function c_mesh_periodic(mesh, capacity, node_capacity, dimensions, refs, transforms, counts, &
      nodes) result(status) bind(c, name="carreau_mesh_periodic")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: capacity, node_capacity
      integer(c_int32_t), intent(inout) :: dimensions(*), refs(*)
      real(c_double), intent(inout) :: transforms(*)
      integer(c_int64_t), intent(inout) :: counts(*)
      integer(c_int32_t), intent(inout) :: nodes(*)
      integer(c_int32_t) :: status
    end function c_mesh_periodic

    !> Gets the solids on both sides of a face by its reference (carreau_model_set_face_sides); 0: none.
    function c_mesh_face_sides(mesh, face_ref, solids) result(status) bind(c, name="carreau_mesh_face_sides")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int32_t), value :: face_ref
      integer(c_int32_t), intent(inout) :: solids(*)
      integer(c_int32_t) :: status
    end function c_mesh_face_sides

    !> Returns the name that carreau_model_name_entities gave to points (dimension 0), curves (1), a face (2) or a solid
    !! (3); "": none, or no such entity.
    function c_mesh_entity_name(mesh, dimension, ref) result(name) bind(c, name="carreau_mesh_entity_name")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int32_t), value :: dimension, ref
      type(c_ptr) :: name
    end function c_mesh_entity_name

    !> Measures the triangles.
    function c_mesh_quality(mesh, quality) result(status) bind(c, name="carreau_mesh_quality")
      import :: c_int32_t, c_ptr, c_quality
      implicit none
      type(c_ptr), value :: mesh
      type(c_quality), intent(inout) :: quality
      integer(c_int32_t) :: status
    end function c_mesh_quality

    !> Gives the quality of the whole mesh to which a part belongs, as all processes have measured it together: sums are
    !! rounded otherwise than in one process.
    function c_mesh_part_quality(part, quality) result(status) bind(c, name="carreau_mesh_part_quality")
      import :: c_int32_t, c_ptr, c_quality
      implicit none
      type(c_ptr), value :: part
      type(c_quality), intent(inout) :: quality
      integer(c_int32_t) :: status
    end function c_mesh_part_quality

    !> Looks for defects that make a mesh unusable: indices out of range, numbers that are not finite, triangles without
    !! area or duplicates, vertices without a triangle, edges of more than two triangles away from curves, and curves
    !! that are not in their faces.
    function c_mesh_defects(mesh, closed, limit, count, text) result(status) bind(c, name="carreau_mesh_defects")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int32_t), value :: closed
      integer(c_int64_t), value :: limit
      integer(c_int64_t), intent(inout) :: count
      type(c_ptr), intent(inout) :: text
      integer(c_int32_t) :: status
    end function c_mesh_defects

    !> Looks for pairs of triangles that cross: with a point in common that is on no vertex and no edge of both.
    function c_mesh_intersections(mesh, threads, capacity, count, triangles, xyz) result(status) &
        bind(c, name="carreau_mesh_intersections")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int32_t), value :: threads
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t), intent(inout) :: triangles(*)
      real(c_double), intent(inout) :: xyz(*)
      integer(c_int32_t) :: status
    end function c_mesh_intersections

    !> Finds the connected regions of space that the mesh bounds, for programs that fill them with solid elements:
    !! solids in ascending order, then holes, which no solid fills.
    function c_mesh_regions(mesh, capacity, count, solids, xyz) result(status) bind(c, name="carreau_mesh_regions")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t), intent(inout) :: solids(*)
      real(c_double), intent(inout) :: xyz(*)
      integer(c_int32_t) :: status
    end function c_mesh_regions

    !> Copies the solids on both sides of each triangle (m x 2) as carreau_mesh_regions has them: the solid that the
    !! triangle looks out of, and the solid on the other side; 0: none.
    function c_mesh_triangle_sides(mesh, capacity, solids) result(status) bind(c, name="carreau_mesh_triangle_sides")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: capacity
      integer(c_int32_t), intent(inout) :: solids(*)
      integer(c_int32_t) :: status
    end function c_mesh_triangle_sides

    !> Samples the fields that governed the mesh of each face on a grid over the box of its parameter domain, and writes
    !! images.
    function c_write_exr(session, path, options) result(status) bind(c, name="carreau_write_exr")
      import :: c_char, c_exr_options, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      character(kind=c_char), intent(in) :: path(*)
      type(c_exr_options), intent(in) :: options
      integer(c_int32_t) :: status
    end function c_write_exr

    !> Cuts a curve into edges of equal length in the metric, as near to 1 as a whole number of edges allows (RR-2818
    !! sec. 4; if all metrics are isotropic, by the closed forms of sec. 5, without lss).
    function c_curve_split(session, curve, capacity, abscissae, edges, length) result(status) &
        bind(c, name="carreau_curve_split")
      import :: c_curve, c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      type(c_curve), intent(in) :: curve
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout) :: abscissae(*)
      integer(c_int64_t), intent(inout) :: edges
      real(c_double), intent(inout) :: length
      integer(c_int32_t) :: status
    end function c_curve_split

    !> Gives sizes along the axes of each metric, the smallest first, n x dimension; and unit axes, n x dimension x
    !! dimension, one after another, or nothing when out_axes is NULL.
    function c_metric_sizes(session, dimension, n, metrics, sizes, axes) result(status) &
        bind(c, name="carreau_metric_sizes")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: dimension
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: metrics(*)
      real(c_double), intent(inout) :: sizes(*), axes(*)
      integer(c_int32_t) :: status
    end function c_metric_sizes

    !> Does the reverse: metrics of sizes > 0 along axes of any length but zero, which are made orthogonal from the
    !! first.
    function c_metric_of_sizes(session, dimension, n, sizes, axes, metrics) result(status) &
        bind(c, name="carreau_metric_of_sizes")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: dimension
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: sizes(*), axes(*)
      real(c_double), intent(inout) :: metrics(*)
      integer(c_int32_t) :: status
    end function c_metric_of_sizes

    !> Gives the metric at share[i] in [0, 1] from p to q: sizes along the axes of their simultaneous reduction follow
    !! the law, 0 linear, 1 geometric, 2 sinusoidal (RR-2818 sec. 4.3.2).
    function c_metric_interpolate(session, dimension, law, n, p, q, share, metrics) result(status) &
        bind(c, name="carreau_metric_interpolate")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: dimension, law
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: p(*), q(*), share(*)
      real(c_double), intent(inout) :: metrics(*)
      integer(c_int32_t) :: status
    end function c_metric_interpolate

    !> Intersects `count` > 0 metrics at each of n places: metrics is n x count rows.
    function c_metric_intersect(session, dimension, how, n, count, metrics, out_metrics) result(status) &
        bind(c, name="carreau_metric_intersect")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: dimension, how
      integer(c_int64_t), value :: n, count
      real(c_double), intent(in) :: metrics(*)
      real(c_double), intent(inout) :: out_metrics(*)
      integer(c_int32_t) :: status
    end function c_metric_intersect

    !> Gives the simultaneous reduction of p and q: directions that are orthogonal in both, unit vectors, n x dimension
    !! x dimension, and the sizes of p and of q along them, n x dimension each.
    function c_metric_reduce(session, dimension, n, p, q, p_sizes, q_sizes, directions) result(status) &
        bind(c, name="carreau_metric_reduce")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: dimension
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: p(*), q(*)
      real(c_double), intent(inout) :: p_sizes(*), q_sizes(*), directions(*)
      integer(c_int32_t) :: status
    end function c_metric_reduce

    !> Gives lengths of straight edges, n x 2 x dimension coordinates, with metrics at their ends, n x 2 rows, which are
    !! interpolated between by the law, to one part in ten thousand (RR-2818 sec. 4.4).
    function c_metric_lengths(session, dimension, law, n, edges, metrics, lengths) result(status) &
        bind(c, name="carreau_metric_lengths")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: dimension, law
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: edges(*), metrics(*)
      real(c_double), intent(inout) :: lengths(*)
      integer(c_int32_t) :: status
    end function c_metric_lengths

    !> Measures the mesh as a whole.
    function c_session_delivered(session, delivered) result(status) bind(c, name="carreau_session_delivered")
      import :: c_delivered, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      type(c_delivered), intent(inout) :: delivered
      integer(c_int32_t) :: status
    end function c_session_delivered

    !> Gives the spread of a kind.
    function c_delivered_measure(session, kind, measure) result(status) bind(c, name="carreau_delivered_measure")
      import :: c_int32_t, c_measure, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: kind
      type(c_measure), intent(inout) :: measure
      integer(c_int32_t) :: status
    end function c_delivered_measure

    !> Gives a histogram: counts[i] values from bounds[i] up to bounds[i + 1], where bounds[0] is -infinity.
    function c_delivered_histogram(session, kind, capacity, bounds, counts) result(status) &
        bind(c, name="carreau_delivered_histogram")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: kind
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout) :: bounds(*)
      integer(c_int64_t), intent(inout) :: counts(*)
      integer(c_int32_t) :: status
    end function c_delivered_histogram

    !> Gives one value for each edge, vertex or triangle.
    function c_delivered_values(session, kind, capacity, values) result(status) bind(c, name="carreau_delivered_values")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: kind
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout) :: values(*)
      integer(c_int32_t) :: status
    end function c_delivered_values

    !> Gives the edges of all triangles, each once: k x 2 vertices, the smaller first, and the reference of the curve, 0
    !! inside a face.
    function c_delivered_edges(session, capacity, vertices, curves) result(status) &
        bind(c, name="carreau_delivered_edges")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int64_t), value :: capacity
      integer(c_int32_t), intent(inout) :: vertices(*), curves(*)
      integer(c_int32_t) :: status
    end function c_delivered_edges

    !> Gives the edge that leaves each corner of a triangle, m x 3.
    function c_delivered_triangle_edges(session, capacity, edges) result(status) &
        bind(c, name="carreau_delivered_triangle_edges")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int64_t), value :: capacity
      integer(c_int32_t), intent(inout) :: edges(*)
      integer(c_int32_t) :: status
    end function c_delivered_triangle_edges

    !> Writes the spreads, histograms, counts and sentences as JSON.
    function c_delivered_write(session, path) result(status) bind(c, name="carreau_delivered_write")
      import :: c_char, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t) :: status
    end function c_delivered_write

    !> strlen of the C library: the length of a text that the library returns.
    function c_strlen(text) result(length) bind(c, name="strlen")
      import :: c_ptr, c_size_t
      implicit none
      type(c_ptr), value :: text
      integer(c_size_t) :: length
    end function c_strlen
  end interface
end module carreau_c
