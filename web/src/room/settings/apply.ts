import { effect } from '@preact/signals'
import { setContrast } from '../panels/pen'
import type { Visit } from '../session/visit'
import type { Settings } from './settings'

/** Keep the room as somebody chose it; returns how to end it. repaint: all panels. */
export function applySettings(settings: Settings, visit: Visit, repaint: () => void): () => void {
  const undo = [
    effect(() => {
      setContrast(settings.contrast.value)
      repaint()
    }),
    effect(() => visit.seat(settings.seated.value)),
    effect(() => visit.hide(settings.occlusion.value)),
  ]
  return () => {
    for (const each of undo) each()
  }
}
