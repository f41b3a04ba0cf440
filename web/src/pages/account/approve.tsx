import { useEffect, useState } from 'preact/hooks'
import type { PairingDevice, Role } from '../../api/types'
import { Button, ButtonLink } from '../../design/button'
import { Field, Select } from '../../design/field'
import { Icon } from '../../design/icons'
import { session, useApi } from '../../shell/session'
import { sentence } from '../../words/diagnostic'
import { words } from '../../words/words'

/** Roles, the one with the fewest rights first. */
const ORDER: readonly Role[] = ['display', 'student', 'operator', 'instructor']

/** Letters of a code. */
const LENGTH = 8

/** Return the roles that a person may give to a device: none above their own. */
export function rolesUpTo(own: Role): readonly Role[] {
  return ORDER.slice(0, ORDER.indexOf(own) + 1)
}

/** Return the role that is proposed: programs play robots, which an operator may. */
export function proposedRole(own: Role, program: boolean): Role {
  const wanted = program ? 'operator' : 'student'
  return rolesUpTo(own).includes(wanted) ? wanted : own
}

/** Return a code as the headset shows it, such as BCDF-GHJK; an incomplete code stays as it is. */
export function codeForm(text: string): string {
  const plain = text.toUpperCase().replace(/[^A-Z0-9]/g, '')
  return plain.length === LENGTH
    ? `${plain.slice(0, LENGTH / 2)}-${plain.slice(LENGTH / 2)}`
    : text
}

/** The form with which a signed-in person approves the device that shows this code. */
export function ApprovePage({ code: given }: { code: string }) {
  const api = useApi()
  const own = session.value?.user?.role ?? 'student'
  const [code, setCode] = useState(codeForm(given))
  const [role, setRole] = useState<Role>(proposedRole(own, false))
  const [found, setFound] = useState<PairingDevice | null>(null)
  const [error, setError] = useState('')
  const [device, setDevice] = useState('')
  const [busy, setBusy] = useState(false)
  const w = words.value.pairing
  const plain = code.replace(/[^A-Z0-9]/g, '')
  useEffect(() => {
    setFound(null)
    if (plain.length !== LENGTH) return
    let here = true
    api.pairingDevice(plain).then(
      (shown) => {
        if (!here) return
        setFound(shown)
        setRole(proposedRole(own, shown.program))
      },
      (problem: unknown) => here && setError(sentence(problem)),
    )
    return () => {
      here = false
    }
  }, [api, plain, own])
  const approve = async (event: Event) => {
    event.preventDefault()
    setBusy(true)
    setError('')
    try {
      setDevice(await api.approvePairing(code.trim(), role))
    } catch (problem) {
      setError(sentence(problem))
    } finally {
      setBusy(false)
    }
  }
  if (device)
    return (
      <section class="card account-card stack" role="status">
        <h1 class="row">
          <Icon name="complete" />
          {w.approved(device)}
        </h1>
        <p class="second">{w.whereToEnd}</p>
        <p class="row">
          <ButtonLink look="primary" href="/people">
            {w.toDevices}
          </ButtonLink>
        </p>
      </section>
    )
  return (
    <section class="card account-card stack">
      <h1>{w.approveTitle}</h1>
      <p class="second">
        {found
          ? (found.program ? w.shownByProgram : w.shownBy)(found.device)
          : w.approveExplanation}
      </p>
      <form class="stack" onSubmit={(event) => void approve(event)}>
        <Field
          label={w.code}
          value={code}
          onInput={(text) => {
            setCode(codeForm(text))
            setError('')
          }}
          error={error}
          placeholder="BCDF-GHJK"
          autocomplete="off"
          required
        />
        <Select
          label={w.as}
          value={role}
          onChange={(value) => setRole(value as Role)}
          options={rolesUpTo(own).map((each) => [each, words.value.roles[each]] as const)}
        />
        <Button look="primary" type="submit" disabled={busy || code.trim() === ''}>
          {w.approve}
        </Button>
      </form>
    </section>
  )
}
