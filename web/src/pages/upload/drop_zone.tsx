import { useRef } from 'preact/hooks'
import { Button } from '../../design/button'
import { Icon } from '../../design/icons'
import { showToast } from '../../design/toast'
import { sentence } from '../../words/diagnostic'
import { words } from '../../words/words'
import { exampleFile } from '../motion/example'

const ACCEPTED = '.mat,.m,.csv,.txt,.npz,.npy,.json,.yaml,.mcap,.db3,.cdr,.gz'

interface DropZoneProps {
  over: boolean
  onFile: (file: File) => void
}

export function DropZone({ over, onFile }: DropZoneProps) {
  const input = useRef<HTMLInputElement>(null)
  const w = words.value.upload
  const tryExample = async () => {
    try {
      onFile(await exampleFile())
    } catch (error) {
      showToast(sentence(error))
    }
  }
  return (
    <section class={`drop-zone${over ? ' drop-zone-over' : ''}`} aria-label={w.drop}>
      <svg class="drop-picture" viewBox="0 0 200 96" aria-hidden="true">
        <path class="drop-line line-a" d="M4 74C40 74 44 22 82 22s40 52 114 40" />
        <path class="drop-line line-b" d="M4 40c44 0 54 44 92 44s52-62 100-62" />
        <path class="drop-line line-c" d="M4 60c34-34 66-34 96 0s66 26 96 18" />
      </svg>
      <p class="drop-title">{over ? w.dropHere : w.drop}</p>
      <p class="second small">{w.formats}</p>
      <div class="row drop-buttons">
        <Button look="primary" icon="upload" onClick={() => input.current?.click()}>
          {w.chooseFile}
        </Button>
        <Button look="quiet" onClick={() => void tryExample()}>
          <Icon name="play" />
          {w.tryExample}
        </Button>
      </div>
      <input
        ref={input}
        hidden
        type="file"
        accept={ACCEPTED}
        onChange={(event) => {
          const file = event.currentTarget.files?.[0]
          // The same file can be chosen again once it was changed.
          if (file) onFile(file)
          event.currentTarget.value = ''
        }}
      />
    </section>
  )
}
