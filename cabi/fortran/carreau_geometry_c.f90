! SPDX-License-Identifier: BSD-3-Clause
!> The functions and structs of carreau_geometry.h as Fortran sees them. Private to module carreau_geometry.
!! Written by generate.py from carreau_geometry.h: do not edit. After a change of the header:
!!   python3 cabi/fortran/generate.py cabi/include/carreau_geometry.h cabi/fortran/carreau_geometry_c.f90
module carreau_geometry_c
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_funptr, c_int32_t, c_int64_t, c_null_funptr, c_null_ptr, &
    c_ptr, c_size_t
  implicit none
  public

  !> A geometry, and the references that are its own: its face k is face first_face + k - 1 of the session.
  type, bind(c) :: c_geometry
    integer(c_size_t) :: struct_size = 0
    integer(c_int32_t) :: kind = 0, faces = 0, first_face = 0, last_face = 0, first_curve = 0, last_curve = 0, &
      first_point = 0, last_point = 0
  end type c_geometry

  !> Tensor products over the unit square.
  type, bind(c) :: c_bezier
    integer(c_size_t) :: struct_size = 0
    integer(c_int64_t) :: patch_count = 0
    type(c_ptr) :: degrees = c_null_ptr, controls = c_null_ptr, side_refs = c_null_ptr
  end type c_bezier

  !> Which surface of a molecule, and by which probe.
  type, bind(c) :: c_molecule_options
    integer(c_size_t) :: struct_size = 0
    integer(c_int32_t) :: surface = 0, drop_cavities = 0
    real(c_double) :: probe = 0
    type(c_ptr) :: radii = c_null_ptr
  end type c_molecule_options

  !> Exact measures of the surface: no mesh is needed.
  type, bind(c) :: c_molecule_measures
    integer(c_size_t) :: struct_size = 0
    real(c_double) :: area = 0, volume = 0
    integer(c_int64_t) :: atoms = 0, exposed_atoms = 0, shells = 0, cavities = 0, euler_number = 0, moved_radii = 0
    real(c_double) :: convex_area = 0, torus_area = 0, concave_area = 0
  end type c_molecule_measures

  !> A domain of the plane.
  type, bind(c) :: c_plane_domain
    integer(c_size_t) :: struct_size = 0
    integer(c_int32_t) :: rest = 0, reserved = 0
    integer(c_int64_t) :: point_count = 0, curve_count = 0, side_count = 0, seed_count = 0
    type(c_ptr) :: points = c_null_ptr, point_refs = c_null_ptr, imposed = c_null_ptr, sizes = c_null_ptr, &
      metrics = c_null_ptr, curve_starts = c_null_ptr, curve_points = c_null_ptr, smooth = c_null_ptr, &
      controls = c_null_ptr, tangents = c_null_ptr, curve_refs = c_null_ptr, sides = c_null_ptr, seeds = c_null_ptr, &
      seed_refs = c_null_ptr
  end type c_plane_domain

  !> Zeros in all members but struct_size are the defaults; NULL in place of the struct is the same.
  type, bind(c) :: c_grid_options
    integer(c_size_t) :: struct_size = 0
    integer(c_int32_t) :: measured = 0, smoothing_rounds = 0
    real(c_double) :: smoothing_inward = 0, smoothing_outward = 0
    integer(c_int32_t) :: lengths = 0, orient = 0
    real(c_double) :: join_angle = 0, tolerance = 0, step = 0
    integer(c_int32_t) :: fill = 0, continuity = 0, smoothing_by_distance = 0, reserved = 0
  end type c_grid_options

  !> The lines of a surface given as triangles.
  type, bind(c) :: c_triangles_options
    integer(c_size_t) :: struct_size = 0
    real(c_double) :: sharp_angle = 0, corner_angle = 0
    integer(c_int32_t) :: given_edges_only = 0, ignore_references = 0, keep_double_vertices = 0, reserved = 0
  end type c_triangles_options

  !> Triangles in arrays of the caller, copied.
  type, bind(c) :: c_triangles
    integer(c_size_t) :: struct_size = 0
    integer(c_int64_t) :: vertex_count = 0, triangle_count = 0, edge_count = 0
    type(c_ptr) :: vertices = c_null_ptr, triangles = c_null_ptr, triangle_refs = c_null_ptr, edges = c_null_ptr
  end type c_triangles

  !> Findings in the triangles of a session.
  type, bind(c) :: c_triangles_report
    integer(c_size_t) :: struct_size = 0
    integer(c_int64_t) :: vertices = 0, triangles = 0, edges = 0, shells = 0, euler_number = 0, border_edges = 0, &
      manifold_breaks = 0, one_sided_edges = 0, pinched_vertices = 0, turned_triangles = 0, repeated_triangles = 0, &
      flat_triangles = 0, sharp_edges = 0, lines = 0, corners = 0, regions = 0, dropped_edges = 0, &
      prolonged_edges = 0, faded_ends = 0, unfolded = 0, folded = 0
    real(c_double) :: diagonal = 0, deviation = 0, sharp_angle = 0
  end type c_triangles_report

  interface
    !> Count the geometries that were added, and describe geometry `index`, from 0, in the order of adding.
    function c_geometry_count(session, count) result(status) bind(c, name="carreau_geometry_count")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function c_geometry_count

    function c_geometry_info(session, index, geometry) result(status) bind(c, name="carreau_geometry_info")
      import :: c_geometry, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int64_t), value :: index
      type(c_geometry), intent(inout) :: geometry
      integer(c_int32_t) :: status
    end function c_geometry_info

    !> Begins a geometry of callbacks beside the geometries of the session.
    function c_geometry_begin(session, callbacks) result(status) bind(c, name="carreau_geometry_begin")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session, callbacks
      integer(c_int32_t) :: status
    end function c_geometry_begin

    function c_geometry_end(session) result(status) bind(c, name="carreau_geometry_end")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t) :: status
    end function c_geometry_end

    function c_geometry_cancel(session) result(status) bind(c, name="carreau_geometry_cancel")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t) :: status
    end function c_geometry_cancel

    !> Adds Bezier patches to a session: patch k is face k + 1, and its normal is along Su x Sv.
    function c_add_bezier(session, bezier) result(status) bind(c, name="carreau_add_bezier")
      import :: c_bezier, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      type(c_bezier), intent(in) :: bezier
      integer(c_int32_t) :: status
    end function c_add_bezier

    !> Adds the Bezier patches of a file .bpt: the number of patches, then for each m n and its control points.
    function c_load_bezier(session, path) result(status) bind(c, name="carreau_load_bezier")
      import :: c_char, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t) :: status
    end function c_load_bezier

    !> Gives the degrees m and n of a face that is a Bezier patch.
    function c_bezier_degrees(session, face_ref, degrees) result(status) bind(c, name="carreau_bezier_degrees")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: face_ref
      integer(c_int32_t), intent(inout) :: degrees(*)
      integer(c_int32_t) :: status
    end function c_bezier_degrees

    !> Adds the surface of n balls to a session.
    function c_add_molecule(session, options, n, centers, radii) result(status) bind(c, name="carreau_add_molecule")
      import :: c_double, c_int32_t, c_int64_t, c_molecule_options, c_ptr
      implicit none
      type(c_ptr), value :: session
      type(c_molecule_options), intent(in) :: options
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: centers(*), radii(*)
      integer(c_int32_t) :: status
    end function c_add_molecule

    !> Adds the surface of the atoms of a file .xyzr (x, y, z, radius), .xyz, .pdb, .ent, .cif or .mmcif.
    function c_load_molecule(session, options, path) result(status) bind(c, name="carreau_load_molecule")
      import :: c_char, c_int32_t, c_molecule_options, c_ptr
      implicit none
      type(c_ptr), value :: session
      type(c_molecule_options), intent(in) :: options
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t) :: status
    end function c_load_molecule

    !> Measures the molecule that the session was given last.
    function c_molecule_measure(session, measures) result(status) bind(c, name="carreau_molecule_measure")
      import :: c_int32_t, c_molecule_measures, c_ptr
      implicit none
      type(c_ptr), value :: session
      type(c_molecule_measures), intent(inout) :: measures
      integer(c_int32_t) :: status
    end function c_molecule_measure

    !> Gives reference and area of each atom of that molecule (of CARREAU_SES the convex parts); an array may be NULL.
    function c_molecule_atoms(session, capacity, refs, areas) result(status) bind(c, name="carreau_molecule_atoms")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int64_t), value :: capacity
      integer(c_int32_t), intent(inout) :: refs(*)
      real(c_double), intent(inout) :: areas(*)
      integer(c_int32_t) :: status
    end function c_molecule_atoms

    !> Gives the full area of each atom: of its convex parts, as above; its share of the torus parts beside it; a third
    !! of each concave part that touches it.
    function c_molecule_atom_areas(session, capacity, convex, torus, concave) result(status) &
        bind(c, name="carreau_molecule_atom_areas")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout) :: convex(*), torus(*), concave(*)
      integer(c_int32_t) :: status
    end function c_molecule_atom_areas

    !> Gives the residue of an atom, from 0; "" when it has none.
    function c_molecule_atom_name(session, atom) result(name) bind(c, name="carreau_molecule_atom_name")
      import :: c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int64_t), value :: atom
      type(c_ptr) :: name
    end function c_molecule_atom_name

    !> Makes a plane domain the only geometry of a session that has no model: see carreau_model_clear.
    function c_add_plane_domain(session, domain) result(status) bind(c, name="carreau_add_plane_domain")
      import :: c_int32_t, c_plane_domain, c_ptr
      implicit none
      type(c_ptr), value :: session
      type(c_plane_domain), intent(in) :: domain
      integer(c_int32_t) :: status
    end function c_add_plane_domain

    !> Adds the plane domain of a file: .poly and .node (Triangle; segments that cross are divided), .dat (airfoils),
    !! .mesh, .meshb or .bl2d of dimension 2, whose edges and ends of triangles are the curves, .data or .g (BL2D; with
    !! the sizes of a .hg beside it).
    function c_load_plane_domain(session, path, sizes, corner_angle) result(status) &
        bind(c, name="carreau_load_plane_domain")
      import :: c_char, c_double, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      character(kind=c_char), intent(in) :: path(*), sizes(*)
      real(c_double), value :: corner_angle
      integer(c_int32_t) :: status
    end function c_load_plane_domain

    !> Gives 1 if the plane domain that the session got last has sizes or metrics at its points; 0 without such a
    !! domain.
    function c_plane_has_sizes(session, answer) result(status) bind(c, name="carreau_plane_has_sizes")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), intent(inout) :: answer
      integer(c_int32_t) :: status
    end function c_plane_has_sizes

    !> Adds a surface through the nodes of n structured grids to a session.
    function c_add_grid(session, options, n, counts, nodes) result(status) bind(c, name="carreau_add_grid")
      import :: c_double, c_grid_options, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      type(c_grid_options), intent(in) :: options
      integer(c_int64_t), value :: n
      integer(c_int32_t), intent(in) :: counts(*)
      real(c_double), intent(in) :: nodes(*)
      integer(c_int32_t) :: status
    end function c_add_grid

    !> Adds a surface through the grids of a file.
    function c_load_grid(session, options, path, format) result(status) bind(c, name="carreau_load_grid")
      import :: c_char, c_grid_options, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      type(c_grid_options), intent(in) :: options
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t), value :: format
      integer(c_int32_t) :: status
    end function c_load_grid

    !> Adds triangles to a session: they are a geometry like others (see carreau_geometry_begin), whose faces have no
    !! curves of a parameter plane.
    function c_add_triangles(session, options, triangles) result(status) bind(c, name="carreau_add_triangles")
      import :: c_int32_t, c_ptr, c_triangles, c_triangles_options
      implicit none
      type(c_ptr), value :: session
      type(c_triangles_options), intent(in) :: options
      type(c_triangles), intent(in) :: triangles
      integer(c_int32_t) :: status
    end function c_add_triangles

    !> Adds the triangles of a file that carreau_mesh_read reads.
    function c_load_triangles(session, options, path) result(status) bind(c, name="carreau_load_triangles")
      import :: c_char, c_int32_t, c_ptr, c_triangles_options
      implicit none
      type(c_ptr), value :: session
      type(c_triangles_options), intent(in) :: options
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t) :: status
    end function c_load_triangles

    !> Gives the report on the triangles of the session.
    function c_triangles_measure(session, report) result(status) bind(c, name="carreau_triangles_measure")
      import :: c_int32_t, c_ptr, c_triangles_report
      implicit none
      type(c_ptr), value :: session
      type(c_triangles_report), intent(inout) :: report
      integer(c_int32_t) :: status
    end function c_triangles_measure

    !> Cuts triangles into four by the middles of their edges on the smooth surface while their normals differ from it
    !! by more than `angle` degrees, at most `depth` times.
    function c_triangles_refine(session, angle, depth, mesh) result(status) bind(c, name="carreau_triangles_refine")
      import :: c_double, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      real(c_double), value :: angle
      integer(c_int32_t), value :: depth
      type(c_ptr), value :: mesh
      integer(c_int32_t) :: status
    end function c_triangles_refine

    !> Distances between the mesh of a session and the triangles that it was given, model length, over their vertices,
    !! middles of edges and of triangles: the largest from the mesh to the triangles, and back.
    function c_triangles_distances(session, distances) result(status) bind(c, name="carreau_triangles_distances")
      import :: c_double, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      real(c_double), intent(inout) :: distances(*)
      integer(c_int32_t) :: status
    end function c_triangles_distances

    !> Bounds the distances over all points of both.
    function c_triangles_bounds(session, share, bounds) result(status) bind(c, name="carreau_triangles_bounds")
      import :: c_double, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      real(c_double), value :: share
      real(c_double), intent(inout) :: bounds(*)
      integer(c_int32_t) :: status
    end function c_triangles_bounds

    !> Evaluates an entity of dimension 2 or 1 at n places, n x dimension. `order` is the highest derivative, 0 to 2.
    !! out_xyz is n x 3. out_first is n x dimension x 3.
    function c_evaluate(session, dimension, reference, n, parameters, order, xyz, first, second) result(status) &
        bind(c, name="carreau_evaluate")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: dimension, reference
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: parameters(*)
      integer(c_int32_t), value :: order
      real(c_double), intent(inout) :: xyz(*), first(*), second(*)
      integer(c_int32_t) :: status
    end function c_evaluate

    !> Finds the closest point of an entity to each of n points of space, n x 3; a reference of 0 means all entities of
    !! that dimension.
    function c_project(session, dimension, reference, n, xyz, references, parameters, closest, &
      distances) result(status) bind(c, name="carreau_project")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: dimension, reference
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: xyz(*)
      integer(c_int32_t), intent(inout) :: references(*)
      real(c_double), intent(inout) :: parameters(*), closest(*), distances(*)
      integer(c_int32_t) :: status
    end function c_project

    !> Embeds a point of space, 3 numbers, in the face nearest to it: the mesh has a vertex there.
    function c_model_embed_point(session, xyz, name, ref) result(status) bind(c, name="carreau_model_embed_point")
      import :: c_char, c_double, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      real(c_double), intent(in) :: xyz(*)
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int32_t), intent(inout) :: ref
      integer(c_int32_t) :: status
    end function c_model_embed_point

    !> Embeds a polyline of n points of space, n x 3, in the faces that it lies on.
    function c_model_embed_polyline(session, n, xyz, name, ref) result(status) &
        bind(c, name="carreau_model_embed_polyline")
      import :: c_char, c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: xyz(*)
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int32_t), intent(inout) :: ref
      integer(c_int32_t) :: status
    end function c_model_embed_polyline

    !> Embeds the curves of wires (faces of orientation 0) that lie on other faces, as carreau_model_embed_polyline()
    !! does, under the names of their wires.
    function c_model_embed_wires(session, count) result(status) bind(c, name="carreau_model_embed_wires")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function c_model_embed_wires

    !> Embeds the ridges of the session's structured grids as carreau_model_embed_polyline() does: lines where the
    !! principal curvature of larger absolute value is maximal along its direction and its radius is below `radius`
    !! (model length), sharp convex and concave lines alike.
    function c_model_embed_ridges(session, radius, count) result(status) bind(c, name="carreau_model_embed_ridges")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      real(c_double), value :: radius
      integer(c_int64_t), intent(inout) :: count
      integer(c_int32_t) :: status
    end function c_model_embed_ridges

    !> Gives the entity of lowest dimension that each vertex lies on, in the order of carreau_mesh_vertices, nodes on
    !! edges included: a point (0, corners and imposed points), a curve (1, free edges too) or a face (2), by the
    !! references that carreau_project takes.
    function c_mesh_vertex_entities(mesh, capacity, dimensions, references) result(status) &
        bind(c, name="carreau_mesh_vertex_entities")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: capacity
      integer(c_int32_t), intent(inout) :: dimensions(*), references(*)
      integer(c_int32_t) :: status
    end function c_mesh_vertex_entities

    !> Gives the parameters of both ends of each edge of carreau_mesh_edges, k x 2, on curve number ic (k) of a face
    !! (k), as callbacks get them.
    function c_mesh_edge_parameters(mesh, capacity, t, faces, ics) result(status) &
        bind(c, name="carreau_mesh_edge_parameters")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: mesh
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout) :: t(*)
      integer(c_int32_t), intent(inout) :: faces(*), ics(*)
      integer(c_int32_t) :: status
    end function c_mesh_edge_parameters

    !> Carries the mesh of another session to the geometry of `session`, whose topology is equal.
    function c_mesh_carry(session, old_mesh, match) result(status) bind(c, name="carreau_mesh_carry")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session, old_mesh
      integer(c_int32_t), value :: match
      integer(c_int32_t) :: status
    end function c_mesh_carry

    !> Halves all edges, `times` times: each element becomes four.
    function c_mesh_halve(session, times) result(status) bind(c, name="carreau_mesh_halve")
      import :: c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: times
      integer(c_int32_t) :: status
    end function c_mesh_halve

    !> Halves n marked edges (n x 2 vertices) or all edges of n marked elements (n numbers from 0).
    function c_mesh_refine(session, kind, n, marks) result(status) bind(c, name="carreau_mesh_refine")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: kind
      integer(c_int64_t), value :: n
      integer(c_int32_t), intent(in) :: marks(*)
      integer(c_int32_t) :: status
    end function c_mesh_refine

    !> Halves edges until none is longer than sqrt(2) of the size at its ends. `sizes` are model lengths at the n
    !! vertices of the mesh; of elements of second order at the corners, which come first.
    function c_mesh_refine_sizes(session, n, sizes) result(status) bind(c, name="carreau_mesh_refine_sizes")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: sizes(*)
      integer(c_int32_t) :: status
    end function c_mesh_refine_sizes

    !> Makes elements of order 2 to 4 over the elements of the session's mesh: best over a mesh of order 2 (parameter
    !! element), whose sizes were chosen for curved elements.
    function c_raise_order(session, order, places, invalid) result(status) bind(c, name="carreau_raise_order")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: order, places
      integer(c_int64_t), intent(inout) :: invalid
      integer(c_int32_t) :: status
    end function c_raise_order

    !> Give the numbers of these elements: all nodes, vertices of the mesh first, triangles, quadrilaterals, edges of
    !! curves.
    function c_raised_count(session, nodes, triangles, quads, edges) result(status) bind(c, name="carreau_raised_count")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int64_t), intent(inout) :: nodes, triangles, quads, edges
      integer(c_int32_t) :: status
    end function c_raised_count

    function c_raised_nodes(session, capacity, xyz) result(status) bind(c, name="carreau_raised_nodes")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int64_t), value :: capacity
      real(c_double), intent(inout) :: xyz(*)
      integer(c_int32_t) :: status
    end function c_raised_nodes

    function c_raised_elements(session, corners, capacity, nodes, references) result(status) &
        bind(c, name="carreau_raised_elements")
      import :: c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: corners
      integer(c_int64_t), value :: capacity
      integer(c_int32_t), intent(inout) :: nodes(*), references(*)
      integer(c_int32_t) :: status
    end function c_raised_elements

    function c_raised_write(session, path) result(status) bind(c, name="carreau_raised_write")
      import :: c_char, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t) :: status
    end function c_raised_write

    !> Evaluates a face at n places (u, v).
    function c_geometry_points(session, face_ref, n, uv, xyz) result(status) bind(c, name="carreau_geometry_points")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: face_ref
      integer(c_int64_t), value :: n
      real(c_double), intent(in) :: uv(*)
      real(c_double), intent(inout) :: xyz(*)
      integer(c_int32_t) :: status
    end function c_geometry_points

    !> Evaluates curve `ic` of a face at a share of its interval, from 0 to 1: (u, v).
    function c_geometry_curve(session, face_ref, ic, share, uv) result(status) bind(c, name="carreau_geometry_curve")
      import :: c_double, c_int32_t, c_ptr
      implicit none
      type(c_ptr), value :: session
      integer(c_int32_t), value :: face_ref, ic
      real(c_double), value :: share
      real(c_double), intent(inout) :: uv(*)
      integer(c_int32_t) :: status
    end function c_geometry_curve
  end interface
end module carreau_geometry_c
