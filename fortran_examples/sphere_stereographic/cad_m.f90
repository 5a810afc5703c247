! SPDX-License-Identifier: BSD-3-Clause
!> Unit sphere by stereographic projection (RT-0232 sec. 2.1 example 2): its lower half (face 1) from the North Pole, its upper half
!> (face 2) from the South Pole. Both are discs of radius 2, turned so that both normals point outwards. The equator is glued.
module cad_m
  implicit none
  double precision, parameter :: pi = 3.141592653589793d0
  double precision, parameter :: radius = 2.d0  ! of the parameter domain, a disc

contains

  subroutine cad_init
  end subroutine cad_init

  subroutine surf0(refs, uv, S)
    integer :: refs
    double precision :: uv(2), S(3), u, v, d
    u = uv(1) ; v = uv(2)
    d = u**2 + v**2 + 4
    S = [4*u/d, 4*v/d, 2*(u**2 + v**2)/d]
    if (refs == 2) S(2:3) = [-4*v/d, 8/d]
  end subroutine surf0

  subroutine surf1(refs, uv, Su, Sv)
    integer :: refs
    double precision :: uv(2), Su(3), Sv(3), u, v, d
    u = uv(1) ; v = uv(2)
    d = u**2 + v**2 + 4
    Su = [4/d - 8*u**2/d**2, -8*u*v/d**2, 16*u/d**2]
    Sv = [-8*u*v/d**2, 4/d - 8*v**2/d**2, 16*v/d**2]
    if (refs == 2) Su(2:3) = -Su(2:3)
    if (refs == 2) Sv(2:3) = -Sv(2:3)
  end subroutine surf1

  subroutine surf2(refs, uv, Suu, Suv, Svv)
    integer :: refs
    double precision :: uv(2), Suu(3), Suv(3), Svv(3), u, v, d
    u = uv(1) ; v = uv(2)
    d = u**2 + v**2 + 4
    Suu = [-24*u/d**2 + 32*u**3/d**3, -8*v/d**2 + 32*u**2*v/d**3, 16/d**2 - 64*u**2/d**3]
    Suv = [-8*v/d**2 + 32*u**2*v/d**3, -8*u/d**2 + 32*u*v**2/d**3, -64*u*v/d**3]
    Svv = [-8*u/d**2 + 32*u*v**2/d**3, -24*v/d**2 + 32*v**3/d**3, 16/d**2 - 64*v**2/d**3]
    if (refs == 2) Suu(2:3) = -Suu(2:3)
    if (refs == 2) Suv(2:3) = -Suv(2:3)
    if (refs == 2) Svv(2:3) = -Svv(2:3)
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
