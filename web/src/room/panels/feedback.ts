import type { Feedback } from './panel'

/** Hz and s of each sound. */
const SOUNDS = { hover: [900, 0.012, 0.015], press: [620, 0.05, 0.06] } as const

/** Sound for each action, and a pulse in a controller. */
export function soundFeedback(
  pulse: (signal: Parameters<Feedback>[1], strength: number, ms: number) => void,
): { readonly feedback: Feedback; readonly halt: () => void; readonly dispose: () => void } {
  let audio: AudioContext | null = null
  const play = (pitch: number, volume: number, length: number) => {
    // A browser blocks sound before the first action of the person.
    if (navigator.userActivation?.hasBeenActive === false) return
    audio ??= new AudioContext()
    const tone = new OscillatorNode(audio, { frequency: pitch, type: 'sine' })
    const gain = new GainNode(audio, { gain: volume })
    gain.gain.exponentialRampToValueAtTime(0.0001, audio.currentTime + length)
    tone.connect(gain).connect(audio.destination)
    tone.start()
    tone.stop(audio.currentTime + length)
  }
  return {
    feedback: (what, signal) => {
      const [pitch, volume, length] = SOUNDS[what]
      play(pitch, volume, length)
      if (what === 'hover') pulse(signal, 0.2, 10)
      else pulse(signal, 0.5, 20)
    },
    halt: () => play(220, 0.2, 0.35),
    dispose: () => void audio?.close(),
  }
}
