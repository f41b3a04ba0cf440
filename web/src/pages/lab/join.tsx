import { Dialog } from '../../design/dialog'
import { session } from '../../shell/session'
import { words } from '../../words/words'
import { LinkWithCode } from '../motion/lazy'

/** The address of the lab for phones and headsets. */
export function Join({ onClose }: { onClose: () => void }) {
  const w = words.value.lab
  return (
    <Dialog title={w.join} onClose={onClose}>
      <div class="stack">
        <p>{session.value?.ways.password ? w.joinSignIn : w.joinOpen}</p>
        <LinkWithCode path="/lab" />
      </div>
    </Dialog>
  )
}
