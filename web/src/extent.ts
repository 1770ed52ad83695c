// The least and the largest of numbers, of which there may be more than a function takes arguments.

export function least(values: number[]): number {
  return values.reduce((a, b) => Math.min(a, b), Infinity)
}

export function largest(values: number[]): number {
  return values.reduce((a, b) => Math.max(a, b), -Infinity)
}
