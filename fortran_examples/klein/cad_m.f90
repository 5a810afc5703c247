! SPDX-License-Identifier: BSD-3-Clause
!> Klein bottle (RT-0232 sec. 3.1.1): four squares; the sides u = 0 and u = 2 pi meet with their orientations reversed.
module cad_m
  implicit none
  double precision, parameter :: pi = 3.141592653589793d0

contains

  subroutine cad_init
  end subroutine cad_init

  !> Radius of the tube
  double precision function r(u)
    double precision :: u
    r = 4 - 2*cos(u)
  end function r

  !> Parameter domain of a face
  subroutine rectangle(refs, low, high)
    integer :: refs
    double precision :: low(2), high(2)
    low = 0.d0
    if (refs >= 3) low(1) = pi
    if (mod(refs, 2) == 0) low(2) = pi
    high = low + pi
  end subroutine rectangle

  subroutine surf0(refs, uv, S)
    integer :: refs
    double precision :: uv(2), S(3), u, v
    u = uv(1) ; v = uv(2)
    if (refs <= 2) then
      S(1) = 6*cos(u)*(1 + sin(u)) + r(u)*cos(u)*cos(v)
      S(2) = 16*sin(u) + r(u)*sin(u)*cos(v)
    else
      S(1) = 6*cos(u)*(1 + sin(u)) - r(u)*cos(v)
      S(2) = 16*sin(u)
    end if
    S(3) = r(u)*sin(v)
  end subroutine surf0

  subroutine surf1(refs, uv, Su, Sv)
    integer :: refs
    double precision :: uv(2), Su(3), Sv(3), u, v
    u = uv(1) ; v = uv(2)
    Su(1) = 6*(cos(2*u) - sin(u))
    if (refs <= 2) then
      Su(1) = Su(1) + (2*sin(u)*cos(u) - r(u)*sin(u))*cos(v)
      Su(2) = 16*cos(u) + (2*sin(u)**2 + r(u)*cos(u))*cos(v)
      Sv(1:2) = -r(u)*sin(v)*[cos(u), sin(u)]
    else
      Su(1) = Su(1) - 2*sin(u)*cos(v)
      Su(2) = 16*cos(u)
      Sv(1:2) = [r(u)*sin(v), 0.d0]
    end if
    Su(3) = 2*sin(u)*sin(v)
    Sv(3) = r(u)*cos(v)
  end subroutine surf1

  subroutine surf2(refs, uv, Suu, Suv, Svv)
    integer :: refs
    double precision :: uv(2), Suu(3), Suv(3), Svv(3), u, v
    u = uv(1) ; v = uv(2)
    Suu(1) = 6*(-2*sin(2*u) - cos(u))
    if (refs <= 2) then
      Suu(1) = Suu(1) + (2*cos(2*u) - 2*sin(u)**2 - r(u)*cos(u))*cos(v)
      Suu(2) = -16*sin(u) + (4*sin(u)*cos(u) + 2*sin(u)*cos(u) - r(u)*sin(u))*cos(v)
      Suv(1) = -(2*sin(u)*cos(u) - r(u)*sin(u))*sin(v)
      Suv(2) = -(2*sin(u)**2 + r(u)*cos(u))*sin(v)
      Svv(1:2) = -r(u)*cos(v)*[cos(u), sin(u)]
    else
      Suu(1) = Suu(1) - 2*cos(u)*cos(v)
      Suu(2) = -16*sin(u)
      Suv(1:2) = [2*sin(u)*sin(v), 0.d0]
      Svv(1:2) = [r(u)*cos(v), 0.d0]
    end if
    Suu(3) = 2*cos(u)*sin(v)
    Suv(3) = 2*sin(u)*cos(v)
    Svv(3) = -r(u)*sin(v)
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

  !> Sizes in a spiral (fig. 2), from 0.2 on its two strands to 1.4 between them. Both go on over the sides u = 0 and
  !! u = 2 pi, where v meets pi - v.
  subroutine cad_hphys(refs, uv, h)
    integer :: refs
    double precision :: uv(2), h
    if (refs >= 1) h = 0.2d0 + 1.2d0*sin(uv(2) + 2*uv(1))**2
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
