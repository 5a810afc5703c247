! SPDX-License-Identifier: BSD-3-Clause
!> Fortran 2003 face of cabi/include/carreau_remesh.h: pieces that deform, break and touch tools are meshed anew. That
!! header documents the meaning and errors of each routine. Different here: vertices, points of tools and components
!! count from 1; arrays that are not allocated are not given.
module carreau_remeshing
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t, c_loc, c_null_char
  use carreau, only: carreau_mesh, carreau_mesh_count, CARREAU_ERR_ARGUMENT, CARREAU_OK
  use carreau_remesh_c
  implicit none
  private

  public :: carreau_remesh_input, carreau_remesh_options, carreau_remesh_summary, carreau_remesh
  public :: carreau_remesh_nodal_values, carreau_remesh_element_values, carreau_remesh_damage, carreau_mesh_add_field

  integer(c_int32_t), parameter, public :: CARREAU_NODE_INSIDE = 0, CARREAU_NODE_FREE = 1, CARREAU_NODE_IMPOSED = 2, &
    CARREAU_NODE_BOUND = 3
  integer(c_int32_t), parameter, public :: CARREAU_ELEMENT_MEAN = 0, CARREAU_ELEMENT_CONSERVED = 1
  integer(c_int32_t), parameter, public :: CARREAU_SPLINE_TANGENT = 0, CARREAU_SPLINE_NATURAL = 1, CARREAU_POLYGON = 2
  integer(c_int32_t), parameter, public :: CARREAU_ERROR_NONE = 0, CARREAU_ERROR_HESSIAN = 1, &
    CARREAU_ERROR_CURVATURE = 2, CARREAU_ERROR_DEFORMATION = 3
  integer(c_int32_t), parameter, public :: CARREAU_BOUNDARY_SMOOTH = 0, CARREAU_BOUNDARY_PARTLY = 1, &
    CARREAU_BOUNDARY_KEPT = 2, CARREAU_BOUNDARY_AS_GIVEN = 3

  !> Tool k has the points tool_starts(k) : tool_starts(k + 1) - 1; the last entry is their number plus 1.
  type :: carreau_remesh_input
    real(c_double), allocatable :: vertices(:, :)          !< (2, n)
    integer(c_int32_t), allocatable :: triangles(:, :)     !< (3, m)
    real(c_double), allocatable :: displacements(:, :)     !< (2, n)
    real(c_double), allocatable :: damage(:)               !< (m)
    integer(c_int32_t), allocatable :: vertex_kinds(:)     !< (n), by carreau_mesh_vertex_refs after the last increment
    integer(c_int64_t), allocatable :: tool_starts(:)
    real(c_double), allocatable :: tool_points(:, :)       !< (2, points)
    real(c_double), allocatable :: tool_radii(:)           !< (points)
    integer(c_int32_t), allocatable :: tool_closed(:)      !< (tools)
    real(c_double), allocatable :: nodal_values(:, :)      !< (components, n)
    real(c_double), allocatable :: element_values(:, :)    !< (components, m)
    integer(c_int32_t), allocatable :: element_kinds(:)    !< (components)
  end type carreau_remesh_input

  type :: carreau_remesh_options
    real(c_double) :: h_min = 0, h_max = 0, step = 0
    real(c_double) :: reach = -1 !< negative: the step
    real(c_double) :: damage_limit = 0, gradation = 0, corner_angle = 0, curvature_angle = 0
    integer(c_int32_t) :: curves = CARREAU_SPLINE_TANGENT, imposed_smoothing = 0
    logical :: keep_all_parts = .false., remove_overlaps = .false., damage_sizes = .true.
    integer(c_int32_t) :: error_source = CARREAU_ERROR_NONE, error_component = 1
    real(c_double) :: error_tolerance = 0
    integer(c_int64_t) :: max_triangles = 0
  end type carreau_remesh_options

  type :: carreau_remesh_summary
    integer(c_int64_t) :: vertices = 0, triangles = 0, boundary_edges = 0
    integer(c_int64_t) :: bound_vertices = 0, free_vertices = 0, imposed_vertices = 0
    integer(c_int64_t) :: removed_damaged = 0, removed_multiple = 0, removed_dangling = 0, removed_parts = 0, &
      removed_overlapping = 0
    integer(c_int32_t) :: parts_found = 0, parts_kept = 0, boundary = 0
    real(c_double) :: area_given = 0, area_removed = 0, area_bound = 0, area_geometry = 0, area = 0
  end type carreau_remesh_summary

