#include "clackers/decks/rows.hpp"
#include "clackers/decks/scripts/c_text.hpp"
#include "clackers/decks/text.hpp"

namespace clackers::decks {
namespace {

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
@mechanics@
static int motion(realtype t, N_Vector state, N_Vector rate, void* data) {
  (void)data;
  rates(t, 0, N_VGetArrayPointer(state), N_VGetArrayPointer(rate));
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
    if (impacts(u, v, tolerance) < 0) {
      fputs("Several contacts stay closed: this program has no rule for that.\n", stderr);
      return 1;
    }
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
                                           {"data", data(subject.problem, c_syntax)},
                                           {"mechanics", c_mechanics}})},
          run_script(subject, tolerances(), "./model \"$2\" \"$1.csv\"", ".csv",
                     "--expect proper:5/6",  // tolerance^(k / (k + 1)) of errors per step, k = 5
                     "\"${CC:-cc}\" -O2 -o model model.c -lsundials_cvode -lsundials_nvecserial "
                     "-lsundials_sunlinsoldense -lsundials_sunmatrixdense -lm")};
}

}  // namespace clackers::decks
