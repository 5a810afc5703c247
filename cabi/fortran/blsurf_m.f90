! SPDX-License-Identifier: BSD-3-Clause
!> The program of RT-0232 around a module cad_m of the user, unchanged (RT-0232 sec. 3.1 and 5):
!>
!>     program blsurf
!>       use blsurf_m
!>       call blsurf_s
!>     end program blsurf
!>
!> cad_m is compiled first, then this file; both are linked with carreau_fortran and carreau. cad_m holds the routines of
!> the manual's figure 10; cad_init and the routines of sizes (cad_hphys, cad_hphyc, cad_hphyp, cad_rads, cad_radc) may be
!> left out:
!> nothing is initialised, no size is answered. blsurf_s does not call routines that the variables of blsurf.env do not need.
module blsurf_m
  use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_ptr
  use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
  use carreau
  ! Other names here: a module cad_m may hold anything else besides its routines.
  use cad_m, only: user_surf0 => surf0, user_surf1 => surf1, user_surf2 => surf2, &
    user_curv_int => curv_int, user_curv0 => curv0, user_curv1 => curv1, user_curv2 => curv2
  implicit none
  private
  public :: blsurf_s

contains

  !> Runs a blsurf.env: `env`, or the first argument of the command line, or blsurf.env in the current folder. Files that
  !> it names are beside it. Prints messages by its variable verb. When something fails the sentence goes to the
  !> error output, and the program stops with exit code 1.
  subroutine blsurf_s(env)
    character(len=*), intent(in), optional :: env
    type(carreau_session) :: session
    integer(c_int32_t) :: status
    call user_init
    call carreau_session_create(session, status)
    call check(status)
    call carreau_set_message_callback(session, status, print_message)
    call check(status)
    call carreau_set_cad_m(session, surf0, curv_int, curv0, status, surf1=surf1, surf2=surf2, curv1=curv1, &
      curv2=curv2, cad_hphys=hphys, cad_hphyc=hphyc, cad_hphyp=hphyp, cad_rads=rads, cad_radc=radc)
    call check(status)
    if (present(env)) then
      call carreau_run_env(session, env, status)
    else
      call carreau_run_env(session, env_of_command_line(), status)
    end if
    call check(status)
    call carreau_session_free(session)

  contains

    subroutine check(status)
      integer(c_int32_t), intent(in) :: status
      if (status == CARREAU_OK) return
      flush (output_unit)
      write (error_unit, '(4a)') 'blsurf: ', carreau_last_error(session), ' ', '['//carreau_status_name(status)//']'
      call carreau_session_free(session)
      stop 1
    end subroutine check
  end subroutine blsurf_s

  function env_of_command_line() result(path)
    character(len=:), allocatable :: path
    integer :: length
    if (command_argument_count() < 1) then
      path = 'blsurf.env'
      return
    end if
    call get_command_argument(1, length=length)
    allocate (character(len=length) :: path)
    call get_command_argument(1, value=path)
  end function env_of_command_line

  subroutine print_message(level, text, user) bind(c)
    integer(c_int32_t), value :: level
    type(c_ptr), value :: text, user
    if (level <= CARREAU_LEVEL_WARNING) then
      write (error_unit, '(2a)') 'blsurf: warning: ', carreau_string(text)
    else
      write (output_unit, '(2a)') ' ', carreau_string(text)
    end if
    associate (not_needed => user)
    end associate
  end subroutine print_message

  ! The user's routines take default integers and double precision numbers without intent, may change their arguments, and
  ! may be compiled with flags that change default kinds: they get copies of their own kinds. Results start as NaN, so
  ! that values that a routine leaves unset for an unknown reference are found.

  pure function nan() result(value)
    double precision :: value
    value = ieee_value(1.d0, ieee_quiet_nan)
  end function nan

  subroutine surf0(refs, uv, S) bind(c)
    integer(c_int32_t), intent(in) :: refs
    real(c_double), intent(in) :: uv(2)
    real(c_double), intent(out) :: S(3)
    integer :: r
    double precision :: p(2), x(3)
    r = refs; p = uv; x = nan()
    call user_surf0(r, p, x)
    S = x
  end subroutine surf0

  subroutine surf1(refs, uv, Su, Sv) bind(c)
    integer(c_int32_t), intent(in) :: refs
    real(c_double), intent(in) :: uv(2)
    real(c_double), intent(out) :: Su(3), Sv(3)
    integer :: r
    double precision :: p(2), xu(3), xv(3)
    r = refs; p = uv; xu = nan(); xv = xu
    call user_surf1(r, p, xu, xv)
    Su = xu; Sv = xv
  end subroutine surf1

  subroutine surf2(refs, uv, Suu, Suv, Svv) bind(c)
    integer(c_int32_t), intent(in) :: refs
    real(c_double), intent(in) :: uv(2)
    real(c_double), intent(out) :: Suu(3), Suv(3), Svv(3)
    integer :: r
    double precision :: p(2), xuu(3), xuv(3), xvv(3)
    r = refs; p = uv; xuu = nan(); xuv = xuu; xvv = xuu
    call user_surf2(r, p, xuu, xuv, xvv)
    Suu = xuu; Suv = xuv; Svv = xvv
  end subroutine surf2

  subroutine curv_int(refs, ic, a, b) bind(c)
    integer(c_int32_t), intent(in) :: refs, ic
    real(c_double), intent(out) :: a, b
    integer :: r, i
    double precision :: x, y
    r = refs; i = ic; x = nan(); y = x
    call user_curv_int(r, i, x, y)
    a = x; b = y
  end subroutine curv_int

  subroutine curv0(refs, ic, t, C) bind(c)
    integer(c_int32_t), intent(in) :: refs, ic
    real(c_double), intent(in) :: t
    real(c_double), intent(out) :: C(2)
    integer :: r, i
    double precision :: w, p(2)
    r = refs; i = ic; w = t; p = nan()
    call user_curv0(r, i, w, p)
    C = p
  end subroutine curv0

  subroutine curv1(refs, ic, t, C) bind(c)
    integer(c_int32_t), intent(in) :: refs, ic
    real(c_double), intent(in) :: t
    real(c_double), intent(out) :: C(2)
    integer :: r, i
    double precision :: w, p(2)
    r = refs; i = ic; w = t; p = nan()
    call user_curv1(r, i, w, p)
    C = p
  end subroutine curv1

  subroutine curv2(refs, ic, t, C) bind(c)
    integer(c_int32_t), intent(in) :: refs, ic
    real(c_double), intent(in) :: t
    real(c_double), intent(out) :: C(2)
    integer :: r, i
    double precision :: w, p(2)
    r = refs; i = ic; w = t; p = nan()
    call user_curv2(r, i, w, p)
    C = p
  end subroutine curv2

  subroutine hphys(refs, uv, h) bind(c)
    integer(c_int32_t), intent(in) :: refs
    real(c_double), intent(in) :: uv(2)
    real(c_double), intent(inout) :: h
    integer :: r
    double precision :: p(2), x
    r = refs; p = uv; x = h
    call user_hphys(r, p, x)
    h = x
  end subroutine hphys

  subroutine hphyc(refs, ic, t, h) bind(c)
    integer(c_int32_t), intent(in) :: refs, ic
    real(c_double), intent(in) :: t
    real(c_double), intent(inout) :: h
    integer :: r, i
    double precision :: w, x
    r = refs; i = ic; w = t; x = h
    call user_hphyc(r, i, w, x)
    h = x
  end subroutine hphyc

  subroutine hphyp(refp, h) bind(c)
    integer(c_int32_t), intent(in) :: refp
    real(c_double), intent(inout) :: h
    integer :: r
    double precision :: x
    r = refp; x = h
    call user_hphyp(r, x)
    h = x
  end subroutine hphyp

  subroutine rads(refs, uv, h) bind(c)
    integer(c_int32_t), intent(in) :: refs
    real(c_double), intent(in) :: uv(2)
    real(c_double), intent(inout) :: h
    integer :: r
    double precision :: p(2), x
    r = refs; p = uv; x = h
    call user_rads(r, p, x)
    h = x
  end subroutine rads

  subroutine radc(refs, ic, t, h) bind(c)
    integer(c_int32_t), intent(in) :: refs, ic
    real(c_double), intent(in) :: t
    real(c_double), intent(inout) :: h
    integer :: r, i
    double precision :: w, x
    r = refs; i = ic; w = t; x = h
    call user_radc(r, i, w, x)
    h = x
  end subroutine radc

  ! Routines that cad_m may leave out. In a procedure that uses cad_m its names hide the names of this module: the empty
  ! routines below are called where it has none. There, our names must not be names of cad_m.

  subroutine user_init
    use cad_m
    call cad_init
  end subroutine user_init

  subroutine user_hphys(blsurf_m_refs, blsurf_m_uv, blsurf_m_h)
    use cad_m
    integer :: blsurf_m_refs
    double precision :: blsurf_m_uv(2), blsurf_m_h
    call cad_hphys(blsurf_m_refs, blsurf_m_uv, blsurf_m_h)
  end subroutine user_hphys

  subroutine user_hphyc(blsurf_m_refs, blsurf_m_ic, blsurf_m_t, blsurf_m_h)
    use cad_m
    integer :: blsurf_m_refs, blsurf_m_ic
    double precision :: blsurf_m_t, blsurf_m_h
    call cad_hphyc(blsurf_m_refs, blsurf_m_ic, blsurf_m_t, blsurf_m_h)
  end subroutine user_hphyc

  subroutine user_hphyp(blsurf_m_refp, blsurf_m_h)
    use cad_m
    integer :: blsurf_m_refp
    double precision :: blsurf_m_h
    call cad_hphyp(blsurf_m_refp, blsurf_m_h)
  end subroutine user_hphyp

  subroutine user_rads(blsurf_m_refs, blsurf_m_uv, blsurf_m_rho)
    use cad_m
    integer :: blsurf_m_refs
    double precision :: blsurf_m_uv(2), blsurf_m_rho
    call cad_rads(blsurf_m_refs, blsurf_m_uv, blsurf_m_rho)
  end subroutine user_rads

  subroutine user_radc(blsurf_m_refs, blsurf_m_ic, blsurf_m_t, blsurf_m_rho)
    use cad_m
    integer :: blsurf_m_refs, blsurf_m_ic
    double precision :: blsurf_m_t, blsurf_m_rho
    call cad_radc(blsurf_m_refs, blsurf_m_ic, blsurf_m_t, blsurf_m_rho)
  end subroutine user_radc

  subroutine cad_init
  end subroutine cad_init

  subroutine cad_hphys(refs, uv, h)
    integer :: refs
    double precision :: uv(2), h
    associate (not_needed => refs, neither => uv, nor => h)
    end associate
  end subroutine cad_hphys

  subroutine cad_hphyc(refs, ic, t, h)
    integer :: refs, ic
    double precision :: t, h
    associate (not_needed => refs, neither => ic, nor => t, nor_this => h)
    end associate
  end subroutine cad_hphyc

  subroutine cad_hphyp(refp, h)
    integer :: refp
    double precision :: h
    associate (not_needed => refp, neither => h)
    end associate
  end subroutine cad_hphyp

  subroutine cad_rads(refs, uv, rho)
    integer :: refs
    double precision :: uv(2), rho
    associate (not_needed => refs, neither => uv, nor => rho)
    end associate
  end subroutine cad_rads

  subroutine cad_radc(refs, ic, t, rho)
    integer :: refs, ic
    double precision :: t, rho
    associate (not_needed => refs, neither => ic, nor => t, nor_this => rho)
    end associate
  end subroutine cad_radc
end module blsurf_m
