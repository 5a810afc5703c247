! SPDX-License-Identifier: BSD-3-Clause
! The paraboloid of RT-0232 sec. 6.1 as a user of the program writes it: no bind(c), no intent, default kinds. Its routines
! for radii end the program, as the manual's do: they must not be called.
module cad_m
  double precision :: corner(2, 5)
  integer :: initialisations = 0
contains
  subroutine cad_init
    initialisations = initialisations + 1
    if (initialisations > 1) stop 'cad_init was called twice'
    corner = reshape((/ -2.5d0, -2.5d0, 2.5d0, -2.5d0, 2.5d0, 2.5d0, -2.5d0, 2.5d0, -2.5d0, -2.5d0 /), (/ 2, 5 /))
  end subroutine cad_init

  subroutine surf0(refs, uv, S)
    integer :: refs
    double precision :: uv(2), S(3)
    S(1:2) = uv
    S(3) = dot_product(uv, uv) / 2
  end subroutine surf0

  subroutine surf1(refs, uv, Su, Sv)
    integer :: refs
    double precision :: uv(2), Su(3), Sv(3)
    Su = (/ 1.d0, 0.d0, uv(1) /)
    Sv = (/ 0.d0, 1.d0, uv(2) /)
  end subroutine surf1

  subroutine surf2(refs, uv, Suu, Suv, Svv)
    integer :: refs
    double precision :: uv(2), Suu(3), Suv(3), Svv(3)
    Suu = (/ 0, 0, 1 /)
    Suv = 0
    Svv = Suu
  end subroutine surf2

  subroutine curv_int(refs, ic, a, b)
    integer :: refs, ic
    double precision :: a, b
    a = 0
    b = 1
  end subroutine curv_int

  subroutine curv0(refs, ic, t, C)
    integer :: refs, ic
    double precision :: t, C(2)
    C = corner(:, ic) + t * (corner(:, ic + 1) - corner(:, ic))
  end subroutine curv0

  subroutine curv1(refs, ic, t, Ct)
    integer :: refs, ic
    double precision :: t, Ct(2)
    Ct = corner(:, ic + 1) - corner(:, ic)
  end subroutine curv1

  subroutine curv2(refs, ic, t, Ctt)
    integer :: refs, ic
    double precision :: t, Ctt(2)
    Ctt = 0
  end subroutine curv2

  subroutine cad_hphys(refs, uv, h)
    integer :: refs
    double precision :: uv(2), h
    h = 0.5d0
    if (uv(1) > 100) h = 1   ! uses its arguments
  end subroutine cad_hphys

  subroutine cad_hphyc(refs, ic, t, h) ! does not answer
    integer :: refs, ic
    double precision :: t, h
  end subroutine cad_hphyc

  subroutine cad_hphyp(refp, h) ! does not answer
    integer :: refp
    double precision :: h
  end subroutine cad_hphyp

  subroutine cad_rads(refs, uv, rhos)
    integer :: refs
    double precision :: uv(2), rhos
    print *, 'cad_rads was called'
    stop
  end subroutine cad_rads

  subroutine cad_radc(refs, ic, t, rhoc)
    integer :: refs, ic
    double precision :: t, rhoc
    print *, 'cad_radc was called'
    stop
  end subroutine cad_radc
end module cad_m
