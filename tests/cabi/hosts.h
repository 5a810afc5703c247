/* SPDX-License-Identifier: BSD-3-Clause */
/* Hosts in C for the tests of the interface: geometry in closed form, counted, and able to fail on purpose. */
#ifndef CARREAU_TESTS_HOSTS_H
#define CARREAU_TESTS_HOSTS_H

#include "carreau.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How the next calls misbehave. */
enum { HOST_FINE = 0, HOST_NAN, HOST_INFINITY, HOST_STATUS, HOST_REVERSED_INTERVAL, HOST_WRONG_DERIVATIVE };

/* The target of `user` for a host of carreau_cad. */
typedef struct test_host {
  int64_t calls;          /* of surface, or points of surface_batch */
  int64_t curve_calls;    /* of curve */
  int32_t misbehaviour;   /* HOST_..., from call number misbehave_from on */
  int64_t misbehave_from; /* counted by calls */
  int64_t stop_at;        /* carreau_stop(session) in that call of surface; 0: never */
  int32_t busy_status;    /* of a call on `session` from inside surface; set when probe_busy */
  int32_t probe_busy;
  carreau_session* session;
} test_host;

/* z = (u^2 + v^2) / 2 on [-2.5, 2.5]^2: the paraboloid of RT-0232 sec. 6.1, face 1. */
carreau_cad paraboloid_cad(test_host* host);
carreau_cad paraboloid_batch_cad(test_host* host);
carreau_cad_m paraboloid_cad_m(void); /* its routines do not fail, and count their calls */
void reset_cad_m_calls(void);
int64_t count_cad_m_calls(int32_t order); /* calls of surf0, surf1 or surf2 in this thread since the reset */
/* One face, four boundary curves with references 1..4 and ends 1..4. */
carreau_status paraboloid_model(carreau_session* session);

/* Torus of radii 3 and 1 over [0, 2 pi]^2, face 5: two seams, every corner the same point. */
carreau_cad torus_cad(test_host* host);
carreau_status torus_model(carreau_session* session);

/* The whole run of the paraboloid by carreau_cad_m with `hphydef`; the session is the caller's to free. */
carreau_status mesh_paraboloid(double hphydef, carreau_session** out_session);

#ifdef __cplusplus
}
#endif

#endif
