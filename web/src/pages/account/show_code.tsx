import { useEffect, useState } from 'preact/hooks'
import type { Pairing } from '../../api/types'
import { Button, ButtonLink } from '../../design/button'
import { Icon } from '../../design/icons'
import { Notice } from '../../design/notice'
import { navigate } from '../../shell/router'
import { session, useApi } from '../../shell/session'
import { sentence } from '../../words/diagnostic'
import { words } from '../../words/words'
import { QrCode } from '../motion/lazy'

/** ms between two requests that the gateway expects. */
const ASK_EVERY_MS = 2000

/** The page on a headset: code and QR, until a phone approves them. */
export function ShowCodePage() {
  const api = useApi()
  const [pairing, setPairing] = useState<Pairing | null>(null)
  const [left, setLeft] = useState(0)
  const [error, setError] = useState('')
  const w = words.value.pairing

  useEffect(() => {
    if (error) return
    let here = true
    let timer = 0
    let deadline = 0
    const begin = async () => {
      const begun = await api.startPairing()
      if (!here) return
      deadline = performance.now() + begun.expires_in * 1000
      setPairing(begun)
      setLeft(begun.expires_in)
      timer = window.setTimeout(() => void ask(begun), ASK_EVERY_MS)
    }
    const ask = async (begun: Pairing) => {
      try {
        const { state } = await api.pairing(begun.secret)
        if (!here) return
        if (state === 'approved') {
          session.value = await api.session()
          navigate('/lab', 'replace')
        } else if (state === 'expired') await begin()
        else {
          setLeft(Math.max((deadline - performance.now()) / 1000, 0))
          timer = window.setTimeout(() => void ask(begun), ASK_EVERY_MS)
        }
      } catch (problem) {
        if (here) setError(sentence(problem))
      }
    }
    begin().catch((problem: unknown) => here && setError(sentence(problem)))
    return () => {
      here = false
      clearTimeout(timer)
    }
  }, [api, error])

  return (
    <section class="card pair-card">
      <div class="stack">
        <h1>{w.showTitle}</h1>
        <ol class="pair-steps">
          <li>{w.stepScan}</li>
          <li>{w.stepCompare}</li>
          <li>{w.stepWait}</li>
        </ol>
        {error ? (
          <Notice severity="error">
            <p>{error}</p>
            <Button onClick={() => setError('')}>{words.value.retry}</Button>
          </Notice>
        ) : (
          pairing && (
            <>
              <p class="pair-code" data-testid="code">
                {pairing.code}
              </p>
              <p class="second small">
                <Icon name="headset" /> {w.goodFor(Math.ceil(left))}
              </p>
            </>
          )
        )}
        <p>
          <ButtonLink look="quiet" href="/sign-in">
            {w.withPassword}
          </ButtonLink>
        </p>
      </div>
      {pairing && !error && <QrCode text={pairing.url} label={words.value.qrCode(pairing.url)} />}
    </section>
  )
}
