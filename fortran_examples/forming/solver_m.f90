! SPDX-License-Identifier: BSD-3-Clause
!> A small explicit solver: elasto-plastic plane strain with damage, linear triangles, rigid tools. It is here to show how
!! a host calls carreau_remesh; it is no tool of mechanics.
!!
!! Stresses are rotated with the material (Jaumann) and returned radially to a yield stress that hardens with plastic
!! strain and falls with damage. Pressures follow the mean volume change at nodes, so that triangles do not lock. Damage
!! grows with plastic strain, weighted by the triaxiality as Lemaitre does. The motion is slow beside the speed of sound.
module solver_m
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use tools_m
  implicit none
  private
  public :: body, material, prepare, run_increment, speed_of_sound

  !> MPa, mm; the density only sets the unit of time.
  type :: material
    real(dp) :: young = 70000, poisson = 0.3_dp
    real(dp) :: yield = 150, hardening = 100
    real(dp) :: strain_to_failure = 1       !< plastic strain at which damage is 1 in pure shear
    real(dp) :: least_weight = 0.3_dp       !< of plastic strain under high pressure
    real(dp) :: critical = 1                !< damage from which voids grow together
    real(dp) :: coalescence = 1             !< factor on the growth of damage from there
    integer :: spread = 1                   !< rounds that spread the growth of damage over neighbours
    real(dp) :: friction = 0.2_dp
  end type material

  type :: body
    real(dp), allocatable :: x(:, :), v(:, :)      !< (2, n)
    integer(c_int32_t), allocatable :: t(:, :)     !< (3, m)
    real(dp), allocatable :: stress(:, :)          !< (4, m): xx, yy, zz, xy
    real(dp), allocatable :: plastic(:), damage(:) !< (m)
    integer(c_int32_t), allocatable :: edge(:, :)  !< (2, k): boundary, the body on the left
    integer(c_int32_t), allocatable :: kind(:)     !< (n): CARREAU_NODE_..., after a remeshing
    logical, allocatable :: fixed(:)
    logical :: self_contact = .false.
    real(dp), allocatable :: mass(:)
  end type body

