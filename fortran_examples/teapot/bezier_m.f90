! SPDX-License-Identifier: BSD-3-Clause
!> Bicubic Bezier patches read from a file in the BPT layout.
module bezier_m
  implicit none
  private
  public :: read_patches, bezier0, bezier1, bezier2, patch_count

  integer :: patch_count = 0
  double precision, allocatable :: control(:, :, :, :)  ! xyz, column (v), row (u), patch

contains

  subroutine read_patches(name)
    character(*), intent(in) :: name
    integer :: unit, k, i, j, m, n, status
    open(newunit=unit, file=name, status='old', action='read', iostat=status)
    if (status /= 0) then
      write(*, '(3a)') 'cannot open ', name, ': run the program in the folder that holds it'
      stop 1
    end if
    read(unit, *) patch_count
    allocate(control(3, 0:3, 0:3, patch_count))
    do k = 1, patch_count
      read(unit, *) m, n
      do i = 0, 3
        do j = 0, 3
          read(unit, *) control(:, j, i, k)
        end do
      end do
    end do
    close(unit)
  end subroutine read_patches

  !> Bernstein polynomials of degree 3 and their derivatives of order 0, 1 or 2.
  pure function bernstein(t, order) result(b)
    double precision, intent(in) :: t
    integer, intent(in) :: order
    double precision :: b(0:3), s
    s = 1 - t
    select case (order)
    case (0)
      b = [s**3, 3*t*s**2, 3*t**2*s, t**3]
    case (1)
      b = [-3*s**2, 3*s**2 - 6*t*s, 6*t*s - 3*t**2, 3*t**2]
    case default
      b = [6*s, 6*t - 12*s, 6*s - 12*t, 6*t]
    end select
  end function bernstein

  pure function tensor(patch, uv, order_u, order_v) result(x)
    integer, intent(in) :: patch, order_u, order_v
    double precision, intent(in) :: uv(2)
    double precision :: x(3), bu(0:3), bv(0:3)
    integer :: i, j
    bu = bernstein(uv(1), order_u)
    bv = bernstein(uv(2), order_v)
    x = 0
    do i = 0, 3
      do j = 0, 3
        x = x + bu(i) * bv(j) * control(:, j, i, patch)
      end do
    end do
  end function tensor

  subroutine bezier0(patch, uv, S)
    integer, intent(in) :: patch
    double precision, intent(in) :: uv(2)
    double precision, intent(out) :: S(3)
    S = tensor(patch, uv, 0, 0)
  end subroutine bezier0

  subroutine bezier1(patch, uv, Su, Sv)
    integer, intent(in) :: patch
    double precision, intent(in) :: uv(2)
    double precision, intent(out) :: Su(3), Sv(3)
    Su = tensor(patch, uv, 1, 0)
    Sv = tensor(patch, uv, 0, 1)
  end subroutine bezier1

  subroutine bezier2(patch, uv, Suu, Suv, Svv)
    integer, intent(in) :: patch
    double precision, intent(in) :: uv(2)
    double precision, intent(out) :: Suu(3), Suv(3), Svv(3)
    Suu = tensor(patch, uv, 2, 0)
    Suv = tensor(patch, uv, 1, 1)
    Svv = tensor(patch, uv, 0, 2)
  end subroutine bezier2

end module bezier_m
