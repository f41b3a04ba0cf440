import type { ComponentChildren, TargetedInputEvent } from 'preact'
import { useId } from 'preact/hooks'
import { Icon } from './icons'

interface FieldProps {
  label: string
  value: string
  onInput: (value: string) => void
  password?: boolean
  hint?: string
  error?: string
  autocomplete?: string
  placeholder?: string
  required?: boolean
  minlength?: number
  inputmode?: 'numeric' | 'text'
}

export function Field({ label, value, onInput, hint, error, password, ...input }: FieldProps) {
  const id = useId()
  const note = error || hint
  const attributes = {
    ...input,
    id,
    class: 'input',
    value,
    onInput: (event: TargetedInputEvent<HTMLInputElement>) => onInput(event.currentTarget.value),
    'aria-invalid': error ? ('true' as const) : undefined,
    'aria-describedby': note ? `${id}-note` : undefined,
  }
  return (
    <div class="field">
      <label for={id}>{label}</label>
      {password ? (
        <input type="password" {...attributes} />
      ) : (
        <input type="text" {...attributes} />
      )}
      {note && (
        <p id={`${id}-note`} class={error ? 'field-error' : 'field-hint'}>
          {error && <Icon name="error" />}
          {note}
        </p>
      )}
    </div>
  )
}

interface SelectProps {
  label: string
  value: string
  onChange: (value: string) => void
  options: readonly (readonly [value: string, label: string])[]
  /** The label is read aloud only. */
  bare?: boolean
}

export function Select({ label, value, onChange, options, bare = false }: SelectProps) {
  const id = useId()
  return (
    <div class="field">
      <label for={id} class={bare ? 'spoken' : ''}>
        {label}
      </label>
      <select
        id={id}
        class="select"
        value={value}
        onChange={(event) => onChange(event.currentTarget.value)}
      >
        {options.map(([option, text]) => (
          <option key={option} value={option}>
            {text}
          </option>
        ))}
      </select>
    </div>
  )
}

interface CheckProps {
  checked: boolean
  onChange: (checked: boolean) => void
  children: ComponentChildren
}

export function Check({ checked, onChange, children }: CheckProps) {
  return (
    <label class="check">
      <input
        type="checkbox"
        checked={checked}
        onChange={(event) => onChange(event.currentTarget.checked)}
      />
      <span>{children}</span>
    </label>
  )
}

interface SegmentsProps<Value extends string> {
  label: string
  value: Value
  onChange: (value: Value) => void
  options: readonly (readonly [value: Value, label: string])[]
}

/** A few choices side by side, of which one holds; arrow keys move between them. */
export function Segments<Value extends string>(props: SegmentsProps<Value>) {
  const name = useId()
  return (
    <fieldset>
      <legend class="spoken">{props.label}</legend>
      <div class="segments">
        {props.options.map(([value, text]) => (
          <label key={value}>
            <input
              type="radio"
              name={name}
              checked={value === props.value}
              onChange={() => props.onChange(value)}
            />
            {text}
          </label>
        ))}
      </div>
    </fieldset>
  )
}
