import './design/styles'
import './design/plot/plot.css'
import './scene/stage/scene.css'
import './report/report.css'
import { render, type VNode } from 'preact'
import type { ClassDocument } from './classroom/class_document'
import { ClassReport } from './classroom/report'
import type { MotionDocument } from './playback/motion'
import type { SessionDocument, SessionFacts } from './playback/session'
import { type CheckFacts, CheckReport } from './report/check'
import type { Picture } from './report/findings'
import { MotionReport } from './report/motion'
import { type ShownData, unpackData } from './report/packed_data'
import { followPrinting } from './report/page'
import { SessionReport } from './report/session'
import { languages, setLanguage } from './words/words'

declare global {
  /** Data that the page's first script unpacked. */
  var mrlabData: ArrayBuffer | undefined
}

function reportOf({ document: data, meshes }: ShownData, pictures: Picture[]): VNode {
  const shown = data as
    | MotionDocument
    | (SessionDocument & { readonly check?: CheckFacts })
    | ClassDocument
  if (shown.schema === 'mrlab.motion.1') {
    return <MotionReport motion={shown} meshes={meshes} pictures={pictures} />
  }
  if (shown.schema === 'mrlab.class.1') return <ClassReport graded={shown} />
  if (shown.check) {
    return <CheckReport session={shown} check={shown.check} meshes={meshes} pictures={pictures} />
  }
  return <SessionReport session={shown} report={shown.report as SessionFacts} meshes={meshes} />
}

/** Return the first of the reader's languages that there is; a file keeps no choice. */
function preferred(): string {
  const known = languages()
  return (
    navigator.languages.map((tag) => tag.slice(0, 2)).find((tag) => known.includes(tag)) ?? 'en'
  )
}

/** Replace the static text, which is read without a script, by the report. */
async function start(data: ShownData): Promise<void> {
  const root = document.getElementById('report')
  if (root === null) return
  await setLanguage(preferred(), false)
  const pictures = [...root.querySelectorAll<HTMLImageElement>('.poster img')].map((picture) => ({
    source: picture.src,
    text: picture.alt,
  }))
  root.replaceChildren()
  document.documentElement.dataset.shown = 'true'
  followPrinting()
  render(reportOf(data, pictures), root)
}

if (globalThis.mrlabData !== undefined) void start(unpackData(globalThis.mrlabData))
