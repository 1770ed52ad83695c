// The robot in a plane, drawn from the bodies in a motion.
import { isSolid, present, type LineMotion, type Motion } from './data'
import { REAL, PREDICTED } from './colours'
import { s } from './dom'

const MOST_MARKS = 500 // along the way: some robots go far

export interface Stage {
  element: Element
  /** Shows a motion of its own kind at a frame, which may lie between two. */
  show: (motion: Motion, frame: number) => void
}

interface Bounds {
  left: number
  right: number
  bottom: number
  top: number
}

/** One that has room for all these motions; where they go far along the ground, it follows the robot. */
export function stage(motions: LineMotion[]): Stage {
  const bounds = withScaleBar(boundsOf(motions))
  const height = bounds.top - bounds.bottom
  const width = Math.min(bounds.right - bounds.left, 1.6 * height)
  const size = Math.max(width, height)
  const element = s('svg', {
    class: 'stage',
    viewBox: `0 ${-bounds.top} ${width} ${height}`,
    role: 'img',
    'aria-label': 'The robot at the time of the slider',
  })
  const length = roundAbove(0.12 * size)
  const tick = Math.max(length, roundAbove((bounds.right - bounds.left) / MOST_MARKS))
  const goal = s('g', { class: 'goal' })
  const trail = s('polyline', { class: 'trail', stroke: REAL })
  const predicted = s('g', { opacity: 0.45 })
  const real = s('g')
  const world = s('g', {}, ground(bounds, size, tick), goal, trail, predicted, real)
  element.append(world, scaleBar(bounds, size, length, motions[0]?.unit ?? 'm'))

  return {
    element,
    show(motion, frame) {
      if (isSolid(motion)) return
      const now = frameAt(motion.frames, frame)
      world.setAttribute('transform', `translate(${-leftOf(bounds, width, motion.goal, now)}, 0)`)
      goal.replaceChildren(...goalMarks(motion.goal, size))
      predicted.replaceChildren(...bodies(motion, frameAt(motion.predicted, frame), PREDICTED))
      real.replaceChildren(...bodies(motion, now, REAL), ...joints(motion, now, size))
      trail.setAttribute('points', trailOf(motion, frame))
    },
  }
}

/** The next of 1, 2, 5, 10, 20, … and of 0.5, 0.2, … */
function roundAbove(least: number): number {
  const decade = 10 ** Math.floor(Math.log10(least || 1))
  return ([1, 2, 5].find((digit) => digit * decade > least) ?? 10) * decade
}

/** The left end of what is seen: the goal in the middle, unless the robot would leave. */
function leftOf(bounds: Bounds, width: number, goal: LineMotion['goal'], ends: number[] | null): number {
  const xs = (ends ?? []).filter((_, i) => i % 2 === 0)
  const home = (goal?.[0] ?? (bounds.left + bounds.right) / 2) - width / 2
  if (xs.length === 0) return home
  const inside = Math.min(Math.max(home, Math.max(...xs) - 0.85 * width), Math.min(...xs) - 0.15 * width)
  return Math.min(Math.max(inside, bounds.left), bounds.right - width)
}

/** The height zero, with marks that show how the robot moves along it. */
function ground(bounds: Bounds, size: number, tick: number): SVGElement {
  const marks: string[] = []
  for (let x = Math.ceil(bounds.left / tick) * tick; x <= bounds.right; x += tick) marks.push(`M${x},0v${0.015 * size}`)
  return s('path', { class: 'ground', d: `M${bounds.left},0H${bounds.right}${marks.join('')}` })
}

/** Between two frames bodies move in straight lines; none where a number is missing. */
function frameAt(frames: LineMotion['frames'] | null | undefined, frame: number): number[] | null {
  if (!frames || frames.length === 0) return null
  const before = frames[Math.min(Math.floor(frame), frames.length - 1)] ?? []
  const part = frame - Math.floor(frame)
  const after = part > 0 ? (frames[Math.min(Math.floor(frame) + 1, frames.length - 1)] ?? []) : before
  const numbers = before.map((value, i) => {
    const next = after[i]
    return present(value) && present(next) ? value + part * (next - value) : NaN
  })
  return numbers.every(Number.isFinite) ? numbers : null
}

