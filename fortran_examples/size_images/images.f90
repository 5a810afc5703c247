! SPDX-License-Identifier: BSD-3-Clause
!> The fields that govern a mesh, as OpenEXR images from Fortran: the sheet z = (x^2 + y^2)/2 over [-1, 1]^2, one patch of Bezier.
!> Sizes follow the curvature where it is strong, and are hphydef elsewhere. `exrheader sheet.exr` lists the channels; any
!> viewer opens the file.
program images
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t
  use, intrinsic :: iso_fortran_env, only: error_unit
  use carreau
  use carreau_geometry
  implicit none

  integer(c_int32_t), parameter :: magic_of_exr = 20000630
  real(c_double), parameter :: at(3) = [-1, 0, 1], square(3) = [1, -1, 1]
  real(c_double) :: controls(3, 9)
  integer(c_int32_t) :: status, magic
  integer :: i, j, unit
  type(carreau_session) :: session
  type(carreau_exr_options) :: options

  do j = 1, 3
    do i = 1, 3
      controls(:, 3*(j - 1) + i) = [at(i), at(j), (square(i) + square(j))/2]
    end do
  end do
  call carreau_session_create(session, status)
  call carreau_add_bezier(session, reshape([integer(c_int32_t) :: 2, 2], [2, 1]), controls, status)
  call stop_unless_fine
  call carreau_set_integer(session, "hgeo_flag", 1_c_int32_t, status)
  call carreau_set_real(session, "angle_mesh", 4._c_double, status)
  call carreau_set_real(session, "hphydef", 0.18_c_double, status)
  call carreau_mesh_generate(session, status)
  call stop_unless_fine

  ! One file of all faces, each a part, with the channels size.*, physical.*, geometric.*, governs and mask.
  options%width = 256
  options%height = 256
  options%multi_part = .true.
  options%channels = CARREAU_EXR_SIZE + CARREAU_EXR_GOVERNS + CARREAU_EXR_MASK
  call carreau_write_exr(session, "sheet.exr", options, status)
  call stop_unless_fine
  open (newunit=unit, file="sheet.exr", access="stream", form="unformatted", status="old")
  read (unit) magic
  close (unit)
  call claim(magic == magic_of_exr, "the file is one of OpenEXR")

  ! A picture for everybody: the sizes of face 1 in colours, under the sides of its triangles.
  options = carreau_exr_options(longest=512, face=1)
  call carreau_write_exr(session, "sheet.png", options, status)
  call stop_unless_fine
  print '(a)', "sheet.exr: size.*, physical.*, geometric.*, governs and mask; sheet.png: a preview"
  call carreau_session_free(session)

contains

  subroutine stop_unless_fine
    if (status == CARREAU_OK) return
    write (error_unit, '(a)') carreau_last_error(session)
    error stop
  end subroutine stop_unless_fine

  subroutine claim(holds, sentence)
    logical, intent(in) :: holds
    character(len=*), intent(in) :: sentence
    if (holds) return
    write (error_unit, '(2a)') "this does not hold: ", sentence
    error stop
  end subroutine claim
end program images
