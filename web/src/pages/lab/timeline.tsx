import { useEffect, useRef } from 'preact/hooks'
import type { RemotePlayer } from '../../playback/player'
import { Controls, type TimeMark } from '../../scene/preview/controls'
import { words } from '../../words/words'

interface TimelineProps {
  readonly player: RemotePlayer
  /** Hz, of the frames */
  readonly rate: number
  /** True if the person may play, seek and set the speed. */
  readonly enabled: boolean
  readonly marks?: readonly TimeMark[]
}

const NO_MARKS: readonly TimeMark[] = []

/** Play, timeline and speed of something that the lab plays. */
export function Timeline({ player, rate, enabled, marks = NO_MARKS }: TimelineProps) {
  const host = useRef<HTMLDivElement>(null)
  const shown = useRef<Controls | null>(null)
  const { scene } = words.value
  useEffect(() => {
    const row = (time: number) => Math.floor(time * rate + 1e-6) + 1
    const controls = new Controls(player, scene, rate > 0 ? 1 / rate : 0.01, row)
    controls.setEnabled(enabled)
    host.current?.append(controls.element)
    shown.current = controls
    let request = 0
    const frame = () => {
      controls.show(player.position())
      request = player.playing ? requestAnimationFrame(frame) : 0
    }
    const stir = () => {
      if (request === 0) request = requestAnimationFrame(frame)
    }
    const stop = player.onChange(stir)
    stir()
    return () => {
      stop()
      cancelAnimationFrame(request)
      controls.dispose()
    }
  }, [player, rate, scene, enabled])
  const { duration } = player
  useEffect(() => shown.current?.setMarks(marks), [marks, duration, player, rate, scene, enabled])
  return <div class="lab-timeline" ref={host} />
}
