import { useMemo, useState } from 'preact/hooks'
import type { RobotLibrary } from '../../api/types'
import { Segments } from '../../design/field'
import { Picker } from '../../design/picker'
import { named, number, words } from '../../words/words'
import { mostUsed } from './used_robots'

interface LibraryPickerProps {
  readonly label: string
  readonly library: RobotLibrary
  readonly chosen: string
  readonly onChoose: (id: string) => void
}

/** Choose a robot of the library by its picture, the most used first. */
export function RobotPicker({ library, ...rest }: LibraryPickerProps) {
  const w = words.value.upload
  const [joints, setJoints] = useState('')
  const counts = [...new Set(library.robots.map((robot) => String(robot.joints.length)))].sort()
  const robots = useMemo(() => mostUsed(library.robots), [library])
  return (
    <div class="stack-8">
      {counts.length > 1 && (
        <Segments
          label={w.joints}
          value={joints}
          onChange={setJoints}
          options={[
            ['', words.value.trajectories.scopes.all],
            ...counts.map((count) => [count, w.jointCount(count)] as const),
          ]}
        />
      )}
      <Picker
        {...rest}
        choices={robots
          .filter((robot) => joints === '' || String(robot.joints.length) === joints)
          .map((robot) => ({
            id: robot.model,
            name: robot.name,
            note: w.reach(number(robot.reach, 2), number(robot.payload, 1)),
            picture: robot.thumbnail,
          }))}
      />
    </div>
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
