! SPDX-License-Identifier: BSD-3-Clause
! Module carreau: a mesh of the paraboloid identical to the mesh in C; base 1; texts; callbacks; errors.
module paraboloid_m
  use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int32_t, c_int64_t, c_ptr
  use carreau
  implicit none

  !> The target of `user`.
  type :: watch
    integer :: reports = 0, stop_at = 0, messages = 0
    character(len=200) :: last_message = ' '
  end type watch

  real(c_double), parameter :: corner(2, 5) = reshape([-2.5d0, -2.5d0, 2.5d0, -2.5d0, 2.5d0, 2.5d0, -2.5d0, 2.5d0, &
    -2.5d0, -2.5d0], [2, 5])
contains
  subroutine surf0(refs, uv, S) bind(c)
    integer(c_int32_t), intent(in) :: refs
    real(c_double), intent(in) :: uv(2)
    real(c_double), intent(out) :: S(3)
    S = [uv(1), uv(2), (uv(1)*uv(1) + uv(2)*uv(2))/2]
    if (refs /= 1) S = 0
  end subroutine surf0

  subroutine surf1(refs, uv, Su, Sv) bind(c)
    integer(c_int32_t), intent(in) :: refs
    real(c_double), intent(in) :: uv(2)
    real(c_double), intent(out) :: Su(3), Sv(3)
    Su = [1.d0, 0.d0, uv(1)]
    Sv = [0.d0, 1.d0, uv(2)]
    if (refs /= 1) Su = 0
  end subroutine surf1

  subroutine surf2(refs, uv, Suu, Suv, Svv) bind(c)
    integer(c_int32_t), intent(in) :: refs
    real(c_double), intent(in) :: uv(2)
    real(c_double), intent(out) :: Suu(3), Suv(3), Svv(3)
    Suu = [0.d0, 0.d0, 1.d0]
    Suv = 0*uv(1)
    Svv = Suu
    if (refs /= 1) Suu = 0
  end subroutine surf2

  subroutine curv_int(refs, ic, a, b) bind(c)
    integer(c_int32_t), intent(in) :: refs, ic
    real(c_double), intent(out) :: a, b
    a = 0*refs
    b = 1 + 0*ic
  end subroutine curv_int

  subroutine curv0(refs, ic, t, C) bind(c)
    integer(c_int32_t), intent(in) :: refs, ic
    real(c_double), intent(in) :: t
    real(c_double), intent(out) :: C(2)
    C = corner(:, ic) + t*(corner(:, ic + refs) - corner(:, ic))
  end subroutine curv0

  subroutine curv1(refs, ic, t, C) bind(c)
    integer(c_int32_t), intent(in) :: refs, ic
    real(c_double), intent(in) :: t
    real(c_double), intent(out) :: C(2)
    C = corner(:, ic + refs) - corner(:, ic) + 0*t
  end subroutine curv1

  subroutine curv2(refs, ic, t, C) bind(c)
    integer(c_int32_t), intent(in) :: refs, ic
    real(c_double), intent(in) :: t
    real(c_double), intent(out) :: C(2)
    C = 0*t*(refs + ic)
  end subroutine curv2

  ! The same by value.
  function surface(face, u, v, order, S, Su, Sv, Suu, Suv, Svv, user) result(status) bind(c)
    integer(c_int32_t), value :: face, order
    real(c_double), value :: u, v
    real(c_double), intent(inout) :: S(3), Su(3), Sv(3), Suu(3), Suv(3), Svv(3)
    type(c_ptr), value :: user
    integer(c_int32_t) :: status
    call surf0(face, [u, v], S)
    if (order >= 1) call surf1(face, [u, v], Su, Sv)
    if (order >= 2) call surf2(face, [u, v], Suu, Suv, Svv)
    status = merge(0, 1, c_associated(user))
  end function surface

  function interval(face, ic, a, b, user) result(status) bind(c)
    integer(c_int32_t), value :: face, ic
    real(c_double), intent(inout) :: a, b
    type(c_ptr), value :: user
    integer(c_int32_t) :: status
    call curv_int(face, ic, a, b)
    status = merge(0, 1, c_associated(user))
  end function interval

  function curve(face, ic, t, order, C, Ct, Ctt, user) result(status) bind(c)
    integer(c_int32_t), value :: face, ic, order
    real(c_double), value :: t
    real(c_double), intent(inout) :: C(2), Ct(2), Ctt(2)
    type(c_ptr), value :: user
    integer(c_int32_t) :: status
    call curv0(face, ic, t, C)
    if (order >= 1) call curv1(face, ic, t, Ct)
    if (order >= 2) call curv2(face, ic, t, Ctt)
    status = merge(0, 1, c_associated(user))
  end function curve

  function progress(phase, entity, fraction, user) result(status) bind(c)
    integer(c_int32_t), value :: phase, entity
    real(c_double), value :: fraction
    type(c_ptr), value :: user
    integer(c_int32_t) :: status
    type(watch), pointer :: w
    call c_f_pointer(user, w)
    w%reports = w%reports + 1
    status = 0
    if (w%reports == w%stop_at) status = 1
    if (phase < CARREAU_PHASE_IDLE .or. fraction < 0 .or. fraction > 1 .or. entity < 0) w%reports = -1000
  end function progress

  function height(n, xyz, values, user) result(status) bind(c)
    integer(c_int64_t), value :: n
    real(c_double), intent(in) :: xyz(3, n)
    real(c_double), intent(out) :: values(n)
    type(c_ptr), value :: user
    integer(c_int32_t) :: status
    values = xyz(1, :)**2 - xyz(2, :)**2
    status = merge(1, 0, c_associated(user))
  end function height

  !> The size .3 at points of the paraboloid; the status 7 where xyz belongs to another place than uv.
  function sizes_of_points(face, n, uv, xyz, kind, value, user) result(status) bind(c)
    integer(c_int32_t), value :: face
    integer(c_int64_t), value :: n
    real(c_double), intent(in) :: uv(2, n), xyz(3, n)
    integer(c_int32_t), intent(inout) :: kind(n)
    real(c_double), intent(inout) :: value(6, n)
    type(c_ptr), value :: user
    integer(c_int32_t) :: status
    kind = CARREAU_METRIC_SIZE
    value(1, :) = 0.3d0
    status = merge(0, 7, face == 1 .and. .not. c_associated(user) .and. all(xyz(1:2, :) == uv) .and. &
      all(xyz(3, :) == (uv(1, :)**2 + uv(2, :)**2)/2))
  end function sizes_of_points

  subroutine message(level, text, user) bind(c)
    integer(c_int32_t), value :: level
    type(c_ptr), value :: text, user
    type(watch), pointer :: w
    call c_f_pointer(user, w)
    w%messages = w%messages + 1
    w%last_message = carreau_string(text)
    if (level < CARREAU_LEVEL_ERROR) w%messages = -1000
  end subroutine message
