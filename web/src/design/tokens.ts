// Generated from config/design.json by `make docs`.
export type ThemeName = 'light' | 'dark'

export const STATE_NAMES = [
  'IDLE',
  'READY',
  'ADJUSTING',
  'PLAYING',
  'PAUSED',
  'COLLISION_HALT',
  'COMPLETE',
] as const
/** A state of a playback, as in mrlab_msgs/msg/PlaybackState: its number is its place. */
export type StateName = (typeof STATE_NAMES)[number]

export const THEMES = {
  light: {
    colours: {
      page: '#F7F8FA',
      card: '#FFFFFF',
      ink: '#16202B',
      second: '#4A5766',
      border: '#7B8896',
      hairline: '#DCE1E7',
      accent: '#0B5CAD',
      on_accent: '#FFFFFF',
      on_halt: '#FFFFFF',
    },
    states: {
      IDLE: '#667085',
      READY: '#0047B3',
      ADJUSTING: '#00805A',
      PLAYING: '#00805A',
      PAUSED: '#AD6200',
      COLLISION_HALT: '#7A0C1C',
      COMPLETE: '#0047B3',
    },
    joints: ['#00507B', '#B44809', '#007F7F', '#8A39D3', '#E27900', '#2C9ED9', '#173900'],
  },
  dark: {
    colours: {
      page: '#12161C',
      card: '#1B2129',
      ink: '#E8EDF2',
      second: '#A9B5C2',
      border: '#74818F',
      hairline: '#323B46',
      accent: '#6CB6FF',
      on_accent: '#0D1B2A',
      on_halt: '#1A0705',
    },
    states: {
      IDLE: '#8B95A1',
      READY: '#6CB6FF',
      ADJUSTING: '#5BE0A8',
      PLAYING: '#5BE0A8',
      PAUSED: '#FFE08A',
      COLLISION_HALT: '#FF5C4D',
      COMPLETE: '#6CB6FF',
    },
    joints: ['#576BB2', '#CA3B1D', '#43B892', '#B68CFF', '#F1CE0C', '#B6D4FD', '#FFFFCB'],
  },
} as const

export const STATE_ICONS = {
  IDLE: 'circle',
  READY: 'ready',
  ADJUSTING: 'adjusting',
  PLAYING: 'play',
  PAUSED: 'pause',
  COLLISION_HALT: 'halt',
  COMPLETE: 'complete',
} as const
