/* Heun's method for a diagonal M, impacts by bisection, order 2: heun PROBLEM.txt STEPS HISTORY */
#include <stdio.h>
#include <stdlib.h>
enum { most = 8 };
typedef double vector[2 * most]; /* u, then v */
static int dof, contacts;
static vector M[most], C[most], K[most], b[most], gap, eta;
static void read(FILE* file, int count, double* values) { /* of the next line, name=values */
  if (fscanf(file, "%*[^=]=") < 0) exit(3);
  for (; count > 0; --count, ++values)
    if (fscanf(file, "%lf", values) != 1) exit(3);
}
static double dot(const double* x, const double* y) {
  double sum = 0;
  for (int i = 0; i < dof; ++i) sum += x[i] * y[i];
  return sum;
}
static void add(const vector y, double h, const vector x, vector sum) { /* y + h f(x) */
  for (int i = 0; i < dof; ++i) {
    sum[i] = y[i] + h * x[dof + i];
    sum[dof + i] = y[dof + i] - h * (dot(C[i], x + dof) + dot(K[i], x)) / M[i][i];
  }
}
static int step(const vector y, double h, vector y1) { /* returns a closing contact, or -1 */
  vector predictor, middle;
  add(y, h, y, predictor), add(y, h / 2, y, middle), add(middle, h / 2, predictor, y1);
  for (int c = 0; c < contacts; ++c)
    if (dot(b[c], y1) < gap[c] && dot(b[c], y1 + dof) < 0) return c;
  return -1;
}
int main(int argc, char** argv) {
  vector y, y1, head; /* dof, contacts, t, end */
  FILE* file = argc == 4 && atol(argv[2]) > 0 ? fopen(argv[1], "r") : NULL;
  FILE* out = file ? fopen(argv[3], "w") : NULL;
  if (!out) return fputs("usage: heun PROBLEM.txt n OUT.csv, with n > 0 steps\n", stderr), 2;
  for (int i = 0; i < 4; ++i) read(file, 1, head + i);
  if ((dof = (int)head[0]) > most || (contacts = (int)head[1]) > most) return 3;
  read(file, dof, y), read(file, dof, y + dof);
  for (int i = 0; i < 3 * dof; ++i) read(file, dof, (i < dof ? M : i < 2 * dof ? C : K)[i % dof]);
  for (int c = 0; c < contacts; ++c)
    read(file, dof, b[c]), read(file, 1, gap + c), read(file, 1, eta + c);
  fputs(dof == 1 ? "t,u1,v1" : "t,u1,u2,v1,v2", out);
  for (long i = 0, n = atol(argv[2]); i <= n; ++i) {
    fprintf(out, "\n%.17g", head[2] + (head[3] - head[2]) * (double)i / (double)n);
    for (int j = 0; j < 2 * dof; ++j) fprintf(out, ",%.17g", y[j]);
    double left = (head[3] - head[2]) / (double)n, mobility = 0;
    for (int c; (c = step(y, left, y1)) >= 0; mobility = 0) { /* an impact within the step */
      double before = 0, after = left, middle;
      for (int k = 0; k < 60; ++k)
        middle = (before + after) / 2, *(step(y, middle, y1) < 0 ? &before : &after) = middle;
      step(y, before, y), left -= before;
      for (int j = 0; j < dof; ++j) mobility += b[c][j] * b[c][j] / M[j][j];
      double impulse = -(1 + eta[c]) * dot(b[c], y + dof) / mobility;
      for (int j = 0; j < dof; ++j) y[dof + j] += impulse * b[c][j] / M[j][j];
    }
    for (int j = 0; j < 2 * dof; ++j) y[j] = y1[j];
  }
  return fputs("\n", out) < 0 || fclose(out) != 0;
}
