/** The link of a page, closed when the page is left. */

import { type Signal, useSignal } from '@preact/signals'
import { useEffect } from 'preact/hooks'
import type { Link } from './link'

/** Open the lab's link, or in `--mode fake` that of a made-up lab; null until it is open. */
export function useLink(): Signal<Link | null> {
  const link = useSignal<Link | null>(null)
  useEffect(() => {
    let open: Link | null = null
    let here = true
    const opening =
      import.meta.env.MODE === 'fake'
        ? import('../../test/fake_lab').then(({ fakeLab }) => fakeLab())
        : import('./socket').then(({ openLink }) => openLink())
    opening.then((found) => {
      open = found
      if (here) link.value = found
      else found.close()
    })
    return () => {
      here = false
      open?.close()
    }
  }, [])
  return link
}
