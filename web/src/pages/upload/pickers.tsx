import { words } from '../../words/words'
import { EffectorPicker, RobotPicker } from '../motion/library_pickers'
import type { UploadFlow } from './flow'

/** Choose the robot and its end effector; the choice is kept for the next time. */
export function Pickers({ flow }: { flow: UploadFlow }) {
  const library = flow.library.value
  if (library === null) return <div class="picker-waiting" aria-busy="true" />
  return (
    <div class="stack">
      <RobotPicker
        label={words.value.upload.robot}
        library={library}
        chosen={flow.robot.value}
        onChoose={(model) => void flow.chooseRobot(model)}
      />
      <EffectorPicker
        label={words.value.upload.endEffector}
        library={library}
        chosen={flow.effector.value}
        onChoose={(id) => void flow.chooseEffector(id)}
      />
    </div>
  )
}
