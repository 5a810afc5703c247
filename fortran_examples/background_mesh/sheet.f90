! SPDX-License-Identifier: BSD-3-Clause
!> Sizes from background meshes, in Fortran and without callbacks. A sheet z = (x^2 + y^2)/2 over [-1, 1]^2, one patch of
!> Bezier, is meshed three times. Sizes are given at the vertices of tetrahedra around it, as a solver of volumes has them.
!> Then metrics are given at the vertices of triangles, and sizes at the vertices of edges along its border alone.
program sheet
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t
  use, intrinsic :: iso_fortran_env, only: error_unit
  use carreau
  use carreau_geometry
  implicit none

  real(c_double), parameter :: low(3) = [-1.1_c_double, -1.1_c_double, -0.1_c_double]
  real(c_double), parameter :: high(3) = [1.1_c_double, 1.1_c_double, 1.1_c_double]
  integer, parameter :: no_triangle(3, 0) = 0
  integer(c_int32_t) :: status
  type(carreau_session) :: session
  type(carreau_background_report) :: report
  real(c_double), allocatable :: xyz(:, :), points(:, :), sizes(:), metrics(:, :)
  integer(c_int32_t), allocatable :: triangles(:, :), edges(:, :), tetrahedra(:, :)
  integer :: n, i

  call carreau_session_create(session, status)
  call add_sheet
  call carreau_set_real(session, "hphymin", 1e-3_c_double, status)
  call carreau_set_real(session, "hphymax", 2._c_double, status)

  ! Tetrahedra. Values inside are interpolated; points outside would take the nearest value.
  call fill_box(12, points, tetrahedra)
  sizes = [(wanted(points(:, i)), i=1, size(points, 2))]
  call carreau_set_background(session, points, no_triangle, status, sizes=sizes, tetrahedra=tetrahedra)
  call stop_unless_fine
  call make("tetrahedra")
  call carreau_session_background(session, report, status)
  call claim(report%asked > 0 .and. report%outside == 0, "all points lie in the tetrahedra")
  call claim(abs(mean_ratio() - 1) < 0.05_c_double, "edges are as long as the sizes of the tetrahedra")

  ! Triangles: the mesh just made, with metrics for edges of .03 across and .15 along x. The order is xx xy xz yy yz zz.
  allocate (metrics(6, size(xyz, 2)))
  metrics = spread([1/0.15_c_double**2, 0._c_double, 0._c_double, 1/0.03_c_double**2, 0._c_double, 1/0.03_c_double**2], 2, &
    size(xyz, 2))
  call carreau_set_background(session, xyz, triangles, status, metrics=metrics)
  call stop_unless_fine
  call make("triangles")
  call claim(abs(size(triangles, 2)/expected_by_metric() - 1) < 0.08_c_double, "the metric determines the number of triangles")

  ! Edges along the border, sizes from .02 at the first corner to .2 at the third one: inside faces they are interpolated.
  n = 40
  points = reshape([(border(i, n), i=1, 4*n)], [3, 4*n])
  edges = reshape([(int([i, mod(i, 4*n) + 1], c_int32_t), i=1, 4*n)], [2, 4*n])
  sizes = [(0.02_c_double + 0.045_c_double*(points(1, i) + points(2, i) + 2), i=1, 4*n)]
  call carreau_set_background(session, points, no_triangle, status, sizes=sizes, edges=edges)
  call stop_unless_fine
  call make("edges")
  ! Along y = -1 the size grows by .045 a unit of x, and the curve is z = (x^2 + 1)/2.
  call claim(abs(on_first_side() - expected_on_side()) < 1, "the sizes determine the number of edges of the first side")
  call carreau_session_free(session)

