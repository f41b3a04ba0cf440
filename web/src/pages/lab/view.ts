import { LabScene } from '../../scene/lab/lab_scene'
import { MeshLibrary } from '../../scene/robot/meshes'
import { Stage } from '../../scene/stage/stage'
import { words } from '../../words/words'

/** The picture of the lab, in code that is loaded only when it is shown. */
export class LabView {
  readonly scene: LabScene
  private readonly stage: Stage
  private readonly meshes = new MeshLibrary()

  /** Throws NoWebGL if the browser has none. say: reports things that could not be drawn. pose:
   * called before each picture; true requests another one. */
  constructor(
    container: HTMLElement,
    label: string,
    say: (text: string) => void,
    pose: () => boolean,
  ) {
    this.stage = new Stage(container, label)
    this.scene = new LabScene(this.stage, this.meshes, () => {
      say(words.value.scene.missing([...this.scene.troubles].join(', ')))
    })
    this.stage.onFrame(() => {
      const more = pose()
      this.scene.update()
      return more
    })
  }

  /** Ask for a new picture. */
  stir(): void {
    this.stage.invalidate()
  }

  setProjected(on: boolean): void {
    this.scene.setProjected(on)
  }

  dispose(): void {
    this.scene.dispose()
    this.stage.dispose()
    this.meshes.dispose()
  }
}
