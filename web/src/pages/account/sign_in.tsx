import { useState } from 'preact/hooks'
import { Button, ButtonLink } from '../../design/button'
import { Field } from '../../design/field'
import { Notice } from '../../design/notice'
import { navigate, path, search } from '../../shell/router'
import { session, useApi } from '../../shell/session'
import { sentence } from '../../words/diagnostic'
import { named, words } from '../../words/words'
import './account.css'

/** Sign in with a password, at the university, or by pairing. */
export function SignInPage() {
  const api = useApi()
  const [name, setName] = useState('')
  const [password, setPassword] = useState('')
  const [error, setError] = useState('')
  const [busy, setBusy] = useState(false)
  const w = words.value.signIn
  const problem = new URLSearchParams(search.value).get('problem')
  const ways = session.value?.ways
  const user = session.value?.user
  const signIn = async (event: Event) => {
    event.preventDefault()
    setBusy(true)
    setError('')
    try {
      session.value = await api.signIn(name.trim(), password)
      if (path.value === '/sign-in') navigate('/', 'replace')
    } catch (problem) {
      setError(sentence(problem))
      setPassword('')
    } finally {
      setBusy(false)
    }
  }
  return (
    <section class="card account-card stack">
      <h1>{w.title}</h1>
      {problem !== null && !user && (
        <Notice severity="warning">
          <p>{w.problems[problem] ?? w.otherProblem}</p>
        </Notice>
      )}
      {user && (
        <Notice severity="info">
          <p>{w.already(named(user.name))}</p>
          <ButtonLink href="/">{words.value.nav.upload}</ButtonLink>
        </Notice>
      )}
      {ways?.course && !user && <p>{w.course}</p>}
      {!ways?.password && !ways?.oidc && !ways?.course && !user && (
        <Notice severity="warning">
          <p>{w.noWay}</p>
        </Notice>
      )}
      {ways?.password && (
        <form class="stack" onSubmit={(event) => void signIn(event)}>
          <Field label={w.name} value={name} onInput={setName} autocomplete="username" required />
          <Field
            label={w.password}
            value={password}
            onInput={setPassword}
            autocomplete="current-password"
            error={error}
            required
            password
          />
          <Button look="primary" type="submit" disabled={busy}>
            {w.submit}
          </Button>
        </form>
      )}
      {ways?.oidc && <ButtonLink href="/api/oidc/start">{w.university}</ButtonLink>}
      {ways?.pairing && (
        <div class="account-other">
          <ButtonLink look="quiet" icon="headset" href="/pair">
            {w.headset}
          </ButtonLink>
        </div>
      )}
      {ways?.password && <p class="second small">{w.lost}</p>}
    </section>
  )
}
