/* Robustness of an exported policy as in the contest's robustness v2: the share of successes where one thing at a time is not as
 * in the model, and the mean of the six shares. A success ends within 0.35, 0.35 rad, 1, 1 rad/s of upright after 10 s.
 *
 * model: ten parameters, 21 values each. noise of measured speeds, and of the torque: 21 sizes each, a success if more than half of
 * 10 episodes are. response: the torque moves by that fraction of what is missing at every step. delay: of the measured state.
 * perturbation: 50 episodes with three bell-shaped torques on each joint, at least 1 s apart.
 */
#include <stdint.h>
#include <stdio.h>

#include "policy.h"
#include "robot.h"

enum { VALUES = 21, REPETITIONS = 10, PERTURBATIONS = 50, BELLS = 3, LONGEST_DELAY = 20 };

/* Differences from the model. */
struct world {
  struct robot robot;
  double speed_noise, torque_noise, response;
  int delay; /* steps */
  double at[2][BELLS], width[2][BELLS], height[2][BELLS]; /* s, s, N m */
};

static uint64_t state = 1;

static double uniform(double low, double high) { /* xorshift64* (Vigna 2016) */
  state ^= state >> 12;
  state ^= state << 25;
  state ^= state >> 27;
  return low + (high - low) * (double)((state * 2685821657736338717u) >> 11) / 9007199254740992.0;
}

static double normal(void) { return sqrt(-2 * log(1 - uniform(0, 1))) * cos(2 * pi * uniform(0, 1)); }

static struct world as_modelled(void) {
  struct world world = {.robot = model(), .response = 1};
  return world;
}

static double away(double angle) { return fabs(remainder(angle, 2 * pi)); }

static int succeeds(const struct world* world) {
  double seen[LONGEST_DELAY + 1][4] = {{0}}, x[4] = {0, 0, 0, 0}, torque = 0;
  for (int t = 0; t < STEPS; ++t) {
    for (int i = 0; i < 4; ++i) seen[t % (LONGEST_DELAY + 1)][i] = x[i];
    const int then = t < world->delay ? 0 : t - world->delay;
    double measured[4], u[1], pushes[2] = {0, 0};
    for (int i = 0; i < 4; ++i)
      measured[i] = seen[then % (LONGEST_DELAY + 1)][i] + (i < 2 ? 0 : world->speed_noise * normal());
    policy_act(measured, t * dt, u);
    torque += world->response * (u[0] + world->torque_noise * normal() - torque);
    pushes[JOINT - 1] = fmin(fmax(torque, -torque_limit), torque_limit);
    for (int joint = 0; joint < 2; ++joint)
      for (int b = 0; b < BELLS; ++b) {
        const double from = (t * dt - world->at[joint][b]) / (world->width[joint][b] + 1e-9);
        pushes[joint] += world->height[joint][b] * exp(-0.5 * from * from);
      }
    step(&world->robot, x, pushes);
  }
  return away(x[0] - pi) < 0.35 && away(x[1]) < 0.35 && fabs(x[2]) < 1 && fabs(x[3]) < 1;
}

static int mostly_succeeds(const struct world* world) {
  int successes = 0;
  for (int i = 0; i < REPETITIONS; ++i) successes += succeeds(world);
  return 2 * successes > REPETITIONS;
}

static double between(double low, double high, int value) { return low + (high - low) * value / (VALUES - 1); }

static double of_model(void) {
  int successes = 0;
  for (int parameter = 0; parameter < 10; ++parameter)
    for (int v = 0; v < VALUES; ++v) {
      struct world world = as_modelled();
      struct robot* r = &world.robot;
      double* const scaled[5] = {&r->m1r1, &r->I1, &r->m2r2, &r->m2, &r->I2};
      double* const added[5] = {&r->b[0], &r->b[1], &r->cf[0], &r->cf[1], &r->Ir};
      if (parameter < 5)
        *scaled[parameter] *= between(0.75, 1.25, v);
      else if (parameter < 9)
        *added[parameter - 5] = parameter < 7 ? between(-0.1, 0.1, v) : between(-0.2, 0.2, v);
      else
        r->Ir = between(0, 1e-4, v);
      successes += succeeds(&world);
    }
  return successes / (10.0 * VALUES);
}

/* kind: 0 noise of speeds, 1 noise of the torque, 2 response, 3 delay. */
static double of_size(int kind) {
  int successes = 0;
  for (int v = 0; v < VALUES; ++v) {
    struct world world = as_modelled();
    if (kind == 0) world.speed_noise = between(0, 0.5, v);
    if (kind == 1) world.torque_noise = between(0, 1.1, v);
    if (kind == 2) world.response = between(0.1, 2, v);
    if (kind == 3) world.delay = v; /* 0 to 40 ms */
    successes += kind < 2 ? mostly_succeeds(&world) : succeeds(&world);
  }
  return successes / (double)VALUES;
}

static double of_perturbations(void) {
  int successes = 0;
  for (int i = 0; i < PERTURBATIONS; ++i) {
    struct world world = as_modelled();
    for (int joint = 0; joint < 2; ++joint) {
      double room[BELLS], sum = 0;
      for (int b = 0; b < BELLS; ++b) sum += room[b] = uniform(0, 1);
      sum += uniform(0, 1);
      for (int b = 0; b < BELLS; ++b) {
        world.at[joint][b] = (b > 0 ? world.at[joint][b - 1] + 1 : 0) + room[b] / sum * (STEPS * dt - (BELLS - 1));
        world.width[joint][b] = uniform(0.05, 0.1);
        world.height[joint][b] = uniform(0.5, 5) * (uniform(0, 1) < 0.5 ? -1 : 1);
      }
    }
    successes += succeeds(&world);
  }
  return successes / (double)PERTURBATIONS;
}

int main(void) {
  const double model = of_model(), speed = of_size(0), torque = of_size(1), response = of_size(2), delay = of_size(3);
  const double perturbation = of_perturbations();
  printf("robustness %.3f  model %.3f, speed noise %.3f, torque noise %.3f, response %.3f, delay %.3f, perturbations %.3f\n",
         (model + speed + torque + response + delay + perturbation) / 6, model, speed, torque, response, delay, perturbation);
  return 0;
}
