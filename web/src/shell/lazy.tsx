import type { ComponentType } from 'preact'
import { useEffect, useState } from 'preact/hooks'
import { Notice } from '../design/notice'
import { words } from '../words/words'

interface Pending<Props> {
  page: ComponentType<Props> | null
  failed: boolean
}

const LOADING_SHOWN_AFTER_MS = 300

/** A component whose code comes when it is first shown, or before that by load(). */
export type LazyPage<Props extends object = object> = ComponentType<Props> & {
  /** Begin to load the code; a failure is told where the component is shown. */
  load(): void
}

/** Return a component that loads its page when it is first shown, and says so after 300 ms. */
export function lazy<Props extends object>(
  fetch: () => Promise<ComponentType<Props>>,
): LazyPage<Props> {
  let loaded: ComponentType<Props> | null = null
  let loading: Promise<ComponentType<Props>> | null = null
  const load = () => {
    loading ??= fetch().catch((problem: unknown) => {
      // the next attempt asks again
      loading = null
      throw problem
    })
    return loading
  }
  function Lazy(props: Props) {
    const [{ page, failed }, set] = useState<Pending<Props>>({ page: loaded, failed: false })
    const [slow, setSlow] = useState(false)
    useEffect(() => {
      if (loaded) return
      let here = true
      const timer = setTimeout(() => setSlow(true), LOADING_SHOWN_AFTER_MS)
      load()
        .then((component) => {
          loaded = component
          if (here) set({ page: component, failed: false })
        })
        .catch((problem: unknown) => {
          console.error(problem)
          if (here) set({ page: null, failed: true })
        })
        .finally(() => clearTimeout(timer))
      return () => {
        here = false
        clearTimeout(timer)
      }
    }, [])
    const Page = page
    if (Page) return <Page {...props} />
    if (failed)
      return (
        <Notice severity="error">
          <p>{words.value.noAnswer}</p>
        </Notice>
      )
    return slow ? <p class="second">{words.value.loading}</p> : null
  }
  return Object.assign(Lazy, { load: () => void load().catch(() => {}) })
}
