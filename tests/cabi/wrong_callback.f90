! SPDX-License-Identifier: BSD-3-Clause
! Must not compile: the compiler checks callbacks against the interfaces of module carreau.
module wrong_m
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t
  implicit none
contains
  subroutine surf0(refs, uv, S) bind(c)
    integer(c_int32_t), intent(in) :: refs
    real(c_double), intent(in) :: uv(2)
    real(c_double), intent(out) :: S(2)   ! three numbers are needed
    S = uv + refs
  end subroutine surf0

  subroutine curv_int(refs, ic, a, b) bind(c)
    integer(c_int32_t), intent(in) :: refs, ic
    real(c_double), intent(out) :: a, b
    a = refs; b = ic
  end subroutine curv_int

  subroutine curv0(refs, ic, t, C) bind(c)
    integer(c_int32_t), intent(in) :: refs, ic
    real(c_double), intent(in) :: t
    real(c_double), intent(out) :: C(2)
    C = t + refs + ic
  end subroutine curv0
end module wrong_m

subroutine wrong
  use, intrinsic :: iso_c_binding, only: c_int32_t
  use carreau
  use wrong_m
  implicit none
  type(carreau_session) :: session
  integer(c_int32_t) :: status
  call carreau_session_create(session, status)
  call carreau_set_cad_m(session, surf0, curv_int, curv0, status)
end subroutine wrong
