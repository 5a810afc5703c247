! SPDX-License-Identifier: BSD-3-Clause
! Bezier patches, callbacks beside them, and meshes from arrays, from Fortran.
module plate
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_ptr
  implicit none
contains
  function surface(face, u, v, order, s, su, sv, suu, suv, svv, user) result(status) bind(c)
    integer(c_int32_t), value :: face, order
    real(c_double), value :: u, v
    real(c_double), intent(inout) :: s(3), su(3), sv(3), suu(3), suv(3), svv(3)
    type(c_ptr), value :: user
    integer(c_int32_t) :: status
    s = [u + 10 * face, v, 0._c_double]
    su = [1, 0, 0]
    sv = [0, 1, 0]
    suu = 0 ; suv = 0 ; svv = 0
    status = 0
  end function surface
  function interval(face, ic, a, b, user) result(status) bind(c)
    integer(c_int32_t), value :: face, ic
    real(c_double), intent(inout) :: a, b
    type(c_ptr), value :: user
    integer(c_int32_t) :: status
    a = 0
    b = 1
    status = 0
  end function interval
  function side(face, ic, t, order, c, ct, ctt, user) result(status) bind(c)
    integer(c_int32_t), value :: face, ic, order
    real(c_double), value :: t
    real(c_double), intent(inout) :: c(2), ct(2), ctt(2)
    type(c_ptr), value :: user
    integer(c_int32_t) :: status
    real(c_double), parameter :: at(2, 5) = reshape([0, 0, 1, 0, 1, 1, 0, 1, 0, 0], [2, 5])
    c = (1 - t) * at(:, ic) + t * at(:, ic + 1)
    ct = at(:, ic + 1) - at(:, ic)
    ctt = 0
    status = 0
  end function side
end module plate

