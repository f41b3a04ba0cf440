import { useState } from 'preact/hooks'
import { encode } from 'uqr'
import { Button } from '../../design/button'
import { Field } from '../../design/field'
import { showToast } from '../../design/toast'
import { words } from '../../words/words'
import './motion.css'

const BORDER = 2

/** Return the dark squares of a QR code as one path, and its size. */
function codePath(text: string): { path: string; size: number } {
  const { data, size } = encode(text, { ecc: 'M', border: BORDER })
  let path = ''
  data.forEach((row, y) => {
    row.forEach((dark, x) => {
      if (dark) path += `M${x} ${y}h1v1h-1z`
    })
  })
  return { path, size }
}

export function QrCode({ text, label }: { text: string; label: string }) {
  const { path, size } = codePath(text)
  return (
    <svg class="qr" viewBox={`0 0 ${size} ${size}`} role="img" aria-label={label}>
      <path class="qr-light" d={`M0 0h${size}v${size}H0z`} />
      <path class="qr-dark" d={path} />
    </svg>
  )
}

const KEY = 'mrlab.address'

/** Return whether another device reaches this machine by a host name of the address bar. */
export function reachable(hostname: string): boolean {
  const host = hostname.replace(/^\[|\]$/g, '').toLowerCase()
  return !(/^127\./.test(host) || host === '::1' || /(^|\.)localhost$/.test(host))
}

/** Return the origin of an address that others reach, such as https://lab.example:8765; empty: it
 * is none. */
export function originOf(text: string): string {
  const wanted = /^https?:\/\//.test(text) ? text : `${location.protocol}//${text}`
  if (text === '' || !URL.canParse(wanted)) return ''
  const { origin, hostname } = new URL(wanted)
  return reachable(hostname) ? origin : ''
}

/** Why an address of this machine alone opens nowhere else, and the address that does. */
function Elsewhere({ url, onFound }: { url: string; onFound: (origin: string) => void }) {
  const w = words.value.lab
  const [text, setText] = useState('')
  const save = (event: Event) => {
    event.preventDefault()
    localStorage.setItem(KEY, originOf(text))
    onFound(originOf(text))
  }
  return (
    <form class="stack-8 grow" onSubmit={save}>
      <a href={url} class="small">
        {url}
      </a>
      <p class="small">{w.joinNot(new URL(url).hostname)}</p>
      <p class="second small">{w.joinHow}</p>
      {/* biome-ignore lint/a11y/noNoninteractiveTabindex: it scrolls */}
      <pre class="code-block" tabIndex={0}>
        <code>{'mrlab keys init\nmrlab up --keys keys'}</code>
      </pre>
      <Field label={w.address} value={text} onInput={setText} placeholder="https://…:8765" />
      <Button type="submit" disabled={originOf(text) === ''}>
        {w.takeAddress}
      </Button>
    </form>
  )
}

interface LinkProps {
  /** Path of the page. */
  readonly path: string
  /** By default that of this page. */
  readonly origin?: string
}

/** An address to open, copy or scan. One that is this machine alone is asked for once. */
export function LinkWithCode({ path, origin = location.origin }: LinkProps) {
  const w = words.value
  const [known, setKnown] = useState(localStorage.getItem(KEY) ?? '')
  const given = new URL(origin)
  if (!reachable(given.hostname) && known === '')
    return <Elsewhere url={origin + path} onFound={setKnown} />
  const url = (reachable(given.hostname) ? origin : known) + path
  return (
    <div class="link-with-code">
      <QrCode text={url} label={w.qrCode(url)} />
      <div class="stack-8 grow">
        <a href={url} class="small">
          {url}
        </a>
        {navigator.clipboard && (
          <Button
            icon="copy"
            onClick={() => {
              void navigator.clipboard.writeText(url).then(() => showToast(words.value.copied))
            }}
          >
            {w.copyLink}
          </Button>
        )}
      </div>
    </div>
  )
}
