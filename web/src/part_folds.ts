// The panels of a robot with many states, by its body parts: those that the model got most wrong first, the rest folded.
import { variables, type Episode } from './data'
import type { Fold } from './folds'
import { count, percent } from './format'
import type { Panel } from './panels'
import { partsOf, positionOf, TWO_SCREENS, type Part } from './parts'
import type { ByState } from './ranges'

export interface StatePanel extends Panel {
  /** The state, or another variable, that it shows. */
  of: string
}

/** An error, as a part of the range, that is none to speak of. */
const LITTLE = 0.001

/** The parts of a robot whose panels would fill more than two screens; none of other robots. */
export function partsOfRobot(episodes: Episode[]): Part[] {
  const trajectory = episodes.find((episode) => episode.trajectory)?.trajectory
  if (!trajectory) return []
  const { states, actions } = variables(trajectory)
  const parts = partsOf(
    states.map(({ name }) => name),
    [...actions.map(({ name }) => name), 'reward'],
  )
  return states.length + actions.length + 1 > TWO_SCREENS && parts.length > 1 ? parts : []
}

/**
 * A fold a part. The worst stand open: the first, and the next as long as all that is open fits two screens. errors: of each
 * state, relative to its range; empty: of a trial that was not predicted.
 */
export function partFolds(parts: Part[], panels: StatePanel[], errors: ByState): Fold[] {
  const wrong = (part: Part) => meanError(part, errors) ?? -1
  let shown = 0
  return [...parts]
    .sort((a, b) => wrong(b) - wrong(a))
    .flatMap((part): Fold[] => {
      const own = panels.filter((panel) => [...part.states, ...part.others].includes(panel.of))
      if (own.length === 0) return []
      const open = shown === 0 || shown + own.length <= TWO_SCREENS
      shown += own.length
      const title = part.name || 'the robot as a whole'
      return [{ title, about: `${contents(part, own)}. ${wrongness(part, errors)}`, open, panels: own }]
    })
}

/** "coxa, femur, tibia, their rates, 3 actions", of what is shown. */
function contents({ name, states, others }: Part, panels: StatePanel[]): string {
  const shown = (names: string[]) => names.filter((one) => panels.some(({ of }) => of === one))
  const short = (one: string) => (one.startsWith(`${name} `) ? one.slice(name.length + 1) : one)
  const isRate = (one: string) => positionOf(one, states) !== undefined
  const rates = shown(states.filter(isRate)).length
  const actions = shown(others.filter((one) => one !== 'reward')).length
  return [
    ...shown(states.filter((one) => !isRate(one))).map(short),
    ...(rates > 0 ? [rates > 1 ? 'their rates' : 'its rate'] : []),
    ...(actions > 0 ? [count(actions, 'action')] : []),
    ...(shown(others).includes('reward') ? ['reward'] : []),
  ].join(', ')
}

function wrongness(part: Part, errors: ByState): string {
  const mean = meanError(part, errors)
  const [worst, most] = known(part, errors).reduce((a, b) => (b[1] > a[1] ? b : a), ['', -1])
  if (mean === undefined) return 'There is no prediction.'
  const average = `The model is off by ${share(mean)} of the range on average`
  return most < LITTLE ? `${average}.` : `${average}, by most for ${worst}: ${share(most)}.`
}

function share(error: number): string {
  if (error >= 1) return '100 % or more'
  return error < LITTLE ? `less than ${percent(LITTLE)}` : percent(Number(error.toPrecision(2)))
}

function known({ states }: Part, errors: ByState): [state: string, error: number][] {
  return states.flatMap((name): [string, number][] => {
    const error = errors.get(name)
    return error === undefined ? [] : [[name, error]]
  })
}

function meanError(part: Part, errors: ByState): number | undefined {
  const all = known(part, errors)
  return all.length > 0 ? all.reduce((sum, [, error]) => sum + error, 0) / all.length : undefined
}
