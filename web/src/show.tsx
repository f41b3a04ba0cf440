import './design/styles'
import './design/plot/plot.css'
import './scene/stage/scene.css'
import './report/report.css'
import { render } from 'preact'
import type { Reports } from './flat_reports'
import { type ShownData, unpackData } from './report/packed_data'
import { followPrinting } from './report/page'
import { languages, setLanguage } from './words/words'

declare global {
  /** Data that the page's first script unpacked. */
  var mrlabData: ArrayBuffer | undefined
}

/** Return the first of the reader's languages that there is; a file keeps no choice. */
function preferred(): string {
  const known = languages()
  return (
    navigator.languages.map((tag) => tag.slice(0, 2)).find((tag) => known.includes(tag)) ?? 'en'
  )
}

/** Replace the still text, which is read without a script, by the report. It stays where there is
 * no report of the data's schema. */
export async function showReport(data: ShownData, reports: Reports): Promise<void> {
  const root = document.getElementById('report')
  const report = reports[data.document.schema]
  if (root === null || report === undefined) return
  await setLanguage(preferred(), false)
  const pictures = [...root.querySelectorAll<HTMLImageElement>('.poster img')].map((picture) => ({
    source: picture.src,
    text: picture.alt,
  }))
  root.replaceChildren()
  document.documentElement.dataset.shown = 'true'
  followPrinting()
  render(report(data, pictures), root)
}

/** Show the data that the page holds. */
export function start(reports: Reports): void {
  if (globalThis.mrlabData === undefined) return
  void showReport(unpackData(globalThis.mrlabData), reports)
}
