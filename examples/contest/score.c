/* The score of an exported policy in the double-pendulum contest (RealAIGym, simulation v2): 10 s from hanging, integrated by
 * Runge-Kutta with 0.002 s, the policy asked at every step. JOINT: 1 the pendubot, 2 the acrobot. */
#include <math.h>
#include <stdio.h>

#include "policy.h"

enum { STEPS = 5000 };
static const double dt = 0.002, pi = 3.14159265358979323846;

/* Derivatives of the state (q1, q2, dq1, dq2). */
static void change(const double x[4], double torque, double dx[4]) {
  const double m1 = 0.5234602302310271, m2 = 0.6255677234174437, l1 = 0.2, r1 = 0.2, r2 = 0.25569305436052964;
  const double I1 = 0.031887199591513114, I2 = 0.05086984812807257, g = 9.81;
  const double couple = m2 * l1 * r2 * cos(x[1]), swing = m2 * l1 * r2 * sin(x[1]);
  const double a11 = I1 + I2 + m2 * l1 * l1 + 2 * couple, a12 = I2 + couple, a22 = I2;
  const double fall2 = m2 * r2 * g * sin(x[0] + x[1]);
  const double push1 = (JOINT == 1 ? torque : 0) + swing * x[3] * (2 * x[2] + x[3]) -
                       (m1 * r1 + m2 * l1) * g * sin(x[0]) - fall2;
  const double push2 = (JOINT == 2 ? torque : 0) - swing * x[2] * x[2] - fall2;
  const double determinant = a11 * a22 - a12 * a12;
  dx[0] = x[2];
  dx[1] = x[3];
  dx[2] = (a22 * push1 - a12 * push2) / determinant;
  dx[3] = (a11 * push2 - a12 * push1) / determinant;
}

static void step(double x[4], double torque) {
  const double part[3] = {dt / 2, dt / 2, dt};
  double k[4][4], y[4];
  change(x, torque, k[0]);
  for (int s = 0; s < 3; ++s) {
    for (int i = 0; i < 4; ++i) y[i] = x[i] + part[s] * k[s][i];
    change(y, torque, k[s + 1]);
  }
  for (int i = 0; i < 4; ++i) x[i] += dt / 6 * (k[0][i] + 2 * k[1][i] + 2 * k[2][i] + k[3][i]);
}

int main(void) {
  double x[4] = {0, 0, 0, 0}, before = 0, energy = 0, torque2 = 0, speed2 = 0, jump = 0, jump2 = 0;
  int last_below = -1, outside = 0;
  for (int t = 0; t < STEPS; ++t) {
    double torque[1];
    if (policy_act(x, t * dt, torque) != 1 || !(fabs(torque[0]) <= 6)) ++outside;
    const double q = x[JOINT - 1];
    speed2 += (x[2] * x[2] + x[3] * x[3]) * dt;
    torque2 += torque[0] * torque[0] * dt;
    step(x, torque[0]);
    energy += fabs((x[JOINT - 1] - q) * torque[0]);
    if (t > 0) {
      jump += torque[0] - before;
      jump2 += (torque[0] - before) * (torque[0] - before);
    }
    before = torque[0];
    if (!(-0.2 * cos(x[0]) - 0.3 * cos(x[0] + x[1]) > 0.45)) last_below = t;
  }
  const int solved = last_below < STEPS - 1;
  const double n = STEPS - 1, smooth = sqrt(fmax(jump2 / n - jump / n * (jump / n), 0)), up_s = (last_below + 2) * dt;
  const double costs[5] = {up_s / 20, energy / 60, torque2 / 20, smooth / 0.1, speed2 / 400};
  double sum = 0;
  for (int i = 0; i < 5; ++i) sum += tanh(pi * costs[i]) / 5;
  printf("score %.4f  solved %d, up after %.3f s, energy %.2f J, torque %.2f N2 m2 s, smoothness %.4f N m, speed %.1f rad2/s\n",
         solved ? 1 - sum : 0, solved, up_s, energy, torque2, smooth, speed2);
  if (outside > 0) printf("%d torques are outside their bounds or not finite\n", outside);
  return outside > 0;
}