end module paraboloid_m

program fortran_test
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int32_t, c_int64_t, c_loc, c_null_char, c_ptr
  use carreau
  use paraboloid_m
  implicit none
  interface
    function c_paraboloid(hphydef, capacity, xyz, triangles, out_triangles) result(n) bind(c, name="c_paraboloid")
      import :: c_double, c_int32_t, c_int64_t
      implicit none
      real(c_double), value :: hphydef
      integer(c_int64_t), value :: capacity
      real(c_double), intent(out) :: xyz(*)
      integer(c_int32_t), intent(out) :: triangles(*)
      integer(c_int64_t), intent(out) :: out_triangles
      integer(c_int64_t) :: n
    end function c_paraboloid
    function c_paraboloid_in_tetrahedron(corners, sizes, capacity, xyz) result(n) bind(c, name="c_paraboloid_in_tetrahedron")
      import :: c_double, c_int64_t
      implicit none
      real(c_double), intent(in) :: corners(*), sizes(*)
      integer(c_int64_t), value :: capacity
      real(c_double), intent(out) :: xyz(*)
      integer(c_int64_t) :: n
    end function c_paraboloid_in_tetrahedron
    function c_paraboloid_image(path) result(status) bind(c, name="c_paraboloid_image")
      import :: c_char, c_int32_t
      implicit none
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int32_t) :: status
    end function c_paraboloid_image
  end interface
  real(c_double), parameter :: h = 0.2d0
  integer(c_int64_t), parameter :: capacity = 20000
  integer :: failures = 0

  call test_versions_and_parameters
  call test_same_mesh_as_in_c
  call test_callbacks_by_value_and_files
  call test_divided_curves
  call test_metric_batches
  call test_elements
  call test_curve
  call test_adaptation
  call test_fields
  call test_background_and_image_as_in_c
  call test_errors
  if (failures > 0) stop 1
  print '(a)', 'fortran_test: all passed'

