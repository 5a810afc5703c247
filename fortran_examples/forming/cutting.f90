! SPDX-License-Identifier: BSD-3-Clause
!> Orthogonal cutting of HDR sec. 3.4.6: a tool of rake 5 degrees and edge radius .2 mm takes 2 mm off a block. Sizes are
!! from .1 to 10 mm. Usage: forming_cutting [displacement of the tool in mm [name of the files]]
program cutting
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t
  use, intrinsic :: iso_fortran_env, only: error_unit
  use carreau
  use carreau_remeshing
  use tools_m
  use solver_m
  use remeshing_m
  implicit none

  real(dp), parameter :: degree = 3.141592653589793_dp/180, increment = 0.05_dp, width = 44, height = 10, depth = 2
  integer, parameter :: columns = 22, rows = 5
  real(dp) :: last, left, worst, area, before, fallen, x(2, (columns + 1)*(rows + 1))
  integer(c_int32_t) :: t(3, 2*columns*rows), status
  integer :: i, k, v
  character(len=200) :: argument, name
  type(body) :: block
  type(material) :: metal
  type(wedge) :: tool(1)
  type(sizes) :: wanted
  type(carreau_mesh) :: mesh
  type(carreau_remesh_summary) :: told
  type(series) :: files
  type(carreau_quality) :: quality

  last = 4
  name = "cutting"
  if (command_argument_count() > 0) call get_command_argument(1, argument)
  if (command_argument_count() > 0) read (argument, *) last
  if (command_argument_count() > 1) call get_command_argument(2, name)

  do k = 0, rows
    do i = 0, columns
      x(:, k*(columns + 1) + i + 1) = [width*(real(i, dp)/columns - 1), height*(real(k, dp)/rows - 1)]
    end do
  end do
  do k = 0, rows - 1
    do i = 0, columns - 1
      v = k*(columns + 1) + i + 1
      t(:, 2*(k*columns + i) + 1) = [v, v + 1, v + columns + 2]
      t(:, 2*(k*columns + i) + 2) = [v, v + columns + 2, v + columns + 1]
    end do
  end do
  call first_mesh(x, t, block)
  metal%strain_to_failure = 1.2_dp
  metal%friction = 0.1_dp
  metal%critical = 0.45_dp ! voids grow together as in the disc of the Brazilian test
  metal%coalescence = 8
  tool(1) = wedge([0.02_dp, -depth], [cos(8*degree), sin(8*degree)], [sin(5*degree), cos(5*degree)], 0.2_dp, 60._dp)
  tool(1)%velocity = [-0.02_dp*speed_of_sound(metal), 0._dp]
  ! Nodes leave the clearance face by .05 sin 8 degrees an increment: a longer reach would bind them for ever.
  wanted = sizes(h_min=0.1_dp, h_max=10._dp, step=0.05_dp, reach=0.003_dp)
  call carreau_mesh_create(mesh, status)
  call remesh(mesh, block, tool, wanted, told)
  call hold
  call open_series(files, trim(name))
  call add_to_series(files, mesh, block, 0._dp)
  area = told%area
  before = area
  fallen = 0
  worst = 1
  do i = 1, nint(last/increment)
    left = increment/norm2(tool(1)%velocity)
    do while (left > 0)
      call run_increment(block, metal, tool, left, 0.2_dp*wanted%h_min)
      call remesh(mesh, block, tool, wanted, told)
      call hold
      if (told%imposed_vertices > 0) block%self_contact = .true.
      fallen = max(fallen, before - told%area)
      if (before - told%area > 2) &
        print '(a, f6.2, a, f6.2, a)', "the chip breaks at ", i*increment, " mm: ", before - told%area, " mm2 fall"
      before = told%area
      call carreau_mesh_quality(mesh, quality, status)
      worst = min(worst, quality%q2_min)
    end do
    if (mod(i, 4) /= 0) cycle
    call add_to_series(files, mesh, block, i*increment)
    if (mod(i, 20) /= 0 .and. i > 4) cycle
    print '(f6.2, a, i0, a, f6.3, a, f6.3, a, i0, a, f9.3, 2(a, f5.3))', i*increment, " mm: ", told%triangles, &
      " triangles, damage ", maxval(block%damage), ", strain ", maxval(block%plastic), ", bound ", &
      told%bound_vertices, ", area ", told%area, ", Q2 ", quality%q2_mean, ", worst ", quality%q2_min
  end do
  call close_series(files)
  call claim(worst > 0.05_dp, "triangles have a shape")
  call claim(told%bound_vertices >= 1, "the tool touches the block")
  call claim(sum(block%mass) < 1.01_dp*area .and. sum(block%mass) > 0.85_dp*area, "most of the volume is there")
  if (last > 5.9_dp) call claim(fallen > 2, "the chip breaks")
  call carreau_mesh_free(mesh)

contains

  !> The block is clamped below and on the left.
  subroutine hold
    block%fixed = block%x(2, :) < 1e-6_dp - height .or. (block%x(1, :) < 1e-6_dp - width .and. block%x(2, :) < 0.1_dp)
  end subroutine hold

  subroutine claim(holds, sentence)
    logical, intent(in) :: holds
    character(len=*), intent(in) :: sentence
    if (holds) return
    write (error_unit, '(2a)') "this does not hold: ", sentence
    error stop 1
  end subroutine claim
end program cutting
