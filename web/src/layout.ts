// Common parts of both kinds of page: the head, the theme, problems, key figures, sections.
import type { Report } from './data'
import { h, type Child } from './dom'
import { count } from './format'

/** lead: a sentence under them. */
export function head(title: string, subtitle: Child, lead = ''): HTMLElement {
  return h(
    'header',
    {},
    h(
      'div',
      { class: 'title' },
      h('h1', {}, title),
      h('p', { class: 'subtitle' }, subtitle),
      lead ? h('p', { class: 'lead' }, lead) : null,
    ),
    themeButton(),
  )
}

/** Starts with what the reader's system prefers. */
function themeButton(): HTMLElement {
  const prefersDark = matchMedia('(prefers-color-scheme: dark)')
  const isDark = () =>
    (document.documentElement.dataset['theme'] ?? (prefersDark.matches ? 'dark' : 'light')) === 'dark'
  const button = h('button', { type: 'button', class: 'theme', onclick: () => set(isDark() ? 'light' : 'dark') })
  function set(theme?: string) {
    if (theme) document.documentElement.dataset['theme'] = theme
    button.textContent = isDark() ? 'Light' : 'Dark'
    button.setAttribute('aria-label', `Change to the ${isDark() ? 'light' : 'dark'} page`)
  }
  set()
  prefersDark.addEventListener('change', () => set())
  return button
}

export function problems(report: Report): HTMLElement | null {
  if (report.problems.length === 0) return null
  return h(
    'section',
    { class: 'problems', 'aria-label': 'Problems' },
    h('h2', {}, count(report.problems.length, 'problem')),
    h('ul', {}, ...report.problems.map(({ where, what }) => h('li', {}, h('code', {}, where), ' – ', what))),
  )
}

export interface Tile {
  label: string
  value: string
  note?: string
}

export function tiles(all: Tile[]): HTMLElement {
  return h(
    'dl',
    { class: 'tiles' },
    ...all.map(({ label, value, note }) =>
      h('div', {}, h('dt', {}, label), h('dd', {}, value, note ? h('small', {}, note) : null)),
    ),
  )
}

export interface Section {
  id: string
  title: string
  content: Child[]
}

/** The sections that have something to show, and links to them. */
export function sections(all: Section[]): HTMLElement[] {
  const shown = all.filter(({ content }) => content.some((child) => child))
  return [
    h('nav', { 'aria-label': 'Sections' }, ...shown.map(({ id, title }) => h('a', { href: `#${id}` }, title))),
    ...shown.map(({ id, title, content }) => h('section', { id }, h('h2', {}, title), ...content)),
  ]
}

/** Figures side by side where there is room. */
export function beside(...figures: Child[]): Child {
  return figures.some((child) => child) && h('div', { class: 'beside' }, ...figures)
}

/** A choice of one, as radio buttons. */
export function choice(
  label: string,
  options: [value: string, text: string][],
  chosen: (value: string) => void,
): HTMLElement {
  const name = `choice-${label.toLowerCase().replaceAll(/\W+/g, '-')}`
  return h(
    'fieldset',
    { class: 'choice' },
    h('legend', {}, label),
    ...options.map(([value, text], i) =>
      h('label', {}, h('input', { type: 'radio', name, value, checked: i === 0, onchange: () => chosen(value) }), text),
    ),
  )
}