contains

  !> One patch of degrees 2 x 2: x^2 = ((1 - s)^2 - 2 s (1 - s) + s^2) with x = 2 s - 1.
  subroutine add_sheet
    real(c_double), parameter :: at(3) = [-1, 0, 1], square(3) = [1, -1, 1]
    real(c_double) :: controls(3, 9)
    integer :: i, j
    do j = 1, 3
      do i = 1, 3
        controls(:, 3*(j - 1) + i) = [at(i), at(j), (square(i) + square(j))/2]
      end do
    end do
    call carreau_add_bezier(session, reshape([integer(c_int32_t) :: 2, 2], [2, 1]), controls, status)
    call stop_unless_fine
  end subroutine add_sheet

  !> n^3 boxes from `low` to `high`, each in the six tetrahedra around its diagonal.
  subroutine fill_box(n, points, tetrahedra)
    integer, intent(in) :: n
    real(c_double), allocatable, intent(out) :: points(:, :)
    integer(c_int32_t), allocatable, intent(out) :: tetrahedra(:, :)
    integer, parameter :: orders(3, 6) = reshape([1, 2, 3, 1, 3, 2, 2, 1, 3, 2, 3, 1, 3, 1, 2, 3, 2, 1], [3, 6])
    integer :: i, j, k, o, c, at(3), t
    allocate (points(3, (n + 1)**3), tetrahedra(4, 6*n**3))
    points = reshape([(((low + (high - low)*[i, j, k]/real(n, c_double), i=0, n), j=0, n), k=0, n)], shape(points))
    t = 0
    do k = 0, n - 1
      do j = 0, n - 1
        do i = 0, n - 1
          do o = 1, 6
            at = [i, j, k]
            t = t + 1
            do c = 1, 4
              tetrahedra(c, t) = 1 + at(1) + (n + 1)*(at(2) + (n + 1)*at(3))
              if (c < 4) at(orders(c, o)) = at(orders(c, o)) + 1
            end do
          end do
        end do
      end do
    end do
  end subroutine fill_box

  !> Small beside the plane x = 1/2.
  pure real(c_double) function wanted(p)
    real(c_double), intent(in) :: p(3)
    wanted = 0.03_c_double + 0.1_c_double*abs(p(1) - 0.5_c_double)
  end function wanted

  !> Place i of 4 n along the border, counterclockwise from (-1, -1).
  pure function border(i, n) result(p)
    integer, intent(in) :: i, n
    real(c_double) :: p(3), t
    t = -1 + 2*real(mod(i - 1, n), c_double)/n
    select case ((i - 1)/n)
    case (0); p(1:2) = [t, -1._c_double]
    case (1); p(1:2) = [1._c_double, t]
    case (2); p(1:2) = [-t, 1._c_double]
    case default; p(1:2) = [-1._c_double, -t]
    end select
    p(3) = (p(1)**2 + p(2)**2)/2
  end function border

  subroutine make(what)
    character(len=*), intent(in) :: what
    type(carreau_mesh) :: mesh
    call carreau_mesh_generate(session, status)
    call stop_unless_fine
    call carreau_session_mesh(session, mesh, status)
    call carreau_mesh_vertices(mesh, xyz, status)
    call carreau_mesh_triangles(mesh, triangles, status)
    call carreau_mesh_write(mesh, "sheet_by_"//what//".mesh", status)
    call stop_unless_fine
    print '(a12, i8, a)', what, size(triangles, 2), " triangles"
  end subroutine make

  !> Mean of the lengths of edges over the sizes in their middles.
  real(c_double) function mean_ratio()
    integer :: t, k
    real(c_double) :: a(3), b(3)
    mean_ratio = 0
    do t = 1, size(triangles, 2)
      do k = 1, 3
        a = xyz(:, triangles(k, t))
        b = xyz(:, triangles(mod(k, 3) + 1, t))
        mean_ratio = mean_ratio + norm2(b - a)/wanted((a + b)/2)/(3*size(triangles, 2))
      end do
    end do
  end function mean_ratio

  !> The surface's area in the metric over the area of a unit triangle, by the middles of 200 x 200 squares of (x, y).
  real(c_double) function expected_by_metric()
    integer, parameter :: m = 200
    integer :: i, j
    real(c_double) :: x, y, a, c
    a = 1/0.15_c_double**2
    c = 1/0.03_c_double**2
    expected_by_metric = 0
    do j = 1, m
      do i = 1, m
        x = -1 + 2*(i - 0.5_c_double)/m
        y = -1 + 2*(j - 0.5_c_double)/m
        ! The determinant of J^T M J with J = (1 0; 0 1; x y).
        expected_by_metric = expected_by_metric + sqrt((a + c*x**2)*(c + c*y**2) - (c*x*y)**2)*4/m**2
      end do
    end do
    expected_by_metric = expected_by_metric/(sqrt(3._c_double)/4)
  end function expected_by_metric

  real(c_double) function on_first_side()
    on_first_side = count(abs(xyz(2, :) + 1) < 1e-9_c_double) - 1
  end function on_first_side

  !> Integral of ds/h along z = (x^2 + 1)/2 (RR-2818 sec. 4.4).
  real(c_double) function expected_on_side()
    integer, parameter :: m = 1000
    integer :: i
    real(c_double) :: x
    expected_on_side = 0
    do i = 1, m
      x = -1 + 2*(i - 0.5_c_double)/m
      expected_on_side = expected_on_side + 2*sqrt(1 + x**2)/m/(0.02_c_double + 0.045_c_double*(x + 1))
    end do
  end function expected_on_side

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
end program sheet
