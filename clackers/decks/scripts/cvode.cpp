#include "clackers/decks/rows.hpp"
#include "clackers/decks/scripts/data.hpp"
#include "clackers/decks/text.hpp"

namespace clackers::decks {
namespace {

constexpr Syntax c_syntax = {
    .comment = "//",
    .table = "enum { @name@_rows = @rows@ };\nstatic const double @name@[] = {@values@};\n",
    .vector = "static const double @name@[] = {@values@};\n",
    .number = "static const double @name@ = @value@;\n",
    .line = "",
    .nothing = "0",
};

constexpr auto cvode_model =
    R"c(@head@// Build: cc model.c -lsundials_cvode -lsundials_nvecserial -lsundials_sunlinsoldense -lsundials_sunmatrixdense -lm
// Usage: ./model TOLERANCE HISTORY.csv
#include <cvode/cvode.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>
#include <stdlib.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

@data@
enum { n = M_rows };

static double dot(const double* a, const double* b) {
  double sum = 0.0;
  for (int i = 0; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

// M^-1 f, into f.
static void solve(double* f) {
  double A[n * n];
  for (int i = 0; i < n * n; ++i) A[i] = M[i];
  for (int k = 0; k < n; ++k)  // M is positive definite: no pivoting
    for (int i = k + 1; i < n; ++i) {
      const double factor = A[i * n + k] / A[k * n + k];
      for (int j = k; j < n; ++j) A[i * n + j] -= factor * A[k * n + j];
      f[i] -= factor * f[k];
    }
  for (int i = n - 1; i >= 0; --i) {
    for (int j = i + 1; j < n; ++j) f[i] -= A[i * n + j] * f[j];
    f[i] /= A[i * n + i];
  }
}

static int motion(realtype t, N_Vector state, N_Vector rate, void* data) {
  const double *u = N_VGetArrayPointer(state), *v = u + n;
  double *du = N_VGetArrayPointer(rate), *force = du + n;
  (void)data;
  for (int i = 0; i < n; ++i) du[i] = v[i], force[i] = -dot(C + i * n, v) - dot(K + i * n, u);
  for (int k = 0; k < loads_rows; ++k) {
    const double* load = loads + 4 * k;
    force[(int)load[0] - 1] += load[1] * cos(load[2] * t + load[3]);
  }
  for (int k = 0; k < springs_rows; ++k) {
    const double *row = springs + (n + 2) * k, gap = dot(row, u) - row[n];
    for (int i = 0; i < n && gap < 0.0; ++i) force[i] -= row[n + 1] * gap * row[i];
  }
  solve(force);
  return 0;
}

static int gaps(realtype t, N_Vector state, realtype* out, void* data) {
  (void)t, (void)data;
  for (int k = 0; k < contacts_rows; ++k) {
    const double* contact = contacts + (n + 2) * k;
    out[k] = dot(contact, N_VGetArrayPointer(state)) - contact[n];
  }
  return 0;
}

// Newton's law, one contact after the other, until none of those that touch is closing.
static void impacts(double* u, double* v, double tolerance) {
  for (int trial = 0; trial < 1000; ++trial) {
    const double* closing = NULL;
    for (int k = 0; k < contacts_rows && closing == NULL; ++k) {
      const double* contact = contacts + (n + 2) * k;
      if (dot(contact, u) - contact[n] < tolerance && dot(contact, v) < 0.0) closing = contact;
    }
    if (closing == NULL) return;
    double jump[n];
    for (int i = 0; i < n; ++i) jump[i] = closing[i];
    solve(jump);
    const double impulse = -(1.0 + closing[n + 1]) * dot(closing, v) / dot(closing, jump);
    for (int i = 0; i < n; ++i) v[i] += impulse * jump[i];
  }
  fputs("Several contacts stay closed: this program has no rule for that.\n", stderr);
  exit(1);
}

static void write(FILE* file, double t, const double* y) {
  fprintf(file, "\n%.17g", t);
  for (int i = 0; i < 2 * n; ++i) fprintf(file, ",%.17g", y[i]);
}

int main(int count, char** words) {
  if (count < 3) return 2;
  const double tolerance = atof(words[1]);
  FILE* file = fopen(words[2], "w");
  if (file == NULL) return 2;
  SUNContext context;
  SUNContext_Create(NULL, &context);
  N_Vector state = N_VNew_Serial(2 * n, context);
  double *y = N_VGetArrayPointer(state), *u = y, *v = y + n;
  for (int i = 0; i < n; ++i) u[i] = u0[i], v[i] = v0[i];
  void* cvode = CVodeCreate(CV_BDF, context);
  CVodeInit(cvode, motion, t0, state);
  CVodeSStolerances(cvode, tolerance, tolerance);
  SUNMatrix matrix = SUNDenseMatrix(2 * n, 2 * n, context);
  CVodeSetLinearSolver(cvode, SUNLinSol_Dense(state, matrix, context), matrix);
  CVodeSetMaxNumSteps(cvode, 1000000);
  CVodeSetStopTime(cvode, last);
  int closing[contacts_rows + 1];  // without the direction the restart on the surface is a root again
  for (int k = 0; k < contacts_rows; ++k) closing[k] = -1;
  CVodeRootInit(cvode, contacts_rows, gaps);
  if (contacts_rows > 0) CVodeSetRootDirection(cvode, closing);
  fputc('t', file);
  for (int i = 0; i < n; ++i) fprintf(file, ",u%d", i + 1);
  for (int i = 0; i < n; ++i) fprintf(file, ",v%d", i + 1);
  write(file, t0, y);
  const int rows = 4000;
  realtype t = t0, before = t0 - 1.0;
  for (int k = 1; k <= rows;) {
    const realtype wanted = k == rows ? last : t0 + (last - t0) * k / rows;
    const int flag = CVode(cvode, wanted, state, &t, CV_NORMAL);
    if (flag < 0) return 1;
    write(file, t, y);
    if (flag != CV_ROOT_RETURN) {
      ++k;
      continue;
    }
    if (t - before < 1e-12 * last) {
      fputs("A contact stays closed: this program has no rule for that.\n", stderr);
      return 1;
    }
    before = t;
    impacts(u, v, tolerance);
    write(file, t, y);
    CVodeReInit(cvode, t, state);  // without it the impact is ignored, and no error is returned
  }
  fputc('\n', file);
  return fclose(file) == 0 ? 0 : 1;
}
)c";

}  // namespace

std::vector<DeckFile> cvode(const Subject& subject) {
  return {{"model.c", filled(cvode_model, {{"head", head(subject, "cvode", "//")},
                                           {"data", data(subject.problem, c_syntax)}})},
          run_script(subject, tolerances(), "./model \"$2\" \"$1.csv\"", ".csv",
                     "--expect proper:5/6",  // tolerance^(k / (k + 1)) of errors per step, k = 5
                     "\"${CC:-cc}\" -O2 -o model model.c -lsundials_cvode -lsundials_nvecserial "
                     "-lsundials_sunlinsoldense -lsundials_sunmatrixdense -lm")};
}

}  // namespace clackers::decks
