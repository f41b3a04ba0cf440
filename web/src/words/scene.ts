import { en, type Words } from './en'

/** The words of the 3D view; the pages give those of the person's language. */
export type SceneWords = Words['scene']

export const ENGLISH: SceneWords = en.scene
