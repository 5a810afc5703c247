! SPDX-License-Identifier: BSD-3-Clause
!> A team of one rank, which has no partner, and the bytes of a file, counted.
module lone_rank
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_ptr
  implicit none
  integer(c_int64_t) :: taken = 0, calls = 0, bytes_seen = 0
contains
  function take(count, before, user) result(status) bind(c)
    integer(c_int64_t), value :: count
    integer(c_int64_t), intent(out) :: before
    type(c_ptr), value :: user
    integer(c_int32_t) :: status
    before = taken
    taken = taken + count
    status = 0
  end function take
  function exchange(n, bytes, sizes, all_bytes, user) result(status) bind(c)
    integer(c_int64_t), value :: n
    type(c_ptr), value :: bytes
    integer(c_int64_t), intent(out) :: sizes(*)
    type(c_ptr), intent(out) :: all_bytes
    type(c_ptr), value :: user
    integer(c_int32_t) :: status
    sizes(1) = n
    all_bytes = bytes
    taken = 0
    calls = calls + 1
    status = 0
  end function exchange
  function count_bytes(position, n, bytes, user) result(status) bind(c)
    integer(c_int64_t), value :: position, n
    type(c_ptr), value :: bytes, user
    integer(c_int32_t) :: status
    status = merge(0, 1, position == bytes_seen) ! in ascending positions, without gaps
    bytes_seen = position + n
  end function count_bytes
end module lone_rank

!> team_fortran_test CLONE
program team_fortran_test
  use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t
  use carreau
  use carreau_geometry, only: carreau_load_bezier
  use lone_rank
  implicit none
  type(carreau_session) :: session
  type(carreau_mesh) :: mesh, part
  type(carreau_part_counts) :: counts
  type(carreau_quality) :: quality
  integer(c_int64_t), allocatable :: numbers(:), rows(:)
  integer(c_int32_t), allocatable :: owners(:)
  integer(c_int32_t) :: status
  integer(c_int64_t) :: alone, in_team, length
  character(len=1000) :: clone

  call get_command_argument(1, clone)
  call carreau_session_create(session, status)
  call carreau_load_bezier(session, trim(clone)//'/fortran_examples/teapot/teapot.bpt', status)
  call carreau_set_real(session, 'hphydef', 0.3d0, status)
  alone = triangles()
  call carreau_set_team(session, 0_c_int32_t, 1_c_int32_t, take, exchange, status)
  if (status /= CARREAU_OK) error stop 'a team of one'
  in_team = triangles()
  if (alone /= in_team) error stop 'the mesh of a team of one is another one'

  call carreau_session_mesh(session, mesh, status)
  call carreau_mesh_encode(mesh, '.meshb', count_bytes, status)
  if (status /= CARREAU_OK) error stop 'the bytes of a file'
  call carreau_mesh_write(mesh, 'team.meshb', status)
  inquire (file='team.meshb', size=length)
  if (length /= bytes_seen) error stop 'a file of another length'

  ! The only part is the whole mesh.
  call carreau_mesh_create(part, status)
  call carreau_mesh_generate_part(session, part, status)
  if (status /= CARREAU_OK) error stop 'the part of a team of one'
  call carreau_mesh_part_count(part, counts, status)
  if (counts%size /= 1 .or. counts%own_triangles /= alone .or. counts%all_triangles /= alone) error stop 'counts of a part'
  call carreau_mesh_part_quality(part, quality, status)
  if (quality%triangles /= alone) error stop 'the quality of all parts'
  call carreau_mesh_part_vertices(part, numbers, owners, rows, status)
  if (any(numbers /= [(length, length=0, counts%all_vertices - 1)]) .or. any(rows /= numbers)) error stop 'numbers of vertices'
  call carreau_mesh_part_triangles(part, numbers, owners, status)
  if (size(numbers) /= alone .or. any(owners /= 0)) error stop 'numbers of triangles'
  length = bytes_seen
  bytes_seen = 0
  call carreau_mesh_encode(part, '.meshb', count_bytes, status)
  if (status /= CARREAU_OK .or. length /= bytes_seen) error stop 'the bytes of a part'
  call carreau_mesh_free(part)
  call carreau_session_free(session)
contains
  function triangles() result(n)
    integer(c_int64_t) :: n, vertices, edges, faces
    call carreau_mesh_generate(session, status)
    if (status /= CARREAU_OK) write (*, '(a)') carreau_last_error(session)
    if (status /= CARREAU_OK) error stop 'there is no mesh'
    call carreau_session_mesh(session, mesh, status)
    call carreau_mesh_count(mesh, vertices, n, edges, faces, status)
  end function triangles
end program team_fortran_test
