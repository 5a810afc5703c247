! SPDX-License-Identifier: BSD-3-Clause
program blsurf
  use blsurf_m
  call blsurf_s
end program blsurf
