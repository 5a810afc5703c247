! SPDX-License-Identifier: BSD-3-Clause
! model_fortran_test: two squares of the plane as a model: read back, written, named, joined, left out; their mesh by files of sizes and fields.
module squares
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_ptr
  implicit none
contains
  !> Square `face` has its lower left corner at (face - 1, 0).
  function surface(face, u, v, order, s, su, sv, suu, suv, svv, user) result(status) bind(c)
    integer(c_int32_t), value :: face, order
    real(c_double), value :: u, v
    real(c_double), intent(inout) :: s(3), su(3), sv(3), suu(3), suv(3), svv(3)
    type(c_ptr), value :: user
    integer(c_int32_t) :: status
    s = [u + face - 1, v, 0._c_double]
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
end module squares

program model_fortran_test
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t
  use carreau
  use squares
  implicit none
  integer(c_int32_t), parameter :: curves(3, 8) = reshape([1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4, 1, 5, 2, 5, 6, 5, 6, 7, 6, 3, 2, 3, 2], [3, 8])
  type(carreau_session) :: session, other
  type(carreau_mesh) :: mesh, copy
  type(carreau_face) :: face
  type(carreau_layers_report) :: layers
  integer(c_int32_t), allocatable :: refs(:), turned(:), of_faces(:), corner_faces(:, :), edge_refs(:)
  integer(c_int32_t), allocatable :: dimensions(:), pairs(:, :), nodes(:, :)
  integer(c_int64_t), allocatable :: counts(:)
  real(c_double), allocatable :: transforms(:, :, :)
  integer(c_int64_t) :: pair_count, node_count, faces, n_curves, points, n, m, k, f, outside
  real(c_double), allocatable :: uv(:, :), xyz(:, :), metrics(:, :)
  integer(c_int32_t) :: status, dimension, i
  real(c_double) :: hphydef

  call carreau_session_create(session, status)
  call carreau_set_cad(session, surface, interval, side, status)
  call add_squares(session)

  ! The model as it was given.
  call carreau_model_add_point(session, 1, 9, 0.25d0, 0.5d0, status)
  call carreau_model_count(session, faces, n_curves, points, status)
  call check(faces == 2 .and. n_curves == 8 .and. points == 1, 'counts')
  call carreau_model_faces(session, refs, turned, status)
  call check(all(refs == [1, 2]) .and. all(turned == 1), 'faces')
  call carreau_model_points(session, of_faces, refs, uv, status)
  call check(of_faces(1) == 1 .and. refs(1) == 9 .and. all(abs(uv(:, 1) - [0.25d0, 0.5d0]) < 1d-15), 'points')
  call carreau_model_check(session, status)
  call check(status == CARREAU_OK, carreau_last_error(session))
  call carreau_model_write_pardom(session, 'squares.pardom', status)
  call check(status == CARREAU_OK, carreau_last_error(session))
  call carreau_session_create(other, status)
  call carreau_model_read_pardom(other, 'squares.pardom', status)
  call check(status == CARREAU_OK, carreau_last_error(other))
  call carreau_model_count(other, faces, n_curves, points, status)
  call check(faces == 2 .and. n_curves == 8 .and. points == 1, 'counts of the file')
  call carreau_model_add_face(other, 3, 1, status)
  call carreau_model_check(other, status)
  call check(status == CARREAU_ERR_MODEL, 'a face without curves')
  call carreau_set_error(other, CARREAU_ERR_LIMIT, 'too much', status)
  call check(status == CARREAU_ERR_LIMIT .and. carreau_last_error(other) == 'too much', 'an error of a library on top')
  call carreau_session_free(other)

  ! Names and colours; a run that is not stopped.
  call carreau_model_name_face(session, 2, 'right', status)
  call carreau_model_set_face_sides(session, 2, 5, 0, status)
  call carreau_model_name_entities(session, 3, [5], 'right half', status)
  call check(status == CARREAU_OK, carreau_last_error(session))
  call carreau_model_color_face(session, 2, int(z'ff8000', c_int32_t), status)
  call check(status == CARREAU_OK, carreau_last_error(session))
  open (10, file='squares.env')
  write (10, '(a)') 'hphydef 0.125'
  close (10)
  call carreau_read_env(session, 'squares.env', status)
  call carreau_get_real(session, 'hphydef', hphydef, status)
  call check(abs(hphydef - 0.125d0) < 1d-15, 'a size of a file')
  call carreau_stop(session)
  call generate
  call carreau_session_mesh(session, mesh, status)
  call carreau_mesh_face(mesh, 2_c_int64_t, face, status)
  call check(face%name == 'right' .and. face%rgb == int(z'ff8000', c_int32_t), 'name and colour')
  call carreau_mesh_vertices(mesh, xyz, status)
  call carreau_mesh_vertex_refs(mesh, refs, status)
  i = findloc(refs, 9, 1)
  call check(i > 0, 'the imposed point')
  call check(all(abs(xyz(:, i) - [0.25d0, 0.5d0, 0d0]) < 1d-15), 'its place')
  call carreau_mesh_corner_faces(mesh, corner_faces, status)
  call carreau_mesh_triangle_refs(mesh, refs, status)
  call check(all(corner_faces == spread(refs, 1, 3)), 'each triangle lies in its face')

  ! Fields by files: x is linear, and comes to the next mesh as it is.
  call carreau_mesh_write(mesh, 'squares.mesh', status)
  call carreau_mesh_create(copy, status)
  call carreau_mesh_read(copy, 'squares.mesh', status)
  call carreau_mesh_dimension(copy, dimension, status)
  call check(dimension == 3, 'dimension')
  call carreau_mesh_order(copy, dimension, status)
  call check(dimension == 1, 'order')
  call write_sol('size.sol', spread(0.25d0, 1, size(xyz, 2)))
  call carreau_mesh_read_metrics(copy, 'size.sol', metrics, status)
  call check(status == CARREAU_OK, carreau_mesh_last_error(copy))
  call check(all(abs(metrics - spread([16d0, 0d0, 0d0, 16d0, 0d0, 16d0], 2, size(metrics, 2))) < 1d-12), 'metrics of sizes')
  call write_sol('x.sol', xyz(1, :))
  call carreau_set_background_fields(session, 'squares.mesh', 'x.sol', status)
  call check(status == CARREAU_OK, carreau_last_error(session))
  call carreau_set_real(session, 'hphymax', 0.2d0, status)
  call generate
  call carreau_transfer_files(session, 'squares.mesh', 'x.sol', 'next.sol', outside, status)
  call check(status == CARREAU_OK .and. outside == 0, carreau_last_error(session))
  call carreau_mesh_vertices(mesh, xyz, status)
  call check(maxval(abs(read_sol('next.sol', size(xyz, 2)) - xyz(1, :))) < 1d-12, 'a linear field')
  call carreau_clear_background(session, status)
  call carreau_add_attractor(session, reshape([0d0, 0d0, 0d0, 1d0, 0d0, 0d0], [3, 2]), reshape([1, 2, 2], [3, 1]), 0.05d0, 0.2d0, &
    0.5d0, status)
  call check(status == CARREAU_OK, carreau_last_error(session))
  call carreau_add_attractor(session, reshape([0d0, 0d0, 0d0], [3, 1]), reshape([1, 1, 2], [3, 1]), 0.05d0, 0.2d0, 0.5d0, status)
  call check(status == CARREAU_ERR_ARGUMENT, 'an index out of range')
  call carreau_clear_attractors(session, status)
  call carreau_add_layers(session, [1], 0.01d0, 1.2d0, 3, status)
  call check(status == CARREAU_OK, carreau_last_error(session))
  call generate
  call carreau_session_layers(session, 1_c_int64_t, layers, status)
  call check(status == CARREAU_OK .and. layers%rows == 3, 'rows of layers')
  call carreau_clear_layers(session, status)
  call carreau_reset_parameter(session, 'hphymax', status)
  call check(status == CARREAU_OK, carreau_last_error(session))

  ! Both squares as one face, and two sides as one curve.
  call carreau_model_part_of_face(session, 2, 1, status)
  call carreau_model_part_of_curve(session, 7, 3, status)
  call generate
  call carreau_mesh_count(mesh, n, m, k, f, status)
  call carreau_mesh_edge_refs(mesh, edge_refs, status)
  call check(f == 1 .and. any(edge_refs == 3) .and. all(edge_refs /= 7), 'parts')

  ! A face that is left out.
  call carreau_model_clear(session, status)
  call add_squares(session)
  call carreau_model_leave_out_face(session, 2, 'it is not wanted', status)
  call carreau_mesh_generate(session, status)
  call check(status == CARREAU_ERR_PARTIAL, 'one face is missing')
  call carreau_mesh_face(mesh, 2_c_int64_t, face, status)
  call check(face%status == CARREAU_FACE_FAILED .and. face%why == 'it is not wanted', face%why)

  ! The right square is the image of the left one.
  call carreau_model_clear(session, status)
  call add_squares(session)
  call carreau_model_add_periodicity(session, [2], [1], status, &
      reshape([1d0, 0d0, 0d0, 1d0, 0d0, 1d0, 0d0, 0d0, 0d0, 0d0, 1d0, 0d0], [4, 3]))
  call check(status == CARREAU_OK, carreau_last_error(session))
  call carreau_mesh_generate(session, status)
  call check(status == CARREAU_OK, carreau_last_error(session))
  call carreau_mesh_vertices(mesh, xyz, status)
  call carreau_mesh_periodic(mesh, dimensions, pairs, transforms, counts, nodes, status)
  call carreau_mesh_periodic_count(mesh, pair_count, node_count, status)
  call check(pair_count == size(counts) .and. node_count == size(nodes, 2), 'numbers of pairs and of their nodes')
  call check(all(pairs(:, size(counts)) == [2, 1]) .and. dimensions(size(counts)) == 2, 'a pair of faces')
  k = sum(counts(:size(counts) - 1))
  call check(all(abs(xyz(1, nodes(1, k + 1:)) - xyz(1, nodes(2, k + 1:)) - 1) < 1d-12), 'images of vertices')
  call carreau_model_add_period(session, [0d0, 1d0, 0d0], status)
  call check(status == CARREAU_OK, carreau_last_error(session))
  call carreau_mesh_free(copy)
  call carreau_session_free(session)
