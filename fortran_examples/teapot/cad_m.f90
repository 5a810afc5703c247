! SPDX-License-Identifier: BSD-3-Clause
!> The Utah teapot, complete: 32 bicubic Bezier patches (RT-0232 sec. 6.2). Each patch is the unit square.
module cad_m
  use bezier_m
  implicit none

  ! u1 v1 u2 v2 of the four sides, counterclockwise
  double precision, parameter :: sides(4, 4) = reshape([ &
    0.d0, 0.d0, 1.d0, 0.d0,  1.d0, 0.d0, 1.d0, 1.d0,  1.d0, 1.d0, 0.d0, 1.d0,  0.d0, 1.d0, 0.d0, 0.d0], [4, 4])

contains

  subroutine cad_init
    call read_patches('teapot.bpt')
  end subroutine cad_init

  subroutine surf0(refs, uv, S)
    integer :: refs
    double precision :: uv(2), S(3)
    call bezier0(refs, uv, S)
  end subroutine surf0

  subroutine surf1(refs, uv, Su, Sv)
    integer :: refs
    double precision :: uv(2), Su(3), Sv(3)
    call bezier1(refs, uv, Su, Sv)
  end subroutine surf1

  subroutine surf2(refs, uv, Suu, Suv, Svv)
    integer :: refs
    double precision :: uv(2), Suu(3), Suv(3), Svv(3)
    call bezier2(refs, uv, Suu, Suv, Svv)
  end subroutine surf2

  subroutine curv_int(refs, ic, a, b)
    integer :: refs, ic
    double precision :: a, b
    a = 0.d0 ; b = 1.d0
  end subroutine curv_int

  subroutine curv0(refs, ic, t, C)
    integer :: refs, ic
    double precision :: t, C(2)
    C = (1 - t) * sides(1:2, ic) + t * sides(3:4, ic)
  end subroutine curv0

  subroutine curv1(refs, ic, t, Ct)
    integer :: refs, ic
    double precision :: t, Ct(2)
    Ct = sides(3:4, ic) - sides(1:2, ic)
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
