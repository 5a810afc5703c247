! SPDX-License-Identifier: BSD-3-Clause
!> Adaptation in Fortran, without callbacks: a plate with a hole whose "solver" gives a front along a circle. Each round takes values
!> at the vertices, gets metrics for them, makes the next mesh, and carries the values over for a restart of the solver.
program plate
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t
  use, intrinsic :: iso_fortran_env, only: error_unit
  use carreau
  use carreau_geometry
  implicit none

  integer, parameter :: n = 32, rounds = 4
  real(c_double), parameter :: pi = 3.141592653589793_c_double
  real(c_double) :: points(2, 4 + n), error, first_error, angle
  integer(c_int32_t) :: status, i
  integer(c_int64_t) :: outside
  type(carreau_session) :: session
  type(carreau_plane_curves) :: curves
  type(carreau_estimator) :: estimator
  real(c_double), allocatable :: xyz(:, :), values(:), sizes(:), metrics(:, :), carried(:, :)

  points(:, 1:4) = reshape([real(c_double) :: -1, -1, 1, -1, 1, 1, -1, 1], [2, 4])
  do i = 1, n
    angle = 2*pi*(i - 1)/n
    points(:, 4 + i) = 0.2_c_double*[cos(angle), sin(angle)]
  end do
  curves%points = [integer(c_int32_t) :: 1, 2, 3, 4, 1, (4 + i, i=1, n), 5]
  curves%starts = [integer(c_int32_t) :: 1, 6, 7 + n]
  curves%smooth = [integer(c_int32_t) :: 0, 1]

  call carreau_session_create(session, status)
  call carreau_add_plane_domain(session, points, curves, status)
  call stop_unless_fine
  call carreau_set_real(session, "hphydef", 0.1_c_double, status)
  call carreau_set_real(session, "hphymin", 1e-3_c_double, status)
  call carreau_set_real(session, "hphymax", 0.5_c_double, status)
  call carreau_set_real(session, "gradation", 2._c_double, status)
  call carreau_mesh_generate(session, status)
  call stop_unless_fine
  estimator%shape = CARREAU_ANISOTROPIC
  estimator%tolerance = 0.01_c_double
  estimator%hmin = 0.003_c_double
  estimator%hmax = 0.4_c_double

  print '(a)', "round  vertices  error of the field, carried over from the mesh before"
  call solve
  first_error = error
  print '(i5, i10, es12.2)', 0, size(values), error
  do i = 1, rounds
    call carreau_estimate(session, estimator, values, sizes, metrics, status)
    call stop_unless_fine
    call carreau_set_vertex_metrics(session, metrics, status)
    call carreau_mesh_generate(session, status)
    call stop_unless_fine
    call carreau_transfer(session, reshape(values, [1, size(values)]), carried, outside, status)
    call stop_unless_fine
    call claim(outside == 0, "each vertex lies on the mesh before")
    call solve
    print '(i5, i10, 2es12.2)', i, size(values), error, maxval(abs(carried(1, :) - values))
  end do
  call claim(size(values) < 1200, "the last mesh is no finer than the first")
  call claim(error < first_error/5, "its error is at most a fifth of the error of the first")
  call claim(maxval(abs(carried(1, :) - values)) < 0.2_c_double, "the field arrives on the next mesh")
  call carreau_session_free(session)

contains

  !> Stands in for a solver: values at the vertices of the mesh, and how far the mesh is from the field at the middles of triangles.
  subroutine solve
    type(carreau_mesh) :: mesh
    integer(c_int32_t), allocatable :: triangles(:, :)
    integer :: t
    call carreau_session_mesh(session, mesh, status)
    call carreau_mesh_vertices(mesh, xyz, status)
    call carreau_mesh_triangles(mesh, triangles, status)
    call stop_unless_fine
    values = front(xyz(1, :), xyz(2, :))
    error = 0
    do t = 1, size(triangles, 2)
      error = max(error, abs(sum(values(triangles(:, t)))/3 - &
        front(sum(xyz(1, triangles(:, t)))/3, sum(xyz(2, triangles(:, t)))/3)))
    end do
  end subroutine solve

  elemental real(c_double) function front(x, y)
    real(c_double), intent(in) :: x, y
    front = tanh(20*(hypot(x, y) - 0.6_c_double))
  end function front

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
end program plate
