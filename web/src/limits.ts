// Limits of the task: how often each trial's policy was expected to break them, and whether the trial did.
import { present, type Cell, type Columns, type Run } from './data'
import { h, type Child } from './dom'
import { tableFigure } from './figure'
import { count, percent } from './format'
import { rowsOf } from './trials'

export function limits({ limits }: Run): Child {
  if (!limits?.numbers['trial']?.length) return null
  const { names, numbers } = limits
  const at = (column: string, i: number) => numbers[column]?.[i] ?? null
  const risk = (i: number) => {
    if (!present(at('predicted_risk', i))) return 'not known'
    return `${percent(at('predicted_risk', i))} (${percent(at('low', i))} to ${percent(at('high', i))})`
  }
  const lines = names.map((name, i) =>
    h(
      'tr',
      {},
      h('td', {}, at('trial', i)),
      h('td', {}, name),
      h('td', {}, percent(at('allowed_risk', i))),
      h('td', {}, risk(i)),
      h('td', {}, outcome(at('broken', i))),
    ),
  )
  return tableFigure({
    name: 'limits',
    title: 'Limits',
    about: `${sentence(numbers)} In brackets the 95 % interval, of simulated episodes of the policy.`,
    columns: ['Trial', 'Limit', 'Allowed risk', 'Predicted risk', 'On the robot'],
    lines,
    table: () =>
      rowsOf(numbers, ['trial', 'allowed_risk', 'predicted_risk', 'low', 'high', 'broken']).map((row, i) => ({
        ...row,
        limit: names[i] ?? '',
      })),
  })
}

/** An episode that was told may have gone on behind the step that broke the limit: nobody stopped that robot. */
export function outcome(broken: Cell): string {
  return broken === 1 ? 'broken, the trial counts up to there' : 'kept'
}

/** Predicted against observed, by trials. */
function sentence(numbers: Columns): string {
  const trials = new Map<number, { safe: boolean; broken: boolean }>()
  numbers['trial']?.forEach((trial, i) => {
    const [high, allowed] = [numbers['high']?.[i], numbers['allowed_risk']?.[i]]
    const safe = present(high) && present(allowed) && high <= allowed
    const before = trials.get(trial ?? 0) ?? { safe: true, broken: false }
    trials.set(trial ?? 0, { safe: before.safe && safe, broken: before.broken || numbers['broken']?.[i] === 1 })
  })
  const all = [...trials.values()]
  const [safe, others] = [all.filter((trial) => trial.safe), all.filter((trial) => !trial.safe)]
  const broke = (some: typeof all) => some.filter((trial) => trial.broken).length
  return (
    `Of ${count(safe.length, 'trial')} that were expected to be safe, ${broke(safe)} broke a limit; ` +
    `of the ${count(others.length, 'other')}, ${broke(others)}.`
  )
}
