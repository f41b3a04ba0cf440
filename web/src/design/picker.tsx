import { useId } from 'preact/hooks'
import { Icon } from './icons'
import './picker.css'

export interface Choice {
  readonly id: string
  readonly name: string
  readonly note: string
  readonly picture: string | null
}

interface PickerProps {
  label: string
  choices: readonly Choice[]
  chosen: string
  onChoose: (id: string) => void
}

/** Pictures of which one is chosen; arrow keys move between them. */
export function Picker({ label, choices, chosen, onChoose }: PickerProps) {
  const name = useId()
  return (
    <fieldset class="picker">
      <legend>{label}</legend>
      <div class="picker-choices">
        {choices.map(({ id, name: text, note, picture }) => (
          <label class="picker-choice" key={id}>
            <input
              class="spoken"
              type="radio"
              name={name}
              value={id}
              checked={id === chosen}
              onChange={() => onChoose(id)}
            />
            <span class="picker-picture">
              {picture === null ? (
                <Icon name={id === '' ? 'close' : 'robot'} />
              ) : (
                <img src={picture} alt="" loading="lazy" width="160" height="160" />
              )}
              <span class="picker-check">
                <Icon name="check" />
              </span>
            </span>
            {/* a line ends after no hyphen of a model's number */}
            <span class="picker-name">{text.replace(/-(?=\d)/g, '\u2011')}</span>
            {note && <span class="tiny second">{note}</span>}
          </label>
        ))}
      </div>
    </fieldset>
  )
}
