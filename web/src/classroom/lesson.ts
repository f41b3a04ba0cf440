import type { Submission } from '../api/types'
import type { ClassSteps } from './class_steps'

/** Prefix of the id of a submission's motion among trajectories: class:ben. */
export const SUBMISSION = 'class:'

/** A class that a teacher steps through in the room. */
export interface Lesson {
  readonly steps: ClassSteps
  /** Publish a submission's motion for the teacher; return its id, rejects with why it cannot
   * be. */
  publish(submission: Submission): Promise<string>
}
