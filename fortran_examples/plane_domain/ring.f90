! SPDX-License-Identifier: BSD-3-Clause
!> A plane domain from arrays, without any callback: the square [-3, 3] x [-2, 2] with two circles of radius 1, splines
!> through 32 points. The left disc is a hole; the right one is a subdomain of reference 7, with other sizes.
program ring
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t
  use, intrinsic :: iso_fortran_env, only: error_unit
  use carreau
  use carreau_geometry
  implicit none

  integer, parameter :: n = 32
  real(c_double), parameter :: pi = 3.141592653589793_c_double
  real(c_double) :: points(2, 4 + 2*n), sizes(4 + 2*n), angle, expected
  integer(c_int32_t) :: status, i
  integer(c_int32_t), allocatable :: refs(:)
  type(carreau_session) :: session
  type(carreau_mesh) :: mesh
  type(carreau_quality) :: quality
  type(carreau_plane_curves) :: curves

  points(:, 1:4) = reshape([-3._c_double, -2._c_double, 3._c_double, -2._c_double, 3._c_double, 2._c_double, &
    -3._c_double, 2._c_double], [2, 4])
  do i = 1, n
    angle = 2*pi*(i - 1)/n
    points(:, 4 + i) = [-1.5_c_double + cos(angle), sin(angle)]
    points(:, 4 + n + i) = [1.5_c_double + cos(angle), sin(angle)]
  end do
  sizes(:4 + n) = 0.2_c_double
  sizes(5 + n:) = 0.05_c_double
  curves%points = [integer(c_int32_t) :: 1, 2, 3, 4, 1, (4 + i, i=1, n), 5, (4 + n + i, i=1, n), 5 + n]
  curves%starts = [integer(c_int32_t) :: 1, 6, 7 + n, 8 + 2*n]
  curves%smooth = [integer(c_int32_t) :: 0, 1, 1]

  call carreau_session_create(session, status)
  call carreau_add_plane_domain(session, points, curves, status, rest=CARREAU_REST_OUTSIDE, sizes=sizes, &
    sides=reshape([integer(c_int32_t) :: 1, 1, 3, 3, 1, 7], [3, 2]))
  call stop_unless_fine
  call carreau_set_integer(session, "hphy_flag", 2_c_int32_t, status)
  call carreau_set_real(session, "hphymin", 1e-3_c_double, status)
  call carreau_mesh_generate(session, status)
  call stop_unless_fine
  call carreau_session_mesh(session, mesh, status)
  call carreau_mesh_write(mesh, "ring.mesh", status)
  call carreau_mesh_write(mesh, "ring.bl2d", status)
  call stop_unless_fine
  call carreau_mesh_quality(mesh, quality, status)
  call carreau_mesh_triangle_refs(mesh, refs, status)
  call stop_unless_fine
  print '(i0, a, i0, a, f8.5, a, f7.4)', quality%triangles, " triangles, ", count(refs == 7), " of them in the right disc; area ", &
    quality%area, ", mean Q2 ", quality%q2_mean
  expected = 24 - pi ! a polygon in each circle: edges of .05 and .2 leave .04 % and .6 % of its area out
  call claim(abs(quality%area - expected) <= 0.02*pi, "the area agrees with the square without one disc")
  call claim(all(refs == 3 .or. refs == 7), "triangles have the references of the subdomains")
  call claim(abs(count(refs == 7)*sqrt(3._c_double)/4*0.05_c_double**2 - pi) <= 0.15*pi, &
    "triangles of size .05 fill the right disc")
  call claim(quality%q2_min > 0.5 .and. quality%q2_mean > 0.9, "triangles have a shape")
  call expect_refusal
  call carreau_session_free(session)

contains

  subroutine stop_unless_fine
    if (status == CARREAU_OK) return
    write (error_unit, '(a)') carreau_last_error(session)
    error stop
  end subroutine stop_unless_fine

  subroutine claim(holds, sentence)
    logical, intent(in) :: holds
    character(len=*), intent(in) :: sentence
    if (holds) return
    write (error_unit, '(2a)') "this does not hold: ", sentence
    error stop
  end subroutine claim

  !> The outer side of the square is no domain.
  subroutine expect_refusal
    call carreau_model_clear(session, status)
    call carreau_add_plane_domain(session, points, curves, status, rest=CARREAU_REST_OUTSIDE, &
      sides=reshape([integer(c_int32_t) :: 1, -1, 3], [3, 1]))
    call claim(status == CARREAU_ERR_MODEL, "the outer side of a square is rejected")
    call claim(index(carreau_last_error(session), "it would be unbounded") > 0, "the sentence gives the reason")
  end subroutine expect_refusal
end program ring
