/* The robot of the double-pendulum contest (RealAIGym): two links, state (q1, q2, dq1, dq2), q1 = 0 hanging, q2 relative to link 1,
 * integrated by Runge-Kutta with 0.002 s. JOINT: the one with the motor, 1 the pendubot, 2 the acrobot. */
#include <math.h>

enum { STEPS = 5000 }; /* 10 s */
static const double dt = 0.002, pi = 3.14159265358979323846, torque_limit = 6;

/* Links' lengths are 0.2 and 0.3 m, gear ratios 6. I: about the joints. */
struct robot {
  double m1r1, I1, m2r2, m2, I2;      /* kg m, kg m2, kg m, kg, kg m2 */
  double b[2], cf[2];                 /* viscous and Coulomb friction, N m s/rad and N m */
  double Ir;                          /* the motors' inertia, kg m2 */
};

/* Model 1.0 of design C.1, as in simulation v2. */
static struct robot model(void) {
  const double m1 = 0.5234602302310271, m2 = 0.6255677234174437;
  struct robot robot = {m1 * 0.2, 0.031887199591513114, m2 * 0.25569305436052964, m2, 0.05086984812807257, {0, 0}, {0, 0}, 0};
  return robot;
}

/* Derivatives of the state; torque: on both joints. */
static void change(const struct robot* r, const double x[4], const double torque[2], double dx[4]) {
  const double l1 = 0.2, g = 9.81, gear = 6;
  const double couple = r->m2r2 * l1 * cos(x[1]), swing = r->m2r2 * l1 * sin(x[1]);
  const double a11 = r->I1 + r->I2 + r->m2 * l1 * l1 + 2 * couple + (gear * gear + 1) * r->Ir;
  const double a12 = r->I2 + couple - gear * r->Ir, a22 = r->I2 + gear * gear * r->Ir;
  const double fall2 = r->m2r2 * g * sin(x[0] + x[1]);
  const double push1 = torque[0] + swing * x[3] * (2 * x[2] + x[3]) - (r->m1r1 + r->m2 * l1) * g * sin(x[0]) - fall2 -
                       r->b[0] * x[2] - r->cf[0] * atan(100 * x[2]);
  const double push2 = torque[1] - swing * x[2] * x[2] - fall2 - r->b[1] * x[3] - r->cf[1] * atan(100 * x[3]);
  const double determinant = a11 * a22 - a12 * a12;
  dx[0] = x[2];
  dx[1] = x[3];
  dx[2] = (a22 * push1 - a12 * push2) / determinant;
  dx[3] = (a11 * push2 - a12 * push1) / determinant;
}

static void step(const struct robot* robot, double x[4], const double torque[2]) {
  const double part[3] = {dt / 2, dt / 2, dt};
  double k[4][4], y[4];
  change(robot, x, torque, k[0]);
  for (int s = 0; s < 3; ++s) {
    for (int i = 0; i < 4; ++i) y[i] = x[i] + part[s] * k[s][i];
    change(robot, y, torque, k[s + 1]);
  }
  for (int i = 0; i < 4; ++i) x[i] += dt / 6 * (k[0][i] + 2 * k[1][i] + 2 * k[2][i] + k[3][i]);
}
