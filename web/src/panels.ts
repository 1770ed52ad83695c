// Charts side by side, as wide as there is room for.
import { h } from './dom'
import type { Drawn } from './export'

export interface Panel {
  title: string
  /** A description for screen readers, where the title alone is not enough. */
  label?: string
  draw: (width: number) => SVGSVGElement
}

export interface Filling {
  /** The least width of a panel, in px; as many stand side by side as fit, at most `columns`. */
  minWidth?: number
  maxWidth?: number
  columns?: number
  /** The number of consecutive panels that belong together: in one row, or under each other if all fit so. */
  together?: number
}

export interface Layout {
  columns: number
  /** The width of a panel, in px. */
  width: number
  panels: Panel[]
}

const GAP = 16

/** room: width in px. */
export function arranged(panels: Panel[], room: number, filling: Filling): Layout {
  const fitting = Math.floor((room + GAP) / ((filling.minWidth ?? 300) + GAP))
  const together = filling.together ?? 1
  const groups = panels.length / together
  let columns = Math.max(1, Math.min(panels.length, filling.columns ?? 4, fitting))
  let order = panels
  if (together > 1 && groups > 2 && groups <= columns) {
    columns = groups
    order = panels.map((_, i) => panels[(i % groups) * together + Math.floor(i / groups)] as Panel)
  } else if (columns > together) columns -= columns % together
  const width = Math.min((room - GAP * (columns - 1)) / columns, filling.maxWidth ?? 720)
  return { columns, width: Math.floor(width), panels: order }
}

/** Fills a grid with panels; title: of their figure. */
export function fill(grid: HTMLElement, { columns, width, panels }: Layout, title: string): Drawn[] {
  const drawn = panels.map((panel) => {
    const svg = panel.draw(width)
    svg.setAttribute('role', 'img')
    svg.setAttribute('aria-label', `${title}: ${panel.label ?? panel.title}`)
    return { title: panel.title, svg }
  })
  grid.style.gridTemplateColumns = `repeat(${columns}, minmax(0, ${width}px))`
  grid.replaceChildren(
    ...drawn.map((panel) => h('div', { class: 'panel' }, panel.title ? h('h4', {}, panel.title) : null, panel.svg)),
  )
  return drawn
}
