// The frame of every figure: title, what it shows, legend, panels as wide as the page allows, and what can be saved.
import { h, download, type Child } from './dom'
import { downloadCsv, svgOf, type Drawn, type Row } from './export'
import { Folds, type Fold } from './folds'
import { legend, type LegendEntry } from './legend'
import { arranged, fill, type Filling, type Layout, type Panel } from './panels'

export interface FigureOptions extends Filling {
  /** The name of the files that are saved. */
  name: string
  title: string
  about?: Child
  legend?: LegendEntry[]
  panels: () => Panel[]
  /** The same panels in folds, where they are too many to look at. */
  folds?: () => Fold[]
  table: () => Row[]
  controls?: HTMLElement
  afterDrawing?: () => void
}

export interface Figure {
  element: HTMLElement
  redraw: () => void
  drawn: () => Drawn[]
}

/** The width of figures on paper, in px; A4 and Letter have a little more. */
const PAPER = 640

export function figure(options: FigureOptions): Figure {
  const grid = h('div', { class: 'panels' })
  let layout: Layout = { columns: 1, width: 0, panels: [] }
  let panels: Drawn[] = []
  let drawnWidth = 0
  const afterDrawing = () => {
    svg.disabled = drawn().length === 0
    options.afterDrawing?.()
  }
  const draw = (into: HTMLElement, some: Panel[]) => fill(into, { ...layout, panels: some }, options.title)
  const folds = options.folds ? new Folds(draw, afterDrawing) : null
  const body = folds?.element ?? grid

  const redraw = () => {
    if (drawnWidth === 0) return
    const wanted = options.folds?.() ?? []
    layout = arranged(folds ? wanted.flatMap((fold) => fold.panels) : options.panels(), drawnWidth, options)
    if (folds) folds.show(wanted)
    else panels = draw(grid, layout.panels)
    afterDrawing()
  }
  const fit = (width: number) => {
    if (width === drawnWidth) return
    drawnWidth = width
    redraw()
  }
  const fitBody = () => fit(body.clientWidth)
  whenNearOrIdle(body, () => {
    fitBody() // a page that is printed may see no frame
    new ResizeObserver(() => requestAnimationFrame(fitBody)).observe(body)
  })
  // A chart as wide as the window would be shrunk to the paper, with its text.
  window.addEventListener('beforeprint', () => fit(PAPER))
  window.addEventListener('afterprint', fitBody)

  const drawn = () => folds?.panels() ?? panels
  const saveSvg = () =>
    download(
      `${options.name}.svg`,
      svgOf(options.title, drawn(), layout.columns, options.legend ?? []),
      'image/svg+xml',
    )
  const svg = saveButton(options.title, 'SVG', saveSvg)
  svg.disabled = true // until something is drawn
  const element = h(
    'figure',
    { id: options.name },
    heading(
      options.title,
      svg,
      saveButton(options.title, 'CSV', () => downloadCsv(options.name, options.table())),
    ),
    options.about ? h('figcaption', {}, options.about) : null,
    options.controls,
    options.legend?.length ? legend(options.legend) : null,
    body,
  )
  return { element, redraw, drawn }
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
  // Safari has no idle callbacks, and a browser without a window may have none, or never look.
  if ('requestIdleCallback' in window) requestIdleCallback(draw)
  setTimeout(draw, 1000)
  window.addEventListener('beforeprint', draw, { once: true })
}

function heading(title: string, ...buttons: HTMLButtonElement[]): HTMLElement {
  return h('div', { class: 'heading' }, h('h3', {}, title), h('div', { class: 'save' }, ...buttons))
}

function saveButton(title: string, label: string, save: () => void): HTMLButtonElement {
  return h('button', { type: 'button', onclick: save, 'aria-label': `Save “${title}” as ${label}` }, label)
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
    heading(
      title,
      saveButton(title, 'CSV', () => downloadCsv(name, table())),
    ),
    about ? h('figcaption', {}, about) : null,
    h(
      'div',
      { class: 'scroll', tabindex: 0, role: 'region', 'aria-label': title },
      h('table', {}, h('thead', {}, head), h('tbody', {}, ...lines)),
    ),
  )
}
