// Figures as SVG and tables as CSV.
import { download, s } from './dom'
import { entryMarks, widthOf, type LegendEntry } from './legend'

export type Row = Record<string, string | number | null | undefined>

export function csvOf(rows: Row[]): string {
  const header = [...new Set(rows.flatMap((row) => Object.keys(row)))]
  const cell = (value: Row[string]) => {
    const text = value === null || value === undefined ? '' : String(value)
    return /[",\n\r]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text
  }
  return [header, ...rows.map((row) => header.map((name) => row[name]))]
    .map((cells) => cells.map(cell).join(',') + '\n')
    .join('')
}

export function downloadCsv(name: string, rows: Row[]) {
  download(`${name}.csv`, csvOf(rows), 'text/csv')
}

export interface Drawn {
  title: string
  svg: SVGSVGElement
}

const MARGIN = 12
const TITLE = 22
/** From a line of a legend to the next. */
const LINE = 18

/** Panels side by side in one SVG that stands alone: in the colours of the light page, with a title and a legend. */
export function svgOf(title: string, panels: Drawn[], columns: number, legend: LegendEntry[]): string {
  const size = (svg: SVGSVGElement, side: 'width' | 'height') => Number(svg.getAttribute(side))
  const width = Math.max(...panels.map(({ svg }) => size(svg, 'width'))) + MARGIN
  const height = Math.max(...panels.map(({ svg }) => size(svg, 'height'))) + TITLE + MARGIN
  const across = Math.min(columns, panels.length)
  const least = Math.max(1.3 * lengthOf(title), ...legend.map(lengthOfEntry)) + 2 * MARGIN
  const allWidth = Math.max(width * across + MARGIN, least)
  const places = placesOf(legend, allWidth - 2 * MARGIN)
  const top = 50 + LINE * (places.at(-1)?.row ?? 0)
  const all = { width: allWidth, height: height * Math.ceil(panels.length / across) + top + 6 }
  const root = s('svg', {
    xmlns: 'http://www.w3.org/2000/svg',
    viewBox: `0 0 ${all.width} ${all.height}`,
    ...all,
    'font-family': 'system-ui, sans-serif',
    'font-size': 12,
    style: 'color: #1b1f24',
    fill: 'currentColor',
  })
  root.append(
    s('rect', { ...all, fill: '#ffffff' }),
    s('text', { x: MARGIN, y: 20, 'font-size': 15, 'font-weight': 600 }, title),
  )
  root.append(drawnLegend(legend, places))
  panels.forEach((panel, i) => {
    const x = MARGIN + width * (i % across)
    const y = top + height * Math.floor(i / across)
    const copy = panel.svg.cloneNode(true) as SVGSVGElement
    copy.querySelectorAll('[aria-label=tip], .cursor').forEach((part) => part.remove())
    copy.setAttribute('x', String(x))
    copy.setAttribute('y', String(y + TITLE))
    const squeezed = 1.1 * lengthOf(panel.title) > width - MARGIN
    const fitted = squeezed ? { textLength: width - MARGIN, lengthAdjust: 'spacingAndGlyphs' } : {}
    root.append(s('text', { x, y: y + 14, 'font-weight': 600, ...fitted }, panel.title), copy)
  })
  return new XMLSerializer()
    .serializeToString(root)
    .replaceAll(/var\((--[\w-]+)\)/g, (_, name: string) => lightValue(name))
}

/** About as wide as a text is, in px. */
function lengthOf(text: string): number {
  return 6.6 * text.length
}

function lengthOfEntry(entry: LegendEntry): number {
  return widthOf(entry) + 6 + lengthOf(entry.label)
}

/** The places of a legend's entries: from left to right in rows that are not wider than that. */
export function placesOf(legend: LegendEntry[], width: number): { x: number; row: number }[] {
  let [x, row] = [0, 0]
  return legend.map((entry) => {
    const length = lengthOfEntry(entry)
    if (x > 0 && x + length > width) [x, row] = [0, row + 1]
    const place = { x, row }
    x += length + 20
    return place
  })
}

function drawnLegend(legend: LegendEntry[], places: { x: number; row: number }[]): SVGElement {
  const drawn = legend.flatMap((entry, i) => {
    const { x, row } = places[i] as (typeof places)[0]
    return [
      s('g', { transform: `translate(${x}, ${LINE * row - 4})` }, ...entryMarks(entry)),
      s('text', { x: x + widthOf(entry) + 6, y: LINE * row }, entry.label),
    ]
  })
  return s('g', { transform: `translate(${MARGIN}, 38)` }, ...drawn)
}

/** "light-dark(A, B)" is A; see style.css. */
function lightValue(name: string): string {
  const value = getComputedStyle(document.documentElement).getPropertyValue(name)
  return /light-dark\(\s*([^,]+),/.exec(value)?.[1] ?? value.trim()
}
