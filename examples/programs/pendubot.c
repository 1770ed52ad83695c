/* The pendubot for `rehearse learn pendubot.toml`: two links, a motor at the shoulder. States dtheta1, dtheta2, theta1, theta2
 * (angles from upright), action torque, parameters m1, m2, l1, l2, b1, b2. The messages are those of docs/programs.md, numbers raw.
 * Build it:  cc -O2 -o pendubot pendubot.c -lm */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { STATES = 4, ACTIONS = 1, PARAMETERS = 6, STEPS = 10 };

static void rate(const double *x, double torque, const double *p, double *dxdt) {
  const double m1 = p[0], m2 = p[1], l1 = p[2], l2 = p[3], g = 9.82;
  const double c = cos(x[2] - x[3]), s = sin(x[2] - x[3]);
  const double a11 = l1 * l1 * (m1 / 3 + m2), a12 = m2 * l1 * l2 * c / 2, a22 = m2 * l2 * l2 / 3;
  const double f1 = g * l1 * sin(x[2]) * (m1 / 2 + m2) - m2 * l1 * l2 * x[1] * x[1] * s / 2 + torque - p[4] * x[0];
  const double f2 = m2 * l2 / 2 * (l1 * x[0] * x[0] * s + g * sin(x[3])) - p[5] * x[1];
  const double determinant = a11 * a22 - a12 * a12;
  dxdt[0] = (a22 * f1 - a12 * f2) / determinant, dxdt[1] = (a11 * f2 - a12 * f1) / determinant;
  dxdt[2] = x[0], dxdt[3] = x[1];
}

static void step(double *x, double torque, const double *p, double h) { /* Runge and Kutta, fourth order */
  double k[4][STATES], y[STATES];
  for (int stage = 0; stage < 4; ++stage) {
    for (int i = 0; i < STATES; ++i) y[i] = x[i] + (stage ? k[stage - 1][i] * (stage == 3 ? h : h / 2) : 0);
    rate(y, torque, p, k[stage]);
  }
  for (int i = 0; i < STATES; ++i) x[i] += h / 6 * (k[0][i] + 2 * k[1][i] + 2 * k[2][i] + k[3][i]);
}

int main(void) {
  char hello[4096];
  int64_t n;
  if (!fgets(hello, sizeof hello, stdin)) return 1;
  puts("{\"rehearse\":1,\"encoding\":\"doubles\",\"parameters\":[\"m1\",\"m2\",\"l1\",\"l2\",\"b1\",\"b2\"]}");
  fflush(stdout);
  while (fread(&n, sizeof n, 1, stdin) == 1) {
    double p[PARAMETERS], *numbers = malloc((STATES + ACTIONS) * (size_t)n * sizeof *numbers);
    if (!numbers || fread(p, sizeof p, 1, stdin) != 1) return 1;
    if (fread(numbers, sizeof *numbers, (STATES + ACTIONS) * (size_t)n, stdin) != (STATES + ACTIONS) * (size_t)n) return 1;
    for (int64_t row = 0; row < n; ++row) {
      double x[STATES];
      for (int i = 0; i < STATES; ++i) x[i] = numbers[i * n + row];
      for (int s = 0; s < STEPS; ++s) step(x, numbers[STATES * n + row], p, 0.05 / STEPS);
      for (int i = 0; i < STATES; ++i) numbers[i * n + row] = x[i] - numbers[i * n + row];
    }
    fwrite(&n, sizeof n, 1, stdout);
    fwrite(numbers, sizeof *numbers, STATES * (size_t)n, stdout);
    fflush(stdout);
    free(numbers);
  }
  return 0;
}
