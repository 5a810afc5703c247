! SPDX-License-Identifier: BSD-3-Clause
!> A cylinder of radius 1 and height 3 under a metric: edges of length 0.3 along helices, of 0.03 across them. The metric
!> comes from a callback, as two sizes and a direction in the tangent plane. The program checks the mesh itself: on the
!> unrolled cylinder lengths in the metric are lengths in a plane.
module helix_m
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_ptr
  use carreau
  implicit none
  private
  public :: surface, interval, side, metric, length
  real(c_double), parameter, public :: pi = 3.141592653589793_c_double, height = 3
  real(c_double), parameter, public :: along = 0.3_c_double, across = 0.03_c_double, slope = pi/6
  real(c_double), parameter :: corners(2, 5) = reshape([0._c_double, 0._c_double, 2*pi, 0._c_double, 2*pi, height, &
    0._c_double, height, 0._c_double, 0._c_double], [2, 5])

contains

  function surface(face, u, v, order, S, Su, Sv, Suu, Suv, Svv, user) result(status) bind(c)
    integer(c_int32_t), value :: face, order
    real(c_double), value :: u, v
    real(c_double), intent(inout) :: S(3), Su(3), Sv(3), Suu(3), Suv(3), Svv(3)
    type(c_ptr), value :: user
    integer(c_int32_t) :: status
    S = [cos(u), sin(u), v]
    Su = [-sin(u), cos(u), 0._c_double]
    Sv = [0._c_double, 0._c_double, 1._c_double]
    Suu = [-cos(u), -sin(u), 0._c_double]
    Suv = 0
    Svv = 0
    status = 0
  end function surface

  function interval(face, ic, a, b, user) result(status) bind(c)
    integer(c_int32_t), value :: face, ic
    real(c_double), intent(inout) :: a, b
    type(c_ptr), value :: user
    integer(c_int32_t) :: status
    a = 0
    b = 1
    status = 0
  end function interval

  function side(face, ic, t, order, C, Ct, Ctt, user) result(status) bind(c)
    integer(c_int32_t), value :: face, ic, order
    real(c_double), value :: t
    real(c_double), intent(inout) :: C(2), Ct(2), Ctt(2)
    type(c_ptr), value :: user
    integer(c_int32_t) :: status
    C = (1 - t)*corners(:, ic) + t*corners(:, ic + 1)
    Ct = corners(:, ic + 1) - corners(:, ic)
    Ctt = 0
    status = 0
  end function side

  function metric(face, u, v, kind, value, user) result(status) bind(c)
    integer(c_int32_t), value :: face
    real(c_double), value :: u, v
    integer(c_int32_t), intent(inout) :: kind
    real(c_double), intent(inout) :: value(6)
    type(c_ptr), value :: user
    integer(c_int32_t) :: status
    kind = CARREAU_METRIC_TANGENT
    value(1:2) = [along, across]
    value(3:5) = [-sin(u)*cos(slope), cos(u)*cos(slope), sin(slope)]
    status = 0
  end function metric

  !> Length of a straight edge of the unrolled cylinder.
  function length(d) result(l)
    real(c_double), intent(in) :: d(2)
    real(c_double) :: l
    l = norm2([(cos(slope)*d(1) + sin(slope)*d(2))/along, (cos(slope)*d(2) - sin(slope)*d(1))/across])
  end function length
end module helix_m

program helix
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t
  use, intrinsic :: iso_fortran_env, only: error_unit
  use carreau
  use helix_m
  implicit none
  type(carreau_session) :: session
  type(carreau_mesh) :: mesh
  type(carreau_quality) :: quality
  integer(c_int32_t) :: status
  integer :: ic
  integer(c_int32_t), parameter :: refs(4) = [1, 2, 3, 2], ends(2, 4) = reshape([1, 1, 1, 2, 2, 2, 2, 1], [2, 4])

  call carreau_session_create(session, status)
  call stop_unless_fine
  call carreau_set_cad(session, surface, interval, side, status)
  call stop_unless_fine
  call carreau_set_metric_callbacks(session, status, surface_metric=metric)
  call stop_unless_fine
  call carreau_model_add_face(session, 1_c_int32_t, 1_c_int32_t, status)
  do ic = 1, 4 ! the sides u = 0 and u = 2 pi are one curve of space
    call carreau_model_add_curve(session, 1_c_int32_t, CARREAU_BOUNDARY, refs(ic), ends(1, ic), ends(2, ic), status)
    call stop_unless_fine
  end do
  call carreau_set_real(session, "hphymin", 0.01_c_double, status)
  call carreau_mesh_generate(session, status)
  call stop_unless_fine
  call carreau_session_mesh(session, mesh, status)
  call carreau_mesh_write(mesh, "helix.mesh", status)
  call stop_unless_fine
  call carreau_mesh_quality(mesh, quality, status)
  call check
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

  subroutine check
    real(c_double), allocatable :: uv(:, :, :)
    real(c_double) :: l, total, expected
    integer(c_int64_t) :: t, sides, in_range
    integer :: i
    call carreau_mesh_corner_uv(mesh, uv, status)
    call stop_unless_fine
    sides = 3*size(uv, 3)
    total = 0
    in_range = 0
    do t = 1, size(uv, 3)
      do i = 1, 3
        l = length(uv(:, mod(i, 3) + 1, t) - uv(:, i, t))
        total = total + l
        if (l >= sqrt(0.5_c_double) .and. l <= sqrt(2._c_double)) in_range = in_range + 1
      end do
    end do
    print '(i0, a, f7.4, a, f8.3, a)', sides/3, " triangles; length in the metric: mean", total/sides, ", ", &
      100._c_double*in_range/sides, " % between 1/sqrt(2) and sqrt(2)"
    print '(a, f7.4)', "shape quality in space, which the metric forbids to be good: mean", quality%q2_mean
    ! Triangles of unit edges have the area sqrt(3) / 4 in the metric.
    expected = 2*pi*height/(along*across*sqrt(3._c_double)/4)
    call claim(abs(sides/3 - expected) <= 0.05*expected, "the metric determines the number of triangles within 5 %")
    call claim(abs(total/sides - 1) <= 0.02, "the mean length in the metric is 1 within 2 %")
    call claim(in_range >= 0.97*sides, "97 % of the lengths are between 1/sqrt(2) and sqrt(2)")
    call claim(quality%q2_mean < 0.5, "triangles are stretched")
  end subroutine check
end program helix
