// The page of a campaign.
import { chart, extent, type Point, type Series } from './chart'
import { DASHES, looks, type Look } from './colours'
import { present, type Campaign, type ClaimPart, type Group, type GroupKey, type Quartiles, type Report } from './data'
import { h, type Child } from './dom'
import type { Row } from './export'
import { figure, tableFigure, type Panel } from './figure'
import { count, duration, number, percent } from './format'
import type { LegendEntry } from './legend'
import { choice, head, problems, sections, tiles } from './layout'

export function campaignPage(report: Report, campaign: Campaign): Child[] {
  const { summary } = campaign
  const style = styles(campaign)
  return [
    head(summary.title, `${summary.scenario} · ${count(summary.trials, 'trial')} a run · ${count(summary.seeds.length, 'seed')}`),
    problems(report),
    h(
      'main',
      {},
      tiles(keyFigures(campaign)),
      missing(campaign),
      ...sections([
        { id: 'claims', title: 'Claims', content: [claims(campaign)] },
        { id: 'returns', title: 'Returns', content: [returns(campaign, style)] },
        { id: 'success', title: 'Success', content: [success(campaign, style)] },
        { id: 'identified', title: 'Parameters', content: [parameters(campaign, style)] },
        { id: 'time', title: 'Time', content: [times(campaign, style)] },
        { id: 'runs', title: 'Runs', content: [runs(campaign)] },
      ]),
    ),
  ]
}

interface Style extends Look {
  label: string
  dash: string
}

/** Colour and symbol say the learner, the dash the variant. */
function styles({ summary }: Campaign): (group: GroupKey) => Style {
  const look = looks(summary.learners)
  return ({ learner, variant }) => ({
    ...look(learner),
    label: variant ? `${learner}, ${variant}` : learner,
    dash: DASHES[Math.max(0, summary.variants.indexOf(variant)) % DASHES.length] ?? 'none',
  })
}

function legendOf({ summary }: Campaign, style: (group: GroupKey) => Style, extra: Partial<LegendEntry> = {}): LegendEntry[] {
  const entries = summary.groups.map((group) => ({ ...style(group), ...extra }))
  return entries.filter((entry, i) => entries.findIndex((other) => other.label === entry.label) === i)
}

/** Priors that have a panel of their own; learners without a prior stand in every one. */
function panelPriors({ summary }: Campaign): string[] {
  const named = summary.priors.filter((prior) => prior !== '')
  return named.length > 0 ? named : ['']
}

function inPanel<T extends GroupKey>(groups: T[], prior: string): T[] {
  return groups.filter((group) => group.prior === prior || group.prior === '')
}

function panelTitle(prior: string): string {
  return prior ? `prior ${prior}` : 'no prior'
}

function keyFigures({ summary, times }: Campaign) {
  const { counts, claims } = summary
  const passed = claims.filter(({ result }) => result === 'pass').length
  const seconds = times.flatMap(({ trials }) => trials).reduce((so, { median, runs }) => so + (median ?? 0) * runs, 0)
  return [
    { label: 'Runs done', value: `${number(counts.done)} of ${number(counts.runs)}`, note: summary.complete ? 'complete' : 'not complete' },
    { label: 'Failed', value: number(counts.failed) },
    ...(claims.length > 0 ? [{ label: 'Claims that hold', value: `${passed} of ${claims.length}` }] : []),
    { label: 'Time to compute', value: `≈ ${duration(seconds)}`, note: 'on one core' },
  ]
}

function missing({ summary }: Campaign): Child {
  if (summary.missing.length === 0) return null
  return h(
    'aside',
    { class: 'missing' },
    h('p', {}, 'Missing, because they are not built:'),
    h('ul', {}, ...summary.missing.map(({ learner, reason }) => h('li', {}, h('strong', {}, learner), ` – ${reason}`))),
  )
}

