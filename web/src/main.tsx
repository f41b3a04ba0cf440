import { render } from 'preact'
import './design/styles'
import './shell/shell.css'
import type { Api } from './api/api'
import { HttpApi } from './api/http'
import { App } from './app'
import { followTheme } from './design/theme'
import { followLinks } from './shell/router'
import { leaveSignedOut } from './shell/session'
import { preferredLanguage, setLanguage, words } from './words/words'

async function connect(): Promise<Api> {
  // `scripts/npm run dev -- --mode fake`: the pages without a lab.
  if (import.meta.env.MODE === 'fake') return new (await import('../test/fake_api')).FakeApi()
  const api = new HttpApi(() => words.value.noAnswer)
  api.onSignedOut = leaveSignedOut
  return api
}

followTheme()
followLinks()
const [api] = await Promise.all([connect(), setLanguage(preferredLanguage(), false)])
const page = document.getElementById('page')
if (page !== null) render(<App api={api} />, page)
