import { useEffect, useState } from 'preact/hooks'
import type { Device } from '../../api/types'
import { Button, ButtonLink } from '../../design/button'
import { Icon } from '../../design/icons'
import { Notice } from '../../design/notice'
import { showToast } from '../../design/toast'
import { session, useApi } from '../../shell/session'
import { sentence } from '../../words/diagnostic'
import { dateTime, words } from '../../words/words'
import { TokenDialog } from './token_dialog'

/** Headsets, programs and browsers that are signed in; ending one closes its connection at once. */
export function Devices() {
  const api = useApi()
  const [devices, setDevices] = useState<readonly Device[] | null>(null)
  const [error, setError] = useState('')
  const [adding, setAdding] = useState(false)
  const w = words.value.people
  const load = () => {
    api
      .devices()
      .then(setDevices)
      .catch((problem: unknown) => setError(sentence(problem)))
  }
  useEffect(load, [api])
  const revoke = async (device: Device) => {
    try {
      await api.revokeDevice(device.id)
      showToast(w.revoked(device.name))
    } catch (problem) {
      showToast(sentence(problem))
    }
    load()
  }
  return (
    <section class="card stack" aria-labelledby="devices">
      <div class="row">
        <h2 id="devices" class="grow">
          {w.devices}
        </h2>
        <Button icon="link" onClick={() => setAdding(true)}>
          {w.addProgram}
        </Button>
        {session.value?.ways.pairing && (
          <ButtonLink icon="headset" href="/pair">
            {words.value.nav.pair}
          </ButtonLink>
        )}
      </div>
      {adding && (
        <TokenDialog
          onClose={() => {
            setAdding(false)
            load()
          }}
        />
      )}
      {error && (
        <Notice severity="error">
          <p>{error}</p>
        </Notice>
      )}
      {devices?.length === 0 && <p class="second">{w.noDevices}</p>}
      <ul class="devices">
        {devices?.map((device) => (
          <li key={device.id} data-device={device.name}>
            <Icon name={device.name === 'browser' ? 'person' : 'headset'} />
            <div class="grow">
              <strong>{device.name === 'browser' ? w.browser : device.name}</strong>
              {device.this && <span class="chip chip-plain device-this">{w.thisOne}</span>}
              <p class="second small">
                {device.approved_by}, {words.value.roles[device.role]} ·{' '}
                {w.lastSeen(dateTime(device.last_seen))} · {w.until(dateTime(device.expires))}
              </p>
            </div>
            {!device.this && (
              <Button look="danger" onClick={() => void revoke(device)}>
                {w.revoke}
              </Button>
            )}
          </li>
        ))}
      </ul>
    </section>
  )
}
