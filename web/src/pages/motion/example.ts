import example from '../../../../examples/quintic_ur5e.mat?url'

const NAME = 'quintic_ur5e.mat'
/** The robot that the example is for. */
export const EXAMPLE_MODEL = 'ur5e'

/** Return the shipped example. Rejects if the gateway does not answer. */
export async function exampleFile(): Promise<File> {
  const answer = await fetch(example)
  return new File([await answer.blob()], NAME)
}
