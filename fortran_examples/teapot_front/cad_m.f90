! SPDX-License-Identifier: BSD-3-Clause
!> Four patches of the front of the Utah teapot (RT-0232 sec. 6.2, fig. 18 to 23), references 1, 4 (rim), 5 and 8 (body). The
!> lines u = 0.3 and u = 0.8 are imposed inside the rim. The borders of the body patches are moved to the line of the spout.
!> The environment variable TEAPOT_SIZES chooses the sizes of figures 21 to 23: "patch" (a size for each patch) or "point" (a
!> size at each end of a curve); otherwise no answer.
module cad_m
  use bezier_m
  use spout_m
  implicit none

  ! u1 v1 u2 v2 of a side of a rim patch: the sides v = 0 and v = 1 are cut where the inner lines end
  double precision, parameter :: rim(4, 10) = reshape([ &
    0.d0, 0.d0, 0.3d0, 0.d0,  0.3d0, 0.d0, 0.8d0, 0.d0,  0.8d0, 0.d0, 1.d0, 0.d0,  1.d0, 0.d0, 1.d0, 1.d0, &
    1.d0, 1.d0, 0.8d0, 1.d0,  0.8d0, 1.d0, 0.3d0, 1.d0,  0.3d0, 1.d0, 0.d0, 1.d0,  0.d0, 1.d0, 0.d0, 0.d0, &
    0.3d0, 0.d0, 0.3d0, 1.d0, 0.8d0, 0.d0, 0.8d0, 1.d0], [4, 10])
  ! of the body patches 5 and 8; the second side of patch 5 and the third of patch 8 are cuts; found by cad_init
  double precision :: left(4, 5), right(4, 5)
  type(cut) :: left_cut, right_cut
  character(8) :: sizes = ' '

contains

  subroutine cad_init
    double precision :: p(2), q(2)
    call read_patches('teapot.bpt')
    call get_environment_variable('TEAPOT_SIZES', sizes)
    left_cut = cut_body(5, 0.d0, 0.2d0, 17, 0.d0, 0.6d0)
    p = left_cut%point(:, 0)
    q = cut0(left_cut, 1.d0)
    left = reshape([0.d0, 0.d0, p,  p, q,  q, 1.d0, 1.d0,  1.d0, 1.d0, 0.d0, 1.d0,  0.d0, 1.d0, 0.d0, 0.d0], [4, 5])
    right_cut = cut_body(8, 1.d0, 0.8d0, 18, 1.d0, 0.4d0)
    p = right_cut%point(:, 0)
    q = cut0(right_cut, 1.d0)
    right = reshape([0.d0, 0.d0, 1.d0, 0.d0,  1.d0, 0.d0, q,  q, p,  p, 0.d0, 1.d0,  0.d0, 1.d0, 0.d0, 0.d0], [4, 5])
  end subroutine cad_init

  !> u1 v1 u2 v2 of curve ic of patch refs
  function segment(refs, ic)
    integer :: refs, ic
    double precision :: segment(4)
    select case (refs)
    case (5)
      segment = left(:, ic)
    case (8)
      segment = right(:, ic)
    case default
      segment = rim(:, ic)
    end select
  end function segment

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
    double precision :: t, C(2), s(4)
    if (refs == 5 .and. ic == 2) then
      C = cut0(left_cut, t)
    else if (refs == 8 .and. ic == 3) then
      C = cut0(right_cut, 1 - t)
    else
      s = segment(refs, ic)
      C = (1 - t) * s(1:2) + t * s(3:4)
    end if
  end subroutine curv0

  subroutine curv1(refs, ic, t, Ct)
    integer :: refs, ic
    double precision :: t, Ct(2), s(4)
    if (refs == 5 .and. ic == 2) then
      Ct = cut1(left_cut, t)
    else if (refs == 8 .and. ic == 3) then
      Ct = -cut1(right_cut, 1 - t)
    else
      s = segment(refs, ic)
      Ct = s(3:4) - s(1:2)
    end if
  end subroutine curv1

  subroutine curv2(refs, ic, t, Ctt)
    integer :: refs, ic
    double precision :: t, Ctt(2)
    if (refs == 5 .and. ic == 2) then
      Ctt = cut2(left_cut, t)
    else if (refs == 8 .and. ic == 3) then
      Ctt = cut2(right_cut, 1 - t)
    else
      Ctt = 0
    end if
  end subroutine curv2

  subroutine cad_hphys(refs, uv, h)
    integer :: refs
    double precision :: uv(2), h
    double precision, parameter :: th(8) = [0.05d0, 0.d0, 0.d0, 0.1d0, 0.2d0, 0.d0, 0.d0, 0.8d0]
    if (sizes == 'patch') h = th(refs)
  end subroutine cad_hphys

  subroutine cad_hphyc(refs, ic, t, h)
    integer :: refs, ic
    double precision :: t, h
    ! h is left untouched: no answer
  end subroutine cad_hphyc

  subroutine cad_hphyp(refp, h)
    integer :: refp
    double precision :: h
    if (sizes /= 'point') return
    if (refp == 6) then
      h = 0.01d0
    else if (refp <= 26) then
      h = 0.1d0
    else
      h = 0.5d0
    end if
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
