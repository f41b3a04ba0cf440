import '../../design/tokens.css'
import './show.css'
import './class.css'
import type { MotionDocument } from '../../playback/motion'
import type { SessionDocument } from '../../playback/session'
import { isClass, showClass } from './class_page'
import { translate } from './german'
import { showMotion } from './motion_page'
import { type ShownData, unpackData } from './packed_data'
import { showSession } from './session_page'

declare global {
  /** What the page's first script unpacked. */
  var mrlabData: ArrayBuffer | undefined
}

function start(data: ShownData): void {
  if (isClass(data.document)) {
    showClass(data.document)
    return
  }
  if (navigator.language.startsWith('de')) translate(document.body)
  const view = document.getElementById('view')
  if (view === null) return
  const shown = data.document as MotionDocument | SessionDocument
  if (shown.schema === 'mrlab.session.1') showSession(view, shown, data.meshes)
  else showMotion(view, shown, data.meshes)
}

if (globalThis.mrlabData !== undefined) start(unpackData(globalThis.mrlabData))
