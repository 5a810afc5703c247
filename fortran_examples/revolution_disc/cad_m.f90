! SPDX-License-Identifier: BSD-3-Clause
!> Surface of revolution (RT-0232 sec. 2.1 example 3), second parametrisation: u = t cos(phi), v = t sin(phi) in a quarter of a disc.
!> Here X(t) = t (2 - t), Y(t) = t^2. No side is degenerate.
module cad_m
  implicit none
  double precision, parameter :: pi = 3.141592653589793d0

contains

  subroutine cad_init
  end subroutine cad_init

  subroutine surf0(refs, uv, S)
    integer :: refs
    double precision :: uv(2), S(3), t
    t = sqrt(uv(1)**2 + uv(2)**2)
    S = [(2 - t)*uv(1), (2 - t)*uv(2), t**2]
    if (refs /= 1) S = 0
  end subroutine surf0

  subroutine surf1(refs, uv, Su, Sv)
    integer :: refs
    double precision :: uv(2), Su(3), Sv(3), u, v, t
    u = uv(1) ; v = uv(2)
    t = max(sqrt(u**2 + v**2), tiny(t))
    Su = [2 - t - u**2/t, -u*v/t, 2*u]
    Sv = [-u*v/t, 2 - t - v**2/t, 2*v]
    if (refs /= 1) Su = 0
  end subroutine surf1

  subroutine surf2(refs, uv, Suu, Suv, Svv)
    integer :: refs
    double precision :: uv(2), Suu(3), Suv(3), Svv(3), u, v, t
    u = uv(1) ; v = uv(2)
    t = max(sqrt(u**2 + v**2), tiny(t))
    Suu = [-3*u/t + (u/t)**3, -v/t + u**2*v/t**3, 2.d0]
    Suv = [-v/t + u**2*v/t**3, -u/t + u*v**2/t**3, 0.d0]
    Svv = [-u/t + u*v**2/t**3, -3*v/t + (v/t)**3, 2.d0]
    if (refs /= 1) Suu = 0
  end subroutine surf2

  !> Two radii and the arc between them
  subroutine curv_int(refs, ic, a, b)
    integer :: refs, ic
    double precision :: a, b
    a = 0.d0 ; b = 1.d0
  end subroutine curv_int

  subroutine curv0(refs, ic, t, C)
    integer :: refs, ic
    double precision :: t, C(2)
    if (ic == 1) C = [t, 0.d0]
    if (ic == 2) C = [cos(t*pi/2), sin(t*pi/2)]
    if (ic == 3) C = [0.d0, 1 - t]
  end subroutine curv0

  subroutine curv1(refs, ic, t, Ct)
    integer :: refs, ic
    double precision :: t, Ct(2)
    if (ic == 1) Ct = [1.d0, 0.d0]
    if (ic == 2) Ct = pi/2 * [-sin(t*pi/2), cos(t*pi/2)]
    if (ic == 3) Ct = [0.d0, -1.d0]
  end subroutine curv1

  subroutine curv2(refs, ic, t, Ctt)
    integer :: refs, ic
    double precision :: t, Ctt(2)
    Ctt = 0.d0
    if (ic == 2) Ctt = -(pi/2)**2 * [cos(t*pi/2), sin(t*pi/2)]
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
