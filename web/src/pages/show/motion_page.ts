import type { MotionDocument } from '../../playback/motion'
import { type MeshBytes, MeshLibrary } from '../../scene/meshes'
import { createMotionPreview } from '../../scene/preview'
import { reducedMotion } from '../../scene/theme'
import { ENGLISH } from '../../scene/words'
import { words as de } from '../../words/de'
import { attachCursors } from './plots'

/** Put the 3D view into a page that shows one motion, and join it with plots and findings. */
export function showMotion(view: HTMLElement, motion: MotionDocument, bytes: MeshBytes): void {
  const meshes = new MeshLibrary(bytes)
  const words = navigator.language.startsWith('de') ? de.scene : ENGLISH
  const poster = document.querySelector<HTMLImageElement>('.poster img')?.src
  const preview = createMotionPreview(view, motion, {
    meshes,
    words,
    ...(poster === undefined ? {} : { poster }),
  })
  const chosen = (number: number) => {
    for (const entry of document.querySelectorAll<HTMLElement>('[data-finding]')) {
      entry.classList.toggle('chosen', Number(entry.dataset.finding) === number)
    }
  }
  const setCursors = attachCursors(preview.duration, (time) => preview.seek(time))
  preview.onTime(setCursors)
  preview.onSelect(chosen)
  for (const entry of document.querySelectorAll<HTMLElement>('[data-finding]')) {
    entry.addEventListener('click', () => {
      const number = Number(entry.dataset.finding)
      preview.select(number)
      chosen(number)
    })
  }
  const first = motion.findings.findIndex((one) => one.severity === 'error' && one.first_row > 0)
  if (motion.verdict === 'refused' && first >= 0) {
    preview.select(first + 1)
    chosen(first + 1)
  } else if (!reducedMotion()) {
    preview.ready.then(() => preview.play())
  }
  document.documentElement.dataset.shown = 'true'
  preview.ready.then(() => {
    document.documentElement.dataset.ready = 'true'
  })
}
