// Body parts of a robot, recognised by the names of its states and actions (docs/report.md#many-states).

export interface Part {
  /** The part's name within its variables' names; '' for the robot as a whole. */
  name: string
  /** States in the robot's order; others: actions, the reward. */
  states: string[]
  others: string[]
}

/** The number of panels on about two screens: four rows of two beside the robot's picture, 900 px high, are one. */
export const TWO_SCREENS = 16

/** The state whose rate this is, by its name: of `d knee`, `d_knee` and `dknee` it is `knee`. */
export function positionOf(name: string, states: readonly string[]): string | undefined {
  const position = /^d[ _]?(.+)$/.exec(name)?.[1]
  return position !== undefined && states.includes(position) ? position : undefined
}

/**
 * Every state and every other variable (actions, the reward) is in one part. Names that begin with the same word are of one
 * part, and so are names of one word that end in the same number (q1, dq1, torque1). But a part moves: one of its states has
 * its rate beside it, or an action is named alike. All else is of the robot as a whole, which stands last.
 */
export function partsOf(states: readonly string[], others: readonly string[]): Part[] {
  const all = [...states, ...others]
  const words: Words = new Map(all.map((name) => [name, wordsOf(stemOf(name, states))]))
  const part = (name: string, members: string[]): Part => ({
    name,
    states: members.filter((member) => states.includes(member)),
    others: members.filter((member) => others.includes(member)),
  })
  const moves = ({ name, ...its }: Part) =>
    name !== '' && its.states.length > 0 && (its.others.length > 0 || its.states.some((one) => positionOf(one, states)))
  const parts = grouped(all, words, 1)
    .map(([name, members]) => part(name, members))
    .filter(moves)
  const taken = new Set(parts.flatMap((one) => [...one.states, ...one.others]))
  const left = all.filter((name) => !taken.has(name))
  return left.length > 0 ? [...parts, part('', left)] : parts
}

/** The state that a variable is about: `knee` of `d knee` and of its action `knee target`. */
function stemOf(name: string, states: readonly string[]): string {
  const position = positionOf(name, states) ?? name
  const about = states.filter((state) => position.startsWith(`${state} `) || position.startsWith(`${state}_`))
  return about.sort((a, b) => a.length - b.length)[0] ?? position
}

function wordsOf(name: string): string[] {
  return name.split(/[\s_./:]+/).filter((word) => word !== '')
}

type Words = Map<string, string[]>

/** Groups names by their first `depth` words; by one more where a group has more than fits. */
function grouped(names: string[], words: Words, depth: number): [name: string, members: string[]][] {
  const groups = new Map<string, string[]>()
  for (const name of names) {
    const key = keyOf(words.get(name) ?? [], depth)
    groups.set(key, [...(groups.get(key) ?? []), name])
  }
  return [...groups].flatMap(([key, members]): [string, string[]][] => {
    const deeper = members.some((member) => (words.get(member)?.length ?? 0) > depth + 1)
    if (key !== '' && members.length > TWO_SCREENS && deeper) return grouped(members, words, depth + 1)
    return [[labelOf(key, members, words), members]]
  })
}

/** '' where there is none. */
function keyOf(words: string[], depth: number): string {
  const number = /^\D*(\d+)$/.exec(words.join(''))?.[1]
  if (number !== undefined && words.length <= 2) return `#${number}`
  return words.length > depth ? words.slice(0, depth).join(' ') : ''
}

/** The label of a part; one with a number alone is called by its first variable. */
function labelOf(key: string, members: string[], words: Words): string {
  return key.startsWith('#') ? (words.get(members[0] ?? '') ?? []).join(' ') : key
}
