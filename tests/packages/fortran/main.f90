! SPDX-License-Identifier: BSD-3-Clause
!> A customer's geometry: the unit square in space.
module square
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t
  implicit none
contains

  subroutine surf0(refs, uv, S) bind(c)
    integer(c_int32_t), intent(in) :: refs
    real(c_double), intent(in) :: uv(2)
    real(c_double), intent(out) :: S(3)
    S = [uv(1), uv(2), 2 + 0 * real(refs, c_double)]
  end subroutine surf0

  subroutine curv_int(refs, ic, a, b) bind(c)
    integer(c_int32_t), intent(in) :: refs, ic
    real(c_double), intent(out) :: a, b
    a = 0 * (refs + ic)
    b = 1
  end subroutine curv_int

  !> The four sides, counterclockwise.
  subroutine curv0(refs, ic, t, C) bind(c)
    integer(c_int32_t), intent(in) :: refs, ic
    real(c_double), intent(in) :: t
    real(c_double), intent(out) :: C(2)
    real(c_double), parameter :: from(2, 4) = reshape([0.d0, 0.d0, 1.d0, 0.d0, 1.d0, 1.d0, 0.d0, 1.d0], [2, 4])
    C = from(:, ic) + t * (from(:, modulo(ic, 4) + 1) - from(:, ic)) + 0 * refs
  end subroutine curv0
end module square

program customer
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t
  use carreau
  use square
  implicit none
  type(carreau_session) :: session
  type(carreau_mesh) :: mesh
  type(carreau_quality) :: q
  integer(c_int32_t) :: status, side

  call carreau_session_create(session, status)
  call check
  call carreau_set_cad_m(session, surf0, curv_int, curv0, status)
  call check
  call carreau_model_add_face(session, 1, 1, status)
  call check
  do side = 1, 4
    call carreau_model_add_curve(session, 1, CARREAU_BOUNDARY, side, side, modulo(side, 4) + 1, status)
    call check
  end do
  call carreau_set_real(session, 'hphydef', 0.1_c_double, status)
  call check
  call carreau_mesh_generate(session, status)
  call check
  call carreau_session_mesh(session, mesh, status)
  call check
  call carreau_mesh_quality(mesh, q, status)
  call check
  print '(3a, i0, a, i0, a, f0.12)', 'carreau ', carreau_version(), ': ', q%vertices, ' vertices, ', q%triangles, &
    ' triangles, area ', q%area
  call carreau_session_free(session)
  ! Sides of length 1 with edges of 0.1; a plane square keeps its area; Euler's number of a disc is 1.
  if (q%open_edges /= 40 .or. abs(q%area - 1) > 1d-12 .or. q%vertices - q%edges + q%triangles /= 1) stop 1

contains

  subroutine check
    if (status == CARREAU_OK) return
    print '(a)', carreau_last_error(session)
    stop 1
  end subroutine check
end program customer
