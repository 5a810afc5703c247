/* SPDX-License-Identifier: BSD-3-Clause */
#include "hosts.h"

#include <math.h>
#include <string.h>

static int misbehaves(const test_host* host, int32_t how) {
  return host->misbehaviour == how && host->calls >= host->misbehave_from;
}

/* The work of every surface callback besides its formula. */
static int32_t begin_call(test_host* host) {
  ++host->calls;
  if (host->stop_at != 0 && host->calls == host->stop_at) carreau_stop(host->session);
  if (host->probe_busy) host->busy_status = carreau_set_real(host->session, "hphydef", 1);
  return misbehaves(host, HOST_STATUS) ? 42 : 0;
}

static void spoil(const test_host* host, int32_t order, double* S, double* Su) {
  if (misbehaves(host, HOST_NAN)) S[1] = NAN;
  if (misbehaves(host, HOST_INFINITY)) S[2] = INFINITY;
  if (misbehaves(host, HOST_WRONG_DERIVATIVE) && order >= 1) Su[2] += 0.5;
}

static int32_t interval(int32_t face, int32_t ic, double* a, double* b, void* user, double length) {
  const test_host* host = (const test_host*)user;
  (void)face;
  (void)ic;
  *a = misbehaves(host, HOST_REVERSED_INTERVAL) ? length : 0;
  *b = misbehaves(host, HOST_REVERSED_INTERVAL) ? 0 : length;
  return 0;
}

/* ---- Paraboloid ---- */

static int32_t paraboloid_surface(int32_t face, double u, double v, int32_t order, double* S, double* Su, double* Sv,
                                  double* Suu, double* Suv, double* Svv, void* user) {
  test_host* host = (test_host*)user;
  const int32_t status = begin_call(host);
  (void)face;
  if (status != 0) return status;
  S[0] = u, S[1] = v, S[2] = (u * u + v * v) / 2;
  if (order >= 1) {
    Su[0] = 1, Su[1] = 0, Su[2] = u;
    Sv[0] = 0, Sv[1] = 1, Sv[2] = v;
  }
  if (order >= 2) {
    Suu[0] = 0, Suu[1] = 0, Suu[2] = 1;
    Suv[0] = 0, Suv[1] = 0, Suv[2] = 0;
    Svv[0] = 0, Svv[1] = 0, Svv[2] = 1;
  }
  spoil(host, order, S, Su);
  return 0;
}

static int32_t paraboloid_batch(int32_t face, int64_t n, const double* uv, int32_t order, double* S, double* Su,
                                double* Sv, double* Suu, double* Suv, double* Svv, void* user) {
  double unused[3];
  for (int64_t i = 0; i < n; ++i) {
    const int32_t status =
        paraboloid_surface(face, uv[2 * i], uv[2 * i + 1], order, S + 3 * i, order >= 1 ? Su + 3 * i : unused,
                           order >= 1 ? Sv + 3 * i : unused, order >= 2 ? Suu + 3 * i : unused,
                           order >= 2 ? Suv + 3 * i : unused, order >= 2 ? Svv + 3 * i : unused, user);
    if (status != 0) return status;
  }
  return 0;
}

static const double segments[4][4] = {
    {-2.5, -2.5, 2.5, -2.5}, {2.5, -2.5, 2.5, 2.5}, {2.5, 2.5, -2.5, 2.5}, {-2.5, 2.5, -2.5, -2.5}};

static int32_t paraboloid_interval(int32_t face, int32_t ic, double* a, double* b, void* user) {
  return interval(face, ic, a, b, user, 1);
}

static int32_t paraboloid_curve(int32_t face, int32_t ic, double t, int32_t order, double* C, double* Ct, double* Ctt,
                                void* user) {
  const double* s = segments[ic - 1];
  (void)face;
  ++((test_host*)user)->curve_calls;
  C[0] = s[0] + t * (s[2] - s[0]), C[1] = s[1] + t * (s[3] - s[1]);
  if (order >= 1) Ct[0] = s[2] - s[0], Ct[1] = s[3] - s[1];
  if (order >= 2) Ctt[0] = 0, Ctt[1] = 0;
  return 0;
}

carreau_cad paraboloid_cad(test_host* host) {
  carreau_cad cad;
  memset(&cad, 0, sizeof cad);
  cad.struct_size = sizeof cad;
  cad.user = host;
  cad.surface_order = 2;
  cad.curve_order = 2;
  cad.surface = paraboloid_surface;
  cad.curve_interval = paraboloid_interval;
  cad.curve = paraboloid_curve;
  return cad;
}

carreau_cad paraboloid_batch_cad(test_host* host) {
  carreau_cad cad = paraboloid_cad(host);
  cad.surface = NULL;
  cad.surface_batch = paraboloid_batch;
  return cad;
}

carreau_status paraboloid_model(carreau_session* session) {
  carreau_status status = carreau_model_add_face(session, 1, 1);
  for (int32_t ic = 1; ic <= 4 && status == CARREAU_OK; ++ic)
    status = carreau_model_add_curve(session, 1, CARREAU_BOUNDARY, ic, ic, ic % 4 + 1);
  return status;
}

/* The same by the routines of cad_m, which have no user pointer. */
static _Thread_local int64_t cad_m_calls[3];
static _Thread_local test_host quiet;

void reset_cad_m_calls(void) { cad_m_calls[0] = cad_m_calls[1] = cad_m_calls[2] = 0; }
int64_t count_cad_m_calls(int32_t order) { return cad_m_calls[order]; }

