import { THEMES, type ThemeName } from '../../design/tokens'

/** Colours of the 3D view, those of the design. */
export interface SceneTheme {
  readonly name: ThemeName
  readonly ink: string
  readonly second: string
  readonly card: string
  readonly accent: string
  readonly error: string
  /** of a link that fails: brighter than text, as light and shade fall on it */
  readonly failing: string
  readonly warning: string
  readonly info: string
}

/** Return the theme of the page: its data-theme, else the preference of the person's system. */
export function themeNow(): SceneTheme {
  const named = document.documentElement.dataset.theme
  const dark =
    named === 'dark' || (named !== 'light' && matchMedia('(prefers-color-scheme: dark)').matches)
  const name = dark ? 'dark' : 'light'
  const { colours, states } = THEMES[name]
  return {
    name,
    ink: colours.ink,
    second: colours.second,
    card: colours.card,
    accent: colours.accent,
    error: states.COLLISION_HALT,
    failing: dark ? '#FF4D3D' : '#C8102E',
    warning: states.PAUSED,
    info: states.READY,
  }
}

/** Call `listener` whenever the theme changes; return a function that ends it. */
export function onTheme(listener: (theme: SceneTheme) => void): () => void {
  const changed = () => listener(themeNow())
  const media = matchMedia('(prefers-color-scheme: dark)')
  media.addEventListener('change', changed)
  const observer = new MutationObserver(changed)
  observer.observe(document.documentElement, { attributeFilter: ['data-theme'] })
  return () => {
    media.removeEventListener('change', changed)
    observer.disconnect()
  }
}

/** Return whether the person prefers reduced motion. */
export function reducedMotion(): boolean {
  return matchMedia('(prefers-reduced-motion: reduce)').matches
}
