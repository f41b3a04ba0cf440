import '../../design/tokens.css'
import './show.css'
import type { MotionDocument } from '../../playback/motion'
import { showMotion } from './motion_page'
import { type ShownData, unpackData } from './packed_data'

declare global {
  /** What the page's first script unpacked. */
  var mrlabData: ArrayBuffer | undefined
}

function start(data: ShownData): void {
  const view = document.getElementById('view')
  if (view === null) return
  showMotion(view, data.document as MotionDocument, data.meshes)
}

if (globalThis.mrlabData !== undefined) start(unpackData(globalThis.mrlabData))
