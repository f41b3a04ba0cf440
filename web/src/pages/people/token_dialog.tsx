import { useState } from 'preact/hooks'
import type { Role } from '../../api/types'
import { Button } from '../../design/button'
import { Dialog } from '../../design/dialog'
import { Field, Select } from '../../design/field'
import { showToast } from '../../design/toast'
import { session, useApi } from '../../shell/session'
import { sentence } from '../../words/diagnostic'
import { words } from '../../words/words'
import { rolesUpTo } from '../account/approve'

const DAYS = ['1', '30', '90', '366'] as const

/** Makes a token for a program of the person who asks, and shows it once. */
export function TokenDialog({ onClose }: { onClose: () => void }) {
  const api = useApi()
  const own = session.value?.user?.role ?? 'display'
  const [program, setProgram] = useState('')
  const [role, setRole] = useState<Role>(own)
  const [days, setDays] = useState<string>('90')
  const [error, setError] = useState('')
  const [token, setToken] = useState('')
  const w = words.value.people
  const make = async (event: Event) => {
    event.preventDefault()
    setError('')
    try {
      setToken(await api.makeToken({ program: program.trim(), role, days: Number(days) }))
    } catch (problem) {
      setError(sentence(problem))
    }
  }
  if (token)
    return (
      <Dialog title={w.tokenFor(program.trim())} onClose={onClose}>
        <div class="stack">
          <p>{w.tokenExplanation}</p>
          <code class="token">{token}</code>
          <div class="dialog-actions">
            {navigator.clipboard && (
              <Button
                icon="copy"
                onClick={() => {
                  void navigator.clipboard
                    .writeText(token)
                    .then(() => showToast(words.value.copied))
                }}
              >
                {words.value.copy}
              </Button>
            )}
            <Button look="primary" onClick={onClose}>
              {words.value.close}
            </Button>
          </div>
        </div>
      </Dialog>
    )
  return (
    <Dialog title={w.addProgram} onClose={onClose}>
      <form class="stack" onSubmit={(event) => void make(event)}>
        <Field
          label={w.program}
          value={program}
          onInput={setProgram}
          error={error}
          autocomplete="off"
        />
        <Select
          label={words.value.pairing.as}
          value={role}
          onChange={(value) => setRole(value as Role)}
          options={rolesUpTo(own).map((each) => [each, words.value.roles[each]] as const)}
        />
        <Select
          label={w.goodFor}
          value={days}
          onChange={setDays}
          options={DAYS.map((each) => [each, w.days(Number(each))] as const)}
        />
        <div class="dialog-actions">
          <Button onClick={onClose}>{words.value.cancel}</Button>
          <Button look="primary" type="submit" disabled={program.trim() === ''}>
            {w.makeToken}
          </Button>
        </div>
      </form>
    </Dialog>
  )
}
