import { encode } from 'uqr'
import { Button } from '../../design/button'
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

/** An address to open, copy or scan. */
export function LinkWithCode({ url }: { url: string }) {
  const w = words.value
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
