# SPDX-License-Identifier: BSD-3-Clause
# Static libraries without OpenEXR and oneTBB, libcarreau_cad among them: they are built, installed and moved; programs in C use them by CMake,
# by pkg-config and by hand. Variables: SOURCE, WORK, TESTS (this folder), CC, PKG_CONFIG, GENERATOR, OPENCASCADE (ON, OFF).
file(REMOVE_RECURSE "${WORK}")
function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
# Nothing is measured: the quickest compilation does.
run(${CMAKE_COMMAND} -S ${SOURCE} -B "${WORK}/build" -G ${GENERATOR} -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE=-O0 -DCARREAU_WERROR=OFF
  -DBUILD_SHARED_LIBS=OFF -DCARREAU_OPENEXR=OFF -DCARREAU_TBB=OFF -DCARREAU_MPI=OFF -DCARREAU_TESTS=OFF -DCARREAU_COMMAND=OFF -DCARREAU_FORTRAN=OFF -DCARREAU_OPENCASCADE=${OPENCASCADE})
run(${CMAKE_COMMAND} --build "${WORK}/build" --parallel)
run(${CMAKE_COMMAND} --install "${WORK}/build" --prefix "${WORK}/first")
file(RENAME "${WORK}/first" "${WORK}/a tree")
file(GLOB shared "${WORK}/a tree/lib/*.so*")
if(shared OR NOT EXISTS "${WORK}/a tree/lib/libcarreau.a")
  message(FATAL_ERROR "not a static library: ${shared}")
endif()
set(cad 0)
if(OPENCASCADE)
  set(cad 1)
  if(NOT EXISTS "${WORK}/a tree/lib/libcarreau_cad.a")
    message(FATAL_ERROR "libcarreau_cad is no static library")
  endif()
  run(${CMAKE_COMMAND} -DSOURCE=${TESTS}/cad "-DBUILD=${WORK}/cad customer" "-DTREE=${WORK}/a tree" -DGENERATOR=${GENERATOR}
    -DPROGRAM=mesh_sphere -P ${TESTS}/project.cmake)
endif()
run(${CMAKE_COMMAND} -DSOURCE=${TESTS}/c "-DBUILD=${WORK}/customer" "-DTREE=${WORK}/a tree" -DGENERATOR=${GENERATOR} -DPROGRAM=customer
  -P ${TESTS}/project.cmake)
if(PKG_CONFIG)
  run(sh ${TESTS}/pkg_config.sh "${WORK}/a tree" "${WORK}/by pkg-config" ${PKG_CONFIG} ${CC} ${cad})
endif()
# What it was built without is refused with a sentence; threads of the standard library give the mesh of one.
file(WRITE "${WORK}/variant.c" "#include <carreau.h>
#include <stdio.h>
#include <string.h>
static int32_t plane(int32_t f, double u, double v, int32_t o, double* S, double* a, double* b, double* c, double* d, double* e, void* x) {
  return S[0] = u + f, S[1] = v, S[2] = 0, 0;
}
static int32_t interval(int32_t f, int32_t ic, double* a, double* b, void* x) { return *a = 0, *b = 1, 0; }
static int32_t side(int32_t f, int32_t ic, double t, int32_t o, double* C, double* Ct, double* Ctt, void* x) {
  static const double at[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
  for (int i = 0; i < 2; ++i) C[i] = (1 - t) * at[ic - 1][i] + t * at[ic][i];
  return 0;
}
static int64_t triangles(int threads, int write) {
  carreau_cad cad = {.struct_size = sizeof cad, .reentrant = 1, .surface = plane, .curve_interval = interval, .curve = side};
  carreau_session* s;
  carreau_mesh* mesh;
  int64_t n = -1;
  carreau_session_create(&s);
  carreau_set_cad(s, &cad);
  for (int f = 1; f <= 8; ++f) {
    carreau_model_add_face(s, f, 1);
    for (int ic = 1; ic <= 4; ++ic) carreau_model_add_curve(s, f, CARREAU_BOUNDARY, 0, 0, 0);
  }
  carreau_set_real(s, \"hphydef\", 0.05);
  carreau_set_integer(s, \"threads\", threads);
  if (carreau_mesh_generate(s) != CARREAU_OK) return puts(carreau_last_error(s)), -1;
  carreau_session_mesh(s, &mesh);
  carreau_mesh_count(mesh, NULL, &n, NULL, NULL);
  if (write) {
    if (carreau_write_exr(s, \"x.exr\", NULL) != CARREAU_ERR_FILE || strstr(carreau_last_error(s), \"without OpenEXR\") == NULL) return -2;
    carreau_exr_options small = {.struct_size = sizeof small, .longest = 32};
    if (carreau_write_exr(s, \"x.png\", &small) != CARREAU_OK) return puts(carreau_last_error(s)), -3;
  }
  carreau_session_free(s);
  return n;
}
int main(void) {
  int64_t one = triangles(1, 1), four = triangles(4, 0);
  printf(\"%ld and %ld triangles\\n\", (long)one, (long)four);
  return one > 5000 && one == four ? 0 : 1;
}
")
# By hand, as README says for a static library.
run(${CC} -std=c99 "${WORK}/variant.c" -o "${WORK}/variant" "-I${WORK}/a tree/include" "-L${WORK}/a tree/lib" -lcarreau -lz -lstdc++ -lm -pthread)
execute_process(COMMAND "${WORK}/variant" WORKING_DIRECTORY "${WORK}" COMMAND_ERROR_IS_FATAL ANY)
