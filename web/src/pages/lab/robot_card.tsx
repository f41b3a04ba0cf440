import { useEffect, useMemo, useRef, useState } from 'preact/hooks'
import { Button } from '../../design/button'
import { StateChip } from '../../design/chip'
import { Icon } from '../../design/icons'
import { Menu } from '../../design/menu'
import type { LabCatalogue } from '../../lab/catalogue'
import { removeType } from '../../protocol/mrlab_msgs'
import { useApi } from '../../shell/session'
import { spoken } from '../../words/diagnostic'
import { named, number, words } from '../../words/words'
import { CheckCard } from './check_card'
import './check.css'
import { order, trigger } from '../../lab/commands'
import type { RobotView } from '../../lab/followed_robot'
import type { SystemView } from '../../lab/follower'
import { nextOf } from '../../lab/next'
import { kindOf, marksOf, RobotCheck } from '../../lab/robot_check'
import { useLab } from './context'
import { LoadList } from './load_list'
import { Timeline } from './timeline'

/** Targets that have a button each; a longer list would push the next robot away. */
const MOST_TARGETS = 12
/** ms between two looks at what comes next. */
const LOOK_MS = 250

interface RobotCardProps {
  readonly view: RobotView
  readonly catalogue: LabCatalogue
  /** That moves it; absent: none. */
  readonly system: SystemView | undefined
  /** Nothing of the lab moves: a motion that is loaded now is checked automatically. */
  readonly idle: boolean
}

/** The check of a robot's motion; a motion that is loaded from now on is checked automatically. */
function useCheck({ robot, playback }: RobotView, begins: boolean): RobotCheck {
  const api = useApi()
  const check = useMemo(() => new RobotCheck(api, robot.name), [api, robot.name])
  useEffect(() => () => check.dispose(), [check])
  const known = useRef<RobotCheck | null>(null)
  const { trajectory_id: id, trajectory_version: version } = playback ?? {}
  useEffect(() => {
    if (id === undefined) return
    void check.follow(id && `${id}@${version}`, begins && known.current === check)
    known.current = check
  }, [check, id, version])
  return check
}

/** The places at which the trajectory grasps and releases; a click seeks to one. The numbers are
 * those in 3D. */
function Targets({ view }: { view: RobotView }) {
  const { may } = useLab()
  const w = words.value.lab
  if (view.targets.length === 0) return null
  return (
    <ol class="lab-targets" aria-label={w.grasps}>
      {view.targets.slice(0, MOST_TARGETS).map(({ time, close, frame }, index) => (
        <li key={frame}>
          <button
            type="button"
            class="lab-target tiny"
            disabled={!may.commands || view.playback?.system !== ''}
            onClick={() => view.player.seek(time)}
          >
            <b class="lab-target-number">{index + 1}</b>
            {close ? w.closesAt(number(time, 2)) : w.opensAt(number(time, 2))}
          </button>
        </li>
      ))}
    </ol>
  )
}

interface NextProps {
  readonly view: RobotView
  readonly system: SystemView | undefined
}

/** What the robot does next, as far as it is known; it follows the robot while that moves. */
function Next({ view, system }: NextProps) {
  const w = words.value.lab.next
  const { player } = view
  const [, look] = useState(0)
  useEffect(() => {
    if (!player.playing && !system?.player.playing) return
    const timer = setInterval(() => look((count) => count + 1), LOOK_MS)
    return () => clearInterval(timer)
  }, [view, system])
  const member = system?.system.members.find(({ robot }) => robot === view.robot.name)
  const turn = system && member ? { member, position: system.player.position() } : null
  return (
    <p class="small">
      <span class="second">{w.next}: </span>
      {nextOf(view, player.position(), turn, w)}
    </p>
  )
}

/** One robot: its state, the object that it holds, its timeline, and its motions. */
export function RobotCard({ view, catalogue, system, idle }: RobotCardProps) {
  const lab = useLab()
  const { may, replays } = lab
  const [choosing, setChoosing] = useState(false)
  const card = useRef<HTMLElement>(null)
  const [chosen, setChosen] = useState(0)
  const { robot, state, playback, holding, touching, player } = view
  const w = words.value.lab
  const loaded = playback !== null && playback.frame_count > 0
  const independent = !playback?.system
  const halted = state === 'COLLISION_HALT'
  const check = useCheck(view, may.commands && idle)
  const seeks = may.commands && independent
  const found = check.check.value
  const marks = useMemo(
    () =>
      marksOf(found, playback?.duration ?? 0).map(({ finding: { code, severity }, time }) => ({
        time,
        severity,
        words: `${words.value.severities[severity]}: ${kindOf(code, words.value)}, ${words.value.check.at(number(time, 2))}`,
      })),
    [found, playback?.duration, words.value],
  )
  // What was pressed is gone with the list: a keyboard goes on at Play.
  useEffect(() => {
    if (chosen > 0 && document.activeElement === document.body)
      card.current?.querySelector<HTMLElement>('.scene-play')?.focus({ preventScroll: true })
  }, [chosen, playback?.trajectory_id])
  return (
    <article class="lab-card" aria-label={robot.name} ref={card}>
      <header class="lab-card-head">
        <h2>{robot.name}</h2>
        <StateChip state={state} />
        {may.scene && (
          <Menu label={w.actionsFor(robot.name)} icon="more" look="quiet">
            <Button
              look="quiet"
              icon="trash"
              onClick={() => void order(lab, 'lab/remove_robot', removeType, { name: robot.name })}
            >
              {w.removeRobot}
            </Button>
          </Menu>
        )}
      </header>
      <div class="lab-card-words" key="words">
        <p class="second small">
          {robot.model}
          {robot.end_effector && ` + ${named(robot.end_effector)}`}
          {playback?.system && ` · ${w.inSystem(playback.system)}`}
        </p>
        {playback?.message && (
          <p class={`lab-why small${halted ? ' lab-halt' : ''}`}>{spoken(playback)}</p>
        )}
        {view.down && <p class="lab-halt small">{w.outages.robot}</p>}
        {view.overlaps.length > 0 && (
          <p class="lab-not-checked small">
            <Icon name="warning" />
            {w.standsIn(view.overlaps.map((each) => named(each)).join(', '))}
          </p>
        )}
        {touching && !halted && <p class="lab-halt small">{touching}</p>}
        {!replays && <Next view={view} system={system} />}
        {holding && <p class="small">{w.holds(holding)}</p>}
        {halted && may.commands && (
          <Button onClick={() => trigger(lab, `${robot.name}/clear_halt`)}>{w.clearHalt}</Button>
        )}
      </div>
      {loaded && (
        <div class="lab-card-words" key="loaded">
          <div class="lab-loaded">
            <strong class="grow small">{playback.trajectory_id}</strong>
            {independent && may.commands && (
              <Button look="quiet" aria-expanded={choosing} onClick={() => setChoosing(!choosing)}>
                {w.another}
              </Button>
            )}
          </div>
          <Timeline player={player} rate={playback.frame_rate} enabled={seeks} marks={marks} />
          <CheckCard
            check={check}
            enabled={may.commands}
            onSeek={seeks ? (time) => player.seek(time) : null}
          />
          <Targets view={view} />
        </div>
      )}
      {!replays && (choosing || (playback !== null && !loaded && independent)) && (
        <LoadList
          key="list"
          robot={robot}
          catalogue={catalogue}
          loaded={playback?.trajectory_id ?? ''}
          onLoaded={() => {
            setChoosing(false)
            setChosen(chosen + 1)
          }}
        />
      )}
    </article>
  )
}
