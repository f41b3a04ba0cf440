import { useEffect, useState } from 'preact/hooks'
import type { Invitation } from '../../api/types'
import { Button, ButtonLink } from '../../design/button'
import { Field } from '../../design/field'
import { Notice } from '../../design/notice'
import { navigate, path } from '../../shell/router'
import { session, useApi } from '../../shell/session'
import { sentence } from '../../words/diagnostic'
import { words } from '../../words/words'
import './account.css'

/** Fewest characters that the gateway takes. */
const SHORTEST = 12

/** Choose a password by a link that is good once. */
export function InvitationPage() {
  const api = useApi()
  const token = decodeURIComponent(path.value.split('/')[2] ?? '')
  const [invitation, setInvitation] = useState<Invitation | null>(null)
  const [refused, setRefused] = useState('')
  const [password, setPassword] = useState('')
  const [again, setAgain] = useState('')
  const [error, setError] = useState('')
  const [busy, setBusy] = useState(false)
  const w = words.value.invitation
  useEffect(() => {
    api
      .invitation(token)
      .then(setInvitation)
      .catch((problem: unknown) => setRefused(sentence(problem)))
  }, [api, token])
  const accept = async (event: Event) => {
    event.preventDefault()
    if (password.length < SHORTEST) return setError(w.short(SHORTEST, password.length))
    if (password !== again) return setError(w.differ)
    setBusy(true)
    setError('')
    try {
      session.value = await api.acceptInvitation(token, password)
      navigate('/', 'replace')
    } catch (problem) {
      setError(sentence(problem))
    } finally {
      setBusy(false)
    }
  }
  if (refused)
    return (
      <section class="card account-card stack">
        <h1>{w.invalid}</h1>
        <Notice severity="error">
          <p>{refused}</p>
        </Notice>
        <p class="second">{w.askAgain}</p>
        <p>
          <ButtonLink href="/sign-in">{words.value.nav.signIn}</ButtonLink>
        </p>
      </section>
    )
  if (invitation === null) return <p class="second">{words.value.loading}</p>
  return (
    <section class="card account-card stack">
      <h1>{w.title(invitation.name)}</h1>
      <p class="second">{w.explanation(words.value.roles[invitation.role])}</p>
      <form class="stack" onSubmit={(event) => void accept(event)}>
        {/* For the browser's own list of passwords. */}
        <input
          class="spoken"
          type="text"
          autocomplete="username"
          value={invitation.name}
          readOnly
          tabIndex={-1}
          aria-hidden="true"
        />
        <Field
          label={w.password}
          value={password}
          onInput={setPassword}
          hint={w.hint(SHORTEST)}
          autocomplete="new-password"
          required
          password
        />
        <Field
          label={w.again}
          value={again}
          onInput={setAgain}
          error={error}
          autocomplete="new-password"
          required
          password
        />
        <Button look="primary" type="submit" disabled={busy}>
          {w.submit}
        </Button>
      </form>
    </section>
  )
}
