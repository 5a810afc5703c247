! SPDX-License-Identifier: BSD-3-Clause
! files_fortran_test CLONE: each geometry of module carreau_geometry that comes from a file, and its exact properties.
program files_fortran_test
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t
  use carreau
  use carreau_geometry
  implicit none
  type(carreau_session) :: session
  type(carreau_mesh) :: mesh
  type(carreau_molecule_options) :: molecule
  type(carreau_molecule_measures) :: measures
  type(carreau_grid_options) :: grid
  type(carreau_triangles_options) :: sharp
  type(carreau_triangles_report) :: report
  type(carreau_quality) :: quality
  character(len=1000) :: clone
  real(c_double), allocatable :: convex(:), torus(:), concave(:)
  integer(c_int32_t) :: status
  integer(c_int64_t) :: faces, curves, points, ridges
  logical :: answer

  call get_command_argument(1, clone)
  call carreau_session_create(session, status)

  call carreau_load_bezier(session, trim(clone)//'/fortran_examples/teapot/teapot.bpt', status)
  call check(status == CARREAU_OK)
  call carreau_model_count(session, faces, curves, points, status)
  if (faces /= 32 .or. curves /= 128) error stop 'the teapot has 32 patches of four sides'

  call carreau_model_clear(session, status)
  molecule%surface = CARREAU_SES
  call carreau_load_molecule(session, molecule, trim(clone)//'/tests/data/molecule/caffeine.xyzr', status)
  call check(status == CARREAU_OK)
  call carreau_molecule_measure(session, measures, status)
  call carreau_molecule_atom_areas(session, convex, torus, concave, status)
  if (size(convex) /= 24 .or. abs(sum(convex) + sum(torus) + sum(concave) - measures%area) > 1d-9) error stop 'areas of atoms'

  call carreau_model_clear(session, status)
  grid%step = 10
  grid%continuity = 2
  grid%smoothing_rounds = 100
  grid%smoothing_by_distance = .true.
  call carreau_load_grid(session, grid, trim(clone)//'/tests/data/grid/volcano.txt', status)
  call check(status == CARREAU_OK)
  call carreau_model_embed_ridges(session, 1d-3, ridges, status)
  call check(status == CARREAU_OK)
  if (ridges /= 0) error stop 'heights at steps of 10 m have no radius of a millimetre'
  call carreau_model_embed_ridges(session, 40d0, ridges, status)
  call check(status == CARREAU_OK)
  if (ridges < 1) error stop 'the rim of the crater is a ridge'

  call carreau_model_clear(session, status)
  call carreau_load_plane_domain(session, trim(clone)//'/tests/data/plane/plate.poly', status)
  call check(status == CARREAU_OK)
  call carreau_plane_has_sizes(session, answer, status)
  if (answer) error stop 'the plate has no sizes'
  call carreau_set_real(session, 'hphydef', 0.2d0, status)
  call carreau_mesh_generate(session, status)
  call check(status == CARREAU_OK)
  call carreau_session_mesh(session, mesh, status)
  call carreau_mesh_quality(mesh, quality, status)
  call carreau_mesh_write(mesh, 'plate.mesh', status)

  call carreau_model_clear(session, status)
  call carreau_load_triangles(session, sharp, 'plate.mesh', status)
  call check(status == CARREAU_OK)
  call carreau_triangles_measure(session, report, status)
  if (report%triangles /= quality%triangles .or. report%border_edges < 3) error stop 'the triangles of the plate'

  ! A geometry that has begun can be dropped.
  call carreau_load_triangles(session, sharp, 'none.off', status)
  if (status /= CARREAU_ERR_ARGUMENT .and. status /= CARREAU_ERR_FILE) error stop 'a file that is not there'
  call carreau_geometry_cancel(session, status)
  if (status /= CARREAU_ERR_SEQUENCE) error stop 'no geometry has begun'
  call carreau_session_free(session)
contains
  subroutine check(good)
    logical, intent(in) :: good
    if (good) return
    write (*, '(a)') carreau_last_error(session)
    error stop 1
  end subroutine check
end program files_fortran_test
