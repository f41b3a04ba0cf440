import type { ComponentType } from 'preact'
import { useEffect, useState } from 'preact/hooks'
import { Notice } from '../design/notice'
import { sentence } from '../words/diagnostic'
import { words } from '../words/words'

interface Pending<Props> {
  page: ComponentType<Props> | null
  error: string
}

const LOADING_SHOWN_AFTER_MS = 300

/** Return a component that loads its page when it is first shown, and says so after 300 ms. */
export function lazy<Props extends object>(
  load: () => Promise<ComponentType<Props>>,
): ComponentType<Props> {
  let loaded: ComponentType<Props> | null = null
  return function Lazy(props: Props) {
    const [{ page, error }, set] = useState<Pending<Props>>({ page: loaded, error: '' })
    const [slow, setSlow] = useState(false)
    useEffect(() => {
      if (loaded) return
      let here = true
      const timer = setTimeout(() => setSlow(true), LOADING_SHOWN_AFTER_MS)
      load()
        .then((component) => {
          loaded = component
          if (here) set({ page: component, error: '' })
        })
        .catch((problem: unknown) => here && set({ page: null, error: sentence(problem) }))
        .finally(() => clearTimeout(timer))
      return () => {
        here = false
        clearTimeout(timer)
      }
    }, [])
    const Page = page
    if (Page) return <Page {...props} />
    if (error)
      return (
        <Notice severity="error">
          <p>{words.value.noAnswer}</p>
          <p class="second small">{error}</p>
        </Notice>
      )
    return slow ? <p class="second">{words.value.loading}</p> : null
  }
}
