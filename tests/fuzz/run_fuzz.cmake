# SPDX-License-Identifier: BSD-3-Clause
# cmake -DPROGRAM= -DCORPUS= -DWORK= -DRUNS= -P run_fuzz.cmake: runs a fuzz target on a fresh copy of its corpus
# (libFuzzer adds to the folder it is given). An input that fails is kept in WORK, and its name is printed.
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK}/corpus)
file(GLOB seeds ${CORPUS}/*)
list(LENGTH seeds count)
if(count EQUAL 0)
  message(FATAL_ERROR "${CORPUS} is empty")
endif()
file(COPY ${seeds} DESTINATION ${WORK}/corpus)
# A count of runs, not of seconds: a fast machine looks at what a slow one does.
# malloc_limit_mb: a small file with a large count in it must not make the reader ask for gigabytes.
execute_process(COMMAND ${PROGRAM} -runs=${RUNS} -seed=1 -max_len=4096 -timeout=20 -malloc_limit_mb=64
  -print_final_stats=1 -artifact_prefix=${WORK}/ ${WORK}/corpus RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "the fuzz target failed: ${result}")
endif()