program geometries_fortran_test
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t
  use carreau
  use carreau_geometry
  use plate
  implicit none
  type(carreau_session) :: session
  type(carreau_mesh) :: mesh, copy
  type(carreau_geometry_place) :: place
  type(carreau_quality) :: quality, of_copy
  real(c_double) :: controls(3, 4)
  real(c_double), allocatable :: xyz(:, :), uv(:, :, :), uv_copy(:, :, :), first(:, :, :), second(:, :, :)
  real(c_double), allocatable :: params(:, :), closest(:, :), distances(:)
  integer(c_int32_t), allocatable :: triangles(:, :), refs(:), edges(:, :), edge_refs(:), back(:, :)
  integer(c_int32_t), allocatable :: dimensions(:), faces(:), ics(:)
  integer(c_int32_t) :: status, degrees(2), k
  integer(c_int64_t) :: count

  call carreau_session_create(session, status)
  ! z = u v over the unit square
  controls = reshape([0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 1], [3, 4])
  call carreau_add_bezier(session, reshape([1, 1], [2, 1]), controls(:, :3), status)
  call check(status == CARREAU_ERR_ARGUMENT, 'a control point is missing')
  call carreau_add_bezier(session, reshape([1, 1], [2, 1]), controls, status)
  call check(status == CARREAU_OK, carreau_last_error(session))
  call carreau_bezier_degrees(session, 1, degrees, status)
  call check(status == CARREAU_OK .and. all(degrees == 1), 'degrees')
  call carreau_geometry_points(session, 1, reshape([0.25d0, 0.5d0], [2, 1]), xyz, status)
  call check(status == CARREAU_OK .and. all(abs(xyz(:, 1) - [0.25d0, 0.5d0, 0.125d0]) < 1d-15), 'a point')
  call carreau_evaluate(session, 2, 1, reshape([0.25d0, 0.5d0], [2, 1]), xyz, status, first, second)
  call check(status == CARREAU_OK .and. all(abs(xyz(:, 1) - [0.25d0, 0.5d0, 0.125d0]) < 1d-15), 'a place')
  call check(all(abs(first(:, 1, 1) - [1d0, 0d0, 0.5d0]) < 1d-14) .and. abs(second(3, 2, 1) - 1) < 1d-14, &
    'derivatives')
  call carreau_project(session, 2, 0, reshape([-0.25d0, 0.25d0, 1.125d0], [3, 1]), refs, params, closest, &
    distances, status)
  call check(status == CARREAU_OK .and. all(abs(params(:, 1) - [0.25d0, 0.5d0]) < 1d-12) .and. refs(1) == 1, &
    'a closest point')
  call check(abs(distances(1)**2 - 1.3125d0) < 1d-12 .and. abs(closest(3, 1) - 0.125d0) < 1d-12, 'its distance')
  call carreau_project(session, 2, 7, closest, refs, params, xyz, distances, status)
  call check(status == CARREAU_ERR_ARGUMENT, 'no such face')
  call carreau_geometry_begin(session, surface, interval, side, status)
  call check(status == CARREAU_OK, carreau_last_error(session))
  call carreau_model_add_face(session, 1, 1, status)
  do k = 1, 4
    call carreau_model_add_curve(session, 1, CARREAU_BOUNDARY, k, k, mod(k, 4) + 1, status)
  end do
  call carreau_geometry_end(session, status)
  call check(status == CARREAU_OK, carreau_last_error(session))
  call carreau_geometry_count(session, count, status)
  call carreau_geometry_info(session, count, place, status)
  call check(count == 2 .and. place%kind == CARREAU_GEOMETRY_CALLBACKS .and. place%first_face == 2 &
    .and. place%first_curve == 5 .and. place%last_point == 12, 'places')
  call carreau_set_real(session, 'hphydef', 0.1d0, status)
  call carreau_mesh_generate(session, status)
  call check(status == CARREAU_OK, carreau_last_error(session))
  call carreau_session_mesh(session, mesh, status)
  call carreau_mesh_vertex_entities(mesh, dimensions, refs, status)
  call check(status == CARREAU_OK .and. sum(merge(1, 0, dimensions == 0)) == 8 .and. all(refs > 0), 'corners of two squares')
  call carreau_mesh_edge_parameters(mesh, params, faces, ics, status)
  call check(status == CARREAU_OK .and. all(params >= 0 .and. params <= 1) .and. all(ics <= 4), 'parameters of edges')
  call carreau_mesh_quality(mesh, quality, status)
  call check(quality%area > 2.2 .and. quality%area < 2.3, 'a square, and a saddle of 1.28')
  call follow_and_raise

  call carreau_mesh_vertices(mesh, xyz, status)
  call carreau_mesh_triangles(mesh, triangles, status)
  call carreau_mesh_triangle_refs(mesh, refs, status)
  call carreau_mesh_edges(mesh, edges, status)
  call carreau_mesh_edge_refs(mesh, edge_refs, status)
  call carreau_mesh_corner_uv(mesh, uv, status)
  call carreau_mesh_create(copy, status)
  call carreau_mesh_from_arrays(copy, xyz, triangles, status, edges=edges, triangle_refs=refs, edge_refs=edge_refs, &
    corner_uv=uv)
  call check(status == CARREAU_OK, carreau_mesh_last_error(copy))
  call carreau_mesh_quality(copy, of_copy, status)
  call check(of_copy%area == quality%area .and. of_copy%open_edges == quality%open_edges, 'the same mesh')
  call carreau_mesh_triangles(copy, back, status)
  call carreau_mesh_corner_uv(copy, uv_copy, status)
  call check(all(back == triangles) .and. all(uv_copy == uv), 'the same arrays')
  triangles(2, 3) = 0
  call carreau_mesh_from_arrays(copy, xyz, triangles, status)
  call check(status == CARREAU_ERR_ARGUMENT .and. index(carreau_mesh_last_error(copy), 'triangle 2') > 0, 'no such vertex')
  call carreau_model_embed_point(session, [0.2d0, 0.8d0, 0.16d0], 'probe', k, status)
  call check(status == CARREAU_OK .and. k > 12, carreau_last_error(session))
  call carreau_model_embed_polyline(session, reshape([0.2d0, 0.25d0, 0.05d0, 0.8d0, 0.25d0, 0.2d0], [3, 2]), 'line', k, status)
  call check(status == CARREAU_OK .and. k > 8, carreau_last_error(session))
  call carreau_model_embed_wires(session, count, status)
  call check(status == CARREAU_OK .and. count == 0, 'no wire')
  call triangles_of_a_tetrahedron(copy)
  call ring_of_arcs
  call carreau_mesh_free(copy)
  call carreau_session_free(session)
