import type { Vector3 } from 'three'
import type { LabFollower } from '../../lab/follower'
import type { Board } from '../board/board'
import type { XrInputs } from '../input/sources'
import type { Targets } from '../input/targets'
import type { Stats } from '../latency'
import type { Surroundings } from '../panels/panel'
import type { Preferences, Speech } from '../ports'
import type { RobotPanels } from '../robots/robot_panels'
import type { RoomStage } from '../scene/stage'
import type { Settings } from '../session/settings'
import { type Seen, Tour } from './tour'
import { TourPanel } from './tour_panel'

/** Height of the figures of time below the board, mm. */
const STATS = 172

/** The parts of a room that the guide observes, or is placed at. */
interface Watched {
  readonly stage: RoomStage
  readonly settings: Settings
  readonly board: Board
  readonly stats: Stats
  readonly panels: RobotPanels
  readonly follower: LabFollower
}

/** Leads a newcomer through the first steps, and watches that they are done. */
export class Guide {
  readonly tour: Tour
  readonly panel: TourPanel

  constructor(
    private readonly ports: Speech & Preferences & Surroundings,
    private readonly room: Watched,
    private readonly targets: Targets,
  ) {
    const { settings, board, stage } = room
    this.tour = new Tour(settings.toured.value, () => {
      settings.toured.value = true
    })
    this.panel = new TourPanel(ports, this.tour, board.panel.group, stage.panels)
    targets.add(this.panel.panel)
  }

  /** Restart the tour. */
  begin(): void {
    this.tour.begin()
    this.panel.panel.repaint()
  }

  /** Before each picture. inputs: of a headset; null: there is none. */
  update(inputs: XrInputs | null): void {
    // Before the lab has published its robots, none is new.
    const watches = this.tour.step !== null && this.room.follower.known.value
    if (watches && this.tour.see(this.seen())) this.panel.panel.repaint()
    const side = this.ports.leftHanded ? 'left' : 'right'
    const hand: Vector3 | null = inputs?.hand(side) ?? null
    const means = inputs === null ? 'mouse' : inputs.hasHands ? 'hand' : 'controller'
    // Below the figures, if those are shown.
    this.panel.hang(this.room.stats.panel.group.visible ? STATS : 0)
    this.panel.update(means, hand)
  }

  dispose(): void {
    this.targets.remove(this.panel.panel)
    this.panel.dispose()
  }

  private seen(): Seen {
    const robots = this.room.follower.robots.value
    seen.robots = robots.length
    seen.loaded = robots.some(({ playback }) => (playback?.frame_count ?? 0) > 0)
    seen.playing = robots.some(({ state }) => state === 'PLAYING')
    seen.halted = robots.some(({ state }) => state === 'COLLISION_HALT')
    seen.scrubs = this.room.panels.scrubs
    return seen
  }
}

const seen = { robots: 0, loaded: false, playing: false, halted: false, scrubs: 0 }
