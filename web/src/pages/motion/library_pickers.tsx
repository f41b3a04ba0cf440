import type { RobotLibrary } from '../../api/types'
import { Picker } from '../../design/picker'
import { named, words } from '../../words/words'

interface LibraryPickerProps {
  readonly label: string
  readonly library: RobotLibrary
  readonly chosen: string
  readonly onChoose: (id: string) => void
}

/** Choose a robot of the library by its picture. */
export function RobotPicker({ library, ...rest }: LibraryPickerProps) {
  return (
    <Picker
      {...rest}
      choices={library.robots.map((robot) => ({
        id: robot.model,
        name: robot.name,
        note: robot.maker,
        picture: robot.thumbnail,
      }))}
    />
  )
}

/** Choose an end effector of the library by its picture, or none. */
export function EffectorPicker({ library, ...rest }: LibraryPickerProps) {
  return (
    <Picker
      {...rest}
      choices={[
        { id: '', name: words.value.upload.noEndEffector, note: '', picture: null },
        ...library.end_effectors.map((effector) => ({
          id: effector.id,
          name: named(effector.id, effector.name),
          note: '',
          picture: effector.thumbnail,
        })),
      ]}
    />
  )
}
