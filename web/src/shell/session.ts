import { signal } from '@preact/signals'
import { createContext } from 'preact'
import { useContext } from 'preact/hooks'
import type { Api } from '../api/api'
import type { Session } from '../api/types'
import { navigate } from './router'

/** The session of the person who is signed in; null until the gateway has answered. */
export const session = signal<Session | null>(null)

/** Lead a person whose sign-in was ended to the page that says so. */
export function leaveSignedOut(): void {
  const { value } = session
  if (!value?.user) return
  session.value = { ...value, user: null }
  navigate('/sign-in?problem=ended', 'replace')
}

/** Ask whether the sign-in still holds. A gateway that does not answer has ended none. */
export async function checkSignIn(api: Api): Promise<void> {
  const now = await api.session().catch(() => null)
  if (now?.user === null) leaveSignedOut()
}

const ApiContext = createContext<Api | null>(null)
export const ApiProvider = ApiContext.Provider

export function useApi(): Api {
  const api = useContext(ApiContext)
  if (api === null) throw new Error('useApi needs an ApiProvider above it')
  return api
}

/** Return whether the person may see the other people and let others in. */
export function mayAdmit(current: Session | null): boolean {
  return current?.user?.role === 'instructor'
}
