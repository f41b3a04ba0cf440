import { useEffect, useErrorBoundary, useState } from 'preact/hooks'
import type { Api } from './api/api'
import type { Session } from './api/types'
import { Button, ButtonLink } from './design/button'
import { Notice } from './design/notice'
import { Toasts } from './design/toast'
import { Header } from './shell/header'
import { type LazyPage, lazy } from './shell/lazy'
import { path } from './shell/router'
import { ApiProvider, checkSignIn, session } from './shell/session'
import { sentence } from './words/diagnostic'
import { words } from './words/words'

interface Route {
  readonly path: RegExp
  readonly page: LazyPage
  /** Shown to people who have signed in only. */
  readonly members: boolean
  /** The page has the whole window below the header. */
  readonly wide?: boolean
}

const SignIn = lazy(async () => (await import('./pages/account/sign_in')).SignInPage)

const Room = lazy(async () => {
  const [{ RoomPage }, { classInRoom }] = await Promise.all([
    import('./room/page'),
    import('./classroom/in_room'),
  ])
  return () => <RoomPage extra={classInRoom} />
})

const ROUTES: readonly Route[] = [
  {
    path: /^\/(live)?$/,
    page: lazy(async () => (await import('./pages/upload/page')).UploadPage),
    members: true,
  },
  {
    path: /^\/lab$/,
    page: lazy(async () => (await import('./pages/lab/page')).LabPage),
    members: true,
    wide: true,
  },
  {
    path: /^\/room$/,
    page: Room,
    members: true,
    wide: true,
  },
  {
    path: /^\/trajectories(\/.*)?$/,
    page: lazy(async () => (await import('./pages/trajectories/page')).TrajectoriesPage),
    members: true,
  },
  {
    path: /^\/class(\/.*)?$/,
    page: lazy(async () => (await import('./classroom/page')).ClassPage),
    members: true,
  },
  {
    path: /^\/people$/,
    page: lazy(async () => (await import('./pages/people/page')).PeoplePage),
    members: true,
  },
  { path: /^\/sign-in$/, page: SignIn, members: false },
  {
    path: /^\/pair(\/[^/]+)?$/,
    page: lazy(async () => (await import('./pages/account/pair')).PairPage),
    members: false,
  },
  {
    path: /^\/invitation\/[^/]+$/,
    page: lazy(async () => (await import('./pages/account/invitation')).InvitationPage),
    members: false,
  },
]

function NotFound() {
  return (
    <section class="stack">
      <h1>{words.value.notFound.title}</h1>
      <p>
        <ButtonLink href="/">{words.value.notFound.back}</ButtonLink>
      </p>
    </section>
  )
}

function Crashed({ error }: { error: unknown }) {
  const w = words.value.crashed
  return (
    <Notice severity="error">
      <h2>{w.title}</h2>
      <p>{w.remedy}</p>
      <p class="second">
        <code>{sentence(error)}</code>
      </p>
      <Button onClick={() => location.reload()}>{w.reload}</Button>
    </Notice>
  )
}

function Page() {
  const [error] = useErrorBoundary()
  if (error) return <Crashed error={error} />
  const route = ROUTES.find((each) => each.path.test(path.value))
  if (!route) return <NotFound />
  const Shown = route.members && session.value?.user === null ? SignIn : route.page
  return <Shown />
}

/** Begin to load the code of the page at a path. */
export function loadPage(at: string): void {
  ROUTES.find((each) => each.path.test(at))?.page.load()
}

/** The whole of the pages: header, page, toasts. asked: the session, where it was asked for. */
export function App({ api, asked }: { api: Api; asked?: Promise<Session> }) {
  const [error, setError] = useState('')
  const load = (answer: Promise<Session>) => {
    setError('')
    answer
      .then((found) => {
        session.value = found
      })
      .catch((problem: unknown) => setError(sentence(problem)))
  }
  useEffect(() => load(asked ?? api.session()), [])
  useEffect(() => {
    const look = () => {
      if (session.value?.user) void checkSignIn(api)
    }
    addEventListener('focus', look)
    return () => removeEventListener('focus', look)
  }, [api])
  const wide = ROUTES.find((each) => each.path.test(path.value))?.wide && session.value?.user
  return (
    <ApiProvider value={api}>
      <a class="skip" href="#main">
        {words.value.nav.skip}
      </a>
      <Header />
      <main id="main" tabIndex={-1} class={wide ? 'main-wide' : 'main'}>
        {error ? (
          <Notice severity="error">
            <p>{error}</p>
            <Button onClick={() => load(api.session())}>{words.value.retry}</Button>
          </Notice>
        ) : (
          session.value && <Page key={path.value.split('/')[1]} />
        )}
      </main>
      <Toasts />
    </ApiProvider>
  )
}
