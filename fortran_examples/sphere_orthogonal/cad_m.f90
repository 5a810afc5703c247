! SPDX-License-Identifier: BSD-3-Clause
!> Cap of the unit sphere by orthogonal projection (RT-0232 sec. 2.1 example 2): a disc of radius 0.95. The derivatives are
!> infinite on the equator, and the surface is not defined beyond.
module cad_m
  implicit none
  double precision, parameter :: pi = 3.141592653589793d0
  double precision, parameter :: radius = 0.95d0  ! of the parameter domain, a disc

contains

  subroutine cad_init
  end subroutine cad_init

  subroutine surf0(refs, uv, S)
    integer :: refs
    double precision :: uv(2), S(3), u, v, d
    u = uv(1) ; v = uv(2)
    d = sqrt(1 - u**2 - v**2)
    S = [u, v, d]
    if (refs /= 1) S = 0
  end subroutine surf0

  subroutine surf1(refs, uv, Su, Sv)
    integer :: refs
    double precision :: uv(2), Su(3), Sv(3), u, v, d
    u = uv(1) ; v = uv(2)
    d = sqrt(1 - u**2 - v**2)
    Su = [1.d0, 0.d0, -u/d]
    Sv = [0.d0, 1.d0, -v/d]
    if (refs /= 1) Su = 0
  end subroutine surf1

  subroutine surf2(refs, uv, Suu, Suv, Svv)
    integer :: refs
    double precision :: uv(2), Suu(3), Suv(3), Svv(3), u, v, d
    u = uv(1) ; v = uv(2)
    d = sqrt(1 - u**2 - v**2)
    Suu = [0.d0, 0.d0, -(1 - v**2)/d**3]
    Suv = [0.d0, 0.d0, -u*v/d**3]
    Svv = [0.d0, 0.d0, -(1 - u**2)/d**3]
    if (refs /= 1) Suu = 0
  end subroutine surf2

  !> Two half circles, t is the angle
  subroutine curv_int(refs, ic, a, b)
    integer :: refs, ic
    double precision :: a, b
    a = (ic - 1) * pi ; b = ic * pi
  end subroutine curv_int

  subroutine curv0(refs, ic, t, C)
    integer :: refs, ic
    double precision :: t, C(2)
    C = radius * [cos(t), sin(t)]
  end subroutine curv0

  subroutine curv1(refs, ic, t, Ct)
    integer :: refs, ic
    double precision :: t, Ct(2)
    Ct = radius * [-sin(t), cos(t)]
  end subroutine curv1

  subroutine curv2(refs, ic, t, Ctt)
    integer :: refs, ic
    double precision :: t, Ctt(2)
    Ctt = -radius * [cos(t), sin(t)]
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
