// Lines with bands over a number, which is what nearly every figure here is.
import * as Plot from '@observablehq/plot'
import { INTERVAL_OPACITY, RULE, type Symbol } from './colours'
import { present } from './data'
import { largest, least } from './extent'
import { number, percent } from './format'
import { linearTick, logTick, logTicks, tick, tickRoom, wholeTicks } from './ticks'

export interface Point {
  x: number
  y: number
  /** Filled lightly, or outlined. */
  band?: [number, number]
  /** Inside it, filled more. */
  core?: [number, number]
  /** Drawn as a vertical bar. */
  interval?: [number, number]
  /** The text shown when a reader points at it, instead of its numbers. */
  tip?: string
  /** A line under its numbers there. */
  note?: string
  hollow?: boolean
}

export interface Series {
  label: string
  colour: string
  points: Point[]
  symbol?: Symbol
  dash?: string
  width?: number
  opacity?: number
  /** The radius of a symbol, in px. */
  radius?: number
  line?: boolean
  /** Each value holds until the next. */
  held?: boolean
  /** The band is its edges. */
  outline?: boolean
}

export interface ChartOptions {
  width: number
  height?: number
  x: { label: string; domain?: [number, number]; whole?: boolean; log?: boolean }
  y: { label: string; domain?: [number, number]; whole?: boolean; log?: boolean; percent?: boolean }
  series: Series[]
  /** A dashed horizontal line, at y; the legend says what it is. */
  rule?: number | null
  /** A vertical line that `moveCursor` moves. */
  cursor?: boolean
}

type Drawn = SVGSVGElement & { cursor?: { line: SVGLineElement; x: (value: number) => number } }

export function chart(options: ChartOptions): SVGSVGElement {
  const { width, x, y, series, rule } = options
  const points = series.flatMap((one) => one.points.map((point) => ({ ...point, label: one.label })))
  const xs = points.map((point) => point.x)
  const ys = y.domain ?? series.flatMap(heights)
  const levels = y.log ? logTicks(ys) : undefined
  const plot = Plot.plot({
    width,
    height: options.height ?? 240,
    marginLeft: y.log || y.percent ? 56 : tickRoom(ys),
    marginRight: 16,
    marginTop: y.label ? 24 : 10,
    marginBottom: 40,
    insetLeft: 8,
    insetRight: 8,
    style: { fontSize: '12px', background: 'none', overflow: 'visible' },
    x: {
      ...axis(x, width / 70),
      labelAnchor: 'center',
      labelArrow: 'none',
      tickFormat: linearTick(x.domain ?? xs),
      ...(x.whole ? { ticks: wholeTicks(x.domain ?? xs, width / 45), tickFormat: tick } : {}),
      ...(x.log ? { ticks: [...new Set(xs)], tickFormat: tick } : {}),
    },
    y: {
      ...axis(y, 5),
      labelAnchor: 'top',
      labelArrow: 'none',
      grid: true,
      ...(y.whole ? { ticks: wholeTicks(ys, 8) } : levels ? { ticks: levels } : {}),
      tickFormat: y.percent ? percent : y.log ? logTick : linearTick(ys),
    },
    marks: [
      ...series.flatMap((one) => bands(one, bandStrength(series))),
      present(rule)
        ? Plot.ruleY([rule], { stroke: RULE.colour, strokeDasharray: RULE.dash, strokeOpacity: 0.7 })
        : null,
      ...series.flatMap(lines),
      Plot.tip(
        points,
        Plot.pointer({
          x: 'x',
          y: 'y',
          title: (p: Point & { label: string }) =>
            [p.label, p.tip ?? `${x.label} ${number(p.x)}\n${number(p.y)}`, p.note ?? []].flat().join('\n'),
          fill: 'var(--surface)',
          stroke: 'var(--muted)',
          fontSize: 12,
          maxRadius: 30,
        }),
      ),
    ],
  }) as Drawn & Plot.Plot
  if (options.cursor) addCursor(plot)
  return plot
}

/** Puts the cursor of a chart that has one at x. */
export function moveCursor(svg: SVGSVGElement, x: number) {
  const cursor = (svg as Drawn).cursor
  if (!cursor) return
  const at = String(cursor.x(x))
  cursor.line.setAttribute('x1', at)
  cursor.line.setAttribute('x2', at)
}

export interface Domain {
  domain?: [number, number]
}

