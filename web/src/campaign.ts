// The page of a campaign.
import { returns, success, times } from './campaign_figures'
import { parameters } from './campaign_parameters'
import { claims, runs } from './campaign_tables'
import type { Campaign, Report } from './data'
import { h, type Child } from './dom'
import { count, duration, number } from './format'
import { styles } from './groups'
import { head, problems, sections, tiles, type Tile } from './layout'

export function campaignPage(report: Report, campaign: Campaign): Child[] {
  const { scenario, seeds, title, trials } = campaign.summary
  const style = styles(campaign)
  return [
    head(title, `${scenario} · ${count(trials, 'trial')} a run · ${count(seeds.length, 'seed')}`),
    problems(report),
    h(
      'main',
      {},
      tiles(keyFigures(campaign)),
      missing(campaign),
      ...sections([
        { id: 'claims', title: 'Claims', content: [claims(campaign)] },
        { id: 'returns', title: 'Returns', content: [returns(campaign, style)] },
        { id: 'success', title: 'Success', content: [success(campaign, style)] },
        { id: 'identified', title: 'Parameters', content: [parameters(campaign, style)] },
        { id: 'time', title: 'Time', content: [times(campaign, style)] },
        { id: 'runs', title: 'Runs', content: [runs(campaign)] },
      ]),
    ),
  ]
}

function keyFigures({ summary, times }: Campaign): Tile[] {
  const { claims, complete, counts } = summary
  const passed = claims.filter(({ result }) => result === 'pass').length
  const seconds = times.flatMap(({ trials }) => trials).reduce((so, { median, runs }) => so + (median ?? 0) * runs, 0)
  return [
    {
      label: 'Runs done',
      value: `${number(counts.done)} of ${number(counts.runs)}`,
      note: complete ? 'complete' : 'not complete',
    },
    { label: 'Failed', value: number(counts.failed) },
    ...(claims.length > 0 ? [{ label: 'Claims that hold', value: `${passed} of ${claims.length}` }] : []),
    { label: 'Time to compute', value: `≈ ${duration(seconds)}`, note: 'of all runs together' },
  ]
}

function missing({ summary }: Campaign): Child {
  if (summary.missing.length === 0) return null
  const item = ({ learner, reason }: { learner: string; reason: string }) =>
    h('li', {}, h('strong', {}, learner), ` – ${reason}`)
  return h(
    'aside',
    { class: 'missing' },
    h('p', {}, 'Missing, because they are not built:'),
    h('ul', {}, ...summary.missing.map(item)),
  )
}
