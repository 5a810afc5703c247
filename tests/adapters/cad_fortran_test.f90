! SPDX-License-Identifier: BSD-3-Clause
! cad_fortran_test FILE: the module carreau_cad reads named_faces.step like the C interface, and meshes it.
program cad_fortran_test
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int32_t, c_int64_t
  use carreau
  use carreau_cad
  use carreau_geometry
  implicit none
  type(carreau_session) :: session
  type(carreau_mesh) :: mesh
  type(carreau_cad_file) :: file, again
  type(carreau_cad_content) :: content
  type(carreau_cad_face) :: face
  type(carreau_cad_figures) :: figures
  type(carreau_cad_report) :: report
  type(carreau_cad_gaps) :: gaps
  type(carreau_cad_danger) :: danger
  type(carreau_geometry_place) :: place
  type(carreau_quality) :: quality
  character(len=1000) :: path
  character(len=:), allocatable :: kind
  integer(c_int32_t), allocatable :: edges(:), parts(:)
  type(carreau_session) :: other
  type(carreau_cad_content) :: more
  type(carreau_cad_small_feature) :: feature
  type(carreau_cad_tree_row) :: row
  type(carreau_cad_contact) :: contact
  integer(c_int64_t) :: contacts
  character(kind=c_char), allocatable :: bytes(:)
  integer(c_int32_t) :: sides(2)
  integer(c_int32_t) :: status, f, tops, count
  real(c_double) :: area, xyz(3), uv(2)

  call get_command_argument(1, path)
  call carreau_session_create(session, status)
  call carreau_cad_open(session, 'none.step', status)
  call check(status == CARREAU_ERR_FILE, 'a file that is not there: '//carreau_last_error(session))
  call check(index(carreau_last_error(session), 'none.step') > 0, 'its name is in the sentence')
  call carreau_cad_open(session, path, status, file)
  call check(status == CARREAU_OK, carreau_last_error(session))
  call carreau_cad_info(file, content, status)
  call check(status == CARREAU_OK .and. content%faces == 6 .and. content%edges == 12 .and. content%vertices == 8, 'counts')
  call check(content%closed .and. content%unit == 'mm' .and. content%losses == 0, 'content')
  tops = 0
  area = 0
  do f = 1, content%faces
    call carreau_cad_file_face(file, f, face, status)
    call check(status == CARREAU_OK .and. face%number == f .and. face%why == '', 'a face')
    if (face%name == 'top') tops = tops + 1
    call carreau_cad_measure_face(file, f, figures, status)
    call check(status == CARREAU_OK .and. figures%kind == 'plane', 'figures')
    area = area + figures%area
    call carreau_cad_curves(file, f, edges, status)
    call check(status == CARREAU_OK .and. size(edges) == 4, 'curves')
    call carreau_cad_curve_point(file, f, 1, 0.5_c_double, uv, status)
    call check(status == CARREAU_OK, 'a place of a curve')
    call carreau_cad_point(file, f, uv(1), uv(2), xyz, status)
    call check(status == CARREAU_OK, 'a point')
  end do
  call check(tops == 1, 'one face is the top')
  call carreau_cad_inspect(file, report, status)
  call check(status == CARREAU_OK .and. abs(report%area - area) < 1d-9 * area .and. report%kinds == 1, 'report')
  call carreau_cad_surfaces(file, 1_c_int64_t, kind, count, status)
  call check(status == CARREAU_OK .and. kind == 'plane' .and. count == 6, 'kinds')
  call carreau_cad_measure_gaps(file, gaps, status)
  call check(status == CARREAU_OK .and. gaps%largest < 1d-6 .and. gaps%beyond == 0, 'a box has no gaps')
  call carreau_cad_danger_at(file, int(report%dangers + 1, c_int64_t), danger, status)
  call check(status == CARREAU_ERR_ARGUMENT, 'no such danger')
  call check(carreau_cad_loss(file, 1_c_int64_t) == '', 'everything was read')
  call carreau_cad_parts(file, 3, parts, status)
  call check(status == CARREAU_OK .and. size(parts) == 1 .and. parts(1) == 3, 'a face that is not cut')
  call check(carreau_cad_whole_face(file, 3) == 3 .and. carreau_cad_whole_edge(file, 5) == 5, 'wholes')
  call carreau_cad_set_face_size(file, 'top', -1d0, status)
  call check(status == CARREAU_ERR_ARGUMENT, 'a size below zero')
  call carreau_cad_create(again, status)
  call carreau_cad_read(again, path, status)
  call check(status == CARREAU_OK, carreau_cad_last_error(again))
  call read_bytes(path, bytes)
  call carreau_cad_read_bytes(again, bytes, 'step', status, unit='cm', min_feature=1d-3)
  call check(status == CARREAU_OK, carreau_cad_last_error(again))
  call carreau_cad_info(again, more, status)
  call check(more%unit == 'cm' .and. more%solids == 1 .and. more%small_features == 0, 'bytes in centimetres')
  call carreau_cad_small_feature_at(again, 1_c_int64_t, feature, status)
  call check(status == CARREAU_ERR_ARGUMENT, 'no small feature')
  call carreau_cad_name_solids(again, ['block'], status, [int(z'40A030', c_int32_t)])
  call check(status == CARREAU_OK, carreau_cad_last_error(again))
  call carreau_cad_mirror(again, [0d0, 0d0, 0d0], [0d0, 0d0, 0d0], status)
  call check(status == CARREAU_ERR_ARGUMENT, 'a normal without length')
  call carreau_cad_imprint(again, 0d0, status)
  call check(status == CARREAU_OK, carreau_cad_last_error(again))
  call carreau_cad_file_face(again, 1, face, status)
  call check(face%solid == 1 .and. face%solid_name == 'block' .and. face%other_solid == 0, 'the solid of a face')
  call carreau_cad_info(again, more, status)
  call carreau_cad_tree_at(again, int(more%tree_rows, c_int64_t), row, status)
  call check(status == CARREAU_OK .and. len(row%kind) > 0, 'the last row of the tree')
  call carreau_cad_tree_at(again, 0_c_int64_t, row, status)
  call check(status == CARREAU_ERR_ARGUMENT, 'rows count from 1')
  call check(carreau_cad_entity_name(again, 3, 1) == 'block' .and. carreau_cad_entity_name(again, 1, 1) == '', 'names of entities')
  call carreau_cad_count_contacts(again, contacts, status)
  call check(status == CARREAU_OK .and. contacts == 0, 'a solid touches no other')
  call carreau_cad_contact_at(again, 1_c_int64_t, contact, status)
  call check(status == CARREAU_ERR_ARGUMENT, 'no contact')
  call carreau_cad_set_size(again, 1, 1, -1d0, status)
  call check(status == CARREAU_ERR_ARGUMENT, 'a size below zero on an edge')
  call carreau_cad_close(again)
  call carreau_session_create(other, status)
  call carreau_cad_open_bytes(other, bytes, '', status)
  call check(status == CARREAU_OK, carreau_last_error(other))
  call carreau_session_free(other)
  call carreau_cad_file_face(file, 7, face, status)
  call check(status == CARREAU_ERR_ARGUMENT .and. index(carreau_cad_last_error(file), 'face 7') > 0, 'no such face')
  call carreau_cad_add(file, session, status)
  call check(status == CARREAU_OK, 'the same once more')
  call carreau_geometry_info(session, 2_c_int64_t, place, status)
  call check(status == CARREAU_OK .and. place%first_face == 7 .and. place%first_curve == 13, 'behind the first')
  call carreau_cad_close(file)
  call carreau_set_real(session, 'hphydef', content%diagonal / 10, status)
  call carreau_mesh_generate(session, status)
  call check(status == CARREAU_OK, carreau_last_error(session))
  call carreau_session_mesh(session, mesh, status)
  call carreau_mesh_face_sides(mesh, 1, sides, status)
  call check(status == CARREAU_OK .and. all(sides == [1, 0]), 'the solid beside a face')
  call check(carreau_mesh_entity_name(mesh, 1, 1) == '', 'an edge without a name')
  call carreau_mesh_quality(mesh, quality, status)
  call check(abs(quality%area - 2 * area) < 1d-9 * area .and. quality%open_edges == 0, 'the area of two boxes')
  call carreau_session_free(session)
contains
  subroutine read_bytes(name, all)
    character(len=*), intent(in) :: name
    character(kind=c_char), allocatable, intent(out) :: all(:)
    integer :: unit, n
    open (newunit=unit, file=trim(name), access='stream', form='unformatted', status='old')
    inquire (unit=unit, size=n)
    allocate (all(n))
    read (unit) all
    close (unit)
  end subroutine read_bytes

  subroutine check(good, what)
    logical, intent(in) :: good
    character(len=*), intent(in) :: what
    if (good) return
    write (*, '(a)') what
    error stop 1
  end subroutine check
end program cad_fortran_test
