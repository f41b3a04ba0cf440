import { useEffect, useState } from 'preact/hooks'
import { Button } from '../../design/button'
import { Icon } from '../../design/icons'
import { fileSize, words } from '../../words/words'
import type { Stage, UploadFlow } from './flow'

const ORDER = ['sending', 'converting', 'loading'] as const
const SHOWN_AFTER_MS = 300

function label(stage: Stage): string {
  const w = words.value.upload.stages
  if (stage.kind === 'sending') return w.sending(Math.round(stage.share * 100))
  return stage.kind === 'idle' ? '' : w[stage.kind]
}

/** The progress of a file, and how to cancel it. It shows after 300 ms: most files are faster. */
export function Progress({ flow }: { flow: UploadFlow }) {
  const [shown, setShown] = useState(false)
  useEffect(() => {
    const timer = setTimeout(() => setShown(true), SHOWN_AFTER_MS)
    return () => clearTimeout(timer)
  }, [])
  const w = words.value
  const stage = flow.stage.value
  const file = flow.file.value
  const place = ORDER.indexOf(stage.kind as (typeof ORDER)[number])
  return (
    <section class="drop-zone upload-progress" aria-busy="true">
      {shown && (
        <>
          <p class="drop-title">{file?.name}</p>
          <p class="second small">{file && fileSize(file.size)}</p>
          <progress
            class="progress"
            max={1}
            value={stage.kind === 'sending' && stage.share < 1 ? stage.share : undefined}
            aria-label={label(stage)}
          />
          <p class="spoken" role="status">
            {stage.kind !== 'idle' && w.upload.stageNames[stage.kind]}
          </p>
          <ol class="upload-stages">
            {ORDER.map((kind, index) => (
              <li
                key={kind}
                class={index < place ? 'stage-done' : index === place ? 'stage-now' : 'stage-next'}
              >
                <Icon name={index < place ? 'check' : index === place ? 'ready' : 'circle'} />
                {index === place ? label(stage) : w.upload.stageNames[kind]}
              </li>
            ))}
          </ol>
          <Button onClick={() => flow.cancel()}>{w.cancel}</Button>
        </>
      )}
    </section>
  )
}
