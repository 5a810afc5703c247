! SPDX-License-Identifier: BSD-3-Clause
!> A head scanned on a cylinder, as HDR sec. 4.4.3 and 4.7.1 have Voltaire's: 180 angles, 144 heights, noise of half a
!> percent. Taubin's filter smooths it without shrinking. Meshed uniformly with two sizes, and by its curvature:
!> isotropic, the same graded, and by direction.
program head
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t
  use, intrinsic :: iso_fortran_env, only: error_unit
  use carreau
  use carreau_geometry
  implicit none

  integer, parameter :: angles = 180, heights = 144
  real(c_double), parameter :: pi = 3.141592653589793_c_double, degree = pi/180
  real(c_double) :: nodes(3, (angles + 1)*heights)
  integer(c_int32_t) :: status
  integer(c_int64_t) :: coarse, fine, isotropic, graded, anisotropic
  type(carreau_session) :: session
  type(carreau_grid_options) :: options

  call scan
  call carreau_session_create(session, status)
  options%measured = CARREAU_MEASURED_RADII
  options%smoothing_rounds = 2000
  call carreau_add_grid(session, options, reshape([angles + 1_c_int32_t, int(heights, c_int32_t)], [2, 1]), nodes, status)
  call stop_unless_fine

  call carreau_set_integer(session, "hphy_flag", 1_c_int32_t, status)
  coarse = triangles_of("uniform, h = 9", 9._c_double)
  fine = triangles_of("uniform, h = 4.5", 4.5_c_double)
  call by_curvature
  isotropic = triangles_of("by curvature", 0._c_double)
  call carreau_set_real(session, "gradation", 1.3_c_double, status)
  graded = triangles_of("the same, graded", 0._c_double)
  call carreau_set_real(session, "gradation", 0._c_double, status)
  call carreau_set_integer(session, "geo_metric", 1_c_int32_t, status)
  anisotropic = triangles_of("by direction", 0._c_double)
  print '(3(a, f5.2))', "fine over coarse ", real(fine)/coarse, ", isotropic over anisotropic ", real(isotropic)/anisotropic, &
    ", graded ", real(graded)/anisotropic
  call claim(abs(real(fine)/coarse - 4) < 0.25, "half the size makes four times the triangles")
  call claim(isotropic > 2*anisotropic .and. graded > 3*anisotropic, "directions save more than half of the triangles")
  call carreau_session_free(session)

contains

  !> Distances from the axis z, in mm, by a formula: skull, neck, brows, nose, eyes, lips, chin, ears, and curls of hair.
  subroutine scan
    integer :: i, j, k, seed_size
    integer, allocatable :: seed(:)
    real(c_double) :: theta, z, r, noise, phase
    call random_seed(size=seed_size)
    seed = [(1234 + 17*k, k=1, seed_size)]
    call random_seed(put=seed)
    do j = 1, heights
      do i = 1, angles
        theta = 2*pi*(i - 1)/angles - pi ! the face looks to theta = 0
        z = -150 + 300*real(j - 1, c_double)/(heights - 1)
        r = radius(theta, z)
        call random_number(noise)
        call random_number(phase)
        r = r*(1 + 0.005_c_double*sqrt(-2*log(max(noise, 1e-300_c_double)))*cos(2*pi*phase))
        k = i + (angles + 1)*(j - 1)
        nodes(:, k) = [r*cos(theta), r*sin(theta), z]
      end do
      nodes(:, (angles + 1)*j) = nodes(:, 1 + (angles + 1)*(j - 1))
    end do
  end subroutine scan

  pure function radius(theta, z) result(r)
    real(c_double), intent(in) :: theta, z
    real(c_double) :: r, front
    front = cos(theta)
    r = 55 + 45*exp(-((z - 50)/85)**4) - 8*sin(theta)**2
    r = r + bump(theta, z, 32, 0, -5, 0.16_c_double, 22) + bump(theta, z, 14, 0, -20, 0.22_c_double, 7)  ! nose
    r = r - bump(theta, z, 9, 26, 18, 0.17_c_double, 9) - bump(theta, z, 9, -26, 18, 0.17_c_double, 9)   ! eyes
    r = r + bump(theta, z, 8, 25, 36, 0.30_c_double, 7) + bump(theta, z, 8, -25, 36, 0.30_c_double, 7)   ! brows
    r = r + bump(theta, z, 7, 0, -42, 0.24_c_double, 4) + bump(theta, z, 7, 0, -54, 0.22_c_double, 4)    ! lips
    r = r + bump(theta, z, 16, 0, -75, 0.28_c_double, 15)                                        ! chin
    r = r + bump(theta, z, 18, 90, 5, 0.12_c_double, 24) + bump(theta, z, 18, -90, 5, 0.12_c_double, 24) ! ears
    r = r + 3*sin(17*theta)*((1 - front)/2)**2*exp(-((z - 40)/90)**4)                       ! hair
  end function radius

  !> A bump of `height` mm about the direction `at` (degrees) and the height z0.
  pure function bump(theta, z, height, at, z0, width, tall) result(b)
    real(c_double), intent(in) :: theta, z, width
    integer, intent(in) :: height, at, z0, tall
    real(c_double) :: b, away
    away = modulo(theta - at*degree + pi, 2*pi) - pi
    b = height*exp(-(away/width)**2 - ((z - z0)/real(tall, c_double))**2)
  end function bump

  subroutine by_curvature
    call carreau_set_integer(session, "hphy_flag", 0_c_int32_t, status)
    call carreau_set_integer(session, "hgeo_flag", 1_c_int32_t, status)
    call carreau_set_real(session, "angle_mesh", 8._c_double, status)
    call carreau_set_real(session, "hgeomin", 0.5_c_double, status)
  end subroutine by_curvature

  function triangles_of(title, h) result(n)
    character(len=*), intent(in) :: title
    real(c_double), intent(in) :: h
    integer(c_int64_t) :: n
    type(carreau_mesh) :: mesh
    type(carreau_quality) :: quality
    if (h > 0) call carreau_set_real(session, "hphydef", h, status)
    call carreau_mesh_generate(session, status)
    call stop_unless_fine
    call carreau_session_mesh(session, mesh, status)
    call carreau_mesh_quality(mesh, quality, status)
    call carreau_mesh_write(mesh, "head_"//name_of(title)//".mesh", status)
    call stop_unless_fine
    n = quality%triangles
    print '(a, t20, i8, a, f7.4)', title, n, " triangles, mean Q2", quality%q2_mean
  end function triangles_of

  pure function name_of(title) result(name)
    character(len=*), intent(in) :: title
    character(len=len(title)) :: name
    integer :: k
    name = title
    do k = 1, len(title)
      if (is_blank(title(k:k))) name(k:k) = "_"
    end do
  end function name_of

  pure function is_blank(c) result(is)
    character, intent(in) :: c
    logical :: is
    is = index(" ,=.", c) > 0
  end function is_blank

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
end program head