contains

  !> carreau_remesh of the C interface. Get the result by carreau_mesh_vertices, carreau_mesh_triangles, ...
  subroutine carreau_remesh(mesh, input, options, status, summary)
    type(carreau_mesh), intent(in) :: mesh
    type(carreau_remesh_input), intent(in), target :: input
    type(carreau_remesh_options), intent(in) :: options
    integer(c_int32_t), intent(out) :: status
    type(carreau_remesh_summary), intent(out), optional :: summary
    type(c_remesh_input) :: c
    type(c_remesh_summary) :: told
    integer(c_int32_t), allocatable, target :: triangles(:)
    integer(c_int64_t), allocatable, target :: starts(:)
    status = CARREAU_ERR_ARGUMENT
    if (.not. shapes_fit(input)) return
    c%struct_size = size(transfer(c, [c_null_char]))
    told%struct_size = size(transfer(told, [c_null_char]))
    allocate (triangles(size(input%triangles) + 1)) ! never empty: C needs an address
    triangles(:size(input%triangles)) = reshape(input%triangles, [size(input%triangles)]) - 1
    c%vertex_count = size(input%vertices, 2)
    c%triangle_count = size(input%triangles, 2)
    if (c%vertex_count > 0) c%vertices = c_loc(input%vertices(1, 1))
    c%triangles = c_loc(triangles(1))
    if (allocated(input%displacements)) c%displacements = c_loc(input%displacements(1, 1))
    if (allocated(input%damage)) c%damage = c_loc(input%damage(1))
    if (allocated(input%vertex_kinds)) c%vertex_kinds = c_loc(input%vertex_kinds(1))
    if (allocated(input%tool_starts)) then
      allocate (starts(size(input%tool_starts)))
      starts = input%tool_starts - 1
      c%tool_count = size(starts) - 1
      c%tool_starts = c_loc(starts(1))
      c%tool_points = c_loc(input%tool_points(1, 1))
      if (allocated(input%tool_radii)) c%tool_radii = c_loc(input%tool_radii(1))
      if (allocated(input%tool_closed)) c%tool_closed = c_loc(input%tool_closed(1))
    end if
    if (allocated(input%nodal_values)) then
      c%nodal_components = int(size(input%nodal_values, 1), c_int32_t)
      c%nodal_values = c_loc(input%nodal_values(1, 1))
    end if
    if (allocated(input%element_values)) then
      c%element_components = int(size(input%element_values, 1), c_int32_t)
      c%element_values = c_loc(input%element_values(1, 1))
      if (allocated(input%element_kinds)) c%element_kinds = c_loc(input%element_kinds(1))
    end if
    call set_options(options, c)
    status = c_remesh(mesh%handle, c, told)
    if (present(summary)) summary = carreau_remesh_summary(told%vertices, told%triangles, told%boundary_edges, &
      told%bound_vertices, told%free_vertices, told%imposed_vertices, told%removed_damaged, told%removed_multiple, &
      told%removed_dangling, told%removed_parts, told%removed_overlapping, told%parts_found, told%parts_kept, &
      told%boundary, told%area_given, told%area_removed, told%area_bound, told%area_geometry, told%area)
  end subroutine carreau_remesh

  subroutine set_options(options, c)
    type(carreau_remesh_options), intent(in) :: options
    type(c_remesh_input), intent(inout) :: c
    c%h_min = options%h_min
    c%h_max = options%h_max
    c%step = options%step
    c%has_reach = merge(1_c_int32_t, 0_c_int32_t, options%reach >= 0)
    c%reach = max(options%reach, 0._c_double)
    c%damage_limit = options%damage_limit
    c%gradation = options%gradation
    c%corner_angle = options%corner_angle
    c%curvature_angle = options%curvature_angle
    c%curves = options%curves
    c%imposed_smoothing = options%imposed_smoothing
    c%keep_all_parts = merge(1_c_int32_t, 0_c_int32_t, options%keep_all_parts)
    c%remove_overlaps = merge(1_c_int32_t, 0_c_int32_t, options%remove_overlaps)
    c%no_damage_sizes = merge(0_c_int32_t, 1_c_int32_t, options%damage_sizes)
    c%error_source = options%error_source
    c%error_component = options%error_component - 1
    c%error_tolerance = options%error_tolerance
    c%max_triangles = options%max_triangles
  end subroutine set_options

  !> Checks lengths that C cannot see: each array must have the length of its entities.
  function shapes_fit(input) result(fit)
    type(carreau_remesh_input), intent(in) :: input
    logical :: fit
    integer :: n, m
    fit = allocated(input%vertices) .and. allocated(input%triangles)
    if (.not. fit) return
    n = size(input%vertices, 2)
    m = size(input%triangles, 2)
    fit = size(input%vertices, 1) == 2 .and. size(input%triangles, 1) == 3
    if (allocated(input%displacements)) fit = fit .and. all(shape(input%displacements) == [2, n])
    if (allocated(input%damage)) fit = fit .and. size(input%damage) == m
    if (allocated(input%vertex_kinds)) fit = fit .and. size(input%vertex_kinds) == n
    if (allocated(input%nodal_values)) fit = fit .and. size(input%nodal_values, 2) == n
    if (allocated(input%element_values)) then
      fit = fit .and. size(input%element_values, 2) == m
      if (allocated(input%element_kinds)) fit = fit .and. size(input%element_kinds) == size(input%element_values, 1)
    end if
    if (.not. allocated(input%tool_starts)) return
    fit = fit .and. allocated(input%tool_points) .and. size(input%tool_starts) > 0
    if (.not. fit) return
    n = size(input%tool_points, 2)
    fit = size(input%tool_points, 1) == 2 .and. input%tool_starts(size(input%tool_starts)) == n + 1 .and. &
      all(input%tool_starts >= 1) .and. all(input%tool_starts <= n + 1)
    if (allocated(input%tool_radii)) fit = fit .and. size(input%tool_radii) == n
    if (allocated(input%tool_closed)) fit = fit .and. size(input%tool_closed) == size(input%tool_starts) - 1
  end function shapes_fit

  !> values(components, n): as many components as carreau_remesh was given.
  subroutine carreau_remesh_nodal_values(mesh, components, values, status)
    type(carreau_mesh), intent(in) :: mesh
    integer, intent(in) :: components
    real(c_double), allocatable, intent(out) :: values(:, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: n, m, k, f
    call carreau_mesh_count(mesh, n, m, k, f, status)
    if (status /= CARREAU_OK) return
    allocate (values(components, n))
    status = c_remesh_nodal_values(mesh%handle, n, values)
  end subroutine carreau_remesh_nodal_values

  subroutine carreau_remesh_element_values(mesh, components, values, status)
    type(carreau_mesh), intent(in) :: mesh
    integer, intent(in) :: components
    real(c_double), allocatable, intent(out) :: values(:, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: n, m, k, f
    call carreau_mesh_count(mesh, n, m, k, f, status)
    if (status /= CARREAU_OK) return
    allocate (values(components, m))
    status = c_remesh_element_values(mesh%handle, m, values)
  end subroutine carreau_remesh_element_values

  subroutine carreau_remesh_damage(mesh, damage, status)
    type(carreau_mesh), intent(in) :: mesh
    real(c_double), allocatable, intent(out) :: damage(:)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: n, m, k, f
    call carreau_mesh_count(mesh, n, m, k, f, status)
    if (status /= CARREAU_OK) return
    allocate (damage(m))
    status = c_remesh_damage(mesh%handle, m, damage)
  end subroutine carreau_remesh_damage

  !> values(components, rows): rows are vertices or triangles.
  subroutine carreau_mesh_add_field(mesh, name, on_vertices, values, status)
    type(carreau_mesh), intent(in) :: mesh
    character(len=*), intent(in) :: name
    logical, intent(in) :: on_vertices
    real(c_double), intent(in) :: values(:, :)
    integer(c_int32_t), intent(out) :: status
    integer(c_int64_t) :: n, m, k, f
    call carreau_mesh_count(mesh, n, m, k, f, status)
    if (status /= CARREAU_OK) return
    status = CARREAU_ERR_ARGUMENT
    if (size(values, 2) /= merge(n, m, on_vertices)) return
    status = c_mesh_add_field(mesh%handle, trim(name)//c_null_char, merge(1_c_int32_t, 0_c_int32_t, on_vertices), &
      int(size(values, 1), c_int32_t), values)
  end subroutine carreau_mesh_add_field
end module carreau_remeshing
