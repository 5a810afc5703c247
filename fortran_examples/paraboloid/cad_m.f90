! SPDX-License-Identifier: BSD-3-Clause
!> Paraboloid z = (u^2 + v^2) / 2 over a square (RT-0232 sec. 6.1). Curves 5 and above lie inside: 20 segments and 16 arcs of circles.
module cad_m
  implicit none
  double precision, parameter :: pi = 3.141592653589793d0
  double precision :: segments(4, 24)  ! u1 v1 u2 v2
  double precision :: arcs(5, 16)      ! centre, radius, first and last angle

contains

  subroutine cad_init
    integer :: i, k
    double precision :: x, y, centres(2, 4)
    segments(:, 1) = [-2.5d0, -2.5d0, +2.5d0, -2.5d0]
    segments(:, 2) = [+2.5d0, -2.5d0, +2.5d0, +2.5d0]
    segments(:, 3) = [+2.5d0, +2.5d0, -2.5d0, +2.5d0]
    segments(:, 4) = [-2.5d0, +2.5d0, -2.5d0, -2.5d0]
    ! five small squares: four around and one in the middle
    centres = reshape([-1.5d0, -1.5d0, 1.5d0, -1.5d0, 1.5d0, 1.5d0, -1.5d0, 1.5d0], [2, 4])
    do k = 0, 4
      x = 0 ; y = 0
      if (k > 0) x = centres(1, k)
      if (k > 0) y = centres(2, k)
      segments(:, 5 + 4*k) = [x - 0.3d0, y - 0.3d0, x + 0.3d0, y - 0.3d0]
      segments(:, 6 + 4*k) = [x + 0.3d0, y - 0.3d0, x + 0.3d0, y + 0.3d0]
      segments(:, 7 + 4*k) = [x + 0.3d0, y + 0.3d0, x - 0.3d0, y + 0.3d0]
      segments(:, 8 + 4*k) = [x - 0.3d0, y + 0.3d0, x - 0.3d0, y - 0.3d0]
    end do
    ! four circles in four arcs each
    do k = 1, 4
      do i = 1, 4
        arcs(:, 4*(k - 1) + i) = [centres(1, k), centres(2, k), 0.7d0, (i - 1)*pi/2, i*pi/2]
      end do
    end do
  end subroutine cad_init

  subroutine surf0(refs, uv, S)
    integer :: refs
    double precision :: uv(2), S(3), u, v
    u = uv(1) ; v = uv(2)
    S(1) = u
    S(2) = v
    S(3) = (u**2 + v**2) / 2
  end subroutine surf0

  subroutine surf1(refs, uv, Su, Sv)
    integer :: refs
    double precision :: uv(2), Su(3), Sv(3)
    Su = [1.d0, 0.d0, uv(1)]
    Sv = [0.d0, 1.d0, uv(2)]
  end subroutine surf1

  subroutine surf2(refs, uv, Suu, Suv, Svv)
    integer :: refs
    double precision :: uv(2), Suu(3), Suv(3), Svv(3)
    Suu = [0.d0, 0.d0, 1.d0]
    Suv = 0.d0
    Svv = [0.d0, 0.d0, 1.d0]
  end subroutine surf2

  subroutine curv_int(refs, ic, a, b)
    integer :: refs, ic
    double precision :: a, b
    a = 0.d0 ; b = 1.d0
  end subroutine curv_int

  subroutine curv0(refs, ic, t, C)
    integer :: refs, ic
    double precision :: t, C(2), a(5)
    if (ic <= 24) then
      C = segments(1:2, ic) + t * (segments(3:4, ic) - segments(1:2, ic))
    else
      a = arcs(:, ic - 24)
      C = a(1:2) + a(3) * [cos(a(4) + t*(a(5) - a(4))), sin(a(4) + t*(a(5) - a(4)))]
    end if
  end subroutine curv0

  subroutine curv1(refs, ic, t, Ct)
    integer :: refs, ic
    double precision :: t, Ct(2), a(5), w
    if (ic <= 24) then
      Ct = segments(3:4, ic) - segments(1:2, ic)
    else
      a = arcs(:, ic - 24) ; w = a(5) - a(4)
      Ct = a(3) * w * [-sin(a(4) + t*w), cos(a(4) + t*w)]
    end if
  end subroutine curv1

  subroutine curv2(refs, ic, t, Ctt)
    integer :: refs, ic
    double precision :: t, Ctt(2), a(5), w
    Ctt = 0.d0
    if (ic <= 24) return
    a = arcs(:, ic - 24) ; w = a(5) - a(4)
    Ctt = -a(3) * w**2 * [cos(a(4) + t*w), sin(a(4) + t*w)]
  end subroutine curv2

  subroutine cad_hphys(refs, uv, h)
    integer :: refs
    double precision :: uv(2), h
    ! h is left untouched: no answer
  end subroutine cad_hphys

  subroutine cad_hphyc(refs, ic, t, h)
    integer :: refs, ic
    double precision :: t, h
    ! h is left untouched: no answer
  end subroutine cad_hphyc

  subroutine cad_hphyp(refp, h)
    integer :: refp
    double precision :: h
    ! h is left untouched: no answer
  end subroutine cad_hphyp

  subroutine cad_rads(refs, uv, rhos)
    integer :: refs
    double precision :: uv(2), rhos
    print *, "cad_rads should not be called", refs, uv, rhos
    stop
  end subroutine cad_rads

  subroutine cad_radc(refs, ic, t, rhoc)
    integer :: refs, ic
    double precision :: t, rhoc
    print *, "cad_radc should not be called", refs, ic, t, rhoc
    stop
  end subroutine cad_radc

end module cad_m
