import { useId } from 'preact/hooks'
import { Icon } from '../../design/icons'
import { words } from '../../words/words'
import type { UploadFlow } from './flow'

interface Choice {
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
function Picker({ label, choices, chosen, onChoose }: PickerProps) {
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
            <span class="picker-name">{text}</span>
            {note && <span class="tiny second">{note}</span>}
          </label>
        ))}
      </div>
    </fieldset>
  )
}

/** Choose the robot and what it holds; the choice is kept for the next time. */
export function Pickers({ flow }: { flow: UploadFlow }) {
  const w = words.value.upload
  const library = flow.library.value
  if (library === null) return <div class="picker-waiting" aria-busy="true" />
  return (
    <div class="stack">
      <Picker
        label={w.robot}
        choices={library.robots.map((robot) => ({
          id: robot.model,
          name: robot.name,
          note: robot.maker,
          picture: robot.thumbnail,
        }))}
        chosen={flow.robot.value}
        onChoose={(model) => void flow.chooseRobot(model)}
      />
      <Picker
        label={w.endEffector}
        choices={[
          { id: '', name: w.noEndEffector, note: '', picture: null },
          ...library.end_effectors.map((effector) => ({
            id: effector.id,
            name: effector.name,
            note: '',
            picture: effector.thumbnail,
          })),
        ]}
        chosen={flow.effector.value}
        onChoose={(id) => void flow.chooseEffector(id)}
      />
    </div>
  )
}
