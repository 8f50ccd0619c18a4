/* A plug-in for `clackers verify --plugin`: Newmark's method of constant average acceleration, with
 * impacts located within the step; order 2. README.md has the lines that compile and run it. */
#include <clackers_solver.h>
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

/* (M + h/2 C + h^2/4 K) a1 = -C (v + h/2 a) - K (u + h v + h^2/4 a); h = 0: M a1 = -C v - K u. */
static void step(const clackers_solver_problem* p, const point* from, double h, point* to) {
  const int n = p->dof;
  double A[most][most], b[most], u[most], v[most];
  for (int i = 0; i < n; ++i) {
    u[i] = from->u[i] + h * from->v[i] + h * h / 4 * from->a[i];
    v[i] = from->v[i] + h / 2 * from->a[i];
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0, at = i * n; j < n; ++j, ++at)
      A[i][j] = p->M[at] + h / 2 * p->C[at] + h * h / 4 * p->K[at];
    b[i] = -dot(n, p->C + i * n, v) - dot(n, p->K + i * n, u);
  }
  to->t = from->t + h;
  solve(n, A, b, to->a);
  for (int i = 0; i < n; ++i) {
    to->u[i] = u[i] + h * h / 4 * to->a[i];
    to->v[i] = v[i] + h / 2 * to->a[i];
  }
}

/* A contact with a negative gap that closes further, or -1. */
static int violated(const clackers_solver_problem* p, const point* x) {
  for (int c = 0; c < p->contacts; ++c) {
    const double* b = p->direction + c * p->dof;
    if (dot(p->dof, b, x->u) < p->gap[c] && dot(p->dof, b, x->v) < 0) return c;
  }
  return -1;
}

/* The velocity after an impact: M (v+ - v-) = impulse b, b . v+ = -restitution b . v-. */
static int impact(const clackers_solver_problem* p, int c, point* x, clackers_solver_host* host) {
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
  return host->collision(host, x->t, impulse, before, x->v);
}

static int32_t prepare(const clackers_solver_problem* p, clackers_solver_host* host, void** state) {
  if (p->dof > most) return host->fail(host, "more than 8 masses");
  point* x = calloc(1, sizeof *x);
  if (x == NULL) return host->fail(host, "no memory");
  *state = x;
  return 0;
}

static int32_t run(void* state, const clackers_solver_problem* p, const clackers_solver_run* run,
                   clackers_solver_host* host) {
  point *x = state, next;
  int result = 0;
  x->t = p->start;
  for (int i = 0; i < p->dof; ++i) x->u[i] = p->u[i], x->v[i] = p->v[i], x->a[i] = 0;
  step(p, x, 0, x);
  for (int64_t i = 1; (result = host->state(host, x->t, x->u, x->v, x->a)) == 0; ++i) {
    if (i > run->steps) return 0;
    const double end = p->start + (p->end - p->start) * (double)i / (double)run->steps;
    int c, impacts = 0;
    while (step(p, x, end - x->t, &next), (c = violated(p, &next)) >= 0) {
      double before = 0, after = end - x->t;
      for (int k = 0; k < 60; ++k) {
        const double middle = (before + after) / 2;
        step(p, x, middle, &next);
        if (violated(p, &next) < 0)
          before = middle;
        else
          after = middle;
      }
      step(p, x, before, &next);
      *x = next;
      if (++impacts > most_impacts) return host->fail(host, "impacts accumulate in a step");
      if ((result = impact(p, c, x, host)) != 0) return result;
    }
    *x = next;
    x->t = end;
  }
  return result;
}

static const clackers_solver solver = {
    CLACKERS_SOLVER_VERSION, CLACKERS_SOLVER_STEP, "newmark-c", prepare, run, free};

const clackers_solver* clackers_plugin(void) { return &solver; }
