// A pendulum with a motor that answers late, for `rehearse learn pendulum.toml`: the messages are those of docs/programs.md.
const lines = require("node:readline").createInterface({ input: process.stdin });
const answer = (object) => process.stdout.write(JSON.stringify(object) + "\n");

const [m, l, b, gravity, inner] = [1, 1, 0.01, 9.82, 0.001]; // kg, m, N m s/rad, m/s², s
let dt, lag, dtheta, theta, torque; // torque: what the motor gives by now

function step(wanted) {
  for (let i = 0; i < Math.round(dt / inner); ++i) {
    torque += (inner * (wanted - torque)) / lag;
    dtheta += (inner * (torque - b * dtheta - ((m * gravity * l) / 2) * Math.sin(theta))) / ((m * l * l) / 3);
    theta += inner * dtheta;
  }
}

lines.on("line", (line) => {
  const message = JSON.parse(line);
  if (message.rehearse) {
    dt = message.dt_s;
    answer({ rehearse: 1, states: ["dtheta", "theta"], messages: ["reset", "step"] });
  } else if (message.reset) {
    [[dtheta, theta], [lag], torque] = [message.reset.state, message.reset.parameters, 0];
    answer({ state: [dtheta, theta] });
  } else if (message.step) {
    step(message.step.action[0]);
    answer({ state: [dtheta, theta] });
  } else {
    answer({ error: "unknown message" });
  }
});
