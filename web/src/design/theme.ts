import { computed, effect, signal } from '@preact/signals'
import { THEMES, type ThemeName } from './tokens'

const KEY = 'mrlab.theme'
const system = window.matchMedia?.('(prefers-color-scheme: dark)')
const systemDark = signal(system?.matches ?? false)
const kept = localStorage.getItem(KEY)
const chosen = signal<ThemeName | null>(kept === 'light' || kept === 'dark' ? kept : null)

export const themeName = computed<ThemeName>(
  () => chosen.value ?? (systemDark.value ? 'dark' : 'light'),
)
/** Colours for canvas and 3D, where CSS does not reach. */
export const theme = computed(() => THEMES[themeName.value])
export type Theme = (typeof THEMES)[ThemeName]

export function setTheme(name: ThemeName): void {
  localStorage.setItem(KEY, name)
  chosen.value = name
}

/** Follow the system and the choice; return a function that ends it. */
export function followTheme(): () => void {
  const onChange = (event: MediaQueryListEvent) => {
    systemDark.value = event.matches
  }
  system?.addEventListener('change', onChange)
  const dispose = effect(() => {
    if (chosen.value === null) delete document.documentElement.dataset.theme
    else document.documentElement.dataset.theme = chosen.value
  })
  return () => {
    system?.removeEventListener('change', onChange)
    dispose()
  }
}
