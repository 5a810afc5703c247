! SPDX-License-Identifier: BSD-3-Clause
!> The line where the spout of the Utah teapot enters the body. The borders of the body patches are moved there, by splines
!> through points of the intersection (RT-0232 sec. 6.2).
module spout_m
  use bezier_m
  implicit none
  private
  public :: cut_body, cut0, cut1, cut2

  integer, parameter :: n = 16  ! segments of the spline

  !> A cut from the plane y = 0 (t = 0) to the lower border of a body patch (t = 1). It is a cubic Hermite spline through points of
  !> the intersection with its exact tangents.
  type, public :: cut
    double precision :: point(2, 0:n), tangent(2, 0:n)
  end type cut

contains

  !> Intersection of body patch `body` with spout patch `spout`. On the plane y = 0, v of the body is `v_body` and v of the
  !> spout `v_spout`; (u, v_end) of the body and (u_spout, v_spout_end) are near the end on the lower border u = 1.
  function cut_body(body, v_body, v_end, spout, v_spout, v_spout_end) result(c)
    integer, intent(in) :: body, spout
    double precision, intent(in) :: v_body, v_end, v_spout, v_spout_end
    type(cut) :: c
    double precision :: x(4), last, jacobian(3, 4), slope(3)
    integer :: k
    ! The end: u of the body is known, v of the spout is not.
    x = [1.d0, v_end, 0.3d0, v_spout_end]
    call meet(body, spout, [2, 3, 4], x)
    last = x(4)
    do k = n, 0, -1
      x(4) = v_spout + (last - v_spout) * k / n
      call meet(body, spout, [1, 2, 3], x)
      if (k == n) x(1) = 1
      if (k == 0) x(2) = v_body
      c%point(:, k) = x(1:2)
      ! Along the cut: d(body)/dt = d(spout)/dt, and v of the spout is linear in t.
      call difference(body, spout, x, slope, jacobian)
      slope = -jacobian(:, 4) * (last - v_spout)
      slope = solve3(jacobian(:, 1:3), slope)
      c%tangent(:, k) = slope(1:2)
    end do
  end function cut_body

  !> S(body) - S(spout) and its derivatives with respect to x = (u, v of the body; u, v of the spout).
  subroutine difference(body, spout, x, d, jacobian)
    integer, intent(in) :: body, spout
    double precision, intent(in) :: x(4)
    double precision, intent(out) :: d(3), jacobian(3, 4)
    double precision :: on_spout(3)
    call bezier0(body, x(1:2), d)
    call bezier0(spout, x(3:4), on_spout)
    d = d - on_spout
    call bezier1(body, x(1:2), jacobian(:, 1), jacobian(:, 2))
    call bezier1(spout, x(3:4), jacobian(:, 3), jacobian(:, 4))
    jacobian(:, 3:4) = -jacobian(:, 3:4)
  end subroutine difference

  !> Newton's method in the three unknowns x(free), from a start that is near.
  subroutine meet(body, spout, free, x)
    integer, intent(in) :: body, spout, free(3)
    double precision, intent(inout) :: x(4)
    double precision :: d(3), jacobian(3, 4)
    integer :: i
    do i = 1, 50
      call difference(body, spout, x, d, jacobian)
      if (maxval(abs(d)) < 1.d-14) return
      x(free) = x(free) - solve3(jacobian(:, free), d)
    end do
    call difference(body, spout, x, d, jacobian)
    if (maxval(abs(d)) > 1.d-10) stop 'the spout does not meet the body'
  end subroutine meet

  !> Solution of A x = b by Cramer's rule.
  pure function solve3(a, b) result(x)
    double precision, intent(in) :: a(3, 3), b(3)
    double precision :: x(3), m(3, 3)
    integer :: i
    do i = 1, 3
      m = a
      m(:, i) = b
      x(i) = det3(m) / det3(a)
    end do
  end function solve3

  pure function det3(a) result(d)
    double precision, intent(in) :: a(3, 3)
    double precision :: d
    d = a(1, 1) * (a(2, 2) * a(3, 3) - a(3, 2) * a(2, 3)) - a(1, 2) * (a(2, 1) * a(3, 3) - a(3, 1) * a(2, 3)) &
      + a(1, 3) * (a(2, 1) * a(3, 2) - a(3, 1) * a(2, 2))
  end function det3

  !> Point of the cut at t in [0, 1].
  pure function cut0(c, t) result(p)
    type(cut), intent(in) :: c
    double precision, intent(in) :: t
    double precision :: p(2), s
    integer :: k
    call locate(t, k, s)
    p = (2*s**3 - 3*s**2 + 1) * c%point(:, k) + (3*s**2 - 2*s**3) * c%point(:, k + 1) &
      + ((s**3 - 2*s**2 + s) * c%tangent(:, k) + (s**3 - s**2) * c%tangent(:, k + 1)) / n
  end function cut0

  pure function cut1(c, t) result(p)
    type(cut), intent(in) :: c
    double precision, intent(in) :: t
    double precision :: p(2), s
    integer :: k
    call locate(t, k, s)
    p = (6*s**2 - 6*s) * (c%point(:, k) - c%point(:, k + 1)) * n &
      + (3*s**2 - 4*s + 1) * c%tangent(:, k) + (3*s**2 - 2*s) * c%tangent(:, k + 1)
  end function cut1

  pure function cut2(c, t) result(p)
    type(cut), intent(in) :: c
    double precision, intent(in) :: t
    double precision :: p(2), s
    integer :: k
    call locate(t, k, s)
    p = (12*s - 6) * (c%point(:, k) - c%point(:, k + 1)) * n**2 &
      + ((6*s - 4) * c%tangent(:, k) + (6*s - 2) * c%tangent(:, k + 1)) * n
  end function cut2

  !> The segment k that holds t, and s in [0, 1] inside it.
  pure subroutine locate(t, k, s)
    double precision, intent(in) :: t
    integer, intent(out) :: k
    double precision, intent(out) :: s
    k = min(max(int(t * n), 0), n - 1)
    s = t * n - k
  end subroutine locate

end module spout_m
