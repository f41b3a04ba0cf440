import { signal } from '@preact/signals'
import { createContext } from 'preact'
import { useContext } from 'preact/hooks'
import type { Api } from '../../api/api'
import type { Session } from '../../api/types'

/** Who is signed in; null until the gateway has answered. */
export const session = signal<Session | null>(null)

const ApiContext = createContext<Api | null>(null)
export const ApiProvider = ApiContext.Provider

export function useApi(): Api {
  const api = useContext(ApiContext)
  if (api === null) throw new Error('useApi needs an ApiProvider above it')
  return api
}

/** True where the person may see who else is here and let others in. */
export function mayAdmit(current: Session | null): boolean {
  return current?.user?.role === 'instructor'
}
