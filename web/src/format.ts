import { present, type Cell } from './data'

/** A number for people: 4 significant digits, no exponent where it can be avoided. */
export function number(value: Cell | undefined, digits = 4): string {
  if (!present(value)) return '–'
  return plain(value, digits).replace(/^-/, '−')
}

function plain(value: number, digits: number): string {
  const size = Math.abs(value)
  if (Number.isInteger(value) && size < 1e15) return value.toLocaleString('en').replaceAll(',', '\u202f')
  const extreme = size < 1e-3 || size >= 1e6
  return extreme ? value.toExponential(digits - 2) : String(Number(value.toPrecision(digits)))
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
