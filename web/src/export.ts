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

/** Panels side by side in one SVG that stands alone: in the colours of the light page, with a title and a legend. */
export function svgOf(title: string, panels: Drawn[], columns: number, legend: LegendEntry[]): string {
  const size = (svg: SVGSVGElement, side: 'width' | 'height') => Number(svg.getAttribute(side))
  const width = Math.max(...panels.map(({ svg }) => size(svg, 'width'))) + MARGIN
  const height = Math.max(...panels.map(({ svg }) => size(svg, 'height'))) + TITLE + MARGIN
  const across = Math.min(columns, panels.length)
  const all = { width: width * across + MARGIN, height: height * Math.ceil(panels.length / across) + 56 }
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
  root.append(drawnLegend(legend))
  panels.forEach((panel, i) => {
    const x = MARGIN + width * (i % across)
    const y = 50 + height * Math.floor(i / across)
    const copy = panel.svg.cloneNode(true) as SVGSVGElement
    copy.querySelectorAll('[aria-label=tip], .cursor').forEach((part) => part.remove())
    copy.setAttribute('x', String(x))
    copy.setAttribute('y', String(y + TITLE))
    root.append(s('text', { x, y: y + 14, 'font-weight': 600 }, panel.title), copy)
  })
  return new XMLSerializer()
    .serializeToString(root)
    .replaceAll(/var\((--[\w-]+)\)/g, (_, name: string) => lightValue(name))
}

function drawnLegend(legend: LegendEntry[]): SVGElement {
  const group = s('g', { transform: `translate(${MARGIN}, 38)` })
  let x = 0
  for (const entry of legend) {
    group.append(
      s('g', { transform: `translate(${x}, -4)` }, ...entryMarks(entry)),
      s('text', { x: x + widthOf(entry) + 6, y: 0 }, entry.label),
    )
    x += widthOf(entry) + 26 + 6.6 * entry.label.length
  }
  return group
}

/** "light-dark(A, B)" is A; see style.css. */
function lightValue(name: string): string {
  const value = getComputedStyle(document.documentElement).getPropertyValue(name)
  return /light-dark\(\s*([^,]+),/.exec(value)?.[1] ?? value.trim()
}
