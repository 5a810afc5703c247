! SPDX-License-Identifier: BSD-3-Clause
!> Cone of height 2 and radius 1, one patch: a seam, and the side v = 0 is one point of space, the apex.
module cad_m
  implicit none
  double precision, parameter :: pi = 3.141592653589793d0

contains

  subroutine cad_init
  end subroutine cad_init

  !> Parameter domain of a face
  subroutine rectangle(refs, low, high)
    integer :: refs
    double precision :: low(2), high(2)
    low = [0.d0, 0.d0]
    high = [2*pi, 1.d0]
  end subroutine rectangle

  subroutine surf0(refs, uv, S)
    integer :: refs
    double precision :: uv(2), S(3), u, v
    u = uv(1) ; v = uv(2)
    S = [v*cos(u), v*sin(u), 2*v]
  end subroutine surf0

  subroutine surf1(refs, uv, Su, Sv)
    integer :: refs
    double precision :: uv(2), Su(3), Sv(3), u, v
    u = uv(1) ; v = uv(2)
    Su = [-v*sin(u), v*cos(u), 0.d0]
    Sv = [cos(u), sin(u), 2.d0]
  end subroutine surf1

  subroutine surf2(refs, uv, Suu, Suv, Svv)
    integer :: refs
    double precision :: uv(2), Suu(3), Suv(3), Svv(3), u, v
    u = uv(1) ; v = uv(2)
    Suu = [-v*cos(u), -v*sin(u), 0.d0]
    Suv = [-sin(u), cos(u), 0.d0]
    Svv = 0.d0
  end subroutine surf2

  !> The sides of a face's rectangle, counterclockwise from the lower one: end points p and q
  subroutine side(refs, ic, p, q)
    integer :: refs, ic
    double precision :: p(2), q(2), low(2), high(2)
    call rectangle(refs, low, high)
    select case (ic)
    case (1)
      p = low ; q = [high(1), low(2)]
    case (2)
      p = [high(1), low(2)] ; q = high
    case (3)
      p = high ; q = [low(1), high(2)]
    case default
      p = [low(1), high(2)] ; q = low
    end select
  end subroutine side

  subroutine curv_int(refs, ic, a, b)
    integer :: refs, ic
    double precision :: a, b
    a = 0.d0 ; b = 1.d0
  end subroutine curv_int

  subroutine curv0(refs, ic, t, C)
    integer :: refs, ic
    double precision :: t, C(2), p(2), q(2)
    call side(refs, ic, p, q)
    C = (1 - t) * p + t * q
  end subroutine curv0

  subroutine curv1(refs, ic, t, Ct)
    integer :: refs, ic
    double precision :: t, Ct(2), p(2), q(2)
    call side(refs, ic, p, q)
    Ct = q - p
  end subroutine curv1

  subroutine curv2(refs, ic, t, Ctt)
    integer :: refs, ic
    double precision :: t, Ctt(2)
    Ctt = 0.d0
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