function returns(campaign: Campaign, style: (group: GroupKey) => Style): Child {
  const { groups } = campaign.summary
  let measure: 'return' | 'best_return' = 'return'
  const series = (group: Group): Series => ({
    ...style(group),
    points: group.trials.flatMap(({ trial, runs, interaction_s, [measure]: five }): Point[] =>
      present(interaction_s) && present(five.median)
        ? [
            {
              x: interaction_s,
              y: five.median,
              ...(present(five.quartile_1) && present(five.quartile_3) ? { band: [five.quartile_1, five.quartile_3] } : {}),
              tip: `trial ${trial}, ${number(interaction_s)} s\nmedian ${number(five.median)}\nquartiles ${number(five.quartile_1)} … ${number(five.quartile_3)}\n${count(runs, 'run')}`,
            },
          ]
        : [],
    ),
  })
  const domain = (side: 'x' | 'y') => {
    const points = groups.flatMap((group) => series(group).points)
    const values = side === 'x' ? points.map(({ x }) => x) : points.flatMap(({ y, band }) => [y, ...(band ?? [])])
    const found = extent(values, true)
    return found ? { domain: found } : {}
  }
  const drawn = figure({
    name: 'return-by-interaction-time',
    title: 'Return against time on the robot',
    about: 'Median and quartiles over the seeds.',
    legend: legendOf(campaign, style, { band: 0.16 }),
    controls: choice('Return', [['return', 'of the trial'], ['best_return', 'best so far']], (value) => {
      measure = value as typeof measure
      drawn.redraw()
    }),
    panels: () =>
      panelPriors(campaign).map((prior): Panel => ({
        title: panelTitle(prior),
        draw: (width) =>
          chart({
            width,
            height: 260,
            x: { label: 'time on the robot (s)', ...domain('x') },
            y: { label: 'return', ...domain('y') },
            series: inPanel(groups, prior).map(series),
          }),
      })),
    table: () =>
      groups.flatMap(({ learner, prior, variant, trials }) =>
        trials.map(({ trial, runs, interaction_s, return: now, best_return: best }): Row => ({
          learner, prior, variant, trial, runs, interaction_s,
          ...prefixed('return_', now), ...prefixed('best_return_', best),
        })),
      ),
    columns: 2,
  })
  return drawn.element
}

function success(campaign: Campaign, style: (group: GroupKey) => Style): Child {
  const { groups } = campaign.summary
  if (!groups.some(({ trials }) => trials.some(({ solved_by }) => solved_by))) return null
  let measure: 'solved_by' | 'solved' = 'solved_by'
  const series = (group: Group, i: number, all: Group[]): Series => ({
    ...style(group),
    points: group.trials.flatMap(({ trial, [measure]: rate }): Point[] =>
      rate && present(rate.rate)
        ? [
            {
              x: trial + 0.12 * (i - (all.length - 1) / 2),
              y: rate.rate,
              ...(present(rate.low) && present(rate.high) ? { interval: [rate.low, rate.high] } : {}),
              tip: `trial ${trial}\n${rate.count} of ${count(rate.runs, 'run')}, ${percent(rate.rate)}\n95 %: ${percent(rate.low)} … ${percent(rate.high)}`,
            },
          ]
        : [],
    ),
  })
  const drawn = figure({
    name: 'success-by-trial',
    title: 'Success rate by trial',
    about: 'With 95 % intervals (Clopper and Pearson 1934). Runs that failed count as not solved.',
    legend: legendOf(campaign, style),
    controls: choice('Solved', [['solved_by', 'by this trial'], ['solved', 'in this trial']], (value) => {
      measure = value as typeof measure
      drawn.redraw()
    }),
    panels: () =>
      panelPriors(campaign).map((prior): Panel => ({
        title: panelTitle(prior),
        draw: (width) =>
          chart({
            width,
            height: 260,
            x: { label: 'trial', whole: true, domain: [0.5, campaign.summary.trials + 0.5] },
            y: { label: 'solved', percent: true, domain: [0, 1] },
            series: inPanel(groups, prior).map(series),
          }),
      })),
    table: () =>
      groups.flatMap(({ learner, prior, variant, trials }) =>
        trials.map(({ trial, solved, solved_by }): Row => ({
          learner, prior, variant, trial, ...prefixed('solved_', solved), ...prefixed('solved_by_', solved_by),
        })),
      ),
    columns: 2,
  })
  return drawn.element
}

