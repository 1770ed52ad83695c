// walker.mjs RUN TRIALS STEPS: makes the motions of the trials in a run folder those of a robot in space, a box that walks
// on two capsules with spheres for feet. The model had expected a slower one, and one that is lost in the end.
import { mkdirSync, writeFileSync } from 'node:fs'

const [run, trials, steps] = process.argv.slice(2)
const LEG = 0.3
const bodies = [
  { name: 'trunk', shape: 'box', size: [0.3, 0.2, 0.1] },
  ...['left', 'right'].flatMap((side) => [
    { name: `${side} leg`, shape: 'capsule', radius: 0.02, length: LEG },
    { name: `${side} foot`, shape: 'sphere', radius: 0.035, foot: true },
  ]),
]

/** Poses after t steps: the legs swing against each other about y, from hips at the sides of the trunk. */
function frame(t, speed) {
  const x = speed * t
  const hip = LEG + 0.035
  const leg = (y, angle) => {
    const down = (part) => [x - part * LEG * Math.sin(angle), y, hip - part * LEG * Math.cos(angle)]
    const turned = [Math.cos(angle / 2), 0, Math.sin(angle / 2), 0]
    return [...down(0.5), ...turned, ...down(1), ...turned]
  }
  const swing = 0.5 * Math.sin(0.4 * t)
  return [x, 0, hip + 0.05, 1, 0, 0, 0, ...leg(0.1, swing), ...leg(-0.1, -swing)]
}

function write(kind, trial, speed, known) {
  const frames = Array.from({ length: Number(steps) + 1 }, (_, t) =>
    frame(t, speed).map((number) => (t <= known ? number : null)),
  )
  const motion = { format: 1, dimensions: 3, unit: 'm', floor: 0, touching: 0.005, bodies, frames }
  writeFileSync(`${run}/motion/${kind}-${String(trial).padStart(3, '0')}.json`, JSON.stringify(motion))
}

mkdirSync(`${run}/motion`, { recursive: true })
for (let trial = 1; trial <= Number(trials); ++trial) {
  write('trial', trial, 0.03, Number(steps))
  write('prediction', trial, 0.022, Number(steps) - 5)
}
