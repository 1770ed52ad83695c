// The page of one run, and that of one trial of it.
import { archiveFigures } from './archive'
import { present, type Cell, type Report, type Run } from './data'
import { h, type Child } from './dom'
import { count, duration, number } from './format'
import { beside, head, problems, sections, tiles, type Tile } from './layout'
import { limits } from './limits'
import { gaps, gapSentence } from './moments'
import { player } from './player'
import { rollouts, times } from './run_computing'
import { errors } from './run_errors'
import { evidence, keptParameters, parameters } from './run_model'
import { returns } from './run_returns'
import { robustness } from './run_robustness'
import { notes, options } from './run_tables'
import { bestRow } from './trials'

export function runPage(report: Report, run: Run): Child[] {
  return [
    head(title(run), subtitle(run), run.task),
    problems(report),
    h(
      'main',
      {},
      tiles(keyFigures(run)),
      ...sections([
        { id: 'returns', title: 'Returns', content: [returns(run), limits(run)] },
        { id: 'replay', title: 'Replay', content: [replay(run)] },
        { id: 'archive', title: 'The archive', content: archiveFigures(run) },
        { id: 'robustness', title: 'Robustness', content: [robustness(run)] },
        {
          id: 'model',
          title: 'The model',
          content: [errors(run), gaps(run), keptParameters(run), beside(parameters(run), evidence(run))],
        },
        { id: 'computing', title: 'Computing', content: [beside(times(run), rollouts(run)), notes(run)] },
        { id: 'options', title: 'Options', content: [options(run)] },
      ]),
    ),
  ]
}

export function replayPage(report: Report, run: Run): Child[] {
  const trial = run.episodes[0]?.trial ?? 1
  return [
    report.headline ? head(report.headline, '') : head(`${title(run)}: trial ${trial}`, subtitle(run)),
    problems(report),
    h('main', { class: 'replay' }, replay(run)),
  ]
}

function title(run: Run): string {
  return `${run.learner} on ${run.scenario}`
}

function subtitle(run: Run): string {
  const done = run.trials?.['trial']?.length ?? run.episodes.length
  const told = run.planned === 0 // one at a time: nobody said how many there will be
  const open = told ? `${count(done, 'trial')} so far` : `${done} of ${count(run.planned, 'trial')}, not complete`
  const state = run.done ? count(done, 'trial') : open
  return [run.prior ? `prior ${run.prior}` : 'no prior', `seed ${run.seed}`, state].join(' · ')
}

function keyFigures({ trials, timings }: Run): Tile[] {
  if (!trials) return []
  const at = (name: string, i: number) => trials[name]?.[i]
  const all = trials['return'] ?? []
  const solved = (trials['solved'] ?? []).findIndex((value) => value === 1)
  const best = bestRow(trials)
  const knowsSolved = (trials['solved'] ?? []).some(present)
  const seconds = sum(timings?.['model_s']) + sum(timings?.['search_s'])
  return [
    knowsSolved && {
      label: 'Solved',
      value: solved < 0 ? 'not yet' : `trial ${at('trial', solved)}`,
      ...(solved < 0 ? {} : { note: `after ${number(at('interaction_s', solved))} s on the robot` }),
    },
    all.length > 0 && { label: 'Best return', value: number(all[best]), note: `trial ${at('trial', best)}` },
    {
      label: 'Time on the robot',
      value: `${number(trials['interaction_s']?.at(-1) ?? 0)} s`,
      note: count(all.length, 'trial'),
    },
    timings && { label: 'Time to compute', value: duration(seconds) },
    {
      label: 'Simulated episodes',
      value: number(sum(trials['rollouts'])),
      note: `${number(sum(trials['failed_rollouts']))} failed`,
    },
  ].filter((tile): tile is Tile => Boolean(tile))
}

function replay(run: Run): Child {
  const usable = run.episodes.filter((episode) => episode.trajectory)
  const best = bestRow(run.trials ?? {}) + 1
  const start = usable.find(({ trial }) => trial === best) ?? usable[0]
  if (!start) return null
  return player(usable, start, (trial) => {
    const value = (name: string) => run.trials?.[name]?.[trial - 1]
    const predicted = present(value('predicted_return')) ? `, ${number(value('predicted_return'))} predicted` : ''
    const solved = value('solved')
    const verdict = present(solved) ? (solved === 1 ? ', solved' : ', not solved') : ''
    return `Return ${number(value('return'))}${predicted}${verdict}.${gapSentence(run, trial)}`
  })
}

function sum(cells: Cell[] | undefined): number {
  return (cells ?? []).reduce((so: number, value) => so + (value ?? 0), 0)
}
