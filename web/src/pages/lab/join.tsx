import { Dialog } from '../../design/dialog'
import { session } from '../../shell/session'
import { words } from '../../words/words'
import { LinkWithCode } from '../motion/lazy'

/** Return whether another device reaches this machine by a host name of the address bar. */
export function reachable(hostname: string): boolean {
  const host = hostname.replace(/^\[|\]$/g, '').toLowerCase()
  return !(/^127\./.test(host) || host === '::1' || /(^|\.)localhost$/.test(host))
}

/** The address of the lab for phones and headsets, or why there is none. */
export function Join({ onClose }: { onClose: () => void }) {
  const w = words.value.lab
  const here = location.hostname
  return (
    <Dialog title={w.join} onClose={onClose}>
      {reachable(here) ? (
        <div class="stack">
          <p>{session.value?.ways.password ? w.joinSignIn : w.joinOpen}</p>
          <LinkWithCode url={`${location.origin}/lab`} />
        </div>
      ) : (
        <div class="stack">
          <p>{w.joinNot(here)}</p>
          <p class="second small">{w.joinHow}</p>
          <pre class="lab-code">
            <code>{'mrlab keys init\nmrlab up --keys keys'}</code>
          </pre>
        </div>
      )}
    </Dialog>
  )
}
