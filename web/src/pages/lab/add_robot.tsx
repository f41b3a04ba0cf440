import { useEffect, useState } from 'preact/hooks'
import type { RobotLibrary } from '../../api/types'
import { Button } from '../../design/button'
import { Dialog } from '../../design/dialog'
import { order } from '../../lab/commands'
import { createSpawnRobotRequest, spawnRobotType } from '../../protocol/mrlab_msgs'
import { useApi } from '../../shell/session'
import { sentence } from '../../words/diagnostic'
import { words } from '../../words/words'
import { EffectorPicker, RobotPicker } from '../motion/library_pickers'
import { countUse } from '../motion/used_robots'
import { useLab } from './context'

const FIRST = 'ur5e'

/** The dialog that adds a robot with an end effector at a free place. */
export function AddRobot({ onClose }: { onClose: () => void }) {
  const api = useApi()
  const { link } = useLab()
  const [library, setLibrary] = useState<RobotLibrary | null>(null)
  const [model, setModel] = useState(FIRST)
  const [effector, setEffector] = useState('')
  const [error, setError] = useState('')
  const [busy, setBusy] = useState(false)
  const w = words.value
  useEffect(() => {
    api.robots().then(setLibrary, (problem: unknown) => setError(sentence(problem)))
  }, [api])
  const add = async (event: Event) => {
    event.preventDefault()
    setBusy(true)
    const request = {
      ...createSpawnRobotRequest(),
      model,
      end_effector: effector,
      automatic: true,
    }
    const answer = await order({ link, say: setError }, 'lab/spawn_robot', spawnRobotType, request)
    setBusy(false)
    if (answer === null) return
    countUse(model)
    onClose()
  }
  return (
    <Dialog title={w.lab.addRobot} onClose={onClose}>
      <form class="lab-add stack" onSubmit={(event) => void add(event)}>
        {library ? (
          <>
            <RobotPicker
              label={w.upload.robot}
              library={library}
              chosen={model}
              onChoose={setModel}
            />
            <EffectorPicker
              label={w.upload.endEffector}
              library={library}
              chosen={effector}
              onChoose={setEffector}
            />
          </>
        ) : (
          !error && <p class="second">{w.loading}</p>
        )}
        {error && (
          <p class="field-error" role="alert">
            {error}
          </p>
        )}
        <div class="dialog-actions lab-add-actions">
          <Button onClick={onClose}>{w.cancel}</Button>
          <Button look="primary" type="submit" disabled={busy || library === null}>
            {w.lab.addIt}
          </Button>
        </div>
      </form>
    </Dialog>
  )
}
