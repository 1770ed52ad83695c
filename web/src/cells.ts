// Many points in a plane as coloured cells, each in the colour of the best point in it.
import * as Plot from '@observablehq/plot'
import type { Scale } from './colours'
import { s } from './dom'
import { linearTick } from './ticks'

export interface Axis {
  label: string
  domain: [number, number]
  cells: number
}

export interface Cell {
  column: number
  row: number
  /** The highest value of the points in it. */
  best: number
  count: number
}

/** A place in the plane that stands out: a disc with a number. */
export interface Spot {
  x: number
  y: number
  label: string
  value: number
  /** Has a second ring. */
  again: boolean
  tip: string
}

export interface CellsOptions {
  width: number
  x: Axis
  /** Null: the chart is a strip. */
  y: Axis | null
  cells: Cell[]
  spots: Spot[]
  scale: Scale
  tip: (cell: Cell) => string
}

const RADIUS = 8
/** Colours of outlines, visible together on every colour of the scale, on light pages and dark ones. */
const [LIGHT, DARK] = ['#ffffff', '#1b1f24']
const STRIP = 60
const MARGIN = { left: 48, right: 14, top: 26, bottom: 40 }

/** The cells that have points, which are given by their coordinates; points beyond the axes count as on their ends. */
export function cellsOf(x: Axis, y: Axis | null, xs: number[], ys: number[], values: number[]): Cell[] {
  const found = new Map<number, Cell>()
  values.forEach((value, i) => {
    const column = cellAt(x, xs[i] ?? 0)
    const row = y ? cellAt(y, ys[i] ?? 0) : 0
    const key = row * x.cells + column
    const cell = found.get(key)
    if (!cell) found.set(key, { column, row, best: value, count: 1 })
    else {
      cell.best = Math.max(cell.best, value)
      ++cell.count
    }
  })
  return [...found.values()]
}

function cellAt({ domain: [low, high], cells }: Axis, value: number): number {
  return Math.min(cells - 1, Math.max(0, Math.floor(((value - low) / (high - low)) * cells)))
}

/** A place within a cell. part: 0 is its lower end, 1 its upper. */
function placeIn({ domain: [low, high], cells }: Axis, cell: number, part: number): number {
  return low + ((cell + part) / cells) * (high - low)
}

export function cellChart({ width, x, y, cells, spots, scale, tip }: CellsOptions): SVGSVGElement {
  const across = width - MARGIN.left - MARGIN.right
  const up = y ? across : STRIP
  const upright = y ?? { label: '', domain: [0, 1] as [number, number], cells: 1 }
  const toX = along(x, MARGIN.left, MARGIN.left + across)
  const toY = along(upright, MARGIN.top + up, MARGIN.top)
  const places = spots.map((spot) => ({ x: toX.pixel(spot.x), y: toY.pixel(y ? spot.y : 0.5) }))
  const discs = apart(places, spots, { x: [MARGIN.left, MARGIN.left + across], y: [MARGIN.top, MARGIN.top + up] })
  const tips = [
    ...cells.map((cell) => ({ x: placeIn(x, cell.column, 0.5), y: placeIn(upright, cell.row, 0.5), text: tip(cell) })),
    ...discs.map((disc, i) => ({ x: toX.value(disc.x), y: toY.value(disc.y), text: spots[i]?.tip })),
  ]
  return Plot.plot({
    width,
    height: up + MARGIN.top + MARGIN.bottom,
    marginLeft: MARGIN.left,
    marginRight: MARGIN.right,
    marginTop: MARGIN.top,
    marginBottom: MARGIN.bottom,
    style: { fontSize: '12px', background: 'none', overflow: 'visible' },
    x: { ...axis(x, across), labelAnchor: 'center' },
    y: { ...axis(upright, across), labelAnchor: 'top', ...(y ? {} : { axis: null }) },
    marks: [
      () => cellMarks(cells, x, upright, toX, toY, scale),
      Plot.frame({ stroke: 'currentColor', strokeOpacity: 0.25 }),
      () => spotsMarks(spots, places, discs, scale),
      Plot.tip(
        tips,
        Plot.pointer({
          x: 'x',
          y: 'y',
          title: 'text',
          fill: 'var(--surface)',
          stroke: 'var(--muted)',
          fontSize: 12,
          maxRadius: 16,
        }),
      ),
    ],
  }) as SVGSVGElement
}

/** A mapping from values to pixels and back. */
interface Along {
  pixel: (value: number) => number
  value: (pixel: number) => number
}

function along({ domain: [low, high] }: Axis, from: number, to: number): Along {
  return {
    pixel: (value) => from + ((value - low) / (high - low)) * (to - from),
    value: (pixel) => low + ((pixel - from) / (to - from)) * (high - low),
  }
}

