! SPDX-License-Identifier: BSD-3-Clause
!> From the solver's state to carreau_remesh and back, and a series of files for ParaView.
module remeshing_m
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t
  use, intrinsic :: iso_fortran_env, only: error_unit
  use carreau
  use carreau_remeshing
  use tools_m
  use solver_m
  implicit none
  private
  public :: sizes, remesh, first_mesh, series, open_series, add_to_series, close_series

  type :: sizes
    real(dp) :: h_min, h_max, step
    real(dp) :: reach = -1
    logical :: keep_all_parts = .false.
    integer :: smoothing = 2
  end type sizes

  type :: series
    integer :: unit = -1, count = 0
    character(len=:), allocatable :: name
  end type series

contains

  subroutine stop_at(mesh, status)
    type(carreau_mesh), intent(in) :: mesh
    integer(c_int32_t), intent(in) :: status
    if (status == CARREAU_OK) return
    write (error_unit, '(a)') carreau_mesh_last_error(mesh)
    error stop 1
  end subroutine stop_at

  !> A body without history from vertices and triangles.
  subroutine first_mesh(x, t, b)
    real(dp), intent(in) :: x(:, :)
    integer(c_int32_t), intent(in) :: t(:, :)
    type(body), intent(out) :: b
    allocate (b%x(2, size(x, 2)), b%v(2, size(x, 2)), b%t(3, size(t, 2)), b%stress(4, size(t, 2)))
    allocate (b%plastic(size(t, 2)), b%damage(size(t, 2)), b%fixed(size(x, 2)), b%edge(2, 0))
    b%x = x
    b%t = t
    b%v = 0
    b%stress = 0
    b%plastic = 0
    b%damage = 0
    b%fixed = .false.
  end subroutine first_mesh

  !> The state of the body on a new mesh. Velocities are nodal; stresses and plastic strain are means.
  subroutine remesh(mesh, b, tools, wanted, told)
    type(carreau_mesh), intent(in) :: mesh
    type(body), intent(inout) :: b
    type(wedge), intent(in) :: tools(:)
    type(sizes), intent(in) :: wanted
    type(carreau_remesh_summary), intent(out) :: told
    type(carreau_remesh_input) :: input
    type(carreau_remesh_options) :: options
    real(dp), allocatable :: xyz(:, :), values(:, :)
    integer(c_int32_t) :: status
    input%vertices = b%x
    input%triangles = b%t
    input%damage = b%damage
    if (allocated(b%kind)) input%vertex_kinds = b%kind
    input%nodal_values = b%v
    allocate (input%element_values(5, size(b%t, 2)))
    input%element_values(1:4, :) = b%stress
    input%element_values(5, :) = b%plastic
    call put_tools(tools, input%tool_starts, input%tool_points, input%tool_radii)
    options%h_min = wanted%h_min
    options%h_max = wanted%h_max
    options%step = wanted%step
    options%reach = wanted%reach
    options%keep_all_parts = wanted%keep_all_parts
    options%remove_overlaps = .true.
    options%imposed_smoothing = wanted%smoothing
    call carreau_remesh(mesh, input, options, status, told)
    call stop_at(mesh, status)
    call carreau_mesh_vertices(mesh, xyz, status)
    b%x = xyz(1:2, :)
    call carreau_mesh_triangles(mesh, b%t, status)
    call carreau_mesh_edges(mesh, b%edge, status)
    call carreau_mesh_vertex_refs(mesh, b%kind, status) ! faces that are laid bare stay imposed
    call carreau_remesh_nodal_values(mesh, 2, b%v, status)
    call carreau_remesh_element_values(mesh, 5, values, status)
    b%stress = values(1:4, :)
    b%plastic = values(5, :)
    call carreau_remesh_damage(mesh, b%damage, status)
    call stop_at(mesh, status)
    b%fixed = [(.false., status=1, size(b%x, 2))]
    call prepare(b)
  end subroutine remesh

  subroutine open_series(files, name)
    type(series), intent(out) :: files
    character(len=*), intent(in) :: name
    files%name = name
    open (newunit=files%unit, file=name//".pvd", status="replace", action="write")
    write (files%unit, '(a)') '<?xml version="1.0"?>', '<VTKFile type="Collection" version="0.1">', '<Collection>'
  end subroutine open_series

  !> Writes the mesh with the state of the body, at a displacement of the tool.
  subroutine add_to_series(files, mesh, b, moved)
    type(series), intent(inout) :: files
    type(carreau_mesh), intent(in) :: mesh
    type(body), intent(in) :: b
    real(dp), intent(in) :: moved
    character(len=8) :: rank
    character(len=:), allocatable :: path
    integer(c_int32_t) :: status
    write (rank, '(i4.4)') files%count
    files%count = files%count + 1
    path = files%name//"_"//trim(rank)//".vtu"
    call carreau_mesh_add_field(mesh, "damage", .false., reshape(b%damage, [1, size(b%damage)]), status)
    call carreau_mesh_add_field(mesh, "plastic strain", .false., reshape(b%plastic, [1, size(b%plastic)]), status)
    call carreau_mesh_add_field(mesh, "stress", .false., b%stress, status)
    call carreau_mesh_add_field(mesh, "velocity", .true., b%v, status)
    call carreau_mesh_write(mesh, path, status)
    call stop_at(mesh, status)
    write (files%unit, '(a, f0.3, 3a)') '<DataSet timestep="', moved, '" part="0" file="', &
      path(index(path, "/", back=.true.) + 1:), '"/>'
  end subroutine add_to_series

  subroutine close_series(files)
    type(series), intent(inout) :: files
    write (files%unit, '(a)') '</Collection>', '</VTKFile>'
    close (files%unit)
  end subroutine close_series
end module remeshing_m
