import { signal } from '@preact/signals'
import { words } from '../words/words'
import { Button } from './button'

interface Toast {
  readonly id: number
  readonly text: string
  readonly action?: { readonly label: string; readonly run: () => void }
}

const toasts = signal<readonly Toast[]>([])
let next = 1
// Long enough to read a line and reach the button; it stays while something in it has the focus.
const SHOWN_MS = 8000

function remove(id: number): void {
  toasts.value = toasts.value.filter((toast) => toast.id !== id)
}

/** Say something that needs no answer, with at most one thing to do about it, such as undo. */
export function showToast(text: string, action?: Toast['action']): void {
  const id = next++
  toasts.value = [...toasts.value.slice(-2), action ? { id, text, action } : { id, text }]
  const fade = () => {
    if (document.querySelector(`[data-toast="${id}"]`)?.matches(':focus-within, :hover'))
      setTimeout(fade, 1000)
    else remove(id)
  }
  setTimeout(fade, SHOWN_MS)
}

export function Toasts() {
  return (
    <div class="toasts" role="status" aria-live="polite">
      {toasts.value.map((toast) => (
        <div class="toast" key={toast.id} data-toast={toast.id}>
          <span class="grow">{toast.text}</span>
          {toast.action && (
            <Button
              look="quiet"
              onClick={() => {
                toast.action?.run()
                remove(toast.id)
              }}
            >
              {toast.action.label}
            </Button>
          )}
          <Button
            look="quiet"
            icon="close"
            label={words.value.close}
            onClick={() => remove(toast.id)}
          />
        </div>
      ))}
    </div>
  )
}