contains

  subroutine expect(holds, what)
    logical, intent(in) :: holds
    character(len=*), intent(in) :: what
    if (holds) return
    failures = failures + 1
    print '(2a)', 'FAILED: ', what
  end subroutine expect

  subroutine expect_ok(status, session, what)
    integer(c_int32_t), intent(in) :: status
    type(carreau_session), intent(in) :: session
    character(len=*), intent(in) :: what
    call expect(status == CARREAU_OK, what//': '//carreau_last_error(session))
  end subroutine expect_ok

  subroutine build_model(session)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t) :: ic, status
    call carreau_model_add_face(session, 1, 1, status)
    call expect_ok(status, session, 'add_face')
    do ic = 1, 4
      call carreau_model_add_curve(session, 1, CARREAU_BOUNDARY, ic, ic, mod(ic, 4) + 1, status)
      call expect_ok(status, session, 'add_curve')
    end do
  end subroutine build_model

  subroutine test_versions_and_parameters
    type(carreau_session) :: session
    type(carreau_parameter) :: parameter
    integer(c_int32_t) :: i, status, verb, rounds
    character(len=:), allocatable :: pref
    real(c_double) :: lss
    call expect(carreau_status_name(CARREAU_ERR_FILE) == 'CARREAU_ERR_FILE', 'status name')
    call expect(carreau_status_meaning(CARREAU_OK) == 'success', 'status meaning')
    call expect(carreau_version_number() >= 100, 'version number')
    call expect(index(carreau_version(), '.') > 0, 'version')
    call carreau_session_create(session, status)
    call expect(status == CARREAU_OK, 'create')
    do i = 1, carreau_parameter_count()
      call carreau_parameter_info(i, parameter, status)
      call expect(status == CARREAU_OK .and. len(parameter%help) > 10, 'parameter '//parameter%name)
      if (parameter%name == 'hphydef') call expect(parameter%diag_relative .and. &
        abs(parameter%default_number - 0.02d0) < 1d-15 .and. parameter%type == CARREAU_REAL, 'hphydef is diag/50')
      if (parameter%name == 'certify') call expect(parameter%set_by == 'effort', 'effort sets certify')
      if (parameter%name == 'format') call expect(parameter%default_text == 'mesh' .and. &
        index(parameter%choices, 'vtu') > 0, 'choices of format')
    end do
    call carreau_parameter_info(0, parameter, status)
    call expect(status == CARREAU_ERR_ARGUMENT, 'parameters count from 1')
    call carreau_set_integer(session, 'verb  ', 50, status) ! trailing blanks do not count
    call expect_ok(status, session, 'set verb')
    call carreau_get_integer(session, 'verb', verb, status)
    call expect(verb == 50, 'get verb')
    call carreau_set_text(session, 'pref', 'teapot', status)
    call carreau_get_text(session, 'pref', pref, status)
    call expect(pref == 'teapot' .and. len(pref) == 6, 'get pref')
    call carreau_set_word(session, 'LSS', '2.5d-1', status)
    call carreau_get_real(session, 'LSS', lss, status)
    call expect(lss == 0.25d0, 'get LSS')
    call carreau_set_integer(session, 'effort', 1, status)
    call expect_ok(status, session, 'set effort')
    call carreau_get_integer(session, 'crossing_rounds', rounds, status)
    call expect(rounds == 10, 'effort sets crossing_rounds')
    call carreau_reset_parameters(session, status)
    call carreau_get_text(session, 'pref', pref, status)
    call expect(pref == 'x', 'reset')
    call carreau_session_free(session)
    call carreau_session_free(session) ! a handle that is no longer one
  end subroutine test_versions_and_parameters

  subroutine test_same_mesh_as_in_c
    type(carreau_session) :: session
    type(carreau_mesh) :: mesh
    type(carreau_face) :: face
    type(carreau_quality) :: quality
    type(carreau_interface) :: curve
    integer(c_int64_t) :: interfaces
    type(carreau_report) :: report
    real(c_double), allocatable :: xyz(:, :), c_xyz(:, :), uv(:, :, :), sizes(:)
    integer(c_int32_t), allocatable :: triangles(:, :), c_triangles(:, :), refs(:), edges(:, :), edge_refs(:), ends(:, :)
    integer(c_int32_t), allocatable :: face_refs(:), types(:), curve_refs(:)
    integer(c_int64_t) :: n, m, k, f, c_n, c_m, defects, t
    integer(c_int32_t), allocatable :: crossing(:, :)
    real(c_double), allocatable :: places(:, :)
    integer(c_int32_t) :: status
    character(len=:), allocatable :: text
    call carreau_session_create(session, status)
    call carreau_set_cad_m(session, surf0, curv_int, curv0, status, surf1=surf1, surf2=surf2, curv1=curv1, curv2=curv2)
    call expect_ok(status, session, 'set_cad_m')
    call build_model(session)
    call carreau_set_real(session, 'hphydef', h, status)
    call carreau_mesh_generate(session, status)
    call expect_ok(status, session, 'generate')
    call carreau_session_mesh(session, mesh, status)
    call carreau_mesh_count(mesh, n, m, k, f, status)
    call carreau_mesh_vertices(mesh, xyz, status)
    call expect(status == CARREAU_OK .and. all(shape(xyz) == [3_c_int64_t, n]), 'vertices')
    call carreau_mesh_triangles(mesh, triangles, status)
    call expect(minval(triangles) == 1 .and. maxval(triangles) == n, 'triangles count from 1')

    allocate (c_xyz(3, capacity), c_triangles(3, capacity))
    c_n = c_paraboloid(h, capacity, c_xyz, c_triangles, c_m)
    call expect(c_n == n .and. c_m == m, 'as many vertices and triangles as in C')
    if (c_n == n .and. c_m == m) then
      call expect(all(transfer(xyz, [0_c_int64_t]) == transfer(c_xyz(:, :n), [0_c_int64_t])), 'vertices are those of C')
      call expect(all(triangles - 1 == c_triangles(:, :m)), 'triangles are those of C')
    end if

    call carreau_mesh_corner_uv(mesh, uv, status)
    call expect(status == CARREAU_OK .and. all(shape(uv) == [2_c_int64_t, 3_c_int64_t, m]), 'corner_uv')
    do t = 1, m
      if (any(uv(:, :, t) /= xyz(1:2, triangles(:, t)))) exit
    end do
    call expect(t == m + 1, '(u, v) of each corner')
    call carreau_mesh_vertex_sizes(mesh, sizes, status)
    call expect(size(sizes, kind=c_int64_t) == n .and. all(abs(sizes - h) < 0.02d0*h), 'vertex_sizes')
    call carreau_mesh_vertex_refs(mesh, refs, status)
    call expect(count(refs /= 0) == 4, 'four corners')
    call carreau_mesh_triangle_refs(mesh, refs, status)
    call expect(size(refs, kind=c_int64_t) == m .and. all(refs == 1), 'triangle_refs')
    call carreau_mesh_edges(mesh, edges, status)
    call carreau_mesh_edge_refs(mesh, edge_refs, status)
    call expect(size(edges, 2, kind=c_int64_t) == k .and. minval(edges) >= 1 .and. maxval(edges) <= n, 'edges')
    call expect(all(edge_refs >= 1 .and. edge_refs <= 4), 'edge_refs')
    call carreau_mesh_face(mesh, 1_c_int64_t, face, status)
    call expect(face%ref == 1 .and. face%status == CARREAU_FACE_MESHED .and. face%triangles == m .and. face%why == '', &
      'face 1')
    call carreau_mesh_face(mesh, 0_c_int64_t, face, status)
    call expect(status == CARREAU_ERR_ARGUMENT, 'faces count from 1')
    call carreau_mesh_quality(mesh, quality, status)
    call expect(quality%vertices == n .and. quality%triangles == m .and. quality%open_edges == k .and. &
      quality%q2_mean > 0.97d0 .and. quality%degree6 > 0.5d0, 'quality')
    call carreau_mesh_defects(mesh, .false., 10_c_int64_t, defects, text, status)
    call expect(defects == 0 .and. text == '', 'no defects')
    call carreau_mesh_intersections(mesh, 1_c_int32_t, 4_c_int64_t, defects, crossing, places, status)
    call expect(status == CARREAU_OK .and. defects == 0 .and. size(crossing, 2) == 0 .and. size(places, 2) == 0, &
      'no intersections')
    call carreau_mesh_regions(mesh, refs, places, status)
    call expect(status == CARREAU_ERR_ARGUMENT .and. size(refs) == 0 .and. size(places, 2) == 0, 'an open surface bounds no region')
    call carreau_mesh_triangle_sides(mesh, crossing, status)
    call expect(status == CARREAU_ERR_ARGUMENT, 'an open surface has no sides')
    call carreau_session_report(session, report, status)
    call expect(report%surf0_calls >= n .and. report%seconds_total > 0 .and. abs(report%diag - 7.735d0) < 0.01d0, 'report')
    call carreau_session_interface_count(session, interfaces, status)
    call expect(interfaces == 4, 'interfaces')
    call carreau_session_interface(session, 4_c_int64_t, curve, status)
    call expect(curve%curve == 4 .and. curve%uses == 1 .and. curve%face == 1 .and. curve%ic == 4 .and. curve%boundary &
      .and. .not. curve%glued .and. curve%gap == 0, 'interface 4')
    call check_delivered(session, xyz, triangles)
    call carreau_model_curves(session, face_refs, types, curve_refs, ends, status)
    call expect(all(ends(2, :) == [2, 3, 4, 1]) .and. all(types == CARREAU_BOUNDARY) .and. all(face_refs == 1) .and. &
      all(curve_refs == [1, 2, 3, 4]), 'model_curves')
    call carreau_session_free(session)
  end subroutine test_same_mesh_as_in_c

  ! Curve 1 in three edges by a progression, curve 2 by its parameters, curve 3 as at first.
  subroutine test_divided_curves
    type(carreau_session) :: session
    type(carreau_mesh) :: mesh
    integer(c_int32_t), allocatable :: edge_refs(:)
    integer(c_int32_t) :: status
    call carreau_session_create(session, status)
    call carreau_set_cad_m(session, surf0, curv_int, curv0, status, surf1=surf1, surf2=surf2, curv1=curv1, curv2=curv2)
    call build_model(session)
    call carreau_set_real(session, 'hphydef', 0.5d0, status)
    call carreau_set_integer(session, 'flag', 1, status)
    call carreau_model_divide_curve(session, 1, 1, 3, CARREAU_GEOMETRIC, 1.5d0, status)
    call expect_ok(status, session, 'divide_curve')
    call carreau_model_divide_curve_at(session, 1, 2, [0.25d0, 0.5d0, 0.75d0, 0.875d0], status)
    call expect_ok(status, session, 'divide_curve_at')
    call carreau_model_divide_curve(session, 1, 3, 2, CARREAU_EQUAL, 1.d0, status)
    call carreau_model_divide_curve(session, 1, 3, 0, CARREAU_EQUAL, 1.d0, status)
    call carreau_mesh_generate(session, status)
    call expect_ok(status, session, 'generate')
    call carreau_session_mesh(session, mesh, status)
    call carreau_mesh_edge_refs(mesh, edge_refs, status)
    call expect(count(edge_refs == 1) == 3 .and. count(edge_refs == 2) == 5 .and. &
      count(edge_refs == 3) == count(edge_refs == 4), 'divided curves')
    call carreau_model_divide_curve(session, 1, 9, 3, CARREAU_EQUAL, 1.d0, status)
    call expect(status == CARREAU_ERR_ARGUMENT, 'no such curve')
    call carreau_session_free(session)
  end subroutine test_divided_curves

  ! Curved triangles: nodes from 1, on the paraboloid; corners are the corners of the triangles.
  subroutine test_elements
    type(carreau_session) :: session
    type(carreau_mesh) :: mesh
    type(carreau_cell_quality) :: quality
    real(c_double), allocatable :: xyz(:, :), uv(:, :, :)
    integer(c_int32_t), allocatable :: triangles(:, :), nodes(:, :), refs(:), mids(:), faces(:, :)
    integer(c_int64_t) :: n, m, k, f, cells, e
    integer(c_int32_t) :: status
    real(c_double) :: off
    integer :: i
    call carreau_session_create(session, status)
    call carreau_set_cad_m(session, surf0, curv_int, curv0, status, surf1=surf1, surf2=surf2, curv1=curv1, curv2=curv2)
    call build_model(session)
    call carreau_set_real(session, 'hphydef', h, status)
    call carreau_set_text(session, 'element', 'p2', status)
    call carreau_mesh_generate(session, status)
    call expect_ok(status, session, 'generate p2')
    call carreau_session_mesh(session, mesh, status)
    call carreau_mesh_count(mesh, n, m, k, f, status)
    call carreau_mesh_cell_count(mesh, CARREAU_CELL_TRIANGLE6, cells, status)
    call expect(status == CARREAU_OK .and. cells == m, 'cell_count')
    call carreau_mesh_vertices(mesh, xyz, status)
    call carreau_mesh_triangles(mesh, triangles, status)
    call carreau_mesh_cells(mesh, CARREAU_CELL_TRIANGLE6, nodes, refs, status)
    call expect(status == CARREAU_OK .and. all(nodes(1:3, :) == triangles) .and. all(refs == 1), 'cells')
    call expect(minval(nodes) == 1 .and. maxval(nodes) == n, 'nodes count from 1')
    call carreau_mesh_cell_uv(mesh, CARREAU_CELL_TRIANGLE6, uv, status)
    off = 0
    do e = 1, m
      do i = 1, 6
        off = max(off, maxval(abs(uv(:, i, e) - xyz(1:2, nodes(i, e)))))
      end do
    end do
    call expect(status == CARREAU_OK .and. off < 1d-14, '(u, v) of each node')
    call carreau_mesh_edge_mids(mesh, mids, status)
    call expect(size(mids, kind=c_int64_t) == k .and. minval(mids) > maxval(triangles), 'edge_mids')
    call carreau_mesh_cell_quality(mesh, quality, status)
    call expect(status == CARREAU_OK .and. quality%triangles6 == m .and. quality%invalid == 0 .and. &
      quality%least_jacobian_min > 0, 'cell_quality')
    ! Cross-patch: quadrilaterals whose nodes are at their (u, v) of the returned faces.
    call carreau_set_text(session, 'patches', 'independent', status)
    call carreau_set_text(session, 'element', 'q2.1', status)
    call carreau_mesh_generate(session, status)
    call expect_ok(status, session, 'generate q2.1, independent')
    call carreau_session_mesh(session, mesh, status)
    call carreau_mesh_vertices(mesh, xyz, status)
    call carreau_mesh_cells(mesh, CARREAU_CELL_QUAD8, nodes, refs, status)
    call carreau_mesh_cell_uv(mesh, CARREAU_CELL_QUAD8, uv, status)
    call carreau_mesh_cell_faces(mesh, CARREAU_CELL_QUAD8, faces, status)
    call expect(status == CARREAU_OK .and. all(shape(faces) == shape(nodes)) .and. size(refs) > 0, 'cell_faces')
    off = 0
    do e = 1, size(refs)
      do i = 1, 8
        off = max(off, maxval(abs(uv(:, i, e) - xyz(1:2, nodes(i, e)))))
      end do
    end do
    call expect(all(faces == 1) .and. off < 1d-14, '(u, v) of each node, independent')
    call carreau_mesh_cell_quality(mesh, quality, status)
    call expect(quality%quads8 == size(refs) .and. quality%invalid == 0, 'only valid quadrilaterals')
    call carreau_session_free(session)
  end subroutine test_elements

  subroutine check_delivered(session, xyz, triangles)
    type(carreau_session), intent(in) :: session
    real(c_double), intent(in) :: xyz(:, :)
    integer(c_int32_t), intent(in) :: triangles(:, :)
    type(carreau_delivered) :: delivered
    type(carreau_measure) :: measure
    real(c_double), allocatable :: length(:), bounds(:)
    integer(c_int64_t), allocatable :: counts(:)
    integer(c_int32_t), allocatable :: ends(:, :), curves(:), sides(:, :)
    integer(c_int32_t) :: status, t, i
    real(c_double) :: chord
    call carreau_session_delivered(session, delivered, status)
    call expect_ok(status, session, 'delivered')
    call expect(delivered%vertices - delivered%edges + delivered%triangles == 1 .and. delivered%in_range > 0.95d0 .and. &
      delivered%folded_triangles == 0 .and. delivered%surf0_calls > 0 .and. index(delivered%text, 'shape Q2') > 0, 'delivered')
    call carreau_delivered_measure(session, CARREAU_MEASURE_LENGTH, measure, status)
    call expect(measure%name == 'metric_length' .and. measure%entity == CARREAU_OF_EDGES .and. &
      abs(measure%mean - 1) < 0.05d0 .and. measure%limit > huge(1.d0), 'measure')
    call carreau_delivered_values(session, CARREAU_MEASURE_LENGTH, length, status)
    call carreau_delivered_edges(session, ends, curves, status)
    call expect(size(length, kind=c_int64_t) == delivered%edges .and. minval(ends) == 1 .and. &
      maxval(ends) == delivered%vertices .and. all(shape(ends) == [2_c_int64_t, delivered%edges]), 'values and edges')
    call carreau_delivered_triangle_edges(session, sides, status)
    do t = 1, size(triangles, 2)
      do i = 1, 3
        if (any(ends(:, sides(i, t)) /= [min(triangles(i, t), triangles(mod(i, 3) + 1, t)), &
          max(triangles(i, t), triangles(mod(i, 3) + 1, t))])) status = -1
        chord = norm2(xyz(:, triangles(i, t)) - xyz(:, triangles(mod(i, 3) + 1, t)))/h
        if (length(sides(i, t)) < 0.999d0*chord .or. length(sides(i, t)) > 1.1d0*chord) status = -1
      end do
    end do
    call expect(status == CARREAU_OK, 'edges of triangles')
    call carreau_delivered_histogram(session, CARREAU_MEASURE_LENGTH, bounds, counts, status)
    call expect(size(bounds) == measure%classes .and. sum(counts) == delivered%edges, 'histogram')
    call carreau_delivered_values(session, 0_c_int32_t, length, status)
    call expect(status == CARREAU_ERR_ARGUMENT .and. .not. allocated(length), 'kinds count from 1')
    call carreau_delivered_write(session, 'delivered.json', status)
    call expect_ok(status, session, 'delivered_write')
  end subroutine check_delivered

  subroutine test_callbacks_by_value_and_files
    type(carreau_session) :: session
    type(carreau_mesh) :: mesh, read
    type(watch), target :: w
    real(c_double), allocatable :: xyz(:, :), c_xyz(:, :), read_xyz(:, :), uv(:, :, :)
    integer(c_int32_t), allocatable :: c_triangles(:, :)
    integer(c_int64_t) :: c_n, c_m
    integer(c_int32_t) :: status
    character(len=*), parameter :: path = 'carreau_fortran_test.mesh'
    call carreau_session_create(session, status)
    call carreau_set_cad(session, surface, interval, curve, status, user=c_loc(w))
    call expect_ok(status, session, 'set_cad')
    call build_model(session)
    call carreau_set_real(session, 'hphydef', h, status)
    call carreau_set_progress_callback(session, status, progress, c_loc(w))
    call carreau_set_message_callback(session, status, message, c_loc(w))
    call carreau_set_real(session, 'eps_ends', 100.d0, status) ! each curve is reported
    w%stop_at = 2
    call carreau_mesh_generate(session, status)
    call expect(status == CARREAU_ERR_CANCELLED, 'a status of the progress callback stops the run')
    w%stop_at = 0
    call carreau_mesh_generate(session, status)
    call expect_ok(status, session, 'generate after a stop')
    call expect(w%reports > 2 .and. w%messages >= 4 .and. len_trim(w%last_message) > 10, 'progress and messages')
    call carreau_session_mesh(session, mesh, status)
    call carreau_mesh_vertices(mesh, xyz, status)
    allocate (c_xyz(3, capacity), c_triangles(3, capacity))
    c_n = c_paraboloid(h, capacity, c_xyz, c_triangles, c_m)
    call expect(size(xyz, 2, kind=c_int64_t) == c_n, 'by value: as many vertices as in C')
    if (size(xyz, 2, kind=c_int64_t) == c_n) call expect(all(xyz == c_xyz(:, :c_n)), 'by value: the vertices of C')
    call carreau_mesh_write(mesh, path, status)
    call expect(status == CARREAU_OK, carreau_mesh_last_error(mesh))
    call carreau_mesh_create(read, status)
    call carreau_mesh_read(read, path, status)
    call expect(status == CARREAU_OK, carreau_mesh_last_error(read))
    call carreau_mesh_vertices(read, read_xyz, status)
    call expect(all(shape(read_xyz) == shape(xyz)), 'read back')
    if (all(shape(read_xyz) == shape(xyz))) call expect(all(read_xyz == xyz), 'read back bit for bit')
    call carreau_mesh_corner_uv(read, uv, status)
    call expect(status == CARREAU_ERR_SEQUENCE .and. .not. allocated(uv), 'a file has no (u, v)')
    call carreau_mesh_free(read)
    open (unit=10, file=path)
    close (unit=10, status='delete')
    call carreau_session_free(session)
  end subroutine test_callbacks_by_value_and_files

  subroutine test_curve
    type(carreau_session) :: session
    real(c_double), parameter :: h(5) = [1.5d0, 0.5d0, 2d0, 0.1d0, 0.7d0], s(5) = [0d0, 3d0, 4d0, 8d0, 10d0]
    integer, parameter :: edges(0:2) = [17, 26, 21]
    real(c_double) :: points(2, 2), metrics(3, 5), length
    real(c_double), allocatable :: cuts(:)
    integer(c_int32_t) :: status, law
    points = reshape([0d0, 0d0, 6d0, 8d0], [2, 2])
    metrics = 0
    metrics(1, :) = 1 / h**2
    metrics(3, :) = metrics(1, :)
    call carreau_session_create(session, status)
    do law = 0, 2 ! RR-2818 sec. 6.1
      call carreau_curve_split(session, points, s, metrics, law, 0d0, cuts, length, status)
      call expect_ok(status, session, 'curve_split')
      call expect(size(cuts) == edges(law) + 1, 'the curve has the edges of RR-2818')
      call expect(abs(cuts(size(cuts)) - 10) < 1d-12 .and. nint(length) == edges(law), 'the split ends where the curve does')
    end do
    call test_metric_algebra(session)
    call carreau_curve_split(session, points, s, metrics(:2, :), 0, 0d0, cuts, length, status)
    call expect(status == CARREAU_ERR_ARGUMENT, 'metrics of two rows are refused')
    call carreau_session_free(session)
  end subroutine test_curve

  subroutine test_metric_batches
    type(carreau_session) :: session
    type(carreau_mesh) :: mesh
    real(c_double), allocatable :: h(:)
    integer(c_int32_t) :: status
    call carreau_session_create(session, status)
    call carreau_set_cad_m(session, surf0, curv_int, curv0, status)
    call build_model(session)
    call carreau_set_real(session, 'hphydef', 1d0, status)
    call carreau_set_metric_callbacks(session, status, surface_metric_batch=sizes_of_points)
    call expect_ok(status, session, 'set_metric_callbacks')
    call carreau_mesh_generate(session, status)
    call expect_ok(status, session, 'mesh_generate with sizes in batches')
    call carreau_session_mesh(session, mesh, status)
    call carreau_mesh_vertex_sizes(mesh, h, status)
    call expect(size(h) > 500 .and. all(abs(h - 0.3d0) < 1d-9), 'the sizes of the batches hold')
    call carreau_session_free(session)
  end subroutine test_metric_batches

  !> The results that tests/cabi/metric_algebra_test.cpp checks in C.
  subroutine test_metric_algebra(session)
    type(carreau_session), intent(in) :: session
    real(c_double), allocatable :: m(:, :), found(:, :), h(:, :), k(:, :), axes(:, :, :), l(:)
    real(c_double) :: three(3, 3, 1), a, edges(2, 2, 1), ends(3, 2, 1)
    integer(c_int32_t) :: status
    integer :: i
    do i = 1, 3
      a = (i - 1) * acos(-1d0) / 3
      call carreau_metric_of_sizes(session, reshape([.2d0, 1d0], [2, 1]), &
        reshape([cos(a), sin(a), -sin(a), cos(a)], [2, 2, 1]), m, status)
      call expect_ok(status, session, 'metric_of_sizes')
      three(:, i, 1) = m(:, 1)
    end do
    call carreau_metric_intersect(session, CARREAU_INTERSECT_LARGEST, three, found, status)
    call expect_ok(status, session, 'metric_intersect')
    call expect(all(abs(found(:, 1) - [25d0, 0d0, 25d0]) < 1d-7), 'the largest ellipse inside three is a circle')
    call carreau_metric_sizes(session, three(:, :, 1), h, axes, status)
    call expect_ok(status, session, 'metric_sizes')
    call expect(all(abs(h(1, :) - .2d0) < 1d-12) .and. all(abs(h(2, :) - 1) < 1d-12), 'sizes come back')
    call carreau_metric_interpolate(session, 1_c_int32_t, reshape([1d0, 0d0, 1d0], [3, 1]), &
      reshape([.0625d0, 0d0, 1d0], [3, 1]), [.5d0], m, status)
    call expect_ok(status, session, 'metric_interpolate')
    call expect(abs(1 / sqrt(m(1, 1)) - 2) < 1d-12, 'a geometric mean of sizes')
    call carreau_metric_reduce(session, three(:, 1:1, 1), three(:, 2:2, 1), h, k, axes, status)
    call expect_ok(status, session, 'metric_reduce')
    call expect(abs(three(1, 1, 1) * axes(1, 1, 1) * axes(1, 2, 1) + three(2, 1, 1) * (axes(1, 1, 1) * axes(2, 2, 1) &
      + axes(2, 1, 1) * axes(1, 2, 1)) + three(3, 1, 1) * axes(2, 1, 1) * axes(2, 2, 1)) < 1d-12, 'directions are conjugate')
    edges(:, :, 1) = reshape([0d0, 0d0, 2d0, 0d0], [2, 2])
    ends(:, :, 1) = reshape([1d0, 0d0, 1d0, exp(-2d0), 0d0, 1d0], [3, 2])
    call carreau_metric_lengths(session, 1_c_int32_t, edges, ends, l, status)
    call expect_ok(status, session, 'metric_lengths')
    call expect(abs(l(1) - 2 * (1 - exp(-1d0))) < 2d-4, 'length of an edge')
    call carreau_metric_sizes(session, ends(:2, :, 1), h, axes, status)
    call expect(status == CARREAU_ERR_ARGUMENT, 'metrics of two rows are no metrics')
  end subroutine test_metric_algebra

  subroutine test_adaptation
    type(carreau_session) :: session
    type(carreau_mesh) :: mesh
    type(carreau_estimator) :: estimator
    type(carreau_adaptation_report) :: report
    type(carreau_background_report) :: background
    real(c_double), allocatable :: xyz(:, :), sizes(:), metrics(:, :), moved(:, :), now(:, :)
    real(c_double) :: corners(2, 4), metric(3, 4)
    integer(c_int32_t) :: status, halves(3, 2)
    integer(c_int64_t) :: outside
    call carreau_session_create(session, status)
    call carreau_set_cad_m(session, surf0, curv_int, curv0, status)
    call build_model(session)
    call carreau_set_real(session, 'hphydef', 0.5d0, status)
    call carreau_mesh_generate(session, status)
    call carreau_session_mesh(session, mesh, status)
    call carreau_mesh_vertices(mesh, xyz, status)
    ! Half of the mesh's sizes, handed back.
    allocate (sizes(size(xyz, 2)))
    sizes = 0.25d0
    call carreau_set_vertex_sizes(session, sizes, status)
    call expect_ok(status, session, 'set_vertex_sizes')
    call carreau_mesh_generate(session, status)
    call expect_ok(status, session, 'mesh_generate')
    call carreau_mesh_vertices(mesh, now, status)
    call expect(size(now, 2) > 3 * size(xyz, 2), 'half the size, four times the vertices')
    call carreau_transfer(session, xyz, moved, outside, status)
    call expect_ok(status, session, 'transfer')
    call expect(outside == 0 .and. all(abs(moved(1:2, :) - now(1:2, :)) < 1d-12), 'linear fields are carried over exactly')
    estimator%tolerance = 0.1d0
    estimator%shape = CARREAU_ANISOTROPIC
    call carreau_estimate(session, estimator, now(3, :), sizes, metrics, status)
    call expect_ok(status, session, 'estimate')
    call expect(size(metrics, 2) == size(now, 2) .and. all(metrics(1, :) > 0), 'there is a metric at each vertex')
    call carreau_set_vertex_metrics(session, metrics, status)
    call expect_ok(status, session, 'set_vertex_metrics')
    corners = reshape([-2.5d0, -2.5d0, 2.5d0, -2.5d0, 2.5d0, 2.5d0, -2.5d0, 2.5d0], [2, 4])
    halves = reshape([1, 2, 3, 1, 3, 4], [3, 2])
    metric = spread([16d0, 0d0, 16d0], 2, 4)
    call carreau_set_background(session, corners, halves, status, faces=[1, 1], metrics=metric)
    call expect_ok(status, session, 'set_background')
    call carreau_mesh_generate(session, status)
    call carreau_session_background(session, background, status)
    call expect(background%asked > 0 .and. background%outside == 0, 'the background mesh covers the face')
    call carreau_set_background(session, corners, halves, status, sizes=[1d0, 1d0])
    call expect(status == CARREAU_ERR_ARGUMENT, 'two sizes for four vertices are refused')
    call carreau_set_background_mesh(session, 'none.mesh', 'none.sol', status)
    call expect(status == CARREAU_ERR_FILE, 'files that do not exist are told')
    call carreau_clear_background(session, status)
    estimator%shape = CARREAU_ISOTROPIC
    estimator%hmin = 0.2d0
    estimator%hmax = 1
    call carreau_adapt(session, estimator, height, report, status, iterations=2)
    call expect_ok(status, session, 'adapt')
    call expect(report%triangles > 0 .and. report%error_max < 1, 'the loop reports')
    call expect(report%tolerance == estimator%tolerance, 'the tolerance is the estimator''s')
    call expect(report%within .eqv. (report%estimated_error <= report%tolerance), 'the estimate is compared with it')
    call expect(report%iterations == 2 .or. report%within, 'a mesh within the tolerance ends the loop')
    call carreau_session_free(session)
  end subroutine test_adaptation

  ! A file of ours starts with the magic number of OpenEXR; C++ tests check its content.
  subroutine test_fields
    type(carreau_session) :: session
    type(carreau_exr_options) :: options
    integer(c_int32_t) :: status, magic
    integer :: unit
    call carreau_session_create(session, status)
    call build_model(session)
    call carreau_set_cad_m(session, surf0, curv_int, curv0, status=status)
    call expect_ok(status, session, 'set_cad_m')
    options%longest = 16
    options%channels = CARREAU_EXR_POSITION + CARREAU_EXR_MASK
    options%multi_part = .true.
    options%raw = .true.
    call carreau_write_exr(session, 'fortran_test.exr', options, status)
    call expect_ok(status, session, 'write_exr')
    open(newunit=unit, file='fortran_test.exr', access='stream', form='unformatted', status='old')
    read(unit) magic
    close(unit, status='delete')
    call expect(magic == 20000630, 'magic number of OpenEXR')
    call carreau_write_exr(session, 'none/fortran_test.exr', options, status)
    call expect(status == CARREAU_ERR_FILE, 'write_exr to a folder that is not there')
    call carreau_session_free(session)
  end subroutine test_fields

  subroutine test_background_and_image_as_in_c
    type(carreau_session) :: session
    type(carreau_mesh) :: mesh
    type(carreau_exr_options) :: options
    type(carreau_background_report) :: background
    real(c_double), parameter :: around(3, 4) = reshape([-30d0, -30d0, -5d0, 60d0, -30d0, -5d0, -30d0, 60d0, -5d0, -30d0, -30d0, &
      60d0], [3, 4]), sizes(4) = [0.3d0, 0.9d0, 1.2d0, 0.6d0]
    integer(c_int32_t), parameter :: no_triangle(3, 0) = 0
    real(c_double), allocatable :: xyz(:, :), c_xyz(:, :)
    integer(c_int64_t) :: n
    integer(c_int32_t) :: status
    call carreau_session_create(session, status)
    call carreau_set_cad_m(session, surf0, curv_int, curv0, status, surf1=surf1, surf2=surf2, curv1=curv1, curv2=curv2)
    call build_model(session)
    call carreau_set_real(session, 'hphydef', 0.5d0, status)
    call carreau_mesh_generate(session, status)
    options%longest = 16
    options%channels = CARREAU_EXR_GOVERNS + CARREAU_EXR_MASK + CARREAU_EXR_POSITION
    options%multi_part = .true.
    options%raw = .true.
    call carreau_write_exr(session, 'fortran_image.exr', options, status)
    call expect_ok(status, session, 'write_exr')
    call expect(c_paraboloid_image('c_image.exr'//c_null_char) == CARREAU_OK, 'the image of C')
    call expect(bytes_of('fortran_image.exr') == bytes_of('c_image.exr'), 'the image is that of C, byte for byte')

    call carreau_set_background(session, around, no_triangle, status, sizes=sizes, tetrahedra=reshape([1, 2, 3, 4], [4, 1]))
    call expect_ok(status, session, 'set_background by a tetrahedron')
    call carreau_mesh_generate(session, status)
    call expect_ok(status, session, 'generate')
    call carreau_session_background(session, background, status)
    call expect(background%asked > 0 .and. background%outside == 0, 'the tetrahedron covers the face')
    call carreau_session_mesh(session, mesh, status)
    call carreau_mesh_vertices(mesh, xyz, status)
    allocate (c_xyz(3, capacity))
    n = c_paraboloid_in_tetrahedron(around, sizes, capacity, c_xyz)
    call expect(size(xyz, 2, kind=c_int64_t) == n, 'by a tetrahedron: as many vertices as in C')
    if (size(xyz, 2, kind=c_int64_t) == n) call expect(all(xyz == c_xyz(:, :n)), 'by a tetrahedron: the vertices of C')
    call carreau_set_background(session, around, no_triangle, status, sizes=sizes, edges=reshape([1, 2, 3], [3, 1]))
    call expect(status == CARREAU_ERR_ARGUMENT, 'edges of three vertices are refused')
    call carreau_set_background(session, around, no_triangle, status, sizes=sizes, edges=reshape([1, 2, 3, 4], [2, 2]))
    call expect_ok(status, session, 'set_background by edges')
    call carreau_session_free(session)
  end subroutine test_background_and_image_as_in_c

  !> The whole file, which is removed.
  function bytes_of(path) result(bytes)
    character(len=*), intent(in) :: path
    character(len=:), allocatable :: bytes
    integer :: unit, n
    open (newunit=unit, file=path, access='stream', form='unformatted', status='old')
    inquire (unit=unit, size=n)
    allocate (character(len=n) :: bytes)
    read (unit) bytes
    close (unit, status='delete')
  end function bytes_of

  subroutine test_errors
    type(carreau_session) :: session
    type(carreau_mesh) :: mesh
    type(carreau_error_place) :: place
    real(c_double), allocatable :: xyz(:, :)
    integer(c_int32_t) :: status
    call carreau_session_create(session, status)
    call carreau_mesh_generate(session, status)
    call expect(status == CARREAU_ERR_SEQUENCE, 'generate without geometry')
    call carreau_set_integer(session, 'frontel', 1, status)
    call expect(carreau_last_error(session) == "there is no parameter 'frontel'; did you mean 'frontal'?", 'last_error')
    call carreau_model_add_curve(session, 7, 3, 1, 1, 2, status)
    call carreau_last_error_place(session, place, status)
    call expect(status == CARREAU_OK .and. place%face == 7, 'error_place')
    call carreau_session_mesh(session, mesh, status)
    call expect(status == CARREAU_ERR_SEQUENCE, 'no mesh yet')
    call carreau_mesh_vertices(mesh, xyz, status)
    call expect(status == CARREAU_ERR_ARGUMENT .and. .not. allocated(xyz), 'a mesh that is none')
    call carreau_session_free(session)
  end subroutine test_errors
end program fortran_test
