! SPDX-License-Identifier: BSD-3-Clause
!> The functions and structs of carreau_atlas.h as Fortran sees them. Private to module carreau_atlas.
!! Written by generate.py from carreau_atlas.h: do not edit. After a change of the header:
!!   python3 cabi/fortran/generate.py cabi/include/carreau_atlas.h cabi/fortran/carreau_atlas_c.f90
module carreau_atlas_c
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int32_t, c_int64_t, c_null_funptr, c_null_ptr, &
    c_ptr, c_size_t
  implicit none
  public

  !> Zeros in all members but struct_size are the defaults; NULL in place of the struct is the same.
  type, bind(c) :: c_atlas_options
    integer(c_size_t) :: struct_size = 0
    integer(c_int32_t) :: border = 0, reach = 0
  end type c_atlas_options

  !> The numbers of the charts and other entities of an atlas.
  type, bind(c) :: c_atlas_counts
    integer(c_size_t) :: struct_size = 0
    integer(c_int64_t) :: vertices = 0, triangles = 0, charts = 0, triples = 0, mended = 0
  end type c_atlas_counts

  !> The plane of a chart: its place (x, y) lies at origin + x u + y v.
  type, bind(c) :: c_atlas_chart
    integer(c_size_t) :: struct_size = 0
    real(c_double) :: origin(3) = 0, u(3) = 0, v(3) = 0, normal(3) = 0, period = 0
    integer(c_int64_t) :: vertices = 0
  end type c_atlas_chart

  interface
    !> Creates an empty loop.
    function c_loop_create(loop) result(status) bind(c, name="carreau_loop_create")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), intent(inout) :: loop
      integer(c_int32_t) :: status
    end function c_loop_create

    subroutine c_loop_free(loop) bind(c, name="carreau_loop_free")
      import :: c_ptr
      implicit none
      type(c_ptr), value :: loop
    end subroutine c_loop_free

    !> Returns the sentence of the last call on the loop, "" after success.
    function c_loop_last_error(loop) result(error) bind(c, name="carreau_loop_last_error")
      import :: c_ptr
      implicit none
      type(c_ptr), value :: loop
      type(c_ptr) :: error
    end function c_loop_last_error

    !> Describes a polygon of n vertices (n x 2: x y), counterclockwise, the first one not repeated.
    function c_loop_build(loop, n, xy, speed) result(status) bind(c, name="carreau_loop_build")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: loop
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: xy(*)
      integer(c_int32_t), value :: speed
      integer(c_int32_t) :: status
    end function c_loop_build

    !> Points (n x 2) at n values of phi, which has a period of 2 pi and is 0 at vertex 0, and derivatives by phi (n x
    !! 2; NULL: none).
    function c_loop_points(loop, n, phi, xy, derivatives) result(status) bind(c, name="carreau_loop_points")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: loop
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: phi(*)
      real(c_double), intent(inout) :: xy(*), derivatives(*)
      integer(c_int32_t) :: status
    end function c_loop_points

    !> phi, from 0 to 2 pi, of n points of the loop.
    function c_loop_invert(loop, n, xy, tolerance, phi) result(status) bind(c, name="carreau_loop_invert")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: loop
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: xy(*)
      real(c_double), value :: tolerance
      real(c_double), intent(inout) :: phi(*)
      integer(c_int32_t) :: status
    end function c_loop_invert

    !> The pivots (x y), inside and outside by turns, and their number; capacity 0 requests the number alone.
    function c_loop_pivots(loop, capacity, xy, count) result(status) bind(c, name="carreau_loop_pivots")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: loop
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout) :: xy(*)
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function c_loop_pivots

    !> Creates an empty annulus.
    function c_annulus_create(annulus) result(status) bind(c, name="carreau_annulus_create")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), intent(inout) :: annulus
      integer(c_int32_t) :: status
    end function c_annulus_create

    subroutine c_annulus_free(annulus) bind(c, name="carreau_annulus_free")
      import :: c_ptr
      implicit none
      type(c_ptr), value :: annulus
    end subroutine c_annulus_free

    !> Returns the sentence of the last call on the annulus, "" after success.
    function c_annulus_last_error(annulus) result(error) bind(c, name="carreau_annulus_last_error")
      import :: c_ptr
      implicit none
      type(c_ptr), value :: annulus
      type(c_ptr) :: error
    end function c_annulus_last_error

    !> Describes the annulus between two polygons, both counterclockwise (n x 2, m x 2).
    function c_annulus_build(annulus, n, inner_xy, m, outer_xy, border, star) result(status) &
        bind(c, name="carreau_annulus_build")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: annulus
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: inner_xy(*)
      integer(c_int64_t), value :: m
      real(c_double), intent(in) :: outer_xy(*)
      integer(c_int32_t), value :: border, star
      integer(c_int32_t) :: status
    end function c_annulus_build

    !> Points (n x 2) at n places tau, phi (n x 2), tau from 0 at the inner to 1 at the outer border, phi with a period
    !! of 2 pi; derivatives (n x 4: x, y by tau, then by phi; NULL: none).
    function c_annulus_points(annulus, n, tau_phi, xy, derivatives) result(status) &
        bind(c, name="carreau_annulus_points")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: annulus
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: tau_phi(*)
      real(c_double), intent(inout) :: xy(*), derivatives(*)
      integer(c_int32_t) :: status
    end function c_annulus_points

    !> Zones of n points, and tau, phi (n x 2, phi from 0 to 2 pi) of points in the annulus, 0 for others.
    function c_annulus_invert(annulus, n, xy, tau_phi, zones) result(status) bind(c, name="carreau_annulus_invert")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: annulus
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: xy(*)
      real(c_double), intent(inout) :: tau_phi(*)
      integer(c_int32_t), intent(inout) :: zones(*)
      integer(c_int32_t) :: status
    end function c_annulus_invert

    !> The pivots (x y) of an annulus, and their number; as carreau_loop_pivots.
    function c_annulus_pivots(annulus, capacity, xy, count) result(status) bind(c, name="carreau_annulus_pivots")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: annulus
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout) :: xy(*)
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function c_annulus_pivots

    !> The polygon (x y) that was described as outer border, and the number of its vertices; as carreau_loop_pivots.
    function c_annulus_outer_border(annulus, capacity, xy, count) result(status) &
        bind(c, name="carreau_annulus_outer_border")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: annulus
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout) :: xy(*)
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function c_annulus_outer_border

    !> The edges (x y x y) of the pseudo-skeleton of the inner border, and their number; as carreau_loop_pivots.
    function c_annulus_skeleton(annulus, capacity, edges, count) result(status) bind(c, name="carreau_annulus_skeleton")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: annulus
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout) :: edges(*)
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function c_annulus_skeleton

    !> Writes an OpenEXR file of `width` pixels a row: channels tau and phi (NaN outside of the annulus), and zone
    !! (CARREAU_ZONE_...), over the box of the outer border, y upwards.
    function c_annulus_write_exr(annulus, path, width) result(status) bind(c, name="carreau_annulus_write_exr")
      import :: c_char, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: annulus
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t), value :: width
      integer(c_int32_t) :: status
    end function c_annulus_write_exr

    !> Creates an empty atlas.
    function c_atlas_create(atlas) result(status) bind(c, name="carreau_atlas_create")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), intent(inout) :: atlas
      integer(c_int32_t) :: status
    end function c_atlas_create

    subroutine c_atlas_free(atlas) bind(c, name="carreau_atlas_free")
      import :: c_ptr
      implicit none
      type(c_ptr), value :: atlas
    end subroutine c_atlas_free

    !> Returns the sentence of the last call on the atlas, "" after success.
    function c_atlas_last_error(atlas) result(error) bind(c, name="carreau_atlas_last_error")
      import :: c_ptr
      implicit none
      type(c_ptr), value :: atlas
      type(c_ptr) :: error
    end function c_atlas_last_error

    !> Covers a closed surface of n vertices (n x 3) and m triangles (m x 3, indices from 0, counterclockwise from
    !! outside). clusters: the cluster of each vertex, from 0 without gaps, each a disc; NULL, or -1 at vertex 0: the
    !! library makes them, and divides triangles in four where they are too coarse.
    function c_atlas_build(atlas, options, n, xyz, m, triangles, clusters) result(status) &
        bind(c, name="carreau_atlas_build")
      import :: c_atlas_options, c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: atlas
      type(c_atlas_options), intent(in) :: options
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: xyz(*)
      integer(c_int64_t), value :: m
      integer(c_int32_t), intent(in) :: triangles(*), clusters(*)
      integer(c_int32_t) :: status
    end function c_atlas_build

    !> Count the entities of the atlas, and describe chart `chart`.
    function c_atlas_count(atlas, counts) result(status) bind(c, name="carreau_atlas_count")
      import :: c_atlas_counts, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: atlas
      type(c_atlas_counts), intent(inout) :: counts
      integer(c_int32_t) :: status
    end function c_atlas_count

    function c_atlas_chart_info(atlas, chart, out_chart) result(status) bind(c, name="carreau_atlas_chart_info")
      import :: c_atlas_chart, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: atlas
      integer(c_int64_t), value :: chart
      type(c_atlas_chart), intent(inout) :: out_chart
      integer(c_int32_t) :: status
    end function c_atlas_chart_info

    !> Places (n x 2) of a chart at n places tau, phi of its annulus, which it shares with others.
    function c_atlas_annulus_points(atlas, chart, n, tau_phi, xy) result(status) &
        bind(c, name="carreau_atlas_annulus_points")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: atlas
      integer(c_int64_t), value :: chart, n
      real(c_double), intent(in) :: tau_phi(*)
      real(c_double), intent(inout) :: xy(*)
      integer(c_int32_t) :: status
    end function c_atlas_annulus_points

    !> Zones (CARREAU_ZONE_...) and weights of the chart at n of its places; an array may be NULL.
    function c_atlas_zones(atlas, chart, n, xy, zones, weights) result(status) bind(c, name="carreau_atlas_zones")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: atlas
      integer(c_int64_t), value :: chart, n
      real(c_double), intent(in) :: xy(*)
      integer(c_int32_t), intent(inout) :: zones(*)
      real(c_double), intent(inout) :: weights(*)
      integer(c_int32_t) :: status
    end function c_atlas_zones

    !> Transition from chart i to chart j: places (n x 2) in j of n places of i. out_found: 1 where both charts have the
    !! place, else 0, and the place is left alone.
    function c_atlas_transition(atlas, i, j, n, xy, out_xy, found) result(status) &
        bind(c, name="carreau_atlas_transition")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: atlas
      integer(c_int64_t), value :: i, j, n
      real(c_double), intent(in) :: xy(*)
      real(c_double), intent(inout) :: out_xy(*)
      integer(c_int32_t), intent(inout) :: found(*)
      integer(c_int32_t) :: status
    end function c_atlas_transition

    !> Points (n x 3) of the blended C1 surface at n places of a chart, and derivatives (n x 6: by x, then by y; NULL:
    !! none).
    function c_atlas_points(atlas, chart, n, xy, xyz, derivatives) result(status) bind(c, name="carreau_atlas_points")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: atlas
      integer(c_int64_t), value :: chart, n
      real(c_double), intent(in) :: xy(*)
      real(c_double), intent(inout) :: xyz(*), derivatives(*)
      integer(c_int32_t) :: status
    end function c_atlas_points

    !> Adds the blended surface to a session: chart k is face k + 1.
    function c_add_atlas(session, atlas) result(status) bind(c, name="carreau_add_atlas")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session, atlas
      integer(c_int32_t) :: status
    end function c_add_atlas
  end interface
end module carreau_atlas_c
