/* Two colliding masses by SUNDIALS CVODE: the gap u1 - u2 is a root function with a direction
   filter, velocities are reversed by Newton's law at each root.

     cvode_pair m1 m2 k1 k2 c1 c2 eta u10 u20 v10 v20 end rtol step digits HISTORY EVENTS

   HISTORY has a row every `step` and both limits of each impact; EVENTS the impacts. */
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>
#include <stdlib.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

struct pair {
  double m1, m2, k1, k2, c1, c2;
};

static int motion(realtype t, N_Vector y, N_Vector rate, void* data) {
  const struct pair* p = data;
  const double *x = NV_DATA_S(y), u1 = x[0], v1 = x[1], u2 = x[2], v2 = x[3];
  double* r = NV_DATA_S(rate);
  (void)t;
  r[0] = v1;
  r[1] = -(p->c1 * v1 + p->k1 * u1) / p->m1;
  r[2] = v2;
  r[3] = -(p->c2 * v2 + p->k2 * u2) / p->m2;
  return 0;
}

static int gap(realtype t, N_Vector y, realtype* g, void* data) {
  (void)t;
  (void)data;
  g[0] = NV_Ith_S(y, 0) - NV_Ith_S(y, 2);
  return 0;
}

static void require(int good, const char* what) {
  if (good) return;
  fprintf(stderr, "cvode_pair: %s failed\n", what);
  exit(1);
}

static void print(FILE* file, int digits, double t, N_Vector y) {
  fprintf(file, "%.*g", digits, t);
  for (int i = 0; i < 4; ++i) fprintf(file, " %.*g", digits, NV_Ith_S(y, i));
  fputc('\n', file);
}

int main(int argc, char** argv) {
  require(argc == 18, "reading 17 arguments");
  double a[16] = {0};
  for (int i = 1; i < 16; ++i) a[i] = strtod(argv[i], NULL);
  struct pair p = {a[1], a[2], a[3], a[4], a[5], a[6]};
  const double eta = a[7], end = a[12], rtol = a[13], step = a[14];
  const int digits = (int)a[15];
  FILE *history = fopen(argv[16], "w"), *events = fopen(argv[17], "w");
  require(history && events, "opening files");
  fprintf(history, "# by CVODE, rtol = %g\nt u1 v1 u2 v2\n", rtol);
  fprintf(events, "t impulse v1- v1+ v2- v2+\n");

  SUNContext context;
  require(SUNContext_Create(NULL, &context) == 0, "SUNContext_Create");
  N_Vector y = N_VNew_Serial(4, context);
  const double start[4] = {a[8], a[10], a[9], a[11]};
  for (int i = 0; i < 4; ++i) NV_Ith_S(y, i) = start[i];
  SUNMatrix matrix = SUNDenseMatrix(4, 4, context);
  SUNLinearSolver solver = SUNLinSol_Dense(y, matrix, context);
  void* cvode = CVodeCreate(CV_BDF, context);
  int closing = -1;
  require(
      CVodeInit(cvode, motion, 0.0, y) == 0 && CVodeSStolerances(cvode, rtol, 0.01 * rtol) == 0 &&
          CVodeSetUserData(cvode, &p) == 0 && CVodeSetMaxNumSteps(cvode, 1000000) == 0 &&
          CVodeSetLinearSolver(cvode, solver, matrix) == 0 && CVodeRootInit(cvode, 1, gap) == 0 &&
          CVodeSetRootDirection(cvode, &closing) == 0 && CVodeSetStopTime(cvode, end) == 0,
      "setting up");
  print(history, digits, 0.0, y);
  double t = 0.0;
  for (long n = 1; t < end;) {
    const double next = n * step < end ? n * step : end;
    const int flag = CVode(cvode, next, y, &t, CV_NORMAL);
    require(flag >= 0, "CVode");
    print(history, digits, t, y);
    if (flag != CV_ROOT_RETURN) {
      ++n;
      continue;
    }
    const double v1 = NV_Ith_S(y, 1), v2 = NV_Ith_S(y, 3);
    const double impulse = -(1.0 + eta) * (v1 - v2) / (1.0 / p.m1 + 1.0 / p.m2);
    NV_Ith_S(y, 1) = v1 + impulse / p.m1;
    NV_Ith_S(y, 3) = v2 - impulse / p.m2;
    fprintf(events, "%.*g %.*g %.*g %.*g %.*g %.*g\n", digits, t, digits, impulse, digits, v1,
            digits, NV_Ith_S(y, 1), digits, v2, digits, NV_Ith_S(y, 3));
    print(history, digits, t, y);
    require(CVodeReInit(cvode, t, y) == 0, "CVodeReInit");
  }
  require(fclose(history) == 0 && fclose(events) == 0, "closing files");
  CVodeFree(&cvode);
  SUNLinSolFree(solver);
  SUNMatDestroy(matrix);
  N_VDestroy(y);
  SUNContext_Free(&context);
  return 0;
}
