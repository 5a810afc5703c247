# SPDX-License-Identifier: BSD-3-Clause
# cmake -DPROGRAM= -DNAME= -DCORPUS= [-DWORK= -DRUNS= -DSEED=] -P run_fuzz.cmake: replays the corpus of a fuzzer. With RUNS
# it mutates a fresh copy of the corpus in WORK (libFuzzer adds to its folder), and keeps an input that fails there.
file(GLOB seeds ${CORPUS}/*)
list(LENGTH seeds count)
if(count EQUAL 0)
  message(FATAL_ERROR "${CORPUS} is empty")
endif()
# malloc_limit_mb: a small file with a large count in it must not make the reader allocate gigabytes.
set(limits -timeout=20 -malloc_limit_mb=64)
if(RUNS)
  file(REMOVE_RECURSE ${WORK})
  file(MAKE_DIRECTORY ${WORK}/corpus)
  file(COPY ${seeds} DESTINATION ${WORK}/corpus)
  set(how -runs=${RUNS} -seed=${SEED} -max_len=4096 -print_final_stats=1 -artifact_prefix=${WORK}/ ${WORK}/corpus)
else()
  set(how ${seeds})
endif()
execute_process(COMMAND ${PROGRAM} --of=${NAME} ${limits} ${how} RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "the fuzzer failed: ${result}")
endif()
