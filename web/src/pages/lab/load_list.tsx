import { useState } from 'preact/hooks'
import type { TrajectoryInfo } from '../../api/types'
import { Button, ButtonLink } from '../../design/button'
import { Icon } from '../../design/icons'
import { Notice } from '../../design/notice'
import { type LabCatalogue, playable } from '../../lab/catalogue'
import { order } from '../../lab/commands'
import { loadTrajectoryType, type Robot } from '../../protocol/mrlab_msgs'
import { session } from '../../shell/session'
import { sentence } from '../../words/diagnostic'
import { number, words } from '../../words/words'
import { EXAMPLE_MODEL, exampleFile } from '../motion/example'
import { ownerName } from '../trajectories/list'
import { useLab } from './context'

/** Shown without a search. */
const FEW = 5
const EXAMPLE_NAME = 'quintic'

interface LoadListProps {
  readonly robot: Robot
  readonly catalogue: LabCatalogue
  /** Id of the loaded motion; empty: none. */
  readonly loaded: string
  readonly onLoaded: () => void
}

function matches(info: TrajectoryInfo, text: string): boolean {
  const line = `${info.id} ${info.source_file}`.toLowerCase()
  return text
    .toLowerCase()
    .split(/\s+/)
    .every((word) => line.includes(word))
}

/** The trajectories that a robot can play; a click loads one. */
export function LoadList({ robot, catalogue, loaded, onLoaded }: LoadListProps) {
  const lab = useLab()
  const { may } = lab
  const [busy, setBusy] = useState('')
  const [text, setText] = useState('')
  const [error, setError] = useState('')
  const w = words.value.lab
  const all = catalogue.all.value
  const user = session.value?.user?.id ?? ''

  const load = async (id: string) => {
    setBusy(id)
    const done = await order(lab, `${robot.name}/load`, loadTrajectoryType, { id })
    setBusy('')
    if (done !== null) onLoaded()
  }
  const takeExample = async () => {
    setError('')
    setBusy('example')
    try {
      await load(await catalogue.take(await exampleFile(), robot.model, EXAMPLE_NAME))
    } catch (problem) {
      setBusy('')
      setError(sentence(problem))
    }
  }

  if (catalogue.error.value)
    return (
      <Notice severity="error">
        <p>{catalogue.error.value}</p>
        <Button onClick={() => void catalogue.load()}>{words.value.retry}</Button>
      </Notice>
    )
  if (all === null) return <p class="second small">{words.value.loading}</p>
  const { here, otherwise } = playable(all, robot)
  const found = text.trim() === '' ? here : here.filter((info) => matches(info, text.trim()))
  return (
    <div class="lab-load">
      {here.length > FEW && (
        <input
          class="input"
          type="search"
          aria-label={w.searchFor(robot.name)}
          placeholder={w.searchTrajectory}
          value={text}
          onInput={(event) => setText(event.currentTarget.value)}
        />
      )}
      {here.length > 0 && (
        <ul class="lab-load-list" aria-label={w.playableBy(robot.name)}>
          {found.slice(0, text ? 50 : FEW).map((info) => (
            <li key={info.id}>
              <button
                type="button"
                class="lab-load-item"
                disabled={!may.commands || busy !== ''}
                aria-current={info.id === loaded ? 'true' : undefined}
                onClick={() => void load(info.id)}
              >
                <Icon name={info.id === loaded ? 'check' : 'motion'} />
                <span class="grow">
                  <strong>{info.id}</strong>
                  <span class="second tiny">
                    {number(info.duration, 1)} s · {ownerName(info, user)}
                  </span>
                </span>
                <span class="lab-load-word small">{busy === info.id ? w.loadingIt : w.load}</span>
              </button>
            </li>
          ))}
        </ul>
      )}
      {here.length > FEW && !text && <p class="second tiny">{w.moreToFind(here.length - FEW)}</p>}
      {here.length > 0 && found.length === 0 && <p class="small">{w.noneLike(text.trim())}</p>}
      {here.length === 0 && (
        <>
          <p class="small">{w.nonePlayable(robot.model)}</p>
          <div class="row">
            {robot.model === EXAMPLE_MODEL && may.commands && (
              <Button
                look="primary"
                icon="play"
                disabled={busy !== ''}
                onClick={() => void takeExample()}
              >
                {w.takeExample}
              </Button>
            )}
            <ButtonLink href="/" icon="upload">
              {words.value.nav.upload}
            </ButtonLink>
          </div>
        </>
      )}
      {otherwise > 0 && <p class="second tiny">{w.otherEffector(otherwise)}</p>}
      {error && <p class="field-error">{error}</p>}
    </div>
  )
}
