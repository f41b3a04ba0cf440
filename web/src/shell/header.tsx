import { useState } from 'preact/hooks'
import { Button } from '../design/button'
import { Segments } from '../design/field'
import { Icon, type IconName } from '../design/icons'
import { useOutside } from '../design/menu'
import { setTheme, themeName } from '../design/theme'
import { language, languageName, languages, named, setLanguage, words } from '../words/words'
import { navigate, path } from './router'
import { mayAdmit, session, useApi } from './session'

interface Place {
  readonly href: string
  readonly icon: IconName
  readonly name: 'upload' | 'trajectories' | 'lab' | 'room' | 'grades' | 'people'
}

const PLACES: readonly Place[] = [
  { href: '/', icon: 'upload', name: 'upload' },
  { href: '/trajectories', icon: 'motion', name: 'trajectories' },
  { href: '/lab', icon: 'robot', name: 'lab' },
  { href: '/room', icon: 'room', name: 'room' },
  { href: '/class', icon: 'check', name: 'grades' },
  { href: '/people', icon: 'people', name: 'people' },
]

function here(href: string): boolean {
  return href === '/' ? path.value === '/' : path.value.startsWith(href)
}

function Logo() {
  return (
    <svg class="logo" viewBox="0 0 32 32" aria-hidden="true">
      <path class="logo-arm" d="M7 27h11M12.5 27v-5L7.5 13.5 16.5 6.5l7 5.5" />
      <circle class="logo-joint" cx="12.5" cy="21.5" r="2.6" />
      <circle class="logo-joint" cx="7.8" cy="13.5" r="2.6" />
      <circle class="logo-joint" cx="16.5" cy="6.8" r="2.6" />
      <circle class="logo-tool" cx="24.5" cy="13" r="2.6" />
    </svg>
  )
}

function AccountMenu() {
  const api = useApi()
  const [open, setOpen] = useState(false)
  const menu = useOutside(open, () => setOpen(false))
  const w = words.value
  const user = session.value?.user
  const signOut = async () => {
    await api.signOut()
    // one's own doing: no page is to say that the sign-in was ended
    if (session.value) session.value = { ...session.value, user: null }
    session.value = await api.session()
    navigate('/sign-in')
  }
  return (
    <div class="menu" ref={menu}>
      <Button
        look="quiet"
        icon="person"
        aria-expanded={open}
        aria-haspopup="true"
        onClick={() => setOpen(!open)}
        label={user ? `${w.nav.account}: ${named(user.name)}` : w.nav.account}
      >
        {user ? <span class="account-name">{named(user.name)}</span> : undefined}
      </Button>
      {open && (
        <div class="menu-list account-list">
          {user && (
            <p class="account-who">
              <strong>{named(user.name)}</strong>
              <span class="second small">{w.roles[user.role]}</span>
            </p>
          )}
          <div class="account-choice">
            <span class="field-label">{w.nav.language}</span>
            <Segments<string>
              label={w.nav.language}
              value={language.value}
              onChange={(next) => void setLanguage(next)}
              options={languages().map((code) => [code, languageName(code)])}
            />
          </div>
          <div class="account-choice">
            <span class="field-label">{w.nav.appearance}</span>
            <Segments
              label={w.nav.appearance}
              value={themeName.value}
              onChange={setTheme}
              options={[
                ['light', w.nav.light],
                ['dark', w.nav.dark],
              ]}
            />
          </div>
          {user && (
            <a class="button button-quiet" href="/pair" onClick={() => setOpen(false)}>
              <Icon name="headset" />
              {w.nav.pair}
            </a>
          )}
          {user && session.value?.ways.password && (
            <Button look="quiet" icon="back" onClick={() => void signOut()}>
              {w.nav.signOut}
            </Button>
          )}
          {!user && (
            <a class="button button-quiet" href="/sign-in" onClick={() => setOpen(false)}>
              <Icon name="person" />
              {w.nav.signIn}
            </a>
          )}
        </div>
      )}
    </div>
  )
}

export function Header() {
  const w = words.value
  const user = session.value?.user
  const may = session.value?.may
  const grades = (may?.grades || may?.hands_in) ?? false
  const shown = { people: mayAdmit(session.value), grades }
  const places = PLACES.filter(({ name }) => !(name in shown) || shown[name as keyof typeof shown])
  return (
    <header class="header">
      <a class="brand" href="/">
        <Logo />
        <span>MR-Lab</span>
      </a>
      {user && (
        <nav class="nav" aria-label={w.nav.main}>
          {places.map(({ href, icon, name }) => (
            <a key={href} href={href} aria-current={here(href) ? 'page' : undefined}>
              <Icon name={icon} />
              <span>{w.nav[name]}</span>
            </a>
          ))}
        </nav>
      )}
      <AccountMenu />
    </header>
  )
}
