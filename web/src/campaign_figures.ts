// Return, success and time, a panel for each prior and a line for each learner.
import { chart, fit, heights, type Point, type Series } from './chart'
import { present, type Campaign, type Group, type GroupTrial, type Quartiles, type SuccessRate } from './data'
import type { Child } from './dom'
import type { Row } from './export'
import { largest } from './extent'
import { figure } from './figure'
import { count, number, percent } from './format'
import { inPanel, legendOf, medianPoint, medianPoints, panelPriors, panelTitle, type StyleOf } from './groups'
import { choice } from './layout'
import type { Panel } from './panels'
import { TRIAL } from './trials'

/** The first of the campaign file is drawn last, over the others. */
export function inFront(series: Series[]): Series[] {
  return [...series].reverse()
}

export function returns(campaign: Campaign, style: StyleOf): Child {
  const { groups } = campaign.summary
  if (!groups.some((group) => group.trials.length > 0)) return null
  let measure: 'return' | 'best_return' = 'return'
  const series = (group: Group): Series => ({
    ...style(group),
    points: group.trials.flatMap((one) => {
      const at = `trial ${one.trial}, ${number(one.interaction_s)} s`
      return medianPoint(one.interaction_s, one[measure], at, one.runs)
    }),
  })
  const panel = (prior: string): Panel => {
    const all = groups.map(series)
    const x = {
      label: 'time on the robot (s)',
      ...fit(
        all.flatMap(({ points }) => points.map((p) => p.x)),
        { zero: true },
      ),
    }
    const y = { label: 'return', ...fit(all.flatMap(heights), { zero: true }) }
    return {
      title: panelTitle(prior),
      draw: (width) => chart({ width, height: 260, x, y, series: inFront(inPanel(groups, prior).map(series)) }),
    }
  }
  const measures: [string, string][] = [
    ['return', 'of the trial'],
    ['best_return', 'best so far'],
  ]
  const drawn = figure({
    name: 'return-by-interaction-time',
    title: 'Return against time on the robot',
    about: 'Median and quartiles over the seeds.',
    legend: legendOf(
      groups.filter((group) => series(group).points.length > 0),
      style,
      { band: 0.16 },
    ),
    controls: choice('Return', measures, (value) => {
      measure = value as typeof measure
      drawn.redraw()
    }),
    panels: () => panelPriors(campaign).map(panel),
    table: () =>
      byTrial(groups, ({ trial, runs, interaction_s, return: now, best_return: best }) => ({
        trial,
        runs,
        interaction_s,
        ...prefixed('return_', now),
        ...prefixed('best_return_', best),
      })),
    columns: 2,
  })
  return drawn.element
}

export function success(campaign: Campaign, style: StyleOf): Child {
  const { groups, trials } = campaign.summary
  if (!groups.some((group) => group.trials.some(({ solved_by }) => solved_by))) return null
  let measure: 'solved_by' | 'solved' = 'solved_by'
  const series = (group: Group, i: number, all: Group[]): Series => {
    const shift = besideEachOther(i, all.length)
    return { ...style(group), points: group.trials.flatMap((one) => ratePoint(one.trial, shift, one[measure])) }
  }
  const drawnGroups = groups.filter((group) => series(group, 0, [group]).points.length > 0)
  const panel = (prior: string): Panel => ({
    title: panelTitle(prior),
    draw: (width) =>
      chart({
        width,
        height: 260,
        x: { ...TRIAL, domain: [0.5, trials + 0.5] },
        y: { label: 'solved', percent: true, domain: [0, 1] },
        series: inFront(inPanel(groups, prior).map(series)),
      }),
  })
  const measures: [string, string][] = [
    ['solved_by', 'by this trial'],
    ['solved', 'in this trial'],
  ]
  const drawn = figure({
    name: 'success-by-trial',
    title: 'Success rate by trial',
    about: 'With 95 % intervals (Clopper and Pearson 1934). Runs that failed count as not solved.',
    legend: legendOf(drawnGroups, style),
    controls: choice('Solved', measures, (value) => {
      measure = value as typeof measure
      drawn.redraw()
    }),
    panels: () => panelPriors(campaign).map(panel),
    table: () =>
      byTrial(groups, ({ trial, solved, solved_by }) => ({
        trial,
        ...prefixed('solved_', solved),
        ...prefixed('solved_by_', solved_by),
      })),
    columns: 2,
  })
  return drawn.element
}

/** The places of the intervals of a trial, so that they stand beside each other and not in the next trial. */
export function besideEachOther(i: number, of: number): number {
  return Math.min(0.12, 0.8 / of) * (i - (of - 1) / 2)
}

function ratePoint(trial: number, shift: number, rate: SuccessRate | null): Point[] {
  if (!rate || !present(rate.rate)) return []
  const tip = [
    `trial ${trial}`,
    `${rate.count} of ${count(rate.runs, 'run')}, ${percent(rate.rate)}`,
    `95 %: ${percent(rate.low)} … ${percent(rate.high)}`,
  ].join('\n')
  const known = present(rate.low) && present(rate.high)
  const interval = known ? { interval: [rate.low, rate.high] as [number, number] } : {}
  return [{ x: trial + shift, y: rate.rate, tip, ...interval }]
}

const SHORTEST_S = 0.01

export function times(campaign: Campaign, style: StyleOf): Child {
  const { times } = campaign
  if (times.length === 0) return null
  const longest = Math.max(1, largest(times.flatMap((one) => heights({ points: medianPoints(one) }))))
  const panel = (prior: string, part: string, name: string): Panel => {
    const shown = inPanel(times, prior).filter((one) => one.part === part)
    const y = { label: 'seconds', log: true, domain: [SHORTEST_S, 1.2 * longest] as [number, number] }
    const series = shown.map((one) => ({ ...style(one), points: medianPoints(one).map(notShorter) }))
    return {
      title: `${name}, ${panelTitle(prior)}`,
      draw: (width) => chart({ width, height: 220, x: TRIAL, y, series: inFront(series) }),
    }
  }
  return figure({
    name: 'time-by-trial',
    title: 'Time to compute a trial',
    about:
      'Median and quartiles over the runs, of searching the policy and of learning the model. ' +
      'Less than 10 ms is drawn as 10 ms.',
    legend: legendOf(
      times.filter((one) => medianPoints(one).length > 0),
      style,
      { band: 0.16 },
    ),
    panels: () =>
      panelPriors(campaign).flatMap((prior) => [panel(prior, 'search_s', 'search'), panel(prior, 'model_s', 'model')]),
    table: () => times.flatMap((one) => quartileRows(one, { part: one.part })),
    minWidth: 260,
    columns: 4,
  }).element
}

/** Zero has no place on a logarithmic axis. */
function notShorter(point: Point): Point {
  const raised = (value: number) => Math.max(value, SHORTEST_S)
  const band = point.band ? { band: [raised(point.band[0]), raised(point.band[1])] as [number, number] } : {}
  return { ...point, y: raised(point.y), ...band }
}

function byTrial(groups: Group[], row: (trial: GroupTrial) => Row): Row[] {
  return groups.flatMap(({ learner, prior, variant, trials }) =>
    trials.map((trial) => ({ learner, prior, variant, ...row(trial) })),
  )
}

export function quartileRows({ learner, prior, variant, trials }: Quartiles, of: Row): Row[] {
  return trials.map((quartiles) => ({ learner, prior, variant, ...of, ...quartiles }))
}

function prefixed(prefix: string, values: object | null): Row {
  return Object.fromEntries(
    Object.entries(values ?? {}).map(([name, value]: [string, Row[string]]) => [prefix + name, value]),
  )
}
