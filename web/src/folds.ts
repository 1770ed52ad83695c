// Panels under lines that open and fold them. What is folded is not drawn.
import { h } from './dom'
import type { Drawn } from './export'
import type { Panel } from './panels'

/** Panels that belong together. */
export interface Fold {
  title: string
  /** Says what is in it, for those who do not open it. */
  about: string
  /** Unless the reader chooses otherwise. */
  open: boolean
  panels: Panel[]
}

/** The folds of a figure. What the reader opens or folds stays so, by its title, whatever is drawn next. */
export class Folds {
  private readonly all = h('button', { type: 'button', onclick: () => this.choose(!this.allOpen()) })
  private readonly list = h('div')
  readonly element = h('div', { class: 'folds' }, h('div', { class: 'save' }, this.all), this.list)
  private readonly chosen = new Map<string, boolean>()
  private folds: Fold[] = []
  private drawn = new Map<string, Drawn[]>()

  /** draw: fills a grid; changed: other panels are drawn now. */
  constructor(
    private readonly draw: (grid: HTMLElement, panels: Panel[]) => Drawn[],
    private readonly changed: () => void,
  ) {}

  show(folds: Fold[]) {
    this.folds = folds
    this.drawn = new Map()
    this.list.replaceChildren(...folds.map((fold) => this.details(fold)))
    this.label()
  }

  /** Panels of open folds, from above. */
  panels(): Drawn[] {
    return this.folds.flatMap(({ title }) => this.drawn.get(title) ?? [])
  }

  private details(fold: Fold): HTMLDetailsElement {
    const grid = h('div', { class: 'panels' })
    const set = (open: boolean) => {
      grid.replaceChildren()
      this.drawn.set(fold.title, open ? this.draw(grid, fold.panels) : [])
    }
    let known = this.isOpen(fold)
    const toggled = () => {
      if (details.open === known) return // the late event of details that are made open
      known = details.open
      this.chosen.set(fold.title, known)
      set(known)
      this.label()
      this.changed()
    }
    const summary = h('summary', {}, h('strong', {}, fold.title), ' ', h('span', {}, fold.about))
    const details = h('details', { open: known, ontoggle: toggled }, summary, grid)
    set(known)
    return details
  }

  private isOpen({ title, open }: Fold): boolean {
    return this.chosen.get(title) ?? open
  }

  private allOpen(): boolean {
    return this.folds.every((fold) => this.isOpen(fold))
  }

  private choose(open: boolean) {
    for (const { title } of this.folds) this.chosen.set(title, open)
    this.show(this.folds)
    this.changed()
  }

  private label() {
    this.all.textContent = this.allOpen() ? 'Fold all' : 'Open all'
  }
}
