import { render } from 'preact'
import './design/styles'
import './shell/shell.css'
import type { Api } from './api/api'
import { HttpApi } from './api/http'
import { App, loadPage } from './app'
import { followTheme } from './design/theme'
import { followLinks, path } from './shell/router'
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
const api = await connect()
// What the first picture waits for is asked for at once: who is signed in, the page's code, words.
const asked = api.session()
asked.catch(() => {})
loadPage(path.value)
await setLanguage(preferredLanguage(), false)
const page = document.getElementById('page')
if (page !== null) render(<App api={api} asked={asked} />, page)
