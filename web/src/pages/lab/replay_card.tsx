import { useEffect, useMemo, useState } from 'preact/hooks'
import { Button } from '../../design/button'
import { Icon } from '../../design/icons'
import { listBagsOf, order, trigger } from '../../lab/commands'
import type { LabFollower } from '../../lab/follower'
import type { SessionStop } from '../../lab/stops'
import type { RemotePlayer } from '../../playback/player'
import { RecorderState, replayType } from '../../protocol/mrlab_msgs'
import type { TimeMark } from '../../scene/preview/controls'
import { spoken } from '../../words/diagnostic'
import { fixed, words } from '../../words/words'
import { useLab } from './context'
import { Timeline } from './timeline'

/** Bags that are listed without a search. */
const MOST = 6

/** Marks on the timeline; of more, the graver ones. */
const MOST_MARKS = 60
const GRAVITY = ['error', 'warning', 'info'] as const

function inWords({ events }: SessionStop): string {
  return events.map(spoken).join(' · ')
}

function marksOf(stops: readonly SessionStop[]): readonly TimeMark[] {
  return [...stops]
    .sort((a, b) => GRAVITY.indexOf(a.severity) - GRAVITY.indexOf(b.severity))
    .slice(0, MOST_MARKS)
    .map((stop) => ({ time: stop.time, severity: stop.severity, words: inWords(stop) }))
}

interface StopsProps {
  readonly stops: readonly SessionStop[]
  readonly player: RemotePlayer
  /** True if the person may seek. */
  readonly enabled: boolean
}

/** What happened in the session; a press goes there. */
function Stops({ stops, player, enabled }: StopsProps) {
  if (stops.length === 0) return null
  return (
    <ol class="lab-load-list lab-stops" aria-label={words.value.report.events}>
      {stops.map((stop, i) => (
        <li key={i}>
          <button
            type="button"
            class={`lab-load-item lab-stop lab-stop-${stop.severity} small`}
            disabled={!enabled}
            onClick={() => player.seek(stop.time)}
          >
            <Icon name={stop.severity} />
            <span class="second lab-stop-time">{fixed(stop.time, 1)} s</span>
            <span class="grow">{inWords(stop)}</span>
          </button>
        </li>
      ))}
    </ol>
  )
}

/** Replay a recorded bag in this view, and show the state of the recorder. */
export function ReplayCard({ follower }: { follower: LabFollower }) {
  const [bag, setBag] = useState('')
  const w = words.value.lab
  const stop = words.value.room.tourStop
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
  const stops = follower.stops.value
  const marks = useMemo(() => marksOf(stops), [stops, words.value])
  const replaying = follower.replays
  if (!may.replay && !replaying && state?.state !== RecorderState.RECORDING) return null
  const replay = (wanted: string) => {
    const request = { bag: wanted, rate: 1, start: 0, loop: false }
    if (wanted) order(lab, 'recorder/replay', replayType, request)
  }
  const text = bag.trim()
  const found = bags.filter((each) => each.toLowerCase().includes(text.toLowerCase()))
  return (
    <article class="lab-card">
      <h2>{w.recordings}</h2>
      {state?.message && <p class="small">{spoken(state)}</p>}
      {state?.state === RecorderState.RECORDING && <p class="small">{w.recording(state.bag)}</p>}
      {replaying && state ? (
        <>
          <p class="small">{w.replaying(state.bag)}</p>
          <Timeline
            key="timeline"
            player={follower.replay}
            rate={100}
            enabled={may.replay}
            marks={marks}
          />
          <Stops stops={stops} player={follower.replay} enabled={may.replay} />
          {may.replay && (
            <div class="row">
              <Button onClick={() => trigger(lab, 'recorder/previous_stop')}>‹ {stop}</Button>
              <Button onClick={() => trigger(lab, 'recorder/next_stop')}>{stop} ›</Button>
              <Button onClick={() => trigger(lab, 'recorder/stop')}>{w.endReplay}</Button>
            </div>
          )}
        </>
      ) : (
        may.replay && (
          <form
            class="lab-load"
            onSubmit={(event) => {
              event.preventDefault()
              replay(text)
            }}
          >
            {/* a folder that is not in the list can be named as well */}
            <input
              class="input"
              type="search"
              aria-label={w.bag}
              placeholder={w.bag}
              value={bag}
              autocomplete="off"
              onInput={(event) => setBag(event.currentTarget.value)}
            />
            {found.length > 0 && (
              <ul class="lab-load-list" aria-label={w.recordings}>
                {found.slice(0, MOST).map((each) => (
                  <li key={each}>
                    <button type="button" class="lab-load-item" onClick={() => replay(each)}>
                      <Icon name="play" />
                      <strong class="grow small">{each}</strong>
                      <span class="lab-load-word small">{w.replay}</span>
                    </button>
                  </li>
                ))}
              </ul>
            )}
            {found.length > MOST && <p class="second tiny">{w.moreToFind(found.length - MOST)}</p>}
            {text !== '' && !bags.includes(text) && (
              <Button type="submit">{w.openBag(text)}</Button>
            )}
          </form>
        )
      )}
    </article>
  )
}
