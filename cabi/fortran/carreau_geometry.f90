! SPDX-License-Identifier: BSD-3-Clause
!> Fortran 2003 face of cabi/include/carreau_geometry.h: several geometries in
!! a session, Bezier patches, molecules, grids, triangles and plane domains. That header documents the meaning and errors of
!! each routine. Different here: points and curves count from 1, and a control point 0 is a free end; arguments that may be
!! NULL are optional.
module carreau_geometry
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funloc, c_int32_t, c_int64_t, c_loc, c_null_char, c_ptr
  use carreau, only: carreau_session, carreau_mesh, carreau_mesh_count, carreau_string, CARREAU_ERR_ARGUMENT, CARREAU_OK, &
    carreau_surface_fn, carreau_surface_batch_fn, carreau_interval_fn, carreau_curve_fn, carreau_surface_value_fn, &
    carreau_curve_value_fn, carreau_point_value_fn, carreau_failure_fn, carreau_release_fn
  use carreau_c, only: c_cad
  use carreau_geometry_c
  implicit none
  private

  public :: carreau_plane_curves, carreau_add_plane_domain, carreau_load_plane_domain, carreau_plane_has_sizes

  public :: carreau_geometry_place, carreau_geometry_count, carreau_geometry_info
  public :: carreau_geometry_begin, carreau_geometry_end, carreau_geometry_cancel
  public :: carreau_add_bezier, carreau_load_bezier, carreau_bezier_degrees

  public :: carreau_molecule_options, carreau_molecule_measures, carreau_add_molecule, carreau_load_molecule
  public :: carreau_molecule_measure, carreau_molecule_atoms, carreau_molecule_atom_areas
  public :: carreau_molecule_atom_name
  public :: carreau_grid_options, carreau_add_grid, carreau_load_grid
  public :: carreau_triangles_options, carreau_triangles_report, carreau_add_triangles, carreau_load_triangles
  public :: carreau_triangles_measure, carreau_triangles_refine, carreau_triangles_distances, &
    carreau_triangles_bounds
  public :: carreau_geometry_points, carreau_geometry_curve
  public :: carreau_mesh_carry, carreau_mesh_halve, carreau_mesh_refine, carreau_mesh_refine_sizes
  integer(c_int32_t), parameter, public :: CARREAU_MATCH_ANY = 0, CARREAU_MATCH_REFERENCE = 1, CARREAU_MATCH_NAME = 2, &
    CARREAU_MATCH_SHAPE = 3
  public :: carreau_raise_order, carreau_raised_count, carreau_raised_nodes, carreau_raised_elements, carreau_raised_write
  integer(c_int32_t), parameter, public :: CARREAU_EQUIDISTANT = 0, CARREAU_GAUSS_LOBATTO = 1
  integer(c_int32_t), parameter, public :: CARREAU_MARK_EDGES = 1, CARREAU_MARK_ELEMENTS = 2
  public :: carreau_model_embed_point, carreau_model_embed_polyline, carreau_model_embed_wires, carreau_model_embed_ridges
  public :: carreau_evaluate, carreau_project, carreau_mesh_vertex_entities, carreau_mesh_edge_parameters

  integer(c_int32_t), parameter, public :: CARREAU_GEOMETRY_CALLBACKS = 1, CARREAU_GEOMETRY_BEZIER = 2, &
    CARREAU_GEOMETRY_MOLECULE = 3, CARREAU_GEOMETRY_PLANE = 4, CARREAU_GEOMETRY_GRID = 5, &
    CARREAU_GEOMETRY_TRIANGLES = 6, CARREAU_GEOMETRY_ATLAS = 7
  integer(c_int32_t), parameter, public :: CARREAU_BEZIER_DEGREE = 15
  integer(c_int32_t), parameter, public :: CARREAU_VWS = 1, CARREAU_SAS = 2, CARREAU_SES = 3
  integer(c_int32_t), parameter, public :: CARREAU_REST_PARITY = 0, CARREAU_REST_INSIDE = 1, CARREAU_REST_OUTSIDE = 2
  integer(c_int32_t), parameter, public :: CARREAU_SEGMENTS = 0, CARREAU_SPLINE = 1, CARREAU_ARCS = 2

  !> Its face k is face first_face + k - 1 of the session.
  type :: carreau_geometry_place
    integer(c_int32_t) :: kind, faces, first_face, last_face, first_curve, last_curve, first_point, last_point
  end type carreau_geometry_place

  type :: carreau_molecule_options
    integer(c_int32_t) :: surface = CARREAU_VWS, drop_cavities = 0
    real(c_double) :: probe = 1.4_c_double
    character(len=:), allocatable :: radii !< file of lines "symbol radius"; not allocated: none
  end type carreau_molecule_options

  integer(c_int32_t), parameter, public :: CARREAU_MEASURED_POINTS = 0, CARREAU_MEASURED_HEIGHTS = 1, CARREAU_MEASURED_RADII = 2
  integer(c_int32_t), parameter, public :: CARREAU_GRID_BY_SUFFIX = 0, CARREAU_GRID_PLOT3D = 1, CARREAU_GRID_HEIGHTS = 2
  integer(c_int32_t), parameter, public :: CARREAU_GRID_SCAN = 3, CARREAU_GRID_NODES = 4

  type :: carreau_grid_options
    integer(c_int32_t) :: measured = CARREAU_MEASURED_POINTS, smoothing_rounds = 0
    real(c_double) :: smoothing_inward = 0.06_c_double, smoothing_outward = 0.061_c_double
    logical :: lengths = .false., orient = .false., fill = .false., smoothing_by_distance = .false.
    integer(c_int32_t) :: continuity = 1
    real(c_double) :: join_angle = 0, tolerance = 0, step = 0
  end type carreau_grid_options

  !> Angles in degrees; 0: sharp_angle is found between 20 and 45, corner_angle is 45
  type :: carreau_triangles_options
    real(c_double) :: sharp_angle = 0, corner_angle = 0
    logical :: given_edges_only = .false., ignore_references = .false., keep_double_vertices = .false.
  end type carreau_triangles_options

  type :: carreau_triangles_report
    integer(c_int64_t) :: vertices, triangles, edges, shells, euler_number
    integer(c_int64_t) :: border_edges, manifold_breaks, one_sided_edges, pinched_vertices
    integer(c_int64_t) :: turned_triangles, repeated_triangles, flat_triangles
    integer(c_int64_t) :: sharp_edges, lines, corners, regions, dropped_edges, prolonged_edges, faded_ends
    integer(c_int64_t) :: unfolded, folded
    real(c_double) :: diagonal, deviation, sharp_angle
  end type carreau_triangles_report

  type :: carreau_molecule_measures
    real(c_double) :: area, volume
    integer(c_int64_t) :: atoms, exposed_atoms, shells, cavities, euler_number, moved_radii
    real(c_double) :: convex_area, torus_area, concave_area
  end type carreau_molecule_measures

  !> Curve c passes points(starts(c) : starts(c + 1) - 1); the last entry of `starts` is size(points) + 1. Arrays that are
  !! not allocated are not given: curves are segments without references, and ends of splines are free.
  type :: carreau_plane_curves
    integer(c_int32_t), allocatable :: starts(:), points(:)
    integer(c_int32_t), allocatable :: smooth(:)      !< CARREAU_SEGMENTS, _SPLINE or _ARCS
    integer(c_int32_t), allocatable :: controls(:, :) !< (2, n): before the first and behind the last point
    real(c_double), allocatable :: tangents(:, :)     !< (4, n): derivatives at both ends; NaN: not given
    integer(c_int32_t), allocatable :: refs(:)
  end type carreau_plane_curves

