import {
  symbol,
  symbolCircle,
  symbolCross,
  symbolDiamond2,
  symbolSquare,
  symbolStar,
  symbolTriangle,
  symbolWye,
} from 'd3-shape'
import { INTERVAL_OPACITY, type Symbol } from './colours'
import { h, s } from './dom'

export interface LegendEntry {
  label: string
  colour: string
  symbol?: Symbol
  hollow?: boolean
  dash?: string
  line?: boolean
  /** Opacity of a filled band. */
  band?: number
  /** The edges of a band. */
  outline?: boolean
  /** A vertical bar, of intervals. */
  interval?: boolean
  /** A scale of colours, from low to high, and nothing else. */
  ramp?: string[]
}

export function legend(entries: LegendEntry[]): HTMLElement {
  const picture = (entry: LegendEntry) =>
    s(
      'svg',
      { viewBox: `-2 -8 ${widthOf(entry) + 4} 16`, width: widthOf(entry) + 4, height: 16, 'aria-hidden': 'true' },
      ...entryMarks(entry),
    )
  return h('ul', { class: 'legend' }, ...entries.map((entry) => h('li', {}, picture(entry), entry.label)))
}

/** The width of the entry's marks. */
export function widthOf(entry: LegendEntry): number {
  return entry.ramp ? 128 : 28
}

/** The marks for a series, `widthOf` wide around y = 0. */
export function entryMarks(entry: LegendEntry): SVGElement[] {
  const { ramp } = entry
  if (ramp) {
    const step = widthOf(entry) / ramp.length
    return ramp.map((fill, i) =>
      s('rect', { x: i * step, y: -6, width: step, height: 12, fill, 'shape-rendering': 'crispEdges' }),
    )
  }
  const stroke = { stroke: entry.colour, 'stroke-width': 2, fill: 'none', 'stroke-dasharray': entry.dash ?? 'none' }
  const marks: SVGElement[] = []
  if (entry.band) marks.push(s('rect', { x: 2, y: -6, width: 24, height: 12, fill: entry.colour, opacity: entry.band }))
  if (entry.outline)
    for (const y of [-6, 6])
      marks.push(s('line', { x1: 0, x2: 28, y1: y, y2: y, stroke: entry.colour, 'stroke-width': 1.25 }))
  if (entry.interval)
    marks.push(s('line', { x1: 14, x2: 14, y1: -8, y2: 8, ...stroke, 'stroke-opacity': INTERVAL_OPACITY }))
  if (entry.line !== false) marks.push(s('line', { x1: 0, x2: 28, ...stroke }))
  if (entry.symbol)
    marks.push(
      s('path', {
        d: symbolPath(entry.symbol, 36),
        transform: 'translate(14, 0)',
        fill: entry.hollow ? 'var(--surface)' : entry.colour,
        stroke: entry.colour,
        'stroke-width': 1.5,
      }),
    )
  return marks
}

const SHAPES = {
  circle: symbolCircle,
  square: symbolSquare,
  triangle: symbolTriangle,
  diamond2: symbolDiamond2,
  star: symbolStar,
  cross: symbolCross,
  wye: symbolWye,
}

function symbolPath(name: Symbol, area: number): string {
  return symbol(SHAPES[name], area)() ?? ''
}
