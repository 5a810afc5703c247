! SPDX-License-Identifier: BSD-3-Clause
!> Areas of two balls through module carreau_geometry: those in closed form.
program molecule_fortran_test
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t
  use carreau
  use carreau_geometry
  implicit none
  type(carreau_session) :: session
  type(carreau_molecule_options) :: options
  type(carreau_molecule_measures) :: measures
  integer(c_int32_t), allocatable :: refs(:)
  real(c_double), allocatable :: areas(:), xyz(:, :)
  real(c_double), parameter :: r = 1.7_c_double, d = 1.5_c_double, pi = acos(-1._c_double)
  real(c_double) :: centers(3, 2), uv(2)
  integer(c_int32_t) :: status
  call carreau_session_create(session, status)
  centers = 0
  centers(1, 2) = d
  options%surface = CARREAU_VWS
  call carreau_add_molecule(session, options, centers, [r, r], status)
  if (status /= CARREAU_OK) error stop 'the molecule is refused'
  call carreau_molecule_measure(session, measures, status)
  if (abs(measures%area - 2*(2*pi*r**2 + pi*r*d)) > 1.e-12_c_double .or. measures%atoms /= 2) error stop 'area'
  call carreau_molecule_atoms(session, refs, areas, status)
  if (any(refs /= [1, 2]) .or. abs(sum(areas) - measures%area) > 1.e-12_c_double) error stop 'atoms'
  if (carreau_molecule_atom_name(session, 1_c_int64_t) /= '') error stop 'name'
  call carreau_geometry_curve(session, 1_c_int32_t, 1_c_int32_t, 0.5_c_double, uv, status)
  call carreau_geometry_points(session, 1_c_int32_t, reshape(uv, [2, 1]), xyz, status)
  if (status /= CARREAU_OK .or. abs(xyz(1, 1) - d/2) > 1.e-12_c_double) error stop 'point'
  options%surface = 9
  call carreau_add_molecule(session, options, centers, [r, r], status)
  if (status /= CARREAU_ERR_ARGUMENT) error stop 'a surface that there is not'
  call carreau_session_free(session)
  print '(a)', 'molecules agree'
end program molecule_fortran_test
