import type { JSX } from 'preact'

/** Drawn on 20 x 20; `solid` parts are filled. */
const SHAPES = {
  circle: <circle cx="10" cy="10" r="6.5" />,
  ready: (
    <>
      <circle cx="10" cy="10" r="7" />
      <circle class="solid" cx="10" cy="10" r="3" />
    </>
  ),
  adjusting: <path d="M3 10h9m-3.5-4 4 4-4 4M17 4v12" />,
  play: (
    <path
      class="solid"
      d="M6 3.8v12.4a.8.8 0 0 0 1.2.7l9.6-6.2a.8.8 0 0 0 0-1.4L7.2 3.1A.8.8 0 0 0 6 3.8Z"
    />
  ),
  pause: <path class="solid" d="M5 4h3.5v12H5zM11.5 4H15v12h-3.5z" />,
  halt: (
    <>
      <path d="M6.9 2.5h6.2l4.4 4.4v6.2l-4.4 4.4H6.9l-4.4-4.4V6.9z" />
      <path d="M10 6.2v4.6M10 13.6v.1" />
    </>
  ),
  complete: (
    <>
      <circle cx="10" cy="10" r="7.2" />
      <path d="m6.8 10.3 2.2 2.2 4.3-4.7" />
    </>
  ),
  error: (
    <>
      <path d="M6.9 2.5h6.2l4.4 4.4v6.2l-4.4 4.4H6.9l-4.4-4.4V6.9z" />
      <path d="M10 6.2v4.6M10 13.6v.1" />
    </>
  ),
  warning: (
    <>
      <path d="M10 2.8 18 16.7H2z" />
      <path d="M10 8v4M10 14.3v.1" />
    </>
  ),
  info: (
    <>
      <circle cx="10" cy="10" r="7.5" />
      <path d="M10 9.3v4.5M10 6.4v.1" />
    </>
  ),
  upload: (
    <path d="M10 13.5V3.2m-4 4 4-4 4 4M3.5 13v2.5a1.5 1.5 0 0 0 1.5 1.5h10a1.5 1.5 0 0 0 1.5-1.5V13" />
  ),
  download: (
    <path d="M10 3.2v10.3m-4-4 4 4 4-4M3.5 13v2.5a1.5 1.5 0 0 0 1.5 1.5h10a1.5 1.5 0 0 0 1.5-1.5V13" />
  ),
  motion: <path d="M3 15.5c3.5 0 3.5-11 7-11s3.5 11 7 11M3 4.5h.1M17 4.5h.1" />,
  robot: <path d="M4 17h8M8 17v-3l-3-5 5.5-4.5L15 8m0 0 1.8-.7M15 8l-.4 2M5 9h.1M10.4 4.5h.1" />,
  eye: (
    <>
      <path d="M2.5 10S5.2 4.8 10 4.8 17.5 10 17.5 10 14.8 15.2 10 15.2 2.5 10 2.5 10Z" />
      <circle class="solid" cx="10" cy="10" r="2.4" />
    </>
  ),
  target: (
    <>
      <circle cx="10" cy="10" r="5.5" />
      <path d="M10 2v4M10 14v4M2 10h4M14 10h4" />
    </>
  ),
  room: <path d="M3 6.5 10 3l7 3.5v7L10 17l-7-3.5zM3 6.5l7 3.5 7-3.5M10 10v7" />,
  people: (
    <>
      <circle cx="7.5" cy="6.5" r="3" />
      <path d="M2 16.5c0-3 2.4-5 5.5-5s5.5 2 5.5 5M13 3.8a3 3 0 0 1 0 5.4M15 12c1.8.7 3 2.3 3 4.5" />
    </>
  ),
  person: (
    <>
      <circle cx="10" cy="6.5" r="3.3" />
      <path d="M3.5 17c0-3.4 2.8-5.5 6.5-5.5s6.5 2.1 6.5 5.5" />
    </>
  ),
  headset: (
    <path d="M3 7.5A1.5 1.5 0 0 1 4.5 6h11A1.5 1.5 0 0 1 17 7.5v5a1.5 1.5 0 0 1-1.5 1.5h-2.700L10 11.5 7.2 14H4.5A1.5 1.5 0 0 1 3 12.5z" />
  ),
  search: (
    <>
      <circle cx="9" cy="9" r="5.5" />
      <path d="m13.2 13.2 4 4" />
    </>
  ),
  fit: <path d="M3 7V3h4M13 3h4v4M17 13v4h-4M7 17H3v-4" />,
  projector: <path d="M3 4h14v9H3zM10 13v2.500M6.500 17l3.500-1.500 3.500 1.500" />,
  topics: <path d="M3 5h3M9 5h8M6 10h3M12 10h5M6 15h3M12 15h5M4.500 5v10" />,
  copy: (
    <>
      <rect x="7" y="7" width="9.5" height="9.5" rx="1.5" />
      <path d="M13 7V5a1.5 1.5 0 0 0-1.5-1.5H5A1.5 1.5 0 0 0 3.5 5v6.5A1.5 1.5 0 0 0 5 13h2" />
    </>
  ),
  share: <path d="M10 12.5V3m-3.5 3L10 2.5 13.5 6M6 9H4.5v8h11V9H14" />,
  trash: <path d="M3.5 5.5h13M8 5.5V3.5h4v2M5.5 5.5l.7 11h7.600l.7-11M8.5 9v4.5M11.5 9v4.5" />,
  undo: <path d="M7 4 3.5 7.5 7 11M3.5 7.5H12a4.5 4.5 0 0 1 0 9H8" />,
  close: <path d="m5 5 10 10M15 5 5 15" />,
  back: <path d="M12.5 4 6.5 10l6 6" />,
  next: <path d="M7.5 4l6 6-6 6" />,
  more: (
    <>
      <circle class="solid" cx="4" cy="10" r="1.6" />
      <circle class="solid" cx="10" cy="10" r="1.6" />
      <circle class="solid" cx="16" cy="10" r="1.6" />
    </>
  ),
  check: <path d="m4 10.5 4 4 8-9" />,
  wrench: (
    <path d="M16.7 5.3 13.9 8.100l-2-2 2.8-2.800a4.6 4.6 0 0 0-6 5.900L3 14.9 5.1 17l5.7-5.700a4.6 4.6 0 0 0 5.9-6z" />
  ),
  compare: <path d="M7 3v14M13 3v14M3 7h4M3 13h4M13 7h4M13 13h4" />,
  link: (
    <path d="M8.3 11.700a3.3 3.3 0 0 0 4.7 0l2.9-2.900a3.3 3.3 0 0 0-4.7-4.700l-.9.900M11.7 8.300a3.3 3.3 0 0 0-4.7 0l-2.9 2.900a3.3 3.3 0 0 0 4.7 4.700l.9-.9" />
  ),
  light: (
    <>
      <circle cx="10" cy="10" r="3.3" />
      <path d="M10 2.5V4M10 16v1.5M2.5 10H4M16 10h1.5M4.7 4.700l1 1M14.3 14.300l1 1M4.7 15.300l1-1M14.3 5.700l1-1" />
    </>
  ),
  dark: <path d="M16.5 11.800A6.8 6.8 0 0 1 8.2 3.5a6.8 6.8 0 1 0 8.3 8.300z" />,
} satisfies Record<string, JSX.Element>

export type IconName = keyof typeof SHAPES

export function Icon({ name }: { name: IconName }) {
  return (
    <svg class="icon" viewBox="0 0 20 20" aria-hidden="true" focusable="false">
      {SHAPES[name]}
    </svg>
  )
}
