! SPDX-License-Identifier: BSD-3-Clause
!> The Brazilian test of HDR sec. 3.4.6: two planes press a disc of 50 mm. The upper plane moves .1 mm an increment.
!! Sizes are from 1 to 6 mm. Usage: forming_brazilian [displacement of the tool in mm [name of the files]]
program brazilian
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t
  use, intrinsic :: iso_fortran_env, only: error_unit
  use carreau
  use carreau_remeshing
  use tools_m
  use solver_m
  use remeshing_m
  implicit none

  integer, parameter :: around = 26
  real(dp), parameter :: pi = 3.141592653589793_dp, increment = 0.1_dp, far = 200
  real(dp) :: last, x(2, around + 1), least_height
  integer(c_int32_t) :: t(3, around), status
  integer :: i
  character(len=200) :: argument, name
  type(body) :: disc
  type(material) :: metal
  type(wedge) :: tools(2)
  type(sizes) :: wanted
  type(carreau_mesh) :: mesh
  type(carreau_remesh_summary) :: told
  type(series) :: files
  type(carreau_quality) :: quality
  real(dp) :: worst, area, left, across
  logical :: broken
  real(dp) :: halves(20)

  last = 22
  name = "brazilian"
  if (command_argument_count() > 0) call get_command_argument(1, argument)
  if (command_argument_count() > 0) read (argument, *) last
  if (command_argument_count() > 1) call get_command_argument(2, name)

  ! A fan about the centre: the first remeshing makes a mesh of it.
  x(:, around + 1) = [0._dp, 25._dp]
  do i = 1, around
    x(:, i) = x(:, around + 1) + 25*[cos(2*pi*i/around), sin(2*pi*i/around)]
    t(:, i) = [i, mod(i, around) + 1, around + 1]
  end do
  call first_mesh(x, t, disc)
  metal%strain_to_failure = 0.73_dp
  metal%least_weight = 0.6_dp
  metal%hardening = 0
  metal%friction = 0.3_dp
  metal%critical = 0.45_dp
  metal%coalescence = 8
  metal%spread = 0
  tools(1) = wedge([0._dp, 0._dp], [-1._dp, 0._dp], [1._dp, 0._dp], 0._dp, far)
  tools(2) = wedge([0._dp, 50._dp], [1._dp, 0._dp], [-1._dp, 0._dp], 0._dp, far)
  tools(2)%velocity = [0._dp, -0.004_dp*speed_of_sound(metal)]
  wanted = sizes(h_min=1._dp, h_max=6._dp, step=increment, keep_all_parts=.true.)
  call carreau_mesh_create(mesh, status)
  call remesh(mesh, disc, tools, wanted, told)
  ! A little damage in a band decides which of both diagonals of the forging cross breaks.
  do i = 1, size(disc%t, 2)
    across = sum(1.7_dp*disc%x(1, disc%t(:, i)) - disc%x(2, disc%t(:, i)))/3 + 25
    if (abs(across) < 6) disc%damage(i) = 0.1_dp
  end do
  call open_series(files, trim(name))
  call add_to_series(files, mesh, disc, 0._dp)
  area = told%area
  worst = 1
  broken = .false.
  do i = 1, nint(last/increment)
    left = increment/abs(tools(2)%velocity(2))
    do while (left > 0)
      call run_increment(disc, metal, tools, left, 0.2_dp*wanted%h_min)
      call remesh(mesh, disc, tools, wanted, told)
      if (told%imposed_vertices > 0) disc%self_contact = .true.
      call parts_of(mesh, halves)
      broken = minval(halves(:2)) > 0.35_dp*sum(halves) ! splinters do not count
      call carreau_mesh_quality(mesh, quality, status)
      worst = min(worst, quality%q2_min)
    end do
    if (mod(i, 10) /= 0 .and. .not. broken) cycle
    call add_to_series(files, mesh, disc, i*increment)
    print '(f6.2, a, i0, a, f6.3, a, f6.3, a, f5.3, a, i0, a, i0, a, f9.2, a, f5.3)', i*increment, " mm: ", told%triangles, &
      " triangles, damage ", maxval(disc%damage), ", strain ", maxval(disc%plastic), ", Q2 ", quality%q2_mean, &
      ", parts ", told%parts_found, ", bound ", told%bound_vertices, ", area ", told%area, ", worst Q2 ", quality%q2_min
    if (broken) print '(a, f6.2, a, 2f8.1)', "broken at ", i*increment, " mm into halves of", halves(:2)
    if (broken) exit
  end do
  call close_series(files)
  least_height = 50 - min(i*increment, last)
  call claim(broken .or. last < 20, "the disc falls into two halves")
  call claim(maxval(disc%x(2, :)) <= least_height + 0.1_dp .and. minval(disc%x(2, :)) >= -0.1_dp, &
    "the disc lies between the tools")
  call claim(worst > 0.1_dp, "triangles have a shape")
  call claim(told%bound_vertices >= 2, "the tools touch it")
  call claim(sum(disc%mass) < 1.02_dp*area .and. sum(disc%mass) > 0.85_dp*area, "the volume of the disc is nearly kept")
  call carreau_mesh_free(mesh)

contains

  !> Areas of the parts, the largest two first.
  subroutine parts_of(mesh, areas)
    type(carreau_mesh), intent(in) :: mesh
    real(dp), intent(out) :: areas(:)
    integer(c_int32_t), allocatable :: part(:)
    integer(c_int32_t) :: status
    integer :: e, k
    real(dp) :: p(2), q(2), r(2)
    call carreau_mesh_triangle_refs(mesh, part, status)
    areas = 0
    do e = 1, size(part)
      p = disc%x(:, disc%t(1, e))
      q = disc%x(:, disc%t(2, e)) - p
      r = disc%x(:, disc%t(3, e)) - p
      k = min(part(e), size(areas))
      areas(k) = areas(k) + (q(1)*r(2) - q(2)*r(1))/2
    end do
    do k = 1, 2
      e = k - 1 + maxloc(areas(k:), 1)
      areas([k, e]) = areas([e, k])
    end do
  end subroutine parts_of

  subroutine claim(holds, sentence)
    logical, intent(in) :: holds
    character(len=*), intent(in) :: sentence
    if (holds) return
    write (error_unit, '(2a)') "this does not hold: ", sentence
    error stop 1
  end subroutine claim
end program brazilian
