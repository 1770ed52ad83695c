// Claims and runs.
import { present, type Campaign, type CampaignRun, type ClaimPart } from './data'
import { h, type Child } from './dom'
import type { Row } from './export'
import { tableFigure } from './figure'
import { number } from './format'

export function claims({ summary }: Campaign): Child {
  if (summary.claims.length === 0) return null
  return tableFigure({
    name: 'claims-table',
    title: 'Do the claims hold?',
    about: 'A claim is undecided where its interval does not decide, or runs are missing.',
    columns: ['', 'Of', 'Measure', 'Estimate, 95 % interval', 'Required', 'Runs or pairs'],
    lines: summary.claims.flatMap(({ text, result, parts }) => [
      h('tr', { class: 'claim' }, h('td', {}, verdict(result)), h('th', { scope: 'row', colspan: 5 }, text)),
      ...parts.map((part) => partLine(part, parts.length > 1)),
    ]),
    table: () => summary.claims.flatMap(({ text, parts }) => parts.map((part) => ({ claim: text, ...partRow(part) }))),
  })
}

function partLine(part: ClaimPart, withVerdict: boolean): HTMLElement {
  return h(
    'tr',
    {},
    h('td', {}, withVerdict ? verdict(part.result) : null),
    h('td', {}, about(part)),
    h('td', {}, part.measure),
    h('td', { class: 'number' }, estimate(part)),
    h('td', {}, part.required),
    h('td', {}, `${number(part.runs)} of ${number(part.of)}`, part.reason ? h('small', {}, part.reason) : null),
  )
}

function partRow(part: ClaimPart): Row {
  const { result, measure, estimate, low, high, required, count, runs, of, reason } = part
  return { result, of: about(part), measure, estimate, low, high, required, count, runs, of_runs: of, reason }
}

function verdict(result: ClaimPart['result']): HTMLElement {
  const sign = { pass: '✓', fail: '✗', undecided: '?' }[result]
  return h('span', { class: `badge ${result}` }, `${sign} ${result}`)
}

interface Subject {
  learner: string
  priors: string[]
  variants: string[]
}

function about(part: ClaimPart): string {
  const text = ({ learner, priors, variants }: Subject) =>
    [learner, priors.filter(Boolean).join(' + '), variants.filter(Boolean).join(' + ')].filter(Boolean).join(', ')
  return part.against ? `${text(part)} against ${text(part.against)}` : text(part)
}

function estimate({ estimate, low, high, count }: ClaimPart): string {
  if (!present(estimate)) return '–'
  const value = number(estimate, 3) + (present(count) ? ` (${count})` : '')
  return present(low) || present(high) ? `${value} [${number(low, 3)}, ${number(high, 3)}]` : value
}

export function runs({ summary }: Campaign): Child {
  const varies = summary.variants.some((variant) => variant !== '')
  const names = ['Run', 'Learner', 'Prior', ...(varies ? ['Variant'] : [])]
  return tableFigure({
    name: 'runs-table',
    title: 'All runs',
    about: 'One in detail: rehearse report FOLDER/runs/RUN',
    columns: [...names, 'Seed', 'State', 'Trials', 'Solved in trial', 'Best return'],
    lines: summary.runs.map((run) => runLine(run, varies)),
    table: () => summary.runs.map((run): Row => ({ ...run })),
  })
}

function runLine(run: CampaignRun, varies: boolean): HTMLElement {
  const texts = [run.learner, run.prior, ...(varies ? [run.variant] : [])]
  const numbers = [run.trials, run.first_success, run.best_return]
  const state = h('span', { class: `badge ${run.state}` }, run.state)
  return h(
    'tr',
    {},
    h('th', { scope: 'row' }, h('code', {}, run.run)),
    ...texts.map((text) => h('td', {}, text)),
    h('td', { class: 'number' }, run.seed),
    h('td', {}, state, run.reason ? h('small', {}, run.reason) : null),
    ...numbers.map((value) => h('td', { class: 'number' }, number(value))),
  )
}