function parameters(campaign: Campaign, style: (group: GroupKey) => Style): Child {
  const { parameters } = campaign
  if (parameters.length === 0) return null
  const names = [...new Set(parameters.map(({ parameter }) => parameter))]
  const priors = [...new Set(parameters.map(({ prior }) => prior))]
  const series = (one: Quartiles): Series => ({ ...style(one), points: quartilePoints(one) })
  const panel = (prior: string, name: string): Panel[] => {
    const shown = parameters.filter((one) => one.prior === prior && one.parameter === name)
    if (shown.length === 0) return []
    const all = parameters.filter((one) => one.parameter === name)
    const truth = shown.find((one) => present(one.truth))?.truth
    const values = all.flatMap((one) => [...quartilePoints(one).flatMap(({ y, band }) => [y, ...(band ?? [])]), ...(present(one.truth) ? [one.truth] : [])])
    const domain = extent(values, false, 0.2 * Math.max(...values.map(Math.abs))) // what is small should look small
    return [
      {
        title: `${name}, ${panelTitle(prior)}`,
        draw: (width) =>
          chart({
            width,
            height: 190,
            x: { label: 'trial', whole: true },
            y: { label: '', ...(domain ? { domain } : {}) },
            series: shown.map(series),
            rule: present(truth) ? { y: truth, label: 'robot' } : null,
          }),
      },
    ]
  }
  return figure({
    name: 'parameters-by-trial',
    title: 'Identified parameters against the truth',
    about: 'Median and quartiles of the values with which the model chose each trial’s policy. Dashed: the robot’s own.',
    legend: legendOf(campaign, style, { band: 0.16 }).filter(({ label }) => parameters.some((one) => style(one).label === label)),
    panels: () => priors.flatMap((prior) => names.flatMap((name) => panel(prior, name))),
    table: () =>
      parameters.flatMap(({ parameter, truth, learner, prior, variant, trials }) =>
        trials.map((quartiles): Row => ({ learner, prior, variant, parameter, truth, ...quartiles })),
      ),
    minWidth: 220,
    columns: names.length,
  }).element
}

const SHORTEST_S = 0.01

function times(campaign: Campaign, style: (group: GroupKey) => Style): Child {
  const { times } = campaign
  if (times.length === 0) return null
  const floored = (one: Quartiles): Point[] =>
    quartilePoints(one).map((p) => ({
      ...p,
      y: Math.max(p.y, SHORTEST_S),
      ...(p.band ? { band: [Math.max(p.band[0], SHORTEST_S), Math.max(p.band[1], SHORTEST_S)] } : {}),
    }))
  const longest = Math.max(...times.flatMap((one) => floored(one).flatMap(({ y, band }) => [y, ...(band ?? [])])))
  const panel = (prior: string, part: 'model_s' | 'search_s', name: string): Panel => ({
    title: `${name}, ${panelTitle(prior)}`,
    draw: (width) =>
      chart({
        width,
        height: 220,
        x: { label: 'trial', whole: true },
        y: { label: 'seconds', log: true, domain: [SHORTEST_S, Math.max(1, 1.2 * longest)] },
        series: inPanel(times.filter((one) => one.part === part), prior).map((one) => ({ ...style(one), points: floored(one) })),
      }),
  })
  return figure({
    name: 'time-by-trial',
    title: 'Time to compute a trial',
    about: 'Median and quartiles over the runs, of searching the policy and of learning the model. Less than 10 ms is drawn as 10 ms.',
    legend: legendOf(campaign, style, { band: 0.16 }),
    panels: () => panelPriors(campaign).flatMap((prior) => [panel(prior, 'search_s', 'search'), panel(prior, 'model_s', 'model')]),
    table: () =>
      times.flatMap(({ part, learner, prior, variant, trials }) => trials.map((quartiles): Row => ({ learner, prior, variant, part, ...quartiles }))),
    minWidth: 260,
    columns: 4,
  }).element
}

