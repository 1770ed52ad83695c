import { present, type Cell } from './data'

const PLAIN_BELOW = 1e6
const COUNTS_BELOW = 1e9

/**
 * A number for people, on axes as in sentences and tables: 4 significant digits, thousands apart, and powers of ten
 * where it is small or large. Whole numbers below 10⁹ are counts, and shown whole.
 */
export function number(value: Cell | undefined, digits = 4): string {
  if (!present(value)) return '–'
  if (Number.isInteger(value) && Math.abs(value) < COUNTS_BELOW) return grouped(value)
  const rounded = Number(value.toPrecision(digits))
  const size = Math.abs(rounded)
  return size >= 1e-3 && size < PLAIN_BELOW ? grouped(rounded) : withPower(value, digits - 1)
}

/** A number that is neither small nor large, with all its digits and thousands apart. */
export function grouped(value: number): string {
  const [whole, ...part] = String(value).split('.')
  return [whole?.replace('-', '−').replaceAll(/\B(?=(\d{3})+$)/g, '\u202f'), ...part].join('.')
}

/** One power of ten with a factor from 1 to below 10: 5·10¹¹, and 10¹². */
export function withPower(value: number, digits: number): string {
  const [factor, exponent = ''] = value.toExponential(digits - 1).split('e')
  const power = '10' + [...exponent.replace('+', '')].map((c) => (c === '-' ? '⁻' : '⁰¹²³⁴⁵⁶⁷⁸⁹'[Number(c)])).join('')
  const short = String(Number(factor)).replace('-', '−')
  return short === '1' ? power : short === '−1' ? `−${power}` : `${short}·${power}`
}

export function percent(value: Cell): string {
  return present(value) ? `${Number((100 * value).toPrecision(3))} %` : '–'
}

export function duration(seconds: number): string {
  if (seconds < 1) return `${number(seconds, 2)} s`
  if (seconds < 99.5) return `${seconds.toFixed(seconds < 10 ? 1 : 0)} s`
  if (seconds < 99.5 * 60) return `${(seconds / 60).toFixed(0)} min`
  return `${(seconds / 3600).toFixed(1)} h`
}

export function count(n: number, noun: string): string {
  return `${number(n)} ${noun}${n === 1 ? '' : 's'}`
}