static void surf0(const int32_t* refs, const double* uv, double* S) {
  (void)refs;
  ++cad_m_calls[0];
  S[0] = uv[0], S[1] = uv[1], S[2] = (uv[0] * uv[0] + uv[1] * uv[1]) / 2;
}
static void surf1(const int32_t* refs, const double* uv, double* Su, double* Sv) {
  (void)refs;
  ++cad_m_calls[1];
  Su[0] = 1, Su[1] = 0, Su[2] = uv[0];
  Sv[0] = 0, Sv[1] = 1, Sv[2] = uv[1];
}
static void surf2(const int32_t* refs, const double* uv, double* Suu, double* Suv, double* Svv) {
  (void)refs;
  (void)uv;
  ++cad_m_calls[2];
  Suu[0] = 0, Suu[1] = 0, Suu[2] = 1;
  Suv[0] = 0, Suv[1] = 0, Suv[2] = 0;
  Svv[0] = 0, Svv[1] = 0, Svv[2] = 1;
}
static void curv_int(const int32_t* refs, const int32_t* ic, double* a, double* b) {
  paraboloid_interval(*refs, *ic, a, b, &quiet);
}
static void curv0(const int32_t* refs, const int32_t* ic, const double* t, double* C) {
  paraboloid_curve(*refs, *ic, *t, 0, C, NULL, NULL, &quiet);
}
static void curv1(const int32_t* refs, const int32_t* ic, const double* t, double* Ct) {
  double C[2];
  paraboloid_curve(*refs, *ic, *t, 1, C, Ct, NULL, &quiet);
}
static void curv2(const int32_t* refs, const int32_t* ic, const double* t, double* Ctt) {
  double C[2], Ct[2];
  paraboloid_curve(*refs, *ic, *t, 2, C, Ct, Ctt, &quiet);
}

carreau_cad_m paraboloid_cad_m(void) {
  carreau_cad_m cad;
  memset(&cad, 0, sizeof cad);
  cad.struct_size = sizeof cad;
  cad.surf0 = surf0, cad.surf1 = surf1, cad.surf2 = surf2;
  cad.curv_int = curv_int;
  cad.curv0 = curv0, cad.curv1 = curv1, cad.curv2 = curv2;
  return cad;
}

carreau_status mesh_paraboloid(double hphydef, carreau_session** out_session) {
  const carreau_cad_m cad = paraboloid_cad_m();
  carreau_status status = carreau_session_create(out_session);
  if (status == CARREAU_OK) status = carreau_set_cad_m(*out_session, &cad);
  if (status == CARREAU_OK) status = paraboloid_model(*out_session);
  if (status == CARREAU_OK) status = carreau_set_real(*out_session, "hphydef", hphydef);
  if (status == CARREAU_OK) status = carreau_mesh_generate(*out_session);
  return status;
}

/* ---- Torus ---- */

static const double two_pi = 6.283185307179586;

static int32_t torus_surface(int32_t face, double u, double v, int32_t order, double* S, double* Su, double* Sv,
                             double* Suu, double* Suv, double* Svv, void* user) {
  test_host* host = (test_host*)user;
  const int32_t status = begin_call(host);
  const double cu = cos(u), su = sin(u), cv = cos(v), sv = sin(v), w = 3 + cv;
  (void)face;
  if (status != 0) return status;
  S[0] = w * cu, S[1] = w * su, S[2] = sv;
  if (order >= 1) {
    Su[0] = -w * su, Su[1] = w * cu, Su[2] = 0;
    Sv[0] = -sv * cu, Sv[1] = -sv * su, Sv[2] = cv;
  }
  if (order >= 2) {
    Suu[0] = -w * cu, Suu[1] = -w * su, Suu[2] = 0;
    Suv[0] = sv * su, Suv[1] = -sv * cu, Suv[2] = 0;
    Svv[0] = -cv * cu, Svv[1] = -cv * su, Svv[2] = -sv;
  }
  spoil(host, order, S, Su);
  return 0;
}

static int32_t torus_interval(int32_t face, int32_t ic, double* a, double* b, void* user) {
  return interval(face, ic, a, b, user, two_pi);
}

static int32_t torus_curve(int32_t face, int32_t ic, double t, int32_t order, double* C, double* Ct, double* Ctt,
                           void* user) {
  const int along_u = ic % 2 == 1;
  (void)face;
  ++((test_host*)user)->curve_calls;
  /* 1: v = 0, 2: u = 2 pi, 3: v = 2 pi, 4: u = 0; each with its parameter growing */
  C[0] = along_u ? t : (ic == 2 ? two_pi : 0);
  C[1] = along_u ? (ic == 3 ? two_pi : 0) : t;
  if (order >= 1) Ct[0] = along_u, Ct[1] = !along_u;
  if (order >= 2) Ctt[0] = 0, Ctt[1] = 0;
  return 0;
}

carreau_cad torus_cad(test_host* host) {
  carreau_cad cad = paraboloid_cad(host);
  cad.surface = torus_surface;
  cad.curve_interval = torus_interval;
  cad.curve = torus_curve;
  return cad;
}

carreau_status torus_model(carreau_session* session) {
  static const int32_t refs[4] = {1, 2, 1, 2};
  carreau_status status = carreau_model_add_face(session, 5, 1);
  for (int32_t ic = 1; ic <= 4 && status == CARREAU_OK; ++ic)
    status = carreau_model_add_curve(session, 5, CARREAU_BOUNDARY, refs[ic - 1], 1, 1);
  return status;
}
