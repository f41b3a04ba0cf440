import { useEffect, useRef, useState } from 'preact/hooks'
import { useApi } from '../../shell/session'

type Poses = readonly (readonly number[])[]

/** ms of a motion, whatever its own duration is. */
const LENGTH_MS = 2400

const known = new Map<string, Promise<Poses>>()

function line(points: readonly number[]): string {
  return points.reduce((text, value, i) => `${text}${i % 2 ? ',' : ' '}${value}`, '')
}

function Arm({ points }: { points: readonly number[] }) {
  const joints = points.length / 2
  return (
    <>
      <polyline class="sketch-arm" points={line(points)} />
      {Array.from({ length: joints }, (_, i) => (
        <circle key={i} class="sketch-joint" cx={points[2 * i]} cy={points[2 * i + 1]} r={2} />
      ))}
    </>
  )
}

interface SketchProps {
  /** Such as quintic@3. */
  readonly id: string
  /** A picture until the motion is known. */
  readonly instead: string | null
}

/** The way of a motion's tool and its poses, as a small drawing. It is loaded when it comes into
 * view, and moves once then and while its row is under the pointer or has the focus. */
export function Sketch({ id, instead }: SketchProps) {
  const api = useApi()
  const host = useRef<HTMLSpanElement>(null)
  const [poses, setPoses] = useState<Poses>([])
  const [at, setAt] = useState(0)
  useEffect(() => {
    const element = host.current
    if (element === null) return
    let here = true
    const seen = new IntersectionObserver(([entry]) => {
      if (!entry?.isIntersecting) return
      seen.disconnect()
      const loading = known.get(id) ?? api.sketch(id)
      known.set(id, loading)
      loading.then(
        (found) => here && setPoses(found),
        () => known.delete(id),
      )
    })
    seen.observe(element)
    return () => {
      here = false
      seen.disconnect()
    }
  }, [id, api])
  useEffect(() => {
    const row = host.current?.parentElement
    const last = poses.length - 1
    if (!row || last < 1) return
    if (matchMedia('(prefers-reduced-motion: reduce)').matches) {
      setAt(last)
      return
    }
    let request = 0
    const play = () => {
      cancelAnimationFrame(request)
      const begin = performance.now()
      const frame = (now: number) => {
        const share = Math.min(Math.max(now - begin, 0) / LENGTH_MS, 1)
        setAt(Math.round(share * last))
        if (share < 1) request = requestAnimationFrame(frame)
        else if (row.matches(':hover, :focus-within')) request = requestAnimationFrame(play)
      }
      request = requestAnimationFrame(frame)
    }
    play()
    row.addEventListener('pointerenter', play)
    row.addEventListener('focusin', play)
    return () => {
      cancelAnimationFrame(request)
      row.removeEventListener('pointerenter', play)
      row.removeEventListener('focusin', play)
    }
  }, [poses])
  const [first, now] = [poses[0], poses[at]]
  return (
    <span ref={host} class="trajectory-picture">
      {first && now ? (
        <svg class="trajectory-picture" viewBox="0 0 96 64" aria-hidden="true">
          <g class="sketch-begin">
            <Arm points={first} />
          </g>
          <polyline
            class="sketch-way"
            points={poses.map((pose) => line(pose.slice(-2))).join('')}
          />
          <Arm points={now} />
        </svg>
      ) : (
        instead && <img class="trajectory-picture" src={instead} alt="" loading="lazy" />
      )}
    </span>
  )
}
