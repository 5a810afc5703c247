! SPDX-License-Identifier: BSD-3-Clause
!> Fortran 2003 face of cabi/include/carreau_atlas.h: loops and annuli of the plane with smooth parameters, and C1 atlases
!! of triangulated surfaces. That header documents the meaning and errors of each routine. Different here: vertices, clusters
!! and charts count from 1.
module carreau_atlas
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t, c_null_ptr, c_null_char, c_ptr
  use carreau, only: carreau_session, carreau_string, CARREAU_ERR_ARGUMENT
  use carreau_atlas_c
  implicit none
  private

  public :: carreau_loop_create, carreau_loop_free, carreau_loop_last_error, carreau_loop_build, carreau_loop_points
  public :: carreau_loop_invert, carreau_loop_pivots
  public :: carreau_annulus_create, carreau_annulus_free, carreau_annulus_last_error, carreau_annulus_build
  public :: carreau_annulus_points, carreau_annulus_invert, carreau_annulus_pivots, carreau_annulus_outer_border
  public :: carreau_annulus_skeleton, carreau_annulus_write_exr
  public :: carreau_atlas_create, carreau_atlas_free, carreau_atlas_last_error, carreau_atlas_build, carreau_atlas_count
  public :: carreau_atlas_chart_info, carreau_atlas_annulus_points, carreau_atlas_zones, carreau_atlas_transition
  public :: carreau_atlas_points, carreau_add_atlas

  integer(c_int32_t), parameter, public :: CARREAU_LOOP_EVEN = 0, CARREAU_LOOP_SMOOTH = 1
  integer(c_int32_t), parameter, public :: CARREAU_BORDER_SPLINE = 0, CARREAU_BORDER_CUBIC = 1, CARREAU_BORDER_POLYGON = 2, &
    CARREAU_BORDER_OUTER_SPLINE = 3, CARREAU_BORDER_OUTER_CUBIC = 4
  integer(c_int32_t), parameter, public :: CARREAU_ZONE_OUTSIDE = 0, CARREAU_ZONE_ANNULUS = 1, CARREAU_ZONE_INSIDE = 2

  type, public :: carreau_loop
    private
    type(c_ptr) :: handle = c_null_ptr
  end type carreau_loop
  type, public :: carreau_annulus
    private
    type(c_ptr) :: handle = c_null_ptr
  end type carreau_annulus
  !> Charts of a closed triangulated surface: carreau_atlas of C, a name that the module has.
  type, public :: carreau_atlas_handle
    private
    type(c_ptr) :: handle = c_null_ptr
  end type carreau_atlas_handle

  type, public :: carreau_atlas_counts
    integer(c_int64_t) :: vertices, triangles, charts, triples, mended
  end type carreau_atlas_counts
  type, public :: carreau_atlas_chart
    real(c_double) :: origin(3), u(3), v(3), normal(3), period
    integer(c_int64_t) :: vertices
  end type carreau_atlas_chart

