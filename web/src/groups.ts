// Common parts of a campaign's figures: learners × priors × variants, and the look of each.
import type { Point } from './chart'
import { looks, variantLooks, type Look } from './colours'
import { present, type Campaign, type Cell, type GroupKey, type Quartiles } from './data'
import { count, number } from './format'
import type { LegendEntry } from './legend'

export interface Style extends Look {
  label: string
  dash: string
}

export type StyleOf = (group: GroupKey) => Style

/** Colour and symbol say the learner, the dash the variant; of more than four variants the symbol does, too. */
export function styles({ summary }: Campaign): StyleOf {
  const look = looks(summary.learners)
  const taken = summary.learners.map((learner) => look(learner).symbol)
  const { variants } = summary
  return ({ learner, variant }) => {
    const all = variantLooks(look(learner), Math.max(1, variants.length), taken)
    const own = all[Math.max(0, variants.indexOf(variant))] as (typeof all)[0]
    return { ...own, label: variant ? `${learner}, ${variant}` : learner }
  }
}

/** One entry a style. */
export function legendOf(groups: GroupKey[], style: StyleOf, extra: Partial<LegendEntry> = {}): LegendEntry[] {
  const entries = groups.map((group) => ({ ...style(group), ...extra }))
  return entries.filter((entry, i) => entries.findIndex((other) => other.label === entry.label) === i)
}

/** Priors that have a panel of their own; learners without a prior stand in every one. */
export function panelPriors({ summary }: Campaign): string[] {
  const named = summary.priors.filter((prior) => prior !== '')
  return named.length > 0 ? named : ['']
}

export function inPanel<T extends GroupKey>(groups: T[], prior: string): T[] {
  return groups.filter((group) => group.prior === prior || group.prior === '')
}

export function panelTitle(prior: string): string {
  return prior ? `prior ${prior}` : 'no prior'
}

interface Quarters {
  quartile_1: Cell
  median: Cell
  quartile_3: Cell
}

/** The median with its quartiles; none without runs. at: the text for x. */
export function medianPoint(x: Cell, { quartile_1, median, quartile_3 }: Quarters, at: string, runs: number): Point[] {
  if (!present(x) || !present(median)) return []
  const tip = [
    at,
    `median ${number(median)}`,
    `quartiles ${number(quartile_1)} … ${number(quartile_3)}`,
    count(runs, 'run'),
  ].join('\n')
  const band = present(quartile_1) && present(quartile_3) ? { band: [quartile_1, quartile_3] as [number, number] } : {}
  return [{ x, y: median, tip, ...band }]
}

export function medianPoints({ trials }: Quartiles): Point[] {
  return trials.flatMap((one) => medianPoint(one.trial, one, `trial ${one.trial}`, one.runs))
}
