// Charts of a robot that walks: when its feet are on the floor, and its way seen from above.
import * as Plot from '@observablehq/plot'
import { addCursor } from './chart'
import { PREDICTED, REAL } from './colours'
import { isSolid, present, type Cell, type Episode, type Motion, type SolidMotion } from './data'
import type { Row } from './export'
import { largest, least } from './extent'
import type { Panel } from './panels'
import { NUMBERS } from './solids'
import { tick } from './ticks'

/** A foot and its number among the bodies. */
interface Foot {
  name: string
  body: number
  radius: number
}

/** A foot is on the floor from one time to another. */
interface Stance {
  foot: string
  from: number
  to: number
}

type Frames = SolidMotion['frames'] | null | undefined

export function walks(motion: Motion): motion is SolidMotion {
  return isSolid(motion) && present(motion.floor) && feetOf(motion).length > 0
}

/** step: seconds from a frame to the next. */
export function walkPanels({ motion }: Episode, step: number): Panel[] {
  if (!motion || !walks(motion)) return []
  return [
    { title: 'Feet on the floor', draw: (width) => gait(motion, step, width) },
    { title: 'The way from above', draw: (width) => way(motion, width) },
  ]
}

export function walkTable({ motion }: Episode, step: number): Row[] {
  if (!motion || !walks(motion)) return []
  const feet = feetOf(motion)
  const columns = (frames: Frames, t: number, prefix: string): Row => ({
    ...Object.fromEntries(feet.map((foot) => [prefix + foot.name, standing(motion, frames, t, foot)])),
    [`${prefix}x [${motion.unit}]`]: frames?.[t]?.[0] ?? null,
    [`${prefix}y [${motion.unit}]`]: frames?.[t]?.[1] ?? null,
  })
  return motion.frames.map((_, t) => ({
    'time [s]': t * step,
    ...columns(motion.frames, t, ''),
    ...columns(motion.predicted, t, 'predicted '),
  }))
}

function feetOf({ bodies }: SolidMotion): Foot[] {
  return bodies.flatMap((body, i) =>
    body.foot && body.shape === 'sphere' ? [{ name: body.name, body: i, radius: body.radius }] : [],
  )
}

/** 1 on the floor, 0 above it, null where that is not known. */
function standing({ floor, touching = 0 }: SolidMotion, frames: Frames, t: number, foot: Foot): Cell {
  const height = frames?.[t]?.[foot.body * NUMBERS + 2]
  return present(height) ? Number(height - foot.radius - (floor ?? 0) < touching) : null
}

/** The stances of all feet; a contact in a frame holds until the next. */
function stances(motion: SolidMotion, frames: Frames, step: number): Stance[] {
  const all: Stance[] = []
  for (const foot of feetOf(motion))
    for (let t = 0; t + 1 < (frames?.length ?? 0); ++t) {
      if (standing(motion, frames, t, foot) !== 1) continue
      const last = all.at(-1)
      const goesOn = last?.foot === foot.name && last.to === t * step
      if (goesOn) last.to = (t + 1) * step
      else all.push({ foot: foot.name, from: t * step, to: (t + 1) * step })
    }
  return all
}

function gait(motion: SolidMotion, step: number, width: number): SVGSVGElement {
  const names = feetOf(motion).map(({ name }) => name)
  const height = 60 + 34 * names.length
  const band = (height - 50) / names.length
  const bars = (frames: Frames, fill: string, insetTop: number, insetBottom: number) =>
    Plot.barX(stances(motion, frames, step), { x1: 'from', x2: 'to', y: 'foot', fill, insetTop, insetBottom })
  const plot = Plot.plot({
    width,
    height,
    marginLeft: 118,
    marginRight: 16,
    marginTop: 10,
    marginBottom: 40,
    style: { fontSize: '12px', background: 'none', overflow: 'visible' },
    x: {
      label: 'time (s)',
      labelAnchor: 'center',
      labelArrow: 'none',
      domain: [0, (motion.frames.length - 1) * step],
      ticks: Math.max(3, Math.floor(width / 80)),
      tickFormat: tick,
    },
    y: { label: null, domain: names, padding: 0.2 },
    marks: [
      bars(motion.frames, REAL, 0, 0.42 * band),
      bars(motion.predicted, PREDICTED, 0.42 * band, 0),
      Plot.ruleX([0], { stroke: 'currentColor', strokeOpacity: 0.4 }),
    ],
  }) as SVGSVGElement & Plot.Plot
  addCursor(plot)
  return plot
}

function way(motion: SolidMotion, width: number): SVGSVGElement {
  const points = (frames: Frames) => (frames ?? []).flatMap(([x, y]) => (present(x) && present(y) ? [{ x, y }] : []))
  const [real, predicted] = [points(motion.frames), points(motion.predicted)]
  const all = [...real, ...predicted]
  const middle = (key: 'x' | 'y') => (least(all.map((p) => p[key])) + largest(all.map((p) => p[key]))) / 2
  const reach = (key: 'x' | 'y') => {
    const center = middle(key)
    return Math.max(largest(all.map((p) => Math.abs(p[key] - center))), 0.1) * 1.1
  }
  const scale = Math.max(reach('x') / (width - 72), reach('y') / 250) // half of a pixel, the same along both
  const height = Math.max(120, reach('y') / scale)
  const domain = (key: 'x' | 'y', pixels: number): [number, number] => [
    middle(key) - scale * pixels,
    middle(key) + scale * pixels,
  ]
  const line = (data: typeof real, stroke: string, strokeDasharray?: string) => [
    Plot.line(data, { x: 'x', y: 'y', stroke, strokeWidth: 2, ...(strokeDasharray ? { strokeDasharray } : {}) }),
    Plot.dot(data.slice(-1), { x: 'x', y: 'y', fill: stroke, r: 4 }),
  ]
  const axis = { labelAnchor: 'center' as const, labelArrow: 'none' as const, grid: true, tickFormat: tick }
  return Plot.plot({
    width,
    height: height + 50,
    marginLeft: 56,
    marginRight: 16,
    marginTop: 10,
    marginBottom: 40,
    style: { fontSize: '12px', background: 'none', overflow: 'visible' },
    x: { ...axis, label: `x (${motion.unit})`, domain: domain('x', width - 72), ticks: Math.floor(width / 80) },
    y: { ...axis, label: `y (${motion.unit})`, domain: domain('y', height), ticks: 4 },
    marks: [
      ...line(predicted, PREDICTED, '6 3'),
      ...line(real, REAL),
      Plot.dot(real.slice(0, 1), { x: 'x', y: 'y', stroke: 'currentColor', r: 4 }),
    ],
  }) as SVGSVGElement & Plot.Plot
}