function claims({ summary }: Campaign): Child {
  if (summary.claims.length === 0) return null
  const body = summary.claims.flatMap(({ text, result, parts }) => [
    h('tr', { class: 'claim' }, h('td', {}, badge(result)), h('th', { scope: 'row', colspan: 5 }, text)),
    ...parts.map((part) =>
      h(
        'tr',
        { class: 'part' },
        h('td', {}, parts.length > 1 ? badge(part.result) : null),
        h('td', {}, about(part)),
        h('td', {}, part.measure),
        h('td', { class: 'number' }, estimate(part)),
        h('td', {}, part.required),
        h('td', {}, `${number(part.runs)} of ${number(part.of)}`, part.reason ? h('small', {}, part.reason) : null),
      ),
    ),
  ])
  const columns = ['', 'Of', 'Measure', 'Estimate, 95 % interval', 'Required', 'Runs or pairs']
  const table = h(
    'table',
    { class: 'claims' },
    h('thead', {}, h('tr', {}, ...columns.map((name) => h('th', { scope: 'col' }, name)))),
    h('tbody', {}, ...body),
  )
  const rows = () =>
    summary.claims.flatMap(({ text, result, parts }) =>
      parts.map((part): Row => ({
        claim: text, claim_result: result, result: part.result, of: about(part), measure: part.measure, estimate: part.estimate, low: part.low,
        high: part.high, required: part.required, count: part.count, runs: part.runs, of_runs: part.of, reason: part.reason,
      })),
    )
  return tableFigure('claims-table', 'Do the claims hold?', 'A claim is undecided where its interval does not decide, or runs are missing.', rows, table)
}

function badge(result: ClaimPart['result']): HTMLElement {
  const sign = { pass: '✓', fail: '✗', undecided: '?' }[result]
  return h('span', { class: `badge ${result}` }, `${sign} ${result}`)
}

function groupText(learner: string, priors: string[], variants: string[]): string {
  return [learner, priors.filter(Boolean).join(' + '), variants.filter(Boolean).join(' + ')].filter(Boolean).join(', ')
}

function about(part: ClaimPart): string {
  const own = groupText(part.learner, part.priors, part.variants)
  return part.against ? `${own} against ${groupText(part.against.learner, part.against.priors, part.against.variants)}` : own
}

function estimate({ estimate, low, high, count }: ClaimPart): string {
  if (!present(estimate)) return '–'
  const counted = present(count) ? ` (${count})` : ''
  return present(low) || present(high) ? `${number(estimate, 3)}${counted} [${number(low, 3)}, ${number(high, 3)}]` : number(estimate, 3) + counted
}

function runs({ summary }: Campaign): Child {
  const varies = summary.variants.some((variant) => variant !== '')
  const columns = ['Run', 'Learner', 'Prior', ...(varies ? ['Variant'] : []), 'Seed', 'State', 'Trials', 'Solved in trial', 'Best return']
  const table = h(
    'table',
    {},
    h('thead', {}, h('tr', {}, ...columns.map((name) => h('th', { scope: 'col' }, name)))),
    h(
      'tbody',
      {},
      ...summary.runs.map((run) =>
        h(
          'tr',
          {},
          h('th', { scope: 'row' }, h('code', {}, run.run)),
          ...[run.learner, run.prior, ...(varies ? [run.variant] : [])].map((text) => h('td', {}, text)),
          h('td', { class: 'number' }, run.seed),
          h('td', {}, h('span', { class: `badge ${run.state}` }, run.state), run.reason ? h('small', {}, run.reason) : null),
          ...[run.trials, run.first_success, run.best_return].map((value) => h('td', { class: 'number' }, number(value))),
        ),
      ),
    ),
  )
  const rows = () => summary.runs.map((run): Row => ({ ...run }))
  return tableFigure('runs-table', 'All runs', 'One in detail: rehearse report FOLDER/runs/RUN', rows, table)
}

function quartilePoints({ trials }: Quartiles): Point[] {
  return trials.flatMap(({ trial, runs, quartile_1, median, quartile_3 }): Point[] =>
    present(median)
      ? [
          {
            x: trial,
            y: median,
            ...(present(quartile_1) && present(quartile_3) ? { band: [quartile_1, quartile_3] } : {}),
            tip: `trial ${trial}\nmedian ${number(median)}\nquartiles ${number(quartile_1)} … ${number(quartile_3)}\n${count(runs, 'run')}`,
          },
        ]
      : [],
  )
}

function prefixed(prefix: string, values: object | null): Row {
  return Object.fromEntries(Object.entries(values ?? {}).map(([name, value]: [string, Row[string]]) => [prefix + name, value]))
}
