/* A step function for clackers_main.h: Newmark's method of constant average acceleration, with impacts
 * located within the step; order 2. C99 and C++. README.md has the lines that compile and run it. */
#include <clackers_main.h>
#include <stdlib.h>

/* Masses, and impacts in a step, that this example takes. */
enum { most = 8, most_impacts = 1000 };

typedef struct point {
  double t, u[most], v[most], a[most];
} point;

static double dot(int n, const double* x, const double* y) {
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += x[i] * y[i];
  return sum;
}

/* x = A^-1 b by elimination. A is positive definite: no pivoting. */
static void solve(int n, double A[most][most], double* b, double* x) {
  for (int k = 0; k < n; ++k)
    for (int i = k + 1; i < n; ++i) {
      const double factor = A[i][k] / A[k][k];
      for (int j = k; j < n; ++j) A[i][j] -= factor * A[k][j];
      b[i] -= factor * b[k];
    }
  for (int i = n - 1; i >= 0; --i)
    x[i] = (b[i] - dot(n - 1 - i, A[i] + i + 1, x + i + 1)) / A[i][i];
}

/* (M + h/2 C + h^2/4 K) a1 = f1 - C (v + h/2 a) - K (u + h v + h^2/4 a); h = 0: M a1 = f - C v - K u. */
static void step(const clackers_run* p, const point* from, double h, point* to) {
  const int n = p->dof;
  double A[most][most], b[most], u[most] = {0}, v[most];
  for (int i = 0; i < n; ++i) {
    u[i] = from->u[i] + h * from->v[i] + h * h / 4 * from->a[i];
    v[i] = from->v[i] + h / 2 * from->a[i];
  }
  to->t = from->t + h;
  clackers_forces(p, to->t, u, b);
  for (int i = 0; i < n; ++i) {
    for (int j = 0, at = i * n; j < n; ++j, ++at)
      A[i][j] = p->M[at] + h / 2 * p->C[at] + h * h / 4 * p->K[at];
    b[i] -= dot(n, p->C + i * n, v) + dot(n, p->K + i * n, u);
  }
  solve(n, A, b, to->a);
  for (int i = 0; i < n; ++i) {
    to->u[i] = u[i] + h * h / 4 * to->a[i];
    to->v[i] = v[i] + h / 2 * to->a[i];
  }
}

/* A contact with a negative gap that closes further, or -1. */
static int violated(const clackers_run* p, const point* x) {
  for (int c = 0; c < p->contacts; ++c) {
    const double* b = p->direction + c * p->dof;
    if (dot(p->dof, b, x->u) < p->gap[c] && dot(p->dof, b, x->v) < 0) return c;
  }
  return -1;
}

/* The velocity after an impact: M (v+ - v-) = impulse b, b . v+ = -restitution b . v-. */
static int impact(clackers_run* p, int c, point* x) {
  const int n = p->dof;
  const double* b = p->direction + c * n;
  double M[most][most], right[most], y[most], before[most];
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) M[i][j] = p->M[i * n + j];
    right[i] = b[i];
    before[i] = x->v[i];
  }
  solve(n, M, right, y);
  const double impulse = -(1 + p->restitution[c]) * dot(n, b, x->v) / dot(n, b, y);
  for (int i = 0; i < n; ++i) x->v[i] += impulse * y[i];
  step(p, x, 0, x); /* the acceleration that goes with it */
  return clackers_add_impact(p, x->t, impulse, before, x->v);
}

/* The state with its acceleration at the start of a run. */
static point* first_point(const clackers_run* run) {
  point* x = (point*)calloc(1, sizeof(point));
  if (x == NULL) return NULL;
  x->t = run->start;
  for (int i = 0; i < run->dof; ++i) x->u[i] = run->u[i], x->v[i] = run->v[i];
  step(run, x, 0, x);
  return x;
}

int clackers_step(clackers_run* run, double t1, double* u, double* v) {
  if (run->dof > most) return clackers_fail(run, "more than 8 masses");
  if (run->springs > 0) return clackers_fail(run, "one-sided springs need an iteration");
  if (run->memory == NULL) run->memory = first_point(run);
  point *x = (point*)run->memory, next;
  if (x == NULL) return clackers_fail(run, "no memory");
  int c, impacts = 0;
  while (step(run, x, t1 - x->t, &next), (c = violated(run, &next)) >= 0) {
    double before = 0, after = t1 - x->t;
    for (int k = 0; k < 60; ++k) {
      const double middle = (before + after) / 2;
      step(run, x, middle, &next);
      if (violated(run, &next) < 0)
        before = middle;
      else
        after = middle;
    }
    step(run, x, before, &next);
    *x = next;
    if (++impacts > most_impacts) return clackers_fail(run, "impacts accumulate in a step");
    if (impact(run, c, x) != 0) return 1;
  }
  *x = next;
  x->t = t1;
  for (int i = 0; i < run->dof; ++i) u[i] = x->u[i], v[i] = x->v[i];
  return 0;
}
