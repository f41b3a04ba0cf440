import { useEffect, useState } from 'preact/hooks'
import { Button } from '../../design/button'
import { listBagsOf, order, trigger } from '../../lab/commands'
import type { LabFollower } from '../../lab/follower'
import { RecorderState, replayType } from '../../protocol/mrlab_msgs'
import { spoken } from '../../words/diagnostic'
import { words } from '../../words/words'
import { useLab } from './context'
import { Timeline } from './timeline'

/** Replay a recorded bag in this view, and show the state of the recorder. */
export function ReplayCard({ follower }: { follower: LabFollower }) {
  const [bag, setBag] = useState('')
  const w = words.value.lab
  const lab = useLab()
  const { link, may } = lab
  const state = follower.recorder.value
  const [bags, setBags] = useState<readonly string[]>([])
  const doing = state?.state
  // each recording adds one
  useEffect(() => {
    if (!may.replay || doing !== RecorderState.STOPPED) return
    // a name can be typed all the same
    listBagsOf(link).then(setBags, () => setBags([]))
  }, [link, may.replay, doing])
  const replaying =
    state?.state === RecorderState.REPLAYING || state?.state === RecorderState.PAUSED
  if (!may.replay && !replaying && state?.state !== RecorderState.RECORDING) return null
  const start = (event: Event) => {
    event.preventDefault()
    const request = { bag: bag.trim(), rate: 1, start: 0, loop: false }
    if (request.bag) order(lab, 'recorder/replay', replayType, request)
  }
  return (
    <article class="lab-card">
      <h2>{w.recordings}</h2>
      {state?.message && <p class="small">{spoken(state)}</p>}
      {state?.state === RecorderState.RECORDING && <p class="small">{w.recording(state.bag)}</p>}
      {replaying && state ? (
        <>
          <p class="small">{w.replaying(state.bag)}</p>
          <Timeline key="timeline" player={follower.replay} rate={100} enabled={may.replay} />
          {may.replay && (
            <Button onClick={() => trigger(lab, 'recorder/stop')}>{w.endReplay}</Button>
          )}
        </>
      ) : (
        may.replay && (
          <form class="lab-replay" onSubmit={start}>
            <label class="small" for="lab-bag">
              {w.bag}
            </label>
            <input
              id="lab-bag"
              class="input"
              value={bag}
              placeholder="class.bag"
              list="lab-bags"
              autocomplete="off"
              onInput={(event) => setBag(event.currentTarget.value)}
            />
            <datalist id="lab-bags">
              {bags.map((each) => (
                <option key={each} value={each} />
              ))}
            </datalist>
            <Button type="submit" disabled={!bag.trim()}>
              {w.replay}
            </Button>
          </form>
        )
      )}
    </article>
  )
}