/**
 * The interval that holds all of these, a little wider. zero: zero, too. span: at least so wide, relative to the largest,
 * so that what is small looks small.
 */
export function fit(values: number[], { zero = false, span = 0 } = {}): Domain {
  const finite = values.filter(Number.isFinite)
  if (finite.length === 0) return {}
  const low = Math.min(least(finite), zero ? 0 : Infinity)
  const high = Math.max(largest(finite), zero ? 0 : -Infinity)
  const size = Math.max(Math.abs(low), Math.abs(high))
  const room = Math.max(0.04 * (high - low), (span * size - (high - low)) / 2) || 0.1 * size || 1
  return { domain: [zero && low === 0 ? 0 : low - room, high + room] }
}

/** The vertical positions that a series draws. */
export function heights({ points }: { points: Point[] }): number[] {
  return points.flatMap(({ y, band, interval }) => [y, ...(band ?? []), ...(interval ?? [])])
}

function axis(of: ChartOptions['x'] | ChartOptions['y'], ticks: number): Plot.ScaleOptions {
  return {
    label: of.label,
    ticks: Math.max(3, Math.floor(ticks)),
    ...(of.log ? { type: 'log' as const } : { type: 'linear' as const }),
    ...(of.domain ? { domain: of.domain } : { nice: !of.log }),
  }
}

/** Many bands over each other are lighter, so that what lies behind them is seen. */
export function bandStrength(series: Series[]): number {
  return Math.min(1, 4 / series.filter(({ points }) => points.some(({ band }) => band)).length)
}

function bands({ colour, points, outline }: Series, strength: number): Plot.Markish[] {
  if (outline) {
    const some = points.filter((point) => point.band)
    const edge = (side: 0 | 1) =>
      Plot.lineY(some, { x: 'x', y: (p: Point) => p.band?.[side], stroke: colour, strokeWidth: 1.25, clip: true })
    return [edge(0), edge(1)]
  }
  const area = (side: 'band' | 'core', fillOpacity: number) => {
    const some = points.filter((point) => point[side])
    if (some.length === 0) return null
    return Plot.areaY(some, {
      x: 'x',
      y1: (p: Point) => p[side]?.[0],
      y2: (p: Point) => p[side]?.[1],
      fill: colour,
      fillOpacity,
      clip: true,
    })
  }
  return [area('band', 0.16 * strength), area('core', 0.24 * strength)]
}

function lines({
  colour,
  points,
  symbol,
  dash,
  width = 2,
  opacity = 1,
  radius = 3.5,
  line = true,
  held = false,
}: Series): Plot.Markish[] {
  const some = points.filter((point) => point.interval)
  const drawn = { x: 'x', y: 'y', stroke: colour, strokeOpacity: opacity }
  return [
    some.length > 0
      ? Plot.ruleX(some, {
          x: 'x',
          y1: (p: Point) => p.interval?.[0],
          y2: (p: Point) => p.interval?.[1],
          stroke: colour,
          strokeOpacity: INTERVAL_OPACITY,
          strokeWidth: 2,
        })
      : null,
    line
      ? Plot.lineY(points, {
          ...drawn,
          clip: true,
          curve: held ? 'step-after' : 'linear',
          strokeWidth: width,
          ...(dash ? { strokeDasharray: dash } : {}),
        })
      : null,
    ...(symbol
      ? [true, false].map((hollow) =>
          Plot.dot(
            points.filter((point) => (point.hollow ?? false) === hollow),
            {
              ...drawn,
              symbol,
              r: radius,
              fillOpacity: opacity,
              strokeWidth: 1.5,
              fill: hollow ? 'var(--surface)' : colour,
            },
          ),
        )
      : []),
  ]
}

/** Adds the vertical line that `moveCursor` moves, to plots whose x is time. */
export function addCursor(plot: SVGSVGElement & Plot.Plot) {
  const scale = plot.scale('x')
  const range = [...(plot.scale('y')?.range ?? [])]
  if (!scale) return
  const line = document.createElementNS('http://www.w3.org/2000/svg', 'line')
  line.setAttribute('class', 'cursor')
  line.setAttribute('y1', String(range[0]))
  line.setAttribute('y2', String(range[1]))
  plot.append(line)
  ;(plot as Drawn).cursor = { line, x: (value) => Number(scale.apply(value)) }
  moveCursor(plot, Number([...(scale.domain ?? [])][0] ?? 0))
}
