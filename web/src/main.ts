import './style.css'
import { campaignPage } from './campaign'
import type { Report } from './data'
import { h, type Child } from './dom'
import { replayPage, runPage } from './run'

const report = JSON.parse(document.getElementById('data')?.textContent ?? '') as Report

function page(): Child[] {
  if (report.campaign) return campaignPage(report, report.campaign)
  if (report.run) return runPage(report, report.run)
  if (report.replay) return replayPage(report, report.replay)
  return ['This page has no data: it is made by `rehearse report`.']
}

document.title = `${report.name} – Rehearse`
document.body.append(h('div', { class: 'page' }, ...page()))
