import { Plane, Raycaster, Vector3 } from 'three'
import { LookHere } from '../../lab/people/look_here'
import { People, type Present } from '../../lab/people/people'
import type { Link } from '../../link/link'
import type { RecorderState } from '../../protocol/mrlab_msgs'
import { LabScene } from '../../scene/lab/lab_scene'
import { MeshLibrary } from '../../scene/robot/meshes'
import { Stage } from '../../scene/stage/stage'
import { words } from '../../words/words'

const FLOOR = new Plane(new Vector3(0, 1, 0), 0)
/** s */
const LONGEST_STEP = 0.1

/** What the page is told by the picture. */
export interface ViewNews {
  /** Something could not be drawn. */
  trouble(text: string): void
  /** People came or left. seen: the display that the picture is seen with; empty: none. */
  people(present: readonly Present[], seen: string): void
}

/** The picture of the lab, in code that is loaded only when it is shown. */
export class LabView {
  readonly scene: LabScene
  private readonly stage: Stage
  private readonly meshes = new MeshLibrary()
  private readonly people: People
  private readonly lookHere: LookHere
  private readonly raycaster = new Raycaster()
  private drawnAt = 0

  /** Throws NoWebGL if the browser has none. pose: called before each picture; true requests
   * another one. */
  constructor(
    container: HTMLElement,
    link: Link,
    private readonly news: ViewNews,
    pose: () => boolean,
  ) {
    this.stage = new Stage(container, words.value.lab.picture)
    this.scene = new LabScene(this.stage, this.meshes, () => {
      news.trouble(words.value.scene.missing([...this.scene.troubles].join(', ')))
    })
    const { world } = this.stage
    this.people = new People(link, world, '', words.value, () => this.cameOrLeft())
    this.lookHere = new LookHere(link, world, words.value, () => this.stir())
    this.stage.onFrame((now) => {
      let more = pose()
      this.scene.update()
      const step = Math.min(now - this.drawnAt, LONGEST_STEP)
      this.drawnAt = now
      more = this.people.update(now, step) || more
      return this.lookHere.update(now) || more
    })
  }

  /** Ask for a new picture. */
  stir(): void {
    this.stage.invalidate()
  }

  /** Show where a guided replay stands. */
  stand(state: RecorderState | null): void {
    this.lookHere.stand(state)
    this.stir()
  }

  setProjected(on: boolean): void {
    this.scene.setProjected(on)
  }

  /** See with the eyes of a display; empty: with our own. */
  seeWith(id: string): void {
    const eyes = this.people.eyes(id)
    this.people.seenBy = eyes === undefined ? '' : id
    this.stage.seeWith(eyes ?? null)
    this.cameOrLeft()
  }

  /** Ask everybody to look at what the picture shows at a place, CSS pixels; returns whether there
   * is something. */
  point(clientX: number, clientY: number): boolean {
    const { stage, raycaster } = this
    stage.ray(clientX, clientY, raycaster)
    const hit = raycaster
      .intersectObjects(this.scene.solid, true)
      .find(({ object }) => object.visible)
    const at = hit?.point ?? raycaster.ray.intersectPlane(FLOOR, new Vector3())
    if (at === null) return false
    this.lookHere.ask(stage.world.worldToLocal(at))
    return true
  }

  dispose(): void {
    this.people.dispose()
    this.lookHere.dispose()
    this.scene.dispose()
    this.stage.dispose()
    this.meshes.dispose()
  }

  private cameOrLeft(): void {
    const { people, stage } = this
    if (people.seenBy !== '') {
      const eyes = people.eyes(people.seenBy)
      if (eyes === undefined) people.seenBy = ''
      stage.seeWith(eyes ?? null)
    }
    this.news.people(people.present, people.seenBy)
    stage.invalidate()
  }
}