contains

  pure function speed_of_sound(of) result(c)
    type(material), intent(in) :: of
    real(dp) :: c
    c = sqrt(of%young*(1 - of%poisson)/((1 + of%poisson)*(1 - 2*of%poisson)))
  end function speed_of_sound

  !> Masses of a new mesh, for a density of 1.
  subroutine prepare(b)
    type(body), intent(inout) :: b
    real(dp) :: grad(2, 3), area
    integer :: e
    if (allocated(b%mass)) deallocate (b%mass)
    allocate (b%mass(size(b%x, 2)))
    b%mass = 0
    do e = 1, size(b%t, 2)
      call gradients(b, e, grad, area)
      b%mass(b%t(:, e)) = b%mass(b%t(:, e)) + area/3
    end do
  end subroutine prepare

  !> Derivatives of the shape functions of an element.
  subroutine gradients(b, e, grad, area)
    type(body), intent(in) :: b
    integer, intent(in) :: e
    real(dp), intent(out) :: grad(2, 3), area
    real(dp) :: p(2), q(2), r(2)
    p = b%x(:, b%t(1, e))
    q = b%x(:, b%t(2, e))
    r = b%x(:, b%t(3, e))
    area = ((q(1) - p(1))*(r(2) - p(2)) - (q(2) - p(2))*(r(1) - p(1)))/2
    grad(:, 1) = [q(2) - r(2), r(1) - q(1)]/(2*area)
    grad(:, 2) = [r(2) - p(2), p(1) - r(1)]/(2*area)
    grad(:, 3) = [p(2) - q(2), q(1) - p(1)]/(2*area)
  end subroutine gradients

  !> The least altitude of an element with strength.
  function least_altitude(b) result(least)
    type(body), intent(in) :: b
    real(dp) :: least, grad(2, 3), area
    integer :: e, k
    least = huge(least)
    do e = 1, size(b%t, 2)
      if (b%damage(e) >= 1) cycle
      call gradients(b, e, grad, area)
      do k = 1, 3
        least = min(least, 1/norm2(grad(:, k)))
      end do
    end do
  end function least_altitude

  !> Runs until the tools have moved for `left`, or an element has lost its strength or most of its height: then a new mesh
  !! is needed. `left` returns the remaining time.
  subroutine run_increment(b, of, tools, left, least)
    type(body), intent(inout) :: b
    type(material), intent(in) :: of
    type(wedge), intent(inout) :: tools(:)
    real(dp), intent(inout) :: left
    real(dp), intent(in) :: least  !< altitude of an element
    real(dp) :: dt, altitude, time
    integer :: k, broken
    time = left
    broken = count(b%damage >= 1)
    do while (left > 1e-9_dp*time)
      altitude = least_altitude(b)
      if (left < time .and. (altitude < least .or. count(b%damage >= 1) > broken)) return
      dt = 0.4_dp*altitude/speed_of_sound(of)
      dt = left/ceiling(left/dt) ! no last step that is tiny: penalties kick by depth over dt
      call advance(b, of, tools, dt)
      do k = 1, size(tools)
        tools(k)%edge = tools(k)%edge + dt*tools(k)%velocity
      end do
      left = left - dt
      call drop_turned(b)
    end do
    left = 0
  end subroutine run_increment

  !> Elements that have been turned over have no strength left.
  subroutine drop_turned(b)
    type(body), intent(inout) :: b
    real(dp) :: p(2), q(2), r(2)
    integer :: e
    do e = 1, size(b%t, 2)
      p = b%x(:, b%t(1, e))
      q = b%x(:, b%t(2, e)) - p
      r = b%x(:, b%t(3, e)) - p
      if (q(1)*r(2) - q(2)*r(1) <= 0) b%damage(e) = 1
    end do
  end subroutine drop_turned

  subroutine advance(b, of, tools, dt)
    type(body), intent(inout) :: b
    type(material), intent(in) :: of
    type(wedge), intent(in) :: tools(:)
    real(dp), intent(in) :: dt
    real(dp) :: force(2, size(b%x, 2))
    integer :: i
    force = 0
    call stresses(b, of, dt, force)
    do i = 1, size(tools)
      call touch(b, of, tools(i), dt, force)
    end do
    if (b%self_contact) call touch_itself(b, dt, force)
    do i = 1, size(b%x, 2)
      if (b%fixed(i)) then
        b%v(:, i) = 0
        cycle
      end if
      b%v(:, i) = b%v(:, i) + dt*force(:, i)/b%mass(i)
      b%x(:, i) = b%x(:, i) + dt*b%v(:, i)
    end do
  end subroutine advance

  !> Takes means at nodes, by area, and from there in elements. It is its own adjoint, and must be applied both to changes
  !! of volume and to pressures.
  subroutine average(b, area, values)
    type(body), intent(in) :: b
    real(dp), intent(in) :: area(:)
    real(dp), intent(inout) :: values(:)
    real(dp) :: nodal(size(b%x, 2)), weight(size(b%x, 2))
    integer :: e
    nodal = 0
    weight = 0
    do e = 1, size(b%t, 2)
      nodal(b%t(:, e)) = nodal(b%t(:, e)) + area(e)*values(e)
      weight(b%t(:, e)) = weight(b%t(:, e)) + area(e)
    end do
    nodal = nodal/weight
    do e = 1, size(b%t, 2)
      values(e) = sum(nodal(b%t(:, e)))/3
    end do
  end subroutine average

  subroutine stresses(b, of, dt, force)
    type(body), intent(inout) :: b
    type(material), intent(in) :: of
    real(dp), intent(in) :: dt
    real(dp), intent(inout) :: force(:, :)
    real(dp) :: rate(size(b%t, 2)), area(size(b%t, 2)), grad(2, 3, size(b%t, 2))
    real(dp) :: mean(size(b%t, 2)), l(2, 2), s(4), growth(size(b%t, 2))
    integer :: e, k
    do e = 1, size(b%t, 2)
      call gradients(b, e, grad(:, :, e), area(e))
      rate(e) = sum(b%v(:, b%t(:, e))*grad(:, :, e))
    end do
    call average(b, area, rate)
    do e = 1, size(b%t, 2)
      l = matmul(b%v(:, b%t(:, e)), transpose(grad(:, :, e)))
      call update(of, l*dt, rate(e)*dt, b%stress(:, e), b%plastic(e), b%damage(e), growth(e))
      mean(e) = sum(b%stress(1:3, e))/3
    end do
    do k = 1, of%spread
      call average(b, area, growth)
    end do
    where (b%damage < 1) b%damage = b%damage + growth
    where (b%damage >= 0.98_dp) b%damage = 1
    rate = mean
    call average(b, area, rate)
    do e = 1, size(b%t, 2)
      s = b%stress(:, e)
      s(1:3) = s(1:3) + rate(e) - mean(e)
      do k = 1, 3
        force(:, b%t(k, e)) = force(:, b%t(k, e)) - area(e)*[s(1)*grad(1, k, e) + s(4)*grad(2, k, e), &
          s(4)*grad(1, k, e) + s(2)*grad(2, k, e)]
      end do
    end do
  end subroutine stresses

  !> Stress, plastic strain and growth of damage after a small displacement of gradient l and a change of volume.
  subroutine update(of, l, volume, s, plastic, damage, growth)
    type(material), intent(in) :: of
    real(dp), intent(in) :: l(2, 2), volume
    real(dp), intent(inout) :: s(4), plastic
    real(dp), intent(in) :: damage
    real(dp), intent(out) :: growth  !< of damage
    real(dp) :: g, k, spin, mean, dev(4), strain(4), q, limit, more, weight
    growth = 0
    if (damage >= 1) then
      s = 0
      return
    end if
    g = of%young/(2*(1 + of%poisson))
    k = of%young/(3*(1 - 2*of%poisson))
    spin = (l(2, 1) - l(1, 2))/2
    s = s + spin*[-2*s(4), 2*s(4), 0._dp, s(1) - s(2)]
    mean = sum(s(1:3))/3 + k*volume
    dev = s
    dev(1:3) = dev(1:3) - sum(s(1:3))/3
    strain = [l(1, 1), l(2, 2), 0._dp, (l(1, 2) + l(2, 1))/2]
    strain(1:3) = strain(1:3) - (l(1, 1) + l(2, 2))/3
    dev = dev + 2*g*strain
    q = sqrt(1.5_dp*(sum(dev(1:3)**2) + 2*dev(4)**2))
    limit = (1 - damage)*(of%yield + of%hardening*plastic)
    if (q > limit) then
      more = (q - limit)/(3*g + (1 - damage)*of%hardening)
      dev = dev*(1 - 3*g*more/q)
      plastic = plastic + more
      ! Lemaitre: 2/3 (1 + nu) + 3 (1 - 2 nu) (mean / q)**2, less under pressure
      weight = 1
      if (mean > 0) weight = 1 + 3*(1 - 2*of%poisson)/(2*(1 + of%poisson)/3)*min(mean/max(q, 1._dp), 2._dp)**2
      if (mean < 0) weight = max(of%least_weight, 1 + mean/max(limit, 1._dp))
      growth = weight*more/of%strain_to_failure
      if (damage > of%critical) growth = of%coalescence*growth
    end if
    if (mean > 0) mean = min(mean, 3*limit)
    s = dev
    s(1:3) = s(1:3) + mean
  end subroutine update

  !> Penalty: half of the depth goes in a step; friction opposes sliding.
  subroutine touch(b, of, tool, dt, force)
    type(body), intent(in) :: b
    type(material), intent(in) :: of
    type(wedge), intent(in) :: tool
    real(dp), intent(in) :: dt
    real(dp), intent(inout) :: force(:, :)
    real(dp) :: depth, normal(2), push, slip(2), length
    integer :: i, k
    do k = 1, size(b%edge, 2)
      i = b%edge(1, k)
      call depth_in(tool, b%x(:, i), depth, normal)
      if (depth <= 0) cycle
      slip = b%v(:, i) - tool%velocity
      push = b%mass(i)/dt*max(0.5_dp*depth/dt - 0.5_dp*dot_product(slip, normal), 0._dp)
      slip = slip - dot_product(slip, normal)*normal
      length = norm2(slip)
      force(:, i) = force(:, i) + push*normal
      if (length > 0) force(:, i) = force(:, i) - min(of%friction*push, b%mass(i)*length/dt)*slip/length
    end do
  end subroutine touch

  !> Boundary nodes that have passed a boundary edge of another place go back, and the edge the other way.
  subroutine touch_itself(b, dt, force)
    type(body), intent(in) :: b
    real(dp), intent(in) :: dt
    real(dp), intent(inout) :: force(:, :)
    real(dp) :: p(2), d(2), normal(2), along, depth, length, push(2)
    integer :: i, k, n, a, c
    do k = 1, size(b%edge, 2)
      a = b%edge(1, k)
      c = b%edge(2, k)
      d = b%x(:, c) - b%x(:, a)
      length = norm2(d)
      normal = [d(2), -d(1)]/length
      do n = 1, size(b%edge, 2)
        i = b%edge(1, n)
        p = b%x(:, i) - b%x(:, a)
        depth = -dot_product(p, normal)
        if (depth <= 0 .or. depth > 0.2_dp*length) cycle
        along = dot_product(p, d)/length**2
        if (along <= 0 .or. along >= 1 .or. i == a .or. i == c) cycle
        if (is_beside(b, n, a, c)) cycle
        push = 0.1_dp*b%mass(i)*depth/dt**2*normal
        force(:, i) = force(:, i) + push
        force(:, a) = force(:, a) - (1 - along)*push
        force(:, c) = force(:, c) - along*push
      end do
    end do
  end subroutine touch_itself

  !> Is the boundary node of edge n a neighbour of one of two others?
  pure function is_beside(b, n, a, c) result(beside)
    type(body), intent(in) :: b
    integer, intent(in) :: n, a, c
    logical :: beside
    integer :: before
    before = findloc_end(b, b%edge(1, n))
    beside = b%edge(2, n) == a .or. b%edge(2, n) == c .or. before == a .or. before == c
  end function is_beside

  pure function findloc_end(b, node) result(start)
    type(body), intent(in) :: b
    integer(c_int32_t), intent(in) :: node
    integer :: start, k
    start = 0
    do k = 1, size(b%edge, 2)
      if (b%edge(2, k) == node) start = b%edge(1, k)
    end do
  end function findloc_end
end module solver_m
