#include "clackers/decks/scripts/c_text.hpp"

namespace clackers::decks {

const char* const c_located = R"c(
// `h` where no gap is closed behind it, else the part of it, by bisection, that ends before one closes; the state
// there in `next`.
static double located(double t, double h, const double* y, double* next) {
  if (advance(t, h, y, next) >= 0.0) return h;
  double low = 0.0, high = h;
  for (int trial = 0; trial < 60; ++trial) {
    const double middle = 0.5 * (low + high);
    *(advance(t, middle, y, next) < 0.0 ? &high : &low) = middle;
  }
  advance(t, low, y, next);
  return low;
}
)c";

const char* const fmu_exact =
    R"c(// a row a flight: its start [s], u [m] and v [m/s] behind the impact; rate [1/s] bounds those of the motion
@numbers@
// Taylor's series, which is exact but for rounding: the motion is linear, its loads are harmonic.
static void flow(double t, double span, double* y) {
  const int parts = 1 + (int)(4.0 * rate * span);
  const double h = span / parts;
  for (int part = 0; part < parts; ++part) {
    double d[2 * n], next[2 * n], factor = 1.0;
    memcpy(d, y, sizeof d);
    for (int order = 0; order < 24; ++order) {
      rates(t + part * h, order, d, next);
      factor *= h / (order + 1);
      for (int i = 0; i < 2 * n; ++i) y[i] += factor * next[i];
      memcpy(d, next, sizeof d);
    }
  }
}

static int begin(double t, double* y) {
  if (!(t >= t0 && t <= last + 1e-9 * (last - t0))) return failed;  // what follows is not known
  const double* flight = flights + (flights_rows - 1) * (2 * n + 1);
  while (flight > flights && flight[0] > t) flight -= 2 * n + 1;
  memcpy(y, flight + 1, 2 * n * sizeof *y);
  flow(flight[0], t - flight[0], y);
  return ok;
}
static int go(double t, double end, double* y) { return begin(end, y); }
)c";

const char* const fmu_method =
    R"c(// the explicit Runge-Kutta method: its coefficients by rows, its weights as the last
@numbers@
enum { stages = method_rows - 1 };

// A step, in `next`; the smallest of the gaps behind it.
static double advance(double t, double h, const double* y, double* next) {
  double k[stages][2 * n], least = 1.0;
  for (int i = 0; i <= stages; ++i) {
    double share = 0.0;
    memcpy(next, y, 2 * n * sizeof *y);
    for (int j = 0; j < i; ++j) {
      const double weight = method[i * stages + j];
      share += weight;
      for (int l = 0; l < 2 * n; ++l) next[l] += h * weight * k[j][l];
    }
    if (i < stages) rates(t + share * h, 0, next, k[i]);
  }
  for (int k = 0; k < contacts_rows; ++k) {
    const double* contact = contacts + (n + 2) * k;
    least = fmin(least, dot(contact, next) - contact[n]);
  }
  return least;
}
@located@
static int begin(double t, double* y) {
  memcpy(y, u0, sizeof u0);
  memcpy(y + n, v0, sizeof v0);
  return t == t0 ? ok : failed;
}
// Impacts within the step end it there; the rest of it follows.
static int go(double t, double end, double* y) {
  for (int event = 0; event < 1000; ++event) {
    double next[2 * n];
    const double rest = end - t, passed = located(t, rest, y, next);
    memcpy(y, next, sizeof next);
    if (passed == rest) return ok;
    if (impacts(y, y + n, 1e-9) < 1) return failed;
    t += passed;
  }
  return failed;
}
)c";

}  // namespace clackers::decks