function bodies(motion: LineMotion, ends: number[] | null, colour: string): SVGElement[] {
  if (!ends) return []
  return motion.bodies.map(({ name, width }, i) => {
    const [x1 = 0, y1 = 0, x2 = 0, y2 = 0] = ends.slice(4 * i, 4 * i + 4)
    return s(
      'line',
      { x1, y1: -y1, x2, y2: -y2, stroke: colour, 'stroke-width': width, 'stroke-linecap': 'round' },
      s('title', {}, name),
    )
  })
}

/** Circles where a body hangs on the one before it; for the first only if it never moves. */
function joints(motion: LineMotion, ends: number[] | null, size: number): SVGElement[] {
  if (!ends) return []
  const fixed = motion.frames.every((frame) => frame[0] === motion.frames[0]?.[0] && frame[1] === motion.frames[0]?.[1])
  return motion.bodies.flatMap((_, i) =>
    i === 0 && !fixed
      ? []
      : [s('circle', { class: 'joint', cx: ends[4 * i] ?? 0, cy: -(ends[4 * i + 1] ?? 0), r: 0.011 * size })],
  )
}

/** The way of the last body's far end in the last second or so. */
function trailOf(motion: LineMotion, frame: number): string {
  const points: string[] = []
  for (let at = Math.max(0, Math.floor(frame) - 20); at <= frame; ++at) {
    const ends = frameAt(motion.frames, at)
    if (ends) points.push(`${ends.at(-2)},${-(ends.at(-1) ?? 0)}`)
  }
  const now = frameAt(motion.frames, frame)
  if (now) points.push(`${now.at(-2)},${-(now.at(-1) ?? 0)}`)
  return points.join(' ')
}

function goalMarks(goal: LineMotion['goal'], size: number): SVGElement[] {
  if (!goal) return []
  const [x, y] = goal
  const r = 0.025 * size
  return [
    s('circle', { cx: x, cy: -y, r }),
    s('line', { x1: x - 1.6 * r, x2: x + 1.6 * r, y1: -y, y2: -y }),
    s('line', { x1: x, x2: x, y1: -y - 1.6 * r, y2: -y + 1.6 * r }),
  ]
}

/** Room for the scale bar below the robot, which may hang. */
function withScaleBar(bounds: Bounds): Bounds {
  const size = Math.max(bounds.top - bounds.bottom, bounds.right - bounds.left)
  return { ...bounds, bottom: bounds.bottom - 0.1 * size }
}

/** The distance of the marks on the ground, in a lower corner. */
function scaleBar(bounds: Bounds, size: number, length: number, unit: string): SVGElement {
  const x = 0.04 * size
  const y = -bounds.bottom - 0.04 * size
  return s(
    'g',
    { class: 'scale' },
    s('path', { d: `M${x},${y - 0.01 * size}V${y}H${x + length}V${y - 0.01 * size}` }),
    s(
      'text',
      { x: x + length / 2, y: y - 0.025 * size, 'font-size': 0.035 * size, 'text-anchor': 'middle' },
      `${length} ${unit}`,
    ),
  )
}

function boundsOf(motions: LineMotion[]): Bounds {
  const bounds: Bounds = { left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity }
  const include = (x: number, y: number, room: number) => {
    bounds.left = Math.min(bounds.left, x - room)
    bounds.right = Math.max(bounds.right, x + room)
    bounds.bottom = Math.min(bounds.bottom, y - room)
    bounds.top = Math.max(bounds.top, y + room)
  }
  for (const motion of motions) {
    if (motion.goal) include(...motion.goal, 0.1)
    for (const frame of motion.frames)
      for (let i = 0; i + 1 < frame.length; i += 2) {
        const [x, y] = [frame[i], frame[i + 1]]
        if (present(x) && present(y)) include(x, y, 0.15)
      }
  }
  return bounds.left < bounds.right ? bounds : { left: -1, right: 1, bottom: -1, top: 1 }
}
