import { render } from 'preact'
import './design/styles'
import './pages/shell/shell.css'
import type { Api } from './api/api'
import { HttpApi } from './api/http'
import { followTheme } from './design/theme'
import { App } from './pages/shell/app'
import { followLinks } from './pages/shell/router'
import { leaveSignedOut } from './pages/shell/session'
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
