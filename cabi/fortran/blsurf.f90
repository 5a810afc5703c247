program blsurf
  use blsurf_m
  call blsurf_s
end program blsurf
