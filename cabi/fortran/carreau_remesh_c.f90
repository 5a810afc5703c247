! SPDX-License-Identifier: BSD-3-Clause
!> The functions and structs of carreau_remesh.h as Fortran sees them. Private to module carreau_remesh.
!! Written by generate.py from carreau_remesh.h: do not edit. After a change of the header:
!!   python3 cabi/fortran/generate.py cabi/include/carreau_remesh.h cabi/fortran/carreau_remesh_c.f90
module carreau_remesh_c
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int32_t, c_int64_t, c_null_funptr, c_null_ptr, &
    c_ptr, c_size_t
  implicit none
  public

  !> State in.
  type, bind(c) :: c_remesh_input
    integer(c_size_t) :: struct_size = 0
    integer(c_int64_t) :: vertex_count = 0, triangle_count = 0
    type(c_ptr) :: vertices = c_null_ptr, triangles = c_null_ptr, displacements = c_null_ptr, damage = c_null_ptr
    integer(c_int64_t) :: tool_count = 0
    type(c_ptr) :: tool_starts = c_null_ptr, tool_points = c_null_ptr, tool_radii = c_null_ptr, &
      tool_closed = c_null_ptr
    integer(c_int32_t) :: nodal_components = 0, element_components = 0
    type(c_ptr) :: nodal_values = c_null_ptr, element_values = c_null_ptr, element_kinds = c_null_ptr
    real(c_double) :: h_min = 0, h_max = 0, step = 0, damage_limit = 0, gradation = 0, corner_angle = 0, &
      curvature_angle = 0
    integer(c_int32_t) :: curves = 0, imposed_smoothing = 0, keep_all_parts = 0, no_damage_sizes = 0, &
      error_source = 0, error_component = 0
    real(c_double) :: error_tolerance = 0
    integer(c_int64_t) :: max_triangles = 0
    integer(c_int32_t) :: remove_overlaps = 0, has_reach = 0
    real(c_double) :: reach = 0
    type(c_ptr) :: vertex_kinds = c_null_ptr
  end type c_remesh_input

  !> The events of a remeshing.
  type, bind(c) :: c_remesh_summary
    integer(c_size_t) :: struct_size = 0
    integer(c_int64_t) :: vertices = 0, triangles = 0, boundary_edges = 0, bound_vertices = 0, free_vertices = 0, &
      imposed_vertices = 0, removed_damaged = 0, removed_multiple = 0, removed_dangling = 0, removed_parts = 0, &
      removed_overlapping = 0
    integer(c_int32_t) :: parts_found = 0, parts_kept = 0, boundary = 0, reserved = 0
    real(c_double) :: area_given = 0, area_removed = 0, area_bound = 0, area_geometry = 0, area = 0
  end type c_remesh_summary

  interface
    !> Meshes a piece anew after an increment, and puts the result into a mesh that carreau_mesh_create has made:
    !! dimension 2; references of vertices and edges are CARREAU_NODE_...; edges are the boundary, with the piece on
    !! their left; references of triangles are parts, from 1. `out_summary` may be NULL.
    function c_remesh(mesh, input, summary) result(status) bind(c, name="carreau_remesh")
      import :: c_int32_t, c_ptr, c_remesh_input, c_remesh_summary
      implicit none
      type(c_ptr), value :: mesh
      type(c_remesh_input), intent(in) :: input
      type(c_remesh_summary), intent(inout) :: summary
      integer(c_int32_t) :: status
    end function c_remesh

    !> Copy the fields on the new mesh: vertices x nodal_components, triangles x element_components, triangles.
    function c_remesh_nodal_values(mesh, capacity, values) result(status) bind(c, name="carreau_remesh_nodal_values")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout) :: values(*)
      integer(c_int32_t) :: status
    end function c_remesh_nodal_values

    function c_remesh_element_values(mesh, capacity, values) result(status) &
        bind(c, name="carreau_remesh_element_values")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout) :: values(*)
      integer(c_int32_t) :: status
    end function c_remesh_element_values

    function c_remesh_damage(mesh, capacity, damage) result(status) bind(c, name="carreau_remesh_damage")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout) :: damage(*)
      integer(c_int32_t) :: status
    end function c_remesh_damage

    !> Adds a field to a mesh outside of sessions, for carreau_mesh_write to .vtu: `components` numbers for each vertex,
    !! or each triangle.
    function c_mesh_add_field(mesh, name, on_vertices, components, values) result(status) &
        bind(c, name="carreau_mesh_add_field")
      import :: c_char, c_double, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int32_t), value :: on_vertices, components
      real(c_double), intent(in) :: values(*)
      integer(c_int32_t) :: status
    end function c_mesh_add_field
  end interface
end module carreau_remesh_c
