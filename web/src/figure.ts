// The frame of every figure: title, what it shows, legend, panels as wide as the page allows, and what can be saved.
import { h, download, type Child } from './dom'
import { downloadCsv, svgOf, type Drawn, type Row } from './export'
import { legend, type LegendEntry } from './legend'

export interface Panel {
  title: string
  /** For readers who do not see it, where the title alone does not say what it shows. */
  label?: string
  draw: (width: number) => SVGSVGElement
}

export interface FigureOptions {
  /** Of the files that are saved. */
  name: string
  title: string
  about?: Child
  legend?: LegendEntry[]
  panels: () => Panel[]
  table: () => Row[]
  /** Of a panel, in px; as many stand side by side as fit, at most `columns`. */
  minWidth?: number
  maxWidth?: number
  columns?: number
  /** So many panels after each other belong together: they stand in one row, or under each other if all fit so. */
  together?: number
  controls?: HTMLElement
  afterDrawing?: () => void
}

export interface Figure {
  element: HTMLElement
  redraw: () => void
  drawn: () => Drawn[]
}

const GAP = 16

export function figure(options: FigureOptions): Figure {
  const grid = h('div', { class: 'panels' })
  let panels: Drawn[] = []
  let columns = 1
  let drawnWidth = 0

  const redraw = () => {
    if (drawnWidth === 0) return
    let wanted = options.panels()
    const minWidth = options.minWidth ?? 300
    const fitting = Math.floor((drawnWidth + GAP) / (minWidth + GAP))
    const together = options.together ?? 1
    const groups = wanted.length / together
    columns = Math.max(1, Math.min(wanted.length, options.columns ?? 4, fitting))
    if (together > 1 && groups > 2 && groups <= columns) {
      columns = groups
      wanted = wanted.map((_, i) => wanted[(i % groups) * together + Math.floor(i / groups)] as Panel)
    } else if (columns > together) columns -= columns % together
    const width = Math.min((drawnWidth - GAP * (columns - 1)) / columns, options.maxWidth ?? 720)
    panels = wanted.map(({ title, label, draw }) => {
      const svg = draw(Math.floor(width))
      svg.setAttribute('role', 'img')
      svg.setAttribute('aria-label', `${options.title}: ${label ?? title}`)
      return { title, svg }
    })
    grid.style.gridTemplateColumns = `repeat(${columns}, minmax(0, ${Math.floor(width)}px))`
    grid.replaceChildren(
      ...panels.map(({ title, svg }) => h('div', { class: 'panel' }, title ? h('h4', {}, title) : null, svg)),
    )
    options.afterDrawing?.()
  }
  const fit = () => {
    if (grid.clientWidth === drawnWidth) return
    drawnWidth = grid.clientWidth
    redraw()
  }
  whenNearOrIdle(grid, () => new ResizeObserver(() => requestAnimationFrame(fit)).observe(grid))

  const saveSvg = () =>
    download(`${options.name}.svg`, svgOf(options.title, panels, columns, options.legend ?? []), 'image/svg+xml')
  const element = h(
    'figure',
    { id: options.name },
    heading(options.title, [
      { label: 'SVG', save: saveSvg },
      { label: 'CSV', save: () => downloadCsv(options.name, options.table()) },
    ]),
    options.about ? h('figcaption', {}, options.about) : null,
    options.controls,
    options.legend?.length ? legend(options.legend) : null,
    grid,
  )
  return { element, redraw, drawn: () => panels }
}

/** Once: when the reader comes near, or before that in an idle moment, so that a page of many figures opens at once and
 * is whole when it is printed. */
function whenNearOrIdle(element: Element, then: () => void) {
  let due = true
  const draw = () => {
    if (!due) return
    due = false
    observer.disconnect()
    then()
  }
  const observer = new IntersectionObserver((entries) => entries.some((entry) => entry.isIntersecting) && draw(), {
    rootMargin: '800px 0px',
  })
  observer.observe(element)
  // Safari has no idle callbacks.
  if ('requestIdleCallback' in window) requestIdleCallback(draw)
  else setTimeout(draw, 1000)
}

function heading(title: string, files: { label: string; save: () => void }[]): HTMLElement {
  return h(
    'div',
    { class: 'heading' },
    h('h3', {}, title),
    h(
      'div',
      { class: 'save' },
      ...files.map(({ label, save }) =>
        h('button', { type: 'button', onclick: save, 'aria-label': `Save “${title}” as ${label}` }, label),
      ),
    ),
  )
}

interface TableOptions {
  name: string
  title: string
  about?: Child
  columns: string[]
  /** The rows as they are shown. */
  lines: HTMLElement[]
  table: () => Row[]
}

/** A table with its title, that can be saved too. */
export function tableFigure({ name, title, about, columns, lines, table }: TableOptions): HTMLElement {
  const head = h('tr', {}, ...columns.map((column) => h('th', { scope: 'col' }, column)))
  return h(
    'figure',
    { id: name },
    heading(title, [{ label: 'CSV', save: () => downloadCsv(name, table()) }]),
    about ? h('figcaption', {}, about) : null,
    h(
      'div',
      { class: 'scroll', tabindex: 0, role: 'region', 'aria-label': title },
      h('table', {}, h('thead', {}, head), h('tbody', {}, ...lines)),
    ),
  )
}
