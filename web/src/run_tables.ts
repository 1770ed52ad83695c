// Notes and options of a run.
import type { Run } from './data'
import { h, type Child } from './dom'
import { tableFigure } from './figure'

export function notes({ notes }: Run): Child {
  if (!notes?.trial.length) return null
  const rows = notes.trial.map((trial, i) => ({ trial, note: notes.note[i] ?? '' }))
  const all = [...new Set(rows.map(({ note }) => note))]
  const lines = all.map((note) => {
    const trials = rows.filter((row) => row.note === note).map(({ trial }) => trial)
    return h('tr', {}, h('td', {}, spans(trials)), h('td', {}, note))
  })
  return tableFigure({
    name: 'notes',
    title: 'Notes',
    columns: ['Trials', 'What happened'],
    lines,
    table: () => rows,
  })
}

/** Numbers in ascending order, those in a row as one: 1–3, 5. */
export function spans(numbers: number[]): string {
  const all: [number, number][] = []
  for (const value of [...new Set(numbers)].sort((a, b) => a - b)) {
    const last = all.at(-1)
    if (last && last[1] === value - 1) last[1] = value
    else all.push([value, value])
  }
  return all.map(([from, to]) => (from === to ? `${from}` : `${from}–${to}`)).join(', ')
}

export function options({ options }: Run): Child {
  if (options.length === 0) return null
  return h(
    'details',
    {},
    h('summary', {}, `All ${options.length} options of this run`),
    h(
      'div',
      { class: 'scroll', tabindex: 0, role: 'region', 'aria-label': 'Options' },
      h(
        'table',
        {},
        h(
          'tbody',
          {},
          ...options.map(([key, text]) =>
            h('tr', {}, h('th', { scope: 'row' }, h('code', {}, key)), h('td', {}, text)),
          ),
        ),
      ),
    ),
  )
}
