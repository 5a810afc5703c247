! SPDX-License-Identifier: BSD-3-Clause
!> Rigid tools of the two examples: wedges with a rounded edge, and half planes, which are wedges of 180 degrees.
module tools_m
  use, intrinsic :: iso_c_binding, only: c_double, c_int64_t
  implicit none
  private
  public :: wedge, depth_in, put_tools

  integer, parameter, public :: dp = c_double

  !> The solid lies between the directions `first` and `second` from the edge, counterclockwise, seen from there; the edge
  !! is rounded by an arc.
  type :: wedge
    real(dp) :: edge(2)               !< where the faces would meet without the arc
    real(dp) :: first(2), second(2)   !< unit vectors along the faces
    real(dp) :: radius = 0, length = 0 !< of the arc, of the faces
    real(dp) :: velocity(2) = 0
  end type wedge

contains

  !> How deep p lies in the solid (negative: outside) and the outward normal there. A rounded wedge is a smaller wedge and
  !! all that is within the radius of it.
  subroutine depth_in(tool, p, depth, normal)
    type(wedge), intent(in) :: tool
    real(dp), intent(in) :: p(2)
    real(dp), intent(out) :: depth, normal(2)
    real(dp) :: n1(2), n2(2), d(2), d1, d2, half
    n1 = [tool%first(2), -tool%first(1)]    ! out of the solid
    n2 = [-tool%second(2), tool%second(1)]
    d = p - tool%edge
    half = dot_product(n1, n2)
    if (tool%radius > 0) d = d + tool%radius/(1 + half)*(n1 + n2) ! from the centre of the arc
    d1 = dot_product(d, n1)
    d2 = dot_product(d, n2)
    if (dot_product(d, tool%first) <= 0 .and. dot_product(d, tool%second) <= 0 .and. (d1 > 0 .or. d2 > 0)) then
      normal = d/max(norm2(d), tiny(1._dp))
      depth = tool%radius - norm2(d)
    else if (d1 > d2) then
      normal = n1
      depth = tool%radius - d1
    else
      normal = n2
      depth = tool%radius - d2
    end if
  end subroutine depth_in

  !> The tools in the form of carreau_remesh: polylines with the solid on their left, and radii.
  subroutine put_tools(tools, starts, points, radii)
    type(wedge), intent(in) :: tools(:)
    integer(c_int64_t), allocatable, intent(out) :: starts(:)
    real(dp), allocatable, intent(out) :: points(:, :), radii(:)
    integer :: k
    allocate (starts(size(tools) + 1), points(2, 3*size(tools)), radii(3*size(tools)))
    do k = 1, size(tools)
      starts(k) = 3*k - 2
      points(:, 3*k - 2) = tools(k)%edge + tools(k)%length*tools(k)%second
      points(:, 3*k - 1) = tools(k)%edge
      points(:, 3*k) = tools(k)%edge + tools(k)%length*tools(k)%first
      radii(3*k - 2:3*k) = [0._dp, tools(k)%radius, 0._dp]
    end do
    starts(size(tools) + 1) = 3*size(tools) + 1
  end subroutine put_tools
end module tools_m