function axis({ label, domain }: Axis, length: number): Plot.ScaleOptions {
  const ticks = Math.max(3, Math.floor(length / 60))
  return { type: 'linear', label, domain, ticks, tickFormat: linearTick(domain), labelArrow: 'none' }
}

/** One path a colour, so that a page of many panels stays light. */
function cellMarks(cells: Cell[], x: Axis, y: Axis, toX: Along, toY: Along, scale: Scale): SVGElement {
  const paths = new Map<string, string>()
  for (const { column, row, best } of cells) {
    const [left, right] = [0, 1].map((part) => toX.pixel(placeIn(x, column, part)).toFixed(1))
    const [bottom, top] = [0, 1].map((part) => toY.pixel(placeIn(y, row, part)).toFixed(1))
    const colour = scale.colour(best)
    paths.set(colour, `${paths.get(colour) ?? ''}M${left},${bottom}H${right}V${top}H${left}Z`)
  }
  return s(
    'g',
    { 'aria-label': 'cells', 'shape-rendering': 'crispEdges' },
    ...[...paths].map(([fill, d]) => s('path', { fill, d })),
  )
}

interface Place {
  x: number
  y: number
}

const ROUNDS = 200
const MOST_PUSHES = 1e6

/** Discs pushed off each other, so that every number can be read, no farther from their places than they must. */
function apart(places: Place[], spots: Spot[], frame: { x: [number, number]; y: [number, number] }): Place[] {
  const discs = places.map(({ x, y }, i) => ({ x, y: y + (i % 2) - 0.5 })) // or those in a line would stay in it
  const radius = (i: number) => RADIUS + (spots[i]?.again ? 6 : 2)
  const rounds = Math.min(ROUNDS, MOST_PUSHES / places.length ** 2)
  for (let round = 0; round < rounds; ++round) {
    discs.forEach((disc, i) => {
      disc.x += 0.02 * ((places[i] as Place).x - disc.x)
      disc.y += 0.02 * ((places[i] as Place).y - disc.y)
    })
    discs.forEach((a, i) =>
      discs.slice(i + 1).forEach((b, k) => {
        const wanted = radius(i) + radius(i + 1 + k)
        const distance = Math.hypot(b.x - a.x, b.y - a.y)
        if (distance >= wanted) return
        const angle = distance > 0 ? Math.atan2(b.y - a.y, b.x - a.x) : i
        const [dx, dy] = [Math.cos(angle), Math.sin(angle)].map((part) => (part * (wanted - distance)) / 2)
        a.x -= dx ?? 0
        a.y -= dy ?? 0
        b.x += dx ?? 0
        b.y += dy ?? 0
      }),
    )
    discs.forEach((disc) => {
      disc.x = Math.min(frame.x[1], Math.max(frame.x[0], disc.x))
      disc.y = Math.min(frame.y[1], Math.max(frame.y[0], disc.y))
    })
  }
  return discs
}

/** Discs, with lines to their places where they do not cover them. */
function spotsMarks(spots: Spot[], places: Place[], discs: Place[], scale: Scale): SVGElement {
  const lines = places.flatMap((place, i) => {
    const disc = discs[i] as Place
    if (Math.hypot(disc.x - place.x, disc.y - place.y) < RADIUS) return []
    const ends = { x1: place.x, y1: place.y, x2: disc.x, y2: disc.y, 'stroke-linecap': 'round' }
    return [
      s('line', { ...ends, stroke: DARK, 'stroke-width': 3.5 }),
      s('line', { ...ends, stroke: LIGHT, 'stroke-width': 1.5 }),
    ]
  })
  return s(
    'g',
    { 'aria-label': 'trials' },
    ...lines,
    ...spots.map((spot, i) => spotMarks(spot, discs[i] as Place, scale)),
  )
}

function spotMarks({ label, value, again }: Spot, { x, y }: Place, scale: Scale): SVGElement {
  const ring = (r: number, stroke: string, width: number, fill = 'none') =>
    s('circle', { r, fill, stroke, 'stroke-width': width })
  return s(
    'g',
    { transform: `translate(${x.toFixed(1)}, ${y.toFixed(1)})` },
    ...(again ? [ring(RADIUS + 3.5, LIGHT, 3.5), ring(RADIUS + 3.5, DARK, 1.5)] : []),
    ring(RADIUS, DARK, 3.5),
    ring(RADIUS, LIGHT, 1.5, scale.colour(value)),
    s(
      'text',
      { 'text-anchor': 'middle', dy: '0.34em', 'font-size': 10.5, 'font-weight': 700, fill: scale.inkOn(value) },
      label,
    ),
  )
}
