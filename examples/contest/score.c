/* The score of an exported policy in the contest's simulation v2: 10 s from hanging, the policy asked at every step of 0.002 s. */
#include <stdio.h>

#include "policy.h"
#include "robot.h"

int main(void) {
  const struct robot robot = model();
  double x[4] = {0, 0, 0, 0}, before = 0, energy = 0, torque2 = 0, speed2 = 0, jump = 0, jump2 = 0;
  int last_below = -1, outside = 0;
  for (int t = 0; t < STEPS; ++t) {
    double u[1], torque[2] = {0, 0};
    if (policy_act(x, t * dt, u) != 1 || !(fabs(u[0]) <= torque_limit)) ++outside;
    const double q = x[JOINT - 1];
    speed2 += (x[2] * x[2] + x[3] * x[3]) * dt;
    torque2 += u[0] * u[0] * dt;
    torque[JOINT - 1] = u[0];
    step(&robot, x, torque);
    energy += fabs((x[JOINT - 1] - q) * u[0]);
    if (t > 0) {
      jump += u[0] - before;
      jump2 += (u[0] - before) * (u[0] - before);
    }
    before = u[0];
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