contains
  subroutine add_squares(session)
    type(carreau_session), intent(in) :: session
    integer(c_int32_t) :: i
    do i = 1, 8
      if (mod(i, 4) == 1) call carreau_model_add_face(session, (i + 3) / 4, 1, status)
      call carreau_model_add_curve(session, (i + 3) / 4, CARREAU_BOUNDARY, curves(1, i), curves(2, i), curves(3, i), status)
    end do
  end subroutine add_squares
  subroutine generate
    call carreau_mesh_generate(session, status)
    call check(status == CARREAU_OK, carreau_last_error(session))
  end subroutine generate
  subroutine write_sol(path, values)
    character(len=*), intent(in) :: path
    real(c_double), intent(in) :: values(:)
    open (10, file=path)
    write (10, '(a,/,a,/,a,/,i0,/,a)') 'MeshVersionFormatted 2', 'Dimension 3', 'SolAtVertices', size(values), '1 1'
    write (10, '(es24.16)') values
    write (10, '(a)') 'End'
    close (10)
  end subroutine write_sol
  !> The last n numbers of a file, one a line.
  function read_sol(path, n) result(values)
    character(len=*), intent(in) :: path
    integer, intent(in) :: n
    real(c_double) :: values(n)
    character(len=100) :: line
    open (10, file=path, status='old')
    do
      read (10, '(a)') line
      if (index(line, 'SolAtVertices') > 0) exit
    end do
    read (10, '(a)') line
    read (10, '(a)') line
    read (10, *) values
    close (10)
  end function read_sol
  subroutine check(good, what)
    logical, intent(in) :: good
    character(len=*), intent(in) :: what
    if (good) return
    write (*, '(a)') what
    error stop 1
  end subroutine check
end program model_fortran_test
