import { createContext } from 'preact'
import { useContext } from 'preact/hooks'
import type { Rights } from '../../api/types'
import type { Link } from '../../link/link'

/** What the parts of the lab page share. */
export interface LabContext {
  readonly link: Link
  /** What the person may do here. */
  readonly may: Rights
}

const Context = createContext<LabContext | null>(null)
export const LabProvider = Context.Provider

export function useLab(): LabContext {
  const lab = useContext(Context)
  if (lab === null) throw new Error('useLab needs a LabProvider above it')
  return lab
}
