import { useEffect, useRef, useState } from 'preact/hooks'
import { showToast } from '../design/toast'
import { words } from '../words/words'

/** Take files that are dropped anywhere on the page; return whether one is over it now. */
export function useFileDrop(onFile: (file: File) => void): boolean {
  const [over, setOver] = useState(false)
  const take = useRef(onFile)
  take.current = onFile
  useEffect(() => {
    // dragenter and dragleave fire for every element below the pointer.
    let depth = 0
    const holdsFile = (event: DragEvent) => event.dataTransfer?.types.includes('Files') ?? false
    const onEnter = (event: DragEvent) => {
      if (!holdsFile(event)) return
      event.preventDefault()
      depth++
      setOver(true)
    }
    const onOver = (event: DragEvent) => {
      if (holdsFile(event)) event.preventDefault()
    }
    const onLeave = () => {
      depth = Math.max(depth - 1, 0)
      if (depth === 0) setOver(false)
    }
    const onDrop = (event: DragEvent) => {
      if (!holdsFile(event)) return
      event.preventDefault()
      depth = 0
      setOver(false)
      const files = event.dataTransfer?.files
      const file = files?.[0]
      if (file) take.current(file)
      if (files && files.length > 1) showToast(words.value.upload.onlyFirst(file?.name ?? ''))
    }
    const listeners = [
      ['dragenter', onEnter],
      ['dragover', onOver],
      ['dragleave', onLeave],
      ['drop', onDrop],
    ] as const
    for (const [name, listener] of listeners) document.addEventListener(name, listener)
    return () => {
      for (const [name, listener] of listeners) document.removeEventListener(name, listener)
    }
  }, [])
  return over
}