contains

  subroutine carreau_loop_create(loop, status)
    type(carreau_loop), intent(inout) :: loop
    integer(c_int32_t), intent(out) :: status
    status = c_loop_create(loop%handle)
  end subroutine carreau_loop_create

  subroutine carreau_loop_free(loop)
    type(carreau_loop), intent(inout) :: loop
    call c_loop_free(loop%handle)
    loop%handle = c_null_ptr
  end subroutine carreau_loop_free

  function carreau_loop_last_error(loop) result(sentence)
    type(carreau_loop), intent(in) :: loop
    character(len=:), allocatable :: sentence
    sentence = carreau_string(c_loop_last_error(loop%handle))
  end function carreau_loop_last_error

  subroutine carreau_annulus_create(annulus, status)
    type(carreau_annulus), intent(inout) :: annulus
    integer(c_int32_t), intent(out) :: status
    status = c_annulus_create(annulus%handle)
  end subroutine carreau_annulus_create

  subroutine carreau_annulus_free(annulus)
    type(carreau_annulus), intent(inout) :: annulus
    call c_annulus_free(annulus%handle)
    annulus%handle = c_null_ptr
  end subroutine carreau_annulus_free

  function carreau_annulus_last_error(annulus) result(sentence)
    type(carreau_annulus), intent(in) :: annulus
    character(len=:), allocatable :: sentence
    sentence = carreau_string(c_annulus_last_error(annulus%handle))
  end function carreau_annulus_last_error

  subroutine carreau_atlas_create(atlas, status)
    type(carreau_atlas_handle), intent(inout) :: atlas
    integer(c_int32_t), intent(out) :: status
    status = c_atlas_create(atlas%handle)
  end subroutine carreau_atlas_create

  subroutine carreau_atlas_free(atlas)
    type(carreau_atlas_handle), intent(inout) :: atlas
    call c_atlas_free(atlas%handle)
    atlas%handle = c_null_ptr
  end subroutine carreau_atlas_free

  function carreau_atlas_last_error(atlas) result(sentence)
    type(carreau_atlas_handle), intent(in) :: atlas
    character(len=:), allocatable :: sentence
    sentence = carreau_string(c_atlas_last_error(atlas%handle))
  end function carreau_atlas_last_error

  !> pivots(2, :)
  subroutine carreau_loop_pivots(loop, pivots, status)
    type(carreau_loop), intent(in) :: loop
    real(c_double), allocatable, intent(out) :: pivots(:, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: n
    n = 0
    allocate (pivots(2, 1))
    status = c_loop_pivots(loop%handle, 0_c_int64_t, pivots, n)
    deallocate (pivots)
    allocate (pivots(2, int(n)))
    if (n > 0) status = c_loop_pivots(loop%handle, n, pivots, n)
  end subroutine carreau_loop_pivots

  !> pivots(2, :)
  subroutine carreau_annulus_pivots(annulus, pivots, status)
    type(carreau_annulus), intent(in) :: annulus
    real(c_double), allocatable, intent(out) :: pivots(:, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: n
    n = 0
    allocate (pivots(2, 1))
    status = c_annulus_pivots(annulus%handle, 0_c_int64_t, pivots, n)
    deallocate (pivots)
    allocate (pivots(2, int(n)))
    if (n > 0) status = c_annulus_pivots(annulus%handle, n, pivots, n)
  end subroutine carreau_annulus_pivots

  !> polygon(2, :)
  subroutine carreau_annulus_outer_border(annulus, polygon, status)
    type(carreau_annulus), intent(in) :: annulus
    real(c_double), allocatable, intent(out) :: polygon(:, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: n
    n = 0
    allocate (polygon(2, 1))
    status = c_annulus_outer_border(annulus%handle, 0_c_int64_t, polygon, n)
    deallocate (polygon)
    allocate (polygon(2, int(n)))
    if (n > 0) status = c_annulus_outer_border(annulus%handle, n, polygon, n)
  end subroutine carreau_annulus_outer_border

  !> edges(4, :)
  subroutine carreau_annulus_skeleton(annulus, edges, status)
    type(carreau_annulus), intent(in) :: annulus
    real(c_double), allocatable, intent(out) :: edges(:, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: n
    n = 0
    allocate (edges(4, 1))
    status = c_annulus_skeleton(annulus%handle, 0_c_int64_t, edges, n)
    deallocate (edges)
    allocate (edges(4, int(n)))
    if (n > 0) status = c_annulus_skeleton(annulus%handle, n, edges, n)
  end subroutine carreau_annulus_skeleton

  !> xy(2, n)
  subroutine carreau_loop_build(loop, xy, speed, status)
    type(carreau_loop), intent(in) :: loop
    real(c_double), intent(in) :: xy(:, :)
    integer(c_int32_t), intent(in) :: speed
    integer(c_int32_t), intent(out) :: status
    status = CARREAU_ERR_ARGUMENT
    if (size(xy, 1) /= 2) return
    status = c_loop_build(loop%handle, size(xy, 2, c_int64_t), xy, speed)
  end subroutine carreau_loop_build

  !> xy(2, n), derivatives(2, n) at phi(n)
  subroutine carreau_loop_points(loop, phi, xy, derivatives, status)
    type(carreau_loop), intent(in) :: loop
    real(c_double), intent(in) :: phi(:)
    real(c_double), intent(out) :: xy(2, size(phi)), derivatives(2, size(phi))
    integer(c_int32_t), intent(out) :: status
    xy = 0
    derivatives = 0
    status = c_loop_points(loop%handle, size(phi, kind=c_int64_t), phi, xy, derivatives)
  end subroutine carreau_loop_points

  !> phi(n) of xy(2, n)
  subroutine carreau_loop_invert(loop, xy, tolerance, phi, status)
    type(carreau_loop), intent(in) :: loop
    real(c_double), intent(in) :: xy(:, :), tolerance
    real(c_double), intent(out) :: phi(size(xy, 2))
    integer(c_int32_t), intent(out) :: status
    phi = 0
    status = CARREAU_ERR_ARGUMENT
    if (size(xy, 1) /= 2) return
    status = c_loop_invert(loop%handle, size(xy, 2, c_int64_t), xy, tolerance, phi)
  end subroutine carreau_loop_invert

  !> inner(2, n), outer(2, m)
  subroutine carreau_annulus_build(annulus, inner, outer, border, star, status)
    type(carreau_annulus), intent(in) :: annulus
    real(c_double), intent(in) :: inner(:, :), outer(:, :)
    integer(c_int32_t), intent(in) :: border
    logical, intent(in) :: star
    integer(c_int32_t), intent(out) :: status
    status = CARREAU_ERR_ARGUMENT
    if (size(inner, 1) /= 2 .or. size(outer, 1) /= 2) return
    status = c_annulus_build(annulus%handle, size(inner, 2, c_int64_t), inner, size(outer, 2, c_int64_t), outer, border, &
      merge(1_c_int32_t, 0_c_int32_t, star))
  end subroutine carreau_annulus_build

  !> xy(2, n), derivatives(4, n) at tau_phi(2, n)
  subroutine carreau_annulus_points(annulus, tau_phi, xy, derivatives, status)
    type(carreau_annulus), intent(in) :: annulus
    real(c_double), intent(in) :: tau_phi(:, :)
    real(c_double), intent(out) :: xy(2, size(tau_phi, 2)), derivatives(4, size(tau_phi, 2))
    integer(c_int32_t), intent(out) :: status
    xy = 0
    derivatives = 0
    status = CARREAU_ERR_ARGUMENT
    if (size(tau_phi, 1) /= 2) return
    status = c_annulus_points(annulus%handle, size(tau_phi, 2, c_int64_t), tau_phi, xy, derivatives)
  end subroutine carreau_annulus_points

  !> tau_phi(2, n) and zones(n) of xy(2, n)
  subroutine carreau_annulus_invert(annulus, xy, tau_phi, zones, status)
    type(carreau_annulus), intent(in) :: annulus
    real(c_double), intent(in) :: xy(:, :)
    real(c_double), intent(out) :: tau_phi(2, size(xy, 2))
    integer(c_int32_t), intent(out) :: zones(size(xy, 2)), status
    tau_phi = 0
    zones = 0
    status = CARREAU_ERR_ARGUMENT
    if (size(xy, 1) /= 2) return
    status = c_annulus_invert(annulus%handle, size(xy, 2, c_int64_t), xy, tau_phi, zones)
  end subroutine carreau_annulus_invert

  subroutine carreau_annulus_write_exr(annulus, path, width, status)
    type(carreau_annulus), intent(in) :: annulus
    character(len=*), intent(in) :: path
    integer(c_int32_t), intent(in) :: width
    integer(c_int32_t), intent(out) :: status
    status = c_annulus_write_exr(annulus%handle, trim(path)//c_null_char, width)
  end subroutine carreau_annulus_write_exr

  !> xyz(3, n), triangles(3, m), clusters(n); without clusters the library makes them. reach: of those, in edges.
  subroutine carreau_atlas_build(atlas, xyz, triangles, status, clusters, border, reach)
    type(carreau_atlas_handle), intent(in) :: atlas
    real(c_double), intent(in) :: xyz(:, :)
    integer(c_int32_t), intent(in) :: triangles(:, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int32_t), intent(in), optional :: clusters(:), border, reach
    type(c_atlas_options) :: options
    integer(c_int32_t), allocatable :: from_0(:)
    status = CARREAU_ERR_ARGUMENT
    if (size(xyz, 1) /= 3 .or. size(triangles, 1) /= 3) return
    options%struct_size = size(transfer(options, [c_null_char]))
    if (present(border)) options%border = border
    if (present(reach)) options%reach = reach
    allocate (from_0(max(size(xyz, 2), 1)))
    from_0 = -1
    if (present(clusters)) then
      if (size(clusters) /= size(xyz, 2) .or. any(clusters < 1)) return
      from_0 = clusters - 1
    end if
    status = c_atlas_build(atlas%handle, options, size(xyz, 2, c_int64_t), xyz, size(triangles, 2, c_int64_t), triangles - 1, &
      from_0)
  end subroutine carreau_atlas_build

  subroutine carreau_atlas_count(atlas, counts, status)
    type(carreau_atlas_handle), intent(in) :: atlas
    type(carreau_atlas_counts), intent(out) :: counts
    integer(c_int32_t), intent(out) :: status
    type(c_atlas_counts) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    status = c_atlas_count(atlas%handle, c)
    counts = carreau_atlas_counts(c%vertices, c%triangles, c%charts, c%triples, c%mended)
  end subroutine carreau_atlas_count

  subroutine carreau_atlas_chart_info(atlas, chart, info, status)
    type(carreau_atlas_handle), intent(in) :: atlas
    integer(c_int64_t), intent(in) :: chart
    type(carreau_atlas_chart), intent(out) :: info
    integer(c_int32_t), intent(out) :: status
    type(c_atlas_chart) :: c
    c%struct_size = size(transfer(c, [c_null_char]))
    status = c_atlas_chart_info(atlas%handle, chart - 1, c)
    info = carreau_atlas_chart(c%origin, c%u, c%v, c%normal, c%period, c%vertices)
  end subroutine carreau_atlas_chart_info

  !> xy(2, n) at tau_phi(2, n)
  subroutine carreau_atlas_annulus_points(atlas, chart, tau_phi, xy, status)
    type(carreau_atlas_handle), intent(in) :: atlas
    integer(c_int64_t), intent(in) :: chart
    real(c_double), intent(in) :: tau_phi(:, :)
    real(c_double), intent(out) :: xy(2, size(tau_phi, 2))
    integer(c_int32_t), intent(out) :: status
    xy = 0
    status = CARREAU_ERR_ARGUMENT
    if (size(tau_phi, 1) /= 2) return
    status = c_atlas_annulus_points(atlas%handle, chart - 1, size(tau_phi, 2, c_int64_t), tau_phi, xy)
  end subroutine carreau_atlas_annulus_points

  !> zones(n) and weights(n) at xy(2, n)
  subroutine carreau_atlas_zones(atlas, chart, xy, zones, weights, status)
    type(carreau_atlas_handle), intent(in) :: atlas
    integer(c_int64_t), intent(in) :: chart
    real(c_double), intent(in) :: xy(:, :)
    integer(c_int32_t), intent(out) :: zones(size(xy, 2)), status
    real(c_double), intent(out) :: weights(size(xy, 2))
    zones = 0
    weights = 0
    status = CARREAU_ERR_ARGUMENT
    if (size(xy, 1) /= 2) return
    status = c_atlas_zones(atlas%handle, chart - 1, size(xy, 2, c_int64_t), xy, zones, weights)
  end subroutine carreau_atlas_zones

  !> xy_j(2, n) of xy(2, n); found(n)
  subroutine carreau_atlas_transition(atlas, i, j, xy, xy_j, found, status)
    type(carreau_atlas_handle), intent(in) :: atlas
    integer(c_int64_t), intent(in) :: i, j
    real(c_double), intent(in) :: xy(:, :)
    real(c_double), intent(out) :: xy_j(2, size(xy, 2))
    logical, intent(out) :: found(size(xy, 2))
    integer(c_int32_t), intent(out) :: status
    integer(c_int32_t) :: c_found(size(xy, 2))
    xy_j = 0
    c_found = 0
    found = .false.
    status = CARREAU_ERR_ARGUMENT
    if (size(xy, 1) /= 2) return
    status = c_atlas_transition(atlas%handle, i - 1, j - 1, size(xy, 2, c_int64_t), xy, xy_j, c_found)
    found = c_found /= 0
  end subroutine carreau_atlas_transition

  !> xyz(3, n), derivatives(6, n) at xy(2, n)
  subroutine carreau_atlas_points(atlas, chart, xy, xyz, derivatives, status)
    type(carreau_atlas_handle), intent(in) :: atlas
    integer(c_int64_t), intent(in) :: chart
    real(c_double), intent(in) :: xy(:, :)
    real(c_double), intent(out) :: xyz(3, size(xy, 2)), derivatives(6, size(xy, 2))
    integer(c_int32_t), intent(out) :: status
    xyz = 0
    derivatives = 0
    status = CARREAU_ERR_ARGUMENT
    if (size(xy, 1) /= 2) return
    status = c_atlas_points(atlas%handle, chart - 1, size(xy, 2, c_int64_t), xy, xyz, derivatives)
  end subroutine carreau_atlas_points

  subroutine carreau_add_atlas(session, atlas, status)
    type(carreau_session), intent(in) :: session
    type(carreau_atlas_handle), intent(in) :: atlas
    integer(c_int32_t), intent(out) :: status
    status = c_add_atlas(session%handle, atlas%handle)
  end subroutine carreau_add_atlas
end module carreau_atlas
