// Notes and options of a run.
import type { Run } from './data'
import { h, type Child } from './dom'
import { tableFigure } from './figure'

export function notes({ notes }: Run): Child {
  if (!notes?.trial.length) return null
  const rows = notes.trial.map((trial, i) => ({ trial, note: notes.note[i] ?? '' }))
  const lines = rows.map(({ trial, note }) => h('tr', {}, h('td', {}, trial), h('td', {}, note)))
  return tableFigure({
    name: 'notes',
    title: 'Notes',
    columns: ['Trial', 'What happened'],
    lines,
    table: () => rows,
  })
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
