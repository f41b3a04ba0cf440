import { createContext } from 'preact'
import { useContext } from 'preact/hooks'
import type { Rights } from '../../api/types'
import type { Lab } from '../../lab/commands'

/** The link, the toasts and the rights that the parts of the lab page share. */
interface LabContext extends Lab {
  /** What the person may do now: to robots and scene nothing while a recording is replayed. */
  readonly may: Rights
  readonly replays: boolean
}

const Context = createContext<LabContext | null>(null)
export const LabProvider = Context.Provider

export function useLab(): LabContext {
  const lab = useContext(Context)
  if (lab === null) throw new Error('useLab needs a LabProvider above it')
  return lab
}
