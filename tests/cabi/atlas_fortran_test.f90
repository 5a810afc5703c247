! SPDX-License-Identifier: BSD-3-Clause
!> Loops, annuli and an atlas through module carreau_atlas: there and back, transitions, a mesh.
program atlas_fortran_test
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t
  use carreau
  use carreau_atlas
  implicit none
  integer, parameter :: n = 24, m = 12
  real(c_double), parameter :: pi = acos(-1._c_double)
  real(c_double), parameter :: small(2, 4) = reshape([-1, -1, 1, -1, 1, 1, -1, 1]*1._c_double, [2, 4])
  type(carreau_loop) :: loop
  type(carreau_annulus) :: annulus
  type(carreau_atlas_handle) :: atlas
  type(carreau_atlas_counts) :: counts
  type(carreau_atlas_chart) :: chart
  type(carreau_session) :: session
  real(c_double) :: xy(2, 1), derivatives(2, 1), phi(1), place(2, 1), back(2, 1), slopes(4, 1), surface(3, n*m), xyz(3, 1)
  real(c_double) :: there(2, 1), weights(1), other(1), same(3, 1), jet(6, 1), a, b
  real(c_double), allocatable :: pivots(:, :), border(:, :), edges(:, :)
  integer(c_int32_t) :: status, zones(1), triangles(3, 2*n*m), i, j, k
  integer(c_int64_t) :: c
  logical :: found(1)

  call carreau_loop_create(loop, status)
  call carreau_loop_build(loop, small, CARREAU_LOOP_SMOOTH, status)
  call carreau_loop_points(loop, [1._c_double], xy, derivatives, status)
  call carreau_loop_invert(loop, xy, 1.e-9_c_double, phi, status)
  if (status /= CARREAU_OK .or. abs(phi(1) - 1) > 1.e-12_c_double) error stop 'loop'
  call carreau_loop_pivots(loop, pivots, status)
  if (status /= CARREAU_OK .or. size(pivots, 2) /= 4) error stop 'pivots'
  call carreau_loop_build(loop, small(:, 4:1:-1), CARREAU_LOOP_SMOOTH, status)
  if (status /= CARREAU_ERR_DOMAIN .or. index(carreau_loop_last_error(loop), 'clockwise') == 0) error stop 'sentence'
  call carreau_loop_free(loop)

  call carreau_annulus_create(annulus, status)
  call carreau_annulus_build(annulus, small, 2*small, CARREAU_BORDER_SPLINE, .false., status)
  place(:, 1) = [0.3_c_double, 2._c_double]
  call carreau_annulus_points(annulus, place, xy, slopes, status)
  call carreau_annulus_invert(annulus, xy, back, zones, status)
  if (zones(1) /= CARREAU_ZONE_ANNULUS .or. any(abs(back - place) > 1.e-12_c_double)) error stop 'annulus'
  call carreau_annulus_outer_border(annulus, border, status)
  if (size(border, 2) < 4 .or. any(maxval(abs(border), 1) > 2 + 1.e-12_c_double) .or. any(maxval(abs(border), 1) < 1.5_c_double)) &
    error stop 'the outer border is inside of the one that was given, and far from the inner one'
  call carreau_annulus_pivots(annulus, pivots, status)
  call carreau_annulus_skeleton(annulus, edges, status)
  if (status /= CARREAU_OK .or. size(pivots, 1) /= 2 .or. size(edges, 1) /= 4) error stop 'pivots and skeleton'
  call carreau_annulus_write_exr(annulus, 'annulus.exr', 1, status)
  if (status /= CARREAU_ERR_ARGUMENT .or. carreau_annulus_last_error(annulus) == '') error stop 'an image of one pixel'
  call carreau_annulus_free(annulus)

  do i = 0, n - 1
    do j = 0, m - 1
      a = 2*pi*i/n
      b = 2*pi*(j + 0.5_c_double*mod(i, 2))/m
      surface(:, i*m + j + 1) = [(2 + 0.9_c_double*cos(b))*cos(a), (2 + 0.9_c_double*cos(b))*sin(a), 0.9_c_double*sin(b)]
      k = mod(i, 2)
      triangles(:, 2*(i*m + j) + 1) = [at(i, j), at(i + 1, j + k), at(i, j + 1)]
      triangles(:, 2*(i*m + j) + 2) = [at(i, j), at(i + 1, j + k - 1), at(i + 1, j + k)]
    end do
  end do
  call carreau_atlas_create(atlas, status)
  call carreau_atlas_build(atlas, surface, triangles(:, 2:), status)
  if (status /= CARREAU_ERR_ARGUMENT .or. carreau_atlas_last_error(atlas) == '') error stop 'a surface with a border'
  call carreau_atlas_build(atlas, surface, triangles, status)
  if (status /= CARREAU_OK) error stop 'atlas'
  call carreau_atlas_count(atlas, counts, status)
  if (2*counts%charts /= counts%triples) error stop 'Euler number of a torus'
  call carreau_atlas_chart_info(atlas, 1_c_int64_t, chart, status)
  if (abs(sum(chart%normal**2) - 1) > 1.e-12_c_double) error stop 'chart'
  call carreau_atlas_annulus_points(atlas, 1_c_int64_t, reshape([0.5_c_double, 0.4_c_double], [2, 1]), xy, status)
  call carreau_atlas_zones(atlas, 1_c_int64_t, xy, zones, weights, status)
  call carreau_atlas_points(atlas, 1_c_int64_t, xy, xyz, jet, status)
  do c = 2, counts%charts
    call carreau_atlas_transition(atlas, 1_c_int64_t, c, xy, there, found, status)
    if (.not. found(1)) cycle
    call carreau_atlas_points(atlas, c, there, same, jet, status)
    if (any(abs(same - xyz) > 1.e-12_c_double)) error stop 'charts disagree'
    call carreau_atlas_zones(atlas, c, there, zones, other, status)
    weights = weights + other
  end do
  if (abs(weights(1) - 1) > 1.e-12_c_double) error stop 'weights'
  call carreau_session_create(session, status)
  call carreau_add_atlas(session, atlas, status)
  if (status /= CARREAU_OK) error stop 'the session refuses the atlas'
  call carreau_atlas_free(atlas)
  call carreau_session_free(session)
contains
  integer(c_int32_t) function at(row, column)
    integer(c_int32_t), intent(in) :: row, column
    at = mod(row, n)*m + modulo(column, m) + 1
  end function at
end program atlas_fortran_test