contains

  ! ---- Several geometries in one session ----

  subroutine carreau_geometry_count(session, count, status)
    type(carreau_session), intent(in) :: session
    integer(c_int64_t), intent(out) :: count
    integer(c_int32_t), intent(out) :: status
    count = 0
    status = c_geometry_count(session%handle, count)
  end subroutine carreau_geometry_count

  !> index: from 1
  subroutine carreau_geometry_info(session, index, geometry, status)
    type(carreau_session), intent(in) :: session
    integer(c_int64_t), intent(in) :: index
    type(carreau_geometry_place), intent(out) :: geometry
    integer(c_int32_t), intent(out) :: status
    type(c_geometry) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    status = c_geometry_info(session%handle, index - 1, c)
    if (status /= CARREAU_OK) return
    geometry = carreau_geometry_place(c%kind, c%faces, c%first_face, c%last_face, c%first_curve, c%last_curve, &
      c%first_point, c%last_point)
  end subroutine carreau_geometry_info

  !> Arguments as in carreau_set_cad.
  subroutine carreau_geometry_begin(session, surface, curve_interval, curve, status, user, surface_order, curve_order, &
      reentrant, surface_batch, surface_size, curve_size, point_size, surface_radius, curve_radius, failure, release)
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
    type(c_cad), target :: callbacks
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
    status = c_geometry_begin(session%handle, c_loc(callbacks))
  end subroutine carreau_geometry_begin

  subroutine carreau_geometry_end(session, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(out) :: status
    status = c_geometry_end(session%handle)
  end subroutine carreau_geometry_end

  subroutine carreau_geometry_cancel(session, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(out) :: status
    status = c_geometry_cancel(session%handle)
  end subroutine carreau_geometry_cancel

  ! ---- Bezier patches ----

  !> degrees(2, n): m, n; controls(3, all points): patch by patch, v runs fastest; side_refs(4, n)
  subroutine carreau_add_bezier(session, degrees, controls, status, side_refs)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: degrees(:, :)
    real(c_double), intent(in) :: controls(:, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int32_t), intent(in), optional :: side_refs(:, :)
    type(c_bezier) :: c
    integer(c_int32_t), allocatable, target :: flat_degrees(:), flat_refs(:)
    real(c_double), allocatable, target :: flat_controls(:)
    status = CARREAU_ERR_ARGUMENT
    if (size(degrees, 1) /= 2 .or. size(controls, 1) /= 3) return
    if (sum((degrees(1, :) + 1) * (degrees(2, :) + 1)) /= size(controls, 2)) return
    flat_degrees = reshape(degrees, [size(degrees)])
    flat_controls = reshape(controls, [size(controls)])
    c%struct_size = size(transfer(c, [c_null_char]))
    c%patch_count = size(degrees, 2)
    if (size(flat_degrees) > 0) c%degrees = c_loc(flat_degrees)
    if (size(flat_controls) > 0) c%controls = c_loc(flat_controls)
    if (present(side_refs)) then
      if (size(side_refs, 1) /= 4 .or. size(side_refs, 2) /= size(degrees, 2)) return
      flat_refs = reshape(side_refs, [size(side_refs)])
      if (size(flat_refs) > 0) c%side_refs = c_loc(flat_refs)
    end if
    status = c_add_bezier(session%handle, c)
  end subroutine carreau_add_bezier

  subroutine carreau_load_bezier(session, path, status)
    type(carreau_session), intent(in) :: session
    character(len=*), intent(in) :: path
    integer(c_int32_t), intent(out) :: status
    status = c_load_bezier(session%handle, trim(path)//c_null_char)
  end subroutine carreau_load_bezier

  subroutine carreau_bezier_degrees(session, face_ref, degrees, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: face_ref
    integer(c_int32_t), intent(out) :: degrees(2)
    integer(c_int32_t), intent(out) :: status
    degrees = 0
    status = c_bezier_degrees(session%handle, face_ref, degrees)
  end subroutine carreau_bezier_degrees

  ! ---- Molecules ----

  !> centers(3, n), radii(n)
  subroutine carreau_add_molecule(session, options, centers, radii, status)
    type(carreau_session), intent(in) :: session
    type(carreau_molecule_options), intent(in) :: options
    real(c_double), intent(in) :: centers(:, :), radii(:)
    integer(c_int32_t), intent(out) :: status
    status = CARREAU_ERR_ARGUMENT
    if (size(centers, 1) /= 3 .or. size(centers, 2) /= size(radii)) return
    status = c_add_molecule(session%handle, c_options(options), size(radii, kind=c_int64_t), &
      reshape(centers, [size(centers)]), radii)
  end subroutine carreau_add_molecule

  subroutine carreau_load_molecule(session, options, path, status)
    type(carreau_session), intent(in) :: session
    type(carreau_molecule_options), intent(in) :: options
    character(len=*), intent(in) :: path
    integer(c_int32_t), intent(out) :: status
    type(c_molecule_options) :: c
    character(kind=c_char), allocatable, target :: radii(:)
    c = c_options(options)
    if (allocated(options%radii)) then
      allocate (radii(len_trim(options%radii) + 1))
      radii = transfer(trim(options%radii)//c_null_char, [c_null_char], size(radii))
      c%radii = c_loc(radii)
    end if
    status = c_load_molecule(session%handle, c, trim(path)//c_null_char)
  end subroutine carreau_load_molecule

  subroutine carreau_molecule_measure(session, measures, status)
    type(carreau_session), intent(in) :: session
    type(carreau_molecule_measures), intent(out) :: measures
    integer(c_int32_t), intent(out) :: status
    type(c_molecule_measures) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    status = c_molecule_measure(session%handle, c)
    if (status /= CARREAU_OK) return
    measures = carreau_molecule_measures(c%area, c%volume, c%atoms, c%exposed_atoms, c%shells, c%cavities, &
      c%euler_number, c%moved_radii, c%convex_area, c%torus_area, c%concave_area)
  end subroutine carreau_molecule_measure

  !> refs(n), areas(n)
  subroutine carreau_molecule_atoms(session, refs, areas, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), allocatable, intent(out) :: refs(:)
    real(c_double), allocatable, intent(out) :: areas(:)
    integer(c_int32_t), intent(out) :: status
    type(carreau_molecule_measures) :: measures
    call carreau_molecule_measure(session, measures, status)
    if (status /= CARREAU_OK) return
    allocate (refs(measures%atoms), areas(measures%atoms))
    status = c_molecule_atoms(session%handle, measures%atoms, refs, areas)
  end subroutine carreau_molecule_atoms

  !> convex(n), torus(n), concave(n)
  subroutine carreau_molecule_atom_areas(session, convex, torus, concave, status)
    type(carreau_session), intent(in) :: session
    real(c_double), allocatable, intent(out) :: convex(:), torus(:), concave(:)
    integer(c_int32_t), intent(out) :: status
    type(carreau_molecule_measures) :: measures
    call carreau_molecule_measure(session, measures, status)
    if (status /= CARREAU_OK) return
    allocate (convex(measures%atoms), torus(measures%atoms), concave(measures%atoms))
    status = c_molecule_atom_areas(session%handle, measures%atoms, convex, torus, concave)
  end subroutine carreau_molecule_atom_areas

  !> atom: from 1; "" when it has none, or there is no such atom
  function carreau_molecule_atom_name(session, atom) result(name)
    type(carreau_session), intent(in) :: session
    integer(c_int64_t), intent(in) :: atom
    character(len=:), allocatable :: name
    name = carreau_string(c_molecule_atom_name(session%handle, atom - 1))
  end function carreau_molecule_atom_name

  function c_options(options) result(c)
    type(carreau_molecule_options), intent(in) :: options
    type(c_molecule_options) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    c%surface = options%surface
    c%drop_cavities = options%drop_cavities
    c%probe = options%probe
  end function c_options

  ! ---- Structured grids ----

  !> counts(2, n): columns and rows of each block; nodes(3, sum of their products), columns running fastest
  subroutine carreau_add_grid(session, options, counts, nodes, status)
    type(carreau_session), intent(in) :: session
    type(carreau_grid_options), intent(in) :: options
    integer(c_int32_t), intent(in) :: counts(:, :)
    real(c_double), intent(in) :: nodes(:, :)
    integer(c_int32_t), intent(out) :: status
    status = CARREAU_ERR_ARGUMENT
    if (size(counts, 1) /= 2 .or. size(nodes, 1) /= 3) return
    if (sum(product(int(counts, c_int64_t), 1)) /= size(nodes, 2, kind=c_int64_t)) return
    status = c_add_grid(session%handle, c_grid(options), size(counts, 2, kind=c_int64_t), &
      reshape(counts, [size(counts)]), reshape(nodes, [size(nodes)]))
  end subroutine carreau_add_grid

  !> format: left out, by suffix
  subroutine carreau_load_grid(session, options, path, status, format)
    type(carreau_session), intent(in) :: session
    type(carreau_grid_options), intent(in) :: options
    character(len=*), intent(in) :: path
    integer(c_int32_t), intent(out) :: status
    integer(c_int32_t), intent(in), optional :: format
    integer(c_int32_t) :: known
    known = CARREAU_GRID_BY_SUFFIX
    if (present(format)) known = format
    status = c_load_grid(session%handle, c_grid(options), trim(path)//c_null_char, known)
  end subroutine carreau_load_grid

  function c_grid(options) result(c)
    type(carreau_grid_options), intent(in) :: options
    type(c_grid_options) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    c%measured = options%measured
    c%smoothing_rounds = options%smoothing_rounds
    c%smoothing_inward = options%smoothing_inward
    c%smoothing_outward = options%smoothing_outward
    c%lengths = merge(1, 0, options%lengths)
    c%orient = merge(1, 0, options%orient)
    c%fill = merge(1, 0, options%fill)
    c%join_angle = options%join_angle
    c%tolerance = options%tolerance
    c%step = options%step
    c%continuity = options%continuity
    c%smoothing_by_distance = merge(1, 0, options%smoothing_by_distance)
  end function c_grid

  ! ---- Surfaces given as triangles ----

  !> vertices(3, n), triangles(3, m), refs(m), edges(2, k): vertices count from 1
  subroutine carreau_add_triangles(session, options, vertices, triangles, status, refs, edges)
    type(carreau_session), intent(in) :: session
    type(carreau_triangles_options), intent(in) :: options
    real(c_double), intent(in) :: vertices(:, :)
    integer(c_int32_t), intent(in) :: triangles(:, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int32_t), intent(in), optional :: refs(:), edges(:, :)
    real(c_double), allocatable, target :: x(:)
    integer(c_int32_t), allocatable, target :: t(:), r(:), e(:)
    type(c_triangles) :: c
    status = CARREAU_ERR_ARGUMENT
    if (size(vertices, 1) /= 3 .or. size(triangles, 1) /= 3) return
    c%struct_size = size(transfer(c, [c_null_char]))
    c%vertex_count = size(vertices, 2)
    c%triangle_count = size(triangles, 2)
    x = reshape(vertices, [size(vertices)])
    t = reshape(triangles, [size(triangles)]) - 1
    if (size(x) > 0) c%vertices = c_loc(x(1))
    if (size(t) > 0) c%triangles = c_loc(t(1))
    if (present(refs)) then
      if (size(refs) /= size(triangles, 2)) return
      r = refs
      if (size(r) > 0) c%triangle_refs = c_loc(r(1))
    end if
    if (present(edges)) then
      if (size(edges, 1) /= 2) return
      c%edge_count = size(edges, 2)
      e = reshape(edges, [size(edges)]) - 1
      if (size(e) > 0) c%edges = c_loc(e(1))
    end if
    status = c_add_triangles(session%handle, c_triangles_of(options), c)
  end subroutine carreau_add_triangles

  subroutine carreau_load_triangles(session, options, path, status)
    type(carreau_session), intent(in) :: session
    type(carreau_triangles_options), intent(in) :: options
    character(len=*), intent(in) :: path
    integer(c_int32_t), intent(out) :: status
    status = c_load_triangles(session%handle, c_triangles_of(options), trim(path)//c_null_char)
  end subroutine carreau_load_triangles

  function c_triangles_of(options) result(c)
    type(carreau_triangles_options), intent(in) :: options
    type(c_triangles_options) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    c%sharp_angle = options%sharp_angle
    c%corner_angle = options%corner_angle
    c%given_edges_only = merge(1, 0, options%given_edges_only)
    c%ignore_references = merge(1, 0, options%ignore_references)
    c%keep_double_vertices = merge(1, 0, options%keep_double_vertices)
  end function c_triangles_of

  subroutine carreau_triangles_measure(session, report, status)
    type(carreau_session), intent(in) :: session
    type(carreau_triangles_report), intent(out) :: report
    integer(c_int32_t), intent(out) :: status
    type(c_triangles_report) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    status = c_triangles_measure(session%handle, c)
    if (status /= CARREAU_OK) return
    report = carreau_triangles_report(c%vertices, c%triangles, c%edges, c%shells, c%euler_number, c%border_edges, &
      c%manifold_breaks, c%one_sided_edges, c%pinched_vertices, c%turned_triangles, c%repeated_triangles, &
      c%flat_triangles, c%sharp_edges, c%lines, c%corners, c%regions, c%dropped_edges, c%prolonged_edges, &
      c%faded_ends, c%unfolded, c%folded, c%diagonal, c%deviation, c%sharp_angle)
  end subroutine carreau_triangles_measure

  !> angle in degrees; mesh: of carreau_mesh_create
  subroutine carreau_triangles_refine(session, angle, depth, mesh, status)
    type(carreau_session), intent(in) :: session
    real(c_double), intent(in) :: angle
    integer(c_int32_t), intent(in) :: depth
    type(carreau_mesh), intent(in) :: mesh
    integer(c_int32_t), intent(out) :: status
    status = c_triangles_refine(session%handle, angle, depth, mesh%handle)
  end subroutine carreau_triangles_refine

  !> From the mesh to the triangles, and back
  subroutine carreau_triangles_distances(session, distances, status)
    type(carreau_session), intent(in) :: session
    real(c_double), intent(out) :: distances(2)
    integer(c_int32_t), intent(out) :: status
    distances = 0
    status = c_triangles_distances(session%handle, distances)
  end subroutine carreau_triangles_distances

  !> From the mesh to the triangles: between the first two; back: between the others. share: 0 stands for .01
  subroutine carreau_triangles_bounds(session, share, bounds, status)
    type(carreau_session), intent(in) :: session
    real(c_double), intent(in) :: share
    real(c_double), intent(out) :: bounds(4)
    integer(c_int32_t), intent(out) :: status
    bounds = 0
    status = c_triangles_bounds(session%handle, share, bounds)
  end subroutine carreau_triangles_bounds

  ! ---- Places of the model ----

  !> parameters(dimension, n), xyz(3, n), first(3, dimension, n); second(3, 3, n) of faces, (3, 1, n) of curves
  subroutine carreau_evaluate(session, dimension, reference, parameters, xyz, status, first, second)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: dimension, reference
    real(c_double), intent(in) :: parameters(:, :)
    real(c_double), allocatable, intent(out) :: xyz(:, :)
    integer(c_int32_t), intent(out) :: status
    real(c_double), allocatable, optional, intent(out) :: first(:, :, :), second(:, :, :)
    real(c_double), allocatable :: points(:), by_one(:), by_two(:)
    integer(c_int64_t) :: n
    integer :: seconds
    status = CARREAU_ERR_ARGUMENT
    if (size(parameters, 1) /= dimension .or. dimension < 1 .or. dimension > 2) return
    n = size(parameters, 2, kind=c_int64_t)
    seconds = merge(3, 1, dimension == 2)
    allocate (points(3 * n), by_one(3 * dimension * n), by_two(3 * seconds * n))
    points = 0
    by_one = 0
    by_two = 0
    status = c_evaluate(session%handle, dimension, reference, n, reshape(parameters, [size(parameters)]), 2_c_int32_t, &
      points, by_one, by_two)
    if (status /= CARREAU_OK) return
    xyz = reshape(points, [3, int(n)])
    if (present(first)) first = reshape(by_one, [3, int(dimension), int(n)])
    if (present(second)) second = reshape(by_two, [3, seconds, int(n)])
  end subroutine carreau_evaluate

  !> xyz(3, n), references(n), parameters(dimension, n), closest(3, n), distances(n); reference 0: the closest of all
  subroutine carreau_project(session, dimension, reference, xyz, references, parameters, closest, distances, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: dimension, reference
    real(c_double), intent(in) :: xyz(:, :)
    integer(c_int32_t), allocatable, intent(out) :: references(:)
    real(c_double), allocatable, intent(out) :: parameters(:, :), closest(:, :), distances(:)
    integer(c_int32_t), intent(out) :: status
    real(c_double), allocatable :: flat(:), points(:)
    integer :: n
    status = CARREAU_ERR_ARGUMENT
    if (size(xyz, 1) /= 3 .or. dimension < 0 .or. dimension > 2) return
    n = size(xyz, 2)
    allocate (references(n), flat(dimension * n), points(3 * n), distances(n))
    references = 0
    flat = 0
    points = 0
    distances = 0
    status = c_project(session%handle, dimension, reference, int(n, c_int64_t), reshape(xyz, [size(xyz)]), references, &
      flat, points, distances)
    if (status /= CARREAU_OK) then
      deallocate (references, distances)
      return
    end if
    parameters = reshape(flat, [int(dimension), n])
    closest = reshape(points, [3, n])
  end subroutine carreau_project

  !> Embeds a point of space in the nearest face; ref is its reference.
  subroutine carreau_model_embed_point(session, xyz, name, ref, status)
    type(carreau_session), intent(in) :: session
    real(c_double), intent(in) :: xyz(3)
    character(len=*), intent(in) :: name
    integer(c_int32_t), intent(out) :: ref, status
    ref = 0
    status = c_model_embed_point(session%handle, xyz, trim(name)//c_null_char, ref)
  end subroutine carreau_model_embed_point

  !> Embeds a polyline xyz(3, n) in the faces that it lies on; ref names its edges.
  subroutine carreau_model_embed_polyline(session, xyz, name, ref, status)
    type(carreau_session), intent(in) :: session
    real(c_double), intent(in) :: xyz(:, :)
    character(len=*), intent(in) :: name
    integer(c_int32_t), intent(out) :: ref, status
    ref = 0
    status = CARREAU_ERR_ARGUMENT
    if (size(xyz, 1) /= 3) return
    status = c_model_embed_polyline(session%handle, size(xyz, 2, c_int64_t), reshape(xyz, [size(xyz)]), &
      trim(name)//c_null_char, ref)
  end subroutine carreau_model_embed_polyline

  !> Embeds the wires that lie on faces; count is their number.
  subroutine carreau_model_embed_wires(session, count, status)
    type(carreau_session), intent(in) :: session
    integer(c_int64_t), intent(out) :: count
    integer(c_int32_t), intent(out) :: status
    count = 0
    status = c_model_embed_wires(session%handle, count)
  end subroutine carreau_model_embed_wires

  !> Embeds the ridges of grids whose radius of curvature is smaller; count of them
  subroutine carreau_model_embed_ridges(session, radius, count, status)
    type(carreau_session), intent(in) :: session
    real(c_double), intent(in) :: radius
    integer(c_int64_t), intent(out) :: count
    integer(c_int32_t), intent(out) :: status
    count = 0
    status = c_model_embed_ridges(session%handle, radius, count)
  end subroutine carreau_model_embed_ridges

  !> Entities that vertices lie on: 0 points, 1 curves, 2 faces, and their references
  subroutine carreau_mesh_vertex_entities(mesh, dimensions, references, status)
    type(carreau_mesh), intent(in) :: mesh
    integer(c_int32_t), allocatable, intent(out) :: dimensions(:), references(:)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: vertices, triangles, edges, faces
    call carreau_mesh_count(mesh, vertices, triangles, edges, faces, status)
    if (status /= CARREAU_OK) return
    allocate (dimensions(vertices), references(vertices))
    dimensions = 0
    references = 0
    status = c_mesh_vertex_entities(mesh%handle, vertices, dimensions, references)
    if (status /= CARREAU_OK) deallocate (dimensions, references)
  end subroutine carreau_mesh_vertex_entities

  !> t(2, k) on curve ics(k) of face faces(k)
  subroutine carreau_mesh_edge_parameters(mesh, t, faces, ics, status)
    type(carreau_mesh), intent(in) :: mesh
    real(c_double), allocatable, intent(out) :: t(:, :)
    integer(c_int32_t), allocatable, intent(out) :: faces(:), ics(:)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: vertices, triangles, edges, all_faces
    call carreau_mesh_count(mesh, vertices, triangles, edges, all_faces, status)
    if (status /= CARREAU_OK) return
    allocate (t(2, edges), faces(edges), ics(edges))
    t = 0
    faces = 0
    ics = 0
    status = c_mesh_edge_parameters(mesh%handle, edges, t, faces, ics)
    if (status /= CARREAU_OK) deallocate (t, faces, ics)
  end subroutine carreau_mesh_edge_parameters

  ! ---- Meshes that follow their geometry ----

  subroutine carreau_mesh_carry(session, old_mesh, status, match)
    type(carreau_session), intent(in) :: session
    type(carreau_mesh), intent(in) :: old_mesh
    integer(c_int32_t), intent(out) :: status
    integer(c_int32_t), intent(in), optional :: match
    integer(c_int32_t) :: by
    by = CARREAU_MATCH_ANY
    if (present(match)) by = match
    status = c_mesh_carry(session%handle, old_mesh%handle, by)
  end subroutine carreau_mesh_carry

  subroutine carreau_mesh_halve(session, times, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: times
    integer(c_int32_t), intent(out) :: status
    status = c_mesh_halve(session%handle, times)
  end subroutine carreau_mesh_halve

  !> marks: pairs of vertices, or elements, from 1
  subroutine carreau_mesh_refine(session, kind, marks, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: kind, marks(:)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: n
    n = size(marks, kind=c_int64_t)
    if (kind == CARREAU_MARK_EDGES) n = n/2
    status = c_mesh_refine(session%handle, kind, n, marks - 1)
  end subroutine carreau_mesh_refine

  subroutine carreau_mesh_refine_sizes(session, sizes, status)
    type(carreau_session), intent(in) :: session
    real(c_double), intent(in) :: sizes(:)
    integer(c_int32_t), intent(out) :: status
    status = c_mesh_refine_sizes(session%handle, size(sizes, kind=c_int64_t), sizes)
  end subroutine carreau_mesh_refine_sizes

  ! ---- Elements of order 3 and 4 ----

  subroutine carreau_raise_order(session, order, status, places, invalid)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: order
    integer(c_int32_t), intent(out) :: status
    integer(c_int32_t), intent(in), optional :: places
    integer(c_int64_t), intent(out), optional :: invalid
    integer(c_int32_t) :: at
    integer(c_int64_t) :: n
    at = CARREAU_EQUIDISTANT
    if (present(places)) at = places
    n = 0
    status = c_raise_order(session%handle, order, at, n)
    if (present(invalid)) invalid = n
  end subroutine carreau_raise_order

  subroutine carreau_raised_count(session, nodes, triangles, quads, edges, status)
    type(carreau_session), intent(in) :: session
    integer(c_int64_t), intent(out) :: nodes, triangles, quads, edges
    integer(c_int32_t), intent(out) :: status
    nodes = 0
    triangles = 0
    quads = 0
    edges = 0
    status = c_raised_count(session%handle, nodes, triangles, quads, edges)
  end subroutine carreau_raised_count

  !> xyz(3, n)
  subroutine carreau_raised_nodes(session, xyz, status)
    type(carreau_session), intent(in) :: session
    real(c_double), allocatable, intent(out) :: xyz(:, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: nodes, triangles, quads, edges
    call carreau_raised_count(session, nodes, triangles, quads, edges, status)
    if (status /= CARREAU_OK) return
    allocate (xyz(3, nodes))
    xyz = 0
    status = c_raised_nodes(session%handle, nodes, xyz)
    if (status /= CARREAU_OK) deallocate (xyz)
  end subroutine carreau_raised_nodes

  !> Rows of nodes from 1 of the elements of the mesh's order with 2, 3 or 4 corners, and the references of their entities
  subroutine carreau_raised_elements(session, order, corners, nodes, references, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: order, corners
    integer(c_int32_t), allocatable, intent(out) :: nodes(:, :), references(:)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: n, triangles, quads, edges
    integer(c_int32_t) :: width
    call carreau_raised_count(session, n, triangles, quads, edges, status)
    if (status /= CARREAU_OK) return
    n = edges
    width = order + 1
    if (corners == 3) then
      n = triangles
      width = (order + 1)*(order + 2)/2
    else if (corners == 4) then
      n = quads
      width = (order + 1)**2
    end if
    allocate (nodes(width, n), references(n))
    nodes = 0
    references = 0
    status = c_raised_elements(session%handle, corners, n, nodes, references)
    nodes = nodes + 1
    if (status /= CARREAU_OK) deallocate (nodes, references)
  end subroutine carreau_raised_elements

  subroutine carreau_raised_write(session, path, status)
    type(carreau_session), intent(in) :: session
    character(len=*), intent(in) :: path
    integer(c_int32_t), intent(out) :: status
    status = c_raised_write(session%handle, path//c_null_char)
  end subroutine carreau_raised_write

  ! ---- Points of built-in geometries ----

  !> uv(2, n), xyz(3, n)
  subroutine carreau_geometry_points(session, face_ref, uv, xyz, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: face_ref
    real(c_double), intent(in) :: uv(:, :)
    real(c_double), allocatable, intent(out) :: xyz(:, :)
    integer(c_int32_t), intent(out) :: status
    status = CARREAU_ERR_ARGUMENT
    if (size(uv, 1) /= 2) return
    allocate (xyz(3, size(uv, 2)))
    xyz = 0
    status = c_geometry_points(session%handle, face_ref, size(uv, 2, kind=c_int64_t), reshape(uv, [size(uv)]), xyz)
    if (status /= CARREAU_OK) deallocate (xyz)
  end subroutine carreau_geometry_points

  subroutine carreau_geometry_curve(session, face_ref, ic, share, uv, status)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t), intent(in) :: face_ref, ic
    real(c_double), intent(in) :: share
    real(c_double), intent(inout) :: uv(2)
    integer(c_int32_t), intent(out) :: status
    status = c_geometry_curve(session%handle, face_ref, ic, share, uv)
  end subroutine carreau_geometry_curve

  ! ---- Plane domains ----

  !> points(2, n); sides(3, k): curve, 1 (left) or -1 (right), reference; seeds(2, m) with seed_refs(m), -1 for holes;
  !! metrics(3, n): xx xy yy
  subroutine carreau_add_plane_domain(session, points, curves, status, rest, point_refs, imposed, sizes, metrics, sides, &
                                      seeds, seed_refs)
    type(carreau_session), intent(in) :: session
    real(c_double), intent(in) :: points(:, :)
    type(carreau_plane_curves), intent(in) :: curves
    integer(c_int32_t), intent(out) :: status
    integer(c_int32_t), intent(in), optional :: rest, point_refs(:), imposed(:), sides(:, :), seed_refs(:)
    real(c_double), intent(in), optional :: sizes(:), metrics(:, :), seeds(:, :)
    real(c_double), allocatable, target :: xy(:), h(:), m(:), tangents(:), at(:)
    integer(c_int32_t), allocatable, target :: passed(:), refs(:), fixed(:), smooth(:), controls(:), curve_refs(:), of_side(:), &
      of_seed(:)
    integer(c_int64_t), allocatable, target :: starts(:)
    type(c_plane_domain) :: c
    integer :: i, n
    status = CARREAU_ERR_ARGUMENT
    if (size(points, 1) /= 2 .or. .not. (allocated(curves%starts) .and. allocated(curves%points))) return
    n = size(curves%starts) - 1
    if (n < 1) return
    if (curves%starts(1) /= 1 .or. curves%starts(n + 1) /= size(curves%points) + 1) return
    if (any(curves%starts(2:) < curves%starts(:n)) .or. .not. fit_curves(curves, n)) return
    c%struct_size = size(transfer(c, [c_null_char]))
    c%point_count = size(points, 2)
    c%curve_count = n
    if (present(rest)) c%rest = rest
    call copy_reals(reshape(points, [size(points)]), xy, c%points)
    allocate (starts(n + 1))
    starts = curves%starts - 1
    c%curve_starts = c_loc(starts(1))
    call copy_integers(curves%points - 1, passed, c%curve_points)
    if (allocated(curves%smooth)) call copy_integers(curves%smooth, smooth, c%smooth)
    if (allocated(curves%controls)) call copy_integers(reshape(curves%controls, [2*n]) - 1, controls, c%controls)
    if (allocated(curves%tangents)) call copy_reals(reshape(curves%tangents, [4*n]), tangents, c%tangents)
    if (allocated(curves%refs)) call copy_integers(curves%refs, curve_refs, c%curve_refs)
    if (present(point_refs)) then
      if (size(point_refs) /= size(points, 2)) return
      call copy_integers(point_refs, refs, c%point_refs)
    end if
    if (present(imposed)) then
      if (size(imposed) /= size(points, 2)) return
      call copy_integers(imposed, fixed, c%imposed)
    end if
    if (present(sizes)) then
      if (size(sizes) /= size(points, 2)) return
      call copy_reals(sizes, h, c%sizes)
    end if
    if (present(metrics)) then
      if (size(metrics, 1) /= 3 .or. size(metrics, 2) /= size(points, 2)) return
      call copy_reals(reshape(metrics, [size(metrics)]), m, c%metrics)
    end if
    if (present(sides)) then
      if (size(sides, 1) /= 3) return
      c%side_count = size(sides, 2)
      call copy_integers(reshape(sides, [size(sides)]), of_side, c%sides)
      do i = 1, size(of_side) - 1, 3
        of_side(i) = of_side(i) - 1
      end do
    end if
    if (present(seeds) .neqv. present(seed_refs)) return
    if (present(seeds)) then
      if (size(seeds, 1) /= 2 .or. size(seeds, 2) /= size(seed_refs)) return
      c%seed_count = size(seeds, 2)
      call copy_reals(reshape(seeds, [size(seeds)]), at, c%seeds)
      call copy_integers(seed_refs, of_seed, c%seed_refs)
    end if
    status = c_add_plane_domain(session%handle, c)
  end subroutine carreau_add_plane_domain

  !> corner_angle: degrees; left out, polygons stay polygons
  subroutine carreau_load_plane_domain(session, path, status, sizes, corner_angle)
    type(carreau_session), intent(in) :: session
    character(len=*), intent(in) :: path
    integer(c_int32_t), intent(out) :: status
    character(len=*), intent(in), optional :: sizes
    real(c_double), intent(in), optional :: corner_angle
    real(c_double) :: angle
    angle = 0
    if (present(corner_angle)) angle = corner_angle
    if (present(sizes)) then
      status = c_load_plane_domain(session%handle, trim(path)//c_null_char, trim(sizes)//c_null_char, angle)
    else
      status = c_load_plane_domain(session%handle, trim(path)//c_null_char, c_null_char, angle)
    end if
  end subroutine carreau_load_plane_domain

  subroutine carreau_plane_has_sizes(session, answer, status)
    type(carreau_session), intent(in) :: session
    logical, intent(out) :: answer
    integer(c_int32_t), intent(out) :: status
    integer(c_int32_t) :: c
    c = 0
    status = c_plane_has_sizes(session%handle, c)
    answer = c /= 0
  end subroutine carreau_plane_has_sizes

  !> True if the optional arrays of n curves have their sizes.
  function fit_curves(curves, n) result(fit)
    type(carreau_plane_curves), intent(in) :: curves
    integer, intent(in) :: n
    logical :: fit
    fit = .true.
    if (allocated(curves%smooth)) fit = fit .and. size(curves%smooth) == n
    if (allocated(curves%controls)) fit = fit .and. all(shape(curves%controls) == [2, n])
    if (allocated(curves%tangents)) fit = fit .and. all(shape(curves%tangents) == [4, n])
    if (allocated(curves%refs)) fit = fit .and. size(curves%refs) == n
  end function fit_curves

  !> A copy with an address, also when it is empty.
  subroutine copy_integers(values, copy, address)
    integer(c_int32_t), intent(in) :: values(:)
    integer(c_int32_t), allocatable, target, intent(inout) :: copy(:)
    type(c_ptr), intent(inout) :: address
    allocate (copy(size(values) + 1))
    copy(:size(values)) = values
    copy(size(values) + 1) = 0
    address = c_loc(copy(1))
  end subroutine copy_integers

  subroutine copy_reals(values, copy, address)
    real(c_double), intent(in) :: values(:)
    real(c_double), allocatable, target, intent(inout) :: copy(:)
    type(c_ptr), intent(inout) :: address
    allocate (copy(size(values) + 1))
    copy(:size(values)) = values
    copy(size(values) + 1) = 0
    address = c_loc(copy(1))
  end subroutine copy_reals
end module carreau_geometry