contains
  ! A square beside itself: carried, refined, and of order 3.
  subroutine follow_and_raise
    type(carreau_session) :: first, second
    type(carreau_mesh) :: old, new
    real(c_double), allocatable :: p(:, :), q(:, :)
    integer(c_int32_t), allocatable :: corners(:, :), nodes(:, :), of_face(:)
    integer(c_int64_t) :: vertices, before, after, k_edges, k_faces, invalid, quads
    call make_square(first)
    call make_square(second)
    call carreau_mesh_generate(first, status)
    call carreau_session_mesh(first, old, status)
    call carreau_mesh_carry(second, old, status)
    call check(status == CARREAU_OK, carreau_last_error(second))
    call carreau_mesh_carry(second, old, status, match=CARREAU_MATCH_SHAPE)
    call carreau_session_mesh(second, new, status)
    call carreau_mesh_vertices(old, p, status)
    call carreau_mesh_vertices(new, q, status)
    call check(all(abs(p - q) < 1e-12_c_double), 'the same square')
    call carreau_mesh_count(new, vertices, before, k_edges, k_faces, status)
    call carreau_mesh_halve(second, 1, status)
    call carreau_mesh_count(new, vertices, after, k_edges, k_faces, status)
    call check(status == CARREAU_OK .and. after == 4*before, 'four for each')
    call carreau_mesh_refine(second, CARREAU_MARK_ELEMENTS, [1], status)
    call carreau_mesh_triangles(new, corners, status)
    call carreau_mesh_refine(second, CARREAU_MARK_EDGES, corners(1:2, 1), status)
    call check(status == CARREAU_OK .and. size(corners, 2) > after, carreau_last_error(second))
    call carreau_mesh_count(new, vertices, after, k_edges, k_faces, status)
    call carreau_mesh_refine_sizes(second, spread(0.03_c_double, 1, int(vertices)), status)
    call carreau_mesh_count(new, vertices, before, k_edges, k_faces, status)
    call check(status == CARREAU_OK .and. before > after, 'sizes')
    call carreau_raise_order(first, 3, status, places=CARREAU_GAUSS_LOBATTO, invalid=invalid)
    call check(status == CARREAU_OK .and. invalid == 0, carreau_last_error(first))
    call carreau_raised_count(first, vertices, after, quads, k_edges, status)
    call carreau_raised_nodes(first, p, status)
    call carreau_raised_elements(first, 3, 3, nodes, of_face, status)
    call check(status == CARREAU_OK .and. size(p, 2) == vertices .and. size(nodes, 2) == after .and. size(nodes, 1) == 10 .and. &
      minval(nodes) == 1 .and. maxval(nodes) == vertices .and. all(of_face == 1) .and. quads == 0, 'order 3')
    call carreau_raised_write(first, 'raised.vtu', status)
    call check(status == CARREAU_OK, carreau_last_error(first))
    call carreau_session_free(first)
    call carreau_session_free(second)
  end subroutine follow_and_raise

  subroutine make_square(made)
    type(carreau_session), intent(out) :: made
    integer(c_int32_t) :: i
    call carreau_session_create(made, status)
    call carreau_geometry_begin(made, surface, interval, side, status)
    call carreau_model_add_face(made, 1, 1, status)
    do i = 1, 4
      call carreau_model_add_curve(made, 1, CARREAU_BOUNDARY, i, i, mod(i, 4) + 1, status)
    end do
    call carreau_geometry_end(made, status)
    call carreau_set_real(made, 'hphydef', 0.2d0, status)
  end subroutine make_square

  ! Six lines, four corners, four plane faces of area 1/2 (three of them) and sqrt(3)/2.
  subroutine triangles_of_a_tetrahedron(fine)
    type(carreau_mesh), intent(in) :: fine
    type(carreau_session) :: other
    type(carreau_mesh) :: made
    type(carreau_triangles_report) :: report
    type(carreau_quality) :: of_made
    real(c_double) :: distances(2), bounds(4)
    type(carreau_delivered) :: delivered
    integer(c_int64_t) :: n
    call carreau_session_create(other, status)
    call carreau_add_triangles(other, carreau_triangles_options(corner_angle=30._c_double), &
      reshape(real([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1], c_double), [3, 4]), &
      reshape([1, 3, 2, 1, 2, 4, 1, 4, 3, 2, 3, 4], [3, 4]), status)
    call check(status == CARREAU_OK, carreau_last_error(other))
    call carreau_triangles_measure(other, report, status)
    call check(report%lines == 6 .and. report%corners == 4 .and. report%regions == 4, 'lines of a tetrahedron')
    call check(report%euler_number == 2 .and. report%deviation < 1e-15_c_double, 'a plane surface')
    call carreau_triangles_refine(other, 8._c_double, 0, fine, status)
    call carreau_mesh_edges(fine, edges, status)
    call check(size(edges, 2) == 6, 'edges of lines')
    call carreau_set_real(other, 'hphydef', 0.2_c_double, status)
    call carreau_mesh_generate(other, status)
    call check(status == CARREAU_OK, carreau_last_error(other))
    call carreau_session_mesh(other, made, status)
    call carreau_mesh_quality(made, of_made, status)
    call check(abs(of_made%area - 1.5_c_double - sqrt(3._c_double) / 2) < 1e-12_c_double, 'area')
    call check(of_made%open_edges == 0, 'closed')
    call carreau_triangles_distances(other, distances, status)
    call check(all(distances < 1e-12_c_double), 'distances')
    call carreau_triangles_bounds(other, 0._c_double, bounds, status)
    call check(status == CARREAU_OK .and. all(bounds < 1e-5_c_double), 'bounds of the distances')
    call check(bounds(1) <= bounds(2) .and. bounds(3) <= bounds(4), 'lower and upper bounds')
    call carreau_session_delivered(other, delivered, status)
    call check(delivered%input_bound >= bounds(1) .and. delivered%input_back_bound < 1e-5_c_double, 'delivered bounds')
    call carreau_geometry_count(other, n, status)
    call check(n == 1, 'one geometry')
    ! Another tetrahedron beside it, three units off
    call carreau_add_triangles(other, carreau_triangles_options(corner_angle=30._c_double), &
      reshape(real([3, 0, 0, 4, 0, 0, 3, 1, 0, 3, 0, 1], c_double), [3, 4]), &
      reshape([1, 3, 2, 1, 2, 4, 1, 4, 3, 2, 3, 4], [3, 4]), status)
    call check(status == CARREAU_OK, carreau_last_error(other))
    call carreau_triangles_measure(other, report, status)
    call check(report%shells == 2 .and. report%lines == 12 .and. report%euler_number == 4, 'two surfaces of triangles')
    call carreau_mesh_generate(other, status)
    call carreau_session_mesh(other, made, status)
    call carreau_mesh_quality(made, of_made, status)
    call check(abs(of_made%area - 3 - sqrt(3._c_double)) < 1e-12_c_double, 'area of two')
    call carreau_session_free(other)
  end subroutine triangles_of_a_tetrahedron
  !> A ring of radii 1 and 2 by arcs of circles: the area is that between polygons of equal edges.
  subroutine ring_of_arcs
    type(carreau_session) :: other
    type(carreau_mesh) :: made
    type(carreau_quality) :: of_made
    type(carreau_plane_curves) :: curves
    integer(c_int32_t), allocatable :: of_edges(:)
    real(c_double) :: points(2, 4), area
    real(c_double), parameter :: pi = 3.14159265358979323846_c_double
    integer :: n(2), i
    points = reshape([2, 0, -2, 0, 1, 0, -1, 0], [2, 4])
    curves%points = [integer(c_int32_t) :: 1, 2, 1, 3, 4, 3]
    curves%starts = [integer(c_int32_t) :: 1, 4, 7]
    curves%smooth = [CARREAU_ARCS, CARREAU_ARCS]
    curves%refs = [integer(c_int32_t) :: 1, 2]
    call carreau_session_create(other, status)
    call carreau_add_plane_domain(other, points, curves, status)
    call check(status == CARREAU_OK, carreau_last_error(other))
    call carreau_set_real(other, 'hphydef', 0.2_c_double, status)
    call carreau_mesh_generate(other, status)
    call check(status == CARREAU_OK, carreau_last_error(other))
    call carreau_session_mesh(other, made, status)
    call carreau_mesh_quality(made, of_made, status)
    call carreau_mesh_edge_refs(made, of_edges, status)
    do i = 1, 2
      n(i) = size(pack(of_edges, of_edges == i))
    end do
    area = 2 * n(1) * sin(2 * pi / n(1)) - n(2) / 2._c_double * sin(2 * pi / n(2))
    call check(n(1) > 50 .and. abs(of_made%area - area) < 1e-6_c_double, 'a ring of arcs')
    call quadrics_of_a_sphere(other, made)
    call carreau_session_free(other)
  end subroutine ring_of_arcs
  !> The graph of a field is a sphere of radius 3: sizes are 2 R sin(8 degrees) in its tangent planes, and z / R of it in the plane.
  subroutine quadrics_of_a_sphere(other, made)
    type(carreau_session), intent(inout) :: other
    type(carreau_mesh), intent(inout) :: made
    type(carreau_estimator) :: estimator
    real(c_double), allocatable :: at(:, :), sizes(:), metrics(:, :), ratios(:), z(:)
    real(c_double), parameter :: angle = 8 * 3.14159265358979323846_c_double / 180
    logical, allocatable :: inside(:)
    call carreau_mesh_vertices(made, at, status)
    z = sqrt(9 - at(1, :)**2 - at(2, :)**2)
    estimator%source = CARREAU_CURVATURE
    estimator%shape = CARREAU_GRAPH
    estimator%tolerance = 8
    estimator%hmin = 1e-3_c_double
    estimator%hmax = 10
    estimator%recovery = CARREAU_QUADRIC
    call carreau_estimate(other, estimator, z, sizes, metrics, status)
    call check(status == CARREAU_OK, carreau_last_error(other))
    inside = abs(norm2(at(1:2, :), 1) - 1.5_c_double) < 0.25_c_double
    ratios = pack(sizes / (2 * sin(angle) * z), inside)
    call check(size(ratios) > 50, 'the ring has vertices inside')
    call check(abs(sum(ratios) / size(ratios) - 1) < 0.1_c_double, 'quadrics find the curvature of a sphere')
  end subroutine quadrics_of_a_sphere
  subroutine check(good, what)
    logical, intent(in) :: good
    character(len=*), intent(in) :: what
    if (good) return
    write (*, '(a)') what
    error stop 1
  end subroutine check
end program geometries_fortran_test
